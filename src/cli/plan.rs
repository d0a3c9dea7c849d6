//! `tristack plan`.

use super::options::{CodeParser, Format, ResolutionOptions};
use super::out::Out;
use super::stack_set::StackSet;
use super::{CliError, ExitStatus};
use crate::code::{Code, FailureKind, PlannedRun};
use crate::files::{FileError, Layout};
use crate::model::{InvalidValue, shell_quoted, shown};
use crate::output::{parallel_list, planned_runs, slurm_array, start_list};
use crate::study::{PLAN, Plan, PlannedRow};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Duration;

const START: &str = "start.txt";
const PARALLEL: &str = "parallel.txt";
const SLURM: &str = "array.slurm";
/// Time that a task on a cluster is given: these seconds for its start, and this multiple of the forecast of its run.
const STARTING: f64 = 60.0;
const SLOWER: f64 = 10.0;

/// Plan runs that are made elsewhere, for `tristack judge`
///
/// Writes a directory for every run of a crosscheck with all that the code is given, and lists of what to start where:
/// start.txt for a shell, parallel.txt for GNU parallel, array.slurm for Slurm. Needs the folder of the code, not its
/// program, and starts none. Runs come in up to three rounds: micro-tests, further ones that follow from their results, and the stacks
/// if the manifest leaves out parts of the convention. The same command again adds the next round. A run that has a result is left as it is.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack plan --code ./mydem --out away\n         \
    (cd away && sh start.txt) or (cd away && parallel < parallel.txt) or (cd away && sbatch array.slurm)\n         \
    tristack plan --code ./mydem --out away      # the next round, as long as it says that there is one\n         \
    tristack judge away"
)]
pub(super) struct Arguments {
    /// Code whose runs are planned: a name or a folder
    #[arg(long, alias = "codes", value_parser = CodeParser, value_name = "CODE")]
    code: Code,
    #[command(flatten)]
    stacks: StackSet,
    #[command(flatten)]
    resolution: ResolutionOptions,
    /// Directory for plan.json, the lists and the directories of the runs: a new or empty one, or that of an earlier plan
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Format of the list of runs
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Writes or continues the plan, and prints what it costs.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let (code, root) = (arguments.code.clone(), arguments.out.as_path());
    if !code.has_program() {
        return Err(InvalidValue {
            key: "--code".to_owned(),
            value: code.to_string(),
            accepted: "a code with a program; this one is part of tristack, and runs here"
                .to_owned(),
        }
        .into());
    }
    code.check_compresses(arguments.stacks.others.bodies)?;
    Out::claim(Some(root), &layout())?;
    let earlier = Plan::read(root)?;
    let rows = rows(arguments, earlier.as_ref())?;
    let is_here = code.is_here();
    let (plan, prepared) = Plan::new(&code, rows, root, command)?;
    let out = Out::claimed(root, PLAN);
    let planned = out.write(|| vec![(PLAN, plan.to_json())]);
    if planned != ExitStatus::Success {
        return Ok(planned);
    }
    for run in &prepared {
        run.write(root)?;
    }
    let troubles = plan.troubles(&code, root);
    let listed = out.write(|| lists(&code, &open_runs(&plan, &troubles)));
    let table = [planned_runs(&plan.runs, &troubles)];
    let people = || {
        let expected = match is_here {
            true => String::new(),
            false => format!(
                "its program was not found here, {}; the lists expect it in the search path\n",
                code.places()
            ),
        };
        expected + &summary(&plan, &troubles, root)
    };
    let printed = arguments.format.print(&table, command, people);
    Ok(listed.max(printed))
}

/// Returns the rows of the earlier plan, which must be for the same code, and those that are asked for.
fn rows(arguments: &Arguments, earlier: Option<&Plan>) -> Result<Vec<PlannedRow>, CliError> {
    let code = arguments.code.clone();
    let mut rows = Vec::new();
    if let Some(plan) = earlier {
        if plan.code != code.as_str() {
            let message = format!(
                "it is a plan for {}, and --code is {code}; accepted is the same code, or another directory",
                plan.code
            );
            let path = arguments.out.join(PLAN);
            return Err(FileError::content(&path, message).into());
        }
        rows.clone_from(&plan.rows);
    }
    for measurement in arguments
        .stacks
        .measurements(&[code.unmeasured("")], code.law().power)?
    {
        let row = PlannedRow::of(&arguments.resolution.accepted(measurement));
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Returns the runs that have no usable result yet.
fn open_runs<'a>(plan: &'a Plan, troubles: &[Option<FailureKind>]) -> Vec<&'a PlannedRun> {
    let runs = plan.runs.iter().zip(troubles);
    let open = runs.filter(|(_, trouble)| trouble.is_some());
    open.map(|(run, _)| run).collect()
}

fn lists(code: &Code, open: &[&PlannedRun]) -> Vec<(&'static str, String)> {
    // The time limit of runs on this machine is generous; a partition of a cluster may refuse it.
    let limit = |run: &PlannedRun| {
        let forecast = Duration::try_from_secs_f64(STARTING + SLOWER * run.seconds).ok();
        let forecast = forecast.filter(|_| run.seconds > 0.0);
        let longest = code.time_limit(run.steps);
        forecast.map_or(longest, |forecast| longest.min(forecast))
    };
    vec![
        (START, start_list(open)),
        (PARALLEL, parallel_list(open)),
        (SLURM, slurm_array(code.as_str(), open, limit)),
    ]
}

fn layout() -> Layout {
    Layout {
        shared: true,
        ..Layout::tables(PLAN, &[START, PARALLEL, SLURM])
    }
}

/// Says what is planned, what it costs, and what to do next.
fn summary(plan: &Plan, troubles: &[Option<FailureKind>], root: &Path) -> String {
    let open = open_runs(plan, troubles);
    let directory = shell_quoted(&shown(root));
    let (runs, rows) = (plan.runs.len(), plan.rows.len());
    let steps: u64 = open.iter().map(|run| run.steps).sum();
    let seconds = open.iter().map(|run| run.seconds);
    let longest = seconds.clone().fold(0.0, f64::max);
    let all: f64 = seconds.sum();
    let forecast = match all > 0.0 {
        _ if open.is_empty() => "every run has a result".to_owned(),
        true => format!(
            "by the forecast of the manifest {all:.0} s on one core, the longest run {longest:.1} s"
        ),
        false => "how long they take, `seconds` of a manifest would say".to_owned(),
    };
    let mut text = format!(
        "{runs} runs for {rows} rows, {} of which have results\n\
         to do: {} runs, {steps} steps; {forecast}\n",
        runs - open.len(),
        open.len(),
    );
    if !open.is_empty() {
        text += &format!(
            "start them in {directory}: sh {START}, or parallel < {PARALLEL}, or sbatch {SLURM}\n"
        );
    }
    if plan.continues {
        text +=
            "then: the same tristack plan again, for runs that follow from the results of these\n";
    }
    text + &format!("then: tristack judge {directory}\n")
}
