//! Every measured property beside the declared one.

use super::experiments::ContactKind;
use super::finding::{
    CUBED_TURN, DAMPING_VELOCITY_LAG, EXPONENT, HISTORY_UPDATE, OVERLAP_LEAD, Property, TOLERANCE,
};
use super::finding::{
    FORCE_EXPONENT, NORMAL_DAMPING_EXPONENT, RADIUS, SPRING_RADIUS, TANGENTIAL_DAMPING_EXPONENT,
    TANGENTIAL_EXPONENT,
};
use super::normal::LinearNormalLaw;
use super::power::NormalPowerLaw;
use super::regression::Measured;
use super::sliding::SlidingLaw;
use super::tangential::TangentialLaw;
use crate::model::{ContactLaw, ContactTest, CoulombOperand, DampingGrowth, HistoryUpdate};
use crate::model::{SlidingSpring, TensileForce};

/// Alternatives of a convention, each with the value of the property that shows it: the share of the damping in the
/// operand.
pub const OPERANDS: [(CoulombOperand, f64); 2] = [
    (CoulombOperand::SpringAndDamping, 1.0),
    (CoulombOperand::Spring, 0.0),
];
/// The same for the memory of a spring that has slid.
pub const SLIDING_SPRINGS: [(SlidingSpring, f64); 2] = [
    (SlidingSpring::Frozen, 1.0),
    (SlidingSpring::FollowsLimit, 0.0),
];
/// The same for springs that turn with their contacts: the change of their length in units of 1 − cos dψ. If nothing
/// turns a spring, its tangential component changes as that of a projected one, beside [`LEFT_BEHIND`].
pub const HISTORY_UPDATES: [(HistoryUpdate, f64); 3] = [
    (HistoryUpdate::Rotated, 0.0),
    (HistoryUpdate::Projected, -1.0),
    (HistoryUpdate::Linearised, 1.0),
];
/// Name, without the kind of contact, of the share of its normal component that a spring keeps when the contact
/// turns: 1 if nothing turns the spring; not reported for springs that turn.
pub const LEFT_BEHIND: &str = "spring_left_behind";
/// Alternatives for the fraction of a pulling force that is exerted, each with the value that shows it.
pub const TENSILE_FORCES: [(TensileForce, f64); 2] = [
    (TensileForce::MayPull, 1.0),
    (TensileForce::NeverPulls, 0.0),
];

/// The value that shows `own` among `alternatives`.
fn shown<T: PartialEq>(alternatives: &[(T, f64)], own: &T) -> f64 {
    let found = alternatives.iter().find(|(one, _)| one == own);
    found.map_or(f64::NAN, |(_, value)| *value)
}

/// A property of the contacts of one kind: name, as measured, as declared.
type Row = (&'static str, Measured, f64);

fn at(kind: ContactKind, rows: impl IntoIterator<Item = Row>) -> Vec<Property> {
    let rows = rows.into_iter();
    let named = rows.map(|(name, measured, declared)| Property::at(kind, name, measured, declared));
    named.collect()
}

/// Properties of the normal force at `kind`; only `pull` differs between codes.
pub fn normal_properties(
    kind: ContactKind,
    law: &LinearNormalLaw,
    pull: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let declared = test.convention.law(test.stiffness_ratio);
    let pulls = shown(&TENSILE_FORCES, &test.convention.tensile_force);
    let rows = [
        ("normal_stiffness", law.stiffness, declared.normal_stiffness),
        ("normal_damping", law.damping, declared.damping_normal),
        (OVERLAP_LEAD, law.overlap_lead, 0.0),
        (DAMPING_VELOCITY_LAG, law.velocity_lag, 0.5),
        ("pull", pull, pulls),
    ];
    at(kind, rows)
}

/// Properties of a normal force of any power at `kind`. Damping whose growth no manifest can declare is measured
/// without a declared value: no limit depends on it.
pub fn power_properties(
    kind: ContactKind,
    law: &NormalPowerLaw,
    pull: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let declared = declared_law(kind, test);
    let power = declared.power.value();
    let pulls = shown(&TENSILE_FORCES, &test.convention.tensile_force);
    let damping = GrowingDamping {
        names: ["normal_damping", NORMAL_DAMPING_EXPONENT],
        coefficient: law.damping,
        exponent: law.damping_exponent,
        stiffness_exponent: Measured::new(law.exponent.value - 1.0, law.exponent.uncertainty),
        declared: (declared.damping_normal, declared.damping, power - 1.0),
    };
    let damping = damping.rows(kind);
    let exponent = Property::at(kind, FORCE_EXPONENT, law.exponent, power);
    // No limit depends on the stiffness of the top wall, which may be a body of another kind than the floor.
    let stiffness = declared.normal_stiffness;
    let stiffness = Property {
        declared: (kind != ContactKind::Wall).then_some(stiffness),
        ..Property::at(kind, "normal_stiffness", law.stiffness, stiffness)
    };
    let after = [
        (OVERLAP_LEAD, law.overlap_lead, 0.0),
        (DAMPING_VELOCITY_LAG, law.velocity_lag, 0.5),
        ("pull", pull, pulls),
    ];
    let before = [exponent, stiffness].into_iter();
    before.chain(damping).chain(at(kind, after)).collect()
}

/// The law that `test` asks for at `kind`.
pub fn declared_law(kind: ContactKind, test: &ContactTest) -> ContactLaw {
    match kind {
        ContactKind::Pair => test.convention.law(test.stiffness_ratio),
        ContactKind::Floor | ContactKind::Wall => test.convention.wall_law(test.stiffness_ratio),
    }
}

/// Damping that grows with the overlap, beside a stiffness that does.
struct GrowingDamping {
    names: [&'static str; 2],
    coefficient: Measured,
    exponent: Measured,
    stiffness_exponent: Measured,
    /// Coefficient, growth, and exponent of the stiffness.
    declared: (f64, DampingGrowth, f64),
}

impl GrowingDamping {
    /// Coefficient and exponent, beside the declared ones unless no manifest can declare such a growth or such a
    /// body: the top wall may be of another kind than the floor.
    fn rows(&self, kind: ContactKind) -> [Property; 2] {
        let (coefficient, growth, stiffness_exponent) = self.declared;
        let open = self.exponent.uncertainty + self.stiffness_exponent.uncertainty;
        let found = |growth: DampingGrowth| {
            let exponent = share_of_stiffness(growth) * self.stiffness_exponent.value;
            (self.exponent.value - exponent).abs() <= open.max(TOLERANCE)
        };
        let mut growths = DampingGrowth::ALL.into_iter();
        let can_be_declared = kind != ContactKind::Wall && growths.any(found);
        let exponent = share_of_stiffness(growth) * stiffness_exponent;
        let rows = [(self.coefficient, coefficient), (self.exponent, exponent)];
        std::array::from_fn(|index| {
            let (measured, declared) = rows[index];
            Property {
                declared: can_be_declared.then_some(declared),
                ..Property::at(kind, self.names[index], measured, declared)
            }
        })
    }
}

/// The exponent of the damping over that of the stiffness.
fn share_of_stiffness(growth: DampingGrowth) -> f64 {
    match growth {
        DampingGrowth::ConstantRatio => 0.5,
        DampingGrowth::Viscoelastic => 1.0,
    }
}

/// The exponent with which a `stiffness` that is not as declared grows with the overlap, if `growing` finds one.
pub fn growth(stiffness: &Property, growing: impl Fn() -> Option<Measured>) -> Option<Property> {
    let name = stiffness.name.strip_suffix("_stiffness")?;
    let declared = stiffness.declared?;
    let off = (stiffness.measured.value / declared - 1.0).abs();
    if off.max(stiffness.measured.uncertainty / declared) <= TOLERANCE {
        return None;
    }
    let measured = growing()?;
    Some(Property::new(&format!("{name}{EXPONENT}"), measured, 0.0))
}

/// Properties of a sticking contact at `kind`.
pub fn tangential_properties(
    kind: ContactKind,
    law: &TangentialLaw,
    test: &ContactTest,
) -> Vec<Property> {
    let convention = &test.convention;
    let declared = declared_law(kind, test);
    let (stiffness, damping) = (declared.tangential_stiffness, declared.damping_tangential);
    let arms = match kind {
        ContactKind::Pair => convention.arms.pair,
        ContactKind::Floor | ContactKind::Wall => convention.arms.floor,
    };
    let is_fixed = !convention.history_update.turns();
    let update = match is_fixed {
        true => shown(&HISTORY_UPDATES, &HistoryUpdate::Projected),
        false => shown(&HISTORY_UPDATES, &convention.history_update),
    };
    let turns = (kind == ContactKind::Pair).then_some((HISTORY_UPDATE, law.transport, update));
    let none = is_fixed.then(|| match law.transport.uncertainty.is_finite() {
        true => Measured::new(0.0, law.unseen_share),
        false => Measured::UNKNOWN,
    });
    let left_behind = law
        .left_behind
        .or(none)
        .filter(|_| kind == ContactKind::Pair);
    let left_behind = left_behind.map(|own| (LEFT_BEHIND, own, share(is_fixed)));
    let rows = [
        ("tangential_stiffness", law.stiffness, stiffness),
        ("tangential_damping", law.damping, damping),
        (RADIUS, law.radius, 1.0),
        (SPRING_RADIUS, law.spring_radius, 1.0),
        ("torque_arm", law.torque_arm, arms.torque),
        ("kinematic_arm", law.kinematic_arm, arms.kinematic),
        ("damping_arm", law.damping_arm, arms.kinematic),
    ];
    let power = law.exponent.map(|power| (TANGENTIAL_EXPONENT, power, 0.0));
    let rows = power.into_iter().chain(rows);
    let rows = rows.chain(turns).chain(left_behind);
    let third_order = law.third_order.map(|own| Property {
        declared: None,
        ..Property::at(kind, CUBED_TURN, own, 0.0)
    });
    at(kind, rows).into_iter().chain(third_order).collect()
}

/// Properties of a sticking contact at `kind` beside a `normal` force of any power.
pub fn growing_properties(
    kind: ContactKind,
    law: &TangentialLaw,
    normal: &NormalPowerLaw,
    test: &ContactTest,
) -> Vec<Property> {
    let Some(shape) = law.shape else {
        return Vec::new();
    };
    let declared = declared_law(kind, test);
    let exponent = declared.power.value() - 1.0;
    let stiffening = share(declared.stiffens);
    let ratio = declared.power.value() * declared.normal_stiffness / declared.tangential_stiffness;
    let stiffness = [
        (TANGENTIAL_EXPONENT, shape.stiffness_exponent, exponent),
        ("tangential_stiffening", shape.stiffening, stiffening),
        ("stiffness_ratio", stiffness_ratio(normal, law), ratio),
    ];
    let memory = [
        (
            "history_force_share",
            shape.force_share,
            share(declared.history.keeps_force()),
        ),
        (
            "history_rescaling",
            shape.rescaling,
            share(declared.history.is_rescaled()),
        ),
    ];
    let damping = GrowingDamping {
        names: ["tangential_damping", TANGENTIAL_DAMPING_EXPONENT],
        coefficient: law.damping,
        exponent: shape.damping_exponent,
        stiffness_exponent: shape.stiffness_exponent,
        declared: (declared.damping_tangential, declared.damping, exponent),
    };
    let [damping, damping_exponent] = damping.rows(kind);
    let others = tangential_properties(kind, law, test).into_iter();
    let others = others.map(|own| match own.name == damping.name {
        true => damping.clone(),
        false => own,
    });
    // If the stiffness is the same at every overlap, remembering a displacement or a force makes no difference.
    let memory = memory.into_iter().filter(|(_, measured, _)| {
        measured.value.is_finite() || !shape.stiffness_exponent.value.is_finite()
    });
    let own = at(kind, stiffness).into_iter().chain(at(kind, memory));
    own.chain(others).chain([damping_exponent]).collect()
}

/// 1 for yes, 0 for no.
fn share(yes: bool) -> f64 {
    f64::from(u8::from(yes))
}

/// κ = p K/k_t.
fn stiffness_ratio(normal: &NormalPowerLaw, law: &TangentialLaw) -> Measured {
    let (p, k) = (normal.exponent, normal.stiffness);
    let uncertainty = (p.value * k.uncertainty).hypot(k.value * p.uncertainty);
    Measured::new(p.value * k.value, uncertainty).over(law.stiffness)
}

/// Properties of a sliding contact at `kind`; `operand_damping` is the share of the damping in the Coulomb operand.
pub fn sliding_properties(
    kind: ContactKind,
    law: &SlidingLaw,
    operand_damping: Measured,
    test: &ContactTest,
) -> Vec<Property> {
    let share = shown(&OPERANDS, &test.convention.coulomb_operand);
    let memory = shown(&SLIDING_SPRINGS, &test.convention.sliding_spring);
    let rows = [
        ("friction", law.friction, kind.friction(test)),
        ("coulomb_damping_share", operand_damping, share),
        ("sliding_damping", law.damping, 0.0),
        ("sliding_spring_memory", law.memory, memory),
    ];
    at(kind, rows)
}
