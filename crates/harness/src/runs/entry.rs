//! Entries: runs on disk, each a directory that is written completely before it is renamed into place.

use super::summary::RunSummary;
use crate::code::{Provenance, Run};
use crate::dem::SOURCE_DIGEST;
use crate::files::{
    CHECKSUMS, FileError, Links, check, checksums, create_parent, kind, locked_directory,
    parse_json, read_bounded, read_sealed, seal, sync_directory, write_sealed, write_synced,
};
use crate::model::Case;
use crate::series::Series;
use nix::fcntl::{AT_FDCWD, RenameFlags, renameat2};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

const CASE: &str = "case.json";
const SERIES: &str = "series.csv";
const PROVENANCE: &str = "provenance.json";
/// Prefix of the name of a summary; a digest of the sources that made it follows.
const SUMMARY: &str = "summary-";
const SUMMARY_DIGEST: usize = 16;
const ENDING: &str = ".json";
const DRAFT: &str = ".draft-";
/// Size limit for files of an entry, in bytes: four times the longest result of a code.
const LARGEST: u64 = 1 << 30;

/// Whether `name` is that of a file of an entry: one of its own four, or a summary by any version of the sources.
pub(super) fn is_entry_file(name: &str) -> bool {
    let summary = name.strip_prefix(SUMMARY);
    let digest = summary.and_then(|rest| rest.strip_suffix(ENDING));
    let is_summary = digest.is_some_and(|digest| {
        digest.len() == SUMMARY_DIGEST && digest.bytes().all(|byte| byte.is_ascii_hexdigit())
    });
    is_summary || [CASE, SERIES, PROVENANCE, CHECKSUMS].contains(&name)
}

/// Reads the case and the provenance of the entry in `directory`, without its series and without checking digests.
///
/// # Errors
/// If one of them is missing or malformed.
pub(crate) fn read_origin(directory: &Path) -> Result<(Case, Provenance), FileError> {
    let (case, provenance) = (directory.join(CASE), directory.join(PROVENANCE));
    let parsed = Case::parse(&read(&case)?, &case)?;
    Ok((parsed, parse_json(&read(&provenance)?, &provenance)?))
}

/// Reads the entry in `directory`; `None` if there is none.
///
/// # Errors
/// If it is there but damaged.
pub fn read_entry(directory: &Path) -> Result<Option<Run>, FileError> {
    if !is_there(directory)? {
        return Ok(None);
    }
    let checked = checked_files(directory)?;
    let case = Case::parse(&checked(CASE)?, &directory.join(CASE))?;
    let series = parse_series(&directory.join(SERIES), &checked(SERIES)?, &case)?;
    let provenance = parse_json(&checked(PROVENANCE)?, &directory.join(PROVENANCE))?;
    Ok(Some(Run {
        case,
        series,
        provenance,
    }))
}

/// Whether the directory exists; anything else in its place is an error.
fn is_there(directory: &Path) -> Result<bool, FileError> {
    match fs::symlink_metadata(directory) {
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(FileError::reading(directory)(error)),
        Ok(found) if found.is_dir() => Ok(true),
        Ok(found) => {
            let message = format!("it is {}; accepted is a directory", kind(&found));
            Err(FileError::content(directory, message))
        }
    }
}

/// Reads the summary of the entry in `directory`; returns `None` if there is no entry. If the entry has no summary by
/// today's sources, makes one from its series and keeps it, through a draft in the directory `drafts`.
///
/// # Errors
/// If the entry is there but damaged, its series included.
pub(super) fn read_summary(
    directory: &Path,
    drafts: &Path,
) -> Result<Option<RunSummary>, FileError> {
    let path = directory.join(summary_file());
    if let Ok(Some(kept)) = read_sealed(&path)
        && let Ok(kept) = parse_json::<KeptSummary>(&kept, &path)
        && read(&directory.join(CHECKSUMS))? == kept.checksums.as_bytes()
    {
        let checked = checked_files(directory)?;
        for file in [CASE, SERIES, PROVENANCE] {
            checked(file)?;
        }
        return Ok(Some(kept.summary));
    }
    let Some(run) = read_entry(directory)? else {
        return Ok(None);
    };
    let checksums = read(&directory.join(CHECKSUMS))?;
    let summary = RunSummary::new(run);
    // If this fails, the next reader is slower.
    let _ = write_sealed(drafts, &path, &summary_json(&summary, &checksums));
    Ok(Some(summary))
}

/// A summary as it is stored.
#[derive(Serialize, Deserialize)]
struct KeptSummary {
    /// The digests of the files that it was made of.
    checksums: String,
    summary: RunSummary,
}

/// Returns the name of the summary file, which contains the digest of the sources that read it off the series.
fn summary_file() -> String {
    format!("{SUMMARY}{}{ENDING}", &SOURCE_DIGEST[..SUMMARY_DIGEST])
}

fn summary_json(summary: &RunSummary, checksums: &[u8]) -> Vec<u8> {
    let kept = KeptSummary {
        checksums: String::from_utf8_lossy(checksums).into_owned(),
        summary: summary.clone(),
    };
    serde_json::to_vec(&kept).expect("plain data has a JSON form")
}

/// Returns a reader of the files of the entry in `directory` by name. It refuses files that no longer have the digest
/// with which they were written.
fn checked_files(
    directory: &Path,
) -> Result<impl Fn(&str) -> Result<Vec<u8>, FileError>, FileError> {
    let checksums = read(&directory.join(CHECKSUMS))?;
    let checksums = String::from_utf8_lossy(&checksums).into_owned();
    Ok(move |file: &str| {
        let content = read(&directory.join(file))?;
        check(&checksums, directory, file, &content)?;
        Ok(content)
    })
}

/// Writes `run` as the entry in `target`, replacing an older one, through a draft in the directory `drafts`, which
/// the caller cleans up. The entry gets the permissions `mode`, which the umask restricts further.
///
/// # Errors
/// If the file system refuses; an older entry is then unchanged.
pub(super) fn write_entry(
    target: &Path,
    drafts: &Path,
    run: &Run,
    mode: u32,
) -> Result<(), FileError> {
    let parent = create_parent(target)?;
    let draft = locked_directory(drafts, DRAFT, mode).map_err(FileError::writing(drafts))?;
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
    let summary = summary_json(&RunSummary::new(run.clone()), sums.as_bytes());
    write_synced(&directory.join(summary_file()), &seal(&summary))?;
    sync_directory(directory)
}

/// Renames `draft` to `target`; if an older `target` exists, the two change places in the same instant.
fn put_in_place(draft: &Path, target: &Path) -> Result<(), FileError> {
    let rename = |flags| renameat2(AT_FDCWD, draft, AT_FDCWD, target, flags);
    let renamed = rename(RenameFlags::RENAME_NOREPLACE).or_else(|error| match error {
        nix::Error::EEXIST => rename(RenameFlags::RENAME_EXCHANGE),
        error => Err(error),
    });
    let renamed = match renamed {
        // Network file systems support plain renames only.
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
    read_bounded(path, LARGEST, Links::Refused).map_err(FileError::reading(path))
}

/// Reads the series of `case` from the `content` of the file at `path`.
pub(super) fn parse_series(path: &Path, content: &[u8], case: &Case) -> Result<Series, FileError> {
    let series = Series::read(content, case);
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
