//! The numbers that the stepping is done in: doubles, or double-doubles to see what rounding does to them.

use num_traits::{Float, NumAssign};
use std::fmt::Debug;

/// A real number.
pub trait Real: Float + NumAssign + Debug + From<f64> + Into<f64> {}

impl<R: Float + NumAssign + Debug + From<f64> + Into<f64>> Real for R {}

/// `value` exactly.
pub fn real<R: Real>(value: f64) -> R {
    <R as From<f64>>::from(value)
}
