//! `tristack theory`.

use super::options::{ConventionOptions, Format, StackListOptions};
use super::{CliError, ExitStatus, INTERRUPT};
use crate::code::Code;
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
    /// Format of the result
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints the predictions for every combination of friction and stiffness.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let convention = arguments
        .convention
        .of(Code::NATIVE, arguments.stack.bodies())?;
    let stacks = arguments.stack.stacks(convention.law.power)?;
    let predictions: Vec<Predictions> = Predictions::of_each(&stacks, &convention)
        .take_while(|_| !INTERRUPT.requested())
        .collect();
    let people = || theories_by_stack(&predictions);
    let tables = [theory(&predictions)];
    let printed = arguments.format.print(&tables, command, people);
    Ok(match predictions.len() == stacks.len() {
        true => printed,
        false => ExitStatus::Interrupted,
    })
}
