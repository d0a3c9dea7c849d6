//! Damping of contacts: its size at an overlap of r, and its growth with the overlap.

use serde::{Deserialize, Serialize};

/// How the damping coefficients grow with the overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum DampingGrowth {
    /// Like the root of the stiffness: the damping ratio, and hence the restitution, is the same at every overlap.
    #[default]
    ConstantRatio,
    /// Like the stiffness.
    Viscoelastic,
}

impl DampingGrowth {
    /// Every growth.
    pub const ALL: [Self; 2] = [Self::ConstantRatio, Self::Viscoelastic];

    /// The name in case files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::ConstantRatio => "constant-ratio",
            Self::Viscoelastic => "viscoelastic",
        }
    }

    pub(super) fn is_usual(&self) -> bool {
        *self == Self::ConstantRatio
    }
}

/// Returns η for a stiffness, at the damping ratio that gives a free collision this restitution.
pub(super) fn damping(stiffness: f64, restitution: f64, power: f64) -> f64 {
    let log = libm::log(restitution);
    let pi = std::f64::consts::PI;
    let of_power = ((power + 1.0) / (2.0 * power)).sqrt();
    of_power * (2.0 * log.abs() * (stiffness / (pi * pi + log * log)).sqrt())
}

#[cfg(test)]
mod tests {
    use crate::model::{ContactLaw, Law, PAPER_RESTITUTION, Power};

    fn linear(restitution: f64) -> ContactLaw {
        Law::LINEAR.of_pairs(2.5, restitution)
    }

    #[test]
    fn damping_gives_the_restitution_it_is_named_after() {
        // Half an oscillation of a unit mass on a unit spring with damping η keeps the fraction
        // exp(−π ζ/√(1 − ζ²)) of its speed, ζ = η/2.
        let ratio = linear(PAPER_RESTITUTION).damping_normal / 2.0;
        let kept = libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
        assert!((kept - PAPER_RESTITUTION).abs() < 1e-15);
    }

    #[test]
    fn an_elastic_collision_is_not_damped() {
        assert_eq!(linear(1.0).damping_normal.to_bits(), 0);
    }

    /// Restitution of a unit mass that meets the spring at `speed`, by the Runge–Kutta method with time step `step`.
    fn restitution(law: &ContactLaw, speed: f64, step: f64) -> f64 {
        let rate = |[overlap, speed]: [f64; 2]| {
            let own = law.at(overlap.max(0.0));
            [speed, -own.normal_force(overlap, speed)]
        };
        let moved = |from: [f64; 2], by: f64, rate: [f64; 2]| {
            [from[0] + by * rate[0], from[1] + by * rate[1]]
        };
        let mut state = [0.0, speed];
        loop {
            let first = rate(state);
            let second = rate(moved(state, 0.5 * step, first));
            let third = rate(moved(state, 0.5 * step, second));
            let fourth = rate(moved(state, step, third));
            let mean: [f64; 2] = std::array::from_fn(|index| {
                (first[index] + 2.0 * (second[index] + third[index]) + fourth[index]) / 6.0
            });
            let next = moved(state, step, mean);
            if next[0] <= 0.0 {
                return -state[1] / speed;
            }
            state = next;
        }
    }

    #[test]
    fn a_free_collision_has_the_same_restitution_at_every_power_and_speed() {
        for power in Power::ALL {
            for law in [
                Law::of_power(power).of_pairs(2.5, 0.7),
                Law::of_power(power).of_walls(2.5, 0.7),
            ] {
                for speed in [1e-3, 0.1] {
                    // The contact ends within the last step, in which the speed changes by a few times the step.
                    let found = restitution(&law, speed, 1e-4);
                    assert!((found - 0.7).abs() < 1e-3, "{power} {speed} {found}");
                }
            }
        }
    }
}
