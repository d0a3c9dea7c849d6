//! Why a file could not be read or written.

use crate::model::{CaseError, shown};
use crate::series::SeriesError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why an entry could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// A file or directory could not be read or written.
    #[error("cannot {action} {}: {source}", shown(path))]
    Io {
        /// "read" or "write".
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file is not the one that was written.
    #[error(
        "{}: its SHA-256 is {found}, but was {expected} when it was written",
        shown(path)
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Digest of what is there.
        found: String,
        /// Digest of what was written.
        expected: String,
    },
    /// `case.json` is not a case.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// `series.csv` is not the series of the case.
    #[error("{}: {source}", shown(path))]
    Series {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: SeriesError,
    },
    /// `provenance.json` cannot be understood.
    #[error("{}: {message}", shown(path))]
    Provenance {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        message: String,
    },
}

impl FileError {
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
