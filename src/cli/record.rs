//! `tristack record`.

use super::convention::settle;
use super::options::{
    CodeList, CodeListParser, RunOptions, check_compress, recording_directory, selected_codes,
};
use super::progress::Reporter;
use super::trajectories::plans;
use super::{CliError, ExitStatus, INTERRUPT, complain, tell};
use crate::code::{Code, Run, SettledCode};
use crate::model::shown;
use crate::model::{PAPER_BODIES, Power};
use crate::paper::reproduction::summaries_to_record;
use crate::runs::{
    Progress, Recorded, RecordedRun, Recording, RunError, RunSummary, SelectedCode, Settings,
    Workload, read_all,
};
use crate::study::Study;
use crate::study::convention::probe_records;
use crate::study::yield_force::Profile;
use clap::{Args, ValueEnum};
use std::path::Path;

/// The recorded runs of one command.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Set {
    /// The answers to `tristack probe`.
    Probe,
    /// The quick profile of `tristack crosscheck`, under the law of the code.
    Crosscheck,
    /// The series of `tristack trajectories`.
    Trajectories,
    /// The summaries of `tristack report`.
    Report,
}

/// Refresh the recorded runs that stand in for codes that are not installed
///
/// Runs crosscheck, trajectories, probe and report with the external codes. For each code, writes CODE.csv with
/// a summary and the provenance of every run, and CODE.tar.gz with the series of the trajectories and the
/// answers to the probe. They go to the directory that TRISTACK_REFERENCE names, or to reference/recorded of the
/// checkout in which the command is given, from which the next build of the program embeds them.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack record --codes yade --fresh")]
pub(super) struct Arguments {
    /// Codes to record, separated by commas; each must be installed [default: all external codes]
    #[arg(long, alias = "code", value_parser = CodeListParser, value_name = "C1,C2")]
    codes: Vec<CodeList>,
    /// Record only the runs of this command and keep the others [default: replace all recorded runs]
    #[arg(long, value_enum, value_name = "COMMAND")]
    only: Option<Set>,
    #[command(flatten)]
    run: RunOptions,
}

/// Records code by code; a code with a failed run keeps its old recordings.
pub(super) fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut external = CodeList::all(&arguments.codes);
    if external.is_empty() {
        external = Code::built_in();
        external.retain(|code| !code.accepts_any_convention());
    }
    if arguments.only != Some(Set::Probe) {
        check_compress(&external, PAPER_BODIES)?;
    }
    let codes = selected_codes(&external)?;
    let directory = recording_directory()?;
    for selected in &codes {
        Recording::check_place(&directory, &selected.name)?;
    }
    let settled = settle(&codes, &arguments.run)?;
    let settings = arguments.run.settings()?;
    let mut worst = ExitStatus::Success;
    for (selected, code) in codes.iter().zip(&settled) {
        worst = worst.max(record(
            (selected, code),
            arguments.only,
            &settings,
            &directory,
        )?);
        if INTERRUPT.requested() {
            return Ok(ExitStatus::Interrupted);
        }
    }
    Ok(worst)
}

/// Records one code.
fn record(
    (selected, code): (&SelectedCode, &SettledCode),
    only: Option<Set>,
    settings: &Settings,
    directory: &Path,
) -> Result<ExitStatus, CliError> {
    let name = selected.name.clone();
    let mut recording = match only {
        Some(_) => Recorded::new(directory).recording(&name)?,
        None => Recording::default(),
    };
    let made = make(
        &mut recording,
        (selected, code),
        only,
        settings,
        &Reporter::new(),
    );
    if let Err(error) = made {
        complain!("{name} is not recorded: {error}");
        return Ok(ExitStatus::CodeFailed);
    }
    recording.save(directory, &name)?;
    let (count, directory) = (recording.runs.len(), shown(directory));
    tell!(
        "{count} runs of {name} are recorded in {directory}; the next build of the program embeds them"
    );
    Ok(ExitStatus::Success)
}

/// Runs the wanted parts with one code, and puts them into `recording`.
fn make(
    recording: &mut Recording,
    (selected, code): (&SelectedCode, &SettledCode),
    only: Option<Set>,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<(), RunError> {
    // Only series of linear springs are kept: those of the nine Hertz styles would take more than twice their space.
    let is_paper = selected.name.has_power(Power::Linear);
    let wanted = |set: Set| {
        let asked = only.is_none_or(|only| only == set);
        asked && (is_paper || set != Set::Trajectories)
    };
    if wanted(Set::Probe) {
        let codes = std::slice::from_ref(selected);
        let records = probe_records(codes, settings, progress).into_iter();
        recording.probe = records.last().transpose()?;
    }
    let mut summaries = Vec::new();
    if wanted(Set::Crosscheck) {
        summaries = quick_profile((selected, code), settings, progress)?;
    }
    if wanted(Set::Report) {
        summaries.extend(summaries_to_record(selected, settings, progress)?);
    }
    for summary in summaries {
        recording.put(RecordedRun::without_series(summary));
    }
    if wanted(Set::Trajectories) {
        for run in trajectory_runs((selected, code), settings, progress)? {
            recording.put(RecordedRun::with_series(run));
        }
    }
    Ok(())
}

/// The rings of spheres whose quick profile is recorded.
const RINGS: [u8; 2] = [3, 4];

fn quick_profile(
    (selected, code): (&SelectedCode, &SettledCode),
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<RunSummary>, RunError> {
    let power = selected.name.law().power;
    let mut stacks = Profile::Quick.stacks(power, PAPER_BODIES);
    if selected.name.stacks_spheres() && power == Power::Linear {
        stacks.extend(
            RINGS
                .map(|bodies| Profile::Quick.stacks(power, bodies))
                .concat(),
        );
    }
    let plans = Profile::Quick.measurements_of(&stacks, std::slice::from_ref(code), power);
    let workloads: Vec<Workload> = plans.iter().flat_map(Study::workloads).collect();
    let codes = std::slice::from_ref(selected);
    let results = read_all(&workloads, codes, settings, progress);
    results.into_iter().flatten().collect()
}

fn trajectory_runs(
    (selected, code): (&SelectedCode, &SettledCode),
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<Run>, RunError> {
    let plans = plans(std::slice::from_ref(code), PAPER_BODIES);
    // The code's own runs; native ones are never recorded.
    let own = plans
        .iter()
        .filter_map(|plan| plan.workloads().into_iter().next());
    let workloads: Vec<Workload> = own.collect();
    let codes = std::slice::from_ref(selected);
    let results = read_all(&workloads, codes, settings, progress);
    results.into_iter().flatten().collect()
}
