//! Verdicts as JUnit XML, for continuous integration.

use super::number::friction;
use crate::study::Verdict;
use crate::study::yield_force::{JudgedSeries, Judgement};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// Formats the rows of a crosscheck, with one suite per code.
pub fn of_rows(name: &str, judgements: &[Judgement]) -> String {
    let mut codes: Vec<&str> = Vec::new();
    for row in judgements {
        if !codes.contains(&row.code.as_str()) {
            codes.push(row.code.as_str());
        }
    }
    let suites = codes.into_iter().map(|code| {
        let own = judgements.iter().filter(|row| row.code.as_str() == code);
        suite(code, own.map(row))
    });
    document(name, suites)
}

/// Formats the verdict on series without a plan, as a suite of one test.
pub fn of_series(name: &str, judged: &JudgedSeries) -> String {
    let stack = &judged.measurement.stack;
    let reason = judged.grounds.reason();
    let place = place(stack.floor_friction, stack.stiffness);
    let case = TestCase::new(place, status(judged.grounds.verdict(), &reason));
    document(name, [suite("series", [case])])
}

/// Formats a document of `suites`.
pub(super) fn document(name: &str, suites: impl IntoIterator<Item = TestSuite>) -> String {
    let mut report = Report::new(name);
    report.add_test_suites(suites);
    report.to_string().expect("plain text has an XML form") + "\n"
}

/// Collects `cases` in a suite.
pub(super) fn suite(name: &str, cases: impl IntoIterator<Item = TestCase>) -> TestSuite {
    let mut suite = TestSuite::new(name);
    suite.add_test_cases(cases);
    suite
}

/// Converts a row of a crosscheck to a test case.
pub(super) fn row(row: &Judgement) -> TestCase {
    let name = format!("{} at {}", row.code, place(row.mu(), row.stiffness()));
    let status = match row.passes() {
        true => TestCaseStatus::success(),
        false => {
            let shown = match row.grounds.is_contradicted() {
                true => Verdict::Differs,
                false => row.verdict(),
            };
            let mut status = status(shown, &row.reason());
            if let Some(cause) = row.grounds.cause() {
                status.set_type(cause.as_str());
            }
            status
        }
    };
    TestCase::new(name, status)
}

fn place(mu: f64, stiffness: f64) -> String {
    format!("mu = {}, stiffness = {stiffness}", friction(mu))
}

/// Converts a verdict to the status of a test; `text` is its message, unless the verdict is `Agrees`.
pub(super) fn status(verdict: Verdict, text: &str) -> TestCaseStatus {
    let mut status = match verdict {
        Verdict::Agrees => return TestCaseStatus::success(),
        Verdict::Differs => TestCaseStatus::non_success(NonSuccessKind::Failure),
        Verdict::Failed | Verdict::NoYield => TestCaseStatus::non_success(NonSuccessKind::Error),
        Verdict::Inconclusive | Verdict::Missing => TestCaseStatus::skipped(),
    };
    status.set_type(verdict.as_str()).set_message(text);
    status
}
