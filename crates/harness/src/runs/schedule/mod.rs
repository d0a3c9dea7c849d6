//! Carries out the tasks of all workloads on all cores and keeps each result at once.

mod executor;
mod outlook;
mod requests;
mod store_writer;
mod task;
mod time_left;
mod waiting;

pub use outlook::{CodeOutlook, Outlook};
pub(crate) use outlook::{PlannedCall, outlook};
pub use task::ScheduledTask;

use super::recorded::{Recorded, RecordedError};
use crate::code::{Code, Failure, Identity, InstalledCode, Interrupt, Run};
use crate::files::FileError;
use crate::model::Case;
use crate::runs::Store;
use executor::Executor;
use requests::{hand_out, requests};
use std::fmt::Display;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// How runs are carried out.
pub struct Settings<'a> {
    /// The store of finished runs.
    pub store: Store,
    /// The runs that stand in for codes that are not installed.
    pub recorded: Recorded,
    /// Whether to ignore stored runs, and checkpoints of unfinished ones.
    pub fresh: bool,
    /// Number of runs at the same time.
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
    /// Finds the code `name` as it is installed here.
    pub fn find(name: Code) -> Self {
        Self {
            code: name.find(),
            name,
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
    /// The run is made elsewhere, and has no result yet.
    #[error("{}", .0.kind)]
    Absent(Arc<Failure>),
}

impl RunError {
    /// Whether the run was cut short by an interrupt.
    pub fn is_interrupted(&self) -> bool {
        matches!(self, Self::Failed(failure) if failure.is_interrupted())
    }
}

impl From<Failure> for RunError {
    fn from(failure: Failure) -> Self {
        match failure.is_absence() {
            true => Self::Absent(Arc::new(failure)),
            false => Self::Failed(Arc::new(failure)),
        }
    }
}

impl From<RecordedError> for RunError {
    fn from(error: RecordedError) -> Self {
        Self::Missing(Arc::new(error))
    }
}

/// Receives progress.
pub trait Progress: Sync {
    /// The phase of this name begins, such as "probing 6 codes"; a phase of another name has ended.
    fn begins(&self, _phase: &str) {}
    /// `total` results of the kind `name` are needed, of which `reused` exist. The others will take about `seconds`,
    /// summed over all cores.
    fn planned(&self, name: &str, total: usize, reused: usize, seconds: f64);
    /// `seconds` of the planned work are done.
    fn advanced(&self, seconds: f64);
    /// `task` has ended; a success comes with its duration in seconds if that was measured.
    fn finished(&self, code: &Code, task: &dyn Display, result: Result<Option<f64>, &Failure>);
    /// A problem that does not affect the results.
    fn warn(&self, message: &str);
}

/// Tasks that one code is to carry out.
#[derive(Debug, Clone, PartialEq)]
pub struct Workload<T = Case> {
    /// The code.
    pub code: Code,
    /// The tasks.
    pub tasks: Vec<T>,
}

/// The part of a result that a study keeps. Whole results are dropped as soon as they are read, so that memory does
/// not grow with their number.
pub trait Reading: Clone + Send {
    /// The task.
    type Task: ScheduledTask;

    /// Reads the `outcome` of a task.
    fn of(outcome: <Self::Task as ScheduledTask>::Outcome) -> Self;

    /// The program that carried the task out.
    fn identity(&self) -> &Identity;

    /// Reads the result of `task` with `code` from `store`, if there is one.
    ///
    /// # Errors
    /// If there is one but it is damaged.
    fn stored(
        task: &Self::Task,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<Self>, FileError> {
        Ok(task.stored(code, store)?.map(Self::of))
    }

    /// Reads the recorded result of `task` with `code`.
    ///
    /// # Errors
    /// If there is none, or it cannot stand in.
    fn recorded(
        task: &Self::Task,
        code: &Code,
        recorded: &Recorded,
    ) -> Result<Self, RecordedError> {
        task.recorded(code, recorded).map(Self::of)
    }
}

impl Reading for Run {
    type Task = Case;

    fn of(run: Run) -> Self {
        run
    }

    fn identity(&self) -> &Identity {
        &self.provenance.identity
    }
}

/// Carries out `workloads` and returns, task by task, the reading of each result.
pub fn read_all<R: Reading>(
    workloads: &[Workload<R::Task>],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Vec<Result<R, RunError>>> {
    if workloads.is_empty() {
        return Vec::new();
    }
    let (requests, wanted) = requests(workloads);
    let executor = Executor::<R>::new(requests, settings, progress);
    hand_out(executor.results(codes), wanted)
}
