//! `tristack check`.

use super::code_names::code_in_folder;
use super::options::{Format, seconds, time_limit};
use super::progress::during;
use super::{CliError, ExitStatus, INTERRUPT, tell};
use crate::code::RunContext;
use crate::files::FileError;
use crate::model::shown;
use crate::output::{check, check_text};
use crate::study::check::{Grade, Report, check as check_code};
use clap::Args;
use std::path::Path;

/// Check the folder of a code before anything is judged, and explain what is wrong
///
/// Goes through what is mandatory (manifest, program, a small task), what mechanics and the task demand (weight on the
/// floor, balance of forces, signs and units, symmetry, the parameters as micro-tests measure them), and what is worth
/// knowing (reproducible bits, the measured convention). For each failure it says what was expected, what was found, and
/// which mistakes fit that. There is no --store: its runs are made anew in every check, since a stored run would be that of an
/// earlier state of what is being checked, and they are not kept.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack check ./mydem")]
pub(super) struct Arguments {
    /// Folder with a code.toml; FOLDER:NAME for one of several codes in it
    #[arg(value_name = "FOLDER")]
    folder: String,
    /// Longest time without a finished task, in seconds [default: 30 s plus 100 us per step]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<f64>,
    /// Format of the items
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Checks the folder and prints the items.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let limit = time_limit(arguments.time_limit)?;
    let folder = &arguments.folder;
    let report = match code_in_folder(folder) {
        Ok(code) => {
            let place = std::env::temp_dir();
            let context = RunContext {
                time_limit: limit,
                ..RunContext::new(&place, &INTERRUPT)
            };
            let phase = format!("checking {}", shown(Path::new(folder)));
            let report = during(&phase, || check_code(&code, folder, &context));
            report.map_err(FileError::writing(&place))?
        }
        Err(error) => Report::of_manifest(&error.to_string(), folder),
    };
    let tables = [check(&report.items)];
    let printed = arguments
        .format
        .print(&tables, command, || check_text(&report));
    Ok(conclude(&report).max(printed))
}

/// Summarizes the items on standard error, and returns the exit status.
fn conclude(report: &Report) -> ExitStatus {
    if INTERRUPT.requested() {
        return ExitStatus::Interrupted;
    }
    let failures = report.failures().count();
    tell!("{} of {} items failed", failures, report.items.len());
    match report.failed_grade() {
        None => ExitStatus::Success,
        Some(Grade::Mandatory) if report.items.len() == 1 => ExitStatus::WrongInput,
        Some(Grade::Mandatory) => ExitStatus::CodeFailed,
        Some(_) => ExitStatus::Disagreement,
    }
}
