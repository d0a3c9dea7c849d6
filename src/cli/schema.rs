//! `tristack schema`.

use super::{CliError, ExitStatus, print};
use crate::output::{Document, all_json_schemas};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// Print the JSON Schema of what tristack reads and writes
#[derive(Debug, Args)]
#[command(
    after_help = "Example: tristack schema manifest >code.schema.json\n\nWithout a name, all schemas in one, under `$defs`. The \
    same with words: docs/formats.md."
)]
pub(super) struct Arguments {
    /// Kind of document
    #[arg(value_parser = documents())]
    document: Option<Document>,
}

/// Parses the name of a kind of document.
fn documents() -> impl TypedValueParser<Value = Document> {
    let values = Document::ALL.map(|one| PossibleValue::new(one.as_str()).help(one.description()));
    PossibleValuesParser::new(values).map(|name| {
        let mut all = Document::ALL.into_iter();
        all.find(|one| one.as_str() == name)
            .expect("the parser accepts names of documents alone")
    })
}

/// Prints one schema or all.
pub(super) fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let schema = match arguments.document {
        Some(document) => document.json_schema(),
        None => all_json_schemas(),
    };
    Ok(print(&format!("{schema:#}\n")))
}
