//! Errors of reading and writing files.

use crate::model::{CaseError, shown};
use crate::series::SeriesError;
use serde::de::DeserializeOwned;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The reason why a file could not be read or written.
#[derive(Debug, Error)]
#[allow(missing_docs)] // The messages say what each is.
pub enum FileError {
    #[error("cannot {action} {}: {source}", shown(path))]
    Io {
        /// "read" or "write".
        action: &'static str,
        path: PathBuf,
        source: std::io::Error,
    },
    #[error(
        "{}: its SHA-256 is {found}, but was {expected} when it was written",
        shown(path)
    )]
    Damaged {
        path: PathBuf,
        found: String,
        expected: String,
    },
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error("{}: {source}", shown(path))]
    Series { path: PathBuf, source: SeriesError },
    #[error("{}: {message}", shown(path))]
    Content { path: PathBuf, message: String },
}

impl FileError {
    /// Adds the path of the file to an error of reading it.
    pub fn reading(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        Self::trying("read", path)
    }

    /// Adds the path of the file to an error of writing it.
    pub fn writing(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        Self::trying("write", path)
    }

    fn trying(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io {
            action,
            path,
            source,
        }
    }

    /// Whether the disk or the user's quota is full, or the file would be longer than the user may write.
    pub fn is_full(&self) -> bool {
        let full = [
            ErrorKind::StorageFull,
            ErrorKind::QuotaExceeded,
            ErrorKind::FileTooLarge,
        ];
        matches!(self, Self::Io { source, .. } if full.contains(&source.kind()))
    }

    /// Returns the error for a file at `path` that does not hold the series of its case.
    pub fn series(path: &Path) -> impl FnOnce(SeriesError) -> Self {
        let path = path.to_owned();
        move |source| Self::Series { path, source }
    }

    /// Returns the error for a file at `path` that cannot be understood.
    pub fn content(path: &Path, message: impl ToString) -> Self {
        Self::Content {
            path: path.to_owned(),
            message: message.to_string(),
        }
    }
}

/// Parses the JSON `text` of the file at `path`.
pub(crate) fn parse_json<T: DeserializeOwned>(text: &[u8], path: &Path) -> Result<T, FileError> {
    serde_json::from_slice(text).map_err(|error| FileError::content(path, error))
}
