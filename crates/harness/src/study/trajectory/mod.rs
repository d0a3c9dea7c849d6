//! Compares whole series at a finite wall speed: those of an external code with those of a native twin that has its
//! convention.
//!
//! At a finite speed nothing hides behind a limit: mass, inertia, damping, friction and the history of every
//! contact move the series. If the twin follows the same laws, the distance is round-off, or falls with the
//! time step at the order of the known difference in the algorithms.

mod compare;
mod distance;
mod documented;
mod judge;
mod judgement;
mod plan;

pub use distance::{Branch, Distance, Quantity};
pub use documented::{Documented, DocumentedOrder, documented};
pub use judge::{FORCE_TOLERANCE, ORDER_TOLERANCE};
pub use judgement::{Comparison, TrajectoryFinding, TrajectoryJudgement};
pub use plan::{
    Trajectory, Twin, TwinRuns, WALL_SPEED, plan_trajectory, time_steps, trajectory_stack,
};
