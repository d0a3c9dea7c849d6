//! Impacts: the standard tests of the field in their exact parts (Chung and Ooi 2011), carried out as motions of two
//! cylinders by every code.
//!
//! A cylinder strikes another one, or the floor, head-on or while its surface slides. Greatest overlap, duration,
//! restitution, and what friction does to velocity and spin are read at four time steps, extrapolated to none, and compared
//! with their exact values. Spheres and cylinders differ here by the moment of inertia alone.

mod extrapolate;
mod plan;
mod study;

pub use extrapolate::DIVISIONS;
pub use plan::{ImpactQuantity, ImpactStudy, NEARLY_ELASTIC, Reference, plan_impacts};
pub use study::{ImpactBudget, ImpactFinding, ImpactJudgement};
