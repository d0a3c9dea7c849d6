//! `tristack codes`.

use super::options::Format;
use super::{CliError, ExitStatus};
use crate::code::Code;
use crate::output::inventory;
use clap::Args;

/// List the codes: installed or not, version, contact convention
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack codes --format json")]
pub(super) struct Arguments {
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints every known code.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let tables = [inventory(&Code::all())];
    let people = || tables[0].shown().terminal();
    Ok(arguments.format.print(&tables, command, people))
}
