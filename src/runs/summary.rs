//! The summary of a run, kept where its series is not.

use super::{Reading, Recorded, RecordedError, Store};
use crate::code::{Code, Identity, InstalledCode, Provenance, Run};
use crate::files::FileError;
use crate::model::{Case, sha256_hex};
use crate::series::{Mechanics, YieldEstimates};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Digest of the sources that read a summary off a series.
pub(super) static ESTIMATOR: LazyLock<String> = LazyLock::new(|| {
    let sources = [
        include_str!("../model/law/contact_law.rs"),
        include_str!("../model/law/damping.rs"),
        include_str!("../model/law/power.rs"),
        include_str!("../model/law/tangential.rs"),
        include_str!("../series/differences.rs"),
        include_str!("../series/digits.rs"),
        include_str!("../series/drop.rs"),
        include_str!("../series/estimate.rs"),
        include_str!("../series/mechanics.rs"),
        include_str!("../series/oscillator.rs"),
        include_str!("../series/pair_contact.rs"),
        include_str!("../series/polynomial.rs"),
        include_str!("../series/reported.rs"),
        include_str!("../series/sample.rs"),
        include_str!("../series/samples.rs"),
        include_str!("summary.rs"),
    ];
    sha256_hex(sources.concat().as_bytes())
});

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
    /// c, without damping, between the bottom cylinders when the compression begins, in m g; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact_force: Option<f64>,
    /// x₂, y₁ and y₂ when the compression begins, in r; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<[f64; 3]>,
    /// The largest deviation from each law of mechanics; absent from older recordings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mechanics: Option<Mechanics>,
    /// The columns that the code does not report.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absent: Vec<String>,
}

impl RunSummary {
    /// The summary of `run`.
    pub fn new(run: Run) -> Self {
        let stack = &run.case.stack;
        let law = run.case.convention.law(stack.stiffness_ratio);
        let samples = run.series.samples();
        let (first, last) = (samples.first(), samples.last());
        Self {
            estimates: YieldEstimates::read(&run.series, &run.case),
            last_force: last.map_or(0.0, |sample| sample.wall_force * stack.stiffness),
            mechanics: Some(Mechanics::read(&run.series, &run.case)),
            start: first
                .map(|sample| {
                    let contact = sample.first(stack);
                    [contact.outwards, sample.top(stack)[1], contact.height]
                })
                .filter(|start| !start.iter().any(|place| place.is_nan())),
            contact_force: first
                .map(|sample| law.force(sample.bottom_overlap(stack)) * stack.stiffness)
                .filter(|force| !force.is_nan()),
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

    fn recorded(case: &Case, code: Code, recorded: &Recorded) -> Result<Self, RecordedError> {
        recorded.summary(code, case)
    }
}
