//! The states in which the floor slides while contact 2–3 is closed, for any arms and power of the normal force.
//!
//! With e = μ d in place of the floor spring, equilibrium alone fixes the overlap G and the floor load d at each
//! T = tan(ψ/2): the states remember neither springs nor preparation, and the torque arms are all that they see
//! of a convention beside the normal force (docs/theory.md, Eqs. 74 to 76 and 87 to 89). The load grows along them until the contact opens, or to a
//! maximum shortly before.

use super::events::{Event, PathPoint};
use super::overlap::HIGHEST_TANGENT;
use super::root::{bracketed_root, maximum_between};
use crate::model::{Arms, CRITICAL_FRICTION, ContactConvention, ContactLaw, Stack};
use nalgebra::{Matrix2, Vector2};

const WIDEST: f64 = HIGHEST_TANGENT - CRITICAL_FRICTION;
/// The centres of cylinders 1 and 2 coincide.
const LARGEST_OVERLAP: f64 = 2.0;
/// From the solution with arms 0.
const MOST_STEPS: usize = 60;

/// The sliding branch of one stack.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlidingBranch {
    stack: Stack,
    arms: Arms,
    law: ContactLaw,
    wall: ContactLaw,
}

/// How a stack ends whose floor slides while contact 2–3 is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SlidingEnd {
    /// The load has a maximum.
    Peak(PathPoint),
    /// Something else is there before that.
    Other(Event),
}

impl SlidingBranch {
    pub(super) fn new(stack: &Stack, convention: &ContactConvention) -> Self {
        Self {
            stack: *stack,
            arms: convention.arms,
            law: convention.law(stack.stiffness_ratio),
            wall: convention.wall_law(stack.stiffness_ratio),
        }
    }

    /// The peak beyond the state at T − μ_c = `start`, or what comes before it. The wall is lowest at the peak; and
    /// cylinders that slip meanwhile with c > 0 end nothing either, as long as they would stick at the peak.
    pub(super) fn end(&self, start: f64) -> SlidingEnd {
        let Some(opening) = self.opening(start) else {
            return SlidingEnd::Other(Event::None);
        };
        let load = |beyond: f64| self.point(beyond).floor_force;
        let highest = maximum_between(load, start, opening);
        let peak = match load(highest) > load(opening) {
            true => highest,
            false => opening,
        };
        let peak = self.point(peak);
        let mut others = [Event::CylinderSlip, Event::WallContact].into_iter();
        match others.find(|&event| peak.margin(event, &self.stack) < 0.0) {
            Some(event) => SlidingEnd::Other(event),
            None => SlidingEnd::Peak(peak),
        }
    }

    /// The state in which the wall just touches, F = 0, of a stack that began to slide under its own weight; `None`
    /// if contact 2–3 opens before gravity is complete.
    pub(super) fn at_rest(&self) -> Option<f64> {
        let opening = self.opening(0.0)?;
        let missing = |beyond: f64| self.point(beyond).wall_force * self.stack.stiffness;
        bracketed_root(missing, 0.0, opening)
    }

    /// T − μ_c where contact 2–3 opens, which depends on neither κ nor `start` where it can be found without them.
    fn opening(&self, start: f64) -> Option<f64> {
        let closed = |beyond: f64| -self.point(beyond).outward;
        let openings = [0.0, start].map(|low| bracketed_root(closed, low, WIDEST));
        openings
            .into_iter()
            .flatten()
            .find(|&beyond| beyond > start)
    }

    /// The state at T = μ_c + `beyond` under the wall; not a number where there is none.
    pub(super) fn point(&self, beyond: f64) -> PathPoint {
        let (overlap, load) = self.balance(beyond).unwrap_or((f64::NAN, f64::NAN));
        let tangent = CRITICAL_FRICTION + beyond;
        let outward = -0.5 * bottom_overlap(beyond, overlap);
        let [pair_lever, floor_lever] = self.levers(overlap, load);
        let shear = self.stack.floor_friction * load * floor_lever / pair_lever;
        let wall_force = 2.0 * load - 3.0 * self.stack.epsilon();
        PathPoint {
            tangent,
            pair_overlap: overlap,
            floor_overlap: self.wall.overlap(load),
            floor_force: load,
            outward,
            pair_ratio: shear / self.law.force(overlap),
            floor_ratio: self.stack.floor_friction,
            bottom_force: self.law.force((-2.0 * outward).max(0.0)),
            wall_force,
            wall_overlap: self.wall.overlap(wall_force),
        }
    }

    /// R_c and R_f.
    fn levers(&self, overlap: f64, load: f64) -> [f64; 2] {
        let Arms { pair, floor } = self.arms;
        let floor_overlap = self.wall.overlap(load);
        [
            1.0 + pair.torque * overlap,
            1.0 + floor.torque * floor_overlap,
        ]
    }

    /// G and d at T = μ_c + `beyond`, by Newton's method from the state with arms 0 (docs/theory.md, Eqs. 75 and 88).
    fn balance(&self, beyond: f64) -> Option<(f64, f64)> {
        let overlap = self.overlap_without_arms(beyond)?;
        let mut state = Vector2::new(overlap, self.load_without_arms(beyond, overlap));
        let mut last = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (residual, slope) = self.residual(beyond, state.x, state.y);
            let step = slope.lu().solve(&residual)?;
            state -= step;
            let size = step.amax() / state.amax();
            if size <= 4.0 * f64::EPSILON || (size < 1e-12 && size >= last) {
                return Some((state.x, state.y));
            }
            last = size;
        }
        None
    }

    /// G at which the balances hold with arms 0. What they lack grows with G beyond the overlap at which contact 2–3 just
    /// touches, and up to it wherever it is positive there.
    fn overlap_without_arms(&self, beyond: f64) -> Option<f64> {
        let lack = |overlap: f64| {
            let load = self.load_without_arms(beyond, overlap);
            self.outward_push(beyond, overlap) - self.stack.floor_friction * load
        };
        let tangent = CRITICAL_FRICTION + beyond;
        let touching = 0.5 * opened(beyond) / tangent;
        match lack(touching) > 0.0 {
            true => bracketed_root(lack, 0.0, touching),
            false => bracketed_root(lack, touching, LARGEST_OVERLAP),
        }
    }

    /// d of the vertical balance with arms 0.
    fn load_without_arms(&self, beyond: f64, overlap: f64) -> f64 {
        let [tangent, sum, difference] = half_angle(beyond);
        let weight = self.stack.epsilon() * sum;
        (self.law.force(overlap) * difference + weight)
            / (sum - self.stack.floor_friction * tangent)
    }

    /// (a sin ψ + c)(1 + T²)/2.
    fn outward_push(&self, beyond: f64, overlap: f64) -> f64 {
        let [tangent, sum, _] = half_angle(beyond);
        let bottom = self.law.force(bottom_overlap(beyond, overlap));
        self.law.force(overlap) * tangent + bottom * sum
    }

    /// What the horizontal balance of cylinder 2 and the vertical one of cylinder 1 lack at G and d, multiplied by
    /// R_c (1 + T²)/2, with the derivatives.
    fn residual(&self, beyond: f64, overlap: f64, load: f64) -> (Vector2<f64>, Matrix2<f64>) {
        let Arms { pair, floor } = self.arms;
        let [pair_lever, floor_lever] = self.levers(overlap, load);
        let (mu, epsilon) = (self.stack.floor_friction, self.stack.epsilon());
        let [tangent, sum, difference] = half_angle(beyond);
        let outward_push = self.outward_push(beyond, overlap);
        let lack = self.law.force(overlap) * difference - (load - epsilon) * sum;
        let lever_sum = sum * pair_lever + difference * floor_lever;
        let residual = Vector2::new(
            outward_push * pair_lever - mu * load * lever_sum,
            lack * pair_lever + mu * load * floor_lever * tangent,
        );
        let stiffness = self.law.stiffness(overlap);
        let bottom = self.law.stiffness(bottom_overlap(beyond, overlap));
        let floor_slope = floor.torque / self.wall.stiffness(self.wall.overlap(load));
        let slope = Matrix2::new(
            (stiffness + 2.0 * bottom) * tangent * pair_lever
                + (outward_push - mu * load * sum) * pair.torque,
            -mu * (lever_sum + load * difference * floor_slope),
            stiffness * difference * pair_lever + lack * pair.torque,
            -sum * pair_lever + mu * tangent * (floor_lever + load * floor_slope),
        );
        (residual, slope)
    }
}

/// T, (1 + T²)/2 and (1 − T²)/2 at T = μ_c + `beyond`.
fn half_angle(beyond: f64) -> [f64; 3] {
    let tangent = CRITICAL_FRICTION + beyond;
    let square = tangent * tangent;
    [tangent, 0.5 * (1.0 + square), 0.5 * (1.0 - square)]
}

/// (1 + T²) y of cylinders that do not overlap, free of cancellation.
fn opened(beyond: f64) -> f64 {
    beyond * (CRITICAL_FRICTION.recip() - (CRITICAL_FRICTION + beyond))
}

/// −2y at an overlap G of the cylinders 1 and 2; negative where contact 2–3 is open.
fn bottom_overlap(beyond: f64, overlap: f64) -> f64 {
    let [tangent, sum, _] = half_angle(beyond);
    (2.0 * overlap * tangent - opened(beyond)) / sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn branch(mu: f64, stiffness: f64, arms: Arms) -> SlidingBranch {
        let convention = ContactConvention::with_arms(arms);
        SlidingBranch::new(&Stack::paper(mu, stiffness), &convention)
    }

    #[test]
    fn forces_and_torques_balance_with_any_arms() {
        for arms in [
            Arms::PAPER,
            Arms::reciprocal(-0.5, -1.0),
            Arms::reciprocal(0.7, -0.4),
        ] {
            let branch = branch(0.3, 1e2, arms);
            for beyond in [1e-3, 0.01, 0.03] {
                let point = branch.point(beyond);
                let (sin, cos) = libm::sincos(2.0 * libm::atan(point.tangent));
                let (a, d) = (point.pair_overlap, point.floor_force);
                let (b, e, c) = (point.pair_ratio * a, 0.3 * d, 2.0 * (1.0 - (2.0 - a) * sin));
                let near = |left: f64, right: f64| {
                    assert!((left - right).abs() < 1e-14, "{arms:?} {left} {right}");
                };
                near(
                    b * (1.0 + arms.pair.torque * a),
                    e * (1.0 + arms.floor.torque * d),
                );
                near(a * sin - b * cos - e + c, 0.0);
                near(2.0 * (a * cos + b * sin), point.wall_force + 0.01);
                near(2.0 * d, point.wall_force + 0.03);
                near(-2.0 * point.outward, c);
            }
        }
    }

    #[test]
    fn peak_is_where_the_contact_opens_and_the_rational_equation_holds() {
        for (mu, stiffness) in [(0.2, 1e2), (0.25, 1e3), (0.3, 1e2), (0.3, 1e6), (0.35, 1e4)] {
            let branch = branch(mu, stiffness, Arms::PAPER);
            let SlidingEnd::Peak(peak) = branch.end(0.0) else {
                panic!("a peak");
            };
            let tangent = peak.tangent;
            let force = (3.0 * mu - tangent) / (tangent - mu);
            assert!(
                (peak.wall_force * stiffness / force - 1.0).abs() < 1e-11,
                "{mu}"
            );
            assert!(peak.outward.abs() < 1e-16);
        }
    }

    #[test]
    fn a_wall_that_comes_down_far_enough_ends_the_branch() {
        let end = branch(0.45, 1e2, Arms::PAPER).end(0.05);
        assert_eq!(end, SlidingEnd::Other(Event::WallContact));
    }

    #[test]
    fn a_stack_that_slid_under_its_own_weight_rests_if_the_contact_is_still_closed_then() {
        let rest = |mu| branch(mu, 1e2, Arms::PAPER).at_rest();
        assert_eq!(rest(0.08), None);
        let branch = branch(0.12, 1e2, Arms::PAPER);
        let point = branch.point(branch.at_rest().unwrap());
        assert!(point.wall_force.abs() < 1e-16 && point.bottom_force > 0.0);
        assert!((point.floor_force - 0.015).abs() < 1e-16);
    }
}
