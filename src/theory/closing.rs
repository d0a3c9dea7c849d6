//! The quasi-static limit of a stack whose bottom cylinders touch before anything slips.

use super::events::{Event, Path, PathPoint, locate};
use super::limit::Limit;
use super::path::{FollowedPath, RememberedBranch};
use super::sliding::{SlidingBranch, SlidingEnd};
use crate::model::{ContactConvention, Stack};

/// The limit of `stack` along its `path`, on which contact 2–3 closes and may open again, and along the sliding branch
/// if the floor slips while it is closed.
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

/// Whether the floor lacks more of the friction that the first state needs than the cylinders do: it slides then, and
/// limits b = e to less than they bear.
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
    /// `limit` with the peak of the sliding branch.
    fn limit(&self, limit: Limit, convention: &ContactConvention) -> Limit {
        // At the stress-free state nothing is closed yet.
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

/// Why the force has no peak although the floor slides.
fn explanation(event: Event) -> String {
    let what = match event {
        Event::CylinderSlip => "the cylinders slip on each other (|q| = mu_d a)",
        Event::WallContact => "the top wall reaches the bottom cylinders",
        _ => "the sliding branch ends",
    };
    format!("the floor slides while the bottom cylinders touch, and {what} before the force peaks")
}
