//! Removal of entries on request, while no other program uses the store.

use super::listing::{EntryKind, StoredEntry};
use super::{Access, Store, StoreError};
use crate::files::FileError;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

impl Store {
    /// Removes `entries`. Each disappears in one instant: it is renamed into the directory for unfinished work of this
    /// session, and deleted there, where a killed program leaves it to the next one.
    ///
    /// # Errors
    /// If another program uses the store, or the file system refuses.
    pub(crate) fn remove(&self, entries: &[StoredEntry]) -> Result<(), StoreError> {
        let session = match self.access.as_ref() {
            Access::Full(session) => session,
            Access::Reading(reading) => {
                return Err(StoreError::ReadOnly {
                    path: self.directories.root().to_owned(),
                    reason: reading.reason.clone(),
                });
            }
        };
        let alone = session.alone()?;
        let mut removed = Vec::new();
        for entry in entries {
            let aside = session.work.join(format!("removed-{}", removed.len()));
            if self.take_out(entry, &aside)? {
                removed.push(aside);
            }
        }
        // Others may begin: what is deleted now no longer belongs to the store.
        drop(alone);
        removed.iter().try_for_each(|path| delete(path))
    }

    /// Renames `entry` to `aside`; whether it was still there.
    fn take_out(&self, entry: &StoredEntry, aside: &Path) -> Result<bool, FileError> {
        // Every directory on the way is the store's own, and none is a link.
        let path: PathBuf = self.directories.place(&entry.place)?;
        match fs::rename(&path, aside) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
            renamed => renamed.map_err(FileError::writing(&path))?,
        }
        let has_own_group = matches!(entry.kind, EntryKind::Run | EntryKind::FailedRun);
        if let Some(group) = path.parent().filter(|_| has_own_group) {
            // Stays if it holds anything else.
            let _ = fs::remove_dir(group);
        }
        Ok(true)
    }
}

/// Deletes a directory or a file; a link itself, not what it points to.
fn delete(path: &Path) -> Result<(), StoreError> {
    let found = fs::symlink_metadata(path).map_err(FileError::reading(path))?;
    let deleted = match found.is_dir() {
        true => fs::remove_dir_all(path),
        false => fs::remove_file(path),
    };
    Ok(deleted.map_err(FileError::writing(path))?)
}
