//! The first force that is wrong in motions in which several contacts act at once, where nothing else explains them.

use super::event::{changed_contacts, words_of};
use super::evidence::{of_contact, test_under};
use super::twin::{CONTACTS, OF_BODY, Row, Twin, WALL};
use crate::model::ContactConvention;
use crate::runs::Answer;
use crate::series::MotionRow;
use std::cell::RefCell;

/// Largest difference of forces that are the same, in units of the largest one: rounding, which grows in a contact that
/// slides.
const SAME: f64 = 1e-6;
/// Part of a difference that may be left if one contact explains it: others near it are rounded too.
const LEFT: f64 = 1e-3;

/// A force of one contact that differs from that of the law, the forces of all others being right.
struct WrongForce {
    contact: usize,
    step: u64,
    /// Normal and tangential force as found, and by the law.
    found: [f64; 2],
    expected: [f64; 2],
    /// Contacts that open or close in the same step.
    occasions: Vec<String>,
}

/// Names the first wrong force of a contact in the motions of `answers`; one that is wrong when another contact opens or
/// closes says more than any other.
pub(super) fn first_wrong(answers: &[Answer], convention: ContactConvention) -> Option<String> {
    let mut all: Vec<WrongForce> = answers
        .iter()
        .filter_map(|answer| of_motion(answer, convention))
        .collect();
    all.sort_by_key(|own| own.occasions.is_empty());
    let own = all.first()?;
    let set = words_of(own.contact);
    let [found, expected] = [own.found, own.expected];
    let largest = found.iter().chain(&expected).map(|force| force.abs());
    let same = SAME * largest.fold(0.0, f64::max);
    let is_none = |force: [f64; 2]| force.iter().all(|part| part.abs() <= same);
    let kind = usize::from((found[0] - expected[0]).abs() <= same);
    let what = if is_none(found) {
        format!("there is no force{set}")
    } else if is_none(expected) {
        format!("there is a force{set}, which must be open")
    } else {
        format!(
            "the {} force{set} is {:.9}, and must be {:.9},",
            ["normal", "tangential"][kind],
            found[kind],
            expected[kind]
        )
    };
    let when = match own.occasions.is_empty() {
        true => String::new(),
        false => format!(", when {}", own.occasions.join(" and ")),
    };
    let others = all.len() - 1;
    let others = match others {
        0 => String::new(),
        _ => format!("; {others} more motions begin to be wrong in one contact"),
    };
    Some(format!(
        "{what} at step {} of a micro-test{when}, where all forces before are right, and those of the other contacts{others}",
        own.step
    ))
}

/// The first row of a motion in which a force is wrong, if that of one contact explains it.
fn of_motion(answer: &Answer, convention: ContactConvention) -> Option<WrongForce> {
    let test = test_under(answer, convention);
    let mut twin = Twin::of_motion(&test);
    let rows = answer.motion.rows();
    let scale = rows.iter().flat_map(loads).flatten();
    let same = SAME * scale.fold(f64::MIN_POSITIVE, |largest, load| largest.max(load.abs()));
    let before: RefCell<Option<Twin>> = RefCell::default();
    let mut wrong = None;
    twin.run_interrupted(
        |twin, _| {
            before.replace(Some(twin.clone()));
        },
        |step, row| {
            let Some(found) = rows.get(step as usize).filter(|own| own.step == step) else {
                return false;
            };
            let mut differences = differences(found, row);
            let is_off = differences.iter().flatten().any(|own| own.abs() > same);
            if is_off {
                let wall: f64 = WALL.map(|wall| normal_and_tangential(row, wall)[0]).sum();
                differences[2][0] = found.wall_force - wall;
                wrong = Some((step, differences, *row));
            }
            !is_off
        },
    );
    let (step, differences, row) = wrong?;
    let before = before.into_inner()?;
    let mut now = before.clone();
    now.forces();
    let largest = differences.iter().flatten();
    let left = LEFT * largest.fold(0.0, |largest: f64, own| largest.max(own.abs()));
    (0..CONTACTS.len()).find_map(|contact| {
        let change = change_of(contact, &before, &now, &differences, left)?;
        let expected = normal_and_tangential(&row, contact);
        Some(WrongForce {
            contact,
            step,
            found: [expected[0] + change[0], expected[1] + change[1]],
            expected,
            occasions: changed_contacts(&before),
        })
    })
}

fn loads(row: &MotionRow) -> [[f64; 3]; 2] {
    row.bodies()
        .map(|own| [own.force[0], own.force[1], own.torque])
}

/// Differences of forces and torque on both bodies. The third entry is left for the force that is written for the wall.
fn differences(found: &MotionRow, row: &Row) -> [[f64; 3]; 3] {
    let [one, two] = loads(found);
    let mut both = [one, two, [0.0; 3]];
    for (body, own) in both[..2].iter_mut().enumerate() {
        let right = &row[body * OF_BODY.len() + 6..];
        own.iter_mut()
            .zip(right)
            .for_each(|(own, right)| *own -= right);
    }
    both
}

fn normal_and_tangential(row: &Row, contact: usize) -> [f64; 2] {
    [0, 1].map(|number| row[of_contact(contact, number)])
}

/// The change of normal and tangential force of a contact that explains all differences but for `left`.
fn change_of(
    contact: usize,
    before: &Twin,
    now: &Twin,
    differences: &[[f64; 3]; 3],
    left: f64,
) -> Option<[f64; 2]> {
    let states = [&now.states[contact], &before.states[contact]];
    let state = states.into_iter().find(|own| own.overlap > 0.0)?;
    let (one, two) = CONTACTS[contact];
    let ([x, y], [along_x, along_y, turning]) = (state.normal, differences.get(one).copied()?);
    let normal = along_x * x + along_y * y;
    let tangential = along_y * x - along_x * y;
    let mut explained = [[0.0; 3]; 3];
    explained[one] = [along_x, along_y, turning];
    if let Some(two) = two {
        explained[two] = [-along_x, -along_y, turning];
    }
    if WALL.contains(&contact) {
        explained[2][0] = normal;
    }
    // The arm of the torque is that of the surface, but for the overlap.
    let has_arm = (turning + tangential).abs() <= state.overlap * tangential.abs() + left;
    let each = explained.iter().flatten().zip(differences.iter().flatten());
    let mut each = each.map(|(one, other)| (one - other).abs());
    (has_arm && each.all(|rest| rest <= left)).then_some([normal, tangential])
}

#[cfg(test)]
mod tests {
    use super::super::invariances::starts;
    use super::*;
    use crate::dem::run_contact_test;
    use crate::series::Motion;

    #[test]
    fn the_first_wrong_force_is_told_with_its_contact_and_what_opens_then() {
        let convention = ContactConvention::TURNING;
        // The floor pushes cylinder 1 aside from some step on.
        let told_after = |first: u64| {
            let answers: Vec<Answer> =
                starts(&convention, false)
                    .into_iter()
                    .map(|start| {
                        let motion = run_contact_test(&start.test).expect("it is finite");
                        let steps = motion.rows().len() as u64 - 1;
                        let rows = motion.rows().iter().map(|row| {
                            match row.y1 < 1.0 && row.step >= first {
                                true => MotionRow {
                                    fx1: row.fx1 + 0.01,
                                    torque1: row.torque1 + 0.01,
                                    ..*row
                                },
                                false => *row,
                            }
                        });
                        Answer {
                            input_hash: String::new(),
                            motion: Motion::new(rows.collect(), steps).expect("it is whole"),
                            test: start.test,
                        }
                    })
                    .collect();
            first_wrong(&answers, convention)
        };
        let told = told_after(5).expect("a force");
        assert!(
            told.starts_with("the tangential force of cylinder 1 at the floor is "),
            "{told}"
        );
        assert!(told.contains("at step 5 of a micro-test"), "{told}");
        assert_eq!(told_after(u64::MAX), None);
    }
}
