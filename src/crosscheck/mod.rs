//! From a list of stacks to a table of verdicts: plan, run, extrapolate, judge.

mod extrapolate;
mod measure;
mod plan;
mod probing;
mod recorded;
mod schedule;
mod store;
mod verdict;

pub use extrapolate::{Budget, Extrapolation, extrapolate};
pub use measure::{Judgement, measure};
pub use plan::{
    Measurement, NoYield, Profile, no_yield, plan, planned_protocol, protocol_at_speed,
    yielding_frictions,
};
pub use probing::{ProbeError, Probed, contradictions, probe_all, record_probe};
pub use recorded::{Recorded, RecordedError};
pub use schedule::{Participant, Progress, RunError, Settings, run_all};
pub use store::Store;
pub use verdict::{BAR, FLOOR, Row, Source};
