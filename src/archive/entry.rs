//! Reading and writing of entries; every write is a rename of something complete.

use super::Provenance;
use crate::stack::{Case, CaseError};
use crate::trace::{SeriesError, Trace};
use std::fs::{self, File};
use std::io::{BufReader, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A finished run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// What was run.
    pub case: Case,
    /// What came out.
    pub trace: Trace,
    /// Who ran it, how, and when.
    pub provenance: Provenance,
}

/// Why an entry could not be read or written.
#[derive(Debug, Error)]
pub enum ArchiveError {
    /// A file or directory could not be read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// "read" or "write".
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// `case.json` is not a case.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// `series.csv` is not the series of the case.
    #[error("{}: {source}", path.display())]
    Series {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: SeriesError,
    },
    /// `provenance.json` cannot be understood.
    #[error("{}: {message}", path.display())]
    Provenance {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
}

impl ArchiveError {
    pub(crate) fn reading(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io {
            action: "read",
            path,
            source,
        }
    }

    pub(crate) fn writing(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io {
            action: "write",
            path,
            source,
        }
    }
}

/// A directory of entries.
#[derive(Debug, Clone)]
pub struct Archive {
    root: PathBuf,
}

impl Archive {
    /// An archive at `root`, which need not exist yet.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }

    /// Where the archive is.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Reads the entry `name`; `None` if there is none.
    ///
    /// # Errors
    /// If it is there but damaged.
    pub fn load(&self, name: &Path) -> Result<Option<Run>, ArchiveError> {
        let directory = self.root.join(name);
        if !directory.is_dir() {
            return Ok(None);
        }
        let case = Case::read(&directory.join("case.json"))?;
        let trace = read_series(&directory.join("series.csv"), &case)?;
        let provenance = read_provenance(&directory.join("provenance.json"))?;
        Ok(Some(Run {
            case,
            trace,
            provenance,
        }))
    }

    /// Writes `run` as the entry `name`, in place of an older one.
    ///
    /// # Errors
    /// If the file system refuses; nothing partial is left under `name`.
    pub fn save(&self, name: &Path, run: &Run) -> Result<(), ArchiveError> {
        let target = self.root.join(name);
        let parent = target.parent().unwrap_or(&self.root);
        fs::create_dir_all(parent).map_err(ArchiveError::writing(parent))?;
        let draft = tempfile::Builder::new()
            .prefix(".draft-")
            .tempdir_in(parent)
            .map_err(ArchiveError::writing(parent))?;
        let files = [
            ("case.json", run.case.to_json().into_bytes()),
            ("series.csv", run.trace.to_csv()),
            ("provenance.json", run.provenance.to_json().into_bytes()),
        ];
        for (file, content) in files {
            let path = draft.path().join(file);
            fs::write(&path, content).map_err(ArchiveError::writing(&path))?;
        }
        let old = draft.path().with_extension("old");
        if target.exists() {
            fs::rename(&target, &old).map_err(ArchiveError::writing(&target))?;
        }
        fs::rename(draft.path(), &target).map_err(ArchiveError::writing(&target))?;
        // The draft is now the entry; there is nothing left to clean up.
        let _ = draft.keep();
        if old.exists() {
            fs::remove_dir_all(&old).map_err(ArchiveError::writing(&old))?;
        }
        Ok(())
    }
}

fn read_series(path: &Path, case: &Case) -> Result<Trace, ArchiveError> {
    let file = File::open(path).map_err(ArchiveError::reading(path))?;
    let schedule = case.protocol.schedule();
    Trace::read(BufReader::new(file), &schedule, case.protocol.time_step).map_err(|source| {
        ArchiveError::Series {
            path: path.to_owned(),
            source,
        }
    })
}

fn read_provenance(path: &Path) -> Result<Provenance, ArchiveError> {
    let text = fs::read_to_string(path).map_err(ArchiveError::reading(path))?;
    serde_json::from_str(&text).map_err(|error| ArchiveError::Provenance {
        path: path.to_owned(),
        message: error.to_string(),
    })
}

/// Writes `content` to `path` such that a reader sees the old file or the new one, never a part.
///
/// # Errors
/// If the file system refuses; `path` is then as it was.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), ArchiveError> {
    let parent = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    // As readable as any other file of this user, not as a temporary one.
    let mut draft = tempfile::Builder::new()
        .permissions(fs::Permissions::from_mode(0o666))
        .tempfile_in(parent)
        .map_err(ArchiveError::writing(path))?;
    draft
        .write_all(content)
        .and_then(|()| draft.as_file().sync_all())
        .map_err(ArchiveError::writing(path))?;
    draft
        .persist(path)
        .map_err(|error| ArchiveError::writing(path)(error.error))?;
    Ok(())
}
