//! The yield force at vanishing wall speed: plan, extrapolate, judge.

mod budget;
mod evidence;
mod extrapolate;
mod judgement;
mod law_curve;
mod limits;
mod no_yield;
mod peak;
mod plan;
mod profile;
mod rigid;
mod row;
mod runs;
mod series;
mod symmetry;
mod touch;
mod twin;

pub use budget::{Budget, BudgetPart};
pub use evidence::Evidence;
pub use extrapolate::{ConvergenceOrder, Estimator, Extrapolation, extrapolate};
pub use judgement::{Judgement, YieldForce};
pub use law_curve::{LawCurve, law_curves};
pub use no_yield::{NoYield, no_yield};
pub(crate) use peak::peak_allowance;
pub use plan::{
    Measurement, PAPER_TIME_STEP, PAPER_WALL_SPEED, plan, planned_protocol, protocol_at_speed,
};
pub(crate) use plan::{REST_TIME, largest_levers, planned, ramp_time};
pub use profile::{PAPER_STIFFNESSES, Profile, new_seed};
pub(crate) use rigid::{FELL, JAMMED, ROLLS, STOOD, rigid_case};
pub(crate) use runs::{COARSE_TIME_STEP_RUN, SPEEDS};
pub use runs::{MIDDLE_RUN, Method, RunRoles, SHORT_RAMP_RUN};
pub use series::{FoundSeries, JudgedSeries, SeriesInput, compared_run, judge_series};
pub use touch::max_touch_speed;
pub use twin::{TwinForce, measure_with_twin};
