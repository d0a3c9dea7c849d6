//! What a step costs: native beside the external codes, in one call.

mod contestant;
mod memory;
mod pyramid;
mod scaling;
mod stack;
mod statistics;

pub use contestant::{BenchError, Contestant};
pub use pyramid::{PyramidBench, PyramidCost};
pub use scaling::{Scaling, ScalingBench, ScalingRow};
pub use stack::{StackBench, StackCost};
