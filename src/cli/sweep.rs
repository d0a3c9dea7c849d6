//! `tristack sweep`.

use super::convention::settle_one;
use super::crosscheck::conclude;
use super::options::{
    CodeParser, ConventionOptions, Format, RowOptions, RunOptions, StackListOptions, as_flag,
    selected_codes,
};
use super::out::Out;
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::Layout;
use crate::model::Stack;
use crate::output::{crosscheck, json};
use crate::study::Campaign;
use crate::study::yield_force::{Judgement, plan};
use clap::Args;
use std::path::PathBuf;

/// Number of stacks that are measured together. The memory of their runs, some 10 kB per stack, is freed before the
/// next.
const STACKS_AT_ONCE: usize = 2000;

/// Measure a yield curve: yield force against floor friction
///
/// Every point is measured and judged like a row of a crosscheck. Where theory predicts another event than
/// floor slip, nothing is run and the row gives the reason.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack sweep --code native --mu 0.1:0.5:0.05,critical --stiffness 1e2:1e4:x10 --out curve"
)]
pub(super) struct Arguments {
    /// Code that runs the stacks
    #[arg(long, alias = "codes", value_parser = CodeParser, value_name = "CODE")]
    code: Code,
    #[command(flatten)]
    stack: StackListOptions,
    #[command(flatten)]
    convention: ConventionOptions,
    /// Directory for sweep.csv and sweep.json
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Let the wall approach the yield up to ten times faster and stop after it; for each row, one run without
    /// shortcuts measures what this changes. Only native supports shortcuts
    #[arg(long)]
    shortcuts: bool,
    #[command(flatten)]
    rows: RowOptions,
    #[command(flatten)]
    run: RunOptions,
    /// Format of the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Returns `judgement` without its runs and their cases, which are not printed and would fill the memory.
fn without_runs(mut judgement: Judgement) -> Judgement {
    judgement.study.cases = Vec::new();
    if let Some(finding) = &mut judgement.finding {
        finding.runs = Vec::new();
    }
    judgement
}

/// Measures the curve, prints and writes its rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let bodies = arguments.stack.bodies();
    arguments.code.check_compresses(bodies)?;
    let code = settle_one(&arguments.code, &arguments.run)?;
    let convention = arguments.convention.of(&code, bodies)?;
    let accepted = arguments.code.check_shortcuts(arguments.shortcuts);
    accepted.map_err(as_flag)?;
    let codes = selected_codes(std::slice::from_ref(&arguments.code))?;
    let stacks = arguments.stack.stacks(convention.law.power)?;
    for stack in &stacks {
        let accepted = arguments.code.check_stiffness_ratio(stack.stiffness_ratio);
        accepted.map_err(as_flag)?;
    }
    let layout = Layout::tables("sweep.json", &["sweep.csv"]);
    let out = Out::claim(arguments.out.as_deref(), &layout)?;
    let settings = arguments.run.settings()?;
    let planned = |stack: &Stack| {
        let measurement = plan(&code, stack, convention);
        match arguments.shortcuts {
            true => measurement.shortened(),
            false => measurement,
        }
    };
    let progress = Reporter::new();
    let campaign = Campaign::new(&codes, &settings, &progress);
    let parts = stacks.chunks(STACKS_AT_ONCE);
    let judgements: Vec<Judgement> = parts
        .take_while(|_| !INTERRUPT.requested())
        .flat_map(|stacks| campaign.carry_out(stacks.iter().map(planned).collect()))
        .map(without_runs)
        .collect();
    drop(progress);
    let tables = [crosscheck(&judgements)];
    let rows = &arguments.rows;
    let printed = rows.print(&judgements, arguments.format, command);
    let is_whole = judgements.len() == stacks.len();
    let tested = rows.write_junit(&judgements, is_whole);
    let written = out.write_whole(is_whole, || {
        vec![
            ("sweep.csv", tables[0].csv()),
            ("sweep.json", json(&tables, command)),
        ]
    });
    let found = conclude(&judgements, stacks.len(), &codes);
    Ok(found.max(printed).max(tested).max(written))
}
