//! The quasi-static limit for any torque arms, by following the path of equilibria.
//!
//! With the arms R_c = r + r₁ G and R_f = r + r₁ z, equilibrium reads (forces in k_n r, lengths in r)
//!
//! b R_c = e R_f,  −a sin ψ + b cos ψ + e = 0,  2(a cos ψ + b sin ψ) = L,
//!
//! where L is the load carried by cylinder 1: its growing weight along the gravity ramp, f + m g under
//! the wall. The springs accumulate ρ dψ − R_c dθ and dx₂ + R_f dθ. Differentiated with respect to ψ this
//! is a linear 3×3 system for (ρ′, θ′, L′), regular also where L has a maximum (docs/theory.md, Eqs. 10, 15
//! and 36 to 40).

use super::events::{Event, Path, PathPoint, half_angle_tangent, locate, outward_displacement};
use super::limit::Limit;
use super::root::bracketed_root;
use crate::stack::Stack;
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

/// Force laws of a contact, in k_n r, as functions of its overlap in r.
pub trait SpringLaw {
    /// Normal force at an overlap.
    fn normal_force(&self, overlap: f64) -> f64;
    /// Derivative of the normal force with respect to the overlap.
    fn normal_stiffness(&self, overlap: f64) -> f64;
    /// Overlap under a normal force.
    fn overlap(&self, normal_force: f64) -> f64;
    /// Tangential force per tangential displacement at an overlap.
    fn tangential_stiffness(&self, overlap: f64) -> f64;
}

/// The paper's springs: k_n = 1, k_t = 1/κ.
#[derive(Debug, Clone, Copy)]
pub struct LinearSprings {
    /// k_t in units of k_n.
    pub tangential_stiffness: f64,
}

impl SpringLaw for LinearSprings {
    fn normal_force(&self, overlap: f64) -> f64 {
        overlap
    }

    fn normal_stiffness(&self, _overlap: f64) -> f64 {
        1.0
    }

    fn overlap(&self, normal_force: f64) -> f64 {
        normal_force
    }

    fn tangential_stiffness(&self, _overlap: f64) -> f64 {
        self.tangential_stiffness
    }
}

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
    fn from_array(
        [
            turned,
            load,
            pair_overlap,
            rotation,
            pair_shear,
            floor_shear,
        ]: [f64; 6],
    ) -> Self {
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

    fn scaled(self, factor: f64) -> [f64; 6] {
        self.to_array().map(|component| component * factor)
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

/// Everything about the contacts that does not change along the path.
#[derive(Debug, Clone, Copy)]
struct Contacts<Law> {
    law: Law,
    pair_arm: f64,
    floor_arm: f64,
    epsilon: f64,
}

impl<Law: SpringLaw> Contacts<Law> {
    /// Derivative of the state with respect to ψ (docs/theory.md, Eqs. 37 to 39).
    fn derivative(&self, state: &State, leg: Leg) -> State {
        let (sin, cos) = libm::sincos(FRAC_PI_6 + state.turned);
        let distance = 2.0 - state.pair_overlap;
        let floor_force = leg.floor_force(state.load, self.epsilon);
        let floor_overlap = self.law.overlap(floor_force);
        let normal = self.law.normal_force(state.pair_overlap);
        let normal_stiffness = self.law.normal_stiffness(state.pair_overlap);
        let pair_tangential = self.law.tangential_stiffness(state.pair_overlap);
        let floor_tangential = self.law.tangential_stiffness(floor_overlap);
        let floor_overlap_slope =
            leg.floor_force_slope() / self.law.normal_stiffness(floor_overlap);
        let pair_radius = 1.0 + self.pair_arm * state.pair_overlap;
        let floor_radius = 1.0 + self.floor_arm * floor_overlap;
        let (b, e) = (state.pair_shear, state.floor_shear);

        // Rows: torque on 2, horizontal force on 2, vertical force on 1. Columns: ρ′, θ′, L′.
        let system = Matrix3::new(
            -b * self.pair_arm - floor_tangential * floor_radius * sin,
            -pair_tangential * pair_radius * pair_radius
                - floor_tangential * floor_radius * floor_radius,
            -e * self.floor_arm * floor_overlap_slope,
            (normal_stiffness + floor_tangential) * sin,
            -pair_tangential * pair_radius * cos + floor_tangential * floor_radius,
            0.0,
            -2.0 * normal_stiffness * cos,
            -2.0 * pair_tangential * pair_radius * sin,
            -1.0,
        );
        let known = Vector3::new(
            (pair_tangential * pair_radius - floor_tangential * floor_radius * cos) * distance,
            (pair_tangential + floor_tangential) * distance * cos - normal * cos - b * sin,
            2.0 * (pair_tangential * distance * sin - normal * sin + b * cos),
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
            pair_shear: pair_tangential * (distance - pair_radius * rotation_slope),
            floor_shear: floor_tangential
                * (distance_slope * sin + distance * cos + floor_radius * rotation_slope),
        }
    }

    fn point(&self, state: &State, leg: Leg) -> PathPoint {
        let floor_force = leg.floor_force(state.load, self.epsilon);
        PathPoint {
            tangent: half_angle_tangent(state.turned),
            pair_overlap: state.pair_overlap,
            floor_overlap: self.law.overlap(floor_force),
            outward: outward_displacement(state.turned, state.pair_overlap),
            pair_ratio: state.pair_shear / self.law.normal_force(state.pair_overlap),
            floor_ratio: state.floor_shear / floor_force,
            wall_force: match leg {
                Leg::GravityRamp => 0.0,
                Leg::Wall => state.load - self.epsilon,
            },
        }
    }
}

/// One leg as an initial value problem in the path parameter.
struct LegEquation<'a, Law> {
    contacts: &'a Contacts<Law>,
    leg: Leg,
    first_turn: f64,
}

impl<Law: SpringLaw> ODE<f64, [f64; 6]> for LegEquation<'_, Law> {
    fn diff(&self, _parameter: f64, state: &[f64; 6], slope: &mut [f64; 6]) {
        let state = State::from_array(*state);
        let angle_per_parameter = match self.leg {
            Leg::GravityRamp => self.first_turn,
            Leg::Wall => state.turned,
        };
        *slope = self
            .contacts
            .derivative(&state, self.leg)
            .scaled(angle_per_parameter);
    }
}

/// The followed path: states at the stations, and the means to go on from any of them.
struct FollowedPath<Law> {
    contacts: Contacts<Law>,
    /// The angle turned under gravity, to first order in ε.
    first_turn: f64,
    /// The parameter at which gravity is complete; infinite if the stack cannot carry its own weight.
    settled: f64,
    knots: Vec<(f64, State)>,
}

impl<Law: SpringLaw> FollowedPath<Law> {
    /// Follows the path until cylinder 1 has sunk to the level of the others, or no equilibrium follows.
    fn new(contacts: Contacts<Law>) -> Self {
        let origin = State::from_array([0.0; 6]);
        let initial_slope = contacts.derivative(&origin, Leg::GravityRamp);
        let mut path = Self {
            first_turn: contacts.epsilon / initial_slope.load,
            contacts,
            settled: f64::INFINITY,
            knots: vec![(0.0, origin)],
        };
        path.follow_gravity();
        path.follow_wall();
        path
    }

    fn last(&self) -> (f64, State) {
        self.knots[self.knots.len() - 1]
    }

    fn follow_gravity(&mut self) {
        let epsilon = self.contacts.epsilon;
        let end = LARGEST_TURN / self.first_turn;
        loop {
            let (from, state) = self.last();
            let spacing = from.clamp(FIRST_STATION, RAMP_SPACING);
            let to = (from + spacing).min(end);
            let Some(next) = self.advance((from, state), to) else {
                return;
            };
            if next.load >= epsilon {
                let missing = |parameter: f64| {
                    let reached = self.advance((from, state), parameter);
                    reached.map_or(f64::NAN, |state| state.load / epsilon - 1.0)
                };
                let Some(settled) = bracketed_root(missing, from, to) else {
                    return;
                };
                let Some(state) = self.advance((from, state), settled) else {
                    return;
                };
                self.settled = settled;
                self.knots.push((settled, state));
                return;
            }
            self.knots.push((to, next));
            if to >= end {
                return;
            }
        }
    }

    fn follow_wall(&mut self) {
        if self.settled.is_infinite() {
            return;
        }
        let length = libm::log(LARGEST_TURN / self.last().1.turned);
        let count = (length / WALL_SPACING).ceil().max(0.0) as usize;
        for index in 1..=count {
            let to = self.settled + length * index as f64 / count as f64;
            let Some(state) = self.advance(self.last(), to) else {
                return;
            };
            self.knots.push((to, state));
        }
    }

    fn leg_at(&self, parameter: f64) -> Leg {
        if parameter <= self.settled {
            Leg::GravityRamp
        } else {
            Leg::Wall
        }
    }

    fn advance(&self, (from, state): (f64, State), to: f64) -> Option<State> {
        if from == to {
            return Some(state);
        }
        let equation = LegEquation {
            contacts: &self.contacts,
            leg: self.leg_at(to),
            first_turn: self.first_turn,
        };
        let method = ExplicitRungeKutta::dop853()
            .rtol(RELATIVE_TOLERANCE)
            .atol(RELATIVE_TOLERANCE * 1e-3 * self.contacts.epsilon);
        let solution = IVP::ode(&equation, from, to, state.to_array())
            .method(method)
            .solve()
            .ok()?;
        let end = *solution.y.last()?;
        let valid = end.iter().all(|component| component.is_finite());
        valid.then(|| State::from_array(end))
    }
}

impl<Law: SpringLaw> Path for FollowedPath<Law> {
    fn stations(&self) -> Vec<f64> {
        self.knots[1..]
            .iter()
            .map(|&(parameter, _)| parameter)
            .collect()
    }

    fn settled(&self) -> f64 {
        self.settled
    }

    fn point(&self, parameter: f64) -> PathPoint {
        let after = self.knots.partition_point(|&(knot, _)| knot <= parameter);
        let knot = self.knots[after.saturating_sub(1)];
        let lost = State::from_array([f64::NAN; 6]);
        let state = self.advance(knot, parameter).unwrap_or(lost);
        self.contacts.point(&state, self.leg_at(parameter))
    }
}

/// The quasi-static limit of `stack` for any torque arms.
pub fn followed_limit(stack: &Stack, pair_arm: f64, floor_arm: f64) -> Limit {
    let path = FollowedPath::new(Contacts {
        law: LinearSprings {
            tangential_stiffness: stack.tangential_stiffness(),
        },
        pair_arm,
        floor_arm,
        epsilon: stack.epsilon(),
    });
    let slip = locate(&path, Event::FloorSlip, stack);
    Limit::of(&path, slip, stack, pair_arm, floor_arm)
}
