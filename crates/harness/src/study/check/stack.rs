//! Items on the stack at rest and under the wall: the laws of mechanics in its series, and the comparison with the
//! native DEM.

use super::evidence::Evidence;
use super::factor::{is_about, of_factor, of_friction};
use super::report::{Grade, Item};
use crate::model::{Case, Stack};
use crate::series::{
    Deviation, ENOUGH_DIGITS, FloorContact, MechanicalLaw, Mechanics, Sample, Series,
    YieldEstimates, is_of_32_bits, most_digits,
};
use crate::study::convention::VANISHING;

/// Largest relative deviation of the weight on the floor from that of the stack. What ringing leaves is far smaller.
const SAME_WEIGHT: f64 = 1e-3;
/// Largest relative deviation of the friction of a sliding floor. Codes cap the force at μ n itself.
const SAME_FRICTION: f64 = 1e-6;

/// What is known about the scheme of a code.
pub(super) struct Scheme<'a> {
    /// Whether the forces that move the bodies are late.
    pub is_late: bool,
    /// Runs the stack with half the time step, if the scheme has errors that vanish with it and nothing else is wrong
    /// with single contacts.
    pub finer: &'a dyn Fn() -> Option<Evidence>,
}

/// Returns the items on the `series` of `case`; `own` compares it with its twins.
pub(super) fn items(
    series: &Series,
    case: &Case,
    own: &[Evidence],
    scheme: &Scheme<'_>,
) -> Vec<Item> {
    let rows = series.samples();
    let mut items = vec![weight(rows, case), start_of_wall(rows, case)];
    items.extend(laws(
        series,
        &Case {
            convention: own[0].twin.convention,
            ..*case
        },
        scheme.is_late,
    ));
    items.push(friction(series, case));
    items.push(path(own, scheme.finer));
    items.push(digits(series, case));
    items
}

/// Returns an item that fails. Causes that are found for all items together replace its own.
fn failed(name: &'static str, expected: String, found: String, causes: Vec<String>) -> Item {
    Item::failed(Grade::Consistency, name, expected, found, causes)
}

fn passed(name: &'static str, found: impl Into<String>) -> Item {
    Item::passed(Grade::Consistency, name, found)
}

const WEIGHT: &str = "weight on the floor";

/// Checks that the floor bears three weights before the wall moves.
fn weight(rows: &[Sample], case: &Case) -> Item {
    let weight = case.stack.epsilon();
    let Some(first) = rows.first() else {
        return Item::not_tested(Grade::Consistency, WEIGHT, "there is no row");
    };
    let borne = first.borne(&case.stack) / weight;
    if (borne / 3.0 - 1.0).abs() <= SAME_WEIGHT {
        return passed(WEIGHT, "3 m g");
    }
    let found = format!(
        "floor_n2 + floor_n3 = {borne:.6} m g at step 0 ({:.4} times)",
        borne / 3.0
    );
    let count = [(1.0, "one cylinder"), (2.0, "two cylinders")];
    let mut causes = match count.into_iter().find(|(count, _)| is_about(borne, *count)) {
        Some((_, whose)) => vec![format!(
            "only the weight of {whose} is borne: gravity does not act on all of them, or one floor contact is left out"
        )],
        None => Vec::new(),
    };
    if borne.abs() > 1e-9 {
        causes.extend(of_factor(borne / 3.0, weight));
    }
    failed(
        WEIGHT,
        "3 m g = 3 gravity, the stack at rest".to_owned(),
        found,
        causes,
    )
}

const START: &str = "wall force at the start";

/// Checks that the wall just touches at step 0.
fn start_of_wall(rows: &[Sample], case: &Case) -> Item {
    let weight = case.stack.epsilon();
    let force = rows.first().map_or(0.0, |first| first.wall_force) / weight;
    // Codes in which surfaces that just touch are a contact have a damping force there.
    let law = case.convention.law(case.stack.stiffness_ratio);
    let damping = law.damping_normal * case.protocol.wall_speed / weight;
    if force.abs() <= damping + SAME_WEIGHT {
        return passed(START, "0: it just touches");
    }
    failed(
        START,
        "0 at step 0, when the wall just touches cylinder 1".to_owned(),
        format!("{force:.6} m g"),
        Vec::new(),
    )
}

const BALANCE: &str = "balance of forces";
const SYMMETRY: &str = "mirror symmetry";
const WALL_OVERLAP: &str = "wall force against overlap";
const FLOOR_OVERLAP: &str = "floor force against overlap";

fn name_of(law: MechanicalLaw) -> &'static str {
    match law {
        MechanicalLaw::ForceBalance => BALANCE,
        MechanicalLaw::MirrorSymmetry => SYMMETRY,
        MechanicalLaw::WallOverlap => WALL_OVERLAP,
        MechanicalLaw::FloorOverlap => FLOOR_OVERLAP,
    }
}

/// Checks the laws of mechanics in every row before the floor slides.
fn laws(series: &Series, case: &Case, is_late: bool) -> Vec<Item> {
    let mechanics = Mechanics::read(series, case);
    let each = mechanics.0.iter().map(|(law, deviation)| {
        let name = name_of(*law);
        if is_late && deviation.is_of_late_forces {
            return Item::remark(Grade::Consistency, name, rings_longer(deviation));
        }
        match (deviation.found, deviation.expected) {
            (Some(found), Some(expected)) => failed(
                name,
                format!(
                    "{expected:.6} m g at step {} (to {:.1e})",
                    deviation.step, deviation.bound
                ),
                format!("{found:.6} m g"),
                Vec::new(),
            ),
            _ => passed(name, format!("to {:.1e} m g", deviation.size)),
        }
    });
    each.collect()
}

/// Says that late forces explain a `deviation`.
pub(super) fn rings_longer(deviation: &Deviation) -> String {
    format!(
        "off by {:.1e} m g at step {}, where {:.1e} is allowed: forces that are late by a step take damping away, and the \
         stack rings longer",
        deviation.size, deviation.step, deviation.bound
    )
}

const FRICTION: &str = "friction of the floor";

/// Checks that the floor slides at its friction.
fn friction(series: &Series, case: &Case) -> Item {
    let asked = case.stack.floor_friction;
    let Some(found) = YieldEstimates::read(series, case).sliding_friction else {
        return Item::not_tested(
            Grade::Consistency,
            FRICTION,
            "the wall force has no peak, so that nothing slides",
        );
    };
    let digits = digits_of(series, case);
    let same = SAME_FRICTION.max(libm::exp10(2.0 - f64::from(digits)));
    if (found / asked - 1.0).abs() <= same {
        return passed(FRICTION, format!("it slides at |t|/n = {asked}"));
    }
    failed(
        FRICTION,
        format!("|t|/n = {asked} while it slides"),
        format!("{found:.9}"),
        of_friction(found, asked, case.stack.cylinder_friction),
    )
}

fn digits_of(series: &Series, case: &Case) -> u32 {
    let printed = YieldEstimates::read(series, case).printed;
    printed.map_or(17, |printed| printed.digits)
}

const PATH: &str = "loading path";

/// Compares the series with that of the twin, which is the native DEM.
fn path(own: &[Evidence], finer: &dyn Fn() -> Option<Evidence>) -> Item {
    let distance = own[0].before;
    let Some(own) = own.iter().find(|own| own.is_off()) else {
        return passed(
            PATH,
            format!("to {distance:.1e} that of the native DEM with the same convention"),
        );
    };
    if let Some(finer) = finer().filter(|finer| finer.before < VANISHING * distance) {
        return Item::remark(
            Grade::Consistency,
            PATH,
            format!(
                "to {distance:.1e} that of the native DEM with the same convention, and to {:.1e} with half the time step",
                finer.before
            ),
        );
    }
    let (name, step, found, expected) = own.first_off();
    failed(
        PATH,
        format!("{name} {expected:.9} at step {step} (native DEM, same convention)"),
        format!("{name} {found:.9} at step {step}"),
        Vec::new(),
    )
}

const DIGITS: &str = "digits";

/// Remarks on few digits, which add uncertainty but are no mistake.
fn digits(series: &Series, case: &Case) -> Item {
    let digits = digits_of(series, case);
    if digits >= ENOUGH_DIGITS {
        return passed(DIGITS, format!("{digits} of 17"));
    }
    let printed = YieldEstimates::read(series, case).printed;
    let found = match printed.is_some_and(|printed| printed.single) {
        true => "the forces are numbers of 32 bits, of some 7 digits, however many are printed: they cost uncertainty, and may leave a \
                 verdict inconclusive"
            .to_owned(),
        false => format!(
            "the forces are printed with {digits} significant digits; all 17 are asked for (repr() in Python, %.17g in C): \
             fewer cost uncertainty, and may leave a verdict inconclusive"
        ),
    };
    Item::remark(Grade::Consistency, DIGITS, found)
}

/// Recognises gross mistakes without computing anything: no gravity or one that points upwards, a stack that fell or
/// collapsed, a wall that never presses.
pub(super) fn at_first_sight(series: &Series, stack: &Stack) -> Option<String> {
    let rows = series.samples();
    let first = rows.first()?;
    let [x, height, _] = first.top(stack);
    let top = height - (1.0 + stack.ring().rise);
    let bears = |contact: FloorContact| contact.normal.abs() > 1e-12;
    let stands = first.floor_contacts(stack).any(bears);
    if !stands && top > 1e-6 {
        return Some(format!(
            "gravity points upwards: at step 0 cylinder 1 is {top:.3e} r above its place in the stress-free \
                             stack, and nothing presses on the floor"
        ));
    }
    if !stands && top < -0.5 {
        return Some(format!(
            "the stack fell: at step 0 cylinder 1 is at y1 = {height:.6}; the floor, or the contacts of cylinder 1, \
                             exert no force, or push the wrong way"
        ));
    }
    if !stands && top.abs() <= 1e-6 && x.is_finite() {
        return Some("there is no gravity: at step 0 the stack is free of stress; `gravity` is never set, or the steps of \
                     the preparation are left out".to_owned());
    }
    let apart = first.neighbour_distance(stack);
    if top < -1.0 && apart > 2.5 {
        return Some(format!(
            "the stack collapsed before step 0: the bottom {} are {apart:.3} r apart",
            stack.kind()
        ));
    }
    rows.iter().all(|row| row.wall_force == 0.0).then(|| {
        "the wall never presses: it moves upwards, or not at all, or its force is not read; `wall_speed` is downwards".to_owned()
    })
}

/// Says that the positions of a stack are in single precision, if they are.
pub(super) fn in_single_precision(series: &Series) -> Option<String> {
    let positions = || {
        let rows = series.samples().iter();
        rows.flat_map(|row| row.bodies.iter().take(2).flat_map(|body| body.position))
    };
    (most_digits(positions()) >= ENOUGH_DIGITS && positions().all(is_of_32_bits)).then(|| {
        "the numbers are those of single precision, some 7 digits: positions, velocities and springs need double precision"
            .to_owned()
    })
}
