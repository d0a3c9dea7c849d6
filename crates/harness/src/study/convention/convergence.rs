//! The properties of a code at vanishing time step, so that every scheme is welcome that converges.
//!
//! The regressions of the probe are exact for a leapfrog and for velocity Verlet. With another scheme what they
//! measure depends on the time step h, as v + a h + b h² + …; then the micro-tests are repeated with shorter and
//! shorter steps until v is known. What is not v yet vanishes with the step, and is no contradiction.

use super::finding::{NEAR_A_RULE, Property, StepEffect, TOLERANCE};
use super::probe::{measure, with_one_radius, without_consequences};
use super::regression::Measured;
use super::rounding::Rounding;
use crate::code::Declaration;
use crate::model::ContactTest;
use crate::series::{ENOUGH_DIGITS, Motion};

/// The time steps of the levels: that of the micro-tests is divided by these (the sequence of Bulirsch and Stoer, which
/// gives the most orders for a number of steps).
const DIVISORS: [u64; 9] = [1, 2, 3, 4, 6, 8, 12, 16, 24];

/// Motions are cut off, where a contact begins to slide, after multiples of this many of the longest steps: at the same
/// moment at every level, although it slides a little earlier or later there.
const GRAIN: u64 = 5;

/// Number of levels from which on a further one must make some property better known.
const ENOUGH_LEVELS: usize = 3;

/// Number of uncertainties by which a value is off beyond doubt.
const BEYOND_DOUBT: f64 = 10.0;

/// Largest value by any rule of what errors of first order hide.
const LARGEST_HIDDEN: f64 = 1.0;

/// Share of a deviation at the longest step that is left of it at a shorter one, if it vanishes with the step: at half
/// the step it is half of one of first order.
pub(crate) const VANISHING: f64 = 0.75;

/// Uncertainty of a time in units of the step, up to which it is the same at every step.
const SMALL_EFFECT: f64 = 1e-2;

/// Measures every property of the contacts of a code at vanishing time step, and pairs it with what is `declared` of
/// it. `run` carries out micro-tests: those of the probe first, and where they contradict the declaration, the same
/// with shorter steps. An error of the latter that `ends_refinement` leaves what is known by then.
///
/// # Errors
/// Those of `run`.
pub fn converged<E>(
    declared: &Declaration,
    mut run: impl FnMut(&[ContactTest]) -> Result<Vec<Motion>, E>,
    ends_refinement: impl Fn(&E) -> bool,
) -> Result<Vec<Property>, E> {
    let mut motions = Vec::new();
    let first = measure(declared, 1, 1, |tests| {
        let own = run(tests)?;
        motions.push(own.clone());
        Ok(own)
    })?;
    let mut first = with_one_radius(first);
    let rounding = Rounding::of(&motions.iter().flatten().collect::<Vec<_>>());
    rounding.widen(&mut first, &motions, |rounded| {
        let mut rounds = rounded.iter();
        let read = measure(declared, 1, 1, |_| rounds.next().cloned().ok_or(()));
        read.unwrap_or_default()
    });
    let mut found = first.clone();
    let mut levels: Vec<Vec<Property>> = Vec::new();
    for divisor in DIVISORS {
        // Rounding to few digits does not vanish with the step.
        if rounding.digits < ENOUGH_DIGITS || rounding.is_single() || !found.iter().any(is_open) {
            break;
        }
        match measure(declared, divisor, GRAIN * divisor, &mut run) {
            Ok(level) => levels.push(level),
            Err(error) if ends_refinement(&error) => break,
            Err(error) => return Err(error),
        }
        if levels.len() == 1 {
            continue;
        }
        let finer = at_vanishing_step(&first, &levels, extrapolated);
        let has_gained = finer.iter().any(|own| gains(own, &found));
        found = finer;
        if levels.len() >= ENOUGH_LEVELS && !has_gained {
            break;
        }
    }
    if levels.len() > 1 {
        found = at_vanishing_step(&first, &levels, at_zero);
    }
    Ok(without_consequences(found))
}

/// Whether a property is declared, but neither as declared nor known to be otherwise. A value from a single time step
/// is not known.
fn is_open(own: &Property) -> bool {
    let Some(declared) = own.declared else {
        return false;
    };
    let Measured { value, uncertainty } = own.measured;
    let error = (value - declared).abs();
    let is_known = own.is_extrapolated && error > BEYOND_DOUBT * uncertainty;
    value.is_finite() && !own.agrees() && !is_known
}

/// Whether the uncertainty of an open property is less than half of what it was in the properties `before`.
fn gains(own: &Property, before: &[Property]) -> bool {
    let before = before.iter().find(|other| other.name == own.name);
    is_open(own)
        && before.is_some_and(|before| own.measured.uncertainty < 0.5 * before.measured.uncertainty)
}

/// The properties at vanishing time step, from those of the probe and of all levels, whose values have this `limit`.
fn at_vanishing_step(
    first: &[Property],
    levels: &[Vec<Property>],
    limit: fn(&[f64]) -> Measured,
) -> Vec<Property> {
    let each = first.iter().map(|own| {
        let same = |level: &Vec<Property>| {
            let alike = level.iter().find(|other| other.name == own.name);
            alike.map(|other| other.measured)
        };
        let alike: Vec<Measured> = levels.iter().filter_map(same).collect();
        match alike.len() == levels.len() {
            true => of_all_levels(own, &alike, limit),
            // It is not seen at every level.
            false => own.clone(),
        }
    });
    let mut found: Vec<Property> = each.collect();
    let mut others = found.iter();
    let has_errors = others.any(|own| own.is_tangential() && own.step_effect.is_some());
    for own in found.iter_mut().filter(|_| has_errors) {
        if own.is_hidden_by_errors() {
            own.measured.uncertainty = own.measured.value.abs() + LARGEST_HIDDEN;
            (own.declared, own.step_effect) = (None, None);
        } else if own.step_effect.is_some() && own.shows_rule() {
            // When a contact begins to slide depends on the step abruptly.
            own.measured.uncertainty = own.measured.uncertainty.max(NEAR_A_RULE);
        }
    }
    found
}

/// A property at vanishing time step, from that of the probe and the values of every level.
fn of_all_levels(first: &Property, alike: &[Measured], limit: fn(&[f64]) -> Measured) -> Property {
    let values: Vec<f64> = alike.iter().map(|own| own.value).collect();
    let (limit, at_step) = (limit(&values), first.measured.value);
    let allowed = TOLERANCE * first.scale();
    // An error of the scheme that is known as it is.
    if first.step_effect.is_some() {
        return first.clone();
    }
    let is_exact = first.measured.uncertainty <= allowed;
    let of_scheme = vanishes(first.measured.uncertainty, alike);
    // What the probe knows, and what is wrong with the law, no shorter step shows better.
    if is_exact && first.agrees() || !is_exact && !of_scheme || !limit.value.is_finite() {
        return first.clone();
    }
    let first = Property {
        is_extrapolated: true,
        ..first.clone()
    };
    let is_constant = (at_step - limit.value).abs() <= limit.uncertainty + allowed;
    let effect = StepEffect {
        at_step,
        uncertainty: first.measured.uncertainty,
        order: order(&values, limit),
    };
    if is_constant && is_exact {
        return match first.is_time_in_steps() && first.differs() {
            // As many steps at every step: an effect of first order.
            true => Property {
                declared: None,
                step_effect: Some(StepEffect { order: 1, ..effect }),
                ..first
            },
            false => first,
        };
    }
    let found = Property {
        measured: limit,
        step_effect: Some(effect),
        ..first
    };
    let is_time = found.is_time_in_steps() && found.differs();
    match is_time && !is_constant && limit.uncertainty <= SMALL_EFFECT {
        true => Property {
            declared: None,
            ..found
        },
        false => found,
    }
}

/// Whether an `uncertainty` at the longest step falls with the step by itself, not only because there are more rows: it
/// comes from the scheme, and neither from another law nor from rounding.
fn vanishes(uncertainty: f64, alike: &[Measured]) -> bool {
    let finest = alike.iter().zip(DIVISORS).next_back();
    finest.is_some_and(|(own, divisor)| {
        own.uncertainty * (divisor as f64).sqrt() < VANISHING * uncertainty
    })
}

/// The order in which `values` approach their `limit`, at the shortest steps at which that is seen.
fn order(values: &[f64], limit: Measured) -> u32 {
    let distances = values.iter().zip(DIVISORS);
    let distances = distances.map(|(value, divisor)| ((value - limit.value).abs(), divisor as f64));
    let seen = distances.filter(|(distance, _)| *distance > BEYOND_DOUBT * limit.uncertainty);
    let seen: Vec<(f64, f64)> = seen.collect();
    let order = match seen[..] {
        [.., (coarse, few), (fine, many)] => (coarse / fine).ln() / (many / few).ln(),
        _ => 1.0,
    };
    order.round().clamp(1.0, 9.0) as u32
}

/// The limit of values of all levels. If twice their scatter is less than the uncertainty of their extrapolation, it is
/// the last of them with the former: no value is further away from the limit than the first.
fn at_zero(values: &[f64]) -> Measured {
    let limit = extrapolated(values);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let scatter = 2.0 * (largest - values.iter().copied().fold(f64::INFINITY, f64::min));
    match values {
        [.., last] if scatter < limit.uncertainty => Measured::new(*last, scatter),
        _ => limit,
    }
}

/// The limit of values of all levels by Neville's scheme for polynomials in the step; the best of all orders is taken.
/// Its uncertainty is twice the larger difference to the limits of one order less, and once more what that was without the
/// last value: a difference alone can be small by accident. Of values whose effect of first order scatters by a tenth of its
/// largest size, the limit lies outside of it in one case of a hundred (see the tests).
fn extrapolated(values: &[f64]) -> Measured {
    let mut limits: Vec<Vec<f64>> = Vec::new();
    for (level, &value) in values.iter().enumerate() {
        let mut own = vec![value];
        for order in 1..=level {
            let ratio = DIVISORS[level] as f64 / DIVISORS[level - order] as f64;
            let (finer, coarser) = (own[order - 1], limits[level - 1][order - 1]);
            own.push(finer + (finer - coarser) / (ratio - 1.0));
        }
        limits.push(own);
    }
    let difference = |level: usize, order: usize| {
        let lower = [limits[level][order - 1], limits[level - 1][order - 1]];
        let limit = limits[level][order];
        lower
            .map(|lower| (limit - lower).abs())
            .into_iter()
            .fold(0.0, f64::max)
    };
    let last = values.len().saturating_sub(1);
    let of_order = |order: usize| {
        let own = difference(last, order);
        let before = match order < last {
            true => difference(last - 1, order),
            // With one value less there is no such order.
            false => difference(last - 1, order - 1),
        };
        Measured::new(limits[last][order], 2.0 * own + before)
    };
    let orders = (1..=last).map(|order| match last {
        1 => Measured::new(limits[1][1], 3.0 * difference(1, 1)),
        _ => of_order(order),
    });
    let best = orders.min_by(|one, other| one.uncertainty.total_cmp(&other.uncertainty));
    best.unwrap_or(Measured::UNKNOWN)
}

#[cfg(test)]
mod tests {
    use super::super::experiments::refined;
    use super::super::finding::{Finding, step_effects};
    use super::super::probe::probe;
    use super::*;
    use crate::code::Code;
    use crate::dem::run_contact_test;
    use crate::series::MotionRow;
    use crate::study::Verdict;

    fn at_all_levels(value: impl FnMut(f64) -> f64) -> Vec<f64> {
        let steps = DIVISORS.iter().map(|divisor| (*divisor as f64).recip());
        steps.map(value).collect()
    }

    #[test]
    fn the_limit_of_a_smooth_value_lies_within_its_uncertainty() {
        for rate in [0.1, 0.5, 1.0, 2.0] {
            let values = at_all_levels(|step| libm::exp(rate * step) - 0.3 * libm::sin(step));
            for count in 2..=values.len() {
                let Measured { value, uncertainty } = at_zero(&values[..count]);
                let told = format!("{rate}, {count} levels: {value} ± {uncertainty:e}");
                assert!((value - 1.0).abs() <= uncertainty + 1e-14, "{told}");
                assert!(count < 9 || uncertainty < 1e-5, "{told}");
            }
            let limit = at_zero(&values);
            assert_eq!(order(&values, limit), 1);
        }
        let values = at_all_levels(|step| 2.0 + 0.3 * step * step);
        assert_eq!(order(&values, at_zero(&values)), 2);
    }

    /// The tangential stiffness of the last code of tests/codes/schemes.toml at each level: 2 at vanishing step.
    #[test]
    fn values_that_rest_before_they_converge_are_not_known_too_well() {
        let values = [
            1.9988154, 1.9988888, 1.9989640, 1.9992437, 1.9994951, 1.9995964,
        ];
        for count in 4..=values.len() {
            let Measured { value, uncertainty } = at_zero(&values[..count]);
            assert!(
                (value - 2.0).abs() <= uncertainty,
                "{count}: {value} ± {uncertainty:e}"
            );
        }
    }

    /// Values with an effect of first order that scatters by a tenth of it.
    #[test]
    fn the_limit_of_values_that_scatter_rarely_lies_outside_of_its_uncertainty() {
        let mut random = fastrand::Rng::with_seed(0);
        let trials = 4000;
        let outside = (0..trials).filter(|_| {
            let effect = 2.0 * random.f64() - 1.0;
            let mut scatter = || 0.1 * (2.0 * random.f64() - 1.0);
            let values = at_all_levels(|step| (effect + scatter()) * step);
            let Measured { value, uncertainty } = extrapolated(&values);
            value.abs() > uncertainty
        });
        let share = outside.count() as f64 / f64::from(trials);
        assert!(share < 0.015, "{share}");
    }

    #[test]
    fn values_that_scatter_are_not_extrapolated() {
        let values = [1.0, 1.002, 0.999, 1.001, 1.0005];
        let Measured { value, uncertainty } = at_zero(&values);
        assert_eq!(value, 1.0005);
        assert!((uncertainty - 0.006).abs() < 1e-15);
    }

    /// The findings on a code that takes four steps inside each, and whose normal force is this `factor` times that of
    /// the law.
    fn with_steps_inside(factor: f64) -> Vec<Finding> {
        let code = Code::named("lammps").expect("a code");
        let run = |tests: &[ContactTest]| {
            let motions = tests.iter().map(|test| {
                let motion = run_contact_test(&refined(test, 4)).expect("it is finite");
                let rows = motion.rows().iter().step_by(4).zip(0..);
                let rows = rows.map(|(row, step)| MotionRow { step, ..*row });
                Motion::new(rows.collect(), test.steps).expect("it is whole")
            });
            Ok::<_, ()>(motions.collect())
        };
        let declared = Declaration {
            velocity_lag: 0.125,
            in_space: false,
            ..code.declaration()
        };
        let properties = converged(&declared, run, |_| false).expect("every test is answered");
        let judged = properties.into_iter().map(|mut own| {
            // A wrong law in the code is a wrong number in the declaration.
            if own.name.ends_with("normal_stiffness") {
                own.declared = own.declared.map(|declared| declared / factor);
            }
            own.judge(&code, "")
        });
        judged.collect()
    }

    fn differing(findings: &[Finding]) -> Vec<&str> {
        let differ = findings
            .iter()
            .filter(|own| own.verdict == Verdict::Differs);
        differ.map(|own| own.property.as_str()).collect()
    }

    #[test]
    fn what_vanishes_with_the_step_is_no_difference() {
        let findings = with_steps_inside(1.0);
        assert_eq!(differing(&findings), Vec::<&str>::new());
        let named = |name: &str| {
            let own = findings.iter().find(|own| own.property == name);
            own.expect("it is measured")
        };
        let lag = named("pair_damping_velocity_lag");
        assert!(
            (lag.measured.expect("a number") - 0.125).abs() < 1e-3,
            "{lag:?}"
        );
        assert_eq!(lag.declared, None);
        for name in ["pair_tangential_stiffness", "floor_tangential_damping"] {
            let effect = named(name).step_effect;
            assert_eq!(effect.map(|effect| effect.order), Some(1), "{name}");
        }
        let told = step_effects(findings.iter()).expect("there are some");
        assert!(told.contains("0.125 steps before the positions"), "{told}");
    }

    #[test]
    fn a_mistake_of_a_ten_thousandth_is_found_beside_it() {
        let found = with_steps_inside(1.0001);
        assert_eq!(
            differing(&found),
            [
                "pair_normal_stiffness",
                "floor_normal_stiffness",
                "wall_normal_stiffness"
            ]
        );
    }

    #[test]
    fn a_code_that_is_exact_is_asked_at_one_time_step() {
        let declared = Code::native().declaration();
        let mut rounds = 0;
        let mut run = |tests: &[ContactTest]| {
            rounds += 1;
            let motions = tests.iter().map(run_contact_test);
            motions.collect::<Result<Vec<_>, _>>().map_err(|_| ())
        };
        let once = probe(&declared, &mut run).expect("every test is answered");
        let at_all_steps = converged(&declared, &mut run, |_| false);
        assert_eq!(at_all_steps.expect("every test is answered"), once);
        assert_eq!(rounds, 2 * super::super::ROUNDS);
    }
}
