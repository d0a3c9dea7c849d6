//! Runs the cases of all workloads on all cores and keeps each result at once.

mod executor;
mod requests;
mod store_writer;

use super::recorded::{Recorded, RecordedError};
use crate::code::{Code, Failure, InstalledCode, Interrupt, Run};
use crate::model::Case;
use crate::runs::Store;
use executor::Executor;
use requests::{hand_out, requests};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// How runs are carried out.
pub struct Settings<'a> {
    /// The store of finished runs.
    pub store: Store,
    /// The runs that stand in for codes that are not installed.
    pub recorded: Recorded,
    /// Whether to ignore stored runs.
    pub fresh: bool,
    /// Runs at the same time.
    pub threads: usize,
    /// Longest time without a finished case; the codes' own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Stops all runs when requested.
    pub interrupt: &'a Interrupt,
}

/// A code selected for a study, installed or not.
pub struct SelectedCode {
    /// Its name.
    pub name: Code,
    /// The installed code; recorded runs stand in where it is absent.
    pub code: Option<Box<dyn InstalledCode>>,
}

impl SelectedCode {
    /// The code `name` as it is installed here.
    pub fn find(name: Code) -> Self {
        Self {
            name,
            code: name.find(),
        }
    }
}

/// The reason why a run is not available.
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

/// Receives progress.
pub trait Progress: Sync {
    /// `total` runs are needed, `reused` of which exist; the others will take about `seconds` of all cores together.
    fn planned(&self, total: usize, reused: usize, seconds: f64);
    /// Work of so many of these seconds is done.
    fn advanced(&self, seconds: f64);
    /// One run has ended.
    fn finished(&self, code: Code, case: &Case, result: Result<&Run, &Failure>);
    /// A problem that does not affect the results.
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

/// Carries out `workloads` and returns, case by case, the result of `keep` for each run. The runs themselves are
/// dropped at once, so that memory does not grow with their number.
pub(crate) fn run_all<T: Clone + Send>(
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
