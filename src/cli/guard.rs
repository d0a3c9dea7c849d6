//! `tristack guard`: the wrapper in which tristack starts external codes; hidden from users.

use super::complain;
use crate::code::{end_like, guard};
use clap::Args;
use std::ffi::OsString;

/// Exit status of shells for a program that cannot be started.
const CANNOT_START: i32 = 127;

/// Run a program until it ends or standard input is closed, and kill all its child processes
#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Run it without a network, apart from a loopback interface of its own
    #[arg(long)]
    offline: bool,
    /// The program and its arguments
    #[arg(required = true, last = true)]
    command: Vec<OsString>,
}

/// Runs the program and ends with its exit status.
pub(super) fn run(arguments: &Arguments) -> ! {
    let code = match guard(&arguments.command, arguments.offline) {
        Ok(status) => end_like(status),
        Err(error) => {
            let program = arguments.command[0].display();
            complain!("cannot start {program}: {error}");
            CANNOT_START
        }
    };
    std::process::exit(code)
}
