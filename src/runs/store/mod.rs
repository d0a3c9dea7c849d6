//! The store of finished runs, addressed by case, code, version, program and inputs.
//!
//! Several programs may use one store at a time: each claims the runs that it is making, and takes those that
//! others have made. A damaged entry is moved to quarantine, never used and never deleted.

mod format;
mod lock;
mod session;

pub use lock::LockOwner;

use crate::code::{Identity, Run};
use crate::dem::{EventRun, Observation};
use crate::files::{FileError, create_parent, parse_json, read_sealed, write_sealed};
use crate::model::{Case, shown};
use crate::runs::ProbeRecord;
use crate::runs::entry::{read_entry, write_entry};
use serde::{Deserialize, Serialize};
use session::Session;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

// Directories of files by their addresses.
const PROBES: &str = "probes";
const OBSERVATIONS: &str = "observations";
const CHECKPOINTS: &str = "checkpoints";

/// The reason why a store cannot be used.
#[derive(Debug, Error)]
pub enum StoreError {
    #[error(transparent)]
    Files(#[from] FileError),
    #[error(
        "{}: {found}; accepted is a store with `{accepted}`: choose another directory with --store, or delete this one",
        shown(path)
    )]
    OtherFormat {
        path: PathBuf,
        found: String,
        accepted: &'static str,
    },
    #[error(
        "{}: locked by {owner}, which does not release it; continue or end that process",
        shown(path)
    )]
    Busy { path: PathBuf, owner: String },
}

/// An event run with its observation.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObservedRun {
    run: EventRun,
    observation: Observation,
}

/// The finished runs of a user.
#[derive(Debug, Clone)]
pub struct Store {
    pub(crate) session: Arc<Session>,
}

impl Store {
    /// A store at `root`, which is created.
    ///
    /// # Errors
    /// If it cannot be written to, or has another format.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        format::check(root)?;
        let session = Arc::new(Session::begin(root)?);
        Ok(Self { session })
    }

    /// The finished run of `case` by the code with `identity`, if there is one; an error if it is damaged.
    pub fn get(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<Run>, FileError> {
        let address = identity.address(case, deck_hash);
        let run = read_entry(&self.run_path(&address))?;
        let run = run.filter(|run| {
            let provenance = &run.provenance;
            let same = provenance.identity == *identity && provenance.deck_hash == deck_hash;
            same && run.case == *case
        });
        if run.is_some() {
            self.forget_checkpoint(&address);
        }
        Ok(run)
    }

    /// Keeps a finished run and removes its checkpoint.
    pub fn put(&self, run: &Run) -> Result<(), FileError> {
        let made = &run.provenance;
        let address = made.identity.address(&run.case, &made.deck_hash);
        write_entry(&self.run_path(&address), self.work_directory(), run)?;
        self.forget_checkpoint(&address);
        Ok(())
    }

    fn forget_checkpoint(&self, address: &str) {
        // Most runs have none.
        let _ = std::fs::remove_file(self.path(CHECKPOINTS, address));
    }

    /// Puts the damaged run, probe or observation under `address` into quarantine, and returns its place there.
    /// It is one of them, because an address is a digest of what it belongs to; and it may have been moved already.
    pub(crate) fn put_aside(&self, address: &str) -> Result<PathBuf, FileError> {
        let aside = self.aside(address);
        create_parent(&aside)?;
        let [probe, observation] = [PROBES, OBSERVATIONS].map(|kind| self.path(kind, address));
        for damaged in [self.run_path(address), probe, observation] {
            match std::fs::rename(damaged, &aside) {
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                renamed => renamed.map_err(FileError::writing(&aside))?,
            }
        }
        Ok(aside)
    }

    /// The kept probe with the given address, if there is one; an error if it is damaged.
    pub fn probe(&self, address: &str) -> Result<Option<ProbeRecord>, FileError> {
        let path = self.path(PROBES, address);
        let text = read_sealed(&path)?;
        text.map(|text| ProbeRecord::parse(&text, &path))
            .transpose()
    }

    /// Keeps a probe.
    pub(crate) fn put_probe(&self, address: &str, record: &ProbeRecord) -> Result<(), FileError> {
        let (path, content) = (self.path(PROBES, address), record.to_json());
        write_sealed(self.work_directory(), &path, content.as_bytes())
    }

    /// The kept observation of `run`, if there is one; an error if it is damaged.
    pub fn observation(&self, run: &EventRun) -> Result<Option<Observation>, FileError> {
        let path = self.path(OBSERVATIONS, &run.address());
        let Some(text) = read_sealed(&path)? else {
            return Ok(None);
        };
        let kept: ObservedRun = parse_json(&text, &path)?;
        Ok((kept.run == *run).then_some(kept.observation))
    }

    /// Keeps the `observation` of `run`.
    pub(crate) fn put_observation(
        &self,
        run: &EventRun,
        observation: &Observation,
    ) -> Result<(), FileError> {
        let kept = ObservedRun {
            run: *run,
            observation: *observation,
        };
        let content = serde_json::to_string(&kept).expect("plain data has a JSON form") + "\n";
        let path = self.path(OBSERVATIONS, &run.address());
        write_sealed(self.work_directory(), &path, content.as_bytes())
    }

    /// Directory of the checkpoints of native runs.
    pub fn checkpoint_directory(&self) -> PathBuf {
        self.session.root.join(CHECKPOINTS)
    }

    /// Directory of the run directories; those of failed runs stay.
    pub(crate) fn work_directory(&self) -> &Path {
        &self.session.work
    }

    fn run_path(&self, address: &str) -> PathBuf {
        let (group, name) = address.split_at(2);
        self.session.root.join("runs").join(group).join(name)
    }

    /// The file of one `kind` under `address`.
    fn path(&self, kind: &str, address: &str) -> PathBuf {
        self.session.root.join(kind).join(format!("{address}.json"))
    }

    /// A free place in quarantine.
    fn aside(&self, address: &str) -> PathBuf {
        let directory = self.session.root.join("quarantine");
        let mut places = (1..).map(|count: u32| directory.join(format!("{address}-{count}")));
        let free = places.find(|place| !place.exists());
        free.expect("there are more numbers than files")
    }
}
