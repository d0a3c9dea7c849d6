//! The normal impact in closed form, where the damping ratio is the same at every overlap.
//!
//! With s = δ^((p+1)/2) in place of the overlap δ, and τ in place of the time, dt = 2/(p+1) s^(−q) dτ with
//! q = (p−1)/(p+1), the equation m δ̈ = −K δᵖ − c δ^((p−1)/2) δ̇ is that of a damped linear oscillator,
//! m s″ = −2/(p+1) (K s + c s′), and s′ is the speed dδ/dt (docs/theory.md, section 12.1).

use super::{NormalImpact, slope_without_force};
use crate::model::{ContactLaw, Impact, TensileForce};
use gauss_quad::{FiniteAboveNegOneF64, GaussJacobi};
use std::f64::consts::PI;
use std::num::NonZeroUsize;

/// Without its singular factors at the ends, the integrand of a duration is analytic within an ellipse whose semi-axes
/// add up to more than 5.8 half lengths. The error of n nodes is therefore below 5.8⁻²ⁿ, and 12 nodes leave only
/// round-off.
const NODES: NonZeroUsize = NonZeroUsize::new(12).expect("12 is not zero");

/// The oscillator of an impact. A phase is its frequency times τ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Oscillator {
    law: ContactLaw,
    power: f64,
    /// Speed of approach.
    speed: f64,
    tensile_force: TensileForce,
    /// Decay rate in τ.
    decay: f64,
    /// Angular frequency in τ.
    frequency: f64,
}

impl Oscillator {
    /// The oscillator of `impact`; its frequency is NaN if it is damped more than critically.
    pub(super) fn of(impact: &Impact) -> Self {
        let law = impact.law();
        let (power, mass) = (law.power.value(), impact.target.effective_mass());
        let decay = law.damping_normal / ((power + 1.0) * mass);
        let undamped = 2.0 * law.normal_stiffness / ((power + 1.0) * mass);
        Self {
            law,
            power,
            speed: impact.approach_speed,
            tensile_force: impact.convention.tensile_force,
            decay,
            frequency: (undamped - decay * decay).sqrt(),
        }
    }

    /// Computes every number of the impact.
    pub(super) fn impact(&self) -> NormalImpact {
        let release = self.force_changes_sign();
        let (depth, fastest) = (self.overlap(release), -self.velocity(release));
        let greatest_overlap = self.overlap(libm::atan2(self.frequency, self.decay));
        let whole = self.time_to_the_end();
        match self.tensile_force {
            TensileForce::MayPull => {
                let speed = -self.velocity(PI);
                let pulls = self.decay > 0.0;
                let slope = slope_without_force(&self.law, depth, fastest);
                NormalImpact {
                    greatest_overlap,
                    restitution: speed / self.speed,
                    force_duration: whole,
                    duration: whole,
                    total_impulse: self.speed + fastest + (fastest - speed),
                    slope_at_sign_change: if pulls { slope } else { 0.0 },
                }
            }
            TensileForce::NeverPulls => {
                let force_duration = whole - self.time_of_pulling();
                NormalImpact {
                    greatest_overlap,
                    restitution: fastest / self.speed,
                    force_duration,
                    duration: force_duration + depth / fastest,
                    total_impulse: self.speed + fastest,
                    slope_at_sign_change: 0.0,
                }
            }
        }
    }

    /// The phase of the oscillator at which force and s″ are 0.
    fn force_changes_sign(&self) -> f64 {
        PI - self.phase_of_pulling()
    }

    fn phase_of_pulling(&self) -> f64 {
        let (decay, frequency) = (self.decay, self.frequency);
        libm::atan2(
            2.0 * decay * frequency,
            frequency * frequency - decay * decay,
        )
    }

    /// exp(−decay τ) at a phase of the oscillator.
    fn left(&self, phase: f64) -> f64 {
        libm::exp(-self.decay / self.frequency * phase)
    }

    /// dδ/dt at a phase.
    fn velocity(&self, phase: f64) -> f64 {
        let slowing = self.decay / self.frequency * libm::sin(phase);
        self.speed * self.left(phase) * (libm::cos(phase) - slowing)
    }

    /// δ at a phase; 0 where rounding would make it negative.
    fn overlap(&self, phase: f64) -> f64 {
        let s = self.speed / self.frequency * self.left(phase) * libm::sin(phase);
        let s = if s < 0.0 { 0.0 } else { s };
        libm::pow(s, 2.0 / (self.power + 1.0))
    }

    /// q.
    fn singularity(&self) -> f64 {
        (self.power - 1.0) / (self.power + 1.0)
    }

    /// The time from the touch to the phase π.
    fn time_to_the_end(&self) -> f64 {
        let ends = -self.singularity();
        self.time(PI, [ends, ends], |x| {
            let phase = 0.5 * PI * (1.0 + x);
            (phase, libm::cos(0.5 * PI * x) / (1.0 - x * x))
        })
    }

    /// The time from the change of sign of the force to the phase π.
    fn time_of_pulling(&self) -> f64 {
        let length = self.phase_of_pulling();
        if length == 0.0 {
            return 0.0;
        }
        self.time(length, [-self.singularity(), 0.0], |x| {
            let before_the_end = 0.5 * length * (1.0 + x);
            (PI - before_the_end, libm::sin(before_the_end) / (1.0 + x))
        })
    }

    /// ∫ 2/(p+1) s^(−q) dτ over a `length` of phases, with x running from −1 to 1. `at` returns the phase at x, and
    /// its sine without the factors (1 + x) and (1 − x), whose powers are the `weights`.
    fn time(&self, length: f64, weights: [f64; 2], at: impl Fn(f64) -> (f64, f64)) -> f64 {
        let [lower, upper] = weights.map(FiniteAboveNegOneF64::new);
        let (Some(lower), Some(upper)) = (lower, upper) else {
            return f64::NAN;
        };
        let integral = GaussJacobi::new(NODES, upper, lower).integrate(-1.0, 1.0, |x| {
            let (phase, sine) = at(x);
            let s = self.speed / self.frequency * self.left(phase) * sine;
            libm::pow(s, -self.singularity())
        });
        2.0 / (self.power + 1.0) * 0.5 * length / self.frequency * integral
    }
}
