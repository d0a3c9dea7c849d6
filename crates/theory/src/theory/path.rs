//! The quasi-static limit for any arms and contact law, by following the path of equilibria.
//!
//! The [balance] of forces is a differential equation in the angle ψ, with contact 2–3 closed or open. Where that
//! contact closes or opens, the path is continuous but its slope is not, so the integration stops there and restarts
//! (docs/theory.md, Eqs. 47 to 52, and section 11 for laws other than the linear one).

mod balance;
mod remembered;
mod speed;

use super::events::{Event, Path, PathPoint, locate};
use super::limit::Limit;
use super::root::bracketed_root;
use crate::model::{ContactConvention, Problem, Ring, Stack};
pub(super) use balance::BottomContact;
use balance::{Beginning, Contacts, FIXED, Leg, State, TURNING};
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
pub(super) use remembered::{RememberedBranch, remembered_overlap_at_rest};
pub use speed::SpeedExcess;

const RELATIVE_TOLERANCE: f64 = 1e-13;
/// Start of the path on its first ray, as a fraction of the angle that the gravity ramp turns to first order. The ray
/// neglects this fraction of the lengths there, which is its square, 1e-16, relative to the lengths at rest.
const START: f64 = 1e-8;
/// First station on the gravity ramp, as a fraction of the angle it turns to first order. Each further station lies
/// twice as far, up to the spacing below.
const FIRST_STATION: f64 = 1e-7;
/// Largest spacing of stations along the gravity ramp.
const RAMP_SPACING: f64 = 0.125;
/// Distance of the stations under the wall, in the logarithm of the angle turned.
const WALL_SPACING: f64 = 0.125;

/// One leg as an initial value problem in the path parameter.
struct LegEquation<'a> {
    contacts: &'a Contacts,
    leg: Leg,
    closed: bool,
    first_turn: f64,
}

impl<const N: usize> ODE<f64, [f64; N]> for LegEquation<'_> {
    fn diff(&self, _parameter: f64, state: &[f64; N], slope: &mut [f64; N]) {
        let state = State::from_array(*state);
        let angle_per_parameter = match self.leg {
            Leg::GravityRamp => self.first_turn,
            Leg::Wall => state.turned,
        };
        let derivative = self.contacts.derivative(&state, self.leg, self.closed);
        *slope = derivative
            .to_array::<N>()
            .map(|component| component * angle_per_parameter);
    }
}

/// A state on the followed path, and whether contact 2–3 is closed from there on.
#[derive(Debug, Clone, Copy)]
struct Knot {
    parameter: f64,
    state: State,
    closed: bool,
}

/// The followed path, as states at the stations; it can be continued from each of them.
pub(super) struct FollowedPath {
    contacts: Contacts,
    /// The angle turned under gravity, to first order in ε.
    first_turn: f64,
    /// The parameter at which gravity is complete; infinite if the stack cannot carry its own weight.
    settled: f64,
    /// The angle turned at ψ = 90°, where the centre of cylinder 1 has sunk to the level of the other two.
    largest_turn: f64,
    knots: Vec<Knot>,
}

impl FollowedPath {
    /// Follows the path until cylinder 1 has sunk to the level of the others, or no equilibrium follows.
    fn new(contacts: Contacts) -> Self {
        let Beginning {
            first_turn,
            state,
            closed,
        } = contacts.beginning(START);
        let mut path = Self {
            first_turn,
            largest_turn: libm::acos(0.5 * contacts.ring.radius),
            contacts,
            settled: f64::INFINITY,
            knots: vec![Knot {
                parameter: START,
                state,
                closed,
            }],
        };
        path.follow_gravity();
        path.follow_wall();
        path
    }

    fn last(&self) -> Knot {
        self.knots[self.knots.len() - 1]
    }

    fn follow_gravity(&mut self) {
        let epsilon = self.contacts.epsilon;
        let end = self.largest_turn / self.first_turn;
        loop {
            let last = self.last();
            let from = last.parameter;
            let station = match from < FIRST_STATION {
                true => FIRST_STATION,
                false => from + from.min(RAMP_SPACING),
            };
            let Some(next) = self.next_knot(station.min(end)) else {
                return;
            };
            if next.state.load >= epsilon {
                let missing = |parameter: f64| {
                    let reached = self.advance(last, parameter);
                    reached.map_or(f64::NAN, |state| state.load / epsilon - 1.0)
                };
                let Some(settled) = bracketed_root(missing, from, next.parameter) else {
                    return;
                };
                let Some(state) = self.advance(last, settled) else {
                    return;
                };
                self.settled = settled;
                self.knots.push(Knot {
                    parameter: settled,
                    state,
                    closed: last.closed,
                });
                return;
            }
            self.knots.push(next);
            if next.parameter >= end {
                return;
            }
        }
    }

    fn follow_wall(&mut self) {
        if self.settled.is_infinite() {
            return;
        }
        let length = libm::log(self.largest_turn / self.last().state.turned);
        let count = (length / WALL_SPACING).ceil().max(0.0) as usize;
        for index in 1..=count {
            let to = self.settled + length * index as f64 / count as f64;
            while self.last().parameter < to {
                let Some(next) = self.next_knot(to) else {
                    return;
                };
                self.knots.push(next);
            }
        }
    }

    /// Returns the knot at `to`, or an earlier one where contact 2–3 closes or opens.
    fn next_knot(&self, to: f64) -> Option<Knot> {
        let last = self.last();
        let state = self.advance(last, to)?;
        if self.contacts.bottom == BottomContact::Ignored
            || last.closed == (self.outward(&state) < 0.0)
        {
            return Some(Knot {
                parameter: to,
                state,
                closed: last.closed,
            });
        }
        let outward = |parameter: f64| {
            let reached = self.advance(last, parameter);
            reached.map_or(f64::NAN, |state| self.outward(&state))
        };
        // Just after a change, y is 0 up to round-off and there is no root ahead: the path continues to the station.
        let change = bracketed_root(outward, last.parameter, to);
        let change = change.filter(|&change| change > last.parameter);
        let change = change.unwrap_or(to);
        Some(Knot {
            parameter: change,
            state: self.advance(last, change)?,
            closed: !last.closed,
        })
    }

    fn outward(&self, state: &State) -> f64 {
        state.outward(&self.contacts.ring)
    }

    /// Returns the state at a parameter; NaN where there is none.
    fn state(&self, parameter: f64) -> State {
        let parameter = parameter.max(START);
        let after = self
            .knots
            .partition_point(|knot| knot.parameter <= parameter);
        let knot = self.knots[after.saturating_sub(1)];
        self.advance(knot, parameter).unwrap_or(State::lost())
    }

    fn leg_at(&self, parameter: f64) -> Leg {
        if parameter <= self.settled {
            Leg::GravityRamp
        } else {
            Leg::Wall
        }
    }

    fn advance(&self, from: Knot, to: f64) -> Option<State> {
        if from.parameter == to {
            return Some(from.state);
        }
        let equation = LegEquation {
            contacts: &self.contacts,
            leg: self.leg_at(to),
            closed: from.closed,
            first_turn: self.first_turn,
        };
        let (start, epsilon) = (from.state, self.contacts.epsilon);
        match self.contacts.springs_turn() {
            true => integrated::<TURNING>(&equation, [from.parameter, to], start, epsilon),
            false => integrated::<FIXED>(&equation, [from.parameter, to], start, epsilon),
        }
    }
}

/// Integrates `equation` from `start` over a range of the parameter and returns the state at its end; `None` if there
/// is none.
fn integrated<const N: usize>(
    equation: &impl ODE<f64, [f64; N]>,
    [from, to]: [f64; 2],
    start: State,
    epsilon: f64,
) -> Option<State> {
    let method = ExplicitRungeKutta::dop853()
        .rtol(RELATIVE_TOLERANCE)
        .atol(RELATIVE_TOLERANCE * 1e-3 * epsilon);
    let solution = IVP::ode(equation, from, to, start.to_array::<N>())
        .method(method)
        .solve()
        .ok()?;
    let end = *solution.y.last()?;
    let valid = end.iter().all(|component| component.is_finite());
    valid.then(|| State::from_array(end))
}

impl Path for FollowedPath {
    fn stations(&self) -> Vec<f64> {
        self.knots[1..].iter().map(|knot| knot.parameter).collect()
    }

    fn settled(&self) -> f64 {
        self.settled
    }

    fn point(&self, parameter: f64) -> PathPoint {
        self.contacts
            .point(&self.state(parameter), self.leg_at(parameter.max(START)))
    }
}

/// The quasi-static limit of `problem`, along its path even where there is a closed form.
pub fn followed_limit(problem: &Problem) -> Limit {
    let (stack, convention) = (problem.stack(), problem.convention());
    let path = followed_path(stack, convention, BottomContact::Ignored);
    limit_on(&path, stack, convention)
}

/// The limit along the given `path` of the stack.
pub(super) fn limit_on(
    path: &FollowedPath,
    stack: &Stack,
    convention: &ContactConvention,
) -> Limit {
    let slip = locate(path, Event::FloorSlip, stack);
    Limit {
        time_scale: stack.time_scale(convention),
        needs_slow_ramp: convention.law.needs_slow_ramp(),
        ..Limit::of(path, slip, stack)
    }
}

/// Follows the path of equilibria of `stack`, which does not depend on its frictions.
pub(super) fn followed_path(
    stack: &Stack,
    convention: &ContactConvention,
    bottom: BottomContact,
) -> FollowedPath {
    FollowedPath::new(Contacts::new(stack, convention, bottom))
}

/// Follows the path with c = 0 for bodies that start in a `ring` other than the one in which they just touch.
pub(super) fn path_from(ring: Ring, stack: &Stack, convention: &ContactConvention) -> FollowedPath {
    let contacts = Contacts::new(stack, convention, BottomContact::Ignored);
    FollowedPath::new(contacts.in_ring(ring))
}

mod tests;
