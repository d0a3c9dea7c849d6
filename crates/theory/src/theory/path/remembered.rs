//! The sliding branch of springs that do not turn, while contact 2–3 is closed.
//!
//! With springs that turn, the sliding states have no memory ([`SlidingBranch`]). A spring that does not turn keeps
//! the component p along the normal that it has collected, so the branch is integrated: the floor carries e = μ d, the
//! contact 1–2 sticks, and p loses b dψ as before (docs/theory.md, Eq. 112). The parameter is the logarithm of the
//! load while the stack slides under its own weight. Under the wall it is the direction u of the state, from that of
//! the onset to 1, where the contact opens.

use super::super::events::{Event, Path, PathPoint};
use super::super::sliding::{OPENING, SlidingBranch, SlidingEnd, end_of_branch};
use super::balance::{Contacts, FIXED, Leg, Progress, State};
use super::{FollowedPath, integrated};
use crate::model::{ContactConvention, Stack};
use differential_equations::prelude::ODE;

/// First load of a stack that slides from the start, relative to its weight.
const FIRST_LOAD: f64 = 1e-8;
/// Largest spacing, in the logarithm of the load, between the states at which a sliding stack is examined.
const LOAD_SPACING: f64 = 0.25;
/// Number of kept states between the onset and the opening of the contact.
const KNOTS: usize = 32;

/// The states of one stack while it slides on the floor.
pub(in crate::theory) struct RememberedBranch<'a> {
    contacts: &'a Contacts,
    stack: &'a Stack,
    /// Directions u and their states, starting with the state under the wall at which the branch begins.
    knots: Vec<(f64, State)>,
    /// The state in which the wall just touches.
    pub(in crate::theory) settled: PathPoint,
}

/// The equations of a stack while its floor slides.
struct SlidingEquation<'a> {
    contacts: &'a Contacts,
    floor_friction: f64,
    leg: Leg,
}

impl ODE<f64, [f64; FIXED]> for SlidingEquation<'_> {
    fn diff(&self, parameter: f64, state: &[f64; FIXED], slope: &mut [f64; FIXED]) {
        let state = State::from_array(*state);
        let progress = match self.leg {
            Leg::GravityRamp => Progress::Load,
            Leg::Wall => Progress::Direction(parameter),
        };
        let derivative =
            self.contacts
                .sliding_derivative(&state, self.leg, self.floor_friction, progress);
        *slope = derivative.to_array();
    }
}

impl SlidingEquation<'_> {
    fn advance(&self, state: State, range: [f64; 2]) -> Option<State> {
        match range[0] == range[1] {
            true => Some(state),
            false => integrated(self, range, state, self.contacts.epsilon),
        }
    }
}

impl<'a> RememberedBranch<'a> {
    /// Follows the branch of `stack`, whose floor slips at the parameter `slip` of its `path`; `None` if contact 2–3
    /// opens before gravity is complete.
    pub(in crate::theory) fn new(
        path: &'a FollowedPath,
        stack: &'a Stack,
        convention: &ContactConvention,
        slip: f64,
    ) -> Option<Self> {
        let contacts = &path.contacts;
        let settled = path.settled();
        let (start, settled) = if slip >= settled {
            (path.state(slip), path.point(settled))
        } else {
            let start = at_slip(path, stack, convention, slip)?;
            let rest = slid_under_own_weight(contacts, stack, start)?;
            (rest, contacts.point(&rest, Leg::Wall))
        };
        let first = contacts.direction(&start);
        let sliding = SlidingEquation {
            contacts,
            floor_friction: stack.floor_friction,
            leg: Leg::Wall,
        };
        let mut knots = vec![(first, start)];
        for index in 1..KNOTS {
            let to = first + (OPENING - first) * index as f64 / KNOTS as f64;
            let (from, state) = knots[index - 1];
            // A branch that ends before its contact opens has no state at the opening either.
            let Some(state) = sliding.advance(state, [from, to]) else {
                break;
            };
            knots.push((to, state));
        }
        Some(Self {
            contacts,
            stack,
            knots,
            settled,
        })
    }

    /// Returns the peak, or the event that precedes it. If the cylinders slip on the way, the path beyond is unknown,
    /// as a spring remembers how long it has slid.
    pub(in crate::theory) fn end(&self) -> SlidingEnd {
        let (start, _) = self.knots[0];
        let (end, peak) = end_of_branch(|direction| self.point(direction), start, self.stack);
        let slips = |(_, state): &(f64, State)| {
            let point = self.contacts.point(state, Leg::Wall);
            point.margin(Event::CylinderSlip, self.stack) < 0.0
        };
        match self.before(peak).any(slips) {
            true => SlidingEnd::Other(Event::CylinderSlip),
            false => end,
        }
    }

    /// Returns the state of the largest load, whatever precedes it.
    pub(in crate::theory) fn peak(&self) -> PathPoint {
        self.point(self.peak_direction())
    }

    fn peak_direction(&self) -> f64 {
        let (start, _) = self.knots[0];
        end_of_branch(|direction| self.point(direction), start, self.stack).1
    }

    /// The kept states from the onset up to u = `direction`, exclusive.
    fn before(&self, direction: f64) -> impl Iterator<Item = &(f64, State)> {
        let (start, _) = self.knots[0];
        let whole = (direction - start).abs();
        let knots = self.knots.iter();
        knots.take_while(move |(at, _)| (at - start).abs() < whole)
    }

    /// The kept states up to the largest load, and the state of that load.
    fn up_to_peak(&self) -> impl Iterator<Item = PathPoint> {
        let peak = self.peak_direction();
        let points = self.before(peak);
        let points = points.map(|(_, state)| self.contacts.point(state, Leg::Wall));
        points.chain([self.point(peak)])
    }

    /// The friction between the cylinders that is needed up to the largest load.
    pub(in crate::theory) fn needed_friction(&self) -> f64 {
        self.up_to_peak()
            .map(|point| point.pair_friction)
            .fold(0.0, f64::max)
    }

    /// The smallest margin to cylinder slip or wall contact up to the largest load.
    pub(in crate::theory) fn margin(&self) -> f64 {
        let margins = self.up_to_peak().flat_map(|point| {
            [Event::CylinderSlip, Event::WallContact].map(|event| point.margin(event, self.stack))
        });
        margins.fold(f64::INFINITY, f64::min)
    }

    /// Returns the state at u = `direction` under the wall; NaN where there is none.
    fn point(&self, direction: f64) -> PathPoint {
        let after = self.knots.partition_point(|(at, _)| *at <= direction);
        let (from, state) = self.knots[after.saturating_sub(1)];
        let sliding = SlidingEquation {
            contacts: self.contacts,
            floor_friction: self.stack.floor_friction,
            leg: Leg::Wall,
        };
        let state = sliding.advance(state, [from, direction]);
        self.contacts
            .point(&state.unwrap_or(State::lost()), Leg::Wall)
    }
}

/// Returns the state in which the floor begins to slide, at the parameter `slip` of the `path`, before gravity is
/// complete.
fn at_slip(
    path: &FollowedPath,
    stack: &Stack,
    convention: &ContactConvention,
    slip: f64,
) -> Option<State> {
    match slip > 0.0 {
        true => Some(path.state(slip)),
        false => slid_from_the_start(&path.contacts, stack, convention),
    }
}

/// Returns the state, at a small load, of a stack whose floor slides from the start. No spring has fallen behind its
/// contact yet, so springs that turn have the same state there.
fn slid_from_the_start(
    contacts: &Contacts,
    stack: &Stack,
    convention: &ContactConvention,
) -> Option<State> {
    let light = Stack {
        stiffness: stack.stiffness / FIRST_LOAD,
        ..*stack
    };
    let branch = SlidingBranch::new(&light, convention);
    let (beyond, point) = branch.place_at_rest()?;
    Some(contacts.sliding_state(beyond, &point))
}

/// Returns the overlap of the bottom cylinders when gravity is complete, negative if they have separated. If the floor
/// of `stack` slips before, at the parameter `slip` of its `path`, the stack slides until then.
pub(in crate::theory) fn remembered_overlap_at_rest(
    path: &FollowedPath,
    stack: &Stack,
    convention: &ContactConvention,
    slip: f64,
) -> Option<f64> {
    let contacts = &path.contacts;
    let rest = match slip >= path.settled() {
        true => path.state(path.settled()),
        false => {
            let start = at_slip(path, stack, convention, slip)?;
            slid_until(contacts, stack, start, |_| true)?
        }
    };
    Some(-rest.outward(&contacts.ring))
}

/// Returns the state at rest of a stack that slides from `start` on while its weight grows; `None` if contact 2–3
/// opens meanwhile.
fn slid_under_own_weight(contacts: &Contacts, stack: &Stack, start: State) -> Option<State> {
    slid_until(contacts, stack, start, |state| {
        state.outward(&contacts.ring) < 0.0
    })
}

/// Slides the stack under its growing weight; `None` once a state does not satisfy `goes_on`.
fn slid_until(
    contacts: &Contacts,
    stack: &Stack,
    start: State,
    goes_on: impl Fn(&State) -> bool,
) -> Option<State> {
    let sliding = SlidingEquation {
        contacts,
        floor_friction: stack.floor_friction,
        leg: Leg::GravityRamp,
    };
    let [first, last] = [start.load, contacts.epsilon].map(libm::log);
    let count = ((last - first) / LOAD_SPACING).ceil().max(1.0) as usize;
    let place = |index: usize| first + (last - first) * index as f64 / count as f64;
    (0..count).try_fold(start, |state, index| {
        let next = sliding.advance(state, [place(index), place(index + 1)])?;
        goes_on(&next).then_some(next)
    })
}

#[cfg(test)]
mod tests {
    use super::super::super::events::locate;
    use super::super::{BottomContact, followed_path};
    use super::*;

    /// Returns the end of the branch, the state at the largest load and the state at the opening, for the paper's
    /// stack with this stiffness ratio, stiffness, floor friction and cylinder friction.
    fn branch(
        [stiffness_ratio, stiffness, floor, cylinders]: [f64; 4],
    ) -> (SlidingEnd, PathPoint, PathPoint) {
        let stack = Stack {
            stiffness_ratio,
            cylinder_friction: cylinders,
            ..Stack::paper(floor, stiffness)
        };
        let convention = ContactConvention::PAPER;
        let path = followed_path(&stack, &convention, BottomContact::Followed);
        let slip = locate(&path, Event::FloorSlip, &stack).unwrap();
        let branch = RememberedBranch::new(&path, &stack, &convention, slip).unwrap();
        (branch.end(), branch.peak(), branch.point(OPENING))
    }

    #[test]
    fn cylinders_that_slip_before_the_peak_end_the_branch() {
        // Their contact needs 0.6147 at the onset and 0.5561 at the peak, where the wall has reached cylinder 2.
        let (end, peak, opening) = branch([0.05, 20.0, 0.5, 0.62]);
        assert_eq!(end, SlidingEnd::Other(Event::WallContact));
        assert!(peak.floor_force > 1.001 * opening.floor_force);
        let (end, same, _) = branch([0.05, 20.0, 0.5, 0.58]);
        assert_eq!(end, SlidingEnd::Other(Event::CylinderSlip));
        assert_eq!(same, peak);
    }

    #[test]
    fn what_comes_after_a_peak_at_the_onset_does_not_end_the_branch() {
        // It needs 0.3850 at the onset, which is the peak, and 0.3928 later, while the load falls.
        let (end, peak, _) = branch([1.0, 1e3, 0.4, 0.39]);
        assert_eq!(end, SlidingEnd::Peak(peak));
    }
}
