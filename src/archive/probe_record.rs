//! Micro-tests with their outcomes, kept so that a code need not be probed twice.

use super::{ArchiveError, Provenance, write_atomically};
use crate::stack::ContactTest;
use crate::trace::Motion;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a code answered to micro-tests.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeRecord {
    /// Who answered, how and when.
    pub provenance: Provenance,
    /// Each micro-test and its outcome.
    pub outcomes: Vec<(ContactTest, Motion)>,
}

impl ProbeRecord {
    /// Reads the record at `path`; `None` if there is none.
    ///
    /// # Errors
    /// If it is there but damaged.
    pub fn load(path: &Path) -> Result<Option<Self>, ArchiveError> {
        let text = match std::fs::read(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(ArchiveError::reading(path))?,
        };
        let record: Self =
            serde_json::from_slice(&text).map_err(|error| ArchiveError::Provenance {
                path: path.to_owned(),
                message: error.to_string(),
            })?;
        for (test, motion) in &record.outcomes {
            Motion::new(motion.rows().to_vec(), test.steps).map_err(|source| {
                ArchiveError::Series {
                    path: path.to_owned(),
                    source,
                }
            })?;
        }
        Ok(Some(record))
    }

    /// Writes the record to `path`.
    ///
    /// # Errors
    /// If the file system refuses; an older record is then untouched.
    pub fn save(&self, path: &Path) -> Result<(), ArchiveError> {
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent).map_err(ArchiveError::writing(parent))?;
        }
        let json = serde_json::to_string(self).expect("plain data has a JSON form");
        write_atomically(path, (json + "\n").as_bytes())
    }

    /// The outcomes of `tests`, in their order, if every one of them is there.
    pub fn answer(&self, tests: &[ContactTest]) -> Option<Vec<Motion>> {
        let answers = tests.iter().map(|test| {
            let mut known = self.outcomes.iter();
            let found = known.find(|(known, _)| known == test);
            found.map(|(_, motion)| motion.clone())
        });
        answers.collect()
    }
}
