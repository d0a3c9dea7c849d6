//! YADE: many cases a process, because its start takes longer than most cases.

use super::EngineName;
use super::deck::DeckParameters;
use super::external::Adapter;
use super::installation::VersionQuestion;
use crate::stack::{
    Case, Convention, CoulombOperand, SeparatingForce, SlidingSpring, SpringTransport,
};
use crate::trace::{SeriesError, Trace};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Both arms end halfway into the overlap, on a floor made of boxes.
pub const CONVENTION: Convention = Convention {
    pair_arm: -0.5,
    floor_arm: -0.5,
    coulomb_operand: CoulombOperand::Spring,
    sliding_spring: SlidingSpring::FollowsLimit,
    spring_transport: SpringTransport::Linearised,
    separating_force: SeparatingForce::NeverPulls,
    ..Convention::PAPER
};

const SERIES: &str = "series.csv";

/// YADE, ViscElPhys_Basic, box floor.
pub static YADE: Adapter = Adapter {
    name: EngineName::Yade,
    program: "yade",
    version: VersionQuestion {
        arguments: &["--version"],
        before_version: "Yade version: ",
        package_says_it: true,
    },
    deck: &[("stack.py", include_str!("../../yade_scripts/stack.py"))],
    environment: &[],
    logs: &[],
    parameter_file: "parameters.json",
    parameters: DeckParameters::to_json,
    arguments: |directories| {
        let fixed = ["-n", "-x", "-j1", "stack.py"].map(str::to_owned);
        fixed
            .into_iter()
            .chain(directories.iter().cloned())
            .collect()
    },
    completion_file: Some(SERIES),
    read_series,
};

fn read_series(directory: &Path, case: &Case) -> Result<Trace, SeriesError> {
    let file = File::open(directory.join(SERIES)).map_err(|error| SeriesError::Absent {
        message: format!("cannot read {SERIES}: {error}"),
    })?;
    let schedule = case.protocol.schedule();
    Trace::read(BufReader::new(file), &schedule, case.protocol.time_step)
}
