//! Files that are written whole or not at all, whatever happens to the machine.
//!
//! Content goes to a draft, is synced, and takes the place of the target by a rename, which is synced too.

use super::FileError;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{ErrorKind, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Writes `content` to `path` such that a reader sees the old file or the new one, never a part. Drafts of the same
/// file by killed programs are removed.
///
/// # Errors
/// If the file system refuses; `path` is then as it was.
pub(crate) fn write_atomically(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let directory = create_parent(path)?;
    let mut prefix = OsString::from(".");
    prefix.push(path.file_name().unwrap_or_default());
    prefix.push(".draft-");
    remove_abandoned(&directory, &prefix);
    write_by_draft(&directory, &prefix, path, content)
}

/// The same by way of a draft in the directory `drafts`, which the caller cleans up.
pub(super) fn write_by_draft(
    drafts: &Path,
    prefix: &OsStr,
    path: &Path,
    content: &[u8],
) -> Result<(), FileError> {
    let directory = create_parent(path)?;
    let write = || try_to_write(drafts, prefix, path, content);
    // Before it was locked, another program may have taken the draft for an abandoned one.
    match write() {
        Err(error) if error.kind() == ErrorKind::NotFound => write(),
        written => written,
    }
    .map_err(FileError::writing(path))?;
    sync_directory(&directory)
}

fn try_to_write(drafts: &Path, prefix: &OsStr, path: &Path, content: &[u8]) -> std::io::Result<()> {
    // As readable as any other file of this user, not as a temporary one.
    let mut draft = tempfile::Builder::new()
        .prefix(prefix)
        .permissions(fs::Permissions::from_mode(0o666))
        .tempfile_in(drafts)?;
    // The lock marks the draft as in use. Where files cannot be locked, drafts are only not cleaned up.
    let _ = draft.as_file().try_lock();
    draft.write_all(content)?;
    draft.as_file().sync_all()?;
    draft.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Removes the drafts with `prefix` in `directory` that are not locked: a lock ends with its program.
pub(crate) fn remove_abandoned(directory: &Path, prefix: &OsStr) {
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let drafts = entries.filter(|entry| {
        let name = entry.file_name();
        name.as_encoded_bytes()
            .starts_with(prefix.as_encoded_bytes())
    });
    for draft in drafts {
        let abandoned = File::open(draft.path()).is_ok_and(|file| file.try_lock().is_ok());
        if abandoned {
            // Another program may have been faster.
            let _ = fs::remove_file(draft.path()).or_else(|_| fs::remove_dir_all(draft.path()));
        }
    }
}

/// Creates a directory in `parent`, locked as long as the file beside it is open, and removed when dropped.
pub(crate) fn locked_directory(parent: &Path, prefix: &str) -> std::io::Result<(TempDir, File)> {
    let directory = tempfile::Builder::new().prefix(prefix).tempdir_in(parent)?;
    let lock = File::open(directory.path())?;
    let _ = lock.try_lock();
    Ok((directory, lock))
}

/// Writes a file that lasts through a power failure once its directory is synced.
pub(crate) fn write_synced(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let written = File::create(path).and_then(|mut file| {
        file.write_all(content)?;
        file.sync_all()
    });
    written.map_err(FileError::writing(path))
}

/// Makes renames into and out of `directory` last through a power failure.
pub(crate) fn sync_directory(directory: &Path) -> Result<(), FileError> {
    File::open(directory)
        .and_then(|directory| directory.sync_all())
        .map_err(FileError::writing(directory))
}

/// Creates the directory for `target`, if there is none, and makes it last.
pub(crate) fn create_parent(target: &Path) -> Result<PathBuf, FileError> {
    let directory = parent(target);
    if !directory.is_dir() {
        fs::create_dir_all(&directory).map_err(FileError::writing(&directory))?;
        for above in directory.ancestors().skip(1).take(2) {
            sync_directory(&parent(&above.join("file")))?;
        }
    }
    Ok(directory)
}

/// The directory that `path` is in.
fn parent(path: &Path) -> PathBuf {
    let parent = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new(".")).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<OsString> {
        let entries = fs::read_dir(directory).unwrap();
        entries.map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn what_a_killed_program_left_goes_with_the_next_write() {
        let directory = tempfile::tempdir().unwrap();
        let abandoned = directory.path().join(".table.csv.draft-abcdef");
        fs::write(abandoned, "half a ta").unwrap();
        write_atomically(&directory.path().join("table.csv"), b"table").unwrap();
        assert_eq!(names(directory.path()), ["table.csv"]);
    }

    #[test]
    fn the_draft_of_a_living_program_is_left_alone() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(".table.csv.draft-abcdef");
        let held = File::create(&path).unwrap();
        held.lock().unwrap();
        write_atomically(&directory.path().join("table.csv"), b"table").unwrap();
        assert!(path.exists());
    }

    #[test]
    fn a_file_that_cannot_be_written_stays_as_it_was() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.csv");
        fs::create_dir(&path).unwrap();
        assert!(write_atomically(&path, b"table").is_err());
        assert!(path.is_dir());
        assert_eq!(names(directory.path()), ["table.csv"]);
    }
}
