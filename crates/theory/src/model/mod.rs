//! The problem: three cylinders, or a ring of spheres with one on top, and the convention of their contacts.
//!
//! Units throughout: cylinder radius r = 1, cylinder mass m = 1, normal stiffness k_n = 1. Lengths are
//! therefore in r, forces in k_n r, times in √(m/k_n), speeds in r √(k_n/m). Where the normal force of a pair is
//! K δᵖ, K rᵖ⁻¹ takes the place of k_n. The yield force alone is given in m g, as in the paper (arXiv:2511.06807).

mod arms;
mod arrangement;
mod contact_test;
mod convention;
mod impact;
mod law;
mod material;
mod problem;
mod ring;
mod stack;
mod validity;

pub use arms::{ARM_RANGE, Arms, ContactArms};
pub use arrangement::{Arrangement, MOST_BODIES, Place};
pub use contact_test::{ContactTest, Drive, InitialMotion, MotionInSpace};
pub use convention::{
    CYLINDER_INERTIA, ContactConvention, CoulombOperand, HistoryUpdate, PAPER_RESTITUTION,
    SlidingSpring, TensileForce,
};
pub use impact::{Impact, ImpactTarget};
pub use law::{
    ContactCoefficients, ContactLaw, DampingGrowth, Law, Power, TangentialHistory,
    TangentialStiffening,
};
pub use material::Material;
pub use problem::Problem;
pub use ring::Ring;
pub use stack::{
    BODIES_RANGE, CRITICAL_FRICTION, PAPER_BODIES, PAPER_CYLINDER_FRICTION, PAPER_STIFFNESS_RATIO,
    Stack,
};
pub use validity::{InvalidValue, exact, positive, within};
