//! The paper's theories: rigid cylinders, and elastic ones with small displacements.
//!
//! Here α = ε r/z, where z is the vertical displacement of the bottom cylinders, and u = 1 − α. The load on the floor
//! is F + 3 = 2 z/(ε r) = 2/α (paper, Eq. 7), so F ≥ 0 means α ≤ 2/3. With n spheres below, it is F + n + 1 = n/α, √3
//! becomes cot ψ₀, and 𝒟 is multiplied by x₀ (docs/theory.md, Eq. 103).

mod elastic;
mod naive;
mod perturbation;
mod quintic;
mod rigid;

pub use elastic::{ElasticRoot, elastic_root};
pub(crate) use naive::naive_load;
pub(crate) use perturbation::perturbation_load;
#[cfg(test)]
use quintic::quintic_displacement;
pub use rigid::{RigidYield, rigid_force, rigid_limit, rigid_yield};

use crate::model::{Ring, Stack};

/// α at which 𝒟 (paper, Eq. 9) vanishes: α₀ = 1 − μ/μ_c, negative above μ_c.
fn vanishing_alpha(ring: &Ring, floor_friction: f64) -> f64 {
    (ring.critical_friction - floor_friction) / ring.critical_friction
}

/// z⋆ (paper, Eq. 12), the displacement at yield of infinitely stiff cylinders above μ_c, in r.
fn displacement_of_stiff_cylinders(stack: &Stack) -> f64 {
    let (ring, mu) = (stack.ring(), stack.floor_friction);
    let geometry = 1.0 + mu * mu;
    ring.radius * (mu - ring.critical_friction) * (mu + ring.critical_friction.recip())
        / (mu * geometry * (1.0 + stack.stiffness_ratio * geometry))
}
