//! The balance of forces along the path of equilibria, for any arms and contact law.
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

use super::super::events::{PathPoint, half_angle_tangent, outward_displacement};
use crate::model::{Arms, ContactConvention, ContactLaw, Stack};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::FRAC_PI_6;

/// The state that is integrated.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    /// ψ − 30°.
    pub(super) turned: f64,
    /// L, load carried by cylinder 1.
    pub(super) load: f64,
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
    pub(super) fn from_array(state: [f64; 6]) -> Self {
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

    pub(super) fn to_array(self) -> [f64; 6] {
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
    pub(super) fn outward(&self) -> f64 {
        outward_displacement(self.turned, self.pair_overlap)
    }
}

/// The two legs of the path, which differ in how the floor load d grows with L.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Leg {
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

/// Where a path begins.
pub(super) struct Beginning {
    /// The angle turned under gravity, to first order in ε.
    pub(super) first_turn: f64,
    /// The state from which the path is followed.
    pub(super) state: State,
    /// Whether contact 2–3 is closed from there on.
    pub(super) closed: bool,
}

/// Constants of the contacts along a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contacts {
    law: ContactLaw,
    arms: Arms,
    pub(super) epsilon: f64,
    pub(super) bottom: BottomContact,
}

impl Contacts {
    pub(super) fn new(
        stack: &Stack,
        convention: &ContactConvention,
        bottom: BottomContact,
    ) -> Self {
        Self {
            law: convention.law(stack.stiffness_ratio),
            arms: convention.arms,
            epsilon: stack.epsilon(),
            bottom,
        }
    }

    /// The beginning of the path, which has a slope at the origin.
    pub(super) fn beginning(&self) -> Beginning {
        let origin = State::from_array([0.0; 6]);
        let open_slope = self.derivative(&origin, Leg::GravityRamp, false);
        let closed = self.bottom == BottomContact::Followed && moves_inwards(&open_slope);
        let slope = self.derivative(&origin, Leg::GravityRamp, closed);
        Beginning {
            first_turn: self.epsilon / slope.load,
            state: origin,
            closed,
        }
    }

    /// Derivative of the state with respect to ψ, with contact 2–3 closed or open (docs/theory.md,
    /// Eqs. 37 to 39 and 52).
    pub(super) fn derivative(&self, state: &State, leg: Leg, closed: bool) -> State {
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

    pub(super) fn point(&self, state: &State, leg: Leg) -> PathPoint {
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

/// Whether cylinder 2 begins to move inwards from the stress-free state.
fn moves_inwards(slope: &State) -> bool {
    // dy/dψ = ρ′ sin ψ + ρ cos ψ at ψ = 30°, ρ = 2.
    let outward_slope = 3f64.sqrt() - 0.5 * slope.pair_overlap;
    outward_slope < 0.0
}
