//! Studies: each names the runs that it needs and evaluates them.
//!
//! [`Campaign`] does everything in between for all of them: it takes runs from the store or recorded runs, starts
//! codes on all cores, and withdraws judgements whose convention is contradicted. [`Grounds`] derives the verdict on
//! a row.

pub mod atlas;
pub mod check;
pub mod convention;
pub mod cost;
mod elsewhere;
pub mod impact;
mod mechanics;
mod pipeline;
pub mod preparation;
pub mod regimes;
mod tolerance;
pub mod trajectory;
mod verdict;
pub mod yield_force;

pub use elsewhere::{PLAN, Plan, PlannedRow};
pub use pipeline::{Campaign, Evaluation, Judged, Source, Study};
pub(crate) use tolerance::ROUNDING;
pub use tolerance::{MAX_TOLERANCE, MIN_TOLERANCE, RESOLUTIONS, tolerance};
pub(crate) use verdict::Ground;
pub use verdict::{Cause, Grounds, Verdict};
