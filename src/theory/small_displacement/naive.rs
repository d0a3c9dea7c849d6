//! The naive expansion of the displacement itself in powers of ε (paper, Eq. 13).

use super::displacement_of_stiff_cylinders;
use crate::model::{CRITICAL_FRICTION, Stack};

/// F + 3 = 2 z/(ε r) to leading order in ε: μ_c/(μ_c − μ) ε below μ_c, its square root at μ_c, z⋆ above
/// (paper, Eq. 13). `None` where it contradicts F ≥ 0.
pub(crate) fn naive_load(stack: &Stack) -> Option<f64> {
    let mu = stack.floor_friction;
    let epsilon = stack.epsilon();
    let kappa = stack.stiffness_ratio;
    let displacement = if mu < CRITICAL_FRICTION {
        CRITICAL_FRICTION * epsilon / (CRITICAL_FRICTION - mu)
    } else if mu == CRITICAL_FRICTION {
        (epsilon / (CRITICAL_FRICTION * (1.0 + 4.0 * kappa * CRITICAL_FRICTION))).sqrt()
    } else {
        displacement_of_stiff_cylinders(mu, kappa)
    };
    let load = 2.0 * displacement / epsilon;
    (load >= 3.0).then_some(load)
}
