//! `tristack sweep`.

use super::convention::settle_one;
use super::crosscheck::conclude;
use super::options::{
    CodeParser, ConventionOptions, Format, Friction, RunOptions, StackListOptions, as_flag,
    friction, selected_codes,
};
use super::out::Out;
use super::progress::Reporter;
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
use crate::files::Layout;
use crate::model::Stack;
use crate::output::{crosscheck, crosscheck_text, json};
use crate::study::Campaign;
use crate::study::yield_force::{Judgement, plan};
use clap::Args;
use std::path::PathBuf;

const MOST_FRICTIONS: f64 = 1e4;
/// Stacks that are measured together. The memory of their runs, some 10 kB per stack, is freed before the next.
const STACKS_AT_ONCE: usize = 2000;

/// Measure a yield curve: yield force against floor friction
///
/// Every point is measured and judged like a row of a crosscheck. Where theory predicts another event than
/// floor slip, nothing is run and the row gives the reason.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack sweep --code native --mu 0.1:0.5:0.05 --stiffness 1e2,1e3 --out curve"
)]
pub(super) struct Arguments {
    /// Code that runs the stacks
    #[arg(long, value_parser = CodeParser, value_name = "CODE")]
    code: Code,
    /// Floor frictions from A to B in steps, or a single one
    #[arg(long, value_name = "A:B:STEP", value_parser = Frictions::parse, allow_negative_numbers = true)]
    mu: Frictions,
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
    run: RunOptions,
    /// Format of the rows
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// The values of `--mu`.
#[derive(Debug, Clone, PartialEq)]
struct Frictions(Vec<Friction>);

impl Frictions {
    /// A, A + STEP, … up to B, which is included if it lies on the grid.
    fn parse(text: &str) -> Result<Self, String> {
        let accepted = "accepted are A:B:STEP with A <= B and STEP > 0, at most 10000 values, \
                        a number above 0, and the word `critical`";
        let parts: Vec<&str> = text.split(':').collect();
        let [from, to, step] = parts[..] else {
            return friction(text)
                .map(|value| Self(vec![value]))
                .map_err(|_| accepted.to_owned());
        };
        let number = |part: &str| part.parse::<f64>().map_err(|_| accepted.to_owned());
        let (from, to, step) = (number(from)?, number(to)?, number(step)?);
        // As far as the ends and the step are known.
        let last_digits = 1e-9_f64.max(f64::EPSILON * (from.abs() + to.abs()) / step);
        let count = ((to - from) / step + last_digits).floor();
        if !(step > 0.0 && (0.0..MOST_FRICTIONS).contains(&count)) {
            return Err(accepted.to_owned());
        }
        let further = (1..=count as u32).map(|index| rounded(from + step * f64::from(index), step));
        let values: Vec<f64> = std::iter::once(from).chain(further).collect();
        match values.is_sorted_by(|left, right| left < right) {
            true => Ok(Self(values.into_iter().map(Friction::Number).collect())),
            false => Err(format!(
                "{accepted}; numbers near {to} do not differ by {step:e}"
            )),
        }
    }
}

/// `value` to twelve decimals, or to as many as `step` has, without round-off from the multiplication by the step
/// (0.1 + 2 × 0.1 is not 0.3).
fn rounded(value: f64, step: f64) -> f64 {
    const DECIMALS: f64 = 12.0;
    let needed = 1.0 - libm::floor(libm::log10(step));
    if needed <= DECIMALS {
        return (value * 1e12).round() / 1e12;
    }
    let text = format!("{value:.*}", needed.min(30.0) as usize);
    text.parse().unwrap_or(value)
}

/// `judgement` without its runs and their cases, which are not printed and would fill the memory.
fn without_runs(mut judgement: Judgement) -> Judgement {
    judgement.study.cases = Vec::new();
    if let Some(finding) = &mut judgement.finding {
        finding.runs = Vec::new();
    }
    judgement
}

/// Measures the curve, prints and writes its rows.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    settle_one(arguments.code, &arguments.run)?;
    let convention = arguments.convention.of(arguments.code)?;
    let accepted = arguments.code.check_shortcuts(arguments.shortcuts);
    accepted.map_err(as_flag)?;
    let codes = selected_codes(&[arguments.code])?;
    let stacks = arguments
        .stack
        .stacks(&arguments.mu.0, convention.law.power)?;
    for stack in &stacks {
        let accepted = arguments.code.check_stiffness_ratio(stack.stiffness_ratio);
        accepted.map_err(as_flag)?;
    }
    let layout = Layout::tables("sweep.json", &["sweep.csv"]);
    let out = Out::claim(arguments.out.as_deref(), &layout)?;
    let settings = arguments.run.settings()?;
    let planned = |stack: &Stack| {
        let measurement = plan(arguments.code, stack, convention);
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
    let people = || crosscheck_text(&judgements);
    let printed = arguments.format.print(&tables, command, people);
    let written = out.write(|| {
        vec![
            ("sweep.csv", tables[0].csv()),
            ("sweep.json", json(&tables, command)),
        ]
    });
    let found = conclude(&judgements, stacks.len(), &codes);
    Ok(found.max(printed).max(written))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(frictions: &Frictions) -> Vec<f64> {
        let frictions = frictions.0.iter();
        frictions.map(|friction| friction.of_cylinders()).collect()
    }

    #[test]
    fn values_of_a_range_are_different_or_refused() {
        let values = Frictions::parse("0.3:0.30000000000003:1e-14").unwrap();
        assert_eq!(
            numbers(&values),
            [0.3, 0.30000000000001, 0.30000000000002, 0.30000000000003]
        );
        for text in [
            "0.3:0.3000000000000003:1e-17",
            "0.3:0.3000000000000006:4e-17",
        ] {
            let message = Frictions::parse(text).unwrap_err();
            assert!(message.contains("A:B:STEP"), "{text}: {message}");
        }
    }

    #[test]
    fn a_range_includes_both_ends_without_rounding_debris() {
        let values = Frictions::parse("0.1:0.5:0.1").unwrap();
        assert_eq!(numbers(&values), [0.1, 0.2, 0.3, 0.4, 0.5]);
    }

    #[test]
    fn a_single_friction_is_a_sweep_of_one() {
        assert_eq!(numbers(&Frictions::parse("0.3").unwrap()), [0.3]);
    }

    #[test]
    fn ranges_that_never_end_or_go_backwards_are_refused() {
        for text in [
            "0.1:0.5:0",
            "0.5:0.1:0.1",
            "0.1:0.5:-0.1",
            "0:1e9:1e-9",
            "a:b:c",
            "1:2",
            "nan:1:1",
        ] {
            assert!(Frictions::parse(text).is_err(), "{text}");
        }
    }
}
