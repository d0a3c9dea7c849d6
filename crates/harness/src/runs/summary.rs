//! The summary of a run, which takes the place of its series where that is not kept or not read.

use super::{Reading, Recorded, RecordedError, Store};
use crate::code::{Code, Identity, InstalledCode, Provenance, Run};
use crate::files::FileError;
use crate::model::Case;
use crate::series::{Mechanics, RigidReading, Summary, YieldEstimates};
use serde::{Deserialize, Serialize};

/// The yield force of a run by both estimators, and its provenance: a hundredth of its series in size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunSummary {
    /// The case.
    pub case: Case,
    /// Its origin.
    pub provenance: Provenance,
    /// The yield force by both estimators.
    pub estimates: YieldEstimates,
    /// Wall force at the end, in m g.
    pub last_force: f64,
    /// Contact force c between the bottom cylinders, without damping, when the compression begins, in m g; absent
    /// from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_force: Option<f64>,
    /// x₂, y₁ and y₂ when the compression begins, in r; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<[f64; 3]>,
    /// The largest deviation from each law of mechanics; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mechanics: Option<Mechanics>,
    /// What the series of a rigid stack shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rigid: Option<RigidReading>,
    /// The columns that the code does not report.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absent: Vec<String>,
}

impl RunSummary {
    /// Summarises `run`.
    pub fn new(run: Run) -> Self {
        let read = Summary::read(&run.series, &run.case);
        Self {
            estimates: read.estimates,
            last_force: read.last_force,
            mechanics: Some(read.mechanics),
            start: read.start,
            contact_force: read.contact_force,
            rigid: read.rigid,
            absent: run
                .series
                .absent()
                .iter()
                .map(|&name| name.to_owned())
                .collect(),
            case: run.case,
            provenance: run.provenance,
        }
    }
}

impl Reading for RunSummary {
    type Task = Case;

    fn of(run: Run) -> Self {
        Self::new(run)
    }

    fn identity(&self) -> &Identity {
        &self.provenance.identity
    }

    fn stored(
        case: &Case,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<Self>, FileError> {
        store.summary(code.identity(), case, &code.name().deck_hash(case))
    }

    fn recorded(case: &Case, code: &Code, recorded: &Recorded) -> Result<Self, RecordedError> {
        recorded.summary(code, case)
    }
}
