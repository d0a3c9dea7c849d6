//! `tristack crosscheck`.

use super::explain::{RowName, explain, row_name};
use super::options::{
    CodeParser, Format, RunOptions, selected_codes, tell_stand_ins, writable, write_all,
};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::FileError;
use crate::output::{budget, crosscheck, crosscheck_markdown, crosscheck_text, friction, json};
use crate::runs::SelectedCode;
use crate::study::yield_force::{Judgement, Measurement, Profile};
use crate::study::{Campaign, Verdict};
use clap::Args;
use std::path::{Path, PathBuf};

/// The main job: run, compare, judge, write tables
///
/// Measures the yield force of every stack of the profile with every code, extrapolates it to vanishing
/// wall speed, and holds it against the exact quasi-static limit under the code's own contact
/// convention. Codes that are not installed are represented by their recorded runs.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack crosscheck --codes native,liggghts --out results\n          \
    tristack crosscheck --explain yade/0.3/100"
)]
pub struct Arguments {
    /// Which stacks
    #[arg(long, value_enum, default_value_t = Profile::Quick)]
    profile: Profile,
    /// Which codes, separated by commas; each must be installed [default: all, recorded if necessary]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    /// Directory for crosscheck.csv, crosscheck.json, crosscheck.md and budget.csv
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Explain one row, CODE/MU/STIFFNESS, from its runs to its verdict, instead of printing all
    #[arg(long, value_name = "ROW", value_parser = row_name, conflicts_with_all = ["codes", "out", "format", "profile"])]
    explain: Option<RowName>,
    /// Let native walls approach the yield up to ten times faster and stop after it; a run without, for each
    /// row, says what this changes
    #[arg(long, conflicts_with = "explain")]
    shortcuts: bool,
    #[command(flatten)]
    run: RunOptions,
    /// How to print the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Runs the crosscheck, prints and writes its rows.
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    if let Some(row) = &arguments.explain {
        return explain(row, &arguments.run);
    }
    let codes = selected_codes(&arguments.codes)?;
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let names: Vec<Code> = codes.iter().map(|selected| selected.name).collect();
    let mut measurements = arguments.profile.measurements(&names);
    if arguments.shortcuts {
        measurements = measurements
            .into_iter()
            .map(Measurement::shortened)
            .collect();
    }
    let settings = arguments.run.settings()?;
    let reporter = Reporter::new();
    let planned = measurements.len();
    let judgements = Campaign::new(&codes, &settings, &reporter).carry_out(measurements);
    drop(reporter);
    if let Some(directory) = arguments.out.as_deref().filter(|_| !INTERRUPT.requested()) {
        write(directory, &judgements, command)?;
    }
    let tables = [crosscheck(&judgements)];
    let people = || crosscheck_text(&judgements);
    super::print(&arguments.format.render(&tables, command, people))?;
    Ok(conclude(&judgements, planned, &codes))
}

fn write(directory: &Path, judgements: &[Judgement], command: &str) -> Result<(), FileError> {
    let rows = crosscheck(judgements);
    let page = crosscheck_markdown(judgements, command).into_bytes();
    let files = [
        ("crosscheck.csv", rows.csv()),
        ("budget.csv", budget(judgements).csv()),
        ("crosscheck.json", json(&[rows], command)),
        ("crosscheck.md", page),
    ];
    write_all(directory, &files)
}

/// Says on standard error what the rows amount to, and returns the exit status.
pub(super) fn conclude(
    judgements: &[Judgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    for judgement in judgements {
        let stack = &judgement.study.stack;
        for note in judgement.notes() {
            tell!(
                "{}: {} mu={} stiffness={}: {note}",
                judgement.verdict(),
                judgement.code,
                friction(stack.floor_friction),
                stack.stiffness
            );
        }
    }
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == code);
        own.any(Judgement::is_recorded)
    });
    tell!("{}", summary(judgements));
    if INTERRUPT.requested() {
        tell!(
            "interrupted with {} of {planned} rows complete; every finished run is kept, and the same \
             command goes on from here",
            judgements.len()
        );
        return ExitStatus::Interrupted;
    }
    ExitStatus::of(judgements)
}

fn summary(judgements: &[Judgement]) -> String {
    let count = |verdict: Verdict| {
        let alike = judgements.iter().filter(|row| row.verdict() == verdict);
        alike.count()
    };
    let others = [
        Verdict::Differs,
        Verdict::Inconclusive,
        Verdict::NoYield,
        Verdict::Failed,
        Verdict::Missing,
    ];
    let mut text = format!(
        "{} of {} rows agree",
        count(Verdict::Agrees),
        judgements.len()
    );
    for verdict in others.into_iter().filter(|&verdict| count(verdict) > 0) {
        text += &format!(", {} {verdict}", count(verdict));
    }
    let recorded = judgements
        .iter()
        .filter(|judgement| judgement.is_recorded());
    match recorded.count() {
        0 => text,
        count => format!("{text}; {count} rows are recorded, not live"),
    }
}
