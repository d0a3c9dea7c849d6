//! Native runs that are under way, on disk, so that an interruption loses little.

use crate::archive::write_atomically;
use crate::dem::Checkpoint;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time between two checkpoints of a run.
pub(super) const CHECKPOINT_INTERVAL: Duration = Duration::from_secs(20);

/// A run that is under way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Unfinished {
    /// What it has taken so far.
    pub(super) seconds: f64,
    /// How far it is.
    pub(super) checkpoint: Checkpoint,
}

/// The unfinished runs below a directory, by the address that each will have when it is finished.
pub(super) struct Checkpoints<'a> {
    directory: &'a Path,
}

impl<'a> Checkpoints<'a> {
    pub(super) fn new(directory: &'a Path) -> Self {
        Self { directory }
    }

    /// A run that cannot be kept goes on all the same: it only has more to lose.
    pub(super) fn keep(&self, address: &str, run: &Unfinished) {
        let content = serde_json::to_vec(run).expect("plain data has a JSON form");
        let _ = std::fs::create_dir_all(self.directory)
            .map_err(|_| ())
            .and_then(|()| write_atomically(&self.path(address), &content).map_err(|_| ()));
    }

    /// The run under `address`, if it was kept; one that cannot be read starts anew.
    pub(super) fn take_up(&self, address: &str) -> Option<Unfinished> {
        let content = std::fs::read(self.path(address)).ok()?;
        serde_json::from_slice(&content).ok()
    }

    pub(super) fn drop(&self, address: &str) {
        let _ = std::fs::remove_file(self.path(address));
    }

    fn path(&self, address: &str) -> PathBuf {
        self.directory.join(format!("{address}.json"))
    }
}
