//! The cost of a step, of a start and of a yield force: native beside the external codes.

mod duration;
mod memory;
mod pyramid;
mod scaling;
mod stack;
mod statistics;
mod target;

pub use duration::{Basis, CodeDuration, durations};
pub use pyramid::{PyramidBench, PyramidCost};
pub use scaling::{Scaling, ScalingRow, measure_scaling};
pub use stack::{StackCost, installed_codes, measure_stack};
pub use target::{BenchError, BenchTarget};
