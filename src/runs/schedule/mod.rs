//! Runs the cases of all workloads on all cores, keeping each result the moment it is there.

mod executor;
mod requests;
mod store_writer;

use super::recorded::{Recorded, RecordedError};
use crate::code::Run;
use crate::code::{Code, Failure, InstalledCode, Interrupt};
use crate::model::Case;
use crate::runs::Store;
use executor::Executor;
use requests::{hand_out, requests};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// How runs are carried out.
pub struct Settings<'a> {
    /// Where finished runs are kept.
    pub store: Store,
    /// The runs that stand in for codes that are not installed.
    pub recorded: Recorded,
    /// Whether to ignore what is in the store.
    pub fresh: bool,
    /// Runs at the same time.
    pub threads: usize,
    /// Longest time without a finished case; the codes' own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
}

/// An code that takes part, installed or not.
pub struct SelectedCode {
    /// Which one.
    pub name: Code,
    /// The code itself, if it is installed.
    pub code: Option<Box<dyn InstalledCode>>,
}

impl SelectedCode {
    /// `name`, as it is installed here.
    pub fn find(name: Code) -> Self {
        Self {
            name,
            code: name.find(),
        }
    }
}

/// Why a run is not there.
#[derive(Debug, Clone, Error)]
pub enum RunError {
    /// The code failed.
    #[error(transparent)]
    Failed(Arc<Failure>),
    /// The code is not installed, and no recorded run stands in.
    #[error(transparent)]
    Missing(Arc<RecordedError>),
}

impl RunError {
    /// Whether the run was cut short by an interrupt.
    pub(crate) fn is_interrupted(&self) -> bool {
        matches!(self, Self::Failed(failure) if failure.is_interrupted())
    }

    /// Whether no recording of the run exists.
    pub(crate) fn is_unrecorded(&self) -> bool {
        matches!(self, Self::Missing(error) if matches!(**error, RecordedError::Absent { .. }))
    }
}

impl From<Failure> for RunError {
    fn from(failure: Failure) -> Self {
        Self::Failed(Arc::new(failure))
    }
}

impl From<RecordedError> for RunError {
    fn from(error: RecordedError) -> Self {
        Self::Missing(Arc::new(error))
    }
}

/// Somebody who wants to know how far it is.
pub trait Progress: Sync {
    /// `total` runs are needed, `reused` of which were there already; the others will take `seconds` of all
    /// cores together, about.
    fn planned(&self, total: usize, reused: usize, seconds: f64);
    /// What was to take so many of these seconds is done.
    fn advanced(&self, seconds: f64);
    /// One run has ended.
    fn finished(&self, code: Code, case: &Case, result: Result<&Run, &Failure>);
    /// Something went wrong that does not touch the results.
    fn warn(&self, message: &str);
}

/// Cases that one code is to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Workload {
    /// The code.
    pub code: Code,
    /// The cases.
    pub cases: Vec<Case>,
}

/// What `keep` makes of each run, case by case, of every workload. Runs themselves are not held longer
/// than that, so that memory does not grow with their number.
pub fn run_all<T: Clone + Send>(
    workloads: &[Workload],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
    keep: impl Fn(Run) -> T + Sync,
) -> Vec<Vec<Result<T, RunError>>> {
    let (requests, wanted) = requests(workloads);
    let executor = Executor::new(requests, settings, progress, keep);
    hand_out(executor.results(codes), wanted)
}
