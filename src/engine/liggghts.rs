//! LIGGGHTS: one process a case, the series in the last table of its log.

use super::EngineName;
use super::deck::DeckParameters;
use super::external::Adapter;
use super::installation::VersionQuestion;
use super::thermo_log;
use crate::stack::{Case, Convention, CoulombOperand, SlidingSpring, SpringTransport};
use crate::trace::{SeriesError, Trace};
use std::path::Path;

/// Both arms end halfway into the overlap; the cylinders are spheres.
pub const CONVENTION: Convention = Convention {
    pair_arm: -0.5,
    floor_arm: -0.5,
    coulomb_operand: CoulombOperand::Spring,
    sliding_spring: SlidingSpring::FollowsLimit,
    spring_transport: SpringTransport::Projected,
    moment_of_inertia: 0.4,
    ..Convention::PAPER
};

const LOG: &str = "log.liggghts";

/// LIGGGHTS, pair_style gran hooke/stiffness with tangential history, mesh wall on top.
pub static LIGGGHTS: Adapter = Adapter {
    name: EngineName::Liggghts,
    program: "liggghts",
    // Without a deck to read it prints its banner and ends.
    version: VersionQuestion {
        arguments: &["-in", "/dev/null", "-log", "none"],
        before_version: "LIGGGHTS (Version LIGGGHTS-PUBLIC ",
        package_says_it: true,
    },
    deck: &[
        ("stack.in", include_str!("../../liggghts_inputs/stack.in")),
        ("wall.stl", include_str!("../../liggghts_inputs/wall.stl")),
    ],
    environment: super::QUICK_OPEN_MPI,
    logs: &[LOG],
    parameter_file: "parameters.in",
    parameters: DeckParameters::to_lammps,
    arguments: |_| ["-in", "stack.in", "-log", LOG].map(str::to_owned).to_vec(),
    completion_file: None,
    read_series,
};

fn read_series(directory: &Path, case: &Case) -> Result<Trace, SeriesError> {
    thermo_log::read_series(directory, LOG, ["step", "time"], case)
}
