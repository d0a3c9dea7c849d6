//! What is kept of a run when its series is not.

use super::{ArchiveError, Provenance, Run, write_atomically};
use crate::stack::Case;
use crate::trace::YieldEstimates;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A run, read: the yield force by both estimators, and where it comes from. A hundredth of its series in size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// What was run.
    pub case: Case,
    /// Who ran it, how, and when.
    pub provenance: Provenance,
    /// What was read off the series.
    pub estimates: YieldEstimates,
    /// Wall force at the end, in m g.
    pub last_force: f64,
    /// c between the bottom cylinders when the compression begins, in m g; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_force: Option<f64>,
}

impl Reading {
    /// What is to be read off `run`.
    pub fn new(run: Run) -> Self {
        let stack = &run.case.stack;
        let samples = run.trace.samples();
        let (first, last) = (samples.first(), samples.last());
        Self {
            estimates: YieldEstimates::read(&run.trace, stack),
            last_force: last.map_or(0.0, |sample| sample.wall_force * stack.stiffness),
            contact_force: first.map(|sample| sample.bottom_contact_force() * stack.stiffness),
            case: run.case,
            provenance: run.provenance,
        }
    }

    /// The readings in the file at `path`, one JSON object a line; none if there is no such file.
    ///
    /// # Errors
    /// If it is there but damaged; the error names the line.
    pub fn load_all(path: &Path) -> Result<Vec<Self>, ArchiveError> {
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            read => read.map_err(ArchiveError::reading(path))?,
        };
        Self::parse_all(&text, path)
    }

    /// The readings in the `text` of the file at `path`.
    ///
    /// # Errors
    /// If it is damaged; the error names the line.
    pub fn parse_all(text: &str, path: &Path) -> Result<Vec<Self>, ArchiveError> {
        let parsed = text.lines().enumerate().map(|(index, line)| {
            Self::parse(line).map_err(|message| ArchiveError::Provenance {
                path: path.to_owned(),
                message: format!("line {}: {message}", index + 1),
            })
        });
        parsed.collect()
    }

    fn parse(line: &str) -> Result<Self, String> {
        let reading: Self = serde_json::from_str(line).map_err(|error| error.to_string())?;
        reading
            .case
            .validate()
            .map_err(|invalid| invalid.to_string())?;
        Ok(reading)
    }

    /// Writes `readings` to the file at `path`, in place of an older one.
    ///
    /// # Errors
    /// If the file system refuses; an older file is then untouched.
    pub fn save_all(path: &Path, readings: &[Self]) -> Result<(), ArchiveError> {
        let lines = readings.iter().map(|reading| {
            serde_json::to_string(reading).expect("plain data has a JSON form") + "\n"
        });
        write_atomically(path, lines.collect::<String>().as_bytes())
    }
}
