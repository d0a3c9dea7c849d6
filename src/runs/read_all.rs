//! Runs carried out and read, live or recorded.

use super::schedule::{Progress, RunError, SelectedCode, Settings, Workload, run_all};
use crate::code::Code;
use crate::model::Case;
use crate::runs::RunSummary;

/// Carries out the cases of all workloads and reads every run. Where a code is not installed and the
/// series of a run is not recorded, its recorded summary stands in.
pub fn read_all<W: Workload>(
    workloads: &[W],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Vec<Result<RunSummary, RunError>>> {
    let mut results = run_all(workloads, codes, settings, progress, RunSummary::new);
    for (workload, results) in workloads.iter().zip(&mut results) {
        let code = workload.code();
        for (case, result) in workload.cases().iter().zip(results) {
            if result.as_ref().is_err_and(RunError::is_unrecorded) {
                let summary = settings.recorded.summary(code, case);
                *result = summary.map_err(RunError::from);
            }
        }
    }
    results
}

/// Cases that one code is to run, and nothing more.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Who runs them.
    pub code: Code,
    /// The cases.
    pub cases: Vec<Case>,
}

impl Workload for Load {
    fn code(&self) -> Code {
        self.code
    }

    fn cases(&self) -> &[Case] {
        &self.cases
    }
}
