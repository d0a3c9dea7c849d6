//! The store of finished runs, addressed by case, code, version, program and inputs.
//!
//! Several programs may use one store at a time: each claims the runs that it is making, and takes those that
//! others have made. A damaged entry is moved to quarantine, never used and never deleted.
//!
//! A directory is adopted as a store only if its marker is there, or if it is new or empty. A store that cannot be
//! written to is only read.

mod directories;
mod format;
mod listing;
mod lock;
mod removal;
mod session;

pub use directories::Sharing;
pub(crate) use listing::entries;
pub use listing::{EntryKind, StoredEntry, StoredFile};
pub use lock::LockOwner;

use crate::code::{Identity, Provenance, Run};
use crate::files::{FileError, read_sealed, write_sealed};
use crate::model::{Case, shown};
use crate::runs::RunSummary;
use crate::runs::entry::{read_entry, read_summary, write_entry};
use directories::Directories;
use session::Session;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use thiserror::Error;

const CHECKPOINTS: &str = "checkpoints";
const QUARANTINE: &str = "quarantine";

/// The reason why a store cannot be used.
#[derive(Debug, Error)]
#[allow(missing_docs)] // The messages say what each is.
pub enum StoreError {
    #[error(
        "the store cannot be used: {}; accepted is a directory that you may write to: choose another one with --store",
        shown(Path::new(&.0.to_string()))
    )]
    Files(#[from] FileError),
    #[error(
        "{}: {found}; accepted is a store with `{accepted}`: choose another directory with --store",
        shown(path)
    )]
    OtherFormat {
        path: PathBuf,
        found: String,
        accepted: &'static str,
    },
    #[error(
        "{}: no such file beside `{first}`, so that this is no store; accepted is a store with `{accepted}`, or a new or \
         empty directory: choose another one with --store",
        shown(path)
    )]
    NoStore {
        path: PathBuf,
        first: String,
        accepted: &'static str,
    },
    #[error(
        "{}: locked by {owner}, which does not release it; continue or end that process",
        shown(path)
    )]
    Busy { path: PathBuf, owner: String },
    #[error(
        "nothing is removed from the store {}: {owner} is using it; wait until that has ended, or end it",
        shown(path)
    )]
    InUse {
        path: PathBuf,
        owner: Box<LockOwner>,
    },
    #[error(
        "nothing is removed from the store {}: {owner} began to use it, and whether it still does cannot be seen from here; \
         if it has ended, remove {}",
        shown(path),
        shown(session)
    )]
    InUseElsewhere {
        path: PathBuf,
        owner: Box<LockOwner>,
        session: PathBuf,
    },
    #[error(
        "nothing is removed from the store {}: a program that is unknown, because {} cannot be read, is using it, or has not \
         ended well; wait until no program uses the store, and remove that file",
        shown(path),
        shown(session)
    )]
    InUseByUnknown { path: PathBuf, session: PathBuf },
    #[error("the {kind} {name} could not be removed from the store: {error}")]
    NotRemoved {
        kind: &'static str,
        name: String,
        error: Box<FileError>,
    },
    #[error(
        "nothing is removed from the store {}, which can only be read: {reason}",
        shown(path)
    )]
    ReadOnly { path: PathBuf, reason: String },
    #[error(
        "{}: the file system has no locks ({reason}), by which programs at one store learn of one another; accepted is a \
         store on a file system with flock, as a local disk, NFS with its lock service, or Lustre mounted with -o flock: \
         choose another directory with --store",
        shown(path)
    )]
    NoLocks { path: PathBuf, reason: String },
}

/// A kind of result that a store keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The run of a case.
    Run,
    /// The probe of a code.
    Probe,
    /// What was observed in an event run or in a run of the authors' program.
    Observation,
    /// What was read off the motion of an impact.
    Impact,
    /// What a command has found about a code.
    Finding,
}

impl Kind {
    /// What one such result is called.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "run",
            Self::Probe => "probe",
            Self::Observation => "observation",
            Self::Impact => "impact",
            Self::Finding => "finding",
        }
    }

    /// Returns the name of the phase in which such results of so many codes are made or read.
    pub(crate) fn phase(self, codes: usize) -> String {
        let phase = match self {
            Self::Run => "compressions",
            Self::Probe if codes != 1 => return format!("probing {codes} codes"),
            Self::Probe => "probing 1 code",
            Self::Observation => "runs to the first event",
            Self::Impact => "impacts",
            Self::Finding => "findings",
        };
        phase.to_owned()
    }
}

/// The finished runs of a user.
#[derive(Debug, Clone)]
pub struct Store {
    directories: Arc<Directories>,
    access: Arc<Access>,
}

/// What this program may do in a store.
#[derive(Debug)]
enum Access {
    /// Keep results and claim tasks.
    Full(Session),
    /// Read only.
    Reading(Reading),
}

/// A store that cannot be written to.
#[derive(Debug)]
struct Reading {
    /// Why it cannot.
    reason: String,
    /// Directory for unfinished work.
    work: PathBuf,
    /// Whether that has been reported.
    told: AtomicBool,
}

impl Store {
    /// Opens the private store at `root` and creates it if there is none.
    ///
    /// # Errors
    /// If it is neither a store nor a new or empty directory, has another format, or others may write to it.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        Self::open_as(root, Sharing::Private)
    }

    /// Opens a store that may be shared with other users, as [`Self::open`] opens a private one.
    pub fn open_as(root: &Path, sharing: Sharing) -> Result<Self, StoreError> {
        let directories = Directories::open(root, sharing)?;
        format::check(&directories)?;
        let access = match Session::begin(&directories) {
            Ok(session) => Access::Full(session),
            Err(error) => Access::Reading(Reading::after(error)?),
        };
        Ok(Self {
            directories: Arc::new(directories),
            access: Arc::new(access),
        })
    }

    /// Whether results are kept. If they are not, calls `tell` with the reason, once.
    pub(crate) fn is_kept(&self, tell: impl FnOnce(&str)) -> bool {
        let Access::Reading(Reading { reason, told, .. }) = self.access.as_ref() else {
            return true;
        };
        if !told.swap(true, Ordering::Relaxed) {
            let root = shown(self.directories.root());
            tell(&format!(
                "nothing new is kept, because the store {root} can only be read: {reason}"
            ));
        }
        false
    }

    /// Claims the tasks under `addresses` for this program. Returns, for each, the other program that is carrying it
    /// out, if there is one.
    pub(crate) fn claim(&self, addresses: &[String]) -> Result<Vec<Option<LockOwner>>, StoreError> {
        match self.access.as_ref() {
            Access::Full(session) => session.claim(addresses),
            Access::Reading(_) => Ok(vec![None; addresses.len()]),
        }
    }

    /// Releases the claims to the tasks under `addresses`.
    pub(crate) fn release(&self, addresses: &[String]) -> Result<(), StoreError> {
        match self.access.as_ref() {
            Access::Full(session) => session.release(addresses),
            Access::Reading(_) => Ok(()),
        }
    }

    /// Returns the finished run of `case` by the code with `identity`, if there is one; fails if it is damaged.
    pub fn get(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<Run>, FileError> {
        let address = identity.address(case, deck_hash);
        let run = read_entry(&self.path(Kind::Run, &address)?)?;
        let run =
            run.filter(|run| is_of(&run.provenance, identity, deck_hash) && run.case == *case);
        if run.is_some() {
            self.forget_checkpoint(&address);
        }
        Ok(run)
    }

    /// Returns the summary of that run; fails if the run is damaged.
    pub(crate) fn summary(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<RunSummary>, FileError> {
        let address = identity.address(case, deck_hash);
        let summary = read_summary(&self.path(Kind::Run, &address)?, self.work_directory())?;
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
        let target = self.path(Kind::Run, &address)?;
        self.create_directory(Kind::Run, &address)?;
        let mode = self.directories.mode();
        write_entry(&target, self.work_directory(), run, mode)?;
        self.forget_checkpoint(&address);
        Ok(())
    }

    fn forget_checkpoint(&self, address: &str) {
        // Most runs have none.
        let _ = std::fs::remove_file(self.checkpoint_directory().join(format!("{address}.json")));
    }

    /// Moves the damaged result under `address` into quarantine and returns its place there. Another program may have
    /// moved it already.
    pub(crate) fn put_aside(&self, kind: Kind, address: &str) -> Result<PathBuf, FileError> {
        let directory = self.directories.create(QUARANTINE)?;
        let mut places = (1..).map(|count: u32| directory.join(format!("{address}-{count}")));
        let free = places.find(|place| std::fs::symlink_metadata(place).is_err());
        let aside = free.expect("there are more numbers than files");
        // Whatever is there is moved without being opened, even a link or a pipe.
        let damaged = self.directories.place(name(kind, address))?;
        match std::fs::rename(damaged, &aside) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(FileError::writing(&aside)(error))
            }
            _ => Ok(aside),
        }
    }

    /// Reads the result of the given kind under `address`, a single file that `parse` reads, if there is one; fails
    /// if it is damaged.
    pub(crate) fn sealed<T>(
        &self,
        kind: Kind,
        address: &str,
        parse: impl FnOnce(&[u8], &Path) -> Result<T, FileError>,
    ) -> Result<Option<T>, FileError> {
        let path = self.path(kind, address)?;
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
        let path = self.path(kind, address)?;
        self.create_directory(kind, address)?;
        write_sealed(self.work_directory(), &path, content.as_bytes())
    }

    /// Whether there is a result of the given kind under `address`, which may be damaged.
    pub(crate) fn holds(&self, kind: Kind, address: &str) -> bool {
        let path = self.path(kind, address);
        path.is_ok_and(|path| std::fs::symlink_metadata(path).is_ok())
    }

    /// Directory of the checkpoints of native runs.
    pub fn checkpoint_directory(&self) -> PathBuf {
        self.directories.root().join(CHECKPOINTS)
    }

    /// Directory of the run directories; those of failed runs stay.
    pub(crate) fn work_directory(&self) -> &Path {
        match self.access.as_ref() {
            Access::Full(session) => &session.work,
            Access::Reading(reading) => &reading.work,
        }
    }

    /// Returns the path of the result of the given kind under `address`.
    fn path(&self, kind: Kind, address: &str) -> Result<PathBuf, FileError> {
        let path = self.directories.place(name(kind, address))?;
        if kind == Kind::Run {
            self.directories.check(&path)?;
        }
        Ok(path)
    }

    /// Creates the directory in which that result lies.
    fn create_directory(&self, kind: Kind, address: &str) -> Result<(), FileError> {
        let name = name(kind, address);
        let above = name.parent().unwrap_or(Path::new(""));
        self.directories.create(above).map(drop)
    }
}

impl Reading {
    /// Gives read-only access after an `error` that keeps this program from writing to the store; returns any other
    /// error.
    fn after(error: StoreError) -> Result<Self, StoreError> {
        use ErrorKind as Kind;
        let cannot_write = [
            Kind::PermissionDenied,
            Kind::ReadOnlyFilesystem,
            Kind::StorageFull,
            Kind::QuotaExceeded,
        ];
        match error {
            StoreError::Files(FileError::Io { ref source, .. })
                if cannot_write.contains(&source.kind()) =>
            {
                let work = tempfile::Builder::new().prefix("tristack-").tempdir();
                let work = work.map_err(FileError::writing(&std::env::temp_dir()))?;
                Ok(Self {
                    reason: error.to_string(),
                    work: work.keep(),
                    told: AtomicBool::new(false),
                })
            }
            error => Err(error),
        }
    }
}

impl Drop for Reading {
    fn drop(&mut self) {
        // The directory stays if it holds the files of failed runs.
        let _ = std::fs::remove_dir(&self.work);
    }
}

/// Returns the path in a store of the result of the given kind under `address`.
fn name(kind: Kind, address: &str) -> PathBuf {
    let directory = PathBuf::from(format!("{}s", kind.name()));
    match kind {
        Kind::Run => directory.join(&address[..2]).join(&address[2..]),
        _ => directory.join(format!("{address}.json")),
    }
}

/// Whether a run with this `provenance` was made by the program with `identity` from the inputs with `deck_hash`.
fn is_of(provenance: &Provenance, identity: &Identity, deck_hash: &str) -> bool {
    provenance.identity.deciding() == identity.deciding() && provenance.deck_hash == deck_hash
}
