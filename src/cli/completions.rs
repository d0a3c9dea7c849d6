//! `tristack completions`.

use super::{CliError, ExitStatus, print, public_grammar};
use clap::Args;
use clap_complete::{Shell, generate};

/// Print the completions of commands, options and values for a shell
#[derive(Debug, Args)]
#[command(
    after_help = "Examples: tristack completions bash >~/.local/share/bash-completion/completions/tristack\n          \
    tristack completions zsh >_tristack        # in a directory of $fpath\n          \
    tristack completions fish >~/.config/fish/completions/tristack.fish"
)]
pub(super) struct Arguments {
    /// Shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script.
pub(super) fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    let mut script = Vec::new();
    generate(
        arguments.shell,
        &mut public_grammar(),
        "tristack",
        &mut script,
    );
    Ok(print(&String::from_utf8_lossy(&script)))
}
