//! The contact convention of a code, measured by micro-tests of one contact each.
//!
//! The declaration of the code serves for comparison alone. Mass, inertia and the times of velocities follow from free
//! motion; stiffness, damping and arms from linear regression of the reported forces on the reported motion. If the law
//! is right, only rounding remains.

mod clock;
mod contact_frame;
mod experiments;
mod finding;
mod measured;
mod micro_tests;
mod normal;
mod plan;
mod probe;
mod properties;
mod regression;
mod sliding;
mod tangential;

pub(crate) use finding::Finding;
pub(crate) use finding::Property;
pub use finding::TOLERANCE;
pub use measured::probe_all;
pub(crate) use measured::{
    Probed, arms_are_measured, contradictions, is_contradicted, other_program, probe_records,
};
pub(crate) use micro_tests::ask;
pub use probe::probe;
