//! The contents of a store: each entry with the task that it answers and the program that made it.

use super::entry::read_origin;
use super::findings::found_about;
use super::impacts::{ImpactRun, read_impact};
use super::observations::observed_run;
use super::probe_record::probe_address;
use super::store::{EntryKind, StoredEntry};
use super::{ScheduledTask, StoreError, entries, in_parallel};
use crate::code::{Code, Identity, InstalledCode, Provenance};
use crate::dem::{EventRun, PublishedRun};
use crate::files::{FileError, parse_json, read_sealed};
use crate::model::Case;
use crate::runs::Sharing;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

/// Entries that are read at the same time.
const THREADS: usize = 4;

/// An entry of a store, and what is known of it without reading its results.
#[derive(Debug, Clone)]
pub struct Content {
    /// Its place, files and time.
    pub entry: StoredEntry,
    /// The code and the task behind it; an error if they cannot be read.
    pub origin: Result<Origin, String>,
}

/// The code and the task behind an entry.
#[derive(Debug, Clone)]
pub struct Origin {
    /// Name of the code.
    pub code: String,
    /// Version of the code; absent where the entry does not say it.
    pub version: Option<String>,
    /// What was asked of the code; absent where the entry does not say it.
    pub task: Option<StoredTask>,
    /// How it was made; absent where the entry does not say it.
    pub provenance: Option<Provenance>,
}

/// A task whose result is kept.
#[derive(Debug, Clone)]
pub enum StoredTask {
    /// A compression.
    Case(Case),
    /// The micro-tests of a code.
    MicroTests,
    /// An event run.
    Event(EventRun),
    /// A run of the authors' program.
    Published(PublishedRun),
    /// An impact.
    Impact(ImpactRun),
}

impl fmt::Display for StoredTask {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Case(case) => write!(formatter, "{case}"),
            Self::MicroTests => formatter.write_str("micro-tests"),
            Self::Event(run) => write!(formatter, "{run}"),
            Self::Published(run) => write!(formatter, "{run}"),
            Self::Impact(run) => write!(formatter, "{run}"),
        }
    }
}

impl StoredTask {
    /// Returns the address under which the store would keep the result of `code`.
    fn address(&self, code: &dyn InstalledCode) -> String {
        match self {
            Self::Case(case) => ScheduledTask::address(case, code),
            Self::MicroTests => probe_address(code),
            Self::Event(run) => run.address(),
            Self::Published(run) => run.address(),
            Self::Impact(run) => ScheduledTask::address(run, code),
        }
    }
}

impl Content {
    /// The name of its code, if it is known.
    pub fn code(&self) -> Option<&str> {
        Some(&self.origin.as_ref().ok()?.code)
    }

    /// Returns the case if the entry is a run.
    pub fn case(&self) -> Option<&Case> {
        match self.origin.as_ref().ok()?.task.as_ref()? {
            StoredTask::Case(case) => Some(case),
            _ => None,
        }
    }
}

/// Lists the contents of the store at `root` by kind and name; returns `None` if there is no store. Creates nothing.
///
/// # Errors
/// If it is no store, is not to be trusted, or cannot be read.
pub fn contents(root: &Path, sharing: Sharing) -> Result<Option<Vec<Content>>, StoreError> {
    let Some(entries) = entries(root, sharing)? else {
        return Ok(None);
    };
    let origins = in_parallel(&entries, THREADS, |entry| {
        origin(entry).map_err(|error| error.to_string())
    });
    let contents = entries.into_iter().zip(origins);
    Ok(Some(
        contents
            .map(|(entry, origin)| Content { entry, origin })
            .collect(),
    ))
}

fn origin(entry: &StoredEntry) -> Result<Origin, FileError> {
    let path = entry.path.as_path();
    let text = || {
        let text = read_sealed(path)?;
        text.ok_or_else(|| FileError::content(path, "it has just been removed"))
    };
    match entry.kind {
        EntryKind::Run => {
            let (case, provenance) = read_origin(path)?;
            Ok(Origin::made(provenance, StoredTask::Case(case)))
        }
        EntryKind::Probe => {
            let Made { provenance } = parse_json(&text()?, path)?;
            Ok(Origin::made(provenance, StoredTask::MicroTests))
        }
        EntryKind::Observation => {
            let text = text()?;
            let task = match observed_run(&text, path) {
                Ok(run) => StoredTask::Published(run),
                Err(_) => StoredTask::Event(observed_run(&text, path)?),
            };
            Ok(Origin::of_native(Some(task)))
        }
        EntryKind::Impact => {
            let (run, Identity { code, version, .. }) = read_impact(&text()?, path)?;
            Ok(Origin {
                code,
                version: Some(version),
                task: Some(StoredTask::Impact(run)),
                provenance: None,
            })
        }
        EntryKind::Finding => {
            let Identity { code, version, .. } = found_about(&text()?, path)?;
            Ok(Origin {
                code,
                version: Some(version),
                task: None,
                provenance: None,
            })
        }
        // Only the native code has checkpoints.
        EntryKind::Checkpoint => Ok(Origin::of_native(None)),
        EntryKind::FailedRun => code_of_directory(path),
        EntryKind::Quarantine => Err(FileError::content(path, "it was put aside as damaged")),
    }
}

/// The part of the record of a probe that says how it was made.
#[derive(Deserialize)]
struct Made {
    provenance: Provenance,
}

/// Returns the code after which the schedule named the directory of a run.
fn code_of_directory(path: &Path) -> Result<Origin, FileError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let code = name.rsplit_once('-').map(|(code, _)| code.to_owned());
    let code = code.filter(|code| !code.is_empty());
    let unknown = || FileError::content(path, "its name is not that of a code and a run");
    Ok(Origin {
        code: code.ok_or_else(unknown)?,
        version: None,
        task: None,
        provenance: None,
    })
}

impl Origin {
    fn made(provenance: Provenance, task: StoredTask) -> Self {
        Self {
            code: provenance.identity.code.clone(),
            version: Some(provenance.identity.version.clone()),
            task: Some(task),
            provenance: Some(provenance),
        }
    }

    fn of_native(task: Option<StoredTask>) -> Self {
        Self {
            code: Code::native().as_str().to_owned(),
            version: None,
            task,
            provenance: None,
        }
    }
}

/// The codes as they are installed here; each is looked up when it is first asked for.
pub struct CodesOfToday {
    known: Vec<Code>,
    builds: BTreeMap<String, Vec<Box<dyn InstalledCode>>>,
}

impl CodesOfToday {
    /// Starts with the `known` codes, none of them looked up yet.
    pub fn new(known: Vec<Code>) -> Self {
        Self {
            known,
            builds: BTreeMap::new(),
        }
    }

    /// Whether the same task would have another address today, because this program, the code or its deck has
    /// changed. `None` if that is not known: the code is unknown, not installed or broken, or the entry does not say
    /// its task.
    pub fn is_outdated(&mut self, content: &Content) -> Option<bool> {
        let origin = content.origin.as_ref().ok()?;
        let task = origin.task.as_ref()?;
        let builds = self.builds.entry(origin.code.clone());
        let builds = builds.or_insert_with_key(|name| builds_of(&self.known, name));
        let builds = builds.iter().map(|build| &**build);
        let (broken, working): (Vec<&dyn InstalledCode>, Vec<_>) =
            builds.partition(|build| build.broken().is_some());
        let is_own = |&build: &&dyn InstalledCode| task.address(build) == content.entry.name;
        if working.iter().any(is_own) {
            return Some(false);
        }
        // It may come from a build that cannot be asked.
        let is_known = !working.is_empty() && broken.is_empty();
        is_known.then_some(true)
    }
}

/// Finds the builds whose results the store keeps under this `name`, which is one of the `known` codes: the usual
/// build and, if it is installed, the one with more digits that explains round-off. Returns none if the usual one is
/// not installed.
fn builds_of(known: &[Code], name: &str) -> Vec<Box<dyn InstalledCode>> {
    let Some(code) = known.iter().find(|code| code.as_str() == name) else {
        return Vec::new();
    };
    let usual = code.find();
    let precise = usual.is_some().then(|| code.find_precise()).flatten();
    usual.into_iter().chain(precise).collect()
}
