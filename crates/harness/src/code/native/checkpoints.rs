//! Checkpoints of unfinished native runs on disk, so that an interruption loses little.

use crate::code::RunContext;
use crate::dem::Checkpoint;
use crate::files::{read_sealed, write_sealed};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::time::Duration;

/// Time between two checkpoints of a run.
pub(super) const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(20);

/// An unfinished run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Unfinished {
    /// Its run time so far.
    pub(super) seconds: f64,
    /// Its state.
    pub(super) checkpoint: Checkpoint,
}

/// Writes a checkpoint under the `address` of the finished run; the store removes it when the run is finished. If
/// writing fails, the run goes on without it.
pub(super) fn keep(context: &RunContext, address: &str, run: &Unfinished) {
    if let Some(path) = path(context, address) {
        let content = serde_json::to_vec(run).expect("plain data has a JSON form");
        let _ = write_sealed(context.directory, &path, &content);
    }
}

/// Reads the checkpoint under `address`, if there is a readable one and the run is not to begin anew.
pub(super) fn take_up(context: &RunContext, address: &str) -> Option<Unfinished> {
    if context.fresh {
        return None;
    }
    let content = read_sealed(&path(context, address)?).ok()??;
    serde_json::from_slice(&content).ok()
}

fn path(context: &RunContext, address: &str) -> Option<PathBuf> {
    let directory = context.checkpoints?;
    Some(directory.join(format!("{address}.json")))
}
