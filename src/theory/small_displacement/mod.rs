//! The paper's theories: rigid cylinders, and elastic ones whose displacements are small.
//!
//! Here α = ε r/z with the vertical displacement z of the bottom cylinders, and u = 1 − α. The load on
//! the floor is F + 3 = 2 z/(ε r) = 2/α (paper, Eq. 7), so that F ≥ 0 means α ≤ 2/3.

mod elastic;
mod naive;
mod perturbation;
#[cfg(test)]
mod quintic;
mod rigid;

pub use elastic::{ElasticRoot, elastic_root};
pub(crate) use naive::naive_load;
pub(crate) use perturbation::perturbation_load;
#[cfg(test)]
use quintic::quintic_displacement;
pub use rigid::{RigidYield, rigid_yield};

use crate::model::CRITICAL_FRICTION;

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// α at which 𝒟 (paper, Eq. 9) vanishes: α₀ = 1 − μ/μ_c, negative above μ_c.
fn vanishing_alpha(floor_friction: f64) -> f64 {
    (CRITICAL_FRICTION - floor_friction) / CRITICAL_FRICTION
}

/// z⋆ (paper, Eq. 12), the displacement at yield of infinitely stiff cylinders above μ_c, in r.
pub(crate) fn displacement_of_stiff_cylinders(floor_friction: f64, stiffness_ratio: f64) -> f64 {
    let mu = floor_friction;
    let geometry = 1.0 + mu * mu;
    (mu - CRITICAL_FRICTION) * (mu + CRITICAL_FRICTION.recip())
        / (mu * geometry * (1.0 + stiffness_ratio * geometry))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_three_is_its_own_definition() {
        assert_eq!(SQRT_3, 3f64.sqrt());
    }
}
