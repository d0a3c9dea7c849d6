//! `tristack codes`.

use super::options::Format;
use super::{CliError, ExitStatus};
use crate::code::Code;
use crate::output::{Inventory, inventory_csv, inventory_json, inventory_table};
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
pub fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let inventory = Code::all().into_iter().map(Inventory::take);
    let inventory: Vec<Inventory> = inventory.collect();
    super::print(&match arguments.format {
        Format::Table => inventory_table(&inventory).into_bytes(),
        Format::Json => inventory_json(&inventory).into_bytes(),
        Format::Csv => inventory_csv(&inventory),
    })
}
