//! `tristack guard`: how tristack starts foreign programs, not something to type.

use super::tell;
use crate::code::{end_like, guard};
use clap::Args;
use std::ffi::OsString;

/// What shells return for a program that cannot be started.
const CANNOT_START: i32 = 127;

/// Run a program until it ends or standard input is closed, and end all that it started
#[derive(Debug, Args)]
pub struct Arguments {
    /// Without a network but a loopback of its own
    #[arg(long)]
    offline: bool,
    /// The program and its arguments
    #[arg(required = true, last = true)]
    command: Vec<OsString>,
}

/// Runs the program and ends like it.
pub fn run(arguments: &Arguments) -> ! {
    let code = match guard(&arguments.command, arguments.offline) {
        Ok(status) => end_like(status),
        Err(error) => {
            let program = arguments.command[0].display();
            tell!("cannot start {program}: {error}");
            CANNOT_START
        }
    };
    std::process::exit(code)
}
