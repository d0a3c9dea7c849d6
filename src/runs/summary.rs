//! What is kept of a run when its series is not.

use crate::code::{Provenance, Run};
use crate::files::{FileError, write_atomically};
use crate::model::Case;
use crate::series::YieldEstimates;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A run, read: the yield force by both estimators, and where it comes from. A hundredth of its series in size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSummary {
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

impl RunSummary {
    /// What is to be read off `run`.
    pub fn new(run: Run) -> Self {
        let stack = &run.case.stack;
        let samples = run.series.samples();
        let (first, last) = (samples.first(), samples.last());
        Self {
            estimates: YieldEstimates::read(&run.series, stack),
            last_force: last.map_or(0.0, |sample| sample.wall_force * stack.stiffness),
            contact_force: first.map(|sample| sample.bottom_contact_force() * stack.stiffness),
            case: run.case,
            provenance: run.provenance,
        }
    }

    /// The summaries in the file at `path`, one JSON object a line; none if there is no such file.
    ///
    /// # Errors
    /// If it is there but damaged; the error names the line.
    pub fn load_all(path: &Path) -> Result<Vec<Self>, FileError> {
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            read => read.map_err(FileError::reading(path))?,
        };
        Self::parse_all(&text, path)
    }

    /// The summaries in the `text` of the file at `path`.
    ///
    /// # Errors
    /// If it is damaged; the error names the line.
    pub fn parse_all(text: &str, path: &Path) -> Result<Vec<Self>, FileError> {
        let parsed = text.lines().enumerate().map(|(index, line)| {
            Self::parse(line).map_err(|message| FileError::Provenance {
                path: path.to_owned(),
                message: format!("line {}: {message}", index + 1),
            })
        });
        parsed.collect()
    }

    fn parse(line: &str) -> Result<Self, String> {
        let summary: Self = serde_json::from_str(line).map_err(|error| error.to_string())?;
        summary
            .case
            .validate()
            .map_err(|invalid| invalid.to_string())?;
        Ok(summary)
    }

    /// Writes `summaries` to the file at `path`, in place of an older one.
    ///
    /// # Errors
    /// If the file system refuses; an older file is then untouched.
    pub fn save_all(path: &Path, summaries: &[Self]) -> Result<(), FileError> {
        let lines = summaries.iter().map(|summary| {
            serde_json::to_string(summary).expect("plain data has a JSON form") + "\n"
        });
        write_atomically(path, lines.collect::<String>().as_bytes())
    }
}
