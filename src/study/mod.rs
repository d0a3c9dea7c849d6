//! Studies: each names the runs that it needs and evaluates them.
//!
//! [`Campaign`] does everything between the two for all of them: runs from the store, recorded runs, codes on
//! all cores, contradicted conventions. [`Grounds`] derives the verdict on a row.

pub mod convention;
pub mod cost;
mod pipeline;
pub mod preparation;
pub mod regimes;
pub mod trajectory;
mod verdict;
pub mod yield_force;

pub use pipeline::{Campaign, Evaluation, Judged, Study};
pub(crate) use verdict::Ground;
pub use verdict::{Grounds, MAX_TOLERANCE, MIN_TOLERANCE, Source, Verdict, tolerance};
