//! `tristack codes`.

use super::code_names::known_codes;
use super::options::{Format, find_all};
use super::{CliError, ExitStatus, complain};
use crate::code::Code;
use crate::output::inventory;
use clap::Args;

/// List the codes: installed or not, version, contact convention
///
/// Besides the built-in codes there are those of the folders in `tristack/codes` of the user's data directory
/// ($XDG_DATA_HOME, or ~/.local/share), each of which has a manifest, code.toml. A folder is a program: each that is installed
/// is started once, with the question for its version.
#[derive(Debug, Args)]
#[command(after_help = "Example: tristack codes --format json")]
pub(super) struct Arguments {
    /// Format of the list
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

/// Prints every known code, and fails if one that is installed, or a folder of the user, is broken.
pub(super) fn run(arguments: &Arguments, command: &str) -> Result<ExitStatus, CliError> {
    let (known, unreadable) = known_codes();
    let codes = find_all(&known);
    let tables = [inventory(&codes)];
    let people = || tables[0].shown().terminal();
    let printed = arguments.format.print(&tables, command, people);
    let broken = codes.iter().filter_map(|selected| {
        let reason = selected.code.as_ref()?.broken()?;
        Some((selected.name.clone(), reason))
    });
    let broken: Vec<(Code, &str)> = broken.collect();
    for (name, reason) in &broken {
        complain!("{name} failed: {reason}");
    }
    for error in &unreadable {
        complain!("{error}");
    }
    Ok(match broken.is_empty() && unreadable.is_empty() {
        true => printed,
        false => printed.max(ExitStatus::CodeFailed),
    })
}
