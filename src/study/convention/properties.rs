//! What a code declares, property by property, and the verdict on what was measured of each.

use super::experiments::ContactKind;
use super::normal::NormalLaw;
use super::regression::Measured;
use super::sliding::SlidingLaw;
use super::tangential::TangentialLaw;
use crate::code::Code;
use crate::model::{
    ContactConvention, ContactTest, CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce,
};
use crate::study::Verdict;
use serde::{Deserialize, Serialize};

/// Largest deviation of an external code that agrees, relative to the declared value (to 1 where that is
/// 0): a tenth of the bar for yield forces, and a thousand times what was ever seen.
pub const TOLERANCE: f64 = 1e-6;

/// The same for the native code, whose rounding alone is between it and its declaration.
pub const NATIVE_TOLERANCE: f64 = 1e-9;

/// A property of one code, measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Whose.
    pub code: Code,
    /// In which version.
    pub version: String,
    /// Its name.
    pub property: String,
    /// What was measured; absent if it could not be.
    pub measured: Option<f64>,
    /// Three standard errors; absent with the measured value.
    pub uncertainty: Option<f64>,
    /// What the adapter declares.
    pub declared: f64,
    /// What follows.
    pub verdict: Verdict,
}

/// A property with its measured and its declared value.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Name, beginning with the kind if it belongs to one.
    pub name: String,
    /// As measured.
    pub measured: Measured,
    /// As declared.
    pub declared: f64,
}

impl Property {
    /// A property of the whole code.
    pub fn new(name: &str, measured: Measured, declared: f64) -> Self {
        Self {
            name: name.to_owned(),
            measured,
            declared,
        }
    }

    /// A property of the contacts at `kind`.
    pub fn at(kind: ContactKind, name: &str, measured: Measured, declared: f64) -> Self {
        Self::new(&format!("{}_{name}", kind.as_str()), measured, declared)
    }

    /// The verdict, as a row for `code`.
    pub fn judge(self, code: Code, version: &str) -> Finding {
        let scale = if self.declared == 0.0 {
            1.0
        } else {
            self.declared.abs()
        };
        let relative = if code == Code::Native {
            NATIVE_TOLERANCE
        } else {
            TOLERANCE
        };
        let Measured { value, uncertainty } = self.measured;
        let known = value.is_finite() && uncertainty.is_finite();
        Finding {
            code,
            version: version.to_owned(),
            property: self.name,
            measured: known.then_some(value),
            uncertainty: known.then_some(uncertainty),
            declared: self.declared,
            verdict: Verdict::of(value - self.declared, uncertainty, relative * scale),
        }
    }
}

/// Properties of the normal force at `kind`, which every code shares but for `pull`.
pub fn normal_properties(
    kind: ContactKind,
    law: &NormalLaw,
    pull: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let convention = &test.convention;
    let pulls = match convention.tensile_force {
        TensileForce::MayPull => 1.0,
        TensileForce::NeverPulls => 0.0,
    };
    vec![
        Property::at(kind, "normal_stiffness", law.stiffness, 1.0),
        Property::at(kind, "normal_damping", law.damping, convention.damping(1.0)),
        Property::at(kind, "overlap_lead", law.overlap_lead, 0.0),
        Property::at(kind, "damping_velocity_lag", law.velocity_lag, 0.5),
        Property::at(kind, "pull", pull, pulls),
    ]
}

/// Properties of a sticking contact at `kind`.
pub fn tangential_properties(
    kind: ContactKind,
    law: &TangentialLaw,
    test: &ContactTest,
) -> Vec<Property> {
    let convention = &test.convention;
    let stiffness = test.tangential_stiffness();
    let arms = match kind {
        ContactKind::Pair => convention.arms.pair,
        ContactKind::Floor | ContactKind::Wall => convention.arms.floor,
    };
    let mut properties = vec![
        Property::at(kind, "tangential_stiffness", law.stiffness, stiffness),
        Property::at(
            kind,
            "tangential_damping",
            law.damping,
            convention.damping(stiffness),
        ),
        Property::at(kind, "radius", law.radius, 1.0),
        Property::at(kind, "torque_arm", law.torque_arm, arms.torque),
        Property::at(kind, "kinematic_arm", law.kinematic_arm, arms.kinematic),
        Property::at(kind, "damping_arm", law.damping_arm, arms.kinematic),
    ];
    if kind == ContactKind::Pair {
        let declared = match convention.history_update {
            HistoryUpdate::Rotated => 0.0,
            HistoryUpdate::Projected => -1.0,
            HistoryUpdate::Linearised => 1.0,
        };
        properties.push(Property::at(
            kind,
            "history_update",
            law.transport,
            declared,
        ));
    }
    properties
}

/// Properties of a sliding contact at `kind`.
pub fn sliding_properties(
    kind: ContactKind,
    law: &SlidingLaw,
    operand_damping: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let friction = match kind {
        ContactKind::Pair => test.cylinder_friction,
        ContactKind::Floor | ContactKind::Wall => test.floor_friction,
    };
    let memory = match test.convention.sliding_spring {
        SlidingSpring::Frozen => 1.0,
        SlidingSpring::FollowsLimit => 0.0,
    };
    vec![
        Property::at(kind, "friction", law.friction, friction),
        Property::at(
            kind,
            "coulomb_damping_share",
            operand_damping,
            damping_share(&test.convention),
        ),
        Property::at(kind, "sliding_damping", law.damping, 0.0),
        Property::at(kind, "sliding_spring_memory", law.memory, memory),
    ]
}

/// How much of the damping counts in the Coulomb operand.
fn damping_share(convention: &ContactConvention) -> f64 {
    match convention.coulomb_operand {
        CoulombOperand::SpringAndDamping => 1.0,
        CoulombOperand::Spring => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_declared_value_has_a_tolerance_of_its_own() {
        let verdict = |measured: f64, declared: f64| {
            let property = Property::new("damping", Measured::new(measured, 0.0), declared);
            property.judge(Code::Yade, "").verdict
        };
        assert_eq!(verdict(0.067 * (1.0 + 0.9e-6), 0.067), Verdict::Agrees);
        assert_eq!(verdict(0.067 * (1.0 + 1.1e-6), 0.067), Verdict::Differs);
        assert_eq!(verdict(0.9e-6, 0.0), Verdict::Agrees);
        assert_eq!(verdict(1.1e-6, 0.0), Verdict::Differs);
    }
}
