//! `tristack bench`.

use super::options::{Format, participants, writable};
use super::{CliError, ExitStatus, INTERRUPT, print};
use crate::archive::{ArchiveError, write_atomically};
use crate::bench::{Contestant, PyramidBench, ScalingBench, StackBench};
use crate::engine::{EngineName, Workplace};
use crate::report::{
    BenchRow, bench_csv, bench_json, bench_machine, bench_markdown, bench_rows, bench_table,
    performance_svg, pyramid_rows, pyramid_table, scaling_table,
};
use clap::Args;
use serde::Serialize;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

/// What a step and a yield force cost, engine by engine
///
/// Native is always timed, a run at a time and in the lanes of vectors, since the others are compared with
/// it. A step costs the difference of a long and a short run, so that start-up cancels; all engines take
/// turns. Every engine runs on one core. Nothing is taken from a store.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack bench --engines native,lammps --repeats 3")]
pub struct Arguments {
    /// Which engines, separated by commas; each must be installed [default: all that are, YADE on its box]
    #[arg(long, value_enum, value_delimiter = ',', value_name = "E1,E2")]
    engines: Vec<EngineName>,
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
    let engines = engines(&arguments.engines)?;
    if let Some(directory) = &arguments.out {
        writable(directory)?;
    }
    let temporary = std::env::temp_dir();
    let directory = tempfile::tempdir().map_err(ArchiveError::writing(&temporary))?;
    let workplace = Workplace::new(directory.path(), &INTERRUPT);
    let measured = match arguments.pyramids {
        true => measure_pyramids(arguments, engines, &workplace),
        false => measure_stack(arguments, &engines, &workplace),
    };
    match measured {
        Err(_) if INTERRUPT.requested() => Ok(ExitStatus::Interrupted),
        Err(error) => Err(error),
        Ok(output) => print(&output),
    }
}

/// The engines named and native, or those of the default that are installed.
fn engines(named: &[EngineName]) -> Result<Vec<EngineName>, CliError> {
    if named.is_empty() {
        return Ok(StackBench::installed());
    }
    let mut names = vec![EngineName::Native];
    names.extend(named);
    let participants = participants(&names)?;
    Ok(participants.iter().map(|who| who.name).collect())
}

fn measure_stack(
    arguments: &Arguments,
    engines: &[EngineName],
    workplace: &Workplace,
) -> Result<Vec<u8>, CliError> {
    let default = StackBench::default();
    let bench = StackBench {
        contestants: engines.iter().copied().flat_map(Contestant::of).collect(),
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let rows = bench_rows(&bench.measure(workplace)?);
    let mut output = printed(arguments.format, &rows, || bench_table(&rows).terminal());
    if arguments.scaling || arguments.out.is_some() {
        let further = measure_scaling(arguments, &rows, workplace)?;
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
    workplace: &Workplace,
) -> Result<String, CliError> {
    let default = ScalingBench::default();
    let bench = ScalingBench {
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let scaling = bench.measure(workplace)?;
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

fn write(directory: &Path, name: &str, content: &[u8]) -> Result<(), ArchiveError> {
    write_atomically(&directory.join(name), content)
}

fn measure_pyramids(
    arguments: &Arguments,
    mut engines: Vec<EngineName>,
    workplace: &Workplace,
) -> Result<Vec<u8>, CliError> {
    if arguments.engines.is_empty() {
        engines.retain(|engine| engine.builds_pyramids());
    }
    let default = PyramidBench::default();
    let bench = PyramidBench {
        engines,
        repeats: arguments.repeats.map_or(default.repeats, usize::from),
        ..default
    };
    let costs = bench.measure(workplace)?;
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
