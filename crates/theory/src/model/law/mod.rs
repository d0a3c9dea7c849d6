//! The contact law: a normal force that grows with a power of the overlap, a tangential spring, and a dashpot beside
//! each.
//!
//! For an overlap δ that shrinks at the speed v_n, between surfaces that move at v_t,
//!
//! N = K δᵖ − η_n v_n,  T = −k_t u − η_t v_t (or dT = −k_t v_t dt and damping), u̇ = v_t,
//! k_n = p K δᵖ⁻¹,  k_t = k_n/κ,
//!
//! with K = 1 for a pair and the [floor ratio](Law::floor_ratio) for walls. The paper's law has p = 1 (its "Numerical
//! results", Eqs. S1 and S2), Hertz's p = 3/2. By default the damping ratio is the same at every overlap,
//!
//! η = −2 ln e_r √((p+1)/(2p)) √(m k/(π² + ln² e_r))
//!
//! for either stiffness k, which gives a free collision the restitution e_r at any speed (docs/theory.md, section
//! 11.1). Viscoelastic damping has this value at an overlap of r, and grows like the stiffness.

mod chosen;
mod contact_law;
mod damping;
mod power;
mod tangential;
mod written;

pub use chosen::Law;
pub use contact_law::{ContactCoefficients, ContactLaw};
pub use damping::DampingGrowth;
pub use power::Power;
pub use tangential::{TangentialHistory, TangentialStiffening};
