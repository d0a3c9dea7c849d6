//! Studies: each names the runs that it needs and evaluates them.

pub mod convention;
pub mod cost;
pub mod preparation;
pub mod regimes;
pub mod trajectory;
mod verdict;
pub mod yield_force;

pub use verdict::{MAX_TOLERANCE, MIN_TOLERANCE, Source, Verdict, judge, tolerance};
