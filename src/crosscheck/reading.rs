//! Runs carried out and read, live or recorded.

use super::schedule::{Participant, Progress, RunError, Settings, Workload, run_all};
use crate::archive::Reading;
use crate::engine::EngineName;
use crate::stack::Case;
use std::collections::HashMap;

/// Carries out the cases of all workloads and reads every run. Where an engine is not installed and the
/// series of a run is not recorded, its recorded reading stands in.
pub fn read_all<W: Workload>(
    workloads: &[W],
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Vec<Result<Reading, RunError>>> {
    let mut results = run_all(workloads, participants, settings, progress, Reading::new);
    let mut recorded = HashMap::new();
    for (workload, results) in workloads.iter().zip(&mut results) {
        let engine = workload.engine();
        for (case, result) in workload.cases().iter().zip(results) {
            if !result.as_ref().is_err_and(RunError::is_unrecorded) {
                continue;
            }
            let readings = recorded
                .entry(engine)
                .or_insert_with(|| by_case(engine, settings, progress));
            if let Some(reading) = readings.get(&case.content_hash()) {
                *result = settings
                    .recorded
                    .unless_outdated(engine, case, reading.clone())
                    .map_err(RunError::from);
            }
        }
    }
    results
}

/// The recorded readings of one engine, by the hash of their cases.
fn by_case(
    engine: EngineName,
    settings: &Settings,
    progress: &dyn Progress,
) -> HashMap<String, Reading> {
    let readings = settings.recorded.readings(engine).unwrap_or_else(|error| {
        progress.warn(&format!("damaged recorded readings, not used: {error}"));
        Vec::new()
    });
    let keyed = readings
        .into_iter()
        .map(|reading: Reading| (reading.case.content_hash(), reading));
    keyed.collect()
}

/// Cases that one engine is to run, and nothing more.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Who runs them.
    pub engine: EngineName,
    /// The cases.
    pub cases: Vec<Case>,
}

impl Workload for Load {
    fn engine(&self) -> EngineName {
        self.engine
    }

    fn cases(&self) -> &[Case] {
        &self.cases
    }
}
