//! Rigid cylinders (paper, Eq. 4) and spheres.

use crate::model::Stack;
use crate::theory::Limit;

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

/// Returns the wall force F = f/(m g) of a rigid stack that yields, while the body on top has sunk by `travel`, in r; `None`
/// where no force makes it slide. The floor slides with T = tan(ψ/2) in place of μ_c in Eq. 4, and the bodies roll on each
/// other: 2 cos ψ is the height of the one on top over those on the floor.
///
/// ```
/// use tristack_theory::model::Stack;
/// use tristack_theory::theory::{rigid_force, rigid_yield};
/// let stack = Stack::paper(0.2, 1.0);
/// let begins = rigid_force(&stack, 0.0).unwrap();
/// assert!((begins - rigid_yield(&stack).yield_force.unwrap()).abs() < 1e-12);
/// assert!(rigid_force(&stack, 1e-3).unwrap() < begins);
/// ```
pub fn rigid_force(stack: &Stack, travel: f64) -> Option<f64> {
    let (mu, cosine) = (stack.floor_friction, 0.5 * (stack.ring().rise - travel));
    let tangent = ((1.0 - cosine) / (1.0 + cosine)).sqrt();
    (mu < tangent).then(|| (stack.own_weight() * mu - tangent) / (tangent - mu))
}

/// Returns the limit of the yield force of rigid bodies with vanishing wall speed. There is none, with the reason, where they
/// jam, slide under their own weight, or slip on each other: each of the lower bodies is held by two forces beside its weight,
/// through its contact points with the floor and with the body on top, so that the latter needs friction of at least
/// tan(ψ₀/2) = μ_c.
pub fn rigid_limit(stack: &Stack) -> Limit {
    let critical = stack.ring().critical_friction;
    let (mu, own_weight) = (stack.floor_friction, critical / stack.own_weight());
    let force = rigid_force(stack, 0.0).filter(|force| *force > 0.0);
    let (force, reason) = match force {
        _ if stack.cylinder_friction <= critical => (
            None,
            Some(format!(
                "rigid bodies slip on each other under their own weight: that takes friction above {critical:.6} between them"
            )),
        ),
        _ if mu >= critical => (
            None,
            Some(format!(
                "rigid bodies jam from the floor friction {critical:.6} on: no force makes them slide"
            )),
        ),
        None => (
            None,
            Some(format!(
                "rigid bodies slide under their own weight up to the floor friction {own_weight:.6}"
            )),
        ),
        Some(force) => (Some(force), None),
    };
    Limit {
        bodies: stack.bodies,
        yield_force: force,
        slip_onset: force,
        peak_force: force,
        tangent: force.map(|_| critical),
        wall_travel: force.map(|_| 0.0),
        time_scale: 1.0,
        reason,
        ..Limit::default()
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

    #[test]
    fn a_limit_that_is_absent_has_a_reason() {
        let of = |mu, mu_d| {
            let stack = Stack {
                cylinder_friction: mu_d,
                ..Stack::paper(mu, 1.0)
            };
            let limit = rigid_limit(&stack);
            (limit.yield_force, limit.reason.unwrap_or_default())
        };
        let (force, reason) = of(0.2, 0.7);
        let closed = rigid_yield(0.2).yield_force.unwrap();
        assert!((force.unwrap() - closed).abs() < 1e-12);
        assert_eq!(reason, "");
        for (mu, mu_d, word) in [
            (0.3, 0.7, "jam"),
            (0.08, 0.7, "weight up"),
            (0.2, 0.26, "each other"),
        ] {
            let (force, reason) = of(mu, mu_d);
            assert_eq!(force, None);
            assert!(reason.contains(word), "{reason}");
        }
    }

    /// The work of the wall, of gravity and of friction at the floor vanishes with every small step of a sliding stack.
    #[test]
    fn forces_on_the_way_do_no_work_beside_that_of_friction() {
        let stack = Stack::paper(0.2, 1.0);
        for travel in [0.0, 0.01, 0.3] {
            let force = rigid_force(&stack, travel).unwrap();
            let outwards = |travel: f64| {
                let cosine = 0.5 * (stack.ring().rise - travel);
                2.0 * (1.0 - cosine * cosine).sqrt()
            };
            let step = 1e-5;
            let slid = outwards(travel + step) - outwards(travel - step);
            let load = stack.floor_load(force);
            let dissipated = stack.floor_friction * load * slid;
            // Rolling on an equal body that does not turn, they turn by twice the change of ψ, their lower sides outwards.
            let [after, before] = [travel + step, travel - step];
            let change = libm::asin(0.5 * outwards(after)) - libm::asin(0.5 * outwards(before));
            let turned = stack.floor_friction * load * 2.0 * change;
            let work = (force + 1.0) * 2.0 * step;
            assert!(
                (work - dissipated - turned).abs() < 1e-9 * load,
                "{work} {dissipated} {turned}"
            );
        }
    }
}
