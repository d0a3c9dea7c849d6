//! `tristack crosscheck`.

use super::explain::{RowName, explain, row_name};
use super::options::{Format, RunOptions, selected_codes, tell_stand_ins, writable};
use super::progress::Reporter;
use super::tell;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::{FileError, write_atomically};
use crate::output::{
    budget_csv, crosscheck_csv, crosscheck_json, crosscheck_markdown, crosscheck_table, friction,
};
use crate::runs::SelectedCode;
use crate::study::Verdict;
use crate::study::yield_force::{Judgement, Measurement, Profile, measure};
use clap::{Args, ValueEnum};
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
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    codes: Vec<Code>,
    /// Directory for crosscheck.csv, crosscheck.json, crosscheck.md and budget.csv
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Explain one row, ENGINE/MU/STIFFNESS, from its runs to its verdict, instead of printing all
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
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
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
    let judgements = measure(&measurements, &codes, &settings, &reporter);
    drop(reporter);
    if let Some(directory) = arguments.out.as_deref().filter(|_| !INTERRUPT.requested()) {
        write(directory, &judgements, &command_line(arguments))?;
    }
    super::print(&match arguments.format {
        Format::Table if judgements.is_empty() => Vec::new(),
        Format::Table => crosscheck_table(&judgements).into_bytes(),
        Format::Json => crosscheck_json(&judgements).into_bytes(),
        Format::Csv => crosscheck_csv(&judgements),
    })?;
    Ok(conclude(&judgements, measurements.len(), &codes))
}

fn write(directory: &Path, judgements: &[Judgement], command: &str) -> Result<(), FileError> {
    write_atomically(
        &directory.join("crosscheck.csv"),
        &crosscheck_csv(judgements),
    )?;
    write_atomically(&directory.join("budget.csv"), &budget_csv(judgements))?;
    write_atomically(
        &directory.join("crosscheck.json"),
        crosscheck_json(judgements).as_bytes(),
    )?;
    let page = crosscheck_markdown(judgements, command);
    write_atomically(&directory.join("crosscheck.md"), page.as_bytes())
}

/// The command that gives the same rows again; where it writes them does not matter.
fn command_line(arguments: &Arguments) -> String {
    let profile = arguments.profile.to_possible_value();
    let profile = profile.as_ref().map_or("", |value| value.get_name());
    let mut line = format!("tristack crosscheck --profile {profile}");
    if !arguments.codes.is_empty() {
        let names: Vec<&str> = arguments.codes.iter().map(|name| name.as_str()).collect();
        line += &format!(" --codes {}", names.join(","));
    }
    line
}

/// Says on standard error what the rows amount to, and returns the exit status.
pub(super) fn conclude(
    judgements: &[Judgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    for judgement in judgements {
        let row = &judgement.row;
        for note in &judgement.notes {
            tell!(
                "{}: {} mu={} stiffness={}: {note}",
                row.verdict,
                row.code,
                friction(row.mu),
                row.stiffness
            );
        }
    }
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.row.code == code);
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
        let rows = judgements.iter().map(|judgement| &judgement.row);
        rows.filter(|row| row.verdict == verdict).count()
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
