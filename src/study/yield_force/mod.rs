//! The yield force at vanishing wall speed: plan, extrapolate, judge.

mod evidence;
mod extrapolate;
mod judgement;
mod plan;
mod profile;
mod runs;
mod touch;
mod twin;

pub use evidence::Evidence;
pub use extrapolate::{Budget, BudgetPart, ConvergenceOrder, Extrapolation, extrapolate};
pub use judgement::{Judgement, YieldForce, peak_allowance};
pub use plan::{
    Measurement, Method, NoYield, PAPER_TIME_STEP, PAPER_WALL_SPEED, no_yield, plan, plan_literal,
    planned_protocol, protocol_at_speed, yielding_frictions,
};
pub use profile::{PAPER_STIFFNESSES, Profile};
pub use runs::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN, SPEEDS};
pub use touch::max_touch_speed;
pub use twin::{TwinForce, measure_with_twin};
