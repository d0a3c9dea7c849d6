//! The largest speed at which the top wall touches the stack without making the floor slide.

use crate::dem::compress_stack;
use crate::model::{Case, ContactConvention, Preparation, Protocol, Sampling, Stack};
use crate::series::Sample;

/// Wall speed of the trial, in which the native DEM touches the settled stack, in units of ε.
const TRIAL_SPEED: f64 = 1.0;
/// Time for which the trial is watched: the overshoot comes within 10, for κ = 50 within 20.
const TRIAL_TIME: f64 = 60.0;
const TRIAL_TIME_STEP: f64 = 0.1;
/// Interval between the rows of the trial, a single step: near the speed at which the floor slides, e/d lies above μ
/// for two or three steps only.
const TRIAL_INTERVAL: f64 = TRIAL_TIME_STEP;
/// Friction of the trial, at which nothing slides.
const NO_LIMIT: f64 = 1e3;
/// Part of the computed speed that counts as gentle: displacements are small, but not infinitely so, and integrators
/// differ.
const MARGIN: f64 = 0.9;
/// Allowance for the rounding of planned speeds to six digits.
const LEAST_DIGITS: f64 = 1.0 + 1e-5;

/// The largest wall speed, in r √(k_n/m), whose first touch does not make the floor slide; infinite where no
/// speed does.
///
/// Until it touches, the wall carries nothing; then its damper takes up η_n v at once, and the bottom cylinders
/// are pushed apart before they are pressed down: e/d at the floor overshoots its path of equilibria, the more
/// the smaller κ. For fast walls it reaches 0.56 at κ = 1.08 and 0.31 at κ = 2.5. A floor that has slid keeps
/// its displacement, by which the yield force changes for good, and no extrapolation in the speed removes it:
/// +5 × 10⁻⁵ of F at κ = 1.2, 1/ε = 10⁵, μ = 0.35 and speeds of 18, 35 and 70 ε.
///
/// Displacements are small in the touch, so that the forces are those at rest plus a part linear in the speed. One
/// trial without sliding therefore tells at which v the ratio |e₀ + v e₁(t)|/(d₀ + v d₁(t)) reaches μ.
pub fn max_touch_speed(stack: &Stack, convention: &ContactConvention) -> f64 {
    let trial = trial(stack, convention);
    // If not even the trial stays finite, no speed is gentle.
    let Ok(series) = compress_stack(&trial, || true) else {
        return 0.0;
    };
    let forces = |sample: &Sample| {
        let contact = sample.first(stack);
        [-contact.tangential, contact.normal]
    };
    let Some([e0, d0]) = series.samples().first().map(forces) else {
        return 0.0;
    };
    let speed = trial.protocol.wall_speed;
    let mu = stack.floor_friction;
    let reached = series.samples().iter().flat_map(|sample| {
        let [e, d] = forces(sample);
        let [e1, d1] = [(e - e0) / speed, (d - d0) / speed];
        // ±(e₀ + v e₁) = μ (d₀ + v d₁), solved for v.
        [1.0, -1.0].map(|sign| {
            let growth = sign * e1 - mu * d1;
            let room = mu * d0 - sign * e0;
            if growth > 0.0 {
                room / growth
            } else {
                f64::INFINITY
            }
        })
    });
    MARGIN * reached.fold(f64::INFINITY, f64::min).max(0.0)
}

/// Whether the floor does not slide when a wall of this speed touches the stack.
pub(super) fn is_gentle(wall_speed: f64, stack: &Stack, convention: &ContactConvention) -> bool {
    is_surely_gentle(wall_speed, stack)
        || wall_speed <= LEAST_DIGITS * max_touch_speed(stack, convention)
}

/// Whether a wall of this speed is gentle without a trial: at half a weight m g per unit time the overshoot of e/d is
/// lost in the growth of e/d itself.
pub(super) fn is_surely_gentle(wall_speed: f64, stack: &Stack) -> bool {
    wall_speed <= 0.5 * stack.epsilon()
}

fn trial(stack: &Stack, convention: &ContactConvention) -> Case {
    let wall_speed = TRIAL_SPEED * stack.epsilon();
    let time_scale = stack.time_scale(convention);
    Case {
        stack: Stack {
            floor_friction: NO_LIMIT,
            cylinder_friction: NO_LIMIT,
            ..*stack
        },
        convention: *convention,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 100.0 * time_scale,
                rest_time: 100.0 * time_scale,
            },
            time_step: TRIAL_TIME_STEP,
            wall_speed,
            wall_travel: wall_speed * TRIAL_TIME * time_scale,
            sampling: Sampling {
                coarse_interval: TRIAL_INTERVAL,
                fine_from_travel: 0.0,
                fine_interval: TRIAL_INTERVAL,
            },
            shortcuts: None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Stack;

    fn stack(floor_friction: f64, stiffness_ratio: f64) -> Stack {
        Stack {
            stiffness_ratio,
            ..Stack::paper(floor_friction, 1e6)
        }
    }

    /// Largest e/d in any step of a touch at `speed`, without sliding.
    fn overshoot(stack: &Stack, speed: f64) -> f64 {
        let mut case = trial(stack, &ContactConvention::TURNING);
        case.protocol.sampling.coarse_interval = case.protocol.time_step;
        case.protocol.sampling.fine_interval = case.protocol.time_step;
        case.protocol.wall_travel *= speed / case.protocol.wall_speed;
        case.protocol.wall_speed = speed;
        let series = compress_stack(&case, || true).unwrap();
        let ratios = series.samples().iter();
        ratios
            .map(|sample| {
                let contact = sample.first(stack);
                (contact.tangential / contact.normal).abs()
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn at_the_limit_of_gentle_speeds_the_floor_just_does_not_slide() {
        for (mu, kappa) in [(0.3, 1.1), (0.35, 1.2), (0.4, 1.6), (0.3, 2.5)] {
            let stack = stack(mu, kappa);
            let speed = max_touch_speed(&stack, &ContactConvention::TURNING);
            assert!(overshoot(&stack, speed) < mu, "{mu} {kappa}");
            assert!(
                overshoot(&stack, 1.02 * speed / MARGIN) > mu,
                "{mu} {kappa}"
            );
        }
    }

    #[test]
    fn a_rough_floor_below_a_soft_tangential_spring_bears_any_speed() {
        let speed = max_touch_speed(&stack(0.5, 2.5), &ContactConvention::TURNING);
        assert_eq!(speed, f64::INFINITY);
    }
}
