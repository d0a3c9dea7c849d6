//! The convention that the properties of a code show, where its manifest says nothing.

use super::finding::{FORCE_LAG, Property, TOLERANCE};
use super::properties::{HISTORY_UPDATES, LEFT_BEHIND, OPERANDS, SLIDING_SPRINGS, TENSILE_FORCES};
use super::regression::Measured;
use crate::code::{ConventionKey, Declaration, Settled, Unknown};
use crate::model::{ARM_RANGE, HistoryUpdate};

/// Finest decimal that a measured number keeps. Rounding by half of it moves the yield force by less than a hundredth of
/// the least tolerance.
const FINEST: f64 = 1e-9;

/// Uncertainty up to which an arm is known: with a larger one it cannot be told from the next of the usual ones (0, −1/2,
/// −1).
const KNOWN_ARM: f64 = 0.25;

const NOT_SHOWN: &str = "its motions do not show it";

/// The declared convention, with what `properties` show of the keys that `declaration` leaves out.
pub(super) fn settled(declaration: &Declaration, properties: &[Property]) -> Settled {
    let mut settled = declaration.unsettled("");
    settled.unknown.clear();
    let lag = properties.iter().find(|own| own.name == FORCE_LAG);
    settled.force_lag = lag.map_or(0.0, |own| own.measured.value.max(0.0));
    for &key in &declaration.left_out {
        let own = properties.iter().filter(|own| own.key() == Some(key));
        let own: Vec<&Property> = own.collect();
        if let Err(because) = take(&mut settled, key, &own) {
            let unknown = Unknown::new(key, because);
            let moves_limit =
                unknown.moves_limit && !(key == ConventionKey::HistoryUpdate && turns(&own));
            settled.unknown.push(Unknown {
                moves_limit,
                ..unknown
            });
        }
    }
    settled
}

/// Puts what `properties` show of `key` into `settled`, or says why they do not decide it.
fn take(settled: &mut Settled, key: ConventionKey, properties: &[&Property]) -> Result<(), String> {
    let mut found = settled.clone();
    let convention = &mut found.convention;
    match key {
        ConventionKey::CoulombOperand => {
            convention.coulomb_operand = alternative(&OPERANDS, properties)?;
        }
        ConventionKey::SlidingSpring => {
            convention.sliding_spring = alternative(&SLIDING_SPRINGS, properties)?;
        }
        ConventionKey::HistoryUpdate => {
            convention.history_update = history_update(properties)?;
        }
        ConventionKey::TensileForce => {
            convention.tensile_force = alternative(&TENSILE_FORCES, properties)?;
        }
        ConventionKey::MomentOfInertia => {
            let measured = number(properties)?;
            convention.moment_of_inertia = measured.value;
            found.inertia_uncertainty = measured.uncertainty;
        }
        ConventionKey::VelocityLag => {
            let measured = number(properties)?;
            found.velocity_lag = measured.value;
            found.lag_uncertainty = measured.uncertainty;
        }
        _ => {
            let Measured { value, uncertainty } = in_range(number(properties)?, ARM_RANGE);
            let open = known(properties)?[0].measured.uncertainty;
            if open > KNOWN_ARM {
                return Err(format!(
                    "its motions show it to within {open:.1} alone, and arms are told apart to within {KNOWN_ARM}"
                ));
            }
            key.set_arm(&mut convention.arms, value);
            key.set_arm(&mut found.arm_uncertainty, uncertainty);
        }
    }
    let valid = found.convention.validate();
    valid.map_err(|invalid| format!("measured {invalid}"))?;
    *settled = found;
    Ok(())
}

/// The number that `properties`, one or several measurements of the same, agree on: the first of them, rounded to its
/// uncertainty. It is part of the address of a case, which must not depend on digits that mean nothing.
fn number(properties: &[&Property]) -> Result<Measured, String> {
    let known = known(properties)?;
    if properties.first() != known.first() {
        return Err(NOT_SHOWN.to_owned());
    }
    let first = known[0].measured;
    let apart = |own: &&&Property| {
        let allowed = first.uncertainty + own.measured.uncertainty + TOLERANCE;
        (own.measured.value - first.value).abs() > allowed
    };
    if let Some(other) = known.iter().find(apart) {
        return Err(disagreement(known[0], other));
    }
    Ok(rounded(first))
}

/// `measured` to the decimals that are certain; what rounding takes away is added to its uncertainty.
fn rounded(measured: Measured) -> Measured {
    let certain = -libm::ceil(libm::log10(measured.uncertainty.max(FINEST)));
    let decimals = certain.max(0.0) as usize;
    let text = format!("{:.decimals$}", measured.value);
    // Adding zero turns -0 into 0.
    let value = text.parse().unwrap_or(measured.value) + 0.0;
    Measured::new(value, measured.uncertainty + (value - measured.value).abs())
}

/// `measured`, or the end of a range that it leaves by no more than its uncertainty.
fn in_range(measured: Measured, [least, most]: [f64; 2]) -> Measured {
    let end = measured.value.clamp(least, most);
    let beyond = (measured.value - end).abs();
    match beyond <= measured.uncertainty {
        true => Measured::new(end, measured.uncertainty + beyond),
        false => measured,
    }
}

/// What the contact does to its spring as it turns.
fn history_update(properties: &[&Property]) -> Result<HistoryUpdate, String> {
    match is_left_behind(properties)? {
        true => Ok(HistoryUpdate::Fixed),
        false => {
            let turns = properties.iter().filter(|own| !is_share(own));
            alternative(&HISTORY_UPDATES, &turns.copied().collect::<Vec<_>>())
        }
    }
}

/// Whether nothing turns the spring. The share that is left behind is reported only where it is seen or declared.
fn is_left_behind(properties: &[&Property]) -> Result<bool, String> {
    let shares: Vec<&Property> = properties.iter().copied().filter(is_share).collect();
    match shares.is_empty() {
        true => known(properties).map(|_| false),
        false => alternative(&[(true, 1.0), (false, 0.0)], &shares),
    }
}

/// Whether the spring turns with its contact, by whatever rule.
fn turns(properties: &[&Property]) -> bool {
    is_left_behind(properties) == Ok(false)
}

fn is_share(own: &&Property) -> bool {
    own.name.ends_with(LEFT_BEHIND)
}

/// The only one of `alternatives` that `properties` are consistent with.
fn alternative<T: Copy>(alternatives: &[(T, f64)], properties: &[&Property]) -> Result<T, String> {
    let known = known(properties)?;
    let shown = |own: &Property| {
        let Measured { value, uncertainty } = own.measured;
        let near = |shows: f64| (value - shows).abs() <= uncertainty.max(TOLERANCE);
        let mut consistent = (0..alternatives.len()).filter(|&index| near(alternatives[index].1));
        consistent.next().filter(|_| consistent.next().is_none())
    };
    let first = shown(known[0]);
    if let Some(other) = known.iter().find(|own| shown(own) != first) {
        return Err(disagreement(known[0], other));
    }
    let own = known[0];
    first.map(|index| alternatives[index].0).ok_or_else(|| {
        let values: Vec<String> = alternatives.iter().map(|own| own.1.to_string()).collect();
        let (value, values) = (own.measured.value, values.join(" or "));
        format!("{} is {value:.6}, not {values}", own.name)
    })
}

/// The `properties` that could be measured; an error if there are none.
fn known<'a>(properties: &[&'a Property]) -> Result<Vec<&'a Property>, String> {
    let is_known = |own: &&&Property| {
        let Measured { value, uncertainty } = own.measured;
        value.is_finite() && uncertainty.is_finite()
    };
    let known: Vec<&Property> = properties.iter().filter(is_known).copied().collect();
    match known.is_empty() {
        true => Err(NOT_SHOWN.to_owned()),
        false => Ok(known),
    }
}

fn disagreement(one: &Property, other: &Property) -> String {
    format!(
        "{} is {:.6}, and {} is {:.6}",
        one.name, one.measured.value, other.name, other.measured.value
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ContactConvention, SlidingSpring};

    fn property(name: &str, value: f64, uncertainty: f64) -> Property {
        Property {
            declared: None,
            ..Property::new(name, Measured::new(value, uncertainty), 0.0)
        }
    }

    /// The convention after one key is settled, with the reason if it is not.
    fn settled_by(key: ConventionKey, properties: &[Property]) -> Settled {
        let declaration = Declaration {
            convention: ContactConvention::TURNING,
            velocity_lag: 0.5,
            left_out: vec![key],
            in_space: false,
        };
        settled(&declaration, properties)
    }

    fn reason(key: ConventionKey, properties: &[Property]) -> String {
        let unknown = settled_by(key, properties).unknown;
        assert_eq!(unknown.len(), 1, "{unknown:?}");
        unknown[0].because.clone()
    }

    #[test]
    fn a_measured_number_keeps_the_decimals_that_are_certain() {
        for (value, uncertainty, kept) in [
            (-0.500_000_000_3, 4e-10, "-0.5"),
            (-0.333_333_333_3, 0.0, "-0.333333333"),
            (-0.333_333_333_3, 2e-5, "-0.3333"),
            (-1e-13, 1e-12, "0"),
        ] {
            let Measured {
                value: rounded,
                uncertainty: wider,
            } = rounded(Measured::new(value, uncertainty));
            assert_eq!(rounded.to_string(), kept);
            assert!((rounded - value).abs() <= wider && wider >= uncertainty);
        }
    }

    #[test]
    fn an_arm_is_taken_with_its_uncertainty_unless_two_measurements_contradict_each_other() {
        let arm = |of_damping: f64| {
            [
                property("floor_kinematic_arm", -0.25, 1e-7),
                property("floor_damping_arm", of_damping, 1e-6),
            ]
        };
        let found = settled_by(ConventionKey::FloorKinematicArm, &arm(-0.25));
        assert_eq!(found.convention.arms.floor.kinematic, -0.25);
        assert_eq!(found.arm_uncertainty.floor.kinematic, 1e-7);
        assert_eq!(found.unknown, []);
        let why = reason(ConventionKey::FloorKinematicArm, &arm(0.0));
        assert_eq!(
            why,
            "floor_kinematic_arm is -0.250000, and floor_damping_arm is 0.000000"
        );
    }

    #[test]
    fn an_arm_beyond_its_range_by_its_uncertainty_is_the_end_of_the_range() {
        let settled_at = |value: f64| {
            let measured = [property("floor_torque_arm", value, 4e-5)];
            settled_by(ConventionKey::FloorTorqueArm, &measured)
        };
        assert_eq!(settled_at(-1.5).convention.arms.floor.torque, -1.5);
        let [least, _] = ARM_RANGE;
        let found = settled_at(least - 3e-5);
        assert_eq!(found.convention.arms.floor.torque, least);
        assert!(found.arm_uncertainty.floor.torque > 4e-5);
        assert_eq!(settled_at(least - 1e-4).unknown.len(), 1);
    }

    #[test]
    fn an_arm_that_cannot_be_told_from_another_is_not_known() {
        let why = |uncertainty: f64| {
            let measured = [property("floor_torque_arm", -0.7, uncertainty)];
            let found = settled_by(ConventionKey::FloorTorqueArm, &measured);
            let unknown = found.unknown.first().map(|own| own.because.clone());
            (found.knows_limit(), unknown)
        };
        assert_eq!(why(0.1), (true, None));
        let (knows_limit, because) = why(1.0);
        assert!(!knows_limit);
        assert_eq!(
            because.unwrap(),
            "its motions show it to within 1.0 alone, and arms are told apart to within 0.25"
        );
    }

    #[test]
    fn what_no_convention_can_be_is_unknown_with_the_reason() {
        let inertia = [property("moment_of_inertia", 0.1, 1e-9)];
        let why = reason(ConventionKey::MomentOfInertia, &inertia);
        assert!(
            why.contains("`convention.moment_of_inertia` is 0.1"),
            "{why}"
        );
        let dumb = |name: &str| property(name, f64::NAN, f64::INFINITY);
        let why = reason(ConventionKey::PairTorqueArm, &[dumb("pair_torque_arm")]);
        assert_eq!(why, NOT_SHOWN);
        // The arm of the damping alone does not show that of the spring.
        let damping = property("pair_damping_arm", -0.5, 1e-9);
        let why = reason(
            ConventionKey::PairKinematicArm,
            &[dumb("pair_kinematic_arm"), damping],
        );
        assert_eq!(why, NOT_SHOWN);
    }

    /// The limit depends on whether a spring turns, but not on the rule by which it turns.
    #[test]
    fn a_limit_depends_on_whether_a_spring_turns_alone() {
        let transport = |value| property("pair_history_update", value, 1e-8);
        let share = |value| property("pair_spring_left_behind", value, 1e-8);
        let key = ConventionKey::HistoryUpdate;
        for (properties, moves_limit) in [
            (vec![transport(0.3)], false),
            (vec![transport(0.3), share(0.0)], false),
            (vec![transport(-0.25), share(0.25)], true),
            (
                vec![property("pair_history_update", f64::NAN, f64::INFINITY)],
                true,
            ),
        ] {
            let unknown = settled_by(key, &properties).unknown;
            let moves: Vec<bool> = unknown.iter().map(|own| own.moves_limit).collect();
            assert_eq!(moves, [moves_limit], "{unknown:?}");
        }
        let fixed = settled_by(key, &[transport(-1.0), share(1.0)]);
        assert_eq!(fixed.convention.history_update, HistoryUpdate::Fixed);
        assert_eq!(fixed.unknown, []);
    }

    #[test]
    fn a_rule_is_the_only_alternative_that_fits_or_unknown() {
        let memory = |pair: f64, floor: f64| {
            [
                property("pair_sliding_spring_memory", pair, 1e-9),
                property("floor_sliding_spring_memory", floor, 1e-9),
            ]
        };
        let key = ConventionKey::SlidingSpring;
        let found = settled_by(key, &memory(0.0, 0.0));
        assert_eq!(found.convention.sliding_spring, SlidingSpring::FollowsLimit);
        assert_eq!(
            reason(key, &memory(0.3, 0.3)),
            "pair_sliding_spring_memory is 0.300000, not 1 or 0"
        );
        let found = settled_by(key, &memory(f64::NAN, 1.0));
        assert_eq!(found.convention.sliding_spring, SlidingSpring::Frozen);
        assert_eq!(found.unknown, []);
        let why = reason(key, &memory(1.0, 0.0));
        assert!(
            why.contains("floor_sliding_spring_memory is 0.000000"),
            "{why}"
        );
    }
}
