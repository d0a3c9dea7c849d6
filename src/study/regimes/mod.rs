//! The regime map against the native DEM: which event comes first on either side of every boundary, and
//! what the events do.

mod confirm;
mod examine;
mod parallel;
mod survey;

pub use confirm::{Confirmation, Side, THREE_DIGITS, confirm};
pub use examine::{Examination, examine, examined_stacks};
pub use survey::{Survey, survey};

use crate::dem::Loading;
use crate::model::Stack;
use crate::theory::CriticalState;

/// Relative growth of gravity per unit time. Inertia shifts the ratios of forces by about its square.
const GRAVITY_RATE: f64 = 2e-3;
/// Time step, unless the stack needs a shorter one.
const TIME_STEP: f64 = 0.1;

/// A loading of `stack` until somewhat after `critical_state`, by a part `further` − 1 of wall travel and overlap,
/// the wall moving by `speed` times the predicted displacement per unit time.
fn loading(stack: &Stack, critical_state: &CriticalState, speed: f64, further: f64) -> Loading {
    let overlap = critical_state.floor_overlap.max(stack.epsilon());
    // A stack that falls under its own weight gets under the wall if the prediction is wrong.
    let travel = if critical_state.wall_travel > 0.0 {
        critical_state.wall_travel
    } else {
        overlap
    };
    Loading {
        gravity_rate: GRAVITY_RATE,
        wall_speed: speed * travel.min(overlap),
        wall_travel: further * travel + (further - 1.0) * overlap,
        time_step: TIME_STEP.min(stack.longest_time_step()),
    }
}
