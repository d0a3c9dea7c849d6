//! The exit status and the errors of a command.

use super::INTERRUPT;
use crate::code::{Code, Failure, FailureKind, ManifestError};
use crate::files::FileError;
use crate::model::{CaseError, InvalidValue, shown};
use crate::paper::claims::RegisterError;
use crate::paper::reproduction::ReproductionError;
use crate::runs::StoreError;
use crate::study::Verdict;
use crate::study::cost::BenchError;
use crate::study::yield_force::{Judgement, NoYield};
use std::path::Path;
use thiserror::Error;

/// The exit status of the program, from best to worst; the worst of several rows counts. A disagreement that was
/// found is worse than a code that failed, which shows nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitStatus {
    /// All rows agree, or there was nothing to judge.
    Success,
    /// An uncertainty is larger than its tolerance, and nothing is worse.
    Inconclusive,
    /// A result could not be written, and no run is worse than inconclusive.
    NotWritten,
    /// A code failed, timed out or is missing.
    CodeFailed,
    /// A disagreement was found.
    Disagreement,
    /// The command line or an input is wrong.
    WrongInput,
    /// The user interrupted the program, or its time was up.
    Interrupted,
}

impl ExitStatus {
    /// Returns the number given to the shell.
    pub fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::WrongInput => 1,
            Self::Disagreement => 2,
            Self::CodeFailed => 3,
            Self::Inconclusive => 4,
            Self::NotWritten => 5,
            Self::Interrupted if INTERRUPT.is_for_time() => 6,
            Self::Interrupted => 130,
        }
    }

    /// Returns the worst status of the rows.
    pub(super) fn of(judgements: &[Judgement]) -> Self {
        let each = judgements.iter().map(Self::of_row);
        each.max().unwrap_or(Self::Success)
    }

    /// Returns the status of one row. A stack that does not yield where theory expects no yield is not a
    /// disagreement.
    pub(super) fn of_row(judgement: &Judgement) -> Self {
        match judgement.verdict() {
            _ if judgement.passes() => Self::Success,
            _ if judgement.grounds.is_contradicted() => Self::Disagreement,
            verdict => Self::of_verdict(verdict),
        }
    }

    /// Returns the status for one verdict, where a yield was expected.
    pub(super) fn of_verdict(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Agrees => Self::Success,
            Verdict::NoYield | Verdict::Differs => Self::Disagreement,
            Verdict::Inconclusive => Self::Inconclusive,
            Verdict::Failed | Verdict::Missing => Self::CodeFailed,
        }
    }
}

/// The reason why a command stopped.
#[derive(Debug, Error)]
pub enum CliError {
    /// The value of a flag is not accepted.
    #[error(transparent)]
    Invalid(#[from] InvalidValue),
    /// The stack does not yield.
    #[error(transparent)]
    NoYield(#[from] Box<NoYield>),
    /// The case file is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The folder of a code is wrong.
    #[error(transparent)]
    Manifest(#[from] ManifestError),
    /// A file cannot be written or read.
    #[error("{}", in_one_line(.0))]
    Files(#[from] FileError),
    /// The store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A code that was named is not installed.
    #[error("{0} is not installed: {why}", why = .0.absence())]
    MissingCode(Code),
    /// A run that the whole report depends on failed.
    #[error(transparent)]
    Reproduction(#[from] ReproductionError),
    /// The register of claims is wrong.
    #[error(transparent)]
    Register(#[from] RegisterError),
    /// The user or the time limit interrupted the micro-tests on which everything else depends.
    #[error(
        "interrupted while conventions that manifests leave out were being measured; what is finished is kept, and the same \
         command goes on from here"
    )]
    Interrupted,
    /// A code failed.
    #[error(transparent)]
    CodeFailed(#[from] Box<Failure>),
}

/// Escapes control characters in the message, since paths may hold any. The message of a case file stays as it is: it
/// has several lines on purpose.
fn in_one_line(error: &FileError) -> String {
    match error {
        FileError::Case(error) => error.to_string(),
        _ => shown(Path::new(&error.to_string())),
    }
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        match error {
            BenchError::Missing { code } => Self::MissingCode(code),
            BenchError::Failed(failure) => Self::CodeFailed(failure),
            BenchError::Files(error) => Self::Files(error),
        }
    }
}

impl CliError {
    /// Returns the exit status of a command that stops with this error.
    pub fn status(&self) -> ExitStatus {
        match self {
            Self::CodeFailed(failure) => match failure.kind {
                FailureKind::Interrupted => ExitStatus::Interrupted,
                FailureKind::Unsupported(_) => ExitStatus::WrongInput,
                FailureKind::RunDirectory(ref error) if error.is_full() => ExitStatus::NotWritten,
                _ => ExitStatus::CodeFailed,
            },
            Self::Interrupted => ExitStatus::Interrupted,
            Self::Files(error) if error.is_full() => ExitStatus::NotWritten,
            Self::Reproduction(_) | Self::MissingCode(_) => ExitStatus::CodeFailed,
            _ => ExitStatus::WrongInput,
        }
    }
}
