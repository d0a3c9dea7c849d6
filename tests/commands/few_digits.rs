//! A code that prints fewer digits than its numbers have: what the missing digits leave open is no disagreement.

use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, json_rows, recording};
use std::process::Output;
use tristack::code::Code;
use tristack::model::Power;

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
