//! A time series with named columns, and the yield force read off it.

mod estimate;
mod series;

pub use estimate::{Estimate, YieldEstimates};
pub use series::{Sample, SeriesError, Trace};
