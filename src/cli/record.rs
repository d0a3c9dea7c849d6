//! `tristack record`.

use super::options::{CodeParser, RunOptions, reference_directory, selected_codes};
use super::progress::Reporter;
use super::tell;
use super::trajectories::plans;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::code::Run;
use crate::model::shown;
use crate::paper::reproduction::summaries_to_record;
use crate::runs::{Recorded, RunError, SelectedCode, Settings, Workload, run_all};
use crate::study::Study;
use crate::study::convention::record_probe;
use crate::study::yield_force::Profile;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// A part of what is recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Set {
    /// The answers to `tristack probe`.
    Probe,
    /// The quick profile of `tristack crosscheck`.
    Crosscheck,
    /// The series of `tristack trajectories`.
    Trajectories,
    /// The summaries of `tristack report`.
    Report,
}

/// Refresh the recorded runs under reference/
///
/// Runs the quick profile, the trajectories and the report with the external codes and keeps every run, or
/// what is read off it, with its provenance, so that it can stand in where an code is not installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack record --codes yade --fresh")]
pub struct Arguments {
    /// Which codes, separated by commas; each must be installed [default: all external ones]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    /// Only what one command needs [default: all]
    #[arg(long, value_enum, value_name = "COMMAND")]
    only: Option<Set>,
    #[command(flatten)]
    run: RunOptions,
}

/// Runs and records, code by code; an code with a failed run keeps its old recordings.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let external: Vec<Code> = match arguments.codes.as_slice() {
        [] => Code::all()
            .into_iter()
            .filter(|name| !name.accepts_any_convention())
            .collect(),
        named => named.to_vec(),
    };
    let codes = selected_codes(&external)?;
    let settings = arguments.run.settings()?;
    let mut worst = ExitStatus::Success;
    for selected in codes {
        worst = worst.max(record(selected, arguments.only, &settings)?);
    }
    Ok(if INTERRUPT.requested() {
        ExitStatus::Interrupted
    } else {
        worst
    })
}

/// Records one code, set by set.
fn record(
    selected: SelectedCode,
    only: Option<Set>,
    settings: &Settings,
) -> Result<ExitStatus, CliError> {
    let name = selected.name;
    let selected = [selected];
    let wanted = |set: Set| only.is_none_or(|only| only == set);
    let mut worst = ExitStatus::Success;
    if wanted(Set::Probe) {
        worst = worst.max(record_probe_of(&selected[0], settings)?);
    }
    if wanted(Set::Crosscheck) {
        let plans = Profile::Quick.measurements(&[name]);
        let plans: Vec<Workload> = plans.iter().flat_map(Study::workloads).collect();
        let place = (&settings.recorded, reference_directory());
        worst = worst.max(record_runs(&plans, &selected, settings, place)?);
    }
    if wanted(Set::Trajectories) {
        let planned = plans(std::iter::once(name));
        let plans: Vec<Workload> = planned
            .iter()
            .filter_map(|plan| plan.workloads().into_iter().next())
            .collect();
        let place = (
            &Recorded::new(&reference_directory().join("trajectories")),
            reference_directory().join("trajectories"),
        );
        worst = worst.max(record_runs(&plans, &selected, settings, place)?);
    }
    if wanted(Set::Report) {
        worst = worst.max(record_summaries(&selected[0], settings)?);
    }
    Ok(worst)
}

/// Records what is read off the runs of the report, in place of what is there.
fn record_summaries(selected: &SelectedCode, settings: &Settings) -> Result<ExitStatus, CliError> {
    let name = selected.name;
    let reporter = Reporter::new();
    let summaries = summaries_to_record(selected, settings, &reporter);
    drop(reporter);
    match summaries {
        Ok(summaries) => {
            settings.recorded.replace_summaries(name, &summaries)?;
            let (count, directory) = (summaries.len(), reference_directory());
            let directory = directory.join("summaries");
            tell!(
                "{count} summaries of {name} recorded under {}",
                shown(&directory)
            );
            Ok(ExitStatus::Success)
        }
        Err(error) => {
            tell!("the summaries of {name} are not recorded: {error}");
            Ok(ExitStatus::EngineFailed)
        }
    }
}

/// Records the runs of one code, in place of those that are there.
fn record_runs(
    workloads: &[Workload],
    selected: &[SelectedCode; 1],
    settings: &Settings,
    (recorded, directory): (&Recorded, PathBuf),
) -> Result<ExitStatus, CliError> {
    let name = selected[0].name;
    let reporter = Reporter::new();
    let results = run_all(workloads, selected, settings, &reporter, |run| run);
    drop(reporter);
    let runs: Result<Vec<Run>, RunError> = results.into_iter().flatten().collect();
    match runs {
        Ok(runs) => {
            recorded.replace(name, &runs)?;
            let directory = directory.join(name.as_str());
            let count = runs.len();
            tell!(
                "{count} runs of {name} recorded under {}",
                shown(&directory)
            );
            Ok(ExitStatus::Success)
        }
        Err(error) => {
            tell!("the runs of {name} are not recorded: {error}");
            Ok(ExitStatus::EngineFailed)
        }
    }
}

/// Records the probe of one code, in place of the one that is there.
fn record_probe_of(selected: &SelectedCode, settings: &Settings) -> Result<ExitStatus, CliError> {
    let name = selected.name;
    let reporter = Reporter::new();
    let probe = record_probe(selected, settings, &reporter);
    drop(reporter);
    match probe {
        Ok(probe) => {
            settings.recorded.replace_probe(name, &probe)?;
            let directory = reference_directory();
            tell!("probe of {name} recorded under {}", shown(&directory));
            Ok(ExitStatus::Success)
        }
        Err(error) => {
            tell!("the probe of {name} is not recorded: {error}");
            Ok(ExitStatus::EngineFailed)
        }
    }
}
