//! Runs of a plan in `away` on a bench, whose code computes as the native one does.

use super::Bench;
use std::path::PathBuf;
use tristack::code::{PlannedRun, PlannedTask};
use tristack::dem::{compress_stack, run_contact_test};

/// What the native code gives for a planned run, as CSV.
pub fn native_result(run: &PlannedRun) -> Vec<u8> {
    match &run.task {
        PlannedTask::Stack(case) => compress_stack(case, || true).expect("finite").to_csv(),
        PlannedTask::Motion(test) => run_contact_test(test).expect("finite").to_csv(),
    }
}

/// Where its result is expected.
pub fn result_of(bench: &Bench, run: &PlannedRun) -> PathBuf {
    bench.path("away").join(&run.directory).join(&run.result)
}
