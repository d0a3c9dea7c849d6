//! What a code means by "contact": where the torque acts and how much a collision dissipates.

use super::validity::{InvalidValue, within};
use serde::{Deserialize, Serialize};

/// Restitution coefficient e_r of the paper (supplement I.A).
pub const PAPER_RESTITUTION: f64 = 0.7;

/// Contact convention of a code.
///
/// The torque arm of a contact is R = r + r₁ δ with the overlap δ; the same arm enters the torque and
/// the surface velocity. The paper sets r₁ = 0; other codes do not, and above μ_c that alone moves the
/// yield force by up to 20 %.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Convention {
    /// Arm coefficient r₁ of cylinder–cylinder contacts.
    pub pair_arm: f64,
    /// Arm coefficient r₁ of cylinder–floor contacts.
    pub floor_arm: f64,
    /// Restitution coefficient e_r, in (0, 1], of normal and tangential damping.
    #[serde(default = "paper_restitution")]
    pub restitution: f64,
}

fn paper_restitution() -> f64 {
    PAPER_RESTITUTION
}

impl Convention {
    /// The paper's convention: arms 0 and 0, restitution 0.7.
    pub const PAPER: Self = Self::with_arms(0.0, 0.0);

    /// A convention with the given arms and the paper's restitution.
    pub const fn with_arms(pair_arm: f64, floor_arm: f64) -> Self {
        Self {
            pair_arm,
            floor_arm,
            restitution: PAPER_RESTITUTION,
        }
    }

    /// Damping coefficient η = −2 ln e_r √(m k/(π² + ln² e_r)) of a spring with stiffness k, in
    /// √(m k_n) (paper, Eqs. S1 and S2).
    pub fn damping(&self, stiffness: f64) -> f64 {
        let log = libm::log(self.restitution);
        let pi = std::f64::consts::PI;
        2.0 * log.abs() * (stiffness / (pi * pi + log * log)).sqrt()
    }

    /// Every value in its range, or the first one that is not.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        within("convention.pair_arm", self.pair_arm, -1.0, 1.0)?;
        within("convention.floor_arm", self.floor_arm, -1.0, 1.0)?;
        within("convention.restitution", self.restitution, 1e-3, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damping_gives_the_restitution_it_is_named_after() {
        // Half an oscillation of a unit mass on a unit spring with damping η keeps the fraction
        // exp(−π ζ/√(1 − ζ²)) of its speed, ζ = η/2.
        let ratio = Convention::PAPER.damping(1.0) / 2.0;
        let kept = libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
        assert!((kept - PAPER_RESTITUTION).abs() < 1e-15);
    }

    #[test]
    fn an_elastic_collision_is_not_damped() {
        let elastic = Convention {
            restitution: 1.0,
            ..Convention::PAPER
        };
        assert_eq!(elastic.damping(1.0).to_bits(), 0);
    }
}
