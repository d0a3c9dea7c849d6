//! `tristack man`.

use super::out::Out;
use super::{CliError, ExitStatus, print, public_grammar};
use crate::files::Layout;
use crate::model::InvalidValue;
use clap::{Args, Command};
use clap_mangen::Man;
use std::path::PathBuf;

/// The page of the program itself, which marks a directory of pages as ours.
const FIRST: &str = "tristack.1";

/// Print the manual page of a command, or write those of all commands
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack man crosscheck | man -l -\n          \
    tristack man --out pages && cp pages/*.1 ~/.local/share/man/man1/"
)]
pub(super) struct Arguments {
    /// Command, such as `crosscheck` or `store prune` [default: tristack itself]
    #[arg(value_name = "COMMAND")]
    command: Vec<String>,
    /// Directory for the pages of all commands
    #[arg(long, value_name = "DIR", conflicts_with = "command")]
    out: Option<PathBuf>,
}

/// Prints one page, or writes all.
pub(super) fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut grammar = public_grammar().disable_help_subcommand(true);
    grammar.build();
    if let Some(directory) = &arguments.out {
        let out = Out::claim(Some(directory), &layout())?;
        return Ok(out.write(|| pages(&grammar)));
    }
    let mut command = &grammar;
    for word in &arguments.command {
        let found = command.find_subcommand(word);
        command = found.ok_or_else(|| unknown(word, command))?;
    }
    Ok(print(&page(command).1))
}

/// Returns the pages of `command` and of all commands below it, each with its file name.
fn pages(command: &Command) -> Vec<(String, String)> {
    let below = command.get_subcommands().flat_map(pages);
    std::iter::once(page(command)).chain(below).collect()
}

fn page(command: &Command) -> (String, String) {
    let man = Man::new(command.clone());
    let mut text = Vec::new();
    man.render(&mut text).expect("memory takes all");
    let text = String::from_utf8_lossy(&text).into_owned();
    (man.get_filename(), text)
}

fn layout() -> Layout {
    Layout {
        is_ours: |content| String::from_utf8_lossy(content).contains(".TH tristack 1"),
        ..Layout::tables(FIRST, &["tristack-*.1"])
    }
}

fn unknown(word: &str, command: &Command) -> InvalidValue {
    let names = command.get_subcommands().map(Command::get_name);
    let names: Vec<&str> = names.collect();
    let accepted = match names.is_empty() {
        true => format!("nothing: {} has no commands of its own", command.get_name()),
        false => names.join(", "),
    };
    InvalidValue {
        key: "COMMAND".to_owned(),
        value: word.to_owned(),
        accepted,
    }
}
