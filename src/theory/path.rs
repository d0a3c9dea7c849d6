//! The quasi-static limit for any arms, by following the path of equilibria.
//!
//! With the torque arms R_c = r + r₁ G and R_f = r + r₁ z, equilibrium reads (forces in k_n r, lengths in r)
//!
//! b R_c = e R_f,  −a sin ψ + b cos ψ + e = 0,  2(a cos ψ + b sin ψ) = L,
//!
//! where L is the load carried by cylinder 1: its growing weight along the gravity ramp, f + m g under
//! the wall. The springs accumulate ρ dψ − R̃_c dθ and dx₂ + R̃_f dθ, with the kinematic arms R̃ of the same
//! form. Differentiated with respect to ψ this is a linear 3×3 system for (ρ′, θ′, L′), regular also
//! where L has a maximum (docs/theory.md, Eqs. 10, 15 and 36 to 40).
//!
//! Contact 2–3 can be ignored (c = 0, the paper's assumption) or followed. Where it is closed, y < 0, it
//! carries c = k_n (−2y), and nothing tangential: by mirror symmetry its surfaces do not move against each
//! other. The horizontal balance becomes −a sin ψ + b cos ψ + e − c = 0 and the torques stay as they are.
//! The path is continuous where the contact closes or opens, its slope is not: the integration stops
//! there and starts anew (docs/theory.md, Eqs. 47 to 52).

use super::events::{Event, Path, PathPoint, half_angle_tangent, locate, outward_displacement};
use super::limit::Limit;
use super::root::bracketed_root;
use crate::model::{Arms, ContactConvention, ContactLaw, Stack};
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_6;

const RELATIVE_TOLERANCE: f64 = 1e-13;
/// First station on the gravity ramp, relative to the angle it turns to first order; each further one lies
/// twice as far, up to the spacing below.
const FIRST_STATION: f64 = 1e-7;
/// Largest distance of stations along the gravity ramp.
const RAMP_SPACING: f64 = 0.125;
/// Distance of the stations under the wall, in the logarithm of the angle turned.
const WALL_SPACING: f64 = 0.125;
/// At ψ = 90° the centre of cylinder 1 has sunk to the level of the other two.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_3;

/// The state that is integrated.
#[derive(Debug, Clone, Copy)]
struct State {
    /// ψ − 30°.
    turned: f64,
    /// L, load carried by cylinder 1.
    load: f64,
    /// G = 2r − ρ.
    pair_overlap: f64,
    /// θ, rotation of cylinder 2.
    rotation: f64,
    /// b, tangential force of the contact 1–2.
    pair_shear: f64,
    /// e, tangential force of the floor contact.
    floor_shear: f64,
}

impl State {
    fn from_array(state: [f64; 6]) -> Self {
        let [
            turned,
            load,
            pair_overlap,
            rotation,
            pair_shear,
            floor_shear,
        ] = state;
        Self {
            turned,
            load,
            pair_overlap,
            rotation,
            pair_shear,
            floor_shear,
        }
    }

    fn to_array(self) -> [f64; 6] {
        [
            self.turned,
            self.load,
            self.pair_overlap,
            self.rotation,
            self.pair_shear,
            self.floor_shear,
        ]
    }

    /// y = x₂ − r.
    fn outward(&self) -> f64 {
        outward_displacement(self.turned, self.pair_overlap)
    }
}

/// The two legs of the path, which differ in how the floor load d grows with L.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Leg {
    /// Gravity grows until L = ε: d = 3L/2. The parameter is the angle turned, in units of `first_turn`.
    GravityRamp,
    /// The wall presses: d = L/2 + ε. The parameter grows with the logarithm of the angle turned.
    Wall,
}

impl Leg {
    fn floor_force(self, load: f64, epsilon: f64) -> f64 {
        match self {
            Self::GravityRamp => 1.5 * load,
            Self::Wall => 0.5 * load + epsilon,
        }
    }

    fn floor_force_slope(self) -> f64 {
        match self {
            Self::GravityRamp => 1.5,
            Self::Wall => 0.5,
        }
    }
}

/// Treatment of the contact between the bottom cylinders.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BottomContact {
    /// It carries nothing, c = 0, even where the cylinders would overlap.
    Ignored,
    /// It closes where y < 0 and opens where y > 0.
    Followed,
}

/// Constants of the contacts along a path.
#[derive(Debug, Clone, Copy)]
struct Contacts {
    law: ContactLaw,
    arms: Arms,
    epsilon: f64,
    bottom: BottomContact,
}

impl Contacts {
    /// Derivative of the state with respect to ψ, with contact 2–3 closed or open (docs/theory.md,
    /// Eqs. 37 to 39 and 52).
    fn derivative(&self, state: &State, leg: Leg, closed: bool) -> State {
        let (sin, cos) = libm::sincos(FRAC_PI_6 + state.turned);
        let distance = 2.0 - state.pair_overlap;
        let floor_overlap = self.law.overlap(leg.floor_force(state.load, self.epsilon));
        let tangential = self.law.tangential_stiffness;
        let Arms { pair, floor } = self.arms;
        let pair_lever = 1.0 + pair.torque * state.pair_overlap;
        let pair_radius = 1.0 + pair.kinematic * state.pair_overlap;
        let floor_lever = 1.0 + floor.torque * floor_overlap;
        let floor_radius = 1.0 + floor.kinematic * floor_overlap;
        let a = self.law.force(state.pair_overlap);
        let (b, e) = (state.pair_shear, state.floor_shear);
        // −dc/dx₂: the bottom cylinders overlap by −2y.
        let bottom_stiffness = if closed { 2.0 } else { 0.0 };

        // Rows: torque on 2, horizontal force on 2, vertical force on 1. Columns: ρ′, θ′, L′.
        let system = Matrix3::new(
            -b * pair.torque - tangential * floor_lever * sin,
            -tangential * pair_lever * pair_radius - tangential * floor_lever * floor_radius,
            -e * floor.torque * leg.floor_force_slope(),
            (1.0 + tangential + bottom_stiffness) * sin,
            -tangential * pair_radius * cos + tangential * floor_radius,
            0.0,
            -2.0 * cos,
            -2.0 * tangential * pair_radius * sin,
            -1.0,
        );
        let known = Vector3::new(
            (tangential * pair_lever - tangential * floor_lever * cos) * distance,
            (2.0 * tangential + bottom_stiffness) * distance * cos - a * cos - b * sin,
            2.0 * (tangential * distance * sin - a * sin + b * cos),
        );
        let solution = system
            .lu()
            .solve(&-known)
            .unwrap_or(Vector3::repeat(f64::NAN));
        let (distance_slope, rotation_slope, load_slope) = (solution.x, solution.y, solution.z);
        State {
            turned: 1.0,
            load: load_slope,
            pair_overlap: -distance_slope,
            rotation: rotation_slope,
            pair_shear: tangential * (distance - pair_radius * rotation_slope),
            floor_shear: tangential
                * (distance_slope * sin + distance * cos + floor_radius * rotation_slope),
        }
    }

    fn point(&self, state: &State, leg: Leg) -> PathPoint {
        let (law, outward) = (&self.law, state.outward());
        let floor_force = leg.floor_force(state.load, self.epsilon);
        let wall_force = match leg {
            Leg::GravityRamp => 0.0,
            Leg::Wall => state.load - self.epsilon,
        };
        PathPoint {
            tangent: half_angle_tangent(state.turned),
            pair_overlap: state.pair_overlap,
            floor_overlap: law.overlap(floor_force),
            floor_force,
            outward,
            pair_ratio: state.pair_shear / law.force(state.pair_overlap),
            floor_ratio: state.floor_shear / floor_force,
            bottom_force: match self.bottom {
                BottomContact::Ignored => 0.0,
                BottomContact::Followed => law.force((-2.0 * outward).max(0.0)),
            },
            wall_force,
            wall_overlap: law.overlap(wall_force),
        }
    }
}

/// One leg as an initial value problem in the path parameter.
struct LegEquation<'a> {
    contacts: &'a Contacts,
    leg: Leg,
    closed: bool,
    first_turn: f64,
}

impl ODE<f64, [f64; 6]> for LegEquation<'_> {
    fn diff(&self, _parameter: f64, state: &[f64; 6], slope: &mut [f64; 6]) {
        let state = State::from_array(*state);
        let angle_per_parameter = match self.leg {
            Leg::GravityRamp => self.first_turn,
            Leg::Wall => state.turned,
        };
        let derivative = self.contacts.derivative(&state, self.leg, self.closed);
        *slope = derivative
            .to_array()
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

/// The followed path: states at the stations, from each of which it can be continued.
pub(super) struct FollowedPath {
    contacts: Contacts,
    /// The angle turned under gravity, to first order in ε.
    first_turn: f64,
    /// The parameter at which gravity is complete; infinite if the stack cannot carry its own weight.
    settled: f64,
    knots: Vec<Knot>,
}

impl FollowedPath {
    /// Follows the path until cylinder 1 has sunk to the level of the others, or no equilibrium follows.
    fn new(contacts: Contacts) -> Self {
        let origin = State::from_array([0.0; 6]);
        let open_slope = contacts.derivative(&origin, Leg::GravityRamp, false);
        let closed = contacts.bottom == BottomContact::Followed && moves_inwards(&open_slope);
        let initial_slope = contacts.derivative(&origin, Leg::GravityRamp, closed);
        let mut path = Self {
            first_turn: contacts.epsilon / initial_slope.load,
            contacts,
            settled: f64::INFINITY,
            knots: vec![Knot {
                parameter: 0.0,
                state: origin,
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
        let end = LARGEST_TURN / self.first_turn;
        loop {
            let last = self.last();
            let from = last.parameter;
            let spacing = from.clamp(FIRST_STATION, RAMP_SPACING);
            let Some(next) = self.next_knot((from + spacing).min(end)) else {
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
        let length = libm::log(LARGEST_TURN / self.last().state.turned);
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

    /// The knot at `to`, or where contact 2–3 closes or opens before that.
    fn next_knot(&self, to: f64) -> Option<Knot> {
        let last = self.last();
        let state = self.advance(last, to)?;
        if self.contacts.bottom == BottomContact::Ignored || last.closed == (state.outward() < 0.0)
        {
            return Some(Knot {
                parameter: to,
                state,
                closed: last.closed,
            });
        }
        let outward = |parameter: f64| {
            let reached = self.advance(last, parameter);
            reached.map_or(f64::NAN, |state| state.outward())
        };
        // Just after a change y = 0 up to round-off, and no root lies ahead: the path goes on to the station.
        let change = bracketed_root(outward, last.parameter, to);
        let change = change.filter(|&change| change > last.parameter);
        let change = change.unwrap_or(to);
        Some(Knot {
            parameter: change,
            state: self.advance(last, change)?,
            closed: !last.closed,
        })
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
        let method = ExplicitRungeKutta::dop853()
            .rtol(RELATIVE_TOLERANCE)
            .atol(RELATIVE_TOLERANCE * 1e-3 * self.contacts.epsilon);
        let solution = IVP::ode(&equation, from.parameter, to, from.state.to_array())
            .method(method)
            .solve()
            .ok()?;
        let end = *solution.y.last()?;
        let valid = end.iter().all(|component| component.is_finite());
        valid.then(|| State::from_array(end))
    }
}

/// Whether cylinder 2 begins to move inwards from the stress-free state.
fn moves_inwards(slope: &State) -> bool {
    // dy/dψ = ρ′ sin ψ + ρ cos ψ at ψ = 30°, ρ = 2.
    let outward_slope = 3f64.sqrt() - 0.5 * slope.pair_overlap;
    outward_slope < 0.0
}

impl Path for FollowedPath {
    fn stations(&self) -> Vec<f64> {
        self.knots[1..].iter().map(|knot| knot.parameter).collect()
    }

    fn settled(&self) -> f64 {
        self.settled
    }

    fn point(&self, parameter: f64) -> PathPoint {
        let after = self
            .knots
            .partition_point(|knot| knot.parameter <= parameter);
        let knot = self.knots[after.saturating_sub(1)];
        let lost = State::from_array([f64::NAN; 6]);
        let state = self.advance(knot, parameter).unwrap_or(lost);
        self.contacts.point(&state, self.leg_at(parameter))
    }
}

/// The quasi-static limit of `stack` under any convention.
pub fn followed_limit(stack: &Stack, convention: &ContactConvention) -> Limit {
    let path = followed_path(stack, convention, BottomContact::Ignored);
    let slip = locate(&path, Event::FloorSlip, stack);
    Limit::of(&path, slip, stack)
}

/// The path of equilibria of `stack`, which does not depend on its frictions.
pub(super) fn followed_path(
    stack: &Stack,
    convention: &ContactConvention,
    bottom: BottomContact,
) -> FollowedPath {
    FollowedPath::new(Contacts {
        law: convention.law(stack.stiffness_ratio),
        arms: convention.arms,
        epsilon: stack.epsilon(),
        bottom,
    })
}

#[cfg(test)]
mod tests;
