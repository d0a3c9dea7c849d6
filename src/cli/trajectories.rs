//! `tristack trajectories`.

use super::options::{Format, RunOptions, selected_codes, tell_stand_ins, writable};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::{FileError, write_atomically};
use crate::model::InvalidValue;
use crate::output::{
    trajectories_csv, trajectories_json, trajectories_markdown, trajectories_table,
};
use crate::runs::SelectedCode;
use crate::study::Verdict;
use crate::study::convention::probe_all;
use crate::study::trajectory::{
    Trajectory, TrajectoryJudgement, measure_trajectories, plan_trajectory, trajectory_stack,
};
use clap::Args;
use std::path::{Path, PathBuf};

/// Whole series at a finite wall speed, beside native twins
///
/// Compresses one stack at the wall speed 1e-3 with every code, at three time steps each half the one
/// before, and with native twins that take on the code's own contact convention; compares wall force,
/// positions and angle row by row, through yield and collapse; and judges whether what is left falls with
/// the time step as it must. Codes that are not installed are represented by their recorded runs.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack trajectories --codes liggghts,lammps --out results")]
pub struct Arguments {
    /// Which codes, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    codes: Vec<Code>,
    /// Directory for trajectories.csv, trajectories.json and trajectories.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    run: RunOptions,
    /// How to print the results; json and csv have one row for every time step
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Runs and compares, prints and writes the rows.
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    refuse_native(&arguments.codes)?;
    let mut codes = selected_codes(&arguments.codes)?;
    codes.retain(|selected| selected.name != Code::Native);
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let plans = trajectories(codes.iter().map(|selected| selected.name));
    codes.push(SelectedCode::find(Code::Native));
    let settings = arguments.run.settings()?;
    let reporter = Reporter::new();
    let probes = probe_all(&codes, &settings, &reporter);
    let judgements = measure_trajectories(&plans, &codes, &settings, &reporter);
    drop(reporter);
    let judged = judgements.into_iter().map(|judgement| {
        let names = codes.iter().map(|who| who.name);
        judgement.unless_contradicted(names.zip(&probes))
    });
    let judgements: Vec<TrajectoryJudgement> = judged.collect();
    if let Some(directory) = arguments.out.as_deref().filter(|_| !INTERRUPT.requested()) {
        write(directory, &judgements, &command_line(arguments))?;
    }
    super::print(&match arguments.format {
        Format::Table if judgements.is_empty() => Vec::new(),
        Format::Table => trajectories_table(&judgements).into_bytes(),
        Format::Json => trajectories_json(&judgements).into_bytes(),
        Format::Csv => trajectories_csv(&judgements),
    })?;
    Ok(conclude(&judgements, plans.len(), &codes))
}

/// The plans of the codes, each beside the convention that is declared for it.
pub(super) fn trajectories(names: impl Iterator<Item = Code>) -> Vec<Trajectory> {
    let stack = trajectory_stack();
    names
        .map(|name| plan_trajectory(name, &stack, name.convention()))
        .collect()
}

fn refuse_native(named: &[Code]) -> Result<(), InvalidValue> {
    if !named.contains(&Code::Native) {
        return Ok(());
    }
    let others = Code::ALL.into_iter().skip(1).map(Code::as_str);
    Err(InvalidValue {
        key: "--codes".to_owned(),
        value: Code::Native.to_string(),
        accepted: format!(
            "{}: the native code is what they are compared with",
            others.collect::<Vec<_>>().join(", ")
        ),
    })
}

fn write(
    directory: &Path,
    judgements: &[TrajectoryJudgement],
    command: &str,
) -> Result<(), FileError> {
    let put = |name: &str, content: &[u8]| write_atomically(&directory.join(name), content);
    put("trajectories.csv", &trajectories_csv(judgements))?;
    put(
        "trajectories.json",
        trajectories_json(judgements).as_bytes(),
    )?;
    let page = trajectories_markdown(judgements, command);
    put("trajectories.md", page.as_bytes())
}

/// The command that gives the same rows again; where it writes them does not matter.
fn command_line(arguments: &Arguments) -> String {
    let names: Vec<&str> = arguments.codes.iter().map(|name| name.as_str()).collect();
    if names.is_empty() {
        return "tristack trajectories".to_owned();
    }
    format!("tristack trajectories --codes {}", names.join(","))
}

/// Says on standard error what the comparisons amount to, and returns the exit status.
fn conclude(
    judgements: &[TrajectoryJudgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    for judgement in judgements {
        for note in &judgement.notes {
            tell!("{}: {}: {note}", judgement.verdict, judgement.code);
        }
        for comparison in &judgement.comparisons {
            if let Some(note) = &comparison.note {
                let (code, verdict) = (judgement.code, comparison.verdict);
                let twin = comparison.twin.as_str();
                let (branch, quantity) = (comparison.branch.as_str(), comparison.quantity.as_str());
                tell!("{verdict}: {code}, {twin} twin, {branch}, {quantity}: {note}");
            }
        }
    }
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == code);
        own.any(|one| one.verdict != Verdict::Missing)
    });
    let verdicts: Vec<Verdict> = judgements
        .iter()
        .flat_map(TrajectoryJudgement::verdicts)
        .collect();
    let agreeing = verdicts
        .iter()
        .filter(|&&verdict| verdict == Verdict::Agrees);
    tell!(
        "{} of {} comparisons agree",
        agreeing.count(),
        verdicts.len()
    );
    if INTERRUPT.requested() {
        tell!(
            "interrupted with {} of {planned} codes complete; every finished run is kept, and the same \
             command goes on from here",
            judgements.len()
        );
        return ExitStatus::Interrupted;
    }
    let worst = verdicts.into_iter().map(ExitStatus::of_verdict).max();
    worst.unwrap_or(ExitStatus::Success)
}
