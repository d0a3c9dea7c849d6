//! The naive expansion: the displacement itself in powers of ε (paper, Eq. 13).

use super::displacement_of_stiff_cylinders;
use crate::model::Stack;

/// Returns F + n + 1 = n z/(ε r) to leading order in ε, where z is ε μ_c/(μ_c − μ) below μ_c, of order √ε at μ_c, and
/// z⋆ above (paper, Eq. 13). `None` where this contradicts F ≥ 0.
pub(crate) fn naive_load(stack: &Stack) -> Option<f64> {
    let (ring, mu) = (stack.ring(), stack.floor_friction);
    let critical = ring.critical_friction;
    let epsilon = stack.epsilon();
    let kappa = stack.stiffness_ratio;
    let displacement = if mu < critical {
        critical * epsilon / (critical - mu)
    } else if mu == critical {
        let square = 4.0 * critical / ring.radius;
        (ring.radius * epsilon / (critical * (1.0 + kappa * square))).sqrt()
    } else {
        displacement_of_stiff_cylinders(stack)
    };
    let load = ring.bodies * displacement / epsilon;
    (load >= stack.own_weight()).then_some(load)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::theory::small_displacement::elastic_root;

    #[test]
    fn at_the_critical_friction_it_is_the_root_of_stiff_bodies_in_any_ring() {
        for bodies in [2, 3, 5] {
            let stack = Stack {
                bodies,
                ..Stack::paper(0.3, 1e12)
            };
            let stack = Stack {
                floor_friction: stack.ring().critical_friction,
                ..stack
            };
            let ratio = naive_load(&stack).unwrap() / elastic_root(&stack).unwrap().load;
            assert!((ratio - 1.0).abs() < 1e-5, "{bodies}: {ratio}");
        }
    }
}
