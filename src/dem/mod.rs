//! Native time stepping: the paper's DEM for any number of cylinders and plane walls.
//!
//! The stepping code uses +, −, ×, ÷ and √ alone, in a fixed order and without fused multiply-add, so
//! that its results are the same bits on every machine.

mod contact;
mod contact_run;
mod first_event;
mod frames;
mod packing;
mod real;
mod scene;
mod side_walls;
mod stack_run;

pub use contact::{Contact, ContactForce, ContactModel, Spring, SpringDashpot};
pub use contact_run::{run_contact_test, run_contact_test_with};
pub use first_event::{Loading, Observation, Until, watch_stack};
pub use frames::compress_stack_into_frames;
pub use packing::{Material, PYRAMID_FLOOR, Packing, run_pyramid};
pub use real::{Real, real};
pub use scene::{Cylinder, Load, PlaneWall, Scene};
pub use stack_run::{SOURCE_DIGEST, compress_stack, compress_stack_precisely, compress_stack_with};
