//! `tristack bench`.

use super::options::{CodeParser, Format, selected_codes, writable, write_all};
use super::{CliError, ExitStatus, INTERRUPT, print};
use crate::code::{Code, RunContext};
use crate::files::FileError;
use crate::output::{
    DataTable, bench_machine, bench_markdown, json, performance_svg, pyramids, scaling,
};
use crate::study::cost::{BenchTarget, PyramidBench, ScalingBench, StackBench, StackCost};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// What a step and a yield force cost, code by code
///
/// Native is always timed, a run at a time and in the lanes of vectors, since the others are compared with
/// it. A step costs the difference of a long and a short run, so that start-up cancels; all codes take
/// turns. Every code runs on one core. Nothing is taken from a store.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack bench --codes native,lammps --repeats 3")]
pub struct Arguments {
    /// Which codes, separated by commas; each must be installed [default: all that are, of each the first variant]
    #[arg(long, value_parser = CodeParser, value_delimiter = ',', value_name = "C1,C2")]
    codes: Vec<Code>,
    /// How often everything is measured; medians are printed
    #[arg(long, value_name = "N")]
    repeats: Option<NonZeroUsize>,
    /// Pyramids of a thousand to ten thousand cylinders instead of the stack
    #[arg(long)]
    pyramids: bool,
    /// How native lanes scale with the number of cases and cores, too
    #[arg(long, conflicts_with = "pyramids")]
    scaling: bool,
    /// Directory for bench.csv, bench.json, bench.md, scaling.csv and performance.svg; implies --scaling
    #[arg(long, value_name = "DIR", conflicts_with = "pyramids")]
    out: Option<PathBuf>,
    /// How to print the rows; those of the scaling are in the table alone
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Measures, prints and writes.
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let codes = timed_codes(&arguments.codes)?;
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let temporary = std::env::temp_dir();
    let directory = tempfile::tempdir().map_err(FileError::writing(&temporary))?;
    let context = RunContext::new(directory.path(), &INTERRUPT);
    let measured = match arguments.pyramids {
        true => measure_pyramids(arguments, command, codes, &context),
        false => measure_stack(arguments, command, &codes, &context),
    };
    match measured {
        Err(_) if INTERRUPT.requested() => Ok(ExitStatus::Interrupted),
        Err(error) => Err(error),
        Ok(output) => print(&output),
    }
}

/// The codes named and native, or those of the default that are installed.
fn timed_codes(named: &[Code]) -> Result<Vec<Code>, CliError> {
    if named.is_empty() {
        return Ok(StackBench::installed());
    }
    let mut names = vec![Code::NATIVE];
    names.extend(named);
    let codes = selected_codes(&names)?;
    Ok(codes.iter().map(|who| who.name).collect())
}

fn measure_stack(
    arguments: &Arguments,
    command: &str,
    codes: &[Code],
    context: &RunContext,
) -> Result<Vec<u8>, CliError> {
    let default = StackBench::default();
    let bench = StackBench {
        targets: codes.iter().copied().flat_map(BenchTarget::of).collect(),
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let costs = bench.measure(context)?;
    let mut output = printed(arguments.format, crate::output::bench(&costs), command);
    if arguments.scaling || arguments.out.is_some() {
        let further = measure_scaling(arguments, command, &costs, context)?;
        if arguments.format == Format::Table {
            output.extend(further.into_bytes());
        }
    }
    Ok(output)
}

/// Measures and writes what goes beyond the rows, and returns it for people.
fn measure_scaling(
    arguments: &Arguments,
    command: &str,
    costs: &[StackCost],
    context: &RunContext,
) -> Result<String, CliError> {
    let default = ScalingBench::default();
    let bench = ScalingBench {
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let measured = bench.measure(context)?;
    if let Some(directory) = &arguments.out {
        let all = measured.cases.iter().chain(&measured.cores);
        let rows = crate::output::bench(costs);
        let files = [
            ("bench.csv", rows.csv()),
            ("bench.json", json(&[rows], command)),
            ("bench.md", bench_markdown(costs, &measured).into_bytes()),
            ("scaling.csv", scaling(all).csv()),
            (
                "performance.svg",
                performance_svg(costs, &measured).into_bytes(),
            ),
        ];
        write_all(directory, &files)?;
    }
    let (cases, cores) = (scaling(&measured.cases), scaling(&measured.cores));
    Ok(format!(
        "native lanes on one core:\n{}native lanes, planned runs:\n{}",
        cases.shown().terminal(),
        cores.shown().terminal()
    ))
}

fn measure_pyramids(
    arguments: &Arguments,
    command: &str,
    mut codes: Vec<Code>,
    context: &RunContext,
) -> Result<Vec<u8>, CliError> {
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
    Ok(printed(arguments.format, pyramids(&costs), command))
}

fn printed(format: Format, rows: DataTable, command: &str) -> Vec<u8> {
    let tables = [rows];
    format.render(&tables, command, || {
        format!("{}\n{}", bench_machine(), tables[0].shown().terminal())
    })
}
