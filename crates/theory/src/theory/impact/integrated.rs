//! Impacts by integration of the equations of motion: with any damping, and with surfaces that slide on each other
//! from beginning to end, where the tangential force is μ |N| whatever the tangential spring and damping.
//!
//! The normal motion of a pair depends on the rotation of its line of centres, so both motions are integrated together
//! (docs/theory.md, section 12.3).

use super::{NormalImpact, slope_without_force};
use crate::model::{ContactLaw, Impact, ImpactTarget, TensileForce};
use crate::theory::bracketed_root;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};

const TOLERANCE: f64 = 1e-13;
/// Maximum number of strides in the search for an event; an undamped impact takes about twelve.
const MOST_STRIDES: usize = 1000;

/// The effect of friction after an impact with sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingChange {
    /// Change of the tangential velocity, in r √(k_n/m): of the cylinder along the floor, or of one cylinder of a pair
    /// relative to the other, that is their relative angular momentum over the distance 2 at which they touch.
    pub tangential_velocity: f64,
    /// Change of the spin of each cylinder, in √(k_n/m).
    pub spin: f64,
}

/// Returns the normal motion of `impact`; `None` if the integration fails.
pub fn integrated_impact(impact: &Impact) -> Option<NormalImpact> {
    let equations = Equations {
        friction: 0.0,
        ..Equations::of(impact)
    };
    let deepest = equations.next(equations.touch(), |state| state.rate)?;
    let release = equations.next(deepest, |state| equations.force(state))?;
    let (speed, fastest) = (impact.approach_speed, -release.rate);
    let known = NormalImpact {
        greatest_overlap: deepest.overlap,
        restitution: fastest / speed,
        force_duration: release.time,
        duration: release.time + release.overlap / fastest,
        total_impulse: speed + fastest,
        slope_at_sign_change: 0.0,
    };
    if equations.never_pulls {
        return Some(known);
    }
    let end = equations.next(release, |state| state.overlap)?;
    let pulls = equations.law.damping_normal > 0.0;
    let slope = slope_without_force(&equations.law, release.overlap, fastest);
    Some(NormalImpact {
        restitution: -end.rate / speed,
        force_duration: end.time,
        duration: end.time,
        total_impulse: speed + fastest + (fastest + end.rate),
        slope_at_sign_change: if pulls { slope } else { 0.0 },
        ..known
    })
}

/// Returns the change that friction makes in `impact`, during which the surfaces must slide all the time; `None` if
/// the integration fails.
pub fn sliding_change(impact: &Impact) -> Option<SlidingChange> {
    let equations = Equations::of(impact);
    let deepest = equations.next(equations.touch(), |state| state.rate)?;
    // |N| has a kink here, so the integration restarts.
    let release = equations.next(deepest, |state| equations.force(state))?;
    let end = match equations.never_pulls {
        true => release,
        false => equations.next(release, |state| state.overlap)?,
    };
    Some(SlidingChange {
        tangential_velocity: end.momentum / equations.touching_distance(),
        spin: end.spin,
    })
}

/// The state at one moment.
#[derive(Debug, Clone, Copy)]
struct State {
    time: f64,
    overlap: f64,
    /// dδ/dt.
    rate: f64,
    /// Distance times relative tangential velocity; at the floor, whose distance counts as 1, a velocity.
    momentum: f64,
    /// Change of the spin.
    spin: f64,
}

struct Equations {
    law: ContactLaw,
    mass: f64,
    speed: f64,
    friction: f64,
    torque_arm: f64,
    moment_of_inertia: f64,
    never_pulls: bool,
    target: ImpactTarget,
    /// A part of the duration in which at most one event happens.
    stride: f64,
}

impl Equations {
    fn of(impact: &Impact) -> Self {
        let (law, mass) = (impact.law(), impact.target.effective_mass());
        let speed = impact.approach_speed;
        let energy = 0.5 * mass * speed * speed;
        let power = law.power.value();
        let undamped = libm::pow(
            (power + 1.0) * energy / law.normal_stiffness,
            1.0 / (power + 1.0),
        );
        Self {
            law,
            mass,
            speed,
            friction: impact.friction,
            torque_arm: impact.target.arms(&impact.convention).torque,
            moment_of_inertia: impact.convention.moment_of_inertia,
            never_pulls: impact.convention.tensile_force == TensileForce::NeverPulls,
            target: impact.target,
            stride: 0.25 * undamped / speed,
        }
    }

    fn touch(&self) -> State {
        State {
            time: 0.0,
            overlap: 0.0,
            rate: self.speed,
            momentum: 0.0,
            spin: 0.0,
        }
    }

    /// Distance of a touching pair, or 1 for the floor, where the momentum is a velocity.
    fn touching_distance(&self) -> f64 {
        match self.target {
            ImpactTarget::Pair => 2.0,
            ImpactTarget::Floor => 1.0,
        }
    }

    /// The force by the law, negative where it would pull.
    fn force(&self, state: &State) -> f64 {
        let own = self.law.at(state.overlap);
        own.normal_force(state.overlap, state.rate)
    }

    /// Returns the next state in which `event`, positive before, is 0.
    fn next(&self, from: State, event: impl Fn(&State) -> f64) -> Option<State> {
        let mut last = from;
        for _ in 0..MOST_STRIDES {
            if event(&last) <= 0.0 {
                return Some(last);
            }
            let next = self.advance(last, self.stride)?;
            if event(&next) <= 0.0 {
                let value =
                    |time: f64| self.advance(last, time).map_or(f64::NAN, |own| event(&own));
                let time = bracketed_root(value, 0.0, self.stride)?;
                return self.advance(last, time);
            }
            last = next;
        }
        None
    }

    fn advance(&self, from: State, time: f64) -> Option<State> {
        if time == 0.0 {
            return Some(from);
        }
        let smallest = if self.friction == 0.0 {
            1.0
        } else {
            self.friction
        };
        let method = ExplicitRungeKutta::dop853()
            .rtol(TOLERANCE)
            .atol(TOLERANCE * self.speed * smallest);
        let State {
            overlap,
            rate,
            momentum,
            spin,
            ..
        } = from;
        let solution = IVP::ode(self, 0.0, time, [overlap, rate, momentum, spin]);
        let solution = solution.method(method).solve().ok()?;
        let &[overlap, rate, momentum, spin] = solution.y.last()?;
        Some(State {
            time: from.time + time,
            overlap,
            rate,
            momentum,
            spin,
        })
    }
}

impl ODE<f64, [f64; 4]> for Equations {
    fn diff(&self, _time: f64, values: &[f64; 4], slope: &mut [f64; 4]) {
        let [overlap, rate, momentum, _] = *values;
        let own = self.law.at(overlap);
        let pushing = own.normal_force(overlap, rate);
        let normal = if self.never_pulls {
            pushing.max(0.0)
        } else {
            pushing
        };
        let friction = self.friction * normal.abs();
        let arm = 1.0 + self.torque_arm * overlap;
        // The floor is a body of infinite radius: the line of contact does not turn.
        let (distance, turning) = match self.target {
            ImpactTarget::Floor => (1.0, 0.0),
            ImpactTarget::Pair => {
                let distance = 2.0 - overlap;
                let cube = distance * distance * distance;
                (distance, momentum * momentum / cube)
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
