//! `tristack schema`.

use super::{CliError, ExitStatus, print};
use crate::output::{Document, all_json_schemas};
use clap::Args;

/// Print the JSON Schema of what tristack reads and writes
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack schema manifest >code.schema.json\n\nWithout a name, all schemas in one, under `$defs`. The \
    same with words: docs/formats.md."
)]
pub(super) struct Arguments {
    /// Kind of document
    #[arg(value_enum)]
    document: Option<Document>,
}

/// Prints one schema or all.
pub(super) fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let schema = match arguments.document {
        Some(document) => document.json_schema(),
        None => all_json_schemas(),
    };
    Ok(print(&format!("{schema:#}\n")))
}
