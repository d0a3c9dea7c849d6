//! From a list of stacks to a table of verdicts: plan, run, extrapolate, judge.

mod extrapolate;
mod measure;
mod plan;
mod recorded;
mod regimes;
mod schedule;
mod store;
mod verdict;

pub use extrapolate::{Budget, Extrapolation, extrapolate};
pub use measure::{Judgement, measure};
pub use plan::{
    Measurement, NoYield, Profile, no_yield, plan, planned_protocol, protocol_at_speed,
    yielding_frictions,
};
pub use recorded::{Recorded, RecordedError};
pub use regimes::{
    Confirmation, Examination, Side, Survey, THREE_DIGITS, confirm, examine, examined_stacks,
    survey,
};
pub use schedule::{Participant, Progress, RunError, Settings, run_all};
pub use store::Store;
pub use verdict::{BAR, FLOOR, Row, Source, Verdict};
