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
use crate::stack::Stack;
use crate::theory::Outcome;

/// Relative growth of gravity per unit time. Inertia shifts the ratios of forces by about its square.
const GRAVITY_RATE: f64 = 2e-3;
/// Time step, unless the stack needs a shorter one.
const TIME_STEP: f64 = 0.1;

/// A loading that takes `stack` to its predicted end, a little further than `travel`, the wall moving by
/// `speed` times the predicted displacement per unit time.
fn loading(stack: &Stack, outcome: &Outcome, speed: f64, further: f64) -> Loading {
    let last = &outcome.last;
    // A stack that falls under its own weight would be under the wall if the prediction were wrong.
    let travel = if last.wall_travel > 0.0 {
        last.wall_travel
    } else {
        last.floor_overlap.max(stack.epsilon())
    };
    let wall_speed = speed * travel.min(last.floor_overlap.max(stack.epsilon()));
    Loading {
        gravity_rate: GRAVITY_RATE,
        wall_speed,
        wall_travel: further * travel,
        time_step: TIME_STEP.min(stack.longest_time_step()),
    }
}
