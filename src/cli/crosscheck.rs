//! `tristack crosscheck`.

use super::convention::{settle, settle_after_probes};
use super::explain::{RowName, explain, row_name};
use super::findings::exchange_all;
use super::interrupt::interrupted_after;
use super::options::{
    CodeOptions, Format, ResolutionOptions, RowOptions, RunOptions, StackOptions,
    UnannouncedOptions, check_yields, find_all, options_of, power, selected_codes, tell_stand_ins,
};
use super::out::Out;
use super::progress::{Reporter, during};
use super::stack_set::{StackSet, with_options};
use super::{CliError, ExitStatus, published, tell, tell_grounds};
use crate::files::Layout;
use crate::model::Power;
use crate::output::{
    budget, crosscheck, crosscheck_markdown, friction, json, laws_markdown, laws_svg,
};
use crate::runs::{Finder, SelectedCode};
use crate::study::yield_force::Judgement;
use crate::study::{Campaign, Verdict};
use clap::Args;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Compare the yield forces of all codes with the exact limit (the main command)
///
/// Measures the yield force of every stack of the profile with every code, extrapolates it to vanishing
/// wall speed, and compares it with the exact quasi-static limit under the code's own contact
/// convention. Recorded runs stand in for codes that are not installed.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack crosscheck --codes native,liggghts --out results\n          \
    tristack crosscheck --explain yade/0.3/100\n          \
    tristack crosscheck --mu 0.3 --profile standard --only-failures --junit junit.xml\n          \
    tristack crosscheck --mu 0.1:0.5:0.05,critical --stiffness 1e2 --summary\n          \
    tristack crosscheck --codes ./mydem --unannounced 5\n          \
    tristack crosscheck --profile published --published arXiv-2511.06807"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    stacks: StackSet,
    /// Checkout of the authors' repository, github.com/Ryudo-Suzuki/arXiv-2511.06807; with `--profile published`, which
    /// reproduces their numbers
    #[arg(long, value_name = "DIR", requires = "profile", conflicts_with_all = not_of_published())]
    pub published: Option<PathBuf>,
    /// Contact law: `linear` (the paper's), or `hertz`: styles of the codes with Hertz's normal force and a tangential
    /// spring of Mindlin's stiffness; the quick profile has one style of each code, the standard one all
    #[arg(long, value_parser = power, value_name = "LAW", default_value = "linear")]
    law: Power,
    #[command(flatten)]
    pub codes: CodeOptions,
    /// Directory for crosscheck.csv, crosscheck.json, crosscheck.md and budget.csv, with other laws laws.md and laws.svg as well;
    /// of the published numbers, for published.csv, published.json, published.md and further tables
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Explain one row, CODE/MU/STIFFNESS, from its runs to its verdict, instead of printing all rows; measured in the way of
    /// --profile
    #[arg(long, value_name = "ROW", value_parser = row_name, conflicts_with_all = ["codes", "out", "mu", "stiffness", "only_failures", "summary", "junit", "unannounced"])]
    explain: Option<RowName>,
    /// Let the wall of native runs approach the yield up to ten times faster and stop after it; for each row, one
    /// run without shortcuts measures what this changes
    #[arg(long)]
    shortcuts: bool,
    #[command(flatten)]
    resolution: ResolutionOptions,
    #[command(flatten)]
    unannounced: UnannouncedOptions,
    #[command(flatten)]
    rows: RowOptions,
    #[command(flatten)]
    pub run: RunOptions,
    /// Format of the rows, or of the explanation of one
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub format: Format,
}

/// Returns the options that conflict with the published numbers.
fn not_of_published() -> Vec<clap::Id> {
    let own = ["law", "explain", "shortcuts", "resolution", "unannounced"].map(clap::Id::from);
    let others = options_of::<StackOptions>().into_iter();
    let others = others.chain(options_of::<RowOptions>());
    let others = others.chain(["mu", "stiffness"].map(clap::Id::from));
    own.into_iter().chain(others).collect()
}

/// Runs the crosscheck, prints and writes its rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    if arguments.stacks.is_published() {
        return published::run(arguments, command);
    }
    if let Some(row) = &arguments.explain {
        return explain(
            row,
            &arguments.stacks,
            arguments.law,
            (arguments.shortcuts, &arguments.resolution),
            &arguments.run,
            (arguments.format, command),
        );
    }
    let named = arguments.codes.of_power(arguments.law)?;
    let bodies = arguments.stacks.others.bodies;
    check_yields(&named, bodies)?;
    let codes = match named.is_empty() {
        true => find_all(&arguments.stacks.codes(arguments.law)?),
        false => selected_codes(&named)?,
    };
    let out = Out::claim(arguments.out.as_deref(), &layout())?;
    let settings = arguments.run.settings()?;
    let settled = match arguments.resolution.is_given() {
        true => settle_after_probes(&codes, &arguments.run)?,
        false => settle(&codes, &arguments.run)?,
    };
    let draw = arguments.unannounced.draw();
    let again = draw.map_or_else(String::new, |draw| format!(" --seed {}", draw.seed));
    let command = match draw {
        Some(draw) if draw.is_new => format!("{command}{again}"),
        _ => command.to_owned(),
    };
    if draw.is_some() {
        tell!("stacks are drawn now; to draw them again:{again}");
    }
    let planned = || match draw {
        Some(draw) => arguments.stacks.drawn(draw, &settled, arguments.law),
        None => arguments.stacks.measurements(&settled, arguments.law),
    };
    let measurements = during("planning", planned)?.into_iter();
    let measurements = measurements
        .map(|own| with_options(own, arguments.shortcuts, &arguments.resolution))
        .collect::<Vec<_>>();
    let planned = measurements.len();
    let judgements = Campaign::new(&codes, &settings, &Reporter::new()).carry_out(measurements);
    let rows = &arguments.rows;
    let is_whole = judgements.len() == planned;
    let written = publish(
        (&judgements, is_whole),
        rows,
        &out,
        arguments.format,
        &command,
    );
    let found = conclude(&judgements, planned, &codes);
    exchange_all(Finder::Crosscheck, &codes, &settings.store, |selected| {
        let own = judgements.iter().filter(|row| row.code == selected.name);
        own.filter(|row| row.verdict() == Verdict::Differs)
            .map(|row| {
                let mu = friction(row.mu());
                match row.code.is_rigid() {
                    true => format!("the yield force at mu = {mu} differs"),
                    false => format!(
                        "the yield force at mu = {mu}, stiffness {} differs",
                        row.stiffness()
                    ),
                }
            })
            .collect()
    });
    Ok(found.max(written))
}

/// Returns the files that [`publish`] writes.
pub(super) fn layout() -> Layout {
    let files = [
        "crosscheck.csv",
        "budget.csv",
        "crosscheck.md",
        LAWS,
        LAWS_FIGURE,
    ];
    Layout::tables("crosscheck.json", &files)
}

/// The page on the effects of contact laws, and its figure.
const LAWS: &str = "laws.md";
const LAWS_FIGURE: &str = "laws.svg";

/// Prints the rows, and writes them if there is a directory and no row is missing.
pub(super) fn publish(
    (judgements, is_whole): (&[Judgement], bool),
    rows: &RowOptions,
    out: &Out,
    format: Format,
    command: &str,
) -> ExitStatus {
    let printed = rows.print(judgements, format, command);
    let tested = rows.write_junit(judgements, is_whole);
    let written = out.write_whole(is_whole, || {
        let tables = [crosscheck(judgements)];
        let mut files = vec![
            ("crosscheck.csv", tables[0].csv()),
            ("budget.csv", budget(judgements).csv()),
            ("crosscheck.json", json(&tables, command)),
            ("crosscheck.md", crosscheck_markdown(judgements, command)),
        ];
        let is_linear = |row: &Judgement| row.study.convention.law.power == Power::Linear;
        if !judgements.is_empty() && !judgements.iter().any(is_linear) {
            files.push((LAWS, laws_markdown(judgements, LAWS_FIGURE, command)));
            files.push((LAWS_FIGURE, laws_svg(judgements)));
        }
        files
    });
    printed.max(tested).max(written)
}

/// Summarizes the rows on standard error, and returns the exit status.
pub(super) fn conclude(
    judgements: &[Judgement],
    planned: usize,
    codes: &[SelectedCode],
) -> ExitStatus {
    let mut told = BTreeSet::new();
    for judgement in judgements {
        // Remarks on rows that agree are often the same on all rows of a code.
        let is_known = !told.insert((&judgement.code, judgement.notes()));
        if is_known && judgement.verdict() == Verdict::Agrees {
            continue;
        }
        let (code, mu) = (&judgement.code, friction(judgement.mu()));
        let place = match code.is_rigid() {
            true => format!("{code} mu={mu}"),
            false => format!("{code} mu={mu} stiffness={}", judgement.stiffness()),
        };
        tell_grounds(&judgement.grounds, &place);
    }
    tell_stand_ins(codes, |code| {
        let mut own = judgements.iter().filter(|one| one.code == *code);
        own.any(Judgement::is_recorded)
    });
    tell!("{}", summary(judgements));
    if judgements.len() < planned {
        return interrupted_after(judgements.len(), planned, "rows");
    }
    ExitStatus::of(judgements)
}

fn summary(judgements: &[Judgement]) -> String {
    let count = |verdict: Verdict| {
        let alike = judgements.iter().filter(|row| row.verdict() == verdict);
        alike.count()
    };
    let (agreeing, all) = (count(Verdict::Agrees), judgements.len());
    let mut text = format!("{agreeing} of {all} rows agree");
    let others = [
        Verdict::Differs,
        Verdict::Inconclusive,
        Verdict::NoYield,
        Verdict::Failed,
        Verdict::Missing,
    ];
    for verdict in others.into_iter().filter(|&verdict| count(verdict) > 0) {
        text += &format!(", {} {verdict}", count(verdict));
    }
    let recorded = judgements.iter().filter(|row| row.is_recorded());
    match recorded.count() {
        0 => text,
        count => format!("{text}; {count} rows are recorded, not live"),
    }
}
