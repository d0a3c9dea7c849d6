//! An impact in which the surfaces slide on one another from beginning to end: the tangential force is μ |N| all the time,
//! whatever tangential spring and damping are.
//!
//! The normal motion of a pair feels the turn of its line of centres; so both motions are integrated together
//! (docs/theory.md, section 12.3).

use super::normal::NormalImpact;
use crate::model::{ContactLaw, Impact, ImpactTarget, TensileForce};
use crate::theory::bracketed_root;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

const TOLERANCE: f64 = 1e-13;

/// What friction has changed after an impact with sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingChange {
    /// Of the tangential velocity, in r √(k_n/m): of the cylinder along the floor, or of one cylinder of a pair relative to
    /// the other, which is their relative angular momentum over the distance 2 at which they touch.
    pub tangential_velocity: f64,
    /// Of the spin of each cylinder, in √(k_n/m).
    pub spin: f64,
}

/// The exact change by `impact`, in which the surfaces must slide all the time; `None` if the integration fails.
pub fn sliding_change(impact: &Impact) -> Option<SlidingChange> {
    Equations::of(impact).solve(impact.approach_speed)
}

/// State: overlap, its rate, r times the relative tangential velocity, and change of spin.
type State = [f64; 4];

struct Equations {
    law: ContactLaw,
    mass: f64,
    friction: f64,
    torque_arm: f64,
    moment_of_inertia: f64,
    never_pulls: bool,
    target: ImpactTarget,
    expected_duration: f64,
}

impl Equations {
    fn of(impact: &Impact) -> Self {
        let normal = NormalImpact::of(impact);
        Self {
            law: impact.law(),
            mass: normal.mass(),
            friction: impact.friction,
            torque_arm: impact.target.arms(&impact.convention).torque,
            moment_of_inertia: impact.convention.moment_of_inertia,
            never_pulls: impact.convention.tensile_force == TensileForce::NeverPulls,
            target: impact.target,
            expected_duration: normal.force_duration(),
        }
    }

    /// Normal force, negative where it would pull.
    fn force(&self, state: &State) -> f64 {
        let own = self.law.at(state[0]);
        own.secant * state[0] + own.damping_normal * state[1]
    }

    /// From the touch until the force is 0 for good.
    fn solve(&self, speed: f64) -> Option<SlidingChange> {
        let touch = [0.0, speed, 0.0, 0.0];
        let (before, after) = (0.5 * self.expected_duration, 1.5 * self.expected_duration);
        let middle = self.advance(touch, before, speed)?;
        let left = |time: f64| {
            let state = self.advance(middle, time - before, speed);
            state.map_or(f64::NAN, |state| match self.never_pulls {
                true => self.force(&state),
                false => state[0],
            })
        };
        let end = bracketed_root(left, before, after)?;
        let [_, _, momentum, spin] = self.advance(middle, end - before, speed)?;
        let distance = match self.target {
            ImpactTarget::Pair => 2.0,
            ImpactTarget::Floor => 1.0,
        };
        Some(SlidingChange {
            tangential_velocity: momentum / distance,
            spin,
        })
    }

    fn advance(&self, from: State, time: f64, speed: f64) -> Option<State> {
        if time == 0.0 {
            return Some(from);
        }
        let method = ExplicitRungeKutta::dop853()
            .rtol(TOLERANCE)
            .atol(TOLERANCE * speed * self.friction);
        let solution = IVP::ode(self, 0.0, time, from)
            .method(method)
            .solve()
            .ok()?;
        solution.y.last().copied()
    }
}

impl ODE<f64, State> for Equations {
    fn diff(&self, _time: f64, state: &State, slope: &mut State) {
        let [overlap, rate, momentum, _] = *state;
        let pushing = self.force(state);
        let normal = if self.never_pulls {
            pushing.max(0.0)
        } else {
            pushing
        };
        let friction = self.friction * normal.abs();
        let arm = 1.0 + self.torque_arm * overlap;
        // The floor is a body of infinite radius: nothing turns.
        let (distance, turning) = match self.target {
            ImpactTarget::Floor => (1.0, 0.0),
            ImpactTarget::Pair => {
                let distance = 2.0 - overlap;
                (
                    distance,
                    momentum * momentum / (distance * distance * distance),
                )
            }
        };
        *slope = [
            rate,
            -normal / self.mass - turning,
            distance * friction / self.mass,
            arm * friction / self.moment_of_inertia,
        ];
    }
}
