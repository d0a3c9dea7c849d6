//! `tristack bench`.

use super::options::{CodeParser, Format, selected_codes, writable, write_all};
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::{Code, RunContext};
use crate::files::FileError;
use crate::output::{
    DataTable, bench_machine, bench_markdown, json, performance_svg, pyramids, scaling,
};
use crate::study::cost::{
    PyramidBench, StackCost, installed_codes, measure_scaling, measure_stack,
};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Measure the cost of a time step and of a yield force
///
/// Native is always timed, one run at a time and in vector lanes, since the other codes are compared with it. The
/// cost of a step is the difference of a long and a short run, so that start-up cancels. The codes take turns,
/// each on one core. No run is taken from the store.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack bench --codes native,lammps --repeats 3")]
pub(super) struct Arguments {
    /// Codes to time, separated by commas; each must be installed [default: the first variant of every installed code]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    /// Number of measurements, whose medians are printed
    #[arg(long, value_name = "N")]
    repeats: Option<NonZeroUsize>,
    /// Time pyramids of a thousand to ten thousand cylinders instead of the stack
    #[arg(long)]
    pyramids: bool,
    /// Also measure how native lanes scale with the number of cases and cores
    #[arg(long, conflicts_with = "pyramids")]
    scaling: bool,
    /// Directory for bench.csv, bench.json, bench.md, scaling.csv and performance.svg; implies --scaling
    #[arg(long, value_name = "DIR", conflicts_with = "pyramids")]
    out: Option<PathBuf>,
    /// Format of the rows; the scaling is printed in the table format alone
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Measures, prints and writes the costs.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let codes = timed_codes(&arguments.codes)?;
    writable(arguments.out.as_deref())?;
    let temporary = std::env::temp_dir();
    let directory = tempfile::tempdir().map_err(FileError::writing(&temporary))?;
    let context = RunContext::new(directory.path(), &INTERRUPT);
    let measured = match arguments.pyramids {
        true => time_pyramids(arguments, command, codes, &context),
        false => time_stack(arguments, command, &codes, &context),
    };
    match measured {
        Err(_) if INTERRUPT.requested() => Ok(ExitStatus::Interrupted),
        other => other,
    }
}

/// The named codes with native, or else the installed ones.
fn timed_codes(named: &[Code]) -> Result<Vec<Code>, CliError> {
    if named.is_empty() {
        return Ok(installed_codes());
    }
    let mut names = vec![Code::NATIVE];
    names.extend(named);
    let codes = selected_codes(&names)?;
    Ok(codes.iter().map(|selected| selected.name).collect())
}

fn time_stack(
    arguments: &Arguments,
    command: &str,
    codes: &[Code],
    context: &RunContext,
) -> Result<ExitStatus, CliError> {
    let costs = measure_stack(codes, arguments.repeats.map(usize::from), context)?;
    let rows = crate::output::bench(&costs);
    let further = match arguments.scaling || arguments.out.is_some() {
        true => time_scaling(arguments, command, &costs, context)?,
        false => String::new(),
    };
    print(arguments.format, rows, command, &further)
}

/// Measures how lanes scale, writes all files, and returns the text for a terminal.
fn time_scaling(
    arguments: &Arguments,
    command: &str,
    costs: &[StackCost],
    context: &RunContext,
) -> Result<String, CliError> {
    let measured = measure_scaling(arguments.repeats.map(usize::from), context)?;
    write_all(arguments.out.as_deref(), || {
        let all = measured.cases.iter().chain(&measured.cores);
        let rows = crate::output::bench(costs);
        [
            ("bench.csv", rows.csv()),
            ("bench.json", json(&[rows], command)),
            ("bench.md", bench_markdown(costs, &measured)),
            ("scaling.csv", scaling(all).csv()),
            ("performance.svg", performance_svg(costs, &measured)),
        ]
    })?;
    let (cases, cores) = (scaling(&measured.cases), scaling(&measured.cores));
    Ok(format!(
        "native lanes on one core:\n{}native lanes, planned runs:\n{}",
        cases.shown().terminal(),
        cores.shown().terminal()
    ))
}

fn time_pyramids(
    arguments: &Arguments,
    command: &str,
    mut codes: Vec<Code>,
    context: &RunContext,
) -> Result<ExitStatus, CliError> {
    if arguments.codes.is_empty() {
        codes.retain(|code| code.builds_pyramids());
    }
    let default = PyramidBench::default();
    let bench = PyramidBench {
        codes,
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let costs = bench.measure(context)?;
    print(arguments.format, pyramids(&costs), command, "")
}

/// Prints `rows`; a terminal also gets the machine above and `further` text below.
fn print(
    format: Format,
    rows: DataTable,
    command: &str,
    further: &str,
) -> Result<ExitStatus, CliError> {
    let tables = [rows];
    let table = || tables[0].shown().terminal();
    let people = || format!("{}\n{}{further}", bench_machine(), table());
    format.print(&tables, command, people)
}
