//! `tristack bench`.

use super::options::{CodeParser, Format, selected_codes, writable};
use super::{CliError, ExitStatus, INTERRUPT, print};
use crate::code::{Code, RunContext};
use crate::files::{FileError, write_atomically};
use crate::output::{
    BenchRow, bench_csv, bench_json, bench_machine, bench_markdown, bench_rows, bench_table,
    performance_svg, pyramid_rows, pyramid_table, scaling_table,
};
use crate::study::cost::{BenchTarget, PyramidBench, ScalingBench, StackBench};
use clap::Args;
use serde::Serialize;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

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
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let codes = timed_codes(&arguments.codes)?;
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let temporary = std::env::temp_dir();
    let directory = tempfile::tempdir().map_err(FileError::writing(&temporary))?;
    let context = RunContext::new(directory.path(), &INTERRUPT);
    let measured = match arguments.pyramids {
        true => measure_pyramids(arguments, codes, &context),
        false => measure_stack(arguments, &codes, &context),
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
    codes: &[Code],
    context: &RunContext,
) -> Result<Vec<u8>, CliError> {
    let default = StackBench::default();
    let bench = StackBench {
        targets: codes.iter().copied().flat_map(BenchTarget::of).collect(),
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let rows = bench_rows(&bench.measure(context)?);
    let mut output = printed(arguments.format, &rows, || bench_table(&rows).terminal());
    if arguments.scaling || arguments.out.is_some() {
        let further = measure_scaling(arguments, &rows, context)?;
        if arguments.format == Format::Table {
            output.extend(further.into_bytes());
        }
    }
    Ok(output)
}

/// Measures and writes what goes beyond the rows, and returns it for people.
fn measure_scaling(
    arguments: &Arguments,
    rows: &[BenchRow],
    context: &RunContext,
) -> Result<String, CliError> {
    let default = ScalingBench::default();
    let bench = ScalingBench {
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let scaling = bench.measure(context)?;
    if let Some(directory) = &arguments.out {
        let all = [scaling.cases.as_slice(), &scaling.cores].concat();
        let markdown = bench_markdown(rows, &scaling);
        let svg = performance_svg(rows, &scaling);
        write(directory, "bench.csv", &bench_csv(rows))?;
        write(directory, "bench.json", bench_json(rows).as_bytes())?;
        write(directory, "bench.md", markdown.as_bytes())?;
        write(directory, "scaling.csv", &bench_csv(&all))?;
        write(directory, "performance.svg", svg.as_bytes())?;
    }
    let (cases, cores) = (scaling_table(&scaling.cases), scaling_table(&scaling.cores));
    Ok(format!(
        "native lanes on one core:\n{}native lanes, planned runs:\n{}",
        cases.terminal(),
        cores.terminal()
    ))
}

fn write(directory: &Path, name: &str, content: &[u8]) -> Result<(), FileError> {
    write_atomically(&directory.join(name), content)
}

fn measure_pyramids(
    arguments: &Arguments,
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
    let rows = pyramid_rows(&costs);
    Ok(printed(arguments.format, &rows, || {
        pyramid_table(&rows).terminal()
    }))
}

fn printed<R: Serialize>(format: Format, rows: &[R], table: impl Fn() -> String) -> Vec<u8> {
    match format {
        Format::Table => format!("{}\n{}", bench_machine(), table()).into_bytes(),
        Format::Json => bench_json(rows).into_bytes(),
        Format::Csv => bench_csv(rows),
    }
}
