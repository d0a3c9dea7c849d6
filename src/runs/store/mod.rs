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
use crate::dem::{EventRun, Observation};
use crate::files::{FileError, parse_json, seal, unseal, write_atomically_via};
use crate::model::{Case, shown};
use crate::runs::{Archive, ProbeRecord};
use serde::{Deserialize, Serialize};
use session::Session;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use thiserror::Error;

/// Directory of the probes.
const PROBES: &str = "probes";
/// Directory of the observations of event runs.
const OBSERVATIONS: &str = "observations";

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
        let run = self.archive.load(&name(&address))?;
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
        let Provenance {
            identity,
            deck_hash,
            ..
        } = &run.provenance;
        let address = identity.address(&run.case, deck_hash);
        self.archive.save(&name(&address), run)?;
        self.forget_checkpoint(&address);
        Ok(())
    }

    fn forget_checkpoint(&self, address: &str) {
        let checkpoint = self.checkpoint_directory().join(format!("{address}.json"));
        // Most runs have none.
        let _ = std::fs::remove_file(checkpoint);
    }

    /// Puts the damaged run under `address` into quarantine, and returns its place there.
    pub(crate) fn put_aside(&self, address: &str) -> Result<PathBuf, FileError> {
        let aside = self.aside(address);
        self.archive.move_away(&name(address), &aside)?;
        Ok(aside)
    }

    /// The kept probe with the given address, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
    pub fn probe(&self, address: &str) -> Result<Option<ProbeRecord>, FileError> {
        let path = self.path(PROBES, address);
        let text = read_sealed(&path)?;
        text.map(|text| ProbeRecord::parse(&text, &path))
            .transpose()
    }

    /// Keeps a probe.
    pub(crate) fn put_probe(&self, address: &str, record: &ProbeRecord) -> Result<(), FileError> {
        self.put_sealed(&self.path(PROBES, address), &record.to_json())
    }

    /// Puts the damaged probe under `address` into quarantine, and returns its place there.
    pub(crate) fn put_probe_aside(&self, address: &str) -> Result<PathBuf, FileError> {
        self.put_file_aside(PROBES, address)
    }

    /// The kept observation of `run`, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
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
        self.put_sealed(&self.path(OBSERVATIONS, &run.address()), &content)
    }

    /// Puts the damaged observation of `run` into quarantine, and returns its place there.
    pub(crate) fn put_observation_aside(&self, run: &EventRun) -> Result<PathBuf, FileError> {
        self.put_file_aside(OBSERVATIONS, &run.address())
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

    /// The file of one `kind` under `address`.
    fn path(&self, kind: &str, address: &str) -> PathBuf {
        let name = format!("{address}.json");
        self.archive.root().join(kind).join(name)
    }

    fn put_sealed(&self, path: &Path, content: &str) -> Result<(), FileError> {
        write_atomically_via(self.session.work(), path, &seal(content.as_bytes()))
    }

    fn put_file_aside(&self, kind: &str, address: &str) -> Result<PathBuf, FileError> {
        let aside = self.aside(address);
        self.archive
            .move_away(&self.path(kind, address), &aside)
            .map(|()| aside)
    }

    /// A free place in quarantine.
    fn aside(&self, address: &str) -> PathBuf {
        let directory = self.archive.root().join("quarantine");
        let mut places = (1..).map(|count: u32| directory.join(format!("{address}-{count}")));
        let free = places.find(|place| !place.exists());
        free.expect("there are more numbers than files")
    }
}

/// The content of the sealed file at `path`, if there is one.
fn read_sealed(path: &Path) -> Result<Option<Vec<u8>>, FileError> {
    match std::fs::read(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(FileError::reading(path)(error)),
        Ok(sealed) => unseal(path, &sealed).map(|content| Some(content.to_vec())),
    }
}

fn name(address: &str) -> PathBuf {
    Path::new("runs").join(&address[..2]).join(&address[2..])
}
