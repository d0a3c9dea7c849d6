//! The marker of a store, with the version of its format.

use super::StoreError;
use super::directories::Directories;
use crate::files::{FileError, Links, read_bounded, write_atomically};
use std::io::ErrorKind;

const FILE: &str = "format";
/// Version 2 has digests and sessions. Version 1 had neither, and no file that said so.
const CURRENT: &str = "tristack store, format 2\n";
/// Size limit for the marker of any version, in bytes.
const LONGEST: u64 = 80;

/// Refuses a directory that is no store, or one with another format; makes a new or empty one a store.
pub(super) fn check(directories: &Directories) -> Result<(), StoreError> {
    // Looked for before the marker is read, because the marker is written before anything else.
    let first = directories.first_file();
    let path = directories.root().join(FILE);
    let found = match read_bounded(&path, LONGEST, Links::Refused) {
        Ok(found) if found == CURRENT.as_bytes() => return Ok(()),
        Ok(found) => String::from_utf8_lossy(&found).trim().to_owned(),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let Some(first) = first? else {
                return Ok(write_atomically(&path, CURRENT.as_bytes())?);
            };
            return Err(StoreError::NoStore {
                path,
                first,
                accepted: CURRENT.trim(),
            });
        }
        Err(error) if error.kind() == ErrorKind::InvalidInput => error.to_string(),
        Err(error) => return Err(FileError::reading(&path)(error).into()),
    };
    Err(StoreError::OtherFormat {
        path,
        found,
        accepted: CURRENT.trim(),
    })
}
