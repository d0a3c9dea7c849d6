//! What a code declares, property by property, and the verdict on what was measured of each.

use super::experiments::Site;
use super::normal::NormalLaw;
use super::regression::Measured;
use super::sliding::SlidingLaw;
use super::tangential::TangentialLaw;
use crate::engine::EngineName;
use crate::stack::{
    ContactTest, Convention, CoulombOperand, SeparatingForce, SlidingSpring, SpringTransport,
};
use crate::verdict::Verdict;
use serde::{Deserialize, Serialize};

/// Largest deviation of an external code that agrees, relative to the declared value (to 1 where that is
/// 0): a tenth of the bar for yield forces, and a thousand times what was ever seen.
pub const TOLERANCE: f64 = 1e-6;

/// The same for the native engine, whose rounding alone is between it and its declaration.
pub const NATIVE_TOLERANCE: f64 = 1e-9;

/// A property of one engine, measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Whose.
    pub engine: EngineName,
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
    /// Name, beginning with the site if it belongs to one.
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

    /// A property of the contacts at `site`.
    pub fn at(site: Site, name: &str, measured: Measured, declared: f64) -> Self {
        Self::new(&format!("{}_{name}", site.as_str()), measured, declared)
    }

    /// The verdict, as a row for `engine`.
    pub fn judge(self, engine: EngineName, version: &str) -> Finding {
        let scale = if self.declared == 0.0 {
            1.0
        } else {
            self.declared.abs()
        };
        let relative = if engine == EngineName::Native {
            NATIVE_TOLERANCE
        } else {
            TOLERANCE
        };
        let Measured { value, uncertainty } = self.measured;
        let known = value.is_finite() && uncertainty.is_finite();
        Finding {
            engine,
            version: version.to_owned(),
            property: self.name,
            measured: known.then_some(value),
            uncertainty: known.then_some(uncertainty),
            declared: self.declared,
            verdict: Verdict::of(value - self.declared, uncertainty, relative * scale),
        }
    }
}

/// Properties of the normal force at `site`, which every code shares but for `pull`.
pub fn normal_properties(
    site: Site,
    law: &NormalLaw,
    pull: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let convention = &test.convention;
    let pulls = match convention.separating_force {
        SeparatingForce::MayPull => 1.0,
        SeparatingForce::NeverPulls => 0.0,
    };
    vec![
        Property::at(site, "normal_stiffness", law.stiffness, 1.0),
        Property::at(site, "normal_damping", law.damping, convention.damping(1.0)),
        Property::at(site, "overlap_lead", law.overlap_lead, 0.0),
        Property::at(site, "damping_velocity_lag", law.velocity_lag, 0.5),
        Property::at(site, "pull", pull, pulls),
    ]
}

/// Properties of a sticking contact at `site`.
pub fn tangential_properties(site: Site, law: &TangentialLaw, test: &ContactTest) -> Vec<Property> {
    let convention = &test.convention;
    let stiffness = test.tangential_stiffness();
    let arm = match site {
        Site::Pair => convention.pair_arm,
        Site::Floor | Site::Wall => convention.floor_arm,
    };
    let mut properties = vec![
        Property::at(site, "tangential_stiffness", law.stiffness, stiffness),
        Property::at(
            site,
            "tangential_damping",
            law.damping,
            convention.damping(stiffness),
        ),
        Property::at(site, "radius", law.radius, 1.0),
        Property::at(site, "torque_arm", law.torque_arm, arm),
        Property::at(site, "kinematic_arm", law.kinematic_arm, arm),
        Property::at(site, "damping_arm", law.damping_arm, arm),
    ];
    if site == Site::Pair {
        let declared = match convention.spring_transport {
            SpringTransport::Rotated => 0.0,
            SpringTransport::Projected => -1.0,
            SpringTransport::Linearised => 1.0,
        };
        properties.push(Property::at(
            site,
            "spring_transport",
            law.transport,
            declared,
        ));
    }
    properties
}

/// Properties of a sliding contact at `site`.
pub fn sliding_properties(
    site: Site,
    law: &SlidingLaw,
    operand_damping: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let friction = match site {
        Site::Pair => test.cylinder_friction,
        Site::Floor | Site::Wall => test.floor_friction,
    };
    let memory = match test.convention.sliding_spring {
        SlidingSpring::Frozen => 1.0,
        SlidingSpring::FollowsLimit => 0.0,
    };
    vec![
        Property::at(site, "friction", law.friction, friction),
        Property::at(
            site,
            "coulomb_damping_share",
            operand_damping,
            damping_share(&test.convention),
        ),
        Property::at(site, "sliding_damping", law.damping, 0.0),
        Property::at(site, "sliding_spring_memory", law.memory, memory),
    ]
}

/// How much of the damping counts in the Coulomb operand.
fn damping_share(convention: &Convention) -> f64 {
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
            property.judge(EngineName::Yade, "").verdict
        };
        assert_eq!(verdict(0.067 * (1.0 + 0.9e-6), 0.067), Verdict::Agrees);
        assert_eq!(verdict(0.067 * (1.0 + 1.1e-6), 0.067), Verdict::Differs);
        assert_eq!(verdict(0.9e-6, 0.0), Verdict::Agrees);
        assert_eq!(verdict(1.1e-6, 0.0), Verdict::Differs);
    }
}
