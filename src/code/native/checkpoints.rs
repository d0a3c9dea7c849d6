//! Checkpoints of unfinished native runs on disk, so that an interruption loses little.

use crate::dem::Checkpoint;
use crate::files::{seal, unseal, write_atomically_via};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
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

/// The unfinished runs below a directory, by the address that each will have when it is finished.
///
/// The store removes a checkpoint when it keeps the finished run.
pub(super) struct Checkpoints<'a> {
    directory: &'a Path,
    drafts: &'a Path,
}

impl<'a> Checkpoints<'a> {
    /// Checkpoints in `directory`; `drafts` is a directory on the same file system.
    pub(super) fn new(directory: &'a Path, drafts: &'a Path) -> Self {
        Self { directory, drafts }
    }

    /// Writes a checkpoint. If that fails, the run goes on without it.
    pub(super) fn keep(&self, address: &str, run: &Unfinished) {
        let content = serde_json::to_vec(run).expect("plain data has a JSON form");
        let _ = write_atomically_via(self.drafts, &self.path(address), &seal(&content));
    }

    /// The checkpoint under `address`, if there is a readable one.
    pub(super) fn take_up(&self, address: &str) -> Option<Unfinished> {
        let path = self.path(address);
        let sealed = std::fs::read(&path).ok()?;
        let content = unseal(&path, &sealed).ok()?;
        serde_json::from_slice(content).ok()
    }

    fn path(&self, address: &str) -> PathBuf {
        self.directory.join(format!("{address}.json"))
    }
}
