//! The rates at which stacks are loaded.

use crate::dem::Loading;
use crate::model::{ContactConvention, Stack};
use crate::theory::CriticalState;

/// Relative growth of gravity per unit time. Inertia shifts the ratios of forces by about its square.
const GRAVITY_RATE: f64 = 2e-3;
/// Time step, unless the stack needs a shorter one.
const TIME_STEP: f64 = 0.1;

/// Returns a loading of `stack` to somewhat beyond `critical_state`: the wall travels on by a fraction `further` − 1
/// of travel plus overlap, at `speed` times the predicted displacement per unit time.
pub(super) fn loading(
    stack: &Stack,
    critical_state: &CriticalState,
    speed: f64,
    further: f64,
) -> Loading {
    let overlap = critical_state.floor_overlap.max(stack.epsilon());
    // A stack that falls under its own weight reaches the wall phase if the prediction is wrong.
    let travel = if critical_state.wall_travel > 0.0 {
        critical_state.wall_travel
    } else {
        overlap
    };
    Loading {
        gravity_rate: GRAVITY_RATE,
        wall_speed: speed * travel.min(overlap),
        wall_travel: further * travel + (further - 1.0) * overlap,
        time_step: TIME_STEP.min(stack.longest_time_step(&ContactConvention::TURNING)),
    }
}
