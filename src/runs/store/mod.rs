//! The store of finished runs, addressed by case, code, version, program and inputs.
//!
//! Several programs may use one store at a time: each claims the runs that it is making, and takes those that
//! others have made. A damaged entry is moved to quarantine, never used and never deleted.

mod format;
mod lock;
mod session;

pub use lock::LockOwner;

use crate::code::{Identity, Provenance, Run};
use crate::files::{FileError, create_parent, read_sealed, write_sealed};
use crate::model::{Case, shown};
use crate::runs::RunSummary;
use crate::runs::entry::{read_entry, read_summary, write_entry};
use session::Session;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

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

/// A kind of result that a store keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The run of a case.
    Run,
    /// The probe of a code.
    Probe,
    /// What was observed in an event run.
    Observation,
}

impl Kind {
    /// What one such result is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Probe => "probe",
            Self::Observation => "observation",
        }
    }
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
        let run = read_entry(&self.path(Kind::Run, &address))?;
        let run =
            run.filter(|run| is_of(&run.provenance, identity, deck_hash) && run.case == *case);
        if run.is_some() {
            self.forget_checkpoint(&address);
        }
        Ok(run)
    }

    /// The summary of that run; an error if the run is damaged.
    pub(crate) fn summary(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<RunSummary>, FileError> {
        let address = identity.address(case, deck_hash);
        let summary = read_summary(&self.path(Kind::Run, &address), self.work_directory())?;
        let summary = summary.filter(|summary| {
            is_of(&summary.provenance, identity, deck_hash) && summary.case == *case
        });
        if summary.is_some() {
            self.forget_checkpoint(&address);
        }
        Ok(summary)
    }

    /// Keeps a finished run and removes its checkpoint.
    pub fn put(&self, run: &Run) -> Result<(), FileError> {
        let made = &run.provenance;
        let address = made.identity.address(&run.case, &made.deck_hash);
        write_entry(&self.path(Kind::Run, &address), self.work_directory(), run)?;
        self.forget_checkpoint(&address);
        Ok(())
    }

    fn forget_checkpoint(&self, address: &str) {
        // Most runs have none.
        let _ = std::fs::remove_file(self.checkpoint_directory().join(format!("{address}.json")));
    }

    /// Puts the damaged result under `address` into quarantine, and returns its place there. It may have been moved
    /// already.
    pub(crate) fn put_aside(&self, kind: Kind, address: &str) -> Result<PathBuf, FileError> {
        let directory = self.session.root.join("quarantine");
        let mut places = (1..).map(|count: u32| directory.join(format!("{address}-{count}")));
        let free = places.find(|place| !place.exists());
        let aside = free.expect("there are more numbers than files");
        create_parent(&aside)?;
        match std::fs::rename(self.path(kind, address), &aside) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(FileError::writing(&aside)(error))
            }
            _ => Ok(aside),
        }
    }

    /// The result of the given kind under `address`, a single file that `parse` reads, if there is one; an error if it
    /// is damaged.
    pub(crate) fn sealed<T>(
        &self,
        kind: Kind,
        address: &str,
        parse: impl FnOnce(&[u8], &Path) -> Result<T, FileError>,
    ) -> Result<Option<T>, FileError> {
        let path = self.path(kind, address);
        let text = read_sealed(&path)?;
        text.map(|text| parse(&text, &path)).transpose()
    }

    /// Keeps the `content` of a result of the given kind under `address`.
    pub(crate) fn put_sealed(
        &self,
        kind: Kind,
        address: &str,
        content: &str,
    ) -> Result<(), FileError> {
        let path = self.path(kind, address);
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

    /// The place of the result of the given kind under `address`.
    fn path(&self, kind: Kind, address: &str) -> PathBuf {
        let directory = self.session.root.join(format!("{}s", kind.name()));
        match kind {
            Kind::Run => directory.join(&address[..2]).join(&address[2..]),
            _ => directory.join(format!("{address}.json")),
        }
    }
}

/// Whether a run with this `provenance` was made by the program with `identity` from the inputs with `deck_hash`.
fn is_of(provenance: &Provenance, identity: &Identity, deck_hash: &str) -> bool {
    provenance.identity == *identity && provenance.deck_hash == deck_hash
}
