//! The stack at rest and under the wall: what mechanics demands of its series, and the series of the native DEM.

use super::beside::{Beside, SAME};
use super::factor::{is_about, of_factor, of_friction};
use super::mistake::every_step;
use super::report::{Grade, Item, Outcome};
use super::rows::{Row, index, indices, name, rows_of};
use super::{computed, written};
use crate::dem::compress_stack;
use crate::model::{Case, ContactConvention};
use crate::series::{ENOUGH_DIGITS, Law, Mechanics, Series, YieldEstimates, most_digits};

/// Relative deviation of the weight from which on it is not that of the stack: what ringing leaves is far smaller.
const SAME_WEIGHT: f64 = 1e-3;
/// Relative deviation of the friction of a sliding floor; codes cap the force at μ n itself.
const SAME_FRICTION: f64 = 1e-6;

/// The items on the `series` of `case`, which a code with this `convention` has written.
pub(super) fn items(series: &Series, case: &Case, convention: ContactConvention) -> Vec<Item> {
    let own = Case {
        convention,
        ..*case
    };
    let found = rows_of(series);
    let native = compress_stack(&own, || true);
    let Ok(native) = native.or_else(|_| compress_stack(case, || true)) else {
        return Vec::new();
    };
    let expected = rows_of(&native);
    let dense = every_step(&own);
    if dense.len() < 2 {
        return Vec::new();
    }
    let beside = Beside::new(&found, &expected, &dense);
    let mut items = vec![weight(&found, case), start_of_wall(&found, case)];
    items.extend(laws(series, &own));
    items.push(friction(series, case));
    items.push(path(&beside, case));
    items.push(digits(series, case));
    explain(&mut items, &beside, &own);
    items
}

/// Gives every item that failed its causes: those that explain the whole series, else its own, else the usual ones.
fn explain(items: &mut [Item], beside: &Beside, case: &Case) {
    let failed = |item: &Item| item.outcome == Outcome::Failed;
    if !items.iter().any(failed) {
        return;
    }
    let causes = diagnosis(beside, case);
    for item in items.iter_mut().filter(|item| failed(item)) {
        if !causes.is_empty() {
            item.causes.clone_from(&causes);
        } else if item.causes.is_empty() {
            item.causes = vec![usual(item.name).to_owned()];
        }
    }
}

/// An item that fails; its causes are found for all items together where it has none of its own.
fn failed(name: &'static str, expected: String, found: String, causes: Vec<String>) -> Item {
    Item::failed(Grade::Consistency, name, expected, found, causes)
}

fn passed(name: &'static str, found: impl Into<String>) -> Item {
    Item::passed(Grade::Consistency, name, found)
}

fn value(row: &Row, column: &str) -> f64 {
    row[index(column)]
}

const WEIGHT: &str = "weight on the floor";

/// The floor bears three weights before the wall moves.
fn weight(rows: &[Row], case: &Case) -> Item {
    let weight = case.stack.epsilon();
    let Some(first) = rows.first() else {
        return Item::not_tested(Grade::Consistency, WEIGHT, "there is no row");
    };
    let borne = (value(first, "floor_n2") + value(first, "floor_n3")) / weight;
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

/// The wall just touches at step 0.
fn start_of_wall(rows: &[Row], case: &Case) -> Item {
    let weight = case.stack.epsilon();
    let force = rows.first().map_or(0.0, |first| value(first, "wall_force")) / weight;
    // Codes in which surfaces that just touch are a contact damp there.
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

fn name_of(law: Law) -> &'static str {
    match law {
        Law::ForceBalance => BALANCE,
        Law::MirrorSymmetry => SYMMETRY,
        Law::WallOverlap => WALL_OVERLAP,
        Law::FloorOverlap => FLOOR_OVERLAP,
    }
}

/// The laws of mechanics, in every row before the floor slides.
fn laws(series: &Series, case: &Case) -> Vec<Item> {
    let mechanics = Mechanics::read(series, case);
    let each = mechanics.0.iter().map(|(law, deviation)| {
        let name = name_of(*law);
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

const FRICTION: &str = "friction of the floor";

/// The floor slides at its friction.
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

/// The series beside that of the native DEM.
fn path(beside: &Beside, case: &Case) -> Item {
    let distance = beside.distance(beside.expected, &beside.columns);
    if distance < SAME {
        return passed(
            PATH,
            format!("to {distance:.1e} that of the native DEM with the same convention"),
        );
    }
    let worst = beside.columns.iter().copied().max_by(|&left, &right| {
        let of = |column| beside.of_column(column);
        of(left).total_cmp(&of(right))
    });
    let off = worst.and_then(|column| Some((column, beside.first_off(column)?)));
    let (expected, found) = off.map_or_else(
        || {
            (
                "the series of the native DEM".to_owned(),
                "another one".to_owned(),
            )
        },
        |(column, (row, found, expected))| {
            let step = case
                .protocol
                .schedule()
                .sampled_steps()
                .nth(row)
                .unwrap_or(0);
            let text = |value: f64| format!("{} {value:.9} at step {step}", name(column));
            (text(expected), text(found))
        },
    );
    failed(
        PATH,
        format!("{expected} (native DEM, same convention)"),
        found,
        Vec::new(),
    )
}

const DIGITS: &str = "digits";

/// Few digits cost uncertainty, not truth.
fn digits(series: &Series, case: &Case) -> Item {
    let digits = digits_of(series, case);
    if digits >= ENOUGH_DIGITS {
        return passed(DIGITS, format!("{digits} of 17"));
    }
    Item::remark(
        Grade::Consistency,
        DIGITS,
        format!(
            "the forces are printed with {digits} significant digits; all 17 are asked for (repr() in Python, %.17g in C): \
             fewer cost uncertainty, and may leave a verdict inconclusive"
        ),
    )
}

/// Mistakes that give the series that was found.
fn diagnosis(beside: &Beside, case: &Case) -> Vec<String> {
    let plain = at_first_sight(beside);
    if !plain.is_empty() {
        return plain;
    }
    let causes = written::explanations(beside, case);
    match causes.is_empty() {
        true => computed::explanations(beside, case),
        false => causes,
    }
}

/// What the stack at rest shows without computing anything.
fn at_first_sight(beside: &Beside) -> Vec<String> {
    let (Some(found), Some(expected)) = (beside.found.first(), beside.expected.first()) else {
        return Vec::new();
    };
    let stands = |row: &Row| value(row, "floor_n2").abs() + value(row, "floor_n3").abs() > 1e-12;
    let top = value(found, "y1") - (1.0 + 3f64.sqrt());
    let cause = if !stands(found) && top > 1e-6 {
        format!(
            "gravity points upwards: at step 0 cylinder 1 is {top:.3e} r above its place in the stress-free stack, and \
                 nothing presses on the floor"
        )
    } else if !stands(found) && top < -0.5 {
        format!(
            "the stack fell: at step 0 cylinder 1 is at y1 = {:.6}; the floor, or the contacts of cylinder 1, exert no \
                 force, or push the wrong way",
            value(found, "y1")
        )
    } else if !stands(found)
        && indices(&["x1", "y1"])
            .iter()
            .all(|&column| found[column].is_finite())
        && top.abs() <= 1e-6
    {
        "there is no gravity: at step 0 the stack is free of stress; `gravity` is never set, or the steps of the \
         preparation are left out".to_owned()
    } else if (value(found, "y1") - value(expected, "y1")).abs() > 1.0
        && (value(found, "x2") - value(found, "x3")).abs() > 2.5
    {
        format!(
            "the stack collapsed before step 0: the bottom cylinders are at x = {:.3} and {:.3}",
            value(found, "x2"),
            value(found, "x3")
        )
    } else if beside
        .found
        .iter()
        .all(|row| value(row, "wall_force") == 0.0)
    {
        "the wall never presses: it moves upwards, or not at all, or its force is not read; `wall_speed` is downwards"
            .to_owned()
    } else if is_single_precision(beside) {
        "the numbers are those of single precision, some 7 digits: positions, velocities and springs need double precision"
            .to_owned()
    } else {
        return Vec::new();
    };
    vec![cause]
}

/// Whether all positions are numbers of single precision, and are no round ones.
fn is_single_precision(beside: &Beside) -> bool {
    let columns = indices(&["y1", "x2", "y2"]);
    let positions = || {
        beside
            .found
            .iter()
            .flat_map(|row| columns.iter().map(|&column| row[column]))
    };
    let is_single = |position: f64| f64::from(position as f32) == position;
    most_digits(positions()) >= ENOUGH_DIGITS && positions().all(is_single)
}

fn usual(item: &str) -> &'static str {
    match item {
        WEIGHT => {
            "usual causes: the mass is not 1; gravity is not the parameter `gravity`; the stack is still falling or \
                   ringing, because ramp or rest are left out; forces in another unit"
        }
        START => {
            "usual causes: the wall does not start at y1 + 1 of the present cylinder 1; the weight is added; a force of \
                  another step"
        }
        BALANCE => {
            "usual causes: a force of another step, sign or unit; the damping is left out of what is written; a force \
                    that acts on one body alone; the floor under cylinder 1 counts too"
        }
        SYMMETRY => {
            "usual causes: a force that acts on one body alone; cylinders 2 and 3 exchanged in one column; a stack \
                     that is not placed symmetrically; contacts that are updated with positions of different steps"
        }
        WALL_OVERLAP => {
            "usual causes: k_n is not 1 at the wall; wall_speed is not downwards or not as asked; a force of \
                         another step; positions that are not those of the centres"
        }
        FLOOR_OVERLAP => {
            "usual causes: k_n is not 1 at the floor; the floor is not y = 0; heights of another point than the \
                          centre; a force of another step"
        }
        FRICTION => {
            "usual causes: an angle in place of the coefficient; a mean of two materials; static and sliding friction"
        }
        _ => {
            "usual causes: another stiffness or friction than asked; contacts that forget or keep their springs at the \
              wrong time; a convention that the manifest does not declare"
        }
    }
}
