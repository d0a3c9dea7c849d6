//! The quasi-static limit after the paper's preparation between side walls (its supplement, I.B), to leading order in
//! the effect of the walls.
//!
//! The push A rolls the bottom cylinders to x₂ = 1 − A/3 before the top one lies on them. From there the springs
//! of both tangential contacts accumulate as they do from just touching (docs/theory.md, Eqs. 68 and 69):
//!
//! 2 κ b = (x₂ − x₂⁰) + ∫ρ dψ,  x₂⁰ = 1 − A/3 = 2 sin ψ₀.
//!
//! Wherever neither the walls nor contact 2–3 carry a force, b = G T, and differentiation gives the same equation for
//! G(T) as after a gravity ramp, with another start: G(T₀) = 0, T₀ = tan(ψ₀/2) < μ_c. The path also passes through
//! states held by walls or by contact 2–3. This detour changes ∫ρ dψ by the area between the two paths in the plane of
//! ρ and ψ, which is of order ε²: as much as a change of A by some 0.03 ε².

use super::floor_slip::FloorSlip;
use super::overlap::OverlapCurve;
use super::path::{limit_on, path_from};
use crate::model::{CRITICAL_FRICTION, ContactConvention, HistoryUpdate, Ring, Stack};

/// Returns A*, in r, to leading order in ε: the largest push after which the bottom cylinders of the plane stack end
/// without contact, if nothing slides during the preparation (docs/theory.md, Eq. 70).
///
/// After the push A* they end just touching, at x₂ = 1, with a = G = ε/2 and b = a T. To leading order T = μ_c and b =
/// ε μ_c/2. Since ψ₀, ψ has changed by A/(3√3) up to 30°, where the cylinders just touch, and by ε/(4√3) from there (2
/// sin ψ = 1 + ε/4):
///
/// ```text
/// κ μ_c ε = A/3 + 2 (ε/(4√3) + A/(3√3))    =>    A* = 3 ε (κ μ_c − 1/(2√3))/(1 + 2/√3)
/// ```
///
/// A* is 0 at κ = 1.07735; for a smaller κ, contact 2–3 closes under any load (docs/theory.md, section 7.3).
///
/// ```
/// use tristack_theory::model::Stack;
/// let push = tristack_theory::theory::critical_push(&Stack::paper(0.2, 1e4));
/// assert!((push - 0.53074e-4).abs() < 1e-9);
/// ```
pub fn critical_push(stack: &Stack) -> f64 {
    let root = 3f64.sqrt();
    let spread = stack.stiffness_ratio * CRITICAL_FRICTION - 0.5 / root;
    3.0 * stack.epsilon() * spread / (1.0 + 2.0 / root)
}

/// Returns F, in m g, at which the floor slips after the walls have pushed in by `push`, with arms 0 and springs that
/// follow the rule `history_update`. `None` if the floor does not slip, and for spheres. The result holds if nothing
/// slides before and contact 2–3 has opened by then; other events are ignored.
///
/// ```
/// use tristack_theory::model::{HistoryUpdate, Stack};
/// use tristack_theory::theory::{closed_form_limit, pushed_slip_force};
/// let stack = Stack::paper(0.2, 100.0);
/// let force = |push| pushed_slip_force(&stack, push, HistoryUpdate::Rotated).unwrap();
/// let [unpushed, pushed] = [0.0, 0.005].map(force);
/// assert!((unpushed - closed_form_limit(&stack).yield_force.unwrap()).abs() < 1e-12);
/// assert!((pushed - unpushed - 0.0345).abs() < 1e-4);
/// ```
pub fn pushed_slip_force(stack: &Stack, push: f64, history_update: HistoryUpdate) -> Option<f64> {
    stack.refuse_spheres().ok()?;
    if !history_update.turns() {
        let convention = ContactConvention {
            history_update,
            ..ContactConvention::TURNING
        };
        let path = path_from(Ring::pushed(push), stack, &convention);
        return limit_on(&path, stack, &convention).floor_slip_force;
    }
    let sine = 0.5 * (1.0 - push / 3.0);
    let curve = OverlapCurve {
        start: sine / (1.0 + (1.0 - sine * sine).sqrt()),
        stiffness_ratio: stack.stiffness_ratio,
    };
    let slip = FloorSlip::on(&curve, stack);
    slip.map(|slip| slip.force)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Problem;
    use crate::theory::{CLOSING_STIFFNESS_RATIO, closed_form_limit, quasistatic_limit};

    #[test]
    fn without_a_push_it_is_the_closed_form() {
        for friction in [0.12, 0.2, 0.3, 0.5] {
            for stiffness in [1e2, 1e4] {
                let stack = Stack::paper(friction, stiffness);
                let exact = closed_form_limit(&stack).yield_force.unwrap();
                let force = pushed_slip_force(&stack, 0.0, HistoryUpdate::Rotated).unwrap();
                assert!((force / exact - 1.0).abs() < 1e-11, "{force} {exact}");
                let problem = Problem::new(stack, ContactConvention::PAPER).unwrap();
                let fixed = quasistatic_limit(&problem).floor_slip_force;
                let force = pushed_slip_force(&stack, 0.0, HistoryUpdate::Fixed);
                assert_eq!(force, fixed, "the same path");
            }
        }
    }

    /// A push amounts to another angle at which springs are free of force. The effect on springs that do not turn
    /// differs from that on turning ones by the square of the displacements.
    #[test]
    fn a_push_does_nearly_the_same_to_springs_that_nothing_turns() {
        let difference = |stiffness: f64| {
            let stack = Stack::paper(0.2, stiffness);
            let shift = |rule| {
                let force = |push| pushed_slip_force(&stack, push, rule).unwrap();
                force(0.5 * stack.epsilon()) - force(0.0)
            };
            let [fixed, turned] = [HistoryUpdate::Fixed, HistoryUpdate::Rotated].map(shift);
            (fixed - turned).abs() / turned
        };
        let [soft, stiff] = [1e2, 1e3].map(difference);
        assert!(soft < 1e-2 && stiff < 0.2 * soft, "{soft} {stiff}");
    }

    #[test]
    fn no_push_is_needed_for_contact_where_it_closes_by_itself() {
        let stack = Stack {
            stiffness_ratio: CLOSING_STIFFNESS_RATIO,
            ..Stack::paper(0.2, 1e2)
        };
        assert!(critical_push(&stack).abs() < 1e-15);
    }

    #[test]
    fn critical_push_solves_the_balance_it_comes_from() {
        // κ μ_c ε = A/3 + 2 (ε/(4√3) + A/(3√3)), docs/theory.md, Eq. 70.
        let root = 3f64.sqrt();
        for (stiffness, kappa) in [(1e2, 2.5), (1e4, 2.5), (1e3, 10.0)] {
            let stack = Stack {
                stiffness_ratio: kappa,
                ..Stack::paper(0.2, stiffness)
            };
            let (push, epsilon) = (critical_push(&stack), stack.epsilon());
            let turned = epsilon / (4.0 * root) + push / (3.0 * root);
            let spread = push / 3.0 + 2.0 * turned;
            assert!((spread / (kappa * CRITICAL_FRICTION * epsilon) - 1.0).abs() < 1e-14);
        }
    }

    /// F where the floor slips, by the Runge–Kutta method from G(T₀) = 0 and bisection; the error is of fourth order
    /// in steps of 10⁻⁴.
    fn summed_force(stack: &Stack, start: f64) -> f64 {
        let (kappa, epsilon, mu) = (stack.stiffness_ratio, stack.epsilon(), stack.floor_friction);
        let slope = |t: f64, g: f64| {
            let square = 1.0 + t * t;
            (4.0 / square - g * (2.0 / square + kappa * square)) / (t * (1.0 + kappa * square))
        };
        let (mut t, mut g, mut width) = (start, 0.0, 1e-4);
        while width > 1e-15 {
            let first = slope(t, g);
            let second = slope(t + 0.5 * width, g + 0.5 * width * first);
            let third = slope(t + 0.5 * width, g + 0.5 * width * second);
            let fourth = slope(t + width, g + width * third);
            let next = g + width * (first + 2.0 * second + 2.0 * third + fourth) / 6.0;
            if next * (t + width - mu) < epsilon * mu {
                (t, g) = (t + width, next);
            } else {
                width *= 0.5;
            }
        }
        2.0 * g / epsilon - 1.0
    }

    #[test]
    fn a_push_moves_the_angle_at_which_the_springs_are_free_of_force() {
        for push in [0.0f64, 0.005, 0.05] {
            let stack = Stack::paper(0.2, 1e2);
            let start = (0.5 * (0.5 * (1.0 - push / 3.0)).asin()).tan();
            let force = pushed_slip_force(&stack, push, HistoryUpdate::Rotated).unwrap();
            let summed = summed_force(&stack, start);
            assert!((force / summed - 1.0).abs() < 1e-10, "{force} {summed}");
        }
    }
}
