//! The regime map against the native DEM: which event comes first on either side of every boundary, and which
//! largest force follows from the events.

mod boundary;
mod examined_stacks;
mod largest_force;
mod loading;
mod survey;

pub use boundary::{Confirmation, Side};
pub use examined_stacks::examined_stacks;
pub use largest_force::Examination;
pub use survey::{Survey, SurveyPlan, survey};

/// Relative distance from a boundary at which its neighbours are examined: half a unit of the third digit.
pub const THREE_DIGITS: f64 = 5e-4;
