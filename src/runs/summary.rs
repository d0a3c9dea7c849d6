//! The summary of a run, kept where its series is not.

use crate::code::{Provenance, Run};
use crate::model::Case;
use crate::series::YieldEstimates;
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
    /// c between the bottom cylinders when the compression begins, in m g; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_force: Option<f64>,
}

impl RunSummary {
    /// The summary of `run`.
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
}
