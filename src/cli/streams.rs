//! Results on standard output, messages on standard error.

use super::ExitStatus;
use crate::study::Grounds;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether standard error is left to errors and warnings.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves standard error to errors and warnings, as --quiet asks.
pub(super) fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

/// Returns whether standard error is left to errors and warnings.
pub(super) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}

/// Writes an error or a warning as a line to standard error. A failure to write, as to a closed pipe, is ignored.
macro_rules! complain {
    ($($message:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($message)*);
    }};
}

/// Writes a note as a line to standard error, unless --quiet is given.
macro_rules! tell {
    ($($message:tt)*) => {{
        if !$crate::cli::streams::is_quiet() {
            $crate::cli::complain!($($message)*);
        }
    }};
}

pub(crate) use {complain, tell};

/// Writes results to standard output. A closed pipe is not an error; any other failure is reported.
pub(crate) fn print(text: &str) -> ExitStatus {
    let mut output = std::io::stdout().lock();
    let written = output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush());
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            complain!("error: cannot write standard output: {error}");
            ExitStatus::NotWritten
        }
        _ => ExitStatus::Success,
    }
}

/// Prints what decides about a row on standard error: the verdict with the first note, and the others below it.
pub(crate) fn tell_grounds(grounds: &Grounds, row: &str) {
    let notes = grounds.notes();
    let Some((headline, others)) = notes.split_first() else {
        return;
    };
    tell!("{}: {row}: {headline}", grounds.in_words());
    for note in others {
        tell!("  {note}");
    }
}
