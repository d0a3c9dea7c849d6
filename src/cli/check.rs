//! `tristack check`.

use super::code_names::code_in_folder;
use super::findings::exchange;
use super::options::{Format, StoreOptions, seconds, time_limit};
use super::progress::during;
use super::{CliError, ExitStatus, INTERRUPT, complain, tell};
use crate::code::{Code, RunContext};
use crate::files::FileError;
use crate::model::shown;
use crate::output::{check, check_text};
use crate::runs::Finder;
use crate::study::check::{Grade, Report, check as check_code};
use clap::Args;
use std::path::Path;

/// Check the folder of a code before anything is judged, and explain what is wrong
///
/// Goes through what is mandatory (manifest, program, a small task), what mechanics and the task demand (weight on the
/// floor, balance of forces, signs and units, symmetry, the parameters as micro-tests measure them), and what is worth
/// knowing (reproducible bits, the measured convention). For each failure it says what was expected, what was found, and
/// which mistakes fit that. Its runs are made anew in every check, and are not kept;
/// the store has what `probe` and `crosscheck` have found about this very folder, and tells them what is wrong.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack check ./mydem")]
pub(super) struct Arguments {
    /// Folder with a code.toml; FOLDER:NAME for one of several codes in it
    #[arg(value_name = "FOLDER")]
    folder: String,
    /// Longest time without a finished task, in seconds [default: 30 s plus 100 us per step]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<f64>,
    #[command(flatten)]
    store: StoreOptions,
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
            let mut report = report.map_err(FileError::writing(&place))?;
            if INTERRUPT.requested() {
                // What ended with the interrupt is no mistake of the code, and nobody knows which items those are.
                complain!(
                    "the check of {} was not finished, and its items are not printed; the same command begins anew",
                    shown(Path::new(folder))
                );
                return Ok(ExitStatus::Interrupted);
            }
            exchange_findings(&code, &mut report, &arguments.store)?;
            report
        }
        Err(error) => Report::of_manifest(&error.to_string(), folder),
    };
    let tables = [check(&report.items)];
    let printed = arguments
        .format
        .print(&tables, command, || check_text(&report));
    Ok(conclude(&report).max(printed))
}

/// Adds to the report what other commands have found about `code`, and keeps for them what is wrong. A store is created
/// only for something that is wrong, and one that is not named by an option, and cannot be opened, is done without.
fn exchange_findings(
    code: &Code,
    report: &mut Report,
    options: &StoreOptions,
) -> Result<(), CliError> {
    let is_named = options.store.is_some() || options.shared_store;
    let is_there = options.directory().is_ok_and(|place| place.exists());
    let wrong = report.wrong();
    if INTERRUPT.requested() || !is_there && !is_named && wrong.is_empty() {
        return Ok(());
    }
    let Some(installed) = code.find().filter(|own| own.broken().is_none()) else {
        return Ok(());
    };
    let store = match options.opened() {
        Ok(store) => store,
        Err(error) if is_named => return Err(error),
        Err(error) => {
            report.add_of_others(format!("they will not know of this check: {error}"));
            return Ok(());
        }
    };
    let exchanged = exchange(Finder::Check, &*installed, &store, wrong);
    exchanged
        .into_iter()
        .for_each(|told| report.add_of_others(told));
    Ok(())
}

/// Summarizes the items on standard error, and returns the exit status.
fn conclude(report: &Report) -> ExitStatus {
    let failures = report.failures().count();
    tell!("{} of {} items failed", failures, report.items.len());
    match report.failed_grade() {
        None => ExitStatus::Success,
        Some(Grade::Mandatory) if report.items.len() == 1 => ExitStatus::WrongInput,
        Some(Grade::Mandatory) => ExitStatus::CodeFailed,
        Some(_) => ExitStatus::Disagreement,
    }
}
