//! What is worth knowing about a code whose results are in order.

use super::micro::Micro;
use super::report::{Grade, Item};
use crate::code::Code;
use crate::series::Series;
use crate::study::convention::{ArmEffects, Finding, Passport, passport};

const CONVENTION: &str = "measured convention";
const BITS: &str = "the same task twice";

/// Says whether two runs of one task give the same bits, or else by how much they scatter.
pub(super) fn same_bits(first: &Series, second: Option<&Series>) -> Item {
    let grade = Grade::Informational;
    let Some(second) = second else {
        return Item::remark(
            grade,
            BITS,
            "the second run failed: the code does not run reliably",
        );
    };
    if first == second {
        return Item::passed(grade, BITS, "the same bits");
    }
    let force = |series: &Series| {
        series
            .samples()
            .iter()
            .map(|row| row.wall_force)
            .collect::<Vec<_>>()
    };
    let (one, two) = (force(first), force(second));
    let largest = one
        .iter()
        .map(|force| force.abs())
        .fold(f64::MIN_POSITIVE, f64::max);
    let apart = one.iter().zip(&two).map(|(one, two)| (one - two).abs());
    let scatter = apart.fold(0.0, f64::max) / largest;
    Item::remark(
        grade,
        BITS,
        format!(
            "the wall force scatters by {scatter:.1e} of its largest value: it belongs to the uncertainty"
        ),
    )
}

/// Sums up the passport: the convention, what it changes, and which codes share it.
pub(super) fn information(code: &Code, micro: Option<&Micro>) -> Vec<Item> {
    let grade = Grade::Informational;
    let Some(micro) = micro else {
        let reason = "no task `motion`: the declared one is believed";
        return vec![Item::not_tested(grade, CONVENTION, reason)];
    };
    let passport = passport(code, &micro.findings);
    let keys = passport.convention.iter().map(|own| {
        let value = own.measured.as_ref().map(|value| in_short(value));
        let key = own.key.as_str();
        let key = key.rsplit_once("convention.").map_or(key, |(_, key)| key);
        format!("{key} {}", value.as_deref().unwrap_or("unknown"))
    });
    let forces = passport.effects.iter().map(yield_force);
    let convention = Item::passed(grade, CONVENTION, keys.collect::<Vec<_>>().join(", "));
    let items = [convention]
        .into_iter()
        .chain(turned(&micro.findings.findings));
    let others = [
        Item::passed(
            grade,
            "yield force by theory",
            forces.collect::<Vec<_>>().join("; "),
        ),
        Item::passed(grade, "twin", twin(&passport)),
    ];
    items.chain(others).collect()
}

/// Says how forces change if everything is turned, bodies, walls and gravity, for a code whose contacts leave their
/// springs behind as they turn. The share was measured with two cylinders that turn together.
fn turned(findings: &[Finding]) -> Option<Item> {
    let mut findings = findings.iter();
    let own = findings.find(|own| own.property == "pair_spring_left_behind")?;
    let share = own.measured.filter(|share| share.abs() > LEAST_SHARE)?;
    let aside = 100.0 * share * libm::sin(TURN_IN_DEGREES.to_radians());
    let found = format!(
        "its forces depend on how the axes lie: turn everything by {TURN_IN_DEGREES} degrees, and {aside:.1} % of the force \
         of a stretched spring between two cylinders points along their normal (docs/conventions.md)"
    );
    Some(Item::remark(
        Grade::Informational,
        "turned as a whole",
        found,
    ))
}

/// Turn for which the dependence on the axes is shown.
const TURN_IN_DEGREES: f64 = 10.0;
/// Share of a spring left behind above which the dependence is mentioned.
const LEAST_SHARE: f64 = 1e-3;

/// Rounds a number to six decimals; returns a word as it is.
fn in_short(value: &str) -> String {
    let number = value.parse::<f64>();
    number.map_or(value.to_owned(), |number| {
        ((number * 1e6).round() / 1e6 + 0.0).to_string()
    })
}

/// Gives F with the arms of the code, and its change from the paper's.
fn yield_force(effects: &ArmEffects) -> String {
    let stack = &effects.stack;
    let place = format!(
        "mu = {}, stiffness {}:",
        stack.floor_friction, stack.stiffness
    );
    effects.force.zip(effects.paper_force).map_or_else(
        || {
            let reason = effects.reason.as_deref().unwrap_or("none");
            format!("{place} {reason}")
        },
        |(own, paper)| {
            let change = 100.0 * (own - paper) / paper;
            format!("{place} {own:.5} m g, {change:+.3} % of the paper's")
        },
    )
}

/// Names the codes inside the program that have the same convention, or else the same arms.
fn twin(passport: &Passport) -> String {
    let names = |codes: &[Code]| {
        codes
            .iter()
            .map(|code| code.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    if !passport.twins.is_empty() {
        return format!("{}: the same convention", names(&passport.twins));
    }
    if !passport.same_arms.is_empty() {
        return format!(
            "{}: the same arms, and so the same yield force",
            names(&passport.same_arms)
        );
    }
    if !passport.findings.measured.knows_limit() {
        return "not known, as the convention is not".to_owned();
    }
    "none of the external codes inside the program has these arms; native takes on any".to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Verdict;

    #[test]
    fn a_spring_that_is_left_behind_is_said_to_depend_on_the_axes() {
        let finding = |measured: Option<f64>| Finding {
            code: Code::native(),
            version: String::new(),
            property: "pair_spring_left_behind".to_owned(),
            key: None,
            measured,
            uncertainty: Some(1e-9),
            declared: Some(1.0),
            step_effect: None,
            verdict: Verdict::Agrees,
        };
        let item = turned(&[finding(Some(1.0))]).expect("it is said");
        assert!(
            item.found.contains("by 10 degrees, and 17.4 %"),
            "{}",
            item.found
        );
        for none in [Some(1e-9), None] {
            assert!(turned(&[finding(none)]).is_none());
        }
        assert!(turned(&[]).is_none());
    }
}
