//! LIGGGHTS: one process a case, the series in the last table of its log.

use super::Code;
use super::external::Adapter;
use super::installation::VersionQuestion;
use super::pyramid_log::read_pyramid;
use super::task::{Deck, ParameterFile};
use super::thermo_log;
use crate::model::{Arms, Case, ContactConvention, CoulombOperand, HistoryUpdate, SlidingSpring};

/// Both arms end halfway into the overlap; the cylinders are spheres.
pub const CONVENTION: ContactConvention = ContactConvention {
    arms: Arms::reciprocal(-0.5, -0.5),
    coulomb_operand: CoulombOperand::Spring,
    sliding_spring: SlidingSpring::FollowsLimit,
    history_update: HistoryUpdate::Projected,
    moment_of_inertia: 0.4,
    ..ContactConvention::PAPER
};

const LOG: &str = "log.liggghts";

/// LIGGGHTS, pair_style gran hooke/stiffness with tangential history, mesh wall on top.
pub static LIGGGHTS: Adapter = Adapter {
    name: Code::Liggghts,
    program: "liggghts",
    // Without a deck to read it prints its banner and ends.
    version: VersionQuestion {
        arguments: &["-in", "/dev/null", "-log", "none"],
        before_version: "LIGGGHTS (Version LIGGGHTS-PUBLIC ",
        package_says_it: true,
    },
    environment: super::QUICK_OPEN_MPI,
    logs: &[LOG],
    parameter_file: ParameterFile::Lammps,
    stack: compression(
        &[
            ("stack.in", include_str!("../../liggghts_inputs/stack.in")),
            CONTACTS,
            TOP_WALL,
            WALL,
        ],
        |_| arguments("stack.in"),
    ),
    side_walls: Some(compression(
        &[
            (
                "side_walls.in",
                include_str!("../../liggghts_inputs/side_walls.in"),
            ),
            CONTACTS,
            TOP_WALL,
            WALL,
            (
                "side_wall.stl",
                include_str!("../../liggghts_inputs/side_wall.stl"),
            ),
        ],
        |_| arguments("side_walls.in"),
    )),
    probe: Deck {
        files: &[
            ("probe.in", include_str!("../../liggghts_inputs/probe.in")),
            CONTACTS,
            TOP_WALL,
            WALL,
        ],
        arguments: |_| arguments("probe.in"),
        completion_file: None,
        read: |directory, test| thermo_log::read_motion(directory, LOG, ["step", "x1"], test),
    },
    pyramid: Some(Deck {
        files: &[
            (
                "pyramid.in",
                include_str!("../../liggghts_inputs/pyramid.in"),
            ),
            CONTACTS,
        ],
        arguments: |_| arguments("pyramid.in"),
        completion_file: None,
        read: |directory, pyramid| read_pyramid(directory, LOG, pyramid),
    }),
    precise_program: None,
};

const fn compression(
    files: &'static [(&'static str, &'static str)],
    arguments: fn(&[String]) -> Vec<String>,
) -> Deck<Case> {
    Deck {
        files,
        arguments,
        completion_file: None,
        read: |directory, case| thermo_log::read_series(directory, LOG, ["step", "time"], case),
    }
}

const CONTACTS: (&str, &str) = (
    "contacts.in",
    include_str!("../../liggghts_inputs/contacts.in"),
);
const TOP_WALL: (&str, &str) = (
    "top_wall.in",
    include_str!("../../liggghts_inputs/top_wall.in"),
);
const WALL: (&str, &str) = ("wall.stl", include_str!("../../liggghts_inputs/wall.stl"));

fn arguments(deck: &str) -> Vec<String> {
    ["-in", deck, "-log", LOG].map(str::to_owned).to_vec()
}
