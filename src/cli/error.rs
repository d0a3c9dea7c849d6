//! How a command ends.

use crate::archive::ArchiveError;
use crate::bench::BenchError;
use crate::claims::RegisterError;
use crate::crosscheck::{Judgement, NoYield};
use crate::engine::{EngineName, Failure, FailureKind};
use crate::report::PdfError;
use crate::reproduction::ReproductionError;
use crate::stack::{CaseError, InvalidValue, shown};
use crate::store::StoreError;
use crate::verdict::Verdict;
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
    /// An engine failed, timed out or is missing.
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
            .map(|judgement| match judgement.row.verdict {
                _ if judgement.contradicted => Self::Disagreement,
                Verdict::NoYield if judgement.row.reference_force.is_none() => Self::Success,
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
    Files(#[from] ArchiveError),
    /// The store cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// An engine was asked for by name, but is not installed.
    #[error("{0} is not installed: its program is not in the search path, or does not say its version within half a minute; install it with: {hint}", hint = .0.installation_hint())]
    MissingEngine(EngineName),
    /// A run that everything else needs is not there.
    #[error(transparent)]
    Reproduction(#[from] ReproductionError),
    /// The register of claims is wrong.
    #[error(transparent)]
    Register(#[from] RegisterError),
    /// A figure cannot be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// An engine failed.
    #[error(transparent)]
    Engine(#[from] Box<Failure>),
}

/// Paths may hold anything. What a parser says of a case file has lines of its own.
fn in_one_line(error: &ArchiveError) -> String {
    match error {
        ArchiveError::Case(error) => error.to_string(),
        _ => shown(Path::new(&error.to_string())),
    }
}

impl From<BenchError> for CliError {
    fn from(error: BenchError) -> Self {
        match error {
            BenchError::Missing { engine } => Self::MissingEngine(engine),
            BenchError::Failed(failure) => Self::Engine(failure),
            BenchError::Files(error) => Self::Files(error),
        }
    }
}

impl CliError {
    /// The exit status that goes with it.
    pub fn status(&self) -> ExitStatus {
        match self {
            Self::Engine(failure) => match failure.kind {
                FailureKind::Interrupted => ExitStatus::Interrupted,
                FailureKind::Unsupported(_) => ExitStatus::WrongInput,
                _ => ExitStatus::EngineFailed,
            },
            Self::Reproduction(_) | Self::MissingEngine(_) => ExitStatus::EngineFailed,
            _ => ExitStatus::WrongInput,
        }
    }
}
