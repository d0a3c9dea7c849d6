//! Recorded runs, which stand in for engines that are not installed.

use crate::archive::{Archive, ArchiveError, ProbeRecord, Provenance, Reading, Run};
use crate::engine::EngineName;
use crate::stack::{Case, shown};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The recorded runs of the project.
#[derive(Debug, Clone)]
pub struct Recorded {
    archive: Archive,
}

/// Why a recorded run cannot stand in.
#[derive(Debug, Error)]
pub enum RecordedError {
    /// Nobody recorded it.
    #[error("{engine} is not installed, and there is no recorded run at {}; install it ({}), record it where it is installed (tristack record --engines {engine}), or let TRISTACK_REFERENCE name the directory of the recorded runs", shown(path), engine.installation_hint())]
    Absent {
        /// The engine.
        engine: EngineName,
        /// Where the run would be.
        path: PathBuf,
    },
    /// It was made with another deck than today's.
    #[error(
        "the recorded run {} was made with another deck (hash {recorded}, now {current}); refresh it with: tristack record --engines {engine}",
        shown(path)
    )]
    OtherDeck {
        /// The engine.
        engine: EngineName,
        /// The recorded run.
        path: PathBuf,
        /// Deck hash it was made with.
        recorded: String,
        /// Deck hash of this version of tristack.
        current: String,
    },
    /// It cannot be read.
    #[error(transparent)]
    Damaged(#[from] ArchiveError),
}

impl Recorded {
    /// Recorded runs below `root`.
    pub fn new(root: &Path) -> Self {
        Self {
            archive: Archive::new(root),
        }
    }

    /// The recorded run of `case` by `engine`.
    ///
    /// # Errors
    /// If there is none, or it is damaged, or it was made with another deck.
    pub fn get(&self, engine: EngineName, case: &Case) -> Result<Run, RecordedError> {
        let name = name(engine, case);
        let path = self.archive.root().join(&name);
        let run = self.archive.load(&name)?;
        let Some(run) = run
            .filter(|run| run.case == *case && run.provenance.identity.engine == engine.as_str())
        else {
            return Err(RecordedError::Absent { engine, path });
        };
        up_to_date(engine, case, path, &run.provenance)?;
        Ok(run)
    }

    /// What was read off the recorded runs of `engine` whose series are not kept.
    ///
    /// # Errors
    /// If the record is damaged.
    pub fn readings(&self, engine: EngineName) -> Result<Vec<Reading>, ArchiveError> {
        Reading::load_all(&self.readings_path(engine))
    }

    /// `reading` of `case`, if it was made with today's deck.
    ///
    /// # Errors
    /// If it was not.
    pub fn unless_outdated(
        &self,
        engine: EngineName,
        case: &Case,
        reading: Reading,
    ) -> Result<Reading, RecordedError> {
        let path = self.readings_path(engine);
        up_to_date(engine, case, path, &reading.provenance)?;
        Ok(reading)
    }

    /// Records `readings` of `engine` in place of older ones.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn replace_readings(
        &self,
        engine: EngineName,
        readings: &[Reading],
    ) -> Result<(), ArchiveError> {
        Reading::save_all(&self.readings_path(engine), readings)
    }

    fn readings_path(&self, engine: EngineName) -> PathBuf {
        let name = format!("{engine}.jsonl");
        self.archive.root().join("readings").join(name)
    }

    /// The recorded probe of `engine`.
    ///
    /// # Errors
    /// If there is none, or it is damaged, or a micro-test was put with another deck, other parameters or
    /// arguments.
    pub fn probe(&self, engine: EngineName) -> Result<ProbeRecord, RecordedError> {
        let path = self.probe_path(engine);
        let record = ProbeRecord::load(&path)?;
        let own = |record: &ProbeRecord| record.provenance.identity.engine == engine.as_str();
        let Some(record) = record.filter(own) else {
            return Err(RecordedError::Absent { engine, path });
        };
        if let Some(answer) = record.outdated(|test| engine.probe_hash(test)) {
            return Err(RecordedError::OtherDeck {
                engine,
                path,
                recorded: answer.told_hash.clone(),
                current: engine.probe_hash(&answer.test),
            });
        }
        Ok(record)
    }

    /// Records the probe of `engine` in place of an older one.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn replace_probe(
        &self,
        engine: EngineName,
        record: &ProbeRecord,
    ) -> Result<(), ArchiveError> {
        record.save(&self.probe_path(engine))
    }

    fn probe_path(&self, engine: EngineName) -> PathBuf {
        let name = format!("{engine}.json");
        self.archive.root().join("probes").join(name)
    }

    /// Records `runs` of `engine` in place of everything recorded of it before.
    ///
    /// # Errors
    /// If they cannot be written; the older recordings are removed last.
    pub fn replace(&self, engine: EngineName, runs: &[Run]) -> Result<(), ArchiveError> {
        let mut names = Vec::new();
        for run in runs {
            let name = name(engine, &run.case);
            self.archive.save(&name, run)?;
            names.push(self.archive.root().join(name));
        }
        let directory = self.archive.root().join(engine.as_str());
        let entries = std::fs::read_dir(&directory).map_err(ArchiveError::reading(&directory))?;
        for entry in entries.flatten() {
            let path = entry.path();
            if !names.contains(&path) {
                std::fs::remove_dir_all(&path).map_err(ArchiveError::writing(&path))?;
            }
        }
        Ok(())
    }
}

/// Refuses what was made with another deck than today's.
fn up_to_date(
    engine: EngineName,
    case: &Case,
    path: PathBuf,
    provenance: &Provenance,
) -> Result<(), RecordedError> {
    let (recorded, current) = (provenance.deck_hash.clone(), engine.deck_hash(case));
    if recorded == current {
        return Ok(());
    }
    Err(RecordedError::OtherDeck {
        engine,
        path,
        recorded,
        current,
    })
}

fn name(engine: EngineName, case: &Case) -> PathBuf {
    let stack = &case.stack;
    let hash = &case.content_hash()[..12];
    let case = format!(
        "mu-{}_stiffness-{}_{hash}",
        stack.floor_friction, stack.stiffness
    );
    Path::new(engine.as_str()).join(case)
}
