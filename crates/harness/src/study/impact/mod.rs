//! Impacts: the exact parts of the field's standard tests (Chung and Ooi 2011), which every code carries out as
//! motions of two cylinders.
//!
//! A cylinder strikes another one, or the floor, head-on or while its surface slides. Greatest overlap, duration,
//! restitution, and the changes of velocity and spin by friction are read at four time steps, extrapolated to
//! vanishing time step, and compared with their exact values. Spheres and cylinders differ here in the moment of
//! inertia alone.

mod extrapolate;
mod plan;
mod study;

pub use extrapolate::DIVISIONS;
pub use plan::{ImpactQuantity, ImpactStudy, NEARLY_ELASTIC, Reference, plan_impacts};
pub use study::{ImpactBudget, ImpactFinding, ImpactJudgement};
