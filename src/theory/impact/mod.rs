//! Impacts: the motion of two bodies through one contact, without gravity (docs/theory.md, section 12).

mod normal;
mod sliding;

pub use normal::NormalImpact;
pub use sliding::{SlidingChange, sliding_change};
