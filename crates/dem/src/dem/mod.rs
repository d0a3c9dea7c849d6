//! Native time stepping: the paper's DEM for any number of cylinders or spheres and plane walls, and its stack with
//! other contact laws.
//!
//! The stepping uses only +, −, ×, ÷ and √, in a fixed order and without fused multiply-add, so that its results have
//! the same bits on every machine.

mod body;
mod contact;
mod contact_run;
mod contact_state;
mod double_double;
mod first_event;
mod frames;
mod geometry;
mod lane_group;
mod lanes;
mod loading;
mod many_stacks;
mod packing;
mod power_law;
mod published;
mod real;
mod scene;
mod stack_run;
mod stack_scene;
mod wall;

pub use body::{Body, Cylinder, Load, Sphere};
pub use contact::{Contact, ContactForce, ContactModel, Counterpart, Spring, SpringDashpot};
pub use contact_run::{run_contact_test, run_contact_test_in, run_contact_test_with};
pub use first_event::{EventRun, Loading, Observation, Until};
pub use frames::compress_stack_into_frames;
pub use geometry::{Facing, Geometry, Linear, Plane, Space, Tangential};
pub use many_stacks::{Checkpoint, LaneKind, LaneWidth, OpenRun, OpenRuns, RunQueue};
pub use packing::{Material, PYRAMID_FLOOR, Packing, run_pyramid};
pub use power_law::{LoadedSpring, PowerLaw};
pub use published::{ForceSampling, GivenStart, PublishedForces, PublishedRun};
pub use real::{Composite, Real, Work};
pub use scene::Scene;
pub use stack_run::compress_stack_precisely;
pub use stack_run::{compress_stack, compress_stack_with};
pub use wall::PlaneWall;

/// SHA-256 of everything that decides the numbers of this crate, and of the theory below it: sources without comments
/// and layout, the packages that they compute with, and the compiler. It replaces the deck hash of an external code.
pub const SOURCE_DIGEST: &str = env!("SOURCE_DIGEST");
