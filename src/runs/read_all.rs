//! Runs carried out and read, live or recorded.

use super::schedule::{Progress, RunError, SelectedCode, Settings, Workload, run_all};
use crate::code::Code;
use crate::model::Case;
use crate::runs::RunSummary;
use std::collections::HashMap;

/// Carries out the cases of all workloads and reads every run. Where an code is not installed and the
/// series of a run is not recorded, its recorded summary stands in.
pub fn read_all<W: Workload>(
    workloads: &[W],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Vec<Result<RunSummary, RunError>>> {
    let mut results = run_all(workloads, codes, settings, progress, RunSummary::new);
    let mut recorded = HashMap::new();
    for (workload, results) in workloads.iter().zip(&mut results) {
        let code = workload.code();
        for (case, result) in workload.cases().iter().zip(results) {
            if !result.as_ref().is_err_and(RunError::is_unrecorded) {
                continue;
            }
            let summaries = recorded
                .entry(code)
                .or_insert_with(|| by_case(code, settings, progress));
            if let Some(summary) = summaries.get(&case.content_hash()) {
                *result = settings
                    .recorded
                    .unless_outdated(code, case, summary.clone())
                    .map_err(RunError::from);
            }
        }
    }
    results
}

/// The recorded summaries of one code, by the hash of their cases.
fn by_case(
    code: Code,
    settings: &Settings,
    progress: &dyn Progress,
) -> HashMap<String, RunSummary> {
    let summaries = settings.recorded.summaries(code).unwrap_or_else(|error| {
        progress.warn(&format!("damaged recorded summaries, not used: {error}"));
        Vec::new()
    });
    let keyed = summaries
        .into_iter()
        .map(|summary: RunSummary| (summary.case.content_hash(), summary));
    keyed.collect()
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
