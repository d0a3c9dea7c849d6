//! The states in which the floor slides while contact 2–3 is closed, for any arms and power of the normal force.
//!
//! With e = μ d in place of the floor spring, equilibrium alone fixes the overlap G and the floor load d for each
//! direction u, where (T − μ_c) : (−2y/x₀) = u : 1 − u. The states depend neither on springs nor on the preparation;
//! of a convention, only torque arms and normal force matter (docs/theory.md, Eqs. 74 to 76 and 87 to 89). From u = 0,
//! where T = μ_c, to u = 1, where the contact opens, the load grows until the end, or until a maximum shortly before.
//! T is not a suitable parameter: unless springs are linear, some arms make it fall again just before the contact
//! opens.

use super::events::{Event, PathPoint};
use super::overlap::HIGHEST_TANGENT;
use super::root::{bracketed_root, maximum_between};
use crate::model::{Arms, ContactConvention, ContactLaw, Ring, Stack};

/// Overlap at which the bottom cylinders coincide.
const LARGEST_BOTTOM_OVERLAP: f64 = 2.0;
/// Maximum number of iterations for d. The floor arm changes d by a small part of its own change, so each step gains a
/// digit or more.
const MOST_STEPS: usize = 60;
/// Relative change of d in the last step at which d counts as found.
const FOUND: f64 = 1e-12;
/// Maximum number of halvings of a distance at which no floor load balances.
const MOST_HALVINGS: usize = 60;
/// First distance in the search for the balanced state, in units of the overlap under one weight.
const NEAREST: f64 = 1e-3;
/// Fraction of a branch before its end over which its load is seen to rise or fall.
const LAST_PART: f64 = 1e-6;
/// u where contact 2–3 opens.
pub(super) const OPENING: f64 = 1.0;

/// The sliding branch of one stack.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlidingBranch {
    stack: Stack,
    ring: Ring,
    arms: Arms,
    law: ContactLaw,
    wall: ContactLaw,
}

/// How the loading ends for a stack whose floor slides while contact 2–3 is closed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SlidingEnd {
    /// The load has a maximum.
    Peak(PathPoint),
    /// Another event precedes the maximum.
    Other(Event),
}

/// Returns the peak on the branch of states `point` beyond u = `start`, or the event that precedes it, and the u of
/// the peak. The wall is lowest at the peak.
pub(super) fn end_of_branch(
    point: impl Fn(f64) -> PathPoint,
    start: f64,
    stack: &Stack,
) -> (SlidingEnd, f64) {
    let load = |direction: f64| point(direction).floor_force;
    if load(OPENING).is_nan() {
        return (SlidingEnd::Other(Event::None), OPENING);
    }
    let falls_before = load(OPENING - LAST_PART * (OPENING - start)) > load(OPENING);
    let direction = match falls_before {
        true => maximum_between(load, start, OPENING),
        false => OPENING,
    };
    let peak = point(direction);
    let mut others = [Event::CylinderSlip, Event::WallContact].into_iter();
    let end = match others.find(|&event| peak.margin(event, stack) < 0.0) {
        Some(event) => SlidingEnd::Other(event),
        None => SlidingEnd::Peak(peak),
    };
    (end, direction)
}

/// Where cylinders 1 and 2 are.
#[derive(Clone, Copy)]
struct Place {
    /// T − μ_c.
    beyond: f64,
    /// T.
    tangent: f64,
    /// (1 + T²)/2.
    sum: f64,
    /// (1 − T²)/2.
    difference: f64,
    /// −2y/x₀.
    bottom_overlap: f64,
    /// G.
    overlap: f64,
}

impl Place {
    /// The place with T = μ_c + `beyond` and −2y/x₀ = `bottom_overlap`.
    fn new(ring: &Ring, beyond: f64, bottom_overlap: f64) -> Self {
        let tangent = ring.critical_friction + beyond;
        let square = tangent * tangent;
        let sum = 0.5 * (1.0 + square);
        // (1 + T²) y/x₀ for cylinders that do not overlap.
        let opened = beyond * (ring.critical_friction.recip() - tangent);
        Self {
            beyond,
            tangent,
            sum,
            difference: 0.5 * (1.0 - square),
            bottom_overlap,
            overlap: 0.5 * ring.radius * (bottom_overlap * sum + opened) / tangent,
        }
    }
}

impl SlidingBranch {
    pub(super) fn new(stack: &Stack, convention: &ContactConvention) -> Self {
        Self {
            stack: *stack,
            ring: stack.ring(),
            arms: convention.arms,
            law: convention.law(stack.stiffness_ratio),
            wall: convention.wall_law(stack.stiffness_ratio),
        }
    }

    /// Returns u of a state.
    pub(super) fn direction(&self, point: &PathPoint) -> f64 {
        let beyond = point.tangent - self.ring.critical_friction;
        beyond / (beyond + self.ring.neighbour_overlap(point.outward))
    }

    /// Returns the peak beyond the state at u = `start`, or the event that precedes it. Slip between the cylinders
    /// while c > 0 does not end the branch as long as they stick at the peak.
    pub(super) fn end(&self, start: f64) -> SlidingEnd {
        end_of_branch(|direction| self.point(direction), start, &self.stack).0
    }

    /// Returns T − μ_c and the state in which the wall just touches, F = 0, for a stack that began to slide under its
    /// own weight.
    pub(super) fn place_at_rest(&self) -> Option<(f64, PathPoint)> {
        let direction = self.at_rest()?;
        Some((self.place(direction)?.beyond, self.point(direction)))
    }

    /// Returns u of the state in which the wall just touches, F = 0, for a stack that began to slide under its own
    /// weight; `None` if contact 2–3 opens before gravity is complete.
    pub(super) fn at_rest(&self) -> Option<f64> {
        let missing = |direction: f64| self.point(direction).wall_force * self.stack.stiffness;
        bracketed_root(missing, 0.0, OPENING)
    }

    /// Returns the state at u = `direction` under the wall; NaN where there is none.
    pub(super) fn point(&self, direction: f64) -> PathPoint {
        let place = self
            .place(direction)
            .unwrap_or(Place::new(&self.ring, f64::NAN, f64::NAN));
        let load = self.load(&place);
        let shear = self.stack.floor_friction * load * self.lever_ratio(&place, load);
        let wall_force = self.ring.bodies * load - self.stack.own_weight() * self.stack.epsilon();
        PathPoint {
            tangent: place.tangent,
            pair_overlap: place.overlap,
            floor_overlap: self.wall.overlap(load),
            floor_force: load,
            outward: -0.5 * self.ring.radius * place.bottom_overlap,
            pair_ratio: shear / self.law.force(place.overlap),
            pair_friction: shear / self.law.force(place.overlap),
            floor_ratio: self.stack.floor_friction,
            bottom_force: self.law.force(place.bottom_overlap),
            wall_force,
            wall_overlap: self.wall.overlap(wall_force),
        }
    }

    /// Returns the first place in a direction at which all forces balance. The outward push on cylinder 2 grows
    /// roughly as the power p of the distance from the stress-free state (docs/theory.md, section 11.5).
    fn place(&self, direction: f64) -> Option<Place> {
        let at = |distance: f64| {
            Place::new(
                &self.ring,
                distance * direction,
                distance * (1.0 - direction),
            )
        };
        let lack = |distance: f64| self.outward_push(&at(distance));
        let widest = HIGHEST_TANGENT - self.ring.critical_friction;
        let farthest = (widest / direction).min(LARGEST_BOTTOM_OVERLAP / (1.0 - direction));
        let mut near = 0.0;
        let mut far = NEAREST * self.law.overlap(self.stack.epsilon());
        while lack(far) < 0.0 {
            if far >= farthest {
                return None;
            }
            (near, far) = (far, (2.0 * far).min(farthest));
        }
        // Overlaps far beyond those of the state may have no levers, and no floor load that balances.
        for _ in 0..MOST_HALVINGS {
            let lacks = lack(far);
            if lacks >= 0.0 {
                return bracketed_root(lack, near, far).map(at);
            }
            let middle = 0.5 * (near + far);
            match lack(middle) < 0.0 {
                true => near = middle,
                false => far = middle,
            }
        }
        None
    }

    /// Returns the residual of the horizontal balance of cylinder 2, multiplied by (1 + T²)/2 (docs/theory.md, Eq.
    /// 88).
    fn outward_push(&self, place: &Place) -> f64 {
        let load = self.load(place);
        let lever_sum = place.sum + place.difference * self.lever_ratio(place, load);
        self.law.force(place.overlap) * place.tangent
            + self.ring.push * self.law.force(place.bottom_overlap) * place.sum
            - self.stack.floor_friction * load * lever_sum
    }

    /// Returns d from the vertical balance of cylinder 1; the lever ratio in it depends on d (docs/theory.md, Eq. 89).
    /// NaN where no load balances, as with a floor arm that grows faster with d than the weight that it lifts.
    fn load(&self, place: &Place) -> f64 {
        let weight = self.stack.epsilon() * place.sum;
        let pressing = self.law.force(place.overlap) * place.difference + weight;
        let sliding = self.stack.floor_friction * place.tangent;
        let (mut load, mut change) = (0.0, f64::INFINITY);
        for _ in 0..MOST_STEPS {
            let next = pressing / (place.sum - sliding * self.lever_ratio(place, load));
            change = (next - load).abs();
            load = next;
            if change <= f64::EPSILON * next.abs() {
                break;
            }
        }
        match load >= 0.0 && change <= FOUND * load {
            true => load,
            false => f64::NAN,
        }
    }

    /// Returns R_f/R_c at a floor load.
    fn lever_ratio(&self, place: &Place, load: f64) -> f64 {
        let Arms { pair, floor } = self.arms;
        (1.0 + floor.torque * self.wall.overlap(load)) / (1.0 + pair.torque * place.overlap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ContactArms, Problem};
    use crate::theory::quasistatic_limit;

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
            for direction in [0.1, 0.5, 0.9, 1.0] {
                let point = branch.point(direction);
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

    /// The floor load depends on the floor arm, through the overlap that the load itself causes.
    #[test]
    fn stiff_cylinders_balance_to_the_same_part_of_their_load() {
        let stiffness = 1e6;
        let branch = branch(0.3, stiffness, Arms::reciprocal(0.7, -0.4));
        for direction in [0.1, 0.9] {
            let point = branch.point(direction);
            let (sin, cos) = libm::sincos(2.0 * libm::atan(point.tangent));
            let pressing = point.pair_overlap * (cos + point.pair_ratio * sin);
            let load = pressing + stiffness.recip();
            assert!((load / point.floor_force - 1.0).abs() < 1e-14);
        }
    }

    /// Twice as far from the stress-free state, the levers of these arms vanish.
    #[test]
    fn a_state_is_found_before_places_without_a_load() {
        let branch = branch(0.4, 2.0, Arms::reciprocal(-1.0, -1.0));
        for direction in [0.5, 0.8] {
            let point = branch.point(direction);
            let (sin, cos) = libm::sincos(2.0 * libm::atan(point.tangent));
            let normal = point.pair_overlap;
            let lack = normal * (sin - point.pair_ratio * cos) - 0.4 * point.floor_force;
            assert!(lack < 0.0 && (lack + point.bottom_force).abs() < 1e-12);
        }
    }

    /// Found by a random search: with such arms the friction of the floor lifts more than it lowers.
    #[test]
    fn where_no_load_balances_the_branch_ends() {
        let arms = Arms {
            pair: ContactArms {
                torque: -0.925,
                kinematic: -0.395,
            },
            floor: ContactArms {
                torque: 0.327,
                kinematic: 0.397,
            },
        };
        let stack = Stack {
            cylinder_friction: 12.6,
            stiffness_ratio: 0.136,
            bodies: 3,
            ..Stack::paper(0.565, 27e3)
        };
        let convention = ContactConvention::with_arms(arms);
        let branch = SlidingBranch::new(&stack, &convention);
        assert_eq!(branch.end(0.224), SlidingEnd::Other(Event::None));
        let limit = quasistatic_limit(&Problem::new(stack, convention).unwrap());
        assert_eq!([limit.yield_force, limit.peak_force], [None; 2]);
        assert!(limit.reason.unwrap().contains("the sliding branch ends"));
    }

    #[test]
    fn a_state_has_the_direction_in_which_it_was_found() {
        for bodies in [2, 3, 5] {
            let stack = Stack {
                bodies,
                ..Stack::paper(0.25, 1e2)
            };
            let branch = SlidingBranch::new(&stack, &ContactConvention::TURNING);
            for direction in [0.1, 0.5, 0.9] {
                let point = branch.point(direction);
                let found = branch.direction(&point);
                assert!((found - direction).abs() < 1e-12, "{bodies} {found}");
                assert_eq!(point.pair_friction, point.pair_ratio);
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
        let end = branch(0.45, 1e2, Arms::PAPER).end(0.6);
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
