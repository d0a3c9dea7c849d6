//! Rigid cylinders (paper, Eq. 4) and spheres.

use crate::model::Stack;

/// Yield force of rigid bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidYield {
    /// f₀/(m g); absent where it diverges, since no force makes the stack slide.
    pub yield_force: Option<f64>,
    /// Whether the yield force is infinite, μ ≥ μ_c.
    pub diverges: bool,
}

/// Returns f₀(μ)/(m g) = (3μ − μ_c)/(μ_c − μ) between μ_c/3 and μ_c; it is 0 below and infinite above (paper, Eq. 4).
/// For n bodies on the floor, n + 1 replaces 3 (docs/theory.md, Eq. 102).
///
/// ```
/// use tristack_theory::model::Stack;
/// use tristack_theory::theory::rigid_yield;
/// let at = |mu| rigid_yield(&Stack::paper(mu, 1e4));
/// assert!((at(0.2).yield_force.unwrap() - 4.886_751_3).abs() < 1e-7);
/// assert!(at(0.3).diverges);
/// ```
pub fn rigid_yield(stack: &Stack) -> RigidYield {
    let (mu, critical) = (stack.floor_friction, stack.ring().critical_friction);
    if mu >= critical {
        return RigidYield {
            yield_force: None,
            diverges: true,
        };
    }
    let force = (stack.own_weight() * mu - critical) / (critical - mu);
    RigidYield {
        yield_force: Some(force.max(0.0)),
        diverges: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::CRITICAL_FRICTION;

    fn rigid_yield(mu: f64) -> RigidYield {
        super::rigid_yield(&Stack::paper(mu, 1e4))
    }

    #[test]
    fn yield_force_begins_at_a_third_of_the_critical_friction_and_diverges_there() {
        assert_eq!(rigid_yield(0.08).yield_force, Some(0.0));
        assert!(rigid_yield(0.09).yield_force.unwrap() > 0.0);
        assert!(!rigid_yield(CRITICAL_FRICTION * (1.0 - 1e-15)).diverges);
        let critical = rigid_yield(CRITICAL_FRICTION);
        assert_eq!((critical.yield_force, critical.diverges), (None, true));
    }
}
