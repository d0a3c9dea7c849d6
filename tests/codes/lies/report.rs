//! The smallest alterations that do not agree, for docs/reliability.md.

use super::engine::Honest;
use super::in_parallel;
use super::lie::{Kind, Lie};
use serde_json::{Value, json};
use std::ffi::OsStr;
use tristack::study::Verdict;

/// Sizes that are tried: six a decade from 1e-12 to 0.5.
const SIZES_A_DECADE: f64 = 6.0;
const SMALLEST: f64 = 1e-12;
const LARGEST: f64 = 0.5;

/// Writes it, with the number of `rounds` that went before, to the file at `path`.
pub fn write(path: &OsStr, rounds: usize) {
    let honest: Vec<Honest> = Honest::all();
    let native = honest
        .iter()
        .filter(|honest| honest.label().starts_with("native"));
    let jobs: Vec<(Kind, &Honest)> = native
        .flat_map(|honest| Kind::ALL.map(|kind| (kind, honest)))
        .filter(|(kind, _)| *kind != Kind::FewDigits)
        .collect();
    let rows = in_parallel(jobs.len(), |index| row(jobs[index].0, jobs[index].1));
    let report = json!({
        "command": "bash .ci/reliability lies",
        "commit": commit(),
        "machine": tristack::code::machine(),
        "date": jiff::Timestamp::now().to_string(),
        "rounds": rounds,
        "rows": rows,
    });
    let text = serde_json::to_string_pretty(&report).expect("plain data");
    std::fs::write(path, text + "\n").expect("the report can be written");
}

/// The sources that are tried.
fn commit() -> String {
    let mut command = std::process::Command::new("git");
    let output = command.args(["describe", "--always", "--dirty", "--abbrev=12"]);
    let output = output.output().expect("git runs");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

/// The largest size below which an alteration agrees, either sign, by bisection over the sizes.
fn row(kind: Kind, honest: &Honest) -> Value {
    let steps = (SIZES_A_DECADE * (LARGEST / SMALLEST).log10()) as i32;
    let size = |step: i32| LARGEST * 10f64.powf(f64::from(step - steps) / SIZES_A_DECADE);
    let agrees = |size: f64| {
        let agrees = |size| honest.judge(&Lie::of(kind, size)).verdict == Verdict::Agrees;
        // More friction between the cylinders changes nothing.
        agrees(-size) || (kind != Kind::CylinderFriction && agrees(size))
    };
    let (mut low, mut high) = (0, steps);
    let seen = (!agrees(size(high))).then(|| {
        while high - low > 1 {
            let middle = (low + high) / 2;
            if agrees(size(middle)) {
                low = middle;
            } else {
                high = middle;
            }
        }
        size(high)
    });
    let moved = seen.map(|seen| {
        let moved = |size| Lie::of(kind, size).moves_yield_force_by(&honest.measurement);
        moved(seen).max(moved(-seen))
    });
    json!({
        "kind": words(kind),
        "mu": honest.measurement.stack.floor_friction,
        "stiffness": honest.measurement.stack.stiffness,
        "tolerance": honest.tolerance,
        "smallest": seen,
        "moves": moved,
    })
}

/// `FloorFriction` as "floor friction".
fn words(kind: Kind) -> String {
    let letters = format!("{kind:?}");
    let words = letters.chars().flat_map(|letter| {
        let space = letter.is_uppercase().then_some(' ');
        space.into_iter().chain(letter.to_lowercase())
    });
    words.collect::<String>().trim().to_owned()
}
