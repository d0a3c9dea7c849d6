//! Failed runs, with everything needed to find the cause.

use super::described::Code;
use crate::files::FileError;
use crate::model::{InvalidValue, shown};
use crate::series::SeriesError;
use std::path::PathBuf;
use std::process::ExitStatus;
use std::time::Duration;
use thiserror::Error;

/// The reason why a code delivered no series.
#[derive(Debug, Error)]
#[allow(missing_docs)] // The messages say what each is.
pub enum FailureKind {
    #[error("the code cannot run the case: {0}")]
    Unsupported(InvalidValue),
    /// The run directory could not be prepared.
    #[error(transparent)]
    RunDirectory(#[from] FileError),
    #[error("cannot start the program: {0}")]
    Start(#[from] std::io::Error),
    /// The program is installed but does not work.
    #[error("{0}")]
    Broken(String),
    /// The program is no longer the one whose version and hash were taken at the start.
    #[error("{} was replaced while it was in use; start again", shown(.0))]
    Replaced(PathBuf),
    #[error("the program ended without a series: {0}")]
    Ended(ExitStatus),
    /// The guard was killed, or made to end, before what it guards.
    #[error(
        "its guard, the process that ends what a program leaves behind, was ended first; what was left was ended as well, and \
         the result is not used"
    )]
    Unguarded,
    #[error("the program delivered no series for this case and went on")]
    Skipped,
    #[error("no series after {0:?}; it was stopped (--time-limit allows more seconds)")]
    TimedOut(Duration),
    #[error("interrupted")]
    Interrupted,
    /// No other start of the same command would have enough time for it either.
    #[error("by estimate it takes {} s with its start, and {} s of --time-left are there for it; allow more, or leave --time-left out", .estimate.as_secs(), .usable.as_secs())]
    TooLong {
        estimate: Duration,
        usable: Duration,
    },
    #[error("the series is not usable: {0}")]
    Series(#[from] SeriesError),
    /// A run that is made elsewhere has no result yet.
    #[error("{} is not there yet", shown(.0))]
    Awaited(PathBuf),
    /// A run that is made elsewhere has part of a result, or the result of something other than what was planned.
    #[error("{0}")]
    NoResult(String),
    /// A result that was made elsewhere is there, but it is not what was asked for.
    #[error("the result is not usable: {0}")]
    UnusableFile(FileError),
}

/// A failed run.
#[derive(Debug, Error)]
#[error(
    "{code} failed on {subject}: {kind}{}",
    context(run_directory, last_lines)
)]
pub struct Failure {
    /// The code that failed.
    pub code: Code,
    /// The task, in words.
    pub subject: String,
    /// The reason.
    pub kind: FailureKind,
    /// Directory with the deck and the captured output.
    pub run_directory: Option<PathBuf>,
    /// The end of the program's output.
    pub last_lines: Vec<String>,
}

impl Failure {
    /// The failure of `code` on `subject` outside any run directory.
    pub fn new(code: Code, subject: &impl ToString, kind: FailureKind) -> Self {
        Self {
            code,
            subject: subject.to_string(),
            kind,
            run_directory: None,
            last_lines: Vec::new(),
        }
    }

    /// Whether the run directory holds output that helps to find the cause.
    pub fn left_evidence(&self) -> bool {
        self.run_directory.is_some() && !self.is_interrupted()
    }

    /// Whether nothing has failed: a run that is made elsewhere has no result yet.
    pub(crate) fn is_absence(&self) -> bool {
        matches!(
            self.kind,
            FailureKind::Awaited(_) | FailureKind::NoResult(_)
        )
    }

    /// Whether an interrupt is the only cause.
    pub fn is_interrupted(&self) -> bool {
        matches!(self.kind, FailureKind::Interrupted)
    }
}

fn context(run_directory: &Option<PathBuf>, last_lines: &[String]) -> String {
    let mut text = String::new();
    if let Some(directory) = run_directory {
        text += &format!("\n  run directory: {}", shown(directory));
    }
    for line in last_lines {
        text += &format!("\n  | {line}");
    }
    text
}
