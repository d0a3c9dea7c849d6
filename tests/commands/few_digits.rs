//! A code that prints fewer digits than its numbers have: what the missing digits leave open is no disagreement.

use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, json_rows, recording};
use rayon::prelude::*;
use std::process::Output;
use tristack::code::Code;
use tristack::dem::run_contact_test;
use tristack::model::{ContactTest, Power};
use tristack::output::passport_json;
use tristack::runs::{Answer, ProbeRecord};
use tristack::series::{Motion, MotionRow};
use tristack::study::atlas::difference;
use tristack::study::convention::{PassportFile, TOLERANCE, passport, probe, read_probe};

/// `series` with every number but the step as `print` gives it.
fn reprinted(series: &str, print: impl Fn(f64) -> String) -> String {
    let lines = series.lines().enumerate().map(|(row, line)| {
        let cells = line.split(',').enumerate().map(|(column, cell)| {
            let number = cell.parse().ok().filter(|_| row > 0 && column > 1);
            number.map_or(cell.to_owned(), &print)
        });
        cells.collect::<Vec<_>>().join(",") + "\n"
    });
    lines.collect()
}

fn six_digits(series: String) -> String {
    reprinted(&series, |number| format!("{number:.5e}"))
}

fn six_decimals(series: String) -> String {
    reprinted(&series, |number| format!("{number:.6}"))
}

fn thirteen_digits(series: String) -> String {
    reprinted(&series, |number| format!("{number:.12e}"))
}

/// A crosscheck of honest series, all of them printed in the same way.
fn crosscheck(print: fn(String) -> String) -> Output {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::Change(print));
    let mut command = bench.tristack("crosscheck --codes yade --format json");
    command.output().expect("it runs")
}

fn verdicts(output: &Output) -> Vec<String> {
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let verdicts = rows
        .iter()
        .map(|row| row["verdict"].as_str().expect("a verdict").to_owned());
    verdicts.collect()
}

#[test]
fn few_digits_leave_open_what_they_do_not_show() {
    for (print, reason) in [
        (six_digits as fn(String) -> String, "printed with 6 digits"),
        (six_decimals, "printed with "),
    ] {
        let output = crosscheck(print);
        let message = String::from_utf8_lossy(&output.stderr);
        let verdicts = verdicts(&output);
        assert_eq!(verdicts, vec!["inconclusive"; 18], "{message}");
        assert_eq!(message.matches(reason).count(), 18, "{message}");
        assert_eq!(output.status.code(), Some(4), "{message}");
    }
}

#[test]
fn enough_digits_decide_as_all_of_them_do() {
    let output = crosscheck(thirteen_digits);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(verdicts(&output), vec!["agrees"; 18], "{message}");
    assert_eq!(output.status.code(), Some(0), "{message}");
}

/// Otherwise the verdicts of recorded runs would change.
#[test]
fn recorded_runs_are_printed_in_full() {
    for code in Code::with_power(Power::Linear) {
        let few = recording(&code)
            .runs
            .iter()
            .filter(|run| run.summary.estimates.printed.is_some())
            .count();
        assert_eq!(few, 0, "{code}");
        for run in recording(&code).runs {
            let Some(series) = run.series else { continue };
            let estimates = tristack::series::YieldEstimates::read(&series, &run.summary.case);
            assert_eq!(estimates.printed, None, "{code}, {}", run.summary.case);
        }
    }
}

/// How a code prints its numbers, in words and as it is done.
type Printed = (String, Box<dyn Fn(f64) -> f64 + Sync>);

fn significant(digits: usize) -> Printed {
    let print = move |value: f64| read(&format!("{value:.*e}", digits - 1));
    (format!("{digits} digits"), Box::new(print))
}

fn decimals(decimals: usize) -> Printed {
    let print = move |value: f64| read(&format!("{value:.decimals$}"));
    (format!("{decimals} decimals"), Box::new(print))
}

fn single() -> Printed {
    let print = |value: f64| f64::from(value as f32);
    ("single precision".to_owned(), Box::new(print))
}

fn read(text: &str) -> f64 {
    text.parse().expect("a number")
}

/// `motion` with every number but the step as `print` gives it.
fn printed(motion: &Motion, print: impl Fn(f64) -> f64) -> Motion {
    let rows = motion.rows().iter().map(|row| {
        let mut own = *row;
        for column in MotionRow::columns(true).iter().skip(1) {
            (column.set)(&mut own, print((column.value)(row)));
        }
        own
    });
    let rows: Vec<MotionRow> = rows.collect();
    let steps = rows.len() as u64 - 1;
    Motion::new(rows, steps).expect("it is whole")
}

/// The passport of the native code, whose floor has `friction` times what it is asked for, if it prints as `print` does.
fn passport_of(print: impl Fn(f64) -> f64, friction: f64) -> PassportFile {
    let code = Code::native();
    let mut answers = Vec::new();
    let answered = probe(&code.declaration(), |tests: &[ContactTest]| {
        let motions = tests.iter().map(|test| {
            let made = ContactTest {
                floor_friction: test.floor_friction * friction,
                ..*test
            };
            let motion = printed(&run_contact_test(&made).expect("it is finite"), &print);
            answers.push(Answer {
                test: *test,
                input_hash: String::new(),
                motion: motion.clone(),
            });
            Ok::<_, ()>(motion)
        });
        motions.collect()
    });
    answered.expect("every test is answered");
    // Any will do.
    let recorded = recording(&Code::named("yade").expect("a code"));
    let provenance = recorded.probe.expect("it is there").provenance;
    let record = ProbeRecord {
        provenance,
        answers,
    };
    let findings = read_probe(&code, record).expect("every test is answered");
    let text = passport_json(&passport(&code, &findings), "tristack probe");
    PassportFile::read(text.as_bytes()).expect("a passport")
}

#[test]
fn digits_change_no_passport_and_a_coefficient_does() {
    let whole = passport_of(|value| value, 1.0);
    assert_eq!(whole.is_coarse_because(), None);
    let ways: Vec<Printed> = (5..=16)
        .map(significant)
        .chain([decimals(6), decimals(9), single()])
        .collect();
    let told = ways.par_iter().filter_map(|(way, print)| {
        let same = passport_of(print, 1.0);
        let found = difference(&whole, &same);
        let is_coarse = same.is_coarse_because().is_some();
        let friction = same.property("floor_friction").expect("it is measured");
        let Some((asked, open)) = friction.declared.zip(friction.uncertainty) else {
            // Where no uncertainty can be stated, it is said that the value is not known.
            let is_said = found.unknown.contains(&"floor_friction".to_owned());
            let is_right = is_coarse && found.is_none() && is_said;
            return (!is_right).then(|| format!("{way}: {found:?}"));
        };
        // Below the tolerance of the probe nothing changes.
        let off = (5.0 * open / asked).max(2.0 * TOLERANCE);
        let other = difference(&whole, &passport_of(print, 1.0 + off));
        let names: Vec<&str> = other.changes.iter().map(|own| own.name.as_str()).collect();
        let is_right = is_coarse && found.is_none() && names.contains(&"floor_friction");
        (!is_right).then(|| format!("{way}: {found:?}; off by {off:e}: {names:?}"))
    });
    let told: Vec<String> = told.collect();
    assert!(told.is_empty(), "{}", told.join("\n"));
    // What the digits do not show is named.
    let found = difference(&whole, &passport_of(significant(8).1, 1.0));
    assert!(!found.unknown.is_empty());
}
