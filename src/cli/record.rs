//! `tristack record`.

use super::options::{RunOptions, participants, reference_directory};
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::archive::Run;
use crate::crosscheck::{
    Measurement, Participant, Profile, RunError, Settings, plan, record_probe, run_all,
};
use crate::engine::EngineName;
use clap::Args;

/// Refresh the recorded runs under reference/
///
/// Runs the quick profile with the external engines and keeps every run with its provenance, so that it
/// can stand in where an engine is not installed.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack record --engines yade --fresh")]
pub struct Arguments {
    /// Which engines, separated by commas; each must be installed [default: all external ones]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    engines: Vec<EngineName>,
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
        worst = worst.max(record(participant, &settings)?);
    }
    Ok(if INTERRUPT.requested() {
        ExitStatus::Interrupted
    } else {
        worst
    })
}

fn record(participant: Participant, settings: &Settings) -> Result<ExitStatus, CliError> {
    let name = participant.name;
    let stacks = Profile::Quick.stacks();
    let measurements: Vec<Measurement> = stacks
        .iter()
        .map(|stack| plan(name, stack, name.convention()))
        .collect();
    let reporter = Reporter::new();
    let probe = record_probe(&participant, settings, &reporter);
    let results = run_all(&measurements, &[participant], settings, &reporter, |run| {
        run
    });
    drop(reporter);
    let probe = match probe {
        Ok(probe) => probe,
        Err(error) => {
            eprintln!("{name} is not recorded: {error}");
            return Ok(ExitStatus::EngineFailed);
        }
    };
    let runs: Result<Vec<Run>, RunError> = results.into_iter().flatten().collect();
    match runs {
        Ok(runs) => {
            settings.recorded.replace(name, &runs)?;
            settings.recorded.replace_probe(name, &probe)?;
            let directory = reference_directory();
            eprintln!(
                "{} runs and the probe of {name} recorded under {}",
                runs.len(),
                directory.display()
            );
            Ok(ExitStatus::Success)
        }
        Err(error) => {
            eprintln!("{name} is not recorded: {error}");
            Ok(ExitStatus::EngineFailed)
        }
    }
}
