//! Uncertainty of the limit where the arms are uncertain.

use super::{Limit, quasistatic_limit};
use crate::model::{ARM_RANGE, Arms, Problem};

/// Smallest step of an arm for a slope of the limit. The limit is guaranteed to 1e-7 of F + 3, which gives the slope
/// an error of 1e-4 F; the error from curvature is no larger.
const STEP: f64 = 1e-3;

/// Returns the uncertainty of the limit of `problem`, in m g, when its arms are known to within `uncertainty`: the sum
/// over the arms of uncertainty times slope, where the slope is that of onset or peak, whichever is steeper. `None` if
/// the stack does not yield there.
pub fn limit_uncertainty(problem: &Problem, uncertainty: &Arms) -> Option<f64> {
    let each: [fn(&mut Arms) -> &mut f64; 4] = [
        |arms| &mut arms.pair.torque,
        |arms| &mut arms.pair.kinematic,
        |arms| &mut arms.floor.torque,
        |arms| &mut arms.floor.kinematic,
    ];
    let mut uncertainty = *uncertainty;
    let parts = each.into_iter().map(|arm| {
        let uncertainty = *arm(&mut uncertainty);
        match uncertainty > 0.0 {
            true => Some(uncertainty * steepest(problem, arm, uncertainty.max(STEP))?),
            false => Some(0.0),
        }
    });
    parts.sum()
}

/// Returns the steeper of the slopes of onset and peak in one `arm`, over a `step` to both sides.
fn steepest(problem: &Problem, arm: fn(&mut Arms) -> &mut f64, step: f64) -> Option<f64> {
    let moved = |by: f64| {
        let mut moved = *problem.convention();
        let own = arm(&mut moved.arms);
        let [least, most] = ARM_RANGE;
        *own = (*own + by).clamp(least, most);
        let place = *own;
        let moved = Problem::checked(*problem.stack(), moved);
        (place, quasistatic_limit(&moved))
    };
    let ((low, below), (high, above)) = (moved(-step), moved(step));
    let slope = |force: fn(&Limit) -> Option<f64>| {
        Some(((force(&above)? - force(&below)?) / (high - low)).abs())
    };
    let peak = slope(|limit| limit.yield_force)?;
    let onset = slope(|limit| limit.slip_onset);
    Some(onset.map_or(peak, |onset| onset.max(peak)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ContactConvention, Stack};

    #[test]
    fn small_uncertainties_move_the_limit_as_they_say() {
        let stack = Stack::paper(0.3, 1e2);
        let convention = ContactConvention::with_arms(Arms::reciprocal(-0.5, -0.5));
        let force = |pair: f64, floor: f64| {
            let mut moved = convention;
            moved.arms.pair.torque += pair;
            moved.arms.floor.kinematic += floor;
            let problem = Problem::new(stack, moved).unwrap();
            quasistatic_limit(&problem).yield_force.unwrap()
        };
        let problem = Problem::new(stack, convention).unwrap();
        let mut uncertainty = Arms::PAPER;
        assert_eq!(limit_uncertainty(&problem, &uncertainty), Some(0.0));
        uncertainty.pair.torque = 1e-5;
        uncertainty.floor.kinematic = 1e-5;
        let found = limit_uncertainty(&problem, &uncertainty).unwrap();
        let alone = [force(1e-5, 0.0), force(0.0, 1e-5)];
        let expected: f64 = alone.iter().map(|own| (own - force(0.0, 0.0)).abs()).sum();
        assert!((found / expected - 1.0).abs() < 1e-2, "{found} {expected}");
    }

    #[test]
    fn an_arm_at_the_end_of_its_range_has_a_slope_to_one_side_and_what_does_not_yield_has_none() {
        let convention = ContactConvention::with_arms(Arms::reciprocal(-0.5, -1.0));
        let uncertainty = Arms::reciprocal(0.0, 1e-6);
        let bound = |friction: f64| {
            let problem = Problem::new(Stack::paper(friction, 1e2), convention);
            limit_uncertainty(&problem.unwrap(), &uncertainty)
        };
        assert!(bound(0.3).is_some_and(|open| (1e-7..1e-4).contains(&open)));
        assert_eq!(bound(0.05), None);
    }
}
