//! `tristack codes`.

use super::options::Format;
use super::{CliError, ExitStatus};
use crate::code::Code;
use crate::output::{Inventory, inventory};
use clap::Args;

/// What is installed, in which version, with which contact convention
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack codes --format json")]
pub struct Arguments {
    /// How to print the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints every code that tristack knows.
pub fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let found = Code::all()
        .into_iter()
        .map(Inventory::take)
        .collect::<Vec<_>>();
    let tables = [inventory(&found)];
    let people = || tables[0].shown().terminal();
    super::print(&arguments.format.render(&tables, command, people))
}
