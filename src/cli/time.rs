//! `tristack time`.

use super::convention::settle;
use super::options::{
    CodeOptions, Format, RunOptions, check_compress, find_all, power, selected_codes,
    tell_stand_ins,
};
use super::progress::{Reporter, during};
use super::stack_set::StackSet;
use super::{CliError, ExitStatus, INTERRUPT, tell};
use crate::code::RunContext;
use crate::files::{FileError, Scratch};
use crate::model::Power;
use crate::output::{AllDurations, all_durations, code_durations, durations_text};
use crate::study::Campaign;
use crate::study::cost::durations;
use crate::study::yield_force::Measurement;
use clap::Args;

/// Tell how long a crosscheck will take here
///
/// Plans the runs of the same `tristack crosscheck`, counts those that the store holds, and measures for a few seconds
/// what a step of each code costs on this machine. Recorded runs stand in for codes that are not installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack time --profile standard")]
pub(super) struct Arguments {
    #[command(flatten)]
    stacks: StackSet,
    /// Contact law: `linear` (the paper's), or `hertz`
    #[arg(long, value_parser = power, value_name = "LAW", default_value = "linear")]
    law: Power,
    #[command(flatten)]
    codes: CodeOptions,
    /// Let the wall of native runs take the shortcuts of `crosscheck --shortcuts`
    #[arg(long)]
    shortcuts: bool,
    #[command(flatten)]
    run: RunOptions,
    /// Format of the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Plans, measures and prints.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let named = arguments.codes.of_power(arguments.law)?;
    let bodies = arguments.stacks.others.bodies;
    check_compress(&named, bodies)?;
    let codes = match named.is_empty() {
        true => find_all(&arguments.stacks.codes(arguments.law)?),
        false => selected_codes(&named)?,
    };
    let settled = settle(&codes, &arguments.run)?;
    let mut measurements = arguments.stacks.measurements(&settled, arguments.law)?;
    if arguments.shortcuts {
        let shortened = measurements.into_iter().map(Measurement::shortened);
        measurements = shortened.collect();
    }
    let settings = arguments.run.settings()?;
    let outlook = Campaign::new(&codes, &settings, &Reporter::new()).outlook(&measurements);
    let temporary = std::env::temp_dir();
    let directory = Scratch::new().map_err(FileError::writing(&temporary))?;
    let context = RunContext::new(directory.path(), &INTERRUPT);
    let measured = during("timing a step of each code", || {
        durations(&outlook, &codes, bodies, (&settings, &context), |error| {
            tell!("the cost of a step could not be measured: {error}");
        })
    });
    let (rows, seconds) = match measured {
        Err(_) if INTERRUPT.requested() => return Ok(ExitStatus::Interrupted),
        measured => measured?,
    };
    let all = [AllDurations {
        jobs: settings.threads,
        runs: rows.iter().map(|row| row.runs.open).sum(),
        steps: rows.iter().map(|row| row.runs.steps).sum(),
        core_seconds: rows.iter().map(|row| row.core_seconds).sum(),
        seconds,
    }];
    let tables = [code_durations(&rows), all_durations(&all)];
    let people = || durations_text(&rows, &all[0]);
    let printed = arguments.format.print(&tables, command, people);
    tell_stand_ins(&codes, |code| {
        let mut rows = rows.iter();
        rows.any(|row| row.runs.code == *code && row.runs.there > 0)
    });
    Ok(printed)
}
