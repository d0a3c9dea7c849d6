//! Where the floor slips on the path with arms 0, ignoring all other events on the way.
//!
//! The floor slips where G (T − μ) = ε μ, and then F = n μ/(T − μ) − 1 (docs/theory.md, Eqs. 23 and 101). G(T) and its
//! slope are known at every T, so each step of the search takes G to be linear and solves a quadratic equation, the
//! one that joins the three regimes of stiff cylinders (Eqs. 28 and 72).

use super::overlap::{HIGHEST_TANGENT, OverlapCurve};
use crate::model::Stack;

/// Length of the last step relative to the whole way. The error after a step is at most 1.5 times the square of its
/// relative length (docs/theory.md, Eq. 72): 1.5 × 10⁻¹⁴.
const LAST_STEP: f64 = 1e-7;
/// At most seven steps were needed over everything that the command line accepts.
const MOST_STEPS: usize = 50;

/// Where the floor slips.
pub(super) struct FloorSlip {
    /// T beyond the start of the curve.
    pub(super) beyond: f64,
    /// F = f/(m g); negative where the stack slides under its own weight.
    pub(super) force: f64,
}

impl FloorSlip {
    /// Locates the slip of `stack` on `curve`; `None` if the floor has not slipped before T = 1.
    ///
    /// G is concave, hence below its tangents, so the search approaches the root from below without ever passing it,
    /// from any start. It starts at the larger of μ and the start of the curve, and measures from there, so that T − μ
    /// keeps its digits.
    pub(super) fn on(curve: &OverlapCurve, stack: &Stack) -> Option<Self> {
        let (floor_friction, epsilon) = (stack.floor_friction, stack.epsilon());
        let bodies = f64::from(stack.bodies);
        let lowest = floor_friction.max(curve.start);
        let reachable = 0.0..=HIGHEST_TANGENT - lowest;
        let mut offset = 0.0;
        for _ in 0..MOST_STEPS {
            let beyond = lowest - curve.start + offset;
            let clearance = lowest - floor_friction + offset;
            let overlap = curve.overlap(beyond);
            let slope = curve.slope(beyond, overlap);
            let step = step_to_slip(overlap, slope, clearance, epsilon * floor_friction);
            offset += step;
            if !reachable.contains(&offset) {
                return None;
            }
            if step.abs() <= LAST_STEP * offset {
                return Some(Self {
                    beyond: beyond + step,
                    force: bodies * floor_friction / (clearance + step) - 1.0,
                });
            }
        }
        None
    }
}

/// Returns δ with (G + G′ δ)(t + δ) = ε μ, where t = T − μ is the `clearance` (docs/theory.md, Eq. 72); NaN if there
/// is none.
fn step_to_slip(overlap: f64, slope: f64, clearance: f64, target: f64) -> f64 {
    let shortfall = target - overlap * clearance;
    let growth = overlap + slope * clearance;
    let discriminant = growth * growth + 4.0 * slope * shortfall;
    2.0 * shortfall / (growth + discriminant.sqrt())
}

/// Returns F = f/(m g) at which the floor slips, by the closed form with arms 0, to 10⁻¹² of F + n + 1
/// (docs/theory.md, section 5.4). It is the yield force of [`closed_form_limit`](super::closed_form_limit) unless
/// another event comes first, which is not checked here. `None` if the stack slides under its own weight, or if the
/// floor has not slipped before T = 1.
///
/// ```
/// use tristack_theory::model::Stack;
/// let force = tristack_theory::theory::floor_slip_force(&Stack::paper(0.3, 1e4)).unwrap();
/// assert!((force - 2124.669_922_2).abs() < 1e-7);
/// ```
pub fn floor_slip_force(stack: &Stack) -> Option<f64> {
    let slip = FloorSlip::on(&OverlapCurve::from_just_touching(stack), stack)?;
    Some(slip.force).filter(|&force| force >= 0.0)
}

/// The curve F(μ) of stacks that share 1/ε and κ: [`floor_slip_force`] at every one of `floor_frictions`.
pub fn floor_slip_forces(
    floor_frictions: &[f64],
    stiffness: f64,
    stiffness_ratio: f64,
) -> Vec<Option<f64>> {
    let at = |&floor_friction| {
        floor_slip_force(&Stack {
            stiffness_ratio,
            ..Stack::paper(floor_friction, stiffness)
        })
    };
    floor_frictions.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::CRITICAL_FRICTION;

    #[test]
    fn square_root_law_holds_at_the_critical_friction() {
        // docs/theory.md, Eq. 26, up to O(1).
        let stack = Stack::paper(CRITICAL_FRICTION, 1e8);
        let law = 2.0 / (1e-8 * CRITICAL_FRICTION * (1.0 + 10.0 * CRITICAL_FRICTION)).sqrt();
        let force = floor_slip_force(&stack).unwrap();
        assert!((force - law).abs() < 3.0, "{force} {law}");
    }

    #[test]
    fn there_is_no_force_where_the_floor_does_not_slip_under_the_wall() {
        // Slides under its own weight; so soft that it never slips; rougher than T can become; not a friction.
        let stacks = [(0.08, 1e4), (0.8, 1.0), (1.0, 1e4), (-0.1, 1e4), (0.0, 1e4)];
        for (friction, stiffness) in stacks.into_iter().chain([(f64::NAN, 1e4)]) {
            let force = floor_slip_force(&Stack::paper(friction, stiffness));
            assert_eq!(force, None, "{friction} {stiffness}");
        }
    }

    #[test]
    fn a_curve_is_its_points() {
        let frictions = [0.05, 0.2, CRITICAL_FRICTION, 0.5];
        let curve = floor_slip_forces(&frictions, 1e3, 5.0);
        assert_eq!(curve.len(), frictions.len());
        for (friction, force) in frictions.into_iter().zip(curve) {
            let stack = Stack {
                stiffness_ratio: 5.0,
                ..Stack::paper(friction, 1e3)
            };
            assert_eq!(force, floor_slip_force(&stack));
        }
    }
}
