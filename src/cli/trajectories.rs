//! `tristack trajectories`.

use super::options::{
    CodeParser, Format, RunOptions, selected_codes, tell_stand_ins, writable, write_all,
};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::FileError;
use crate::model::InvalidValue;
use crate::output::{json, trajectories, trajectories_markdown, trajectories_text};
use crate::runs::SelectedCode;
use crate::study::trajectory::{
    Trajectory, TrajectoryJudgement, plan_trajectory, trajectory_stack,
};
use crate::study::{Campaign, Verdict};
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
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
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
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    refuse_native(&arguments.codes)?;
    let mut codes = selected_codes(&arguments.codes)?;
    codes.retain(|selected| selected.name != Code::NATIVE);
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let plans = plans(codes.iter().map(|selected| selected.name));
    codes.push(SelectedCode::find(Code::NATIVE));
    let settings = arguments.run.settings()?;
    let reporter = Reporter::new();
    let planned = plans.len();
    let judgements = Campaign::new(&codes, &settings, &reporter).carry_out(plans);
    drop(reporter);
    if let Some(directory) = arguments.out.as_deref().filter(|_| !INTERRUPT.requested()) {
        write(directory, &judgements, command)?;
    }
    let tables = [trajectories(&judgements)];
    let people = || trajectories_text(&judgements);
    super::print(&arguments.format.render(&tables, command, people))?;
    Ok(conclude(&judgements, planned, &codes))
}

/// The plans of the codes, each beside the convention that is declared for it.
pub(super) fn plans(names: impl Iterator<Item = Code>) -> Vec<Trajectory> {
    let stack = trajectory_stack();
    names
        .map(|name| plan_trajectory(name, &stack, name.convention()))
        .collect()
}

fn refuse_native(named: &[Code]) -> Result<(), InvalidValue> {
    if !named.contains(&Code::NATIVE) {
        return Ok(());
    }
    let others = Code::all().into_iter().skip(1).map(Code::as_str);
    Err(InvalidValue {
        key: "--codes".to_owned(),
        value: Code::NATIVE.to_string(),
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
    let rows = trajectories(judgements);
    let page = trajectories_markdown(judgements, command).into_bytes();
    let files = [
        ("trajectories.csv", rows.csv()),
        ("trajectories.json", json(&[rows], command)),
        ("trajectories.md", page),
    ];
    write_all(directory, &files)
}

/// Says on standard error what the comparisons amount to, and returns the exit status.
fn conclude(
    judgements: &[TrajectoryJudgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    for judgement in judgements {
        for note in judgement.notes() {
            tell!("{}: {}: {note}", judgement.verdict(), judgement.code);
        }
        for comparison in judgement.comparisons() {
            for note in comparison.grounds.notes() {
                let (code, verdict) = (judgement.code, comparison.verdict());
                let twin = comparison.twin.as_str();
                let (branch, quantity) = (comparison.branch.as_str(), comparison.quantity.as_str());
                tell!("{verdict}: {code}, {twin} twin, {branch}, {quantity}: {note}");
            }
        }
    }
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == code);
        own.any(|one| one.is_recorded())
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
    let contradicted = judgements.iter().any(|own| own.grounds.is_contradicted());
    let contradicted = contradicted.then_some(ExitStatus::Disagreement);
    let worst = verdicts.into_iter().map(ExitStatus::of_verdict);
    worst
        .chain(contradicted)
        .max()
        .unwrap_or(ExitStatus::Success)
}
