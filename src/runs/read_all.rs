//! Carries out runs and reads each at once.

use super::schedule::{Progress, RunError, SelectedCode, Settings, Workload, run_all};
use super::summary::RunSummary;
use crate::code::{Identity, Run};

/// The part of a run that a study keeps. Whole runs are dropped as soon as they are read, so that memory does not grow
/// with their number.
pub trait Reading: Clone + Send {
    /// Reads `run`.
    fn of_run(run: Run) -> Self;

    /// The same from a recorded summary, where the series itself is not recorded; `None` if it needs the series.
    fn of_summary(summary: RunSummary) -> Option<Self>;

    /// The program that made the run.
    fn identity(&self) -> &Identity;
}

impl Reading for RunSummary {
    fn of_run(run: Run) -> Self {
        Self::new(run)
    }

    fn of_summary(summary: RunSummary) -> Option<Self> {
        Some(summary)
    }

    fn identity(&self) -> &Identity {
        &self.provenance.identity
    }
}

/// Carries out the cases of all workloads and reads every run. Where a code is not installed and the series of
/// a run is not recorded, its recorded summary stands in.
pub(crate) fn read_all<R: Reading>(
    workloads: &[Workload],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Vec<Result<R, RunError>>> {
    let mut results = run_all(workloads, codes, settings, progress, R::of_run);
    for (workload, results) in workloads.iter().zip(&mut results) {
        let code = workload.code;
        for (case, result) in workload.cases.iter().zip(results) {
            if !result.as_ref().is_err_and(RunError::is_unrecorded) {
                continue;
            }
            let summary = settings.recorded.summary(code, case);
            if let Some(reading) = summary.map(R::of_summary).transpose() {
                *result = reading.map_err(RunError::from);
            }
        }
    }
    results
}
