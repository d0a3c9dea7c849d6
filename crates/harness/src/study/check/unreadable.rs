//! Explanations of runs without a usable result.

use super::factor::{is_about, of_factor};
use crate::code::{Failure, FailureKind};
use crate::model::Case;
use crate::series::{NotFinite, Sample, SeriesError};
use std::fs;
use std::path::Path;

/// Largest number of files of a run directory that are named.
const MOST_NAMED: usize = 8;

/// What a failed run should have given, what was found, and the causes that fit.
pub(super) struct Unreadable {
    pub expected: String,
    pub found: String,
    pub causes: Vec<String>,
}

/// Explains the `failure` of the run of `case`, or of a micro-test where there is no case.
pub(super) fn explained(failure: &Failure, case: Option<&Case>) -> Unreadable {
    let causes = match &failure.kind {
        FailureKind::Series(error) => of_result(error, failure, case),
        FailureKind::TimedOut(limit) => vec![
            format!("it hangs, or waits for input: {limit:?} is a multiple of `seconds` in code.toml"),
            "it is slower than that: raise `seconds.step`, the seconds that one step takes".to_owned(),
        ],
        FailureKind::Ended(_) => vec![
            "it stops with an error; its last lines are below".to_owned(),
            "it needs a file that `files` of the task does not name: a run starts in an empty directory".to_owned(),
        ],
        FailureKind::Start(_) => vec!["the program, or the interpreter in its first line, is not there or not executable".to_owned()],
        FailureKind::Skipped => vec!["with {directories} in the command, a result must appear in each of them".to_owned()],
        _ => Vec::new(),
    };
    Unreadable {
        expected: "a complete result".to_owned(),
        found: failure.to_string(),
        causes,
    }
}

fn of_result(error: &SeriesError, failure: &Failure, case: Option<&Case>) -> Vec<String> {
    match (error, case) {
        (SeriesError::Absent { .. }, _) => of_absent(failure),
        (
            SeriesError::WrongStep {
                row,
                found,
                expected,
            },
            Some(case),
        ) => of_step(*row, *found, *expected, case),
        (
            SeriesError::WrongTime {
                row,
                step,
                found,
                expected,
            },
            Some(case),
        ) => of_time(*row, *step, *found, *expected, case),
        (SeriesError::Truncated { found, expected }, Some(case)) => {
            of_length(*found, *expected, case)
        }
        (SeriesError::NotFinite(found), _) => of_not_finite(found, case),
        (SeriesError::WrongStep { .. } | SeriesError::Truncated { .. }, None) => {
            vec![
                "a micro-test has one row for every step, from step 0 to `steps`, both included"
                    .to_owned(),
            ]
        }
        (SeriesError::Columns { found, .. }, Some(case)) => of_columns(found, case.stack.bodies),
        (SeriesError::Garbled { row, .. }, _) => vec![format!(
            "row {row} is not numbers separated by commas: a message of the program among the rows, a row that is cut off \
             because the file was not closed, a comma for the decimal point, or another separator"
        )],
        _ => vec![
            "the first line names the columns (docs/formats.md), separated by commas".to_owned(),
        ],
    }
}

/// Explains a missing result by naming the files that the run has left instead.
fn of_absent(failure: &Failure) -> Vec<String> {
    let own = |directory: &Path| {
        let names = fs::read_dir(directory).into_iter().flatten().flatten();
        let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
        let mut names: Vec<String> = names.filter(|name| !name.starts_with('.')).collect();
        names.sort();
        names.truncate(MOST_NAMED);
        names
    };
    let left = failure
        .run_directory
        .as_deref()
        .map(own)
        .unwrap_or_default();
    vec![format!(
        "the result has another name or lies elsewhere: `result.file` in code.toml names it, and the run left {} in its \
         working directory",
        left.join(", ")
    )]
}

/// Explains a wrong header of the series of a stack with this many bodies on the floor: columns that are missing, unknown, or
/// there more than once.
fn of_columns(found: &str, bodies: u8) -> Vec<String> {
    let expected = Sample::columns(bodies).iter().map(|column| column.name);
    let expected: Vec<&str> = expected.collect();
    let found: Vec<&str> = found.split(',').map(str::trim).collect();
    let list = |names: Vec<&str>| names.join(", ");
    let missing = expected.iter().copied();
    let missing: Vec<&str> = missing.filter(|name| !found.contains(name)).collect();
    let unknown = found.iter().copied();
    let unknown: Vec<&str> = unknown.filter(|name| !expected.contains(name)).collect();
    let mut causes = Vec::new();
    if !missing.is_empty() {
        causes.push(format!("columns are missing: {}", list(missing)));
    }
    if !unknown.is_empty() {
        let usual = "or the first line holds no names, or another separator than a comma";
        causes.push(format!("columns are unknown, {usual}: {}", list(unknown)));
    }
    let count = |name: &str| found.iter().filter(|own| **own == name).count();
    let repeated: Vec<&str> = expected
        .into_iter()
        .filter(|name| count(name) > 1)
        .collect();
    if !repeated.is_empty() {
        causes.push(format!(
            "columns are there more than once: {}",
            list(repeated)
        ));
    }
    causes
}

fn of_step(row: usize, found: u64, expected: u64, case: &Case) -> Vec<String> {
    let schedule = case.protocol.schedule();
    let before = (row >= 2)
        .then(|| schedule.sampled_steps().nth(row - 2))
        .flatten();
    let after = schedule.sampled_steps().nth(row);
    let gap = before.map(|before| found.saturating_sub(before));
    let preparation = schedule.preparation.total();
    let mut causes = Vec::new();
    if found == expected + preparation {
        causes.push(format!(
            "steps count from the beginning of the run: the {preparation} steps of the preparation come before step 0, at \
             which the wall begins to move"
        ));
    }
    if after == Some(found) {
        causes.push(format!("the row of step {expected} is missing: rows are 0, coarse_every, ... and from fine_from_step \
                             on every fine_every, up to compression_steps"));
    } else if gap == Some(1) {
        causes.push("every step is written: only the steps 0, coarse_every, ... are asked for, and every fine_every from \
                     fine_from_step on".to_owned());
    } else if gap == Some(schedule.coarse_every) && expected > schedule.fine_from_step {
        causes.push(
            "the rows stay coarse: from fine_from_step on every fine_every is asked for".to_owned(),
        );
    } else if gap == Some(schedule.fine_every) && expected <= schedule.fine_from_step {
        causes.push("the rows are fine from the beginning: before fine_from_step every coarse_every is asked for".to_owned());
    } else if found == expected + 1 {
        causes.push(
            "the row carries the number of the step after: count from 0, before positions move on"
                .to_owned(),
        );
    } else if found + 1 == expected {
        causes.push(
            "the row carries the number of the step before, or a row in between is one too many"
                .to_owned(),
        );
    }
    if found + 1 == row as u64 && found != expected || found == row as u64 && row > 1 {
        causes.push("the number of the row stands in place of the step".to_owned());
    }
    if causes.is_empty() {
        causes.push(format!(
            "the steps of the rows are 0, {}, ... up to {}, and from there every {} up to {}: coarse_every, \
             fine_from_step, fine_every, compression_steps",
            schedule.coarse_every, schedule.fine_from_step, schedule.fine_every, schedule.compression_steps
        ));
    }
    causes
}

fn of_time(row: usize, step: u64, found: f64, expected: f64, case: &Case) -> Vec<String> {
    let time_step = case.protocol.time_step;
    let preparation = case.protocol.schedule().preparation.total() as f64 * time_step;
    let apart = found - expected;
    let mut causes = Vec::new();
    if step > 0 && is_about(found, step as f64) {
        causes.push("the step stands in place of the time, which is step * time_step".to_owned());
    } else if step > 0 && is_about(found, row as f64 - 1.0) {
        causes.push("the number of the row stands in place of the time".to_owned());
    } else if is_about(apart, preparation) {
        causes.push(format!("time counts from the beginning of the run: at step 0, when the wall begins to move, it is 0; \
                             the preparation took {preparation}"));
    } else if is_about(apart.abs(), time_step) {
        causes.push("the time is that of the end of the step, or of the one before: positions, forces and time of a row \
                     belong together".to_owned());
    } else if is_about(apart.abs(), 0.5 * time_step) {
        causes.push(
            "the time is that of the velocities, half a step away from the positions".to_owned(),
        );
    } else if expected != 0.0 {
        let factor = found / expected;
        causes.push(format!("the time is {factor:.6} times step * time_step: another time step than `time_step` is used, or \
                             another unit than sqrt(m/k_n)"));
        causes.extend(of_factor(factor, case.stack.epsilon()));
    }
    if causes.is_empty() {
        causes.push(
            "time = step * time_step, counted from the step at which the wall begins to move"
                .to_owned(),
        );
    }
    causes
}

fn of_length(found: usize, expected: usize, case: &Case) -> Vec<String> {
    let schedule = case.protocol.schedule();
    let coarse = (schedule.fine_from_step / schedule.coarse_every) as usize;
    let last = schedule.compression_steps;
    if found == 0 {
        return vec!["there is a header and no row: the compression is never reached, or rows are kept in memory and not \
                     written".to_owned()];
    }
    if found + 1 == expected {
        return vec![format!(
            "the last row, of step {last}, is missing: compression_steps itself is a row, so that the loop \
                             ends one step later (in Python range(compression_steps + 1))"
        )];
    }
    if found > expected {
        return vec![format!(
            "the run goes on after step {last}, compression_steps, which is the last row"
        )];
    }
    if (coarse..=coarse + 1).contains(&found) {
        return vec![
            "the rows end where they should become fine: fine_from_step, fine_every".to_owned(),
        ];
    }
    let step = schedule.sampled_steps().nth(found - 1).unwrap_or(0);
    vec![
        format!(
            "the run ends after step {step} of {last}: a condition of its own stops it (the peak, a wall force of 0)"
        ),
        "the last rows were never written: close or flush the file".to_owned(),
    ]
}

/// Largest magnitude of a number in units of r, k_n and m that a run shows unless it explodes.
const LARGEST_USUAL: f64 = 100.0;

/// Beginning of the explanation of a run that explodes.
pub(super) const UNSTABLE: &str = "the integration is unstable";

/// Explains numbers that are not finite in a run whose time step was `divided` as well; `None` if it failed otherwise.
pub(super) fn not_by_step(failure: &Failure, divided: f64) -> Option<Vec<String>> {
    let FailureKind::Series(SeriesError::NotFinite(found)) = &failure.kind else {
        return None;
    };
    let at = match found.step {
        0 => "before the wall moves".to_owned(),
        step => format!("at step {step} or before"),
    };
    Some(vec![
        format!(
            "with the time step divided by {divided} there are no numbers either, {at}: the step is not the cause. A number \
             is divided by 0, as at an overlap of exactly 0, with which bodies that just touch begin, or is the root of a negative one"
        ),
        "energy is gained at any step: damping with the wrong sign, or a contact that pushes the wrong way".to_owned(),
    ])
}

/// Explains numbers that are not finite. An instability grows before it overflows, and takes everything along that touches.
fn of_not_finite(found: &NotFinite, case: Option<&Case>) -> Vec<String> {
    const DIVISION: &str = "a division by 0, such as the normal of two centres at the same place";
    let columns = found.columns.join(", ");
    if found.largest <= LARGEST_USUAL && found.finite > 0 {
        let others = match (found.row, case) {
            (1, None) => "nothing has moved yet",
            (1, Some(_)) => "the wall has not moved yet",
            _ => "the others, and those of the rows before, are no larger than usual",
        };
        let mut causes = vec![format!(
            "{columns} alone are no numbers, and {others}: this is no instability. What gives them is used before it is set, \
             divided by 0, or the root of a negative number"
        )];
        causes.extend(written_alone(&found.columns));
        return causes;
    }
    let (step, mut causes) = (found.step, Vec::new());
    if let Some(case) = case {
        let longest = case.stack.longest_time_step(&case.convention);
        let time_step = case.protocol.time_step;
        causes.push(format!(
            "{UNSTABLE}, at step {step} or before: time_step is {time_step}, and {longest:.2} would be \
                 stable with k_n = 1 and m = 1; a stiffness too high, a mass or an inertia too small, damping with the wrong \
                 sign, or a contact that pushes the wrong way"
        ));
    }
    causes.push(DIVISION.to_owned());
    causes
}

/// Names the contacts among the `columns` without numbers, or says that a body without a place feels forces all the same, so
/// that only what is written of it can be wrong. No force depends on an angle.
fn written_alone(columns: &[&str]) -> Option<String> {
    let is_force = |name: &&&str| {
        ["floor_", "wall_", "f", "torque"]
            .iter()
            .any(|start| name.starts_with(start))
    };
    let mut forces = columns.iter().filter(is_force);
    let contacts: Vec<String> = forces.clone().filter_map(|name| contact_of(name)).collect();
    let has_place = |name: &&str| name.starts_with(['x', 'y']);
    match forces.next() {
        None if !columns.iter().any(has_place) => None,
        None => Some(
            "all forces of the row are numbers, and would not be in such places: the motion is right, and what is written of it \
             is not"
                .to_owned(),
        ),
        Some(_) if contacts.is_empty() => None,
        Some(_) => Some(format!("it is the force of {}", contacts.join(", "))),
    }
}

/// Names the contact whose force a column holds.
fn contact_of(column: &str) -> Option<String> {
    if column == "wall_normal" || column == "wall_force" {
        return Some("cylinder 1 on the top wall".to_owned());
    }
    let body = column
        .strip_prefix("floor_n")
        .or_else(|| column.strip_prefix("floor_t"))?;
    Some(format!("cylinder {body} on the floor"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_none_are_told_from_an_instability() {
        let case = crate::study::yield_force::plan(
            &crate::code::SettledCode::native(),
            &crate::model::Stack::paper(0.3, 1e2),
            crate::model::ContactConvention::TURNING,
        )
        .cases[0];
        let told = |columns: &[&'static str], row: usize, finite: usize, largest: f64| {
            let found = NotFinite {
                row,
                step: 160 * (row as u64 - 1),
                columns: columns.to_vec(),
                value: f64::NAN,
                finite,
                largest,
            };
            of_not_finite(&found, Some(&case)).join("; ")
        };
        let places = told(&["x2", "y2"], 37, 12, 2.7);
        assert!(
            places.starts_with("x2, y2 alone are no numbers"),
            "{places}"
        );
        assert!(places.contains("the motion is right"), "{places}");
        let force = told(&["floor_t2"], 37, 13, 2.7);
        assert!(
            force.contains("the force of cylinder 2 on the floor"),
            "{force}"
        );
        let angle = told(&["theta2"], 1, 13, 2.7);
        assert!(angle.contains("the wall has not moved yet"), "{angle}");
        assert!(!angle.contains("the motion is right"), "{angle}");
        for (finite, largest) in [(13, 1e9), (0, 2.7)] {
            let exploded = told(&["x2"], 37, finite, largest);
            assert!(
                exploded.starts_with("the integration is unstable"),
                "{exploded}"
            );
        }
    }

    #[test]
    fn a_wrong_header_is_told_by_its_columns() {
        let names: Vec<&str> = Sample::columns(2).iter().map(|own| own.name).collect();
        let told = |header: &[&str]| of_columns(&header.join(","), 2);
        assert_eq!(
            told(&[&names[..], &["wall_force"]].concat()),
            ["columns are there more than once: wall_force"]
        );
        assert_eq!(told(&names[1..]), ["columns are missing: step"]);
        assert_eq!(told(&names), Vec::<String>::new());
    }
}
