//! Regimes: the first event on the path, its effect on the stack, and the boundaries between stacks that differ
//! in it.
//!
//! Derived in docs/theory.md, section 7, independently of the equations here: (R2) is its Eq. (44), (R3) Eq. (45),
//! (R4) Eq. (46), (R5) Eq. (54), (R6) Eq. (55); (R1) Eqs. (13) and (48).
//!
//! Everything here is for arms 0, with contact forces in k_n r and lengths in r. On the path of equilibria b = e, by
//! the torques on cylinder 2. With a contact force c ≥ 0 between the bottom cylinders and T = tan(ψ/2), the horizontal
//! and vertical balance give
//!
//! b = e = a T + c/(1 + cos ψ),  L = 2 a + 2 c T,  d = L/2 + ε under the wall, 3 L/2 along the gravity ramp.  (R1)
//!
//! The path itself does not depend on μ and μ_d: κ determines it, and also ε where c > 0. It ends where it needs more
//! friction than there is. Hence every boundary in μ is a value of e/d on one path, and every boundary in μ_d a value
//! of b/a, at the event on the other side of the boundary.
//!
//! **Floor slip**, e = μ d. With c = 0, (R1) becomes T (F + 1) = μ (F + 3), so that
//!
//! F = (3 μ − T)/(T − μ),  dF/dT = −2 μ/(T − μ)² < 0:  (R2)
//!
//! once the floor slides, any further spreading lowers the force. F at the onset is therefore the largest force, which
//! is the paper's yield force.
//!
//! **Cylinder slip**, b = μ_d a. With c = 0 it pins T = μ_d: at fixed ψ the springs have
//! d u_floor = dx₂ + r dθ with dx₂ = −sin ψ dG and κ^-1 d u_floor = de = μ_d dG, so that
//!
//! dθ = (κ μ_d + sin ψ) dG,  while the sliding surfaces move by ρ dψ − r dθ = −dθ.  (R3)
//!
//! The spring of the contact is stretched in the positive direction (b > 0), and a contact slides only
//! the way it is stretched: −dθ > 0, hence dG < 0. Under rising load the contact would have to slide
//! backwards; if it stuck instead, T would grow beyond μ_d and with it b/a. Neither is possible, no
//! equilibrium follows, and
//!
//! F_sat = 2 G(μ_d)/ε − 1  (R4)
//!
//! is the largest force whatever μ is: the yield force saturates. The same argument with d T = 0 along the gravity
//! ramp shows that no equilibrium remains for a stack that begins to slide under its own weight.
//!
//! **Contact 2–3 closes**, y < 0. It carries c = −2 y k_n and nothing tangential, by mirror symmetry; five
//! contacts then share the load that four shared before. The path goes on by (R1) with c > 0 until one of
//! the other events ends it, and the contact may open again. From the stress-free state, to first order
//! in G, y = G (2 κ μ_c − 1/√3)/(1 + 2/√3): it closes at once where
//!
//! κ < κ_c = 1/(2√3 μ_c) = (2 + √3)/(2√3) = 1.07735.  (R5)
//!
//! **Slip while c > 0** does not end the path. Sliding outwards relieves the fifth contact, which was indeterminate:
//! with e = b = μ d (or μ_d a) the balance gives c = b (1 + cos ψ) − a sin ψ, which falls as T grows, and the stack
//! carries more load until c = 0. There contact 2–3 opens, y = 0 and G = G₀(T) = 2 − (1 + T²)/(2T), and (R2) or (R4)
//! apply. The largest force is therefore reached at the first of
//! G₀(T) (T − μ) = ε μ,  T = μ_d,  F = 2 G₀(T)/ε − 1,  (R6)
//!
//! whatever κ is, as long as c > 0 where the first contact slips. Likewise the stack only falls under its own
//! weight if F < 0 by (R6).
//!
//! **Wall contact**, ρ cos ψ = f/k_n. The wall then rests on cylinders 2 and 3 as well. Each is a column between two
//! planes, which the advancing wall squeezes at a finite stiffness whatever cylinder 1 does. The floor gains normal
//! force without gaining shear, so the force grows without a peak and there is no yield force.
//!
//! **Under its own weight** the stack fails where the ramp already needs more than friction gives: e/d = T/3
//! and b/a = T, never less than μ_c, with c = 0.

mod boundary;
mod critical_state;
mod equilibrium_path;
mod map;
mod outcome;
mod release;

pub use boundary::Boundary;
pub use critical_state::{CriticalState, LoadingPhase};
pub use equilibrium_path::EquilibriumPath;
pub use map::{Across, Axis, BoundaryPoint, Line, RegimeMap};
pub use outcome::{FailureMode, LoadingOutcome, Regime};
pub use release::released_frictions;

/// κ_c, below which contact 2–3 closes at once, Eq. (R5).
pub const CLOSING_STIFFNESS_RATIO: f64 = 1.077_350_269_189_625_8;
