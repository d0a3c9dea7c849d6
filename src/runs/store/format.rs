//! The format version of a store.

use super::StoreError;
use crate::files::{FileError, create_parent, write_atomically};
use std::io::ErrorKind;
use std::path::Path;

const FILE: &str = "format";
/// Version 2 has digests and sessions. Version 1 had neither, and no file that said so.
const CURRENT: &str = "tristack store, format 2\n";

/// Refuses a store at `root` with another format; a new one gets the current format.
pub(super) fn check(root: &Path) -> Result<(), StoreError> {
    create_parent(&root.join(FILE))?;
    // Looked for first, because the format is written before the first run.
    let has_runs = root.join("runs").exists();
    let path = root.join(FILE);
    let found = match std::fs::read(&path) {
        Ok(found) if found == CURRENT.as_bytes() => return Ok(()),
        Ok(found) => String::from_utf8_lossy(&found[..found.len().min(80)]).into_owned(),
        Err(error) if error.kind() == ErrorKind::NotFound && !has_runs => {
            return Ok(write_atomically(&path, CURRENT.as_bytes())?);
        }
        Err(error) if error.kind() == ErrorKind::NotFound => "no such file".to_owned(),
        Err(error) => return Err(FileError::reading(&path)(error).into()),
    };
    Err(StoreError::OtherFormat {
        path,
        found: found.trim().to_owned(),
        accepted: CURRENT.trim(),
    })
}
