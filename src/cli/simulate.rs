//! `tristack simulate`.

use super::convention::settle_one;
use super::options::{
    CodeParser, ConventionOptions, Format, OneStackOptions, RunOptions, as_flag, number,
    options_of, seconds, time_limit,
};
use super::out::Out;
use super::pictures::Pictures;
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT, complain, given, print, tell};
use crate::code::{
    Code, Failure, HOME, InstalledCode, Run, RunContext, SettledCode, keep_evidence,
};
use crate::files::{FileError, Layout, read_case_with, remove_older, write_atomically};
use crate::model::{
    Case, ContactConvention, InvalidValue, PartialCase, PartialProtocol, Problem, Protocol,
    Shortcuts, SideWalls, Stack, shown,
};
use crate::output::{commented_case, json, series_columns, simulations, unfinished};
use crate::paper::published::GivenCase;
use crate::runs::Progress;
use crate::study::preparation::between_side_walls;
use crate::study::yield_force::{
    NoYield, max_touch_speed, no_yield, planned_protocol, protocol_at_speed,
};
use crate::theory::{Limit, quasistatic_limit};
use clap::{ArgGroup, Args, Id, ValueEnum};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Default wall speed, in units of the predicted displacement z at yield.
const DEFAULT_SPEED: f64 = 1e-3;
const DEFAULT_TIME_STEP: f64 = 0.1;
/// The stack of `--example`.
const EXAMPLE_FRICTION: f64 = 0.3;
const EXAMPLE_STIFFNESS: f64 = 100.0;

/// The preparation of the stack before the compression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PreparationKind {
    /// Gravity rises over 100 sqrt(m/k_n): no sliding, no force between the bottom cylinders
    GravityRamp,
    /// That of the paper: side walls pushed in by A, top cylinder lowered at 0.1, walls withdrawn at 1e-3 (speeds in r sqrt(k_n/m))
    SideWalls,
}

/// Run one compression
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack simulate --code native --mu 0.3 --stiffness 1e3 --out run\n          \
    tristack simulate --code native --mu 0.2 --stiffness 1e2 --preparation side-walls --push 0.005"
)]
#[command(group(ArgGroup::new("input").required(true).args(["case", "mu", "example"])))]
pub(super) struct Arguments {
    /// Code that runs the case
    #[arg(long, alias = "codes", required_unless_present = "example", value_parser = CodeParser, value_name = "CODE")]
    code: Option<Code>,
    /// Print a case file with every key, its default and its meaning, and exit
    #[arg(long, exclusive = true)]
    example: bool,
    /// A case file, .toml or .json, instead of --mu, --stiffness and the rest; needs only what differs from the defaults. With a
    /// table `start` it is run from that state, as the program of the paper's authors runs
    #[arg(long, value_name = "FILE", conflicts_with_all = replaced_by_case())]
    case: Option<PathBuf>,
    #[command(flatten)]
    stack: OneStackOptions,
    #[command(flatten)]
    convention: ConventionOptions,
    /// Preparation of the stack; a code without a deck for side walls refuses them
    #[arg(long, value_enum, default_value_t = PreparationKind::GravityRamp)]
    preparation: PreparationKind,
    /// Distance A by which each side wall is pushed in, in r [default: 0]
    #[arg(long, value_name = "A", value_parser = number)]
    push: Option<f64>,
    /// Wall speed in r sqrt(k_n/m) [default: 1e-3 of the predicted displacement at yield]
    #[arg(long, value_name = "V", value_parser = number)]
    speed: Option<f64>,
    /// Time step in sqrt(m/k_n)
    #[arg(long, default_value_t = DEFAULT_TIME_STEP, value_parser = number)]
    dt: f64,
    /// Approach the predicted yield up to ten times faster and stop after it; only native supports shortcuts
    #[arg(long)]
    shortcuts: bool,
    /// Directory for case, series with the units of its columns, summary, deck and captured output
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    #[command(flatten)]
    pub(super) pictures: Pictures,
    /// Time limit in seconds [default: 30 s plus 100 us per step for external codes, none for native]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(super) time_limit: Option<f64>,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    pub(super) format: Format,
}

/// Returns the options whose values a case file holds.
fn replaced_by_case() -> Vec<Id> {
    let run = ["preparation", "push", "speed", "dt", "shortcuts"];
    let mut options: Vec<Id> = run.map(Id::from).into();
    options.extend(options_of::<OneStackOptions>());
    options.extend(options_of::<ConventionOptions>());
    options
}

/// Runs one case and prints both estimators.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    if arguments.example {
        return Ok(print(&example()?));
    }
    if let Some(path) = &arguments.case
        && let Some(given) = GivenCase::read(path)?
    {
        return given::run(arguments, &given, path, command);
    }
    // How many bodies a case file has is known later: a code that stacks spheres alone is refused then.
    if arguments.case.is_none() || !arguments.code().stacks_spheres() {
        let bodies = arguments.stack.bodies();
        arguments.code().check_compresses(bodies)?;
    }
    // Micro-tests go to the store, where the other commands find them.
    let settled = settle_one(&arguments.code(), &RunOptions::default())?;
    let case = case(arguments, &settled)?;
    tell_changed_durations(&case);
    let limit = time_limit(arguments.time_limit)?;
    let code = arguments.code().find();
    let code = code.ok_or(CliError::MissingCode(arguments.code()))?;
    let out = Out::claim(arguments.out.as_deref(), &run_layout(arguments, &case))?;
    arguments.pictures.claim(arguments.out.as_deref())?;
    let begun = begin(arguments.out.as_deref(), &case)?;
    let run = match arguments.out.as_deref() {
        Some(directory) if begun == ExitStatus::Success => {
            execute(code.as_ref(), &case, limit, directory)?
        }
        _ => execute_in_scratch(code.as_ref(), &case, limit)?,
    };
    let tables = [simulations(std::slice::from_ref(&run))];
    let people = || tables[0].transposed(&["value"]).terminal();
    let printed = arguments.format.print(&tables, command, people);
    let results = || {
        vec![
            (SERIES, run.series.to_csv()),
            (
                SERIES_COLUMNS,
                series_columns(SERIES, &run.series).into_bytes(),
            ),
            (SUMMARY, json(&tables, command).into_bytes()),
        ]
    };
    // The directory is recognized by the case, so that nothing may be there without it.
    let written = match begun {
        ExitStatus::Success => out.write(results),
        failed => failed,
    };
    let drawn = arguments.pictures.draw(&arguments.code(), &run)?;
    if let Some(problem) = unfinished(&run) {
        tell!("{problem}");
    }
    Ok(printed.max(written).max(drawn))
}

/// Says which durations differ from those of the case: rows lie at whole steps, and phases begin at rows.
fn tell_changed_durations(case: &Case) {
    for (key, asked, made) in case.protocol.changed_durations() {
        tell!(
            "`{key}` is {asked}, and carried out as {made}, a whole number of fine intervals in whole time steps"
        );
    }
}

/// Runs the case in a temporary directory, which stays if it helps to explain a failure.
fn execute_in_scratch(
    code: &dyn InstalledCode,
    case: &Case,
    limit: Option<Duration>,
) -> Result<Run, CliError> {
    let scratch = tempfile::Builder::new().prefix("tristack-").tempdir();
    let scratch = scratch.map_err(FileError::writing(&std::env::temp_dir()))?;
    // The run directory is one level down: files that a program writes beside it are in the temporary directory too.
    let outcome = execute(code, case, limit, &scratch.path().join("run"));
    if let Err(failure) = &outcome
        && failure.left_evidence()
    {
        keep_evidence(scratch);
    }
    Ok(outcome?)
}

fn execute(
    code: &dyn InstalledCode,
    case: &Case,
    limit: Option<Duration>,
    directory: &Path,
) -> Result<Run, Box<Failure>> {
    let reporter = Reporter::new();
    let name = code.name();
    reporter.begins(&format!("compression by {name}"));
    let seconds = |steps: u64| steps as f64 * name.seconds_per_step();
    reporter.planned("run", 0, 0, seconds(case.total_steps()));
    let done = AtomicU64::new(0);
    let advanced = |_, steps| {
        let before = done.fetch_max(steps, Ordering::Relaxed);
        reporter.advanced(seconds(steps.saturating_sub(before)));
    };
    let context = RunContext {
        time_limit: limit,
        advanced: &advanced,
        ..RunContext::new(directory, &INTERRUPT)
    };
    let mut outcome = None;
    let case = std::slice::from_ref(case);
    code.run(case, &context, &mut |_, result| outcome = Some(result));
    outcome
        .expect("a code reports every case")
        .map_err(Box::new)
}

fn case(arguments: &Arguments, code: &SettledCode) -> Result<Case, CliError> {
    if let Some(path) = &arguments.case {
        let case = read_case_with(path, |written| completed(written, code))?;
        let protocol = &case.protocol;
        code.check_case(&case)?;
        let code = code.name();
        code.check_preparation(&case.stack, &protocol.preparation)?;
        code.check_shortcuts(protocol.shortcuts.is_some())?;
        return Ok(case);
    }
    let bodies = arguments.stack.bodies();
    let convention = arguments.convention.of(code, bodies)?;
    let stack = arguments.stack.stack(convention.law.power)?;
    let convention = convention.of_bodies(&stack);
    let accepted = arguments
        .code()
        .check_stiffness_ratio(stack.stiffness_ratio);
    accepted.map_err(as_flag)?;
    let problem = Problem::new(stack, convention).map_err(as_flag)?;
    let limit = quasistatic_limit(&problem);
    let mut protocol = planned(&limit, &problem, arguments.speed, arguments.dt)?;
    let accepted = arguments.code().check_shortcuts(arguments.shortcuts);
    accepted.map_err(as_flag)?;
    if let Some(travel) = limit.wall_travel.filter(|_| arguments.shortcuts) {
        let gentle = max_touch_speed(&stack, &convention);
        protocol.shortcuts = Shortcuts::towards(travel, protocol.wall_speed, gentle);
    }
    let case = Case {
        stack,
        convention,
        protocol: prepared(&protocol, arguments, &stack)?,
    };
    case.validate().map_err(as_flag)?;
    Ok(case)
}

/// Returns the usual protocol, at a wall speed if one is given.
fn planned(
    limit: &Limit,
    problem: &Problem,
    speed: Option<f64>,
    time_step: f64,
) -> Result<Protocol, Box<NoYield>> {
    let (stack, convention) = (problem.stack(), problem.convention());
    let protocol = match speed {
        Some(speed) => protocol_at_speed(limit, speed, time_step),
        None => planned_protocol(limit, stack, convention, DEFAULT_SPEED, time_step),
    };
    protocol.ok_or_else(|| Box::new(no_yield(problem, limit)))
}

/// Completes a case that a file gives in part; the rest is as for a case of the command line.
fn completed(written: &PartialCase, code: &SettledCode) -> Result<Case, InvalidValue> {
    let own = &written.protocol;
    let convention = written.convention.unwrap_or_else(|| of_files(code));
    let stack = written.stack.in_law(convention.law.power);
    stack.validate()?;
    let convention = convention.of_bodies(&stack);
    let problem = Problem::new(stack, convention)?;
    let limit = quasistatic_limit(&problem);
    let time_step = own.time_step.unwrap_or(DEFAULT_TIME_STEP);
    let planned = planned(&limit, &problem, own.wall_speed, time_step);
    let mut protocol = planned.map_err(|no_yield| no_yield.as_value())?;
    if let Some(walls) = own.side_walls(stack.epsilon()) {
        protocol = between_side_walls(&protocol, walls);
    }
    Ok(Case {
        stack,
        convention,
        protocol: own.over(&protocol),
    })
}

/// Returns the convention of a case file for `code` that gives none: that of the code or, if the code takes any, the
/// default of case files, in which springs turn whatever the default of the command line.
fn of_files(code: &SettledCode) -> ContactConvention {
    match code.name().accepts_any_convention() {
        true => ContactConvention::default(),
        false => code.convention(),
    }
}

/// Returns a case file for the paper's stack, with every key and what it means.
fn example() -> Result<String, CliError> {
    let written = PartialCase {
        stack: Stack::paper(EXAMPLE_FRICTION, EXAMPLE_STIFFNESS).into(),
        convention: Some(ContactConvention::PAPER),
        protocol: PartialProtocol::default(),
    };
    Ok(commented_case(&completed(
        &written,
        &SettledCode::native(),
    )?))
}

/// Returns `protocol` with the preparation of the command line.
fn prepared(
    protocol: &Protocol,
    arguments: &Arguments,
    stack: &Stack,
) -> Result<Protocol, InvalidValue> {
    match (arguments.preparation, arguments.push) {
        (PreparationKind::GravityRamp, None) => Ok(*protocol),
        (PreparationKind::GravityRamp, Some(push)) => {
            let accepted = "left out, unless --preparation is side-walls";
            Err(InvalidValue::new("--push", push, accepted))
        }
        (PreparationKind::SideWalls, push) => {
            // Adding zero turns -0 into 0, which is the same push and must be the same case.
            let walls = SideWalls::paper(push.unwrap_or(0.0) + 0.0, stack.epsilon());
            let protocol = between_side_walls(protocol, walls);
            stack.refuse_spheres().map_err(as_flag)?;
            let accepted = arguments
                .code()
                .check_preparation(stack, &protocol.preparation);
            accepted.map_err(as_flag)?;
            Ok(protocol)
        }
    }
}

const CASE: &str = "case.json";
const SERIES: &str = "series.csv";
const SERIES_COLUMNS: &str = "series.csv-metadata.json";
const SUMMARY: &str = "summary.json";
/// Files that are written after the run.
const RESULTS: [&str; 3] = [SERIES, SERIES_COLUMNS, SUMMARY];

/// Removes the results of an earlier run from the directory, if one is given, because they must not stand beside the
/// deck of this run, and writes the case. A full disk is reported, but does not prevent the run.
fn begin(directory: Option<&Path>, case: &Case) -> Result<ExitStatus, FileError> {
    let Some(directory) = directory else {
        return Ok(ExitStatus::Success);
    };
    for path in RESULTS.map(|name| directory.join(name)) {
        remove_older(&path).map_err(FileError::writing(&path))?;
    }
    match write_atomically(&directory.join(CASE), case.to_json().as_bytes()) {
        Err(error) if error.is_full() => {
            complain!("error: {}", shown(Path::new(&error.to_string())));
            Ok(ExitStatus::NotWritten)
        }
        written => written.map(|()| ExitStatus::Success),
    }
}

/// Returns the files of a run in the directory of `--out`, with pictures that are asked for in the same place.
fn run_layout(arguments: &Arguments, case: &Case) -> Layout {
    let mut files = arguments.code().run_files(case);
    files.extend(RESULTS.map(str::to_owned));
    files.extend(arguments.pictures.files_in(arguments.out.as_deref()));
    Layout {
        witness: CASE,
        is_ours: |content| Case::parse(content, Path::new(CASE)).is_ok(),
        files,
        shared: false,
        scratch: Some(HOME),
    }
}

impl Arguments {
    /// Returns the code; native if none is given, which only `--example` allows.
    pub(super) fn code(&self) -> Code {
        self.code.clone().unwrap_or(Code::native())
    }
}
