//! The items of a check, as a table and as text.

use super::table::{Columns, DataTable};
use crate::study::check::{Grade, Item, Outcome, Report};

/// Returns the table of a check, one row per item.
pub fn check(items: &[Item]) -> DataTable<'_> {
    Columns::<&Item>::new(
        "check",
        "A row is one question to the code of a folder, and the answer.",
        "`tristack check`",
    )
    .word("grade", |item| item.grade)
    .means("`mandatory`, `consistency` or `informational`; nothing follows a mandatory item that failed")
    .text("item", |item| item.name)
    .means("the question in a few words")
    .word("outcome", |item| item.outcome)
    .means("`passed`, `failed`, `remark` or `not-tested`")
    .text("expected", |item| item.expected.clone())
    .means("what was expected; empty where it passed")
    .text("found", |item| item.found.clone())
    .means("what was found")
    .text("causes", |item| item.causes.join(" | "))
    .means("mistakes that fit what was found, or the usual ones, separated by ` | `")
    .rows(items)
}

/// Formats a report for people, item by item; a failure says what was expected, what was found, and what fits.
pub fn check_text(report: &Report) -> String {
    let mut text = String::new();
    let mut grade = None;
    let mut told: &[String] = &[];
    for item in &report.items {
        if grade.replace(item.grade) != Some(item.grade) {
            text += &format!("{}\n", title(item.grade));
        }
        text += &format!("  {:<10} {}", word(item.outcome), item.name);
        text += &match item.outcome {
            Outcome::Failed => format!(
                "\n      expected: {}\n      found:    {}\n",
                item.expected,
                indented(&item.found)
            ),
            _ => format!(": {}\n", item.found),
        };
        if item.causes.is_empty() {
            continue;
        }
        if item.causes == told {
            text += "      fits:     the same as above\n";
            continue;
        }
        told = &item.causes;
        for cause in &item.causes {
            text += &format!("      fits:     {cause}\n");
        }
    }
    text + &format!("next: {}\n", report.next)
}

fn indented(found: &str) -> String {
    found.replace('\n', "\n                ")
}

fn title(grade: Grade) -> &'static str {
    match grade {
        Grade::Mandatory => "mandatory",
        Grade::Consistency => "consistency",
        Grade::Informational => "informational",
    }
}

fn word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Passed => "passed",
        Outcome::Failed => "FAILED",
        Outcome::Remark => "remark",
        Outcome::NotTested => "not tested",
    }
}
