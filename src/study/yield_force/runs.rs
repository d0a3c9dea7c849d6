//! The runs of a measurement by their positions, which plan and extrapolation share.

/// Wall speeds in units of the predicted displacement (see `speed_scale`), fastest first, each half the one before.
pub(crate) const SPEEDS: [f64; 3] = [2e-3, 1e-3, 5e-4];

/// Position of the run at the middle speed, with which the two further runs are compared.
pub const MIDDLE_RUN: usize = 1;
/// Position of the run with twice the time step.
pub(crate) const COARSE_TIME_STEP_RUN: usize = SPEEDS.len();
/// Position of the run with half the gravity ramp.
pub const SHORT_RAMP_RUN: usize = SPEEDS.len() + 1;

/// Positions of the runs without shortcuts, where the others take some: at the fastest and the middle speed.
pub(crate) const PLAIN_RUNS: [usize; 2] = [SPEEDS.len() + 2, SPEEDS.len() + 3];
