//! Options that make a run shorter. Their effect on the result has to be measured; runs to the letter of the protocol
//! have none.

use super::{InvalidValue, within};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest accepted factor; beyond it the first touch of the wall is a blow.
const LARGEST_FACTOR: f64 = 1000.0;

/// How the compression is made shorter. Offered by the native code.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Shortcuts {
    /// Factor by which the wall is faster at first, 1 or more.
    pub speed_factor: f64,
    /// Wall travel, in r, by which it has slowed down, as smoothly as gravity rises.
    pub fast_until_travel: f64,
    /// Drop of the wall force, relative to its largest value, that ends the run at a fine row; 0 for none.
    pub stop_at_drop: f64,
}

impl Shortcuts {
    /// Time in which the wall slows down, in √(m/k_n). It is several times the ringing time of the stack, so that
    /// the floor does not slide.
    pub(crate) const SLOWING_TIME: f64 = 50.0;

    /// A wall that is up to ten times as fast, but not faster than `fastest_wall`, for four fifths of the travel to
    /// the predicted yield, half of which is for slowing down. Then it moves at the given speed, and the run ends at
    /// the drop. `None` where this saves nothing.
    pub fn towards(predicted_travel: f64, wall_speed: f64, fastest_wall: f64) -> Option<Self> {
        const LARGEST: f64 = 10.0;
        let fast_until_travel = 0.8 * predicted_travel;
        let mean_while_slowing = 0.5 * fast_until_travel / Self::SLOWING_TIME;
        let fastest = (2.0 * mean_while_slowing - wall_speed).min(fastest_wall);
        let speed_factor = (fastest / wall_speed).min(LARGEST);
        (speed_factor > 1.0).then_some(Self {
            speed_factor,
            fast_until_travel,
            stop_at_drop: 0.02,
        })
    }

    /// Checks every value; the error names the first that is out of range.
    ///
    /// `shortest` is the distance in which the wall slows down.
    pub(super) fn validate(&self, shortest: f64, wall_travel: f64) -> Result<(), InvalidValue> {
        let key = |name: &str| format!("protocol.shortcuts.{name}");
        within(&key("speed_factor"), self.speed_factor, 1.0, LARGEST_FACTOR)?;
        let until = self.fast_until_travel;
        within(&key("fast_until_travel"), until, shortest, wall_travel)?;
        within(&key("stop_at_drop"), self.stop_at_drop, 0.0, 0.9)
    }
}
