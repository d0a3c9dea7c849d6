//! From a list of stacks to a table of verdicts: plan, run, extrapolate, judge. And whole series beside
//! those of a native twin.

mod evidence;
mod extrapolate;
mod measure;
mod plan;
mod probing;
mod profile;
mod reading;
mod recorded;
mod regimes;
mod runs;
mod schedule;
mod touch;
mod trajectory;
mod twin;
mod verdict;

pub use evidence::Evidence;
pub use extrapolate::{Budget, Extrapolation, Order, extrapolate};
pub use measure::{Judgement, measure, peak_allowance};
pub use plan::{
    Measurement, Method, NoYield, PAPER_TIME_STEP, PAPER_WALL_SPEED, no_yield, plan, plan_literal,
    planned_protocol, protocol_at_speed, yielding_frictions,
};
pub use probing::{
    Findings, ProbeError, Probed, contradictions, is_contradicted, probe_all, record_probe,
};
pub use profile::{PAPER_STIFFNESSES, Profile};
pub use reading::{Load, read_all};
pub use recorded::{Recorded, RecordedError};
pub use regimes::{
    Confirmation, Examination, Side, Survey, THREE_DIGITS, confirm, examine, examined_stacks,
    survey,
};
pub use runs::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN};
pub use schedule::{Participant, Progress, RunError, Settings, Workload, run_all};
pub use touch::gentle_speed;
pub use trajectory::{
    Branch, Comparison, DEVIATIONS, Distance, Documented, DocumentedOrder, FORCE_BAR, Milestones,
    ORDER_TOLERANCE, Quantity, TIME_STEPS, Trajectory, TrajectoryJudgement, TrajectoryRow, Twin,
    TwinRuns, WALL_SPEED, documented, measure_trajectories, plan_trajectory, trajectory_stack,
};
pub use twin::{TwinForce, measure_with_twin};
pub use verdict::{BAR, FLOOR, Row, Source};
