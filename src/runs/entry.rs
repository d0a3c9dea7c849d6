//! Entries: runs on disk, each a directory that is written completely before it is renamed into place.

use super::summary::{ESTIMATOR, RunSummary};
use crate::code::Run;
use crate::files::{
    CHECKSUMS, FileError, check, checksums, create_parent, locked_directory, parse_json,
    remove_abandoned, sync_directory, write_synced,
};
use crate::model::Case;
use crate::series::Series;
use nix::fcntl::{AT_FDCWD, RenameFlags, renameat2};
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

const CASE: &str = "case.json";
const SERIES: &str = "series.csv";
const PROVENANCE: &str = "provenance.json";
const SUMMARY: &str = "summary.json";
const DRAFT: &str = ".draft-";

/// The summary of a run as it is kept beside its series, so that the series need not be read again.
#[derive(Serialize, Deserialize)]
struct KeptSummary {
    /// Digest of the sources that made the summary.
    estimator: String,
    summary: RunSummary,
}

/// A directory of entries.
#[derive(Debug, Clone)]
pub struct Archive {
    root: PathBuf,
    drafts: PathBuf,
}

impl Archive {
    /// An archive at `root`, which need not exist yet.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        let root = root.into();
        let drafts = root.clone();
        Self { root, drafts }
    }

    /// The same archive with its drafts in `drafts`, a directory in the same file system.
    pub(crate) fn with_drafts_in(self, drafts: impl Into<PathBuf>) -> Self {
        let drafts = drafts.into();
        Self { drafts, ..self }
    }

    /// The directory of the archive.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Reads the entry `name`; `None` if there is none.
    ///
    /// # Errors
    /// If it is there but damaged.
    pub fn load(&self, name: &Path) -> Result<Option<Run>, FileError> {
        let Some(entry) = Entry::open(self.root.join(name))? else {
            return Ok(None);
        };
        let case = Case::parse(&entry.read(CASE)?, &entry.path(CASE))?;
        let series = parse_series(&entry.path(SERIES), &entry.read(SERIES)?, &case)?;
        let provenance = parse_json(&entry.read(PROVENANCE)?, &entry.path(PROVENANCE))?;
        Ok(Some(Run {
            case,
            series,
            provenance,
        }))
    }

    /// The summary of the entry `name`; `None` if there is none. It is made anew from the series where the one beside
    /// it was made by other sources than today's.
    ///
    /// # Errors
    /// If the entry is there but damaged, its series included.
    pub(crate) fn load_summary(&self, name: &Path) -> Result<Option<RunSummary>, FileError> {
        let Some(entry) = Entry::open(self.root.join(name))? else {
            return Ok(None);
        };
        if entry.has(SUMMARY) {
            let kept: KeptSummary = parse_json(&entry.read(SUMMARY)?, &entry.path(SUMMARY))?;
            if kept.estimator == *ESTIMATOR {
                entry.read(SERIES)?;
                return Ok(Some(kept.summary));
            }
        }
        Ok(self.load(name)?.map(RunSummary::new))
    }

    /// Writes `run` as the entry `name`, in place of an older one.
    ///
    /// # Errors
    /// If the file system refuses; an older entry is then unchanged.
    pub fn save(&self, name: &Path, run: &Run) -> Result<(), FileError> {
        let target = self.root.join(name);
        let parent = create_parent(&target)?;
        if self.drafts == self.root {
            // The owner of any other place cleans it up.
            remove_abandoned(&self.drafts, DRAFT.as_ref());
        }
        let draft = locked_directory(&self.drafts, DRAFT);
        let (draft, _lock) = draft.map_err(FileError::writing(&self.drafts))?;
        write_entry(draft.path(), run)?;
        put_in_place(draft.path(), &target)?;
        // Removes the older entry, if there was one.
        drop(draft);
        sync_directory(&parent)
    }

    /// Moves the entry `name`, if it is still there, to `target`, which does not exist.
    pub(crate) fn move_away(&self, name: &Path, target: &Path) -> Result<(), FileError> {
        create_parent(target)?;
        match fs::rename(self.root.join(name), target) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
            renamed => renamed.map_err(FileError::writing(target)),
        }
    }
}

/// An entry that is being read.
struct Entry {
    directory: PathBuf,
    checksums: String,
}

impl Entry {
    /// The entry in `directory`; `None` if there is none.
    fn open(directory: PathBuf) -> Result<Option<Self>, FileError> {
        if !directory.is_dir() {
            return Ok(None);
        }
        let checksums = read(&directory.join(CHECKSUMS))?;
        let checksums = String::from_utf8_lossy(&checksums).into_owned();
        Ok(Some(Self {
            directory,
            checksums,
        }))
    }

    fn path(&self, file: &str) -> PathBuf {
        self.directory.join(file)
    }

    /// Whether `file` belongs to the entry.
    fn has(&self, file: &str) -> bool {
        self.checksums.lines().any(|line| line.ends_with(file))
    }

    /// The content of `file`, which has the digest that it was written with.
    fn read(&self, file: &str) -> Result<Vec<u8>, FileError> {
        let content = read(&self.path(file))?;
        check(&self.checksums, &self.directory, file, &content)?;
        Ok(content)
    }
}

fn write_entry(directory: &Path, run: &Run) -> Result<(), FileError> {
    let summary = KeptSummary {
        estimator: ESTIMATOR.clone(),
        summary: RunSummary::new(run.clone()),
    };
    let summary = serde_json::to_vec(&summary).expect("plain data has a JSON form");
    let files = [
        (CASE, run.case.to_json().into_bytes()),
        (SERIES, run.series.to_csv()),
        (PROVENANCE, run.provenance.to_json().into_bytes()),
        (SUMMARY, summary),
    ];
    for (name, content) in &files {
        write_synced(&directory.join(name), content)?;
    }
    let sums = checksums(&files);
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
    let schedule = case.protocol.schedule();
    Series::read(content, &schedule, case.protocol.time_step).map_err(|source| FileError::Series {
        path: path.to_owned(),
        source,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
