//! Which rows are printed, and their verdicts for continuous integration.

use super::format::Format;
use crate::cli::out::write;
use crate::cli::{ExitStatus, print};
use crate::output::{crosscheck, crosscheck_summary, crosscheck_text, junit};
use crate::study::yield_force::Judgement;
use clap::Args;
use std::path::PathBuf;

/// The name of the test suites in JUnit XML.
const SUITES: &str = "tristack";

/// What is printed of the rows of a crosscheck.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct RowOptions {
    /// Print only rows that do not pass; a row passes if it agrees, or has no yield as expected. Files have all rows
    #[arg(long, conflicts_with = "summary")]
    only_failures: bool,
    /// Print how many rows of each code have which verdict and where its largest error is, instead of the rows
    #[arg(long)]
    summary: bool,
    /// JUnit XML with a test for each row, for continuous integration: `differs` and a convention that the probe
    /// contradicts are failures, `failed` and `no-yield` where a yield is expected are errors, `inconclusive` and
    /// `missing` skipped
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
}

impl RowOptions {
    /// Prints the rows that are asked for.
    pub fn print(&self, judgements: &[Judgement], format: Format, command: &str) -> ExitStatus {
        if self.summary {
            let tables = [crosscheck_summary(judgements)];
            return format.print(&tables, command, || tables[0].shown().terminal());
        }
        if !self.only_failures {
            let tables = [crosscheck(judgements)];
            return format.print(&tables, command, || crosscheck_text(judgements));
        }
        let failures = judgements.iter();
        let failures = failures.filter(|row| !row.passes());
        let failures: Vec<Judgement> = failures.cloned().collect();
        if failures.is_empty() && format == Format::Table {
            return print(&format!("no failure among {} rows\n", judgements.len()));
        }
        let tables = [crosscheck(&failures)];
        format.print(&tables, command, || crosscheck_text(&failures))
    }

    /// Writes the verdicts of all rows as JUnit XML, if there is a file for them and the result `is_whole`.
    pub fn write_junit(&self, judgements: &[Judgement], is_whole: bool) -> ExitStatus {
        match self.junit.as_deref().filter(|_| is_whole) {
            Some(file) => write(file, junit::of_rows(SUITES, judgements).as_bytes()),
            None => ExitStatus::Success,
        }
    }
}
