//! YADE: one process for many tasks, because it takes a second to start; each writes its own file. On each of
//! its three floors it is an code of its own.

use super::Code;
use super::external::Adapter;
use super::installation::VersionQuestion;
use super::task::{Deck, ParameterFile};
use crate::model::{
    Arms, Case, ContactConvention, ContactTest, CoulombOperand, HistoryUpdate, SlidingSpring,
    TensileForce,
};
use crate::series::{Motion, Series, SeriesError};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// On a box or a facet: both arms end halfway into the overlap.
pub const CONVENTION: ContactConvention = ContactConvention {
    arms: Arms::reciprocal(-0.5, -0.5),
    coulomb_operand: CoulombOperand::Spring,
    sliding_spring: SlidingSpring::FollowsLimit,
    history_update: HistoryUpdate::Linearised,
    tensile_force: TensileForce::NeverPulls,
    ..ContactConvention::PAPER
};

/// On a wall: the floor arm ends at the floor.
pub const ON_WALL: ContactConvention = ContactConvention {
    arms: Arms::reciprocal(-0.5, -1.0),
    ..CONVENTION
};

const SERIES: &str = "series.csv";
const MOTION: &str = "probe.csv";

/// On a floor of boxes.
pub static BOX: Adapter = adapter(
    Code::Yade,
    |directories| arguments("stack.py", "box", directories),
    |directories| arguments("side_walls.py", "box", directories),
    |directories| arguments("probe.py", "box", directories),
);

/// On a floor of facets.
pub static FACET: Adapter = adapter(
    Code::YadeFacet,
    |directories| arguments("stack.py", "facet", directories),
    |directories| arguments("side_walls.py", "facet", directories),
    |directories| arguments("probe.py", "facet", directories),
);

/// On a floor that is a wall.
pub static WALL: Adapter = adapter(
    Code::YadeWall,
    |directories| arguments("stack.py", "wall", directories),
    |directories| arguments("side_walls.py", "wall", directories),
    |directories| arguments("probe.py", "wall", directories),
);

type Arguments = fn(&[String]) -> Vec<String>;

const fn adapter(name: Code, stack: Arguments, side_walls: Arguments, probe: Arguments) -> Adapter {
    Adapter {
        name,
        program: "yade",
        version: VersionQuestion {
            arguments: &["--version"],
            before_version: "Yade version: ",
            package_says_it: true,
        },
        environment: &[],
        logs: &[],
        parameter_file: ParameterFile::Json,
        stack: compression(&[STACK, CONTACTS, CASES], stack),
        side_walls: Some(compression(
            &[
                (
                    "side_walls.py",
                    include_str!("../../yade_scripts/side_walls.py"),
                ),
                STACK,
                CONTACTS,
                CASES,
            ],
            side_walls,
        )),
        probe: Deck {
            files: &[
                ("probe.py", include_str!("../../yade_scripts/probe.py")),
                CONTACTS,
                CASES,
            ],
            arguments: probe,
            completion_file: Some(MOTION),
            read: read_motion,
        },
        pyramid: None,
        precise_program: Some("yade-longdouble"),
    }
}

const fn compression(
    files: &'static [(&'static str, &'static str)],
    arguments: Arguments,
) -> Deck<Case> {
    Deck {
        files,
        arguments,
        completion_file: Some(SERIES),
        read: read_series,
    }
}

const STACK: (&str, &str) = ("stack.py", include_str!("../../yade_scripts/stack.py"));
const CONTACTS: (&str, &str) = (
    "contacts.py",
    include_str!("../../yade_scripts/contacts.py"),
);
const CASES: (&str, &str) = ("cases.py", include_str!("../../yade_scripts/cases.py"));

fn arguments(script: &str, floor: &str, directories: &[String]) -> Vec<String> {
    let fixed = ["-n", "-x", "-j1", script, floor].map(str::to_owned);
    fixed
        .into_iter()
        .chain(directories.iter().cloned())
        .collect()
}

fn read_series(directory: &Path, case: &Case) -> Result<Series, SeriesError> {
    let schedule = case.protocol.schedule();
    Series::read(open(directory, SERIES)?, &schedule, case.protocol.time_step)
}

fn read_motion(directory: &Path, test: &ContactTest) -> Result<Motion, SeriesError> {
    Motion::read(open(directory, MOTION)?, test.steps)
}

fn open(directory: &Path, name: &str) -> Result<BufReader<File>, SeriesError> {
    let file = File::open(directory.join(name)).map_err(|error| SeriesError::Absent {
        message: format!("cannot read {name}: {error}"),
    })?;
    Ok(BufReader::new(file))
}
