//! The runs of a measurement by their positions, which plan and extrapolation share.

use serde::{Deserialize, Serialize};

/// Wall speeds in units of the predicted displacement (see `speed_scale`), fastest first, each half the one before.
pub(crate) const SPEEDS: [f64; 3] = [2e-3, 1e-3, 5e-4];

/// Position of the run at the middle speed, with which the two further runs are compared.
pub const MIDDLE_RUN: usize = 1;
/// Position of the run at the lowest speed.
pub const SLOWEST_RUN: usize = 2;
/// Position of the run with twice the time step.
pub(crate) const COARSE_TIME_STEP_RUN: usize = SPEEDS.len();
/// Position of the run with half the gravity ramp.
pub const SHORT_RAMP_RUN: usize = SPEEDS.len() + 1;
/// Position of the run at the fastest speed with twice the time step, for springs that remember forces.
pub(crate) const COARSE_AND_FAST_RUN: usize = SPEEDS.len() + 2;

/// How the yield force is read off the runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Slip onset, extrapolated to vanishing wall speed.
    Extrapolated,
    /// As in the paper: the peak at the wall speed and time step of the paper, less what theory expects the speed to add.
    /// A run twice as fast shows what is left.
    Literal,
    /// The force with which rigid bodies give way, at vanishing wall travel.
    Rigid,
    /// Slip onset at one wall speed, less what theory expects the speed to add; never planned.
    #[serde(skip)]
    AtOneSpeed,
}

impl Method {
    /// Position of the run that those with another time step or another ramp are compared with.
    pub(crate) fn compared_run(self) -> usize {
        match self {
            Self::Extrapolated => MIDDLE_RUN,
            Self::Literal | Self::AtOneSpeed | Self::Rigid => 0,
        }
    }
}

/// Which run of a measurement is which, by position. The first three differ in their wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunRoles {
    /// The wall speeds of the first three runs in units of the predicted displacement, fastest first; three times the
    /// same speed if there is only one.
    pub speeds: [f64; 3],
    /// The run with twice the time step, if there is one.
    pub coarse_time_step: Option<usize>,
    /// The run at the fastest speed with twice the time step, if there is one.
    pub coarse_and_fast: Option<usize>,
    /// The run with half the gravity ramp, if there is one.
    pub short_ramp: Option<usize>,
    /// Whether the gravity ramp slows down with the wall, so that what it leaves behind differs from speed to speed.
    pub has_slow_ramps: bool,
    /// The runs without shortcuts at the fastest and the middle speed, if the others take shortcuts.
    pub plain: Option<[usize; 2]>,
}

impl RunRoles {
    /// The roles in a planned measurement.
    pub const PLANNED: Self = Self {
        speeds: SPEEDS,
        coarse_time_step: Some(COARSE_TIME_STEP_RUN),
        coarse_and_fast: None,
        short_ramp: Some(SHORT_RAMP_RUN),
        has_slow_ramps: false,
        plain: None,
    };
}
