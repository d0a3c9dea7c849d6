//! How a command ends.

use crate::code::{Code, Failure, FailureKind};
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

/// The exit status of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitStatus {
    /// All agree, or there was nothing to judge.
    Success,
    /// The uncertainty is larger than the tolerance, and nothing worse.
    Inconclusive,
    /// A disagreement was found.
    Disagreement,
    /// A code failed, timed out or is missing.
    EngineFailed,
    /// Wrong usage or input.
    WrongInput,
    /// The user interrupted.
    Interrupted,
}

impl ExitStatus {
    /// The number that the shell sees.
    pub fn code(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::WrongInput => 1,
            Self::Disagreement => 2,
            Self::EngineFailed => 3,
            Self::Inconclusive => 4,
            Self::Interrupted => 130,
        }
    }

    /// The worst that the rows say. That nothing yields where the theory expects no yield is no
    /// disagreement.
    pub(super) fn of(judgements: &[Judgement]) -> Self {
        let each = judgements
            .iter()
            .map(|judgement| match judgement.verdict() {
                _ if judgement.grounds.is_contradicted() => Self::Disagreement,
                Verdict::NoYield if judgement.reference_force().is_none() => Self::Success,
                verdict => Self::of_verdict(verdict),
            });
        each.max().unwrap_or(Self::Success)
    }

    /// What a single verdict says, where a yield was expected.
    pub(super) fn of_verdict(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Agrees => Self::Success,
            Verdict::NoYield | Verdict::Differs => Self::Disagreement,
            Verdict::Inconclusive => Self::Inconclusive,
            Verdict::Failed | Verdict::Missing => Self::EngineFailed,
        }
    }
}

/// Why a command could not do what it was asked.
#[derive(Debug, Error)]
pub enum CliError {
    /// A flag has a value that is not accepted.
    #[error(transparent)]
    Invalid(#[from] InvalidValue),
    /// The stack does not yield.
    #[error(transparent)]
    NoYield(#[from] Box<NoYield>),
    /// The case file is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// Something cannot be written or read.
    #[error("{}", in_one_line(.0))]
    Files(#[from] FileError),
    /// The store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A code was asked for by name, but is not installed.
    #[error("{0} is not installed: its program is not in the search path, or does not say its version within half a minute; install it with: {hint}", hint = .0.installation_hint())]
    MissingEngine(Code),
    /// A run that everything else needs is not there.
    #[error(transparent)]
    Reproduction(#[from] ReproductionError),
    /// The register of claims is wrong.
    #[error(transparent)]
    Register(#[from] RegisterError),
    /// A code failed.
    #[error(transparent)]
    InstalledCode(#[from] Box<Failure>),
}

/// Paths may hold anything. What a parser says of a case file has lines of its own.
fn in_one_line(error: &FileError) -> String {
    match error {
        FileError::Case(error) => error.to_string(),
        _ => shown(Path::new(&error.to_string())),
    }
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        match error {
            BenchError::Missing { code } => Self::MissingEngine(code),
            BenchError::Failed(failure) => Self::InstalledCode(failure),
            BenchError::Files(error) => Self::Files(error),
        }
    }
}

impl CliError {
    /// The exit status that goes with it.
    pub fn status(&self) -> ExitStatus {
        match self {
            Self::InstalledCode(failure) => match failure.kind {
                FailureKind::Interrupted => ExitStatus::Interrupted,
                FailureKind::Unsupported(_) => ExitStatus::WrongInput,
                _ => ExitStatus::EngineFailed,
            },
            Self::Reproduction(_) | Self::MissingEngine(_) => ExitStatus::EngineFailed,
            _ => ExitStatus::WrongInput,
        }
    }
}
