//! Every measured property beside the declared one.

use super::experiments::ContactKind;
use super::finding::Property;
use super::normal::NormalLaw;
use super::regression::Measured;
use super::sliding::SlidingLaw;
use super::tangential::TangentialLaw;
use crate::model::{
    ContactConvention, ContactTest, CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce,
};

/// Properties of the normal force at `kind`; only `pull` differs between codes.
pub fn normal_properties(
    kind: ContactKind,
    law: &NormalLaw,
    pull: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let declared = test.convention.law(test.stiffness_ratio);
    let pulls = match test.convention.tensile_force {
        TensileForce::MayPull => 1.0,
        TensileForce::NeverPulls => 0.0,
    };
    vec![
        Property::at(
            kind,
            "normal_stiffness",
            law.stiffness,
            declared.normal_stiffness,
        ),
        Property::at(kind, "normal_damping", law.damping, declared.damping_normal),
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
    let declared = convention.law(test.stiffness_ratio);
    let arms = match kind {
        ContactKind::Pair => convention.arms.pair,
        ContactKind::Floor | ContactKind::Wall => convention.arms.floor,
    };
    let mut properties = vec![
        Property::at(
            kind,
            "tangential_stiffness",
            law.stiffness,
            declared.tangential_stiffness,
        ),
        Property::at(
            kind,
            "tangential_damping",
            law.damping,
            declared.damping_tangential,
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
