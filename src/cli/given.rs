//! `tristack simulate --case` of a case with a given start.

use super::out::Out;
use super::simulate::Arguments;
use super::{CliError, ExitStatus, INTERRUPT, complain};
use crate::files::Layout;
use crate::model::{InvalidValue, shown};
use crate::output::{given_runs, given_series, json};
use crate::paper::published::GivenCase;
use std::path::Path;

const SUMMARY: &str = "summary.json";
const SERIES: &str = "series.csv";

/// Runs the `case` of the file at `path`, and prints and writes the results.
pub(super) fn run(
    arguments: &Arguments,
    case: &GivenCase,
    path: &Path,
    command: &str,
) -> Result<ExitStatus, CliError> {
    refuse(arguments)?;
    let out = Out::claim(
        arguments.out.as_deref(),
        &Layout::tables(SUMMARY, &[SERIES]),
    )?;
    let Some(outcome) = case.carry_out(|| !INTERRUPT.requested()) else {
        complain!("interrupted: nothing is printed or written");
        return Ok(ExitStatus::Interrupted);
    };
    if !outcome.is_usable() {
        complain!(
            "error: the wall force in the run of {} is no number: its start is far from equilibrium",
            shown(path)
        );
        return Ok(ExitStatus::CodeFailed);
    }
    let runs = std::slice::from_ref(&outcome);
    let mut tables = vec![given_runs(runs)];
    let has_rows = !outcome.rows.is_empty();
    tables.extend(has_rows.then(|| given_series(&outcome.rows)));
    let people = || tables[0].transposed(&["value"]).terminal();
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write(|| {
        let series = has_rows.then(|| (SERIES, given_series(&outcome.rows).csv()));
        let summary = (SUMMARY, json(&tables, command));
        series.into_iter().chain([summary]).collect()
    });
    Ok(printed.max(written))
}

/// Refuses options that apply only to a prepared stack, and any code but native.
fn refuse(arguments: &Arguments) -> Result<(), CliError> {
    let invalid = |key: &str, value: String, accepted: &str| InvalidValue {
        key: key.to_owned(),
        value,
        accepted: accepted.to_owned(),
    };
    if !arguments.code().is_native() {
        let accepted = "native: no other code does what the authors' program does, which a case with a start is for";
        return Err(invalid("--code", arguments.code().to_string(), accepted).into());
    }
    if let Some(seconds) = arguments.time_limit {
        let accepted = "left out: a run from a given start has its end in the case";
        return Err(invalid("--time-limit", seconds.to_string(), accepted).into());
    }
    match arguments.pictures.named() {
        Some((flag, file)) => {
            let accepted = "left out: a case with a start keeps no places of its bodies";
            Err(invalid(flag, shown(file), accepted).into())
        }
        None => Ok(()),
    }
}
