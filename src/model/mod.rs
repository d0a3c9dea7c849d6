//! The problem: three cylinders, the convention of their contacts and the protocol that loads them.
//!
//! Units throughout: cylinder radius r = 1, cylinder mass m = 1, normal stiffness k_n = 1. Lengths are
//! therefore in r, forces in k_n r, times in √(m/k_n), speeds in r √(k_n/m). Where the normal force of a pair is
//! K δᵖ, K rᵖ⁻¹ takes the place of k_n. The yield force alone is given in m g, as in the paper (arXiv:2511.06807).

mod arms;
mod arrangement;
mod case;
mod case_file;
mod contact_test;
mod convention;
mod digest;
mod impact;
mod law;
mod material;
mod protocol;
mod pyramid;
mod ring;
mod shortcuts;
mod shown;
mod side_walls;
mod stack;
mod validity;
mod written_stack;

pub(crate) use arms::ARM_RANGE;
pub use arms::{Arms, ContactArms};
pub use arrangement::{Arrangement, MOST_BODIES, Place};
pub use case::{Case, CaseError};
pub use case_file::{PartialCase, PartialProtocol};
pub use contact_test::{ContactTest, Drive, InitialMotion, MotionInSpace};
pub(crate) use convention::CYLINDER_INERTIA;
pub use convention::{
    ContactConvention, CoulombOperand, HistoryUpdate, PAPER_RESTITUTION, SlidingSpring,
    TensileForce,
};
pub use digest::sha256_hex;
pub use impact::{Impact, ImpactTarget};
pub use law::{
    ContactCoefficients, ContactLaw, DampingGrowth, Law, Power, TangentialHistory,
    TangentialStiffening,
};
pub use material::Material;
pub(crate) use protocol::smooth_step;
pub use protocol::{Preparation, PreparationSteps, Protocol, Sampling, Schedule};
pub use pyramid::Pyramid;
pub use ring::Ring;
pub use shortcuts::Shortcuts;
pub use shown::shown;
pub(crate) use shown::{readable, readable_lines, shell_quoted};
pub use side_walls::{SideWallSteps, SideWalls};
pub use stack::{CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO, Stack};
pub(crate) use stack::{PAPER_BODIES, PAPER_CYLINDER_FRICTION};
pub use validity::InvalidValue;
pub(crate) use validity::exact;
pub use written_stack::WrittenStack;
