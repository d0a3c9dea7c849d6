//! The quasi-static limit of a stack whose bottom cylinders touch before anything slips.

use super::events::{Event, Path, PathPoint, locate};
use super::limit::Limit;
use super::path::{FollowedPath, RememberedBranch};
use super::sliding::{SlidingBranch, SlidingEnd};
use crate::model::{ContactConvention, Stack};

/// Computes the limit of `stack` along its `path`, on which contact 2–3 closes and may open again, and along the
/// sliding branch if the floor slips while the contact is closed.
pub(super) fn closing_limit(
    path: &FollowedPath,
    stack: &Stack,
    convention: &ContactConvention,
) -> Limit {
    let slip = locate(path, Event::FloorSlip, stack);
    let ends = match slip == Some(0.0) && floor_lacks_more(path, stack) {
        true => [Event::WallContact; 2],
        false => [Event::CylinderSlip, Event::WallContact],
    };
    let limit = Limit::before(ends, path, slip, stack);
    let limit = match slip.filter(|_| limit.event == Event::FloorSlip) {
        Some(slip) => SlidingStack { stack, path, slip }.limit(limit, convention),
        None => limit,
    };
    Limit {
        event: Event::ContactCloses,
        time_scale: stack.time_scale(convention),
        needs_slow_ramp: convention.law.needs_slow_ramp(),
        ..limit
    }
}

/// Whether, in the first state, the floor falls further short of the friction needed than the cylinders do. The floor
/// then slides, and limits b = e to less than the cylinders bear.
fn floor_lacks_more(path: &FollowedPath, stack: &Stack) -> bool {
    let point = path.point(path.stations()[0]);
    stack.floor_friction * point.pair_friction <= stack.cylinder_friction * point.floor_ratio
}

/// A stack whose floor slips before anything else, at the parameter `slip` of its path.
struct SlidingStack<'a> {
    stack: &'a Stack,
    path: &'a FollowedPath,
    slip: f64,
}

impl SlidingStack<'_> {
    /// Replaces the peak of `limit` by that of the sliding branch.
    fn limit(&self, limit: Limit, convention: &ContactConvention) -> Limit {
        // In the stress-free state no contact is closed yet.
        let onset = self.path.point(self.slip.max(self.path.stations()[0]));
        if onset.bottom_force <= 0.0 {
            return limit;
        }
        if !convention.history_update.turns() {
            return match RememberedBranch::new(self.path, self.stack, convention, self.slip) {
                Some(branch) => self.with_end(limit, branch.end(), &branch.settled),
                None => limit,
            };
        }
        let branch = SlidingBranch::new(self.stack, convention);
        let settled = self.path.settled();
        if self.slip >= settled {
            let start = branch.direction(&onset);
            let settled = self.path.point(settled);
            return self.with_end(limit, branch.end(start), &settled);
        }
        match branch.at_rest() {
            Some(start) => self.with_end(limit, branch.end(start), &branch.point(start)),
            None => limit,
        }
    }

    fn with_end(&self, limit: Limit, end: SlidingEnd, settled: &PathPoint) -> Limit {
        let peak = match end {
            SlidingEnd::Peak(peak) => peak,
            SlidingEnd::Other(event) => {
                return Limit {
                    yield_force: None,
                    peak_force: None,
                    peak_travel: None,
                    peak_z: None,
                    reason: Some(explanation(event).replace("cylinders", self.stack.kind())),
                    ..limit
                };
            }
        };
        let force = peak.wall_force * self.stack.stiffness;
        Limit {
            yield_force: Some(force),
            peak_force: Some(force),
            peak_travel: Some(settled.wall_height() - peak.wall_height()),
            peak_z: Some(peak.floor_overlap),
            reason: None,
            ..limit
        }
    }
}

/// Says why the force has no peak although the floor slides.
fn explanation(event: Event) -> String {
    let what = match event {
        Event::CylinderSlip => "the cylinders slip on each other (|q| = mu_d a)",
        Event::WallContact => "the top wall reaches the bottom cylinders",
        _ => "the sliding branch ends",
    };
    format!("the floor slides while the bottom cylinders touch, and {what} before the force peaks")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Law, Problem, TangentialHistory};
    use crate::theory::quasistatic_limit;

    fn stack(mu: f64, cylinder_friction: f64, stiffness_ratio: f64) -> Stack {
        Stack {
            cylinder_friction,
            stiffness_ratio,
            ..Stack::paper(mu, 20.0)
        }
    }

    fn limit(stack: &Stack) -> Limit {
        let problem = Problem::new(*stack, ContactConvention::TURNING).unwrap();
        let limit = quasistatic_limit(&problem);
        assert_eq!(limit.event, Event::ContactCloses);
        limit
    }

    /// The first state of this stack needs e/d = 0.1406 and b/a = 0.463. If the floor lacks more of its share, it
    /// limits b = e.
    #[test]
    fn what_slides_from_the_start_is_what_lacks_more_of_its_friction() {
        let sliding = limit(&stack(0.1, 0.35, 0.2));
        let sticking_cylinders = limit(&stack(0.1, 0.5, 0.2));
        assert!(sliding.yield_force.is_some());
        assert_eq!(sliding.yield_force, sticking_cylinders.yield_force);
        let slipping = limit(&stack(0.1, 0.3, 0.2));
        assert_eq!(slipping.yield_force, None);
        assert!(slipping.reason.unwrap().contains("the cylinders slip"));
    }

    /// At the peak the bottom cylinders just part: (2 − G) sin ψ = x₀ there, with G from the balance of cylinder 1.
    #[test]
    fn the_wall_travels_from_the_stack_at_rest_to_the_peak() {
        let stack = stack(0.2, 0.7, 0.5);
        let limit = limit(&stack);
        let force = limit.yield_force.unwrap();
        assert_eq!(limit.peak_force, Some(force));
        assert!(limit.slip_onset.unwrap() < force && limit.rises_after_onset());
        let epsilon = stack.epsilon();
        let load = 0.5 * epsilon * (force + 3.0);
        let [mut overlap, mut cosine] = [0.0_f64; 2];
        for _ in 0..100 {
            let sine = (2.0 - overlap).recip();
            cosine = (1.0 - sine * sine).sqrt();
            overlap = (0.5 * epsilon * (force + 1.0) - stack.floor_friction * load * sine) / cosine;
        }
        let height = 2.0 - load + (2.0 - overlap) * cosine - epsilon * force;
        let [_, top, _] = limit.rest.unwrap();
        let travel = limit.peak_travel.unwrap();
        assert!((top + 1.0 - height - travel).abs() < 1e-12, "{travel}");
        assert!((limit.peak_z.unwrap() - load).abs() < 1e-14);
        assert_eq!(limit.reason, None);
        assert_eq!(limit.travel_to_watch(), limit.wall_travel);
        assert!(limit.wall_travel.unwrap() < travel);
        // c of the horizontal balance of cylinder 2 at the onset, where b = e = μ d.
        let onset = 0.5 * stack.floor_friction * (limit.slip_onset.unwrap() + 3.0);
        let (sine, cosine) = libm::sincos(2.0 * libm::atan(limit.tangent.unwrap()));
        let bottom_force = onset * (1.0 + cosine - sine / limit.pair_ratio.unwrap());
        assert!((limit.bottom_force.unwrap() - bottom_force).abs() < 1e-12);
    }

    #[test]
    fn a_stack_that_began_to_slide_under_its_own_weight_is_watched_to_its_peak() {
        let limit = limit(&stack(0.13, 0.7, 0.2));
        assert_eq!([limit.slip_onset, limit.wall_travel], [None; 2]);
        assert!(limit.peak_travel.is_some_and(|travel| travel > 0.0));
        assert_eq!(limit.travel_to_watch(), limit.peak_travel);
        assert_eq!(limit.reason, None);
        assert!(explanation(Event::CylinderSlip).contains("cylinders slip"));
    }

    #[test]
    fn a_force_that_something_ends_before_its_peak_is_no_yield_force() {
        let limit = limit(&stack(0.38, 0.9, 0.5));
        assert!(limit.slip_onset.is_some());
        assert_eq!([limit.yield_force, limit.peak_force], [None; 2]);
        assert_eq!([limit.peak_travel, limit.peak_z], [None; 2]);
        let reason = limit.reason.unwrap();
        let parts = ["the floor slides while", "the top wall reaches"];
        assert!(parts.iter().all(|part| reason.contains(part)), "{reason}");
    }

    #[test]
    fn a_stack_of_soft_contacts_says_that_it_is_slow() {
        let law = Law {
            history: TangentialHistory::Force,
            ..Law::HERTZ
        };
        let convention = ContactConvention {
            law,
            ..ContactConvention::TURNING
        };
        let stack = Stack {
            stiffness_ratio: 0.9,
            ..Stack::paper(0.2, 1e4)
        };
        let limit = quasistatic_limit(&Problem::new(stack, convention).unwrap());
        assert_eq!(limit.event, Event::ContactCloses);
        assert_eq!(limit.time_scale, stack.time_scale(&convention));
        assert!(limit.time_scale > 2.0 && limit.needs_slow_ramp);
    }
}
