//! LAMMPS: one process a case, the series in the last table of its log.

use super::EngineName;
use super::deck::DeckParameters;
use super::external::Adapter;
use super::installation::VersionQuestion;
use super::thermo_log;
use crate::stack::{Case, Convention, SlidingSpring, SpringTransport};
use crate::trace::{SeriesError, Trace};
use std::path::Path;

/// The paper's own arms, both end at the undeformed radius; the spring is treated differently.
pub const CONVENTION: Convention = Convention {
    sliding_spring: SlidingSpring::FollowsLimit,
    spring_transport: SpringTransport::Projected,
    ..Convention::PAPER
};

const LOG: &str = "log.lammps";

/// LAMMPS, pair_style gran/hooke/history in two dimensions, region wall on top.
pub static LAMMPS: Adapter = Adapter {
    name: EngineName::Lammps,
    program: "lmp",
    // The version of the Debian package is the date of its packaging.
    version: VersionQuestion {
        arguments: &["-help"],
        before_version: "Large-scale Atomic/Molecular Massively Parallel Simulator - ",
        package_says_it: false,
    },
    deck: &[("stack.in", include_str!("../../lammps_inputs/stack.in"))],
    environment: super::QUICK_OPEN_MPI,
    logs: &[LOG],
    parameter_file: "parameters.in",
    parameters: DeckParameters::to_lammps,
    arguments: |_| {
        ["-in", "stack.in", "-log", LOG, "-screen", "none"]
            .map(str::to_owned)
            .to_vec()
    },
    completion_file: None,
    read_series,
};

fn read_series(directory: &Path, case: &Case) -> Result<Trace, SeriesError> {
    thermo_log::read_series(directory, LOG, ["v_step", "v_time"], case)
}
