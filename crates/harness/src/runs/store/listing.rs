//! The entries of a store by place and name alone: no file is opened and no link is followed. Only what is named as
//! this program names it is an entry.

use super::StoreError;
use super::directories::{Directories, Sharing};
use super::session::leftovers;
use super::{CHECKPOINTS, Kind, QUARANTINE, format};
use crate::files::FileError;
use crate::runs::entry::is_entry_file;
use std::fs::{self, DirEntry, Metadata};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Length of an address: SHA-256 in hexadecimal digits.
const ADDRESS: usize = 64;
const ENDING: &str = ".json";

/// A kind of entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum EntryKind {
    /// A finished run.
    Run,
    /// The micro-tests of a code.
    Probe,
    /// The observation of an event run or of a run of the authors' program.
    Observation,
    /// The reading of an impact.
    Impact,
    /// What a command has found about a code.
    Finding,
    /// The state of an unfinished native run.
    Checkpoint,
    /// The files of a run that failed.
    FailedRun,
    /// A damaged result.
    Quarantine,
}

impl EntryKind {
    /// All kinds.
    pub const ALL: [Self; 8] = [
        Self::Run,
        Self::Probe,
        Self::Observation,
        Self::Impact,
        Self::Finding,
        Self::Checkpoint,
        Self::FailedRun,
        Self::Quarantine,
    ];

    /// The word in tables and on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Run => Kind::Run.name(),
            Self::Probe => Kind::Probe.name(),
            Self::Observation => Kind::Observation.name(),
            Self::Impact => Kind::Impact.name(),
            Self::Finding => Kind::Finding.name(),
            Self::Checkpoint => "checkpoint",
            Self::FailedRun => "failed-run",
            Self::Quarantine => QUARANTINE,
        }
    }
}

/// A file of an entry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredFile {
    /// Its path in the entry; its name where the entry is a single file.
    pub name: PathBuf,
    /// Its length in bytes.
    pub bytes: u64,
}

/// An entry of a store.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredEntry {
    /// Its kind.
    pub kind: EntryKind,
    /// Its address; for a result in quarantine, its address and a number; for a failed run, its directory.
    pub name: String,
    /// Its place.
    pub path: PathBuf,
    /// Its path in the store.
    pub(super) place: PathBuf,
    /// Its files, by their names.
    pub files: Vec<StoredFile>,
    /// When the first of its files was written: later ones are summaries by other versions of this program.
    pub made: SystemTime,
}

impl StoredEntry {
    /// Returns the total length of its files.
    pub fn bytes(&self) -> u64 {
        self.files.iter().map(|file| file.bytes).sum()
    }
}

/// Lists the entries of the store at `root` by kind and name; returns `None` if there is no store. Creates nothing.
///
/// # Errors
/// If it is no store, is not to be trusted, or cannot be read.
pub(crate) fn entries(
    root: &Path,
    sharing: Sharing,
) -> Result<Option<Vec<StoredEntry>>, StoreError> {
    match fs::metadata(root) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(FileError::reading(root)(error).into()),
        Ok(_) => {}
    }
    let directories = Directories::open(root, sharing)?;
    if directories.first_file()?.is_none() {
        return Ok(Some(Vec::new()));
    }
    format::check(&directories)?;
    let mut entries = runs(&directories)?;
    for (kind, directory) in [
        (EntryKind::Probe, "probes"),
        (EntryKind::Observation, "observations"),
        (EntryKind::Impact, "impacts"),
        (EntryKind::Finding, "findings"),
        (EntryKind::Checkpoint, CHECKPOINTS),
    ] {
        entries.extend(single_files(&directories, kind, directory)?);
    }
    for place in leftovers(root) {
        entries.extend(below(&directories, &place)?.into_iter().filter_map(|one| {
            let place = place.join(one.name()?);
            entry(EntryKind::FailedRun, &directories, &place, |_| true)
        }));
    }
    for one in below(&directories, Path::new(QUARANTINE))? {
        let place = one.name().filter(|name| is_quarantined(name));
        let place = place.map(|name| Path::new(QUARANTINE).join(name));
        entries.extend(
            place.and_then(|place| entry(EntryKind::Quarantine, &directories, &place, |_| true)),
        );
    }
    entries.sort_by(|one, other| (one.kind, &one.name).cmp(&(other.kind, &other.name)));
    Ok(Some(entries))
}

fn runs(directories: &Directories) -> Result<Vec<StoredEntry>, FileError> {
    let runs = Path::new("runs");
    let mut entries = Vec::new();
    for group in below(directories, runs)? {
        let Some(first) = group.name().filter(|name| is_hexadecimal(name, 2)) else {
            continue;
        };
        if !group.is_directory() {
            continue;
        }
        let group = runs.join(first);
        for run in below(directories, &group)? {
            let rest = run.name().filter(|name| is_hexadecimal(name, ADDRESS - 2));
            let place = rest.filter(|_| run.is_directory());
            let place = place.map(|rest| group.join(rest));
            entries.extend(
                place.and_then(|place| entry(EntryKind::Run, directories, &place, is_entry_file)),
            );
        }
    }
    Ok(entries)
}

fn single_files(
    directories: &Directories,
    kind: EntryKind,
    directory: &str,
) -> Result<Vec<StoredEntry>, FileError> {
    let found = below(directories, Path::new(directory))?.into_iter();
    let entries = found.filter_map(|one| {
        let name = one.name()?;
        let is_own = is_hexadecimal(name.strip_suffix(ENDING)?, ADDRESS)
            && one.0.file_type().is_ok_and(|kind| kind.is_file());
        let place = is_own.then(|| Path::new(directory).join(name))?;
        entry(kind, directories, &place, |_| true)
    });
    Ok(entries.collect())
}

/// Returns the entry at `place`, unless it holds a file that `is_own` does not know, or is gone.
fn entry(
    kind: EntryKind,
    directories: &Directories,
    place: &Path,
    is_own: impl Fn(&str) -> bool,
) -> Option<StoredEntry> {
    let path = directories.root().join(place);
    let mut files = Vec::new();
    let mut times = Vec::new();
    let mut open = vec![PathBuf::new()];
    while let Some(name) = open.pop() {
        // A final slash would make the system take a file for a directory.
        let inside = match name == Path::new("") {
            true => path.clone(),
            false => path.join(&name),
        };
        let found = fs::symlink_metadata(&inside).ok()?;
        if found.is_dir() {
            let children = fs::read_dir(&inside).ok()?.flatten();
            open.extend(children.map(|child| name.join(child.file_name())));
            continue;
        }
        if name != Path::new("") && !is_own(&name.to_string_lossy()) {
            return None;
        }
        times.extend(found.modified().ok());
        files.push(file(&path, name, &found));
    }
    files.sort_by(|one, other| one.name.cmp(&other.name));
    let empty = || fs::symlink_metadata(&path).ok()?.modified().ok();
    Some(StoredEntry {
        kind,
        name: entry_name(kind, place),
        made: times.into_iter().min().or_else(empty)?,
        place: place.to_owned(),
        path,
        files,
    })
}

fn file(entry: &Path, name: PathBuf, found: &Metadata) -> StoredFile {
    let own = || entry.file_name().map(PathBuf::from).unwrap_or_default();
    StoredFile {
        name: match name == Path::new("") {
            true => own(),
            false => name,
        },
        // The length of a link is that of its target's name.
        bytes: if found.is_file() { found.len() } else { 0 },
    }
}

/// Returns the name of an entry, from its place in the store.
fn entry_name(kind: EntryKind, place: &Path) -> String {
    let mut parts = place.iter().skip(1).map(|part| part.to_string_lossy());
    match kind {
        EntryKind::Run => parts.collect(),
        EntryKind::FailedRun => parts.collect::<Vec<_>>().join("/"),
        _ => {
            let name = parts.next().unwrap_or_default();
            name.strip_suffix(ENDING).unwrap_or(&name).to_owned()
        }
    }
}

/// An entry of a directory, with its name if that is text.
struct Found(DirEntry, Option<String>);

impl Found {
    /// Its name, if that is text.
    fn name(&self) -> Option<&str> {
        self.1.as_deref()
    }

    fn is_directory(&self) -> bool {
        self.0.file_type().is_ok_and(|kind| kind.is_dir())
    }
}

/// Lists what lies in the directory at `place`, which may be absent.
fn below(directories: &Directories, place: &Path) -> Result<Vec<Found>, FileError> {
    let path = directories.place(place)?;
    directories.check(&path)?;
    let entries = match fs::read_dir(&path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(FileError::reading(&path))?,
    };
    let found = entries.map(|entry| {
        let entry = entry.map_err(FileError::reading(&path))?;
        let name = entry.file_name().to_str().map(str::to_owned);
        Ok(Found(entry, name))
    });
    found.collect()
}

fn is_hexadecimal(text: &str, digits: usize) -> bool {
    let is_digit = |byte: &u8| byte.is_ascii_digit() || (b'a'..=b'f').contains(byte);
    text.len() == digits && text.as_bytes().iter().all(is_digit)
}

/// Whether the store gives this name to something in quarantine: an address and a number.
fn is_quarantined(name: &str) -> bool {
    let parts = name.split_once('-');
    parts.is_some_and(|(address, number)| {
        is_hexadecimal(address, ADDRESS) && number.parse::<u32>().is_ok()
    })
}
