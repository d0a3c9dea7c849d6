//! `tristack bench`.

use super::convention::settle;
use super::options::{
    CodeList, CodeListParser, Format, RunOptions, check_compress, selected_codes, whole,
};
use super::out::Out;
use super::progress::during;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::{Code, RunContext, SettledCode};
use crate::files::{FileError, Layout, Scratch};
use crate::model::PAPER_BODIES;
use crate::output::{
    DataTable, bench_machine, bench_markdown, json, performance_svg, pyramids, scaling,
};
use crate::study::cost::{PyramidBench, Scaling, installed_codes, measure_scaling, measure_stack};
use clap::Args;
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
    #[arg(long, alias = "code", value_parser = CodeListParser, value_name = "C1,C2")]
    codes: Vec<CodeList>,
    /// Number of measurements, whose medians are printed
    #[arg(long, value_name = "N", value_parser = whole::<usize>(1..=1000))]
    repeats: Option<usize>,
    /// Bodies on the floor of the stack: 2 cylinders, or 3 to 5 spheres
    #[arg(long, value_name = "N", default_value_t = PAPER_BODIES, conflicts_with = "pyramids", value_parser = whole::<u8>(2..=5))]
    bodies: u8,
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
    if !arguments.pyramids {
        check_compress(&CodeList::all(&arguments.codes), arguments.bodies)?;
    }
    let mut codes = timed_codes(&CodeList::all(&arguments.codes))?;
    if arguments.codes.is_empty() && arguments.bodies != PAPER_BODIES {
        codes.retain(|code| code.name().stacks_spheres());
    }
    let files = ["bench.csv", "bench.md", "scaling.csv", "performance.svg"];
    let layout = Layout::tables("bench.json", &files);
    let out = Out::claim(arguments.out.as_deref(), &layout)?;
    let temporary = std::env::temp_dir();
    let directory = Scratch::new().map_err(FileError::writing(&temporary))?;
    let context = RunContext::new(directory.path(), &INTERRUPT);
    let measured = match arguments.pyramids {
        true => time_pyramids(arguments, command, codes, &context),
        false => time_stack(arguments, command, &codes, &out, &context),
    };
    match measured {
        Err(_) if INTERRUPT.requested() => Ok(ExitStatus::Interrupted),
        other => other,
    }
}

/// Returns the named codes with native, or else the installed ones.
fn timed_codes(named: &[Code]) -> Result<Vec<SettledCode>, CliError> {
    if named.is_empty() {
        return Ok(during(
            "locating the programs of all codes",
            installed_codes,
        ));
    }
    let mut names = vec![Code::native()];
    names.extend_from_slice(named);
    let codes = selected_codes(&names)?;
    settle(&codes, &RunOptions::default())
}

/// Measures the stack, and how lanes scale if that is printed or written; prints and writes all of it.
fn time_stack(
    arguments: &Arguments,
    command: &str,
    codes: &[SettledCode],
    out: &Out,
    context: &RunContext,
) -> Result<ExitStatus, CliError> {
    let repeats = arguments.repeats;
    let timed = || measure_stack(codes, arguments.bodies, repeats, context);
    let costs = during(&format!("timing a step of {} codes", codes.len()), timed)?;
    let rows = || crate::output::bench(&costs);
    if !arguments.scaling && arguments.out.is_none() {
        return Ok(print(arguments.format, rows(), command, ""));
    }
    let measured = during("timing native lanes", || measure_scaling(repeats, context))?;
    let printed = print(arguments.format, rows(), command, &scaling_text(&measured));
    let written = out.write(|| {
        let all = measured.cases.iter().chain(&measured.cores);
        vec![
            ("bench.csv", rows().csv()),
            ("bench.json", json(&[rows()], command)),
            ("bench.md", bench_markdown(&costs, &measured)),
            ("scaling.csv", scaling(all).csv()),
            ("performance.svg", performance_svg(&costs, &measured)),
        ]
    });
    Ok(printed.max(written))
}

/// Describes how lanes scale, for a terminal.
fn scaling_text(measured: &Scaling) -> String {
    let (cases, cores) = (scaling(&measured.cases), scaling(&measured.cores));
    format!(
        "native lanes on one core:\n{}native lanes, planned runs:\n{}",
        cases.shown().terminal(),
        cores.shown().terminal()
    )
}

fn time_pyramids(
    arguments: &Arguments,
    command: &str,
    mut codes: Vec<SettledCode>,
    context: &RunContext,
) -> Result<ExitStatus, CliError> {
    if arguments.codes.is_empty() {
        codes.retain(|code| code.name().builds_pyramids());
    }
    let default = PyramidBench::default();
    let bench = PyramidBench {
        codes,
        repeats: arguments.repeats.unwrap_or(default.repeats),
        ..default
    };
    let costs = during("timing pyramids", || bench.measure(context))?;
    Ok(print(arguments.format, pyramids(&costs), command, ""))
}

/// Prints `rows`; a terminal also gets the machine above and `further` text below.
fn print(format: Format, rows: DataTable, command: &str, further: &str) -> ExitStatus {
    let tables = [rows];
    let table = || tables[0].shown().terminal();
    let people = || format!("{}\n{}{further}", bench_machine(), table());
    format.print(&tables, command, people)
}
