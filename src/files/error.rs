//! Errors of reading and writing files.

use crate::model::{CaseError, shown};
use crate::series::SeriesError;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The reason why a file could not be read or written.
#[derive(Debug, Error)]
pub enum FileError {
    /// A file or directory could not be read or written.
    #[error("cannot {action} {}: {source}", shown(path))]
    Io {
        /// "read" or "write".
        action: &'static str,
        /// The file or directory.
        path: PathBuf,
        /// The error of the system.
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
        /// Digest of its content.
        found: String,
        /// Digest when it was written.
        expected: String,
    },
    /// A file does not hold a case.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A file does not hold the series of its case.
    #[error("{}: {source}", shown(path))]
    Series {
        /// The file.
        path: PathBuf,
        /// The error.
        source: SeriesError,
    },
    /// A file cannot be understood.
    #[error("{}: {message}", shown(path))]
    Content {
        /// The file.
        path: PathBuf,
        /// The error.
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

/// The value in the JSON `text` of the file at `path`.
pub(crate) fn parse_json<T: DeserializeOwned>(text: &[u8], path: &Path) -> Result<T, FileError> {
    serde_json::from_slice(text).map_err(|error| FileError::Content {
        path: path.to_owned(),
        message: error.to_string(),
    })
}
