//! LAMMPS: one process a case, the series in the last table of its log.

use super::Code;
use super::external::Adapter;
use super::installation::VersionQuestion;
use super::pyramid_log::read_pyramid;
use super::task::{Deck, ParameterFile};
use super::thermo_log;
use crate::model::{ContactConvention, HistoryUpdate, SlidingSpring};

/// The paper's own arms, both end at the undeformed radius; the spring is treated differently.
pub const CONVENTION: ContactConvention = ContactConvention {
    sliding_spring: SlidingSpring::FollowsLimit,
    history_update: HistoryUpdate::Projected,
    ..ContactConvention::PAPER
};

const LOG: &str = "log.lammps";

/// LAMMPS, pair_style gran/hooke/history in two dimensions, region wall on top.
pub static LAMMPS: Adapter = Adapter {
    name: Code::Lammps,
    program: "lmp",
    // The version of the Debian package is the date of its packaging.
    version: VersionQuestion {
        arguments: &["-help"],
        before_version: "Large-scale Atomic/Molecular Massively Parallel Simulator - ",
        package_says_it: false,
    },
    environment: super::QUICK_OPEN_MPI,
    logs: &[LOG],
    parameter_file: ParameterFile::Lammps,
    stack: Deck {
        files: &[
            ("stack.in", include_str!("../../lammps_inputs/stack.in")),
            CONTACTS,
            TOP_WALL,
        ],
        arguments: |_| arguments("stack.in"),
        completion_file: None,
        read: |directory, case| thermo_log::read_series(directory, LOG, ["v_step", "v_time"], case),
    },
    side_walls: None,
    probe: Deck {
        files: &[
            ("probe.in", include_str!("../../lammps_inputs/probe.in")),
            CONTACTS,
            TOP_WALL,
        ],
        arguments: |_| arguments("probe.in"),
        completion_file: None,
        read: |directory, test| thermo_log::read_motion(directory, LOG, ["v_step", "v_x1"], test),
    },
    pyramid: Some(Deck {
        files: &[("pyramid.in", include_str!("../../lammps_inputs/pyramid.in"))],
        arguments: |_| arguments("pyramid.in"),
        completion_file: None,
        read: |directory, pyramid| read_pyramid(directory, LOG, pyramid),
    }),
    precise_program: None,
};

const CONTACTS: (&str, &str) = (
    "contacts.in",
    include_str!("../../lammps_inputs/contacts.in"),
);
const TOP_WALL: (&str, &str) = (
    "top_wall.in",
    include_str!("../../lammps_inputs/top_wall.in"),
);

fn arguments(deck: &str) -> Vec<String> {
    ["-in", deck, "-log", LOG, "-screen", "none"]
        .map(str::to_owned)
        .to_vec()
}
