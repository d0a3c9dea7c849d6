//! `tristack theory`.

use super::options::{ConventionOptions, Format, StackListOptions, positive};
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::SettledCode;
use crate::model::{InvalidValue, Problem};
use crate::output::{theories_by_stack, theory};
use crate::theory::Predictions;
use clap::Args;

/// Yield force by every theory
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack theory --mu 0.3 --stiffness 1e4 --pair-arm -0.5 --floor-arm -0.5"
)]
pub(super) struct Arguments {
    #[command(flatten)]
    stack: StackListOptions,
    #[command(flatten)]
    convention: ConventionOptions,
    /// Wall speed in r sqrt(k_n/m): adds the peak that a DEM has at it, to first order
    #[arg(long, value_name = "V", value_parser = positive)]
    speed: Option<f64>,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints the predictions for every combination of friction and stiffness.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let convention = arguments
        .convention
        .of(&SettledCode::native(), arguments.stack.bodies())?;
    let stacks = arguments.stack.stacks(convention.law.power)?;
    let problem = |stack| Problem::new(stack, convention);
    let problems: Result<Vec<Problem>, InvalidValue> = stacks.into_iter().map(problem).collect();
    let problems = problems?;
    let predictions: Vec<Predictions> = Predictions::of_each(&problems)
        .map(|own| match arguments.speed {
            Some(speed) => own.at_speed(speed),
            None => own,
        })
        .take_while(|_| !INTERRUPT.requested())
        .collect();
    let people = || theories_by_stack(&predictions);
    let tables = [theory(&predictions)];
    let printed = arguments.format.print(&tables, command, people);
    Ok(match predictions.len() == problems.len() {
        true => printed,
        false => ExitStatus::Interrupted,
    })
}
