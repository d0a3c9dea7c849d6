//! What is worth knowing of a code whose results are in order.

use super::micro::Micro;
use super::report::{Grade, Item};
use super::rows::{index, rows_of};
use crate::code::Code;
use crate::model::{ContactConvention, Stack};
use crate::series::Series;
use crate::theory::quasistatic_limit;

/// Friction and stiffness of the stacks for which the effect of the convention is told: below and above the critical
/// friction, and a stiff one.
const STACKS: [(f64, f64); 3] = [(0.2, 100.0), (0.3, 100.0), (0.3, 1000.0)];

const BITS: &str = "the same task twice";

/// Whether two runs of one task are the same.
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
    let force = index("wall_force");
    let (one, two) = (rows_of(first), rows_of(second));
    let largest = one
        .iter()
        .map(|row| row[force].abs())
        .fold(f64::MIN_POSITIVE, f64::max);
    let apart = one
        .iter()
        .zip(&two)
        .map(|(one, two)| (one[force] - two[force]).abs());
    let scatter = apart.fold(0.0, f64::max) / largest;
    Item::remark(
        grade,
        BITS,
        format!(
            "the wall force scatters by {scatter:.1e} of its largest value: it belongs to the uncertainty"
        ),
    )
}

/// The convention, what it changes, and whose it is.
pub(super) fn information(
    code: Code,
    convention: ContactConvention,
    micro: Option<&Micro>,
) -> Vec<Item> {
    let grade = Grade::Informational;
    let measured = match micro {
        Some(micro) => Item::passed(grade, "measured convention", micro.passport()),
        None => Item::not_tested(
            grade,
            "measured convention",
            "no task `motion`: the declared one is believed",
        ),
    };
    let forces = STACKS.map(|(mu, stiffness)| yield_force(mu, stiffness, &convention));
    vec![
        measured,
        Item::passed(grade, "yield force by theory", forces.join("; ")),
        twin(code, convention),
    ]
}

/// F under `convention` beside the paper's.
fn yield_force(mu: f64, stiffness: f64, convention: &ContactConvention) -> String {
    let stack = Stack::paper(mu, stiffness);
    let limit = |convention| quasistatic_limit(&stack, convention).yield_force;
    let own = limit(convention).zip(limit(&ContactConvention::PAPER));
    let place = format!("mu = {mu}, stiffness {stiffness}:");
    own.map_or_else(
        || format!("{place} does not yield at the floor"),
        |(own, paper)| {
            format!(
                "{place} {own:.5} m g, {:+.3} % of the paper's",
                100.0 * (own - paper) / paper
            )
        },
    )
}

/// The codes inside the program with the same convention.
fn twin(code: Code, convention: ContactConvention) -> Item {
    const NAME: &str = "twin";
    let grade = Grade::Informational;
    let named = |alike: &dyn Fn(&ContactConvention) -> bool| {
        let others = Code::all()
            .into_iter()
            .filter(|other| *other != code && alike(&other.convention()));
        others.map(Code::as_str).collect::<Vec<_>>().join(", ")
    };
    let same = named(&|other| {
        *other
            == ContactConvention {
                restitution: other.restitution,
                ..convention
            }
    });
    if !same.is_empty() {
        return Item::passed(grade, NAME, format!("{same}: the same convention"));
    }
    let arms = named(&|other| other.arms == convention.arms);
    if !arms.is_empty() {
        return Item::passed(
            grade,
            NAME,
            format!("{arms}: the same arms, and so the same yield force"),
        );
    }
    Item::passed(
        grade,
        NAME,
        "none of the codes inside the program has these arms; native takes on any",
    )
}
