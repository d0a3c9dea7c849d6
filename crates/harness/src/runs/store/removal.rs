//! Removal of entries on request, while no other program uses the store.

use super::listing::{EntryKind, StoredEntry};
use super::{Access, Store, StoreError};
use crate::files::FileError;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

impl Store {
    /// Removes `entries`. Each disappears in one instant: it is renamed into this session's directory for unfinished
    /// work, and deleted there. If the program is killed, the next one deletes it.
    ///
    /// # Errors
    /// If the store can only be read, another program uses it, or the file system refuses. In the last case removal
    /// stops at the first entry that stays; those before it are removed.
    pub fn remove(&self, entries: &[StoredEntry]) -> Result<(), StoreError> {
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
        let taken = entries.iter().try_for_each(|entry| {
            let aside = session.work.join(format!("removed-{}", removed.len()));
            let taken = self.take_out(entry, &aside);
            if taken.map_err(|error| not_removed(entry, error))? {
                removed.push((entry, aside));
            }
            Ok(())
        });
        // Other programs may begin: what is deleted now no longer belongs to the store.
        drop(alone);
        let deleted = removed.into_iter().map(|(entry, aside)| {
            let deleted = delete(&aside);
            deleted.map_err(|error| not_removed(entry, error))
        });
        // The others are deleted even if one fails.
        let deleted: Vec<Result<(), StoreError>> = deleted.collect();
        taken.and_then(|()| deleted.into_iter().collect())
    }

    /// Renames `entry` to `aside`; returns whether it was still there.
    fn take_out(&self, entry: &StoredEntry, aside: &Path) -> Result<bool, FileError> {
        // Every directory on the way is the store's own, and none is a link.
        let path: PathBuf = self.directories.place(&entry.place)?;
        match fs::rename(&path, aside) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
            renamed => renamed.map_err(FileError::writing(&path))?,
        }
        let has_own_group = matches!(entry.kind, EntryKind::Run | EntryKind::FailedRun);
        if let Some(group) = path.parent().filter(|_| has_own_group) {
            // The group stays if it holds anything else.
            let _ = fs::remove_dir(group);
        }
        Ok(true)
    }
}

fn not_removed(entry: &StoredEntry, error: FileError) -> StoreError {
    StoreError::NotRemoved {
        kind: entry.kind.as_str(),
        name: entry.name.clone(),
        error: Box::new(error),
    }
}

/// Deletes a directory or a file; deletes a link itself, not its target.
fn delete(path: &Path) -> Result<(), FileError> {
    let found = fs::symlink_metadata(path).map_err(FileError::reading(path))?;
    let deleted = match found.is_dir() {
        true => fs::remove_dir_all(path),
        false => fs::remove_file(path),
    };
    deleted.map_err(FileError::writing(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::SystemTime;

    /// The entry at `place` in the store at `root`.
    fn entry(root: &Path, kind: EntryKind, place: &str) -> StoredEntry {
        StoredEntry {
            kind,
            name: "a1b2".to_owned(),
            path: root.join(place),
            place: PathBuf::from(place),
            files: Vec::new(),
            made: SystemTime::UNIX_EPOCH,
        }
    }

    #[test]
    fn what_was_taken_out_is_deleted_though_another_entry_stays() {
        let root = tempfile::tempdir().unwrap();
        let store = Store::open(root.path()).unwrap();
        fs::create_dir(root.path().join("probes")).unwrap();
        fs::write(root.path().join("probes/a1b2.json"), "{}").unwrap();
        // Nothing can be taken out of a directory that is a file.
        fs::write(root.path().join("impacts"), "").unwrap();
        let entries = [
            entry(root.path(), EntryKind::Probe, "probes/a1b2.json"),
            entry(root.path(), EntryKind::Impact, "impacts/a1b2.json"),
        ];
        let message = store.remove(&entries).unwrap_err().to_string();
        assert!(
            message.starts_with("the impact a1b2 could not be removed"),
            "{message}"
        );
        assert!(!root.path().join("probes/a1b2.json").exists());
        let left = fs::read_dir(store.work_directory()).unwrap();
        assert_eq!(left.count(), 0);
    }
}
