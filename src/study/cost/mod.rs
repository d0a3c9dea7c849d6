//! What a step costs: native beside the external codes, in one call.

mod memory;
mod pyramid;
mod scaling;
mod stack;
mod statistics;
mod target;

pub use pyramid::{PyramidBench, PyramidCost};
pub use scaling::{Scaling, ScalingBench, ScalingRow};
pub use stack::{StackBench, StackCost};
pub use target::{BenchError, BenchTarget};
