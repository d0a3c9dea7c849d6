//! Arms of a contact: the lever of its torque, and the radius at which its surfaces move.

use super::validity::{InvalidValue, within};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Smallest and largest arm coefficient. Beyond them an overlap of a hundredth of the radius moves an arm by more than the
/// radius itself, so that it is no longer a correction of it.
pub const ARM_RANGE: [f64; 2] = [-100.0, 100.0];

/// Arm coefficients r₁ of one kind of contact: an arm is R = r + r₁ δ at the overlap δ.
///
/// In a reciprocal law both are equal: what the contact force does on the turning cylinders is then what its
/// springs and dampers take up. In a case file, a kinematic arm that is left out is the torque arm.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(from = "WrittenArms", bound(deserialize = "Self: From<WrittenArms>"))]
pub struct ContactArms<N = f64> {
    /// r₁ of the torque, R f_t.
    #[serde(rename = "torque_arm")]
    pub torque: N,
    /// r₁ of the surface velocity, v_t − R ω, which stretches the spring and is damped.
    #[serde(rename = "kinematic_arm")]
    pub kinematic: N,
}

/// [`ContactArms`] as a case file spells them.
#[derive(Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
struct WrittenArms {
    /// r₁ of the torque, R f_t.
    torque_arm: f64,
    /// r₁ of the surface velocity, v_t − R ω, which stretches the spring and is damped; left out, it is the torque arm.
    kinematic_arm: Option<f64>,
}

impl From<WrittenArms> for ContactArms {
    fn from(written: WrittenArms) -> Self {
        Self {
            torque: written.torque_arm,
            kinematic: written.kinematic_arm.unwrap_or(written.torque_arm),
        }
    }
}

impl ContactArms {
    /// The same coefficient for torque and surface velocity.
    pub const fn reciprocal(coefficient: f64) -> Self {
        Self {
            torque: coefficient,
            kinematic: coefficient,
        }
    }

    fn validate(&self, key: &str) -> Result<(), InvalidValue> {
        let [least, most] = ARM_RANGE;
        within(&format!("{key}.torque_arm"), self.torque, least, most)?;
        within(&format!("{key}.kinematic_arm"), self.kinematic, least, most)
    }
}

impl fmt::Display for ContactArms {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { torque, kinematic } = self;
        write!(formatter, "{torque}")?;
        if torque == kinematic {
            return Ok(());
        }
        write!(formatter, " (kinematic {kinematic})")
    }
}

/// Arms of every contact of a stack.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(
    default,
    bound(deserialize = "ContactArms<N>: Deserialize<'de>, N: Default")
)]
#[cfg_attr(
    feature = "schema",
    schemars(bound = "N: schemars::JsonSchema + Default + Serialize")
)]
pub struct Arms<N = f64> {
    /// Cylinder–cylinder contacts.
    pub pair: ContactArms<N>,
    /// Cylinder–wall contacts, the floor's above all.
    pub floor: ContactArms<N>,
}

impl<N> Arms<N> {
    /// Converts every coefficient with `number`.
    pub fn map<M>(self, mut number: impl FnMut(N) -> M) -> Arms<M> {
        let mut map = |arms: ContactArms<N>| ContactArms {
            torque: number(arms.torque),
            kinematic: number(arms.kinematic),
        };
        Arms {
            pair: map(self.pair),
            floor: map(self.floor),
        }
    }
}

impl Arms {
    /// The paper's: every arm is the radius of the undeformed cylinder.
    pub const PAPER: Self = Self::reciprocal(0.0, 0.0);

    /// One coefficient for pairs and one for walls; torque and surface velocity share it.
    pub const fn reciprocal(pair: f64, floor: f64) -> Self {
        Self {
            pair: ContactArms::reciprocal(pair),
            floor: ContactArms::reciprocal(floor),
        }
    }

    /// Checks every coefficient; the error names the first that is out of range.
    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        self.pair.validate("convention.pair")?;
        self.floor.validate("convention.floor")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kinematic_arm_that_is_left_out_is_the_torque_arm() {
        let arms: Arms = toml::from_str(
            "pair = { torque_arm = -0.5, kinematic_arm = 0.0 }\nfloor = { torque_arm = -1.0 }",
        )
        .unwrap();
        assert_eq!((arms.pair.torque, arms.pair.kinematic), (-0.5, 0.0));
        assert_eq!(arms.floor, ContactArms::reciprocal(-1.0));
        assert_eq!(toml::from_str::<Arms>("").unwrap(), Arms::PAPER);
    }

    #[test]
    fn arms_are_shown_as_one_number_where_they_are_one() {
        assert_eq!(ContactArms::reciprocal(-0.5).to_string(), "-0.5");
        let apart = ContactArms {
            torque: -0.5,
            kinematic: 0.0,
        };
        assert_eq!(apart.to_string(), "-0.5 (kinematic 0)");
    }
}
