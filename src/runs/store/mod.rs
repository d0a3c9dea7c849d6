//! The store of finished runs, addressed by case, code, version, program and inputs.
//!
//! Several programs may use one store at a time: each claims the runs that it is making, and takes those that
//! others have made. A damaged entry is moved to quarantine, never used and never deleted.

mod format;
mod lock;
mod owner;
mod session;

pub use owner::LockOwner;

use crate::code::{Identity, Provenance, Run};
use crate::files::{FileError, seal, unseal, write_atomically_via};
use crate::model::{Case, shown};
use crate::runs::{Archive, RunSummary};
use session::Session;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

/// The reason why a store cannot be used.
#[derive(Debug, Error)]
pub enum StoreError {
    /// A file or directory could not be read or written.
    #[error(transparent)]
    Files(#[from] FileError),
    /// It has the format of another version of tristack.
    #[error(
        "{}: {found}; accepted is a store with `{accepted}`: choose another directory with --store, or delete this one",
        shown(path)
    )]
    OtherFormat {
        /// The file with the format.
        path: PathBuf,
        /// The format found.
        found: String,
        /// The format of this version.
        accepted: &'static str,
    },
    /// Another program keeps its lock.
    #[error(
        "{}: locked by {owner}, which does not release it; continue or end that process",
        shown(path)
    )]
    Busy {
        /// The lock.
        path: PathBuf,
        /// The owner of the lock.
        owner: String,
    },
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

    /// The place of the result under `address`, relative to the root of the store.
    fn place(self, address: &str) -> PathBuf {
        match self {
            Self::Run => Path::new("runs").join(&address[..2]).join(&address[2..]),
            _ => PathBuf::from(format!("{}s/{address}.json", self.name())),
        }
    }
}

/// The finished runs of a user.
#[derive(Debug, Clone)]
pub struct Store {
    archive: Archive,
    session: Arc<Session>,
}

impl Store {
    /// A store at `root`, which is created.
    ///
    /// # Errors
    /// If it cannot be written to, or has another format.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        format::check(root)?;
        let session = Session::begin(root)?;
        Ok(Self {
            archive: Archive::new(root).with_drafts_in(session.work()),
            session: Arc::new(session),
        })
    }

    /// The finished run of `case` by the code with `identity`, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
    pub fn get(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<Run>, FileError> {
        let address = identity.address(case, deck_hash);
        let run = self.archive.load(&Kind::Run.place(&address))?;
        let run =
            run.filter(|run| is_of(&run.provenance, identity, deck_hash) && run.case == *case);
        if run.is_some() {
            self.forget_checkpoint(&address);
        }
        Ok(run)
    }

    /// The summary of that run: kept beside its series, or made from it.
    ///
    /// # Errors
    /// If there is such a run, but damaged.
    pub(crate) fn summary(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<RunSummary>, FileError> {
        let address = identity.address(case, deck_hash);
        let summary = self.archive.load_summary(&Kind::Run.place(&address))?;
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
        let Provenance {
            identity,
            deck_hash,
            ..
        } = &run.provenance;
        let address = identity.address(&run.case, deck_hash);
        self.archive.save(&Kind::Run.place(&address), run)?;
        self.forget_checkpoint(&address);
        Ok(())
    }

    fn forget_checkpoint(&self, address: &str) {
        let checkpoint = self.checkpoint_directory().join(format!("{address}.json"));
        // Most runs have none.
        let _ = std::fs::remove_file(checkpoint);
    }

    /// Puts the damaged result under `address` into quarantine, and returns its place there.
    pub(crate) fn put_aside(&self, kind: Kind, address: &str) -> Result<PathBuf, FileError> {
        let directory = self.archive.root().join("quarantine");
        let mut places = (1..).map(|count: u32| directory.join(format!("{address}-{count}")));
        let free = places.find(|place| !place.exists());
        let aside = free.expect("there are more numbers than files");
        self.archive.move_away(&kind.place(address), &aside)?;
        Ok(aside)
    }

    /// The result of the given kind under `address`, a single file that `parse` reads, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
    pub(crate) fn sealed<T>(
        &self,
        kind: Kind,
        address: &str,
        parse: impl FnOnce(&[u8], &Path) -> Result<T, FileError>,
    ) -> Result<Option<T>, FileError> {
        let path = self.archive.root().join(kind.place(address));
        match std::fs::read(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(FileError::reading(&path)(error)),
            Ok(sealed) => parse(unseal(&path, &sealed)?, &path).map(Some),
        }
    }

    /// Keeps the `content` of a result of the given kind under `address`.
    pub(crate) fn put_sealed(
        &self,
        kind: Kind,
        address: &str,
        content: &str,
    ) -> Result<(), FileError> {
        let path = self.archive.root().join(kind.place(address));
        write_atomically_via(self.session.work(), &path, &seal(content.as_bytes()))
    }

    /// Claims the runs under `addresses` for this program, until it releases them or ends. Returns, for each, the
    /// other program that is making it, if there is one.
    ///
    /// # Errors
    /// If the claims cannot be read or written.
    pub fn claim(&self, addresses: &[String]) -> Result<Vec<Option<LockOwner>>, StoreError> {
        self.session.claim(addresses)
    }

    /// Releases the claims to the runs under `addresses`.
    ///
    /// # Errors
    /// If the claims cannot be written; they end with this program in any case.
    pub fn release(&self, addresses: &[String]) -> Result<(), StoreError> {
        self.session.release(addresses)
    }

    /// Directory of the checkpoints of native runs.
    pub fn checkpoint_directory(&self) -> PathBuf {
        self.archive.root().join("checkpoints")
    }

    /// Directory of the run directories; those of failed runs stay.
    pub(crate) fn work_directory(&self) -> &Path {
        self.session.work()
    }
}

/// Whether a run with this `provenance` was made by the program with `identity` from the inputs with `deck_hash`.
fn is_of(provenance: &Provenance, identity: &Identity, deck_hash: &str) -> bool {
    provenance.identity == *identity && provenance.deck_hash == deck_hash
}
