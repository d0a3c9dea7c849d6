//! `tristack trajectories`.

use super::convention::settle;
use super::interrupt::interrupted_after;
use super::options::{
    CodeOptions, Format, RunOptions, check_compress, selected_codes, tell_stand_ins, whole,
};
use super::out::Out;
use super::progress::{Reporter, during};
use super::{CliError, ExitStatus, tell, tell_grounds};
use crate::code::{Code, SettledCode};
use crate::files::Layout;
use crate::model::{InvalidValue, PAPER_BODIES};
use crate::output::{json, trajectories, trajectories_markdown, trajectories_text};
use crate::runs::SelectedCode;
use crate::study::trajectory::{
    Trajectory, TrajectoryJudgement, plan_trajectory, trajectory_stack,
};
use crate::study::{Campaign, Verdict};
use clap::Args;
use std::path::PathBuf;

/// Compare whole time series of the codes with native twins
///
/// Compresses one stack at the wall speed 1e-3 r sqrt(k_n/m) with every code, at three time steps each half the
/// one before, and with native twins under the code's own contact convention. Compares wall force, positions and
/// angle row by row, through yield and collapse, and judges whether the differences fall with the time step as
/// they must. The law of a code chooses stiffness ratio and duration of the gravity ramp. Recorded runs stand in for
/// codes that are not installed, those of linear springs.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack trajectories --codes liggghts,lammps --out trajectories")]
pub(super) struct Arguments {
    #[command(flatten)]
    codes: CodeOptions,
    /// Bodies on the floor: 2 cylinders, or 3 to 5 spheres, of which one is displaced by 1e-3 r so that no symmetry is left;
    /// their trajectories are compared up to the peak
    #[arg(long, value_name = "N", default_value_t = PAPER_BODIES, value_parser = whole::<u8>(2..=5))]
    bodies: u8,
    /// Directory for trajectories.csv, trajectories.json and trajectories.md
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    run: RunOptions,
    /// Format of the results; json and csv have one row for every time step
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Runs and compares, prints and writes the rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let named = arguments.codes.named();
    refuse_native(&named)?;
    check_compress(&named, arguments.bodies)?;
    let mut codes = selected_codes(&named)?;
    codes.retain(|selected| !selected.name.is_native());
    let files = ["trajectories.csv", "trajectories.md"];
    let layout = Layout::tables("trajectories.json", &files);
    let out = Out::claim(arguments.out.as_deref(), &layout)?;
    let settings = arguments.run.settings()?;
    let settled = settle(&codes, &arguments.run)?;
    let plans = during("planning", || plans(&settled, arguments.bodies));
    codes.push(SelectedCode::find(Code::native()));
    let planned = plans.len();
    let judgements = Campaign::new(&codes, &settings, &Reporter::new()).carry_out(plans);
    let tables = [trajectories(&judgements)];
    let people = || trajectories_text(&judgements);
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write_whole(judgements.len() == planned, || {
        vec![
            ("trajectories.csv", tables[0].csv()),
            ("trajectories.json", json(&tables, command)),
            (
                "trajectories.md",
                trajectories_markdown(&judgements, command),
            ),
        ]
    });
    let found = conclude(&judgements, planned, &codes);
    Ok(found.max(printed).max(written))
}

/// Returns the plans for the codes, each under its own convention.
pub(super) fn plans(codes: &[SettledCode], bodies: u8) -> Vec<Trajectory> {
    let plan = |code: &SettledCode| {
        let convention = code.convention();
        let stack = trajectory_stack(bodies, convention.law.power);
        plan_trajectory(code, &stack, convention)
    };
    codes.iter().map(plan).collect()
}

fn refuse_native(named: &[Code]) -> Result<(), InvalidValue> {
    if !named.iter().any(Code::is_native) {
        return Ok(());
    }
    let mut others = Code::built_in();
    others.retain(|code| !code.is_native());
    let others = others.iter().map(Code::as_str);
    Err(InvalidValue {
        key: "--codes".to_owned(),
        value: Code::native().to_string(),
        accepted: format!(
            "{}: the native code is what they are compared with",
            others.collect::<Vec<_>>().join(", ")
        ),
    })
}

/// Summarizes the comparisons on standard error, and returns the exit status.
fn conclude(
    judgements: &[TrajectoryJudgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    judgements.iter().for_each(tell_notes);
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == *code);
        own.any(|one| one.is_recorded())
    });
    let verdicts = judgements.iter().flat_map(TrajectoryJudgement::verdicts);
    let verdicts: Vec<Verdict> = verdicts.collect();
    let agreeing = verdicts.iter().filter(|&&own| own == Verdict::Agrees);
    let (agreeing, all) = (agreeing.count(), verdicts.len());
    tell!("{agreeing} of {all} comparisons agree");
    if judgements.len() < planned {
        return interrupted_after(judgements.len(), planned, "codes");
    }
    let contradicted = judgements.iter().any(|own| own.grounds.is_contradicted());
    let contradicted = contradicted.then_some(ExitStatus::Disagreement);
    let statuses = verdicts.into_iter().map(ExitStatus::of_verdict);
    let worst = statuses.chain(contradicted).max();
    worst.unwrap_or(ExitStatus::Success)
}

/// Prints the notes on a code and on its comparisons.
fn tell_notes(judgement: &TrajectoryJudgement) {
    let code = judgement.code.as_str();
    tell_grounds(&judgement.grounds, code);
    for comparison in judgement.comparisons() {
        let twin = comparison.twin.as_str();
        let (branch, quantity) = (comparison.branch.as_str(), comparison.quantity.as_str());
        let place = format!("{code}, {twin} twin, {branch}, {quantity}");
        tell_grounds(&comparison.grounds, &place);
    }
}
