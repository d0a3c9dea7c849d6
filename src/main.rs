//! Runs the command line and turns its end into an exit status.

use std::process::ExitCode;
use tristack::{cli, engine};

fn main() -> ExitCode {
    engine::guard_foreign_programs();
    let status = cli::run(std::env::args_os()).unwrap_or_else(|error| {
        eprintln!("error: {error}");
        error.status()
    });
    ExitCode::from(status.code())
}
