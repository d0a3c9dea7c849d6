//! Entries: runs on disk, each a directory that is written completely before it is renamed into place.

use crate::code::Run;
use crate::files::{
    CHECKSUMS, FileError, check, checksums, create_parent, locked_directory, parse_json,
    sync_directory, write_synced,
};
use crate::model::Case;
use crate::series::Series;
use nix::fcntl::{AT_FDCWD, RenameFlags, renameat2};
use std::fs;
use std::path::Path;

const CASE: &str = "case.json";
const SERIES: &str = "series.csv";
const PROVENANCE: &str = "provenance.json";
const DRAFT: &str = ".draft-";

/// Reads the entry in `directory`; `None` if there is none.
///
/// # Errors
/// If it is there but damaged.
pub fn read_entry(directory: &Path) -> Result<Option<Run>, FileError> {
    if !directory.is_dir() {
        return Ok(None);
    }
    let checksums = read(&directory.join(CHECKSUMS))?;
    let checksums = String::from_utf8_lossy(&checksums);
    let checked = |file: &str| {
        let content = read(&directory.join(file))?;
        check(&checksums, directory, file, &content)?;
        Ok::<_, FileError>(content)
    };
    let case = Case::parse(&checked(CASE)?, &directory.join(CASE))?;
    let series = parse_series(&directory.join(SERIES), &checked(SERIES)?, &case)?;
    let provenance = parse_json(&checked(PROVENANCE)?, &directory.join(PROVENANCE))?;
    Ok(Some(Run {
        case,
        series,
        provenance,
    }))
}

/// Writes `run` as the entry in `target`, in place of an older one, by way of a draft in the directory `drafts`,
/// which the caller cleans up.
///
/// # Errors
/// If the file system refuses; an older entry is then unchanged.
pub(super) fn write_entry(target: &Path, drafts: &Path, run: &Run) -> Result<(), FileError> {
    let parent = create_parent(target)?;
    let draft = locked_directory(drafts, DRAFT).map_err(FileError::writing(drafts))?;
    let (draft, _lock) = draft;
    write_files(draft.path(), run)?;
    put_in_place(draft.path(), target)?;
    // Removes the older entry, if there was one.
    drop(draft);
    sync_directory(&parent)
}

fn write_files(directory: &Path, run: &Run) -> Result<(), FileError> {
    let files = [
        (CASE, run.case.to_json().into_bytes()),
        (SERIES, run.series.to_csv()),
        (PROVENANCE, run.provenance.to_json().into_bytes()),
    ];
    for (name, content) in &files {
        write_synced(&directory.join(name), content)?;
    }
    let sums = checksums(files.iter().map(|(name, content)| (name, content)));
    write_synced(&directory.join(CHECKSUMS), sums.as_bytes())?;
    sync_directory(directory)
}

/// Renames `draft` to `target`; an older `target` takes the place of the draft in the same instant.
fn put_in_place(draft: &Path, target: &Path) -> Result<(), FileError> {
    let rename = |flags| renameat2(AT_FDCWD, draft, AT_FDCWD, target, flags);
    let renamed = rename(RenameFlags::RENAME_NOREPLACE).or_else(|error| match error {
        nix::Error::EEXIST => rename(RenameFlags::RENAME_EXCHANGE),
        error => Err(error),
    });
    let renamed = match renamed {
        // Network file systems know plain renames only.
        Err(nix::Error::EINVAL) => put_in_place_by_steps(draft, target),
        renamed => renamed.map_err(Into::into),
    };
    renamed.map_err(FileError::writing(target))
}

/// Renames `draft` to `target` once an older `target` is out of the way.
fn put_in_place_by_steps(draft: &Path, target: &Path) -> std::io::Result<()> {
    let old = draft.with_extension("old");
    if target.exists() {
        fs::rename(target, &old)?;
    }
    let renamed = fs::rename(draft, target);
    if old.exists() {
        match renamed {
            Ok(()) => fs::remove_dir_all(&old)?,
            Err(_) => fs::rename(&old, target)?,
        }
    }
    renamed
}

fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    fs::read(path).map_err(FileError::reading(path))
}

/// The series of `case` in the `content` of the file at `path`.
pub(super) fn parse_series(path: &Path, content: &[u8], case: &Case) -> Result<Series, FileError> {
    let series = Series::read(content, &case.protocol);
    series.map_err(FileError::series(path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn directory_with(root: &Path, name: &str, content: &str) -> PathBuf {
        let directory = root.join(name);
        fs::create_dir(&directory).unwrap();
        fs::write(directory.join("file"), content).unwrap();
        directory
    }

    fn content(directory: &Path) -> String {
        fs::read_to_string(directory.join("file")).unwrap()
    }

    #[test]
    fn an_older_entry_is_replaced_where_renames_can_exchange_and_where_they_cannot() {
        let root = tempfile::tempdir().unwrap();
        let target = root.path().join("entry");
        let first = directory_with(root.path(), "first", "first");
        put_in_place(&first, &target).unwrap();
        let second = directory_with(root.path(), "second", "second");
        put_in_place(&second, &target).unwrap();
        assert_eq!(content(&target), "second");
        assert_eq!(content(&second), "first");
        fs::remove_dir_all(&second).unwrap();
        let third = directory_with(root.path(), "third", "third");
        put_in_place_by_steps(&third, &target).unwrap();
        assert_eq!(content(&target), "third");
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
    }
}
