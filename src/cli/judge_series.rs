//! `tristack judge --series`.

use super::options::{ConventionOptions, Format, OneStackOptions, options_of, positive};
use super::out::{Out, write};
use super::passport_files::LARGEST_PASSPORT;
use super::{CliError, ExitStatus, tell};
use crate::code::SettledCode;
use crate::files::{FileError, Layout, Links, read_bounded};
use crate::model::{ContactLaw, InvalidValue, Problem, Stack, shown};
use crate::output::{DataTable, json, judged_series, judged_series_text, junit};
use crate::series::Series;
use crate::study::convention::MeasuredArms;
use crate::study::yield_force::{
    JudgedSeries, Method, SeriesInput, compared_run, judge_series, no_yield,
};
use crate::theory::quasistatic_limit;
use clap::Args;
use std::path::{Path, PathBuf};

/// Largest series that is read, in bytes; the same as for the series of a code.
const LARGEST_SERIES: u64 = 256 << 20;
/// Largest relative difference between two numbers that are the same except for rounding, as in the times of a
/// series.
const ROUNDING: f64 = 1e-9;

/// The options of series that nobody has planned.
#[derive(Debug, Clone, Args)]
pub(super) struct SeriesArguments {
    /// Series of one stack (CSV, docs/formats.md) instead of a plan: three or more at different wall speeds, which are
    /// extrapolated to none, or a single one, less what its speed adds according to theory
    #[arg(long, value_name = "FILE", num_args = 1.., requires_all = ["speeds", "mu", "stiffness"], conflicts_with_all = ["only_failures", "summary"])]
    pub series: Vec<PathBuf>,
    /// Their wall speeds in r sqrt(k_n/m), in the order of the files, separated by commas
    #[arg(
        long,
        value_name = "V1,V2,...",
        value_delimiter = ',',
        requires = "series",
        value_parser = positive
    )]
    speeds: Vec<f64>,
    #[command(flatten)]
    stack: OneStackOptions,
    #[command(flatten)]
    convention: ConventionOptions,
    /// Passport of the code, CODE.json of tristack probe --out: its measured arms take the place of --pair-arm and the rest,
    /// and their uncertainties are part of the budget
    #[arg(long, value_name = "FILE", requires = "series", conflicts_with_all = options_of::<ConventionOptions>())]
    passport: Option<PathBuf>,
    /// Time step in sqrt(m/k_n), which the times of the series must show
    #[arg(
        long,
        value_name = "DT",
        requires = "series",
        value_parser = positive
    )]
    dt: Option<f64>,
    /// The series of a run with twice the time step, at the middle one of the three slowest speeds or at the only one
    #[arg(long, value_name = "FILE", requires = "series")]
    coarse_step: Option<PathBuf>,
    /// The series of a run at that speed with half the gravity ramp
    #[arg(long, value_name = "FILE", requires = "series")]
    short_ramp: Option<PathBuf>,
}

/// The files with the three tables, and the one with all of them.
const TABLES: [&str; 3] = ["judged_series.csv", "series_runs.csv", "series_budget.csv"];
const JSON: &str = "judged_series.json";

/// Judges the series, prints and writes what was found.
pub(super) fn run(
    arguments: &SeriesArguments,
    out: Option<&Path>,
    tests: Option<&Path>,
    format: Format,
    command: &str,
) -> Result<ExitStatus, CliError> {
    let out = Out::claim(out, &Layout::tables(JSON, &TABLES))?;
    let judged = judge(arguments)?;
    let tables = judged_series(Some(&judged));
    let printed = format.print(&tables, command, || judged_series_text(&judged));
    let written = out.write(|| {
        let files = TABLES.into_iter().zip(tables.iter().map(DataTable::csv));
        files.chain([(JSON, json(&tables, command))]).collect()
    });
    let tested = tests.map_or(ExitStatus::Success, |file| {
        write(file, junit::of_series("tristack judge", &judged).as_bytes())
    });
    let verdict = judged.grounds.verdict();
    for note in judged.grounds.notes() {
        tell!("{verdict}: {note}");
    }
    let faster: Vec<&str> = judged.faster.iter().map(|run| run.name.as_str()).collect();
    if !faster.is_empty() {
        let read = match judged.measurement.method {
            Method::AtOneSpeed => "the slowest is judged",
            _ => "the three slowest are extrapolated",
        };
        tell!("{read}; {} are read alone", faster.join(", "));
    }
    let convention = judged.measurement.convention;
    let arms = convention.arms;
    let springs = match convention.history_update.turns() {
        true => "springs that turn with their contacts",
        false => "springs that nothing turns",
    };
    let measured = match arguments.passport {
        Some(_) => "measured ",
        None => "",
    };
    tell!(
        "assumed: the stack was prepared by a gravity ramp, and its contacts have the {measured}arms {}, {} and {springs}; \
         others move the limit (docs/theory.md, 2.3 and 8.4), and other arms the balance of forces as well",
        arms.pair,
        arms.floor
    );
    Ok(ExitStatus::of_verdict(verdict)
        .max(printed)
        .max(written)
        .max(tested))
}

fn judge(arguments: &SeriesArguments) -> Result<JudgedSeries, CliError> {
    let measured = arguments.passport.as_deref().map(passport).transpose()?;
    let convention = match measured {
        Some(measured) => measured.convention,
        None => {
            arguments.convention.check_named_arms()?;
            arguments.convention.of_contacts(&SettledCode::native())?
        }
    };
    let stack = arguments.stack.stack(convention.law.power)?;
    let problem = Problem::new(stack, convention)?;
    let limit = quasistatic_limit(&problem);
    if limit.yield_force.is_none() {
        return Err(Box::new(no_yield(&problem, &limit)).into());
    }
    let wall = convention.wall_law(stack.stiffness_ratio);
    let mut series = at_speeds(arguments, (&stack, &wall))?;
    series.sort_by(|one, other| other.wall_speed.total_cmp(&one.wall_speed));
    let compared = &series[compared_run(series.len())];
    let [coarse, hastened] = [
        ("--coarse-step", &arguments.coarse_step, 2.0),
        ("--short-ramp", &arguments.short_ramp, 1.0),
    ]
    .map(|(flag, file, factor)| {
        let file = file.as_deref();
        file.map(|file| {
            let time_step = factor * compared.time_step;
            read(
                (flag, file),
                compared.wall_speed,
                Some(time_step),
                (&stack, &wall),
            )
        })
        .transpose()
    });
    let (coarse, hastened) = (coarse?, hastened?);
    let judged = judge_series(
        &stack,
        convention,
        measured.map(|measured| measured.uncertainty),
        series,
        coarse,
        hastened,
    );
    judged.ok_or_else(|| unknown_speed(arguments.series.len()).into())
}

/// Returns the error for too few series of a stack for which theory does not know what the wall's speed adds.
fn unknown_speed(series: usize) -> InvalidValue {
    let accepted = "three or more files: what the wall's speed adds is not known where cylinders 2 and 3 press on each \
                    other at the onset, where springs are rescaled, and where the floor does not slip first";
    InvalidValue::new("--series", series as f64, accepted)
}

/// Reads the arms in the passport at `path`.
fn passport(path: &Path) -> Result<MeasuredArms, FileError> {
    let text = read_bounded(path, LARGEST_PASSPORT, Links::Followed);
    let text = text.map_err(FileError::reading(path))?;
    MeasuredArms::of_passport(&text).map_err(|error| FileError::content(path, error))
}

/// Reads the series; their speeds must differ, and their time steps must be the same.
fn at_speeds(
    arguments: &SeriesArguments,
    of: (&Stack, &ContactLaw),
) -> Result<Vec<SeriesInput>, CliError> {
    let (files, speeds) = (&arguments.series, &arguments.speeds);
    if files.len() != speeds.len() {
        let accepted = format!("as many as files after --series, {}", files.len());
        return Err(InvalidValue::new("--speeds", speeds.len() as f64, accepted).into());
    }
    for (index, &speed) in speeds.iter().enumerate() {
        let is_new = !speeds[..index].contains(&speed);
        if !(speed > 0.0 && speed.is_finite() && is_new) {
            let accepted = "numbers above 0, each another one";
            return Err(InvalidValue::new("--speeds", speed, accepted).into());
        }
    }
    let mut series: Vec<SeriesInput> = Vec::new();
    for (file, &speed) in files.iter().zip(speeds) {
        let expected = arguments.dt.or(series.first().map(|first| first.time_step));
        series.push(read(("--speeds", file), speed, expected, of)?);
    }
    Ok(series)
}

/// Reads the series of `stack` in `file`. It must show the expected time step and, under a `wall` of this law, the
/// wall speed that `flag` says.
fn read(
    (flag, file): (&str, &Path),
    wall_speed: f64,
    time_step: Option<f64>,
    (stack, wall): (&Stack, &ContactLaw),
) -> Result<SeriesInput, CliError> {
    let content = read_bounded(file, LARGEST_SERIES, Links::Followed);
    let content = content.map_err(FileError::reading(file))?;
    let read = Series::read_unplanned(content.as_slice(), stack.bodies);
    let (series, own_step) = read.map_err(FileError::series(file))?;
    let input = SeriesInput {
        name: shown(file),
        series,
        time_step: own_step,
        wall_speed,
    };
    let refused = |message: String| CliError::from(FileError::content(file, message));
    if let Some(expected) = time_step.filter(|expected| differ(*expected, own_step)) {
        return Err(refused(format!(
            "its time step, `time` over `step`, is {own_step}; accepted is {expected}{}",
            expected_because(flag)
        )));
    }
    if let Some((speed, uncertainty)) = input.shown_speed(wall, stack)
        && (speed - wall_speed).abs() > uncertainty
    {
        return Err(refused(format!(
            "its wall moves at {speed:.4e} by its forces and positions, and {flag} says {wall_speed:e}; accepted are \
             speeds in the order of the files"
        )));
    }
    Ok(input)
}

fn differ(one: f64, other: f64) -> bool {
    let apart = (one - other).abs();
    apart > ROUNDING * other || apart.is_nan()
}

fn expected_because(flag: &str) -> &'static str {
    match flag {
        "--coarse-step" => ", twice that of the series that it belongs to",
        "--short-ramp" => ", that of the series that it belongs to",
        _ => ", that of --dt or of the first series",
    }
}
