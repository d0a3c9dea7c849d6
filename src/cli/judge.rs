//! `tristack judge`.

use super::convention::settle_with;
use super::crosscheck::{conclude, layout, publish};
use super::judge_series::{self, SeriesArguments};
use super::options::{CodeParser, Format, RowOptions, options_of};
use super::out::Out;
use super::{CliError, ExitStatus, INTERRUPT, complain, tell};
use crate::code::{Code, Failure, FailureKind};
use crate::files::{FileError, Scratch};
use crate::runs::{Progress, Recorded, SelectedCode, Settings, Store};
use crate::study::{Campaign, PLAN, Plan};
use clap::Args;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Version of a program, unless `--code-version` says it.
const UNKNOWN_VERSION: &str = "unknown";

/// Judge results that were made elsewhere
///
/// Reads the results in the directories of a plan, and judges them as `tristack crosscheck` judges runs that it makes
/// itself. Says which results are missing, incomplete or malformed; may be repeated while runs come in. Starts no
/// program, and keeps nothing in the store.
///
/// With --series, three or more series of one stack are judged without a plan: slip onset and peak, extrapolated to
/// vanishing wall speed, against the exact limit under the arms of --pair-arm and --floor-arm or of a --passport. What the
/// uncertainty lacks is said, with the run that would make it known; until then nothing agrees.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack judge away --code-version 7.2 --out verdict\n          \
    tristack judge --series v4.csv v2.csv v1.csv --speeds 4e-4,2e-4,1e-4 --mu 0.3 --stiffness 100 --pair-arm 0 --floor-arm 0"
)]
pub(super) struct Arguments {
    /// Directory of a plan
    #[arg(value_name = "DIR", required_unless_present = "series", conflicts_with_all = options_of::<SeriesArguments>())]
    plan: Option<PathBuf>,
    #[command(flatten)]
    series: SeriesArguments,
    /// Folder of the code, if it is no longer where it was planned
    #[arg(long, alias = "codes", value_parser = CodeParser, value_name = "CODE", conflicts_with = "series")]
    code: Option<Code>,
    /// Version of the program that made the results
    #[arg(long, value_name = "TEXT", value_parser = one_line, default_value = UNKNOWN_VERSION, conflicts_with = "series")]
    code_version: String,
    /// Directory for crosscheck.csv, crosscheck.json, crosscheck.md and budget.csv; of series for judged_series.json,
    /// judged_series.csv, series_runs.csv and series_budget.csv
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    rows: RowOptions,
    /// Format of the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Judges what is there, prints and writes the rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let Some(root) = arguments.plan.as_deref() else {
        return judge_series::run(
            &arguments.series,
            arguments.out.as_deref(),
            arguments.rows.junit.as_deref(),
            arguments.format,
            command,
        );
    };
    let path = root.join(PLAN);
    let plan = Plan::read(root)?.ok_or_else(|| {
        let message = "there is none; accepted is a directory that tristack plan has written";
        FileError::content(&path, message)
    })?;
    let code = code(arguments, &plan, &path)?;
    let out = Out::claim(arguments.out.as_deref(), &layout())?;
    tell_results(&plan, &code.clone(), root);
    let results = plan.results(code.clone(), &arguments.code_version, root);
    let codes = [SelectedCode {
        name: code,
        code: Some(Box::new(results)),
    }];
    let scratch = Scratch::new().map_err(FileError::writing(&std::env::temp_dir()))?;
    let settings = settings(scratch.path())?;
    let settled = settle_with(&codes, plan.accepts_resolution(), &settings, &Quiet);
    let measurements = plan.measurements(&settled[0]);
    let planned = measurements.len();
    let judgements = Campaign::new(&codes, &settings, &Quiet).carry_out(measurements);
    let rows = &arguments.rows;
    let is_whole = judgements.len() == planned;
    let published = publish(
        (&judgements, is_whole),
        rows,
        &out,
        arguments.format,
        command,
    );
    let found = conclude(&judgements, planned, &codes);
    Ok(found.max(published))
}

/// Accepts one line of text, which tables show as it is.
fn one_line(text: &str) -> Result<String, String> {
    match text.chars().any(char::is_control) || text.is_empty() {
        true => Err("accepted is one line of text".to_owned()),
        false => Ok(text.to_owned()),
    }
}

/// Finds the code of the plan, or checks that `--code` is that code.
fn code(arguments: &Arguments, plan: &Plan, path: &Path) -> Result<Code, CliError> {
    let refused = |message: String| FileError::content(path, message);
    if let Some(code) = &arguments.code {
        if code.as_str() == plan.code {
            return Ok(code.clone());
        }
        let message = format!(
            "`code` is {}, but --code is {code}; accepted is the code of the plan",
            plan.code
        );
        return Err(refused(message).into());
    }
    let found = match &plan.folder {
        Some(folder) => Code::in_folder(folder, Some(&plan.code)).map_err(|error| {
            refused(format!(
                "its folder cannot be read; --code names another: {error}"
            ))
        }),
        None => Code::named(&plan.code).ok_or_else(|| {
            refused(format!(
                "`code` is {}, which is no code; --code names its folder",
                plan.code
            ))
        }),
    };
    Ok(found?)
}

/// Says how many results there are, and which of them cannot be used.
fn tell_results(plan: &Plan, code: &Code, root: &Path) {
    let troubles = plan.troubles(code, root);
    let missing = troubles.iter().flatten();
    let missing = missing
        .filter(|trouble| matches!(trouble, FailureKind::Awaited(_)))
        .count();
    let others = troubles.iter().flatten();
    let others: Vec<&FailureKind> = others
        .filter(|trouble| !matches!(trouble, FailureKind::Awaited(_)))
        .collect();
    let (all, unusable) = (troubles.len(), others.len());
    tell!(
        "{} of {all} results are there and usable, {missing} are missing, {unusable} are incomplete or malformed",
        all - missing - unusable
    );
    for trouble in others {
        tell!("{trouble}");
    }
    if let Some(line) = plan.first_complaint(&troubles, root) {
        tell!("{line}");
    }
    if plan.continues {
        tell!(
            "further runs follow from results, and are not planned yet: plan again once the planned ones are there"
        );
    }
}

/// Returns settings for runs that are read: with a store of its own, which is thrown away.
fn settings(scratch: &Path) -> Result<Settings<'static>, CliError> {
    let threads = std::thread::available_parallelism();
    Ok(Settings {
        store: Store::open(&scratch.join("store"))?,
        recorded: Recorded::embedded(),
        fresh: true,
        threads: threads.map_or(1, usize::from),
        time_limit: None,
        interrupt: &INTERRUPT,
    })
}

/// Reports warnings only: reading files takes no time, and the rows say what is wrong.
struct Quiet;

impl Progress for Quiet {
    fn planned(&self, _: &str, _: usize, _: usize, _: f64) {}
    fn advanced(&self, _: f64) {}
    fn finished(&self, _: &Code, _: &dyn Display, _: Result<Option<f64>, &Failure>) {}
    fn warn(&self, message: &str) {
        complain!("warning: {message}");
    }
}
