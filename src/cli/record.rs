//! `tristack record`.

use super::options::{RunOptions, participants, recorded_trajectories, reference_directory};
use super::progress::Reporter;
use super::tell;
use super::trajectories::trajectories;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::archive::Run;
use crate::crosscheck::{
    Participant, Profile, Recorded, RunError, Settings, Workload, record_probe, run_all,
};
use crate::engine::EngineName;
use crate::reproduction::readings_to_record;
use crate::stack::shown;
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
    /// The readings of `tristack report`.
    Report,
}

/// Refresh the recorded runs under reference/
///
/// Runs the quick profile, the trajectories and the report with the external engines and keeps every run, or
/// what is read off it, with its provenance, so that it can stand in where an engine is not installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack record --engines yade --fresh")]
pub struct Arguments {
    /// Which engines, separated by commas; each must be installed [default: all external ones]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    engines: Vec<EngineName>,
    /// Only what one command needs [default: all]
    #[arg(long, value_enum, value_name = "COMMAND")]
    only: Option<Set>,
    #[command(flatten)]
    run: RunOptions,
}

/// Runs and records, engine by engine; an engine with a failed run keeps its old recordings.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let external: Vec<EngineName> = match arguments.engines.as_slice() {
        [] => EngineName::ALL
            .into_iter()
            .filter(|name| !name.accepts_any_convention())
            .collect(),
        named => named.to_vec(),
    };
    let participants = participants(&external)?;
    let settings = arguments.run.settings()?;
    let mut worst = ExitStatus::Success;
    for participant in participants {
        worst = worst.max(record(participant, arguments.only, &settings)?);
    }
    Ok(if INTERRUPT.requested() {
        ExitStatus::Interrupted
    } else {
        worst
    })
}

/// Records one engine, set by set.
fn record(
    participant: Participant,
    only: Option<Set>,
    settings: &Settings,
) -> Result<ExitStatus, CliError> {
    let name = participant.name;
    let participant = [participant];
    let wanted = |set: Set| only.is_none_or(|only| only == set);
    let mut worst = ExitStatus::Success;
    if wanted(Set::Probe) {
        worst = worst.max(record_probe_of(&participant[0], settings)?);
    }
    if wanted(Set::Crosscheck) {
        let plans = Profile::Quick.measurements(&[name]);
        let place = (&settings.recorded, reference_directory());
        worst = worst.max(record_runs(&plans, &participant, settings, place)?);
    }
    if wanted(Set::Trajectories) {
        let plans = trajectories(std::iter::once(name));
        let place = (
            &recorded_trajectories(),
            reference_directory().join("trajectories"),
        );
        worst = worst.max(record_runs(&plans, &participant, settings, place)?);
    }
    if wanted(Set::Report) {
        worst = worst.max(record_readings(&participant[0], settings)?);
    }
    Ok(worst)
}

/// Records what is read off the runs of the report, in place of what is there.
fn record_readings(participant: &Participant, settings: &Settings) -> Result<ExitStatus, CliError> {
    let name = participant.name;
    let reporter = Reporter::new();
    let readings = readings_to_record(participant, settings, &reporter);
    drop(reporter);
    match readings {
        Ok(readings) => {
            settings.recorded.replace_readings(name, &readings)?;
            let (count, directory) = (readings.len(), reference_directory());
            let directory = directory.join("readings");
            tell!(
                "{count} readings of {name} recorded under {}",
                shown(&directory)
            );
            Ok(ExitStatus::Success)
        }
        Err(error) => {
            tell!("the readings of {name} are not recorded: {error}");
            Ok(ExitStatus::EngineFailed)
        }
    }
}

/// Records the runs of one engine, in place of those that are there.
fn record_runs<W: Workload>(
    workloads: &[W],
    participant: &[Participant; 1],
    settings: &Settings,
    (recorded, directory): (&Recorded, PathBuf),
) -> Result<ExitStatus, CliError> {
    let name = participant[0].name;
    let reporter = Reporter::new();
    let results = run_all(workloads, participant, settings, &reporter, |run| run);
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

/// Records the probe of one engine, in place of the one that is there.
fn record_probe_of(participant: &Participant, settings: &Settings) -> Result<ExitStatus, CliError> {
    let name = participant.name;
    let reporter = Reporter::new();
    let probe = record_probe(participant, settings, &reporter);
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
