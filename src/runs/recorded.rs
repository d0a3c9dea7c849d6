//! Recorded runs, which stand in for codes that are not installed.

use crate::code::Code;
use crate::code::{Provenance, Run};
use crate::files::FileError;
use crate::model::{Case, shown};
use crate::runs::{Archive, ProbeRecord, RunSummary};
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
    #[error("{code} is not installed, and there is no recorded run at {}; install it ({}), record it where it is installed (tristack record --codes {code}), or let TRISTACK_REFERENCE name the directory of the recorded runs", shown(path), code.installation_hint())]
    Absent {
        /// The code.
        code: Code,
        /// Where the run would be.
        path: PathBuf,
    },
    /// It was made with another deck than today's.
    #[error(
        "the recorded run {} was made with another deck (hash {recorded}, now {current}); refresh it with: tristack record --codes {code}",
        shown(path)
    )]
    OtherDeck {
        /// The code.
        code: Code,
        /// The recorded run.
        path: PathBuf,
        /// Deck hash it was made with.
        recorded: String,
        /// Deck hash of this version of tristack.
        current: String,
    },
    /// It cannot be read.
    #[error(transparent)]
    Damaged(#[from] FileError),
}

impl Recorded {
    /// Recorded runs below `root`.
    pub fn new(root: &Path) -> Self {
        Self {
            archive: Archive::new(root),
        }
    }

    /// The recorded run of `case` by `code`.
    ///
    /// # Errors
    /// If there is none, or it is damaged, or it was made with another deck.
    pub fn get(&self, code: Code, case: &Case) -> Result<Run, RecordedError> {
        let name = name(code, case);
        let path = self.archive.root().join(&name);
        let of_trajectories = Path::new("trajectories").join(&name);
        let run = match self.archive.load(&name)? {
            None => self.archive.load(&of_trajectories)?,
            run => run,
        };
        let Some(run) =
            run.filter(|run| run.case == *case && run.provenance.identity.code == code.as_str())
        else {
            return Err(RecordedError::Absent { code, path });
        };
        up_to_date(code, case, path, &run.provenance)?;
        Ok(run)
    }

    /// What was read off the recorded runs of `code` whose series are not kept.
    ///
    /// # Errors
    /// If the record is damaged.
    pub fn summaries(&self, code: Code) -> Result<Vec<RunSummary>, FileError> {
        RunSummary::load_all(&self.readings_path(code))
    }

    /// `summary` of `case`, if it was made with today's deck.
    ///
    /// # Errors
    /// If it was not.
    pub fn unless_outdated(
        &self,
        code: Code,
        case: &Case,
        summary: RunSummary,
    ) -> Result<RunSummary, RecordedError> {
        let path = self.readings_path(code);
        up_to_date(code, case, path, &summary.provenance)?;
        Ok(summary)
    }

    /// Records `summaries` of `code` in place of older ones.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn replace_summaries(&self, code: Code, summaries: &[RunSummary]) -> Result<(), FileError> {
        RunSummary::save_all(&self.readings_path(code), summaries)
    }

    fn readings_path(&self, code: Code) -> PathBuf {
        let name = format!("{code}.jsonl");
        self.archive.root().join("summaries").join(name)
    }

    /// The recorded probe of `code`.
    ///
    /// # Errors
    /// If there is none, or it is damaged, or a micro-test was put with another deck, other parameters or
    /// arguments.
    pub fn probe(&self, code: Code) -> Result<ProbeRecord, RecordedError> {
        let path = self.probe_path(code);
        let record = ProbeRecord::load(&path)?;
        let own = |record: &ProbeRecord| record.provenance.identity.code == code.as_str();
        let Some(record) = record.filter(own) else {
            return Err(RecordedError::Absent { code, path });
        };
        if let Some(answer) = record.outdated(|test| code.deck_hash(test)) {
            return Err(RecordedError::OtherDeck {
                code,
                path,
                recorded: answer.input_hash.clone(),
                current: code.deck_hash(&answer.test),
            });
        }
        Ok(record)
    }

    /// Records the probe of `code` in place of an older one.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn replace_probe(&self, code: Code, record: &ProbeRecord) -> Result<(), FileError> {
        record.save(&self.probe_path(code))
    }

    fn probe_path(&self, code: Code) -> PathBuf {
        let name = format!("{code}.json");
        self.archive.root().join("probes").join(name)
    }

    /// Records `runs` of `code` in place of everything recorded of it before.
    ///
    /// # Errors
    /// If they cannot be written; the older recordings are removed last.
    pub fn replace(&self, code: Code, runs: &[Run]) -> Result<(), FileError> {
        let mut names = Vec::new();
        for run in runs {
            let name = name(code, &run.case);
            self.archive.save(&name, run)?;
            names.push(self.archive.root().join(name));
        }
        let directory = self.archive.root().join(code.as_str());
        let entries = std::fs::read_dir(&directory).map_err(FileError::reading(&directory))?;
        for entry in entries.flatten() {
            let path = entry.path();
            if !names.contains(&path) {
                std::fs::remove_dir_all(&path).map_err(FileError::writing(&path))?;
            }
        }
        Ok(())
    }
}

/// Refuses what was made with another deck than today's.
fn up_to_date(
    code: Code,
    case: &Case,
    path: PathBuf,
    provenance: &Provenance,
) -> Result<(), RecordedError> {
    let (recorded, current) = (provenance.deck_hash.clone(), code.deck_hash(case));
    if recorded == current {
        return Ok(());
    }
    Err(RecordedError::OtherDeck {
        code,
        path,
        recorded,
        current,
    })
}

fn name(code: Code, case: &Case) -> PathBuf {
    let stack = &case.stack;
    let hash = &case.content_hash()[..12];
    let case = format!(
        "mu-{}_stiffness-{}_{hash}",
        stack.floor_friction, stack.stiffness
    );
    Path::new(code.as_str()).join(case)
}
