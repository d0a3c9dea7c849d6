//! Native time stepping: the paper's DEM for any number of cylinders and plane walls.
//!
//! The stepping code uses +, −, ×, ÷ and √ alone, in a fixed order and without fused multiply-add, so
//! that its results are the same bits on every machine.

mod contact;
mod first_event;
mod scene;
mod stack_run;

pub use contact::{ContactLaw, ContactState, TangentialStep};
pub use first_event::{Loading, Observation, Until, watch_stack};
pub use scene::{Cylinder, PlaneWall, Scene};
pub use stack_run::{SOURCE_DIGEST, compress_stack, compress_stack_while};
