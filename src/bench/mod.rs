//! What a step costs: native beside the external codes, in one call.

mod pyramid;

pub use pyramid::{BenchError, PyramidBench, PyramidCost};
