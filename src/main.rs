//! Runs the command line and returns its exit status.

use std::io::Write;
use std::process::ExitCode;
use tristack::{cli, code};

fn main() -> ExitCode {
    code::guard_foreign_programs(|warning| {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    });
    let status = cli::run(std::env::args_os()).unwrap_or_else(|error| {
        // Standard error may be closed.
        let _ = writeln!(std::io::stderr(), "error: {error}");
        error.status()
    });
    ExitCode::from(status.code())
}
