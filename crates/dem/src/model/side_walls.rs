//! The paper's preparation: side walls hold the bottom cylinders while the top one is put on them.

use super::{InvalidValue, positive, within};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Largest push, up to which the bottom cylinders can give way without meeting under the top one.
const FARTHEST_PUSH: f64 = 0.5;
const FASTEST: f64 = 1.0;
/// Height above its final position, in r, from which the top cylinder is lowered; the fall is rounded to whole steps.
/// Nothing touches the cylinder on its way, so the height has no effect on the result.
const LOWERED_BY: f64 = 0.2;

/// Preparation between side walls (paper, supplement I.B), in every code in the same way:
///
/// 1. The bottom cylinders lie on the floor at x = ±1, y = 1 − ε, at rest under gravity. The top cylinder is
///    held above them. Frictionless vertical walls, just touching at x = ±2, move inwards by A at the
///    withdrawal speed; the bottom cylinders roll. Rest. Springs wall–3–2–wall then share 2A, so that
///    x₂ = 1 − A/3 and c = 2A/3, without tangential force.
/// 2. The top cylinder moves down at the constant speed v_fall, whatever pulls at it, until it just touches
///    a bottom cylinder that lies at (1 − A/3, 1 − ε). There it is let go with `landing_speed`. Rest.
/// 3. The walls move outwards at the withdrawal speed, over `withdrawal`, and are then taken away. Rest.
///
/// The paper says "released at a constant falling speed" and leaves open whether the cylinder still has that
/// speed when it touches. At v_fall = 0.1 an impact would press it in by ten times what its weight does at
/// 1/ε = 100, and throw it 25 r up at 10⁴; the default is therefore to let it go at rest, and the fall
/// speed itself decides nothing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideWalls<N = f64> {
    /// A, how far each wall moves inwards, in r.
    pub push: N,
    /// v_fall, speed at which the top cylinder is lowered, in r √(k_n/m).
    pub fall_speed: N,
    /// Speed with which it is let go where it touches, in r √(k_n/m): 0, or up to `fall_speed`.
    pub landing_speed: N,
    /// v_wall, speed of the walls, inwards and outwards, in r √(k_n/m).
    pub withdrawal_speed: N,
    /// Distance that each wall moves outwards, in r; more than A, so that it ends without contact.
    pub withdrawal: N,
    /// Duration of the rest after the push and of the rest under the top cylinder, each, in √(m/k_n).
    pub settle_time: N,
    /// Duration of the rest after the walls are gone, in √(m/k_n).
    pub rest_time: N,
}

/// The preparation between side walls counted in time steps, as every code runs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SideWallSteps {
    /// The preparation that is counted.
    pub walls: SideWalls,
    /// Speed at which the walls move inwards, so that they reach A in whole steps: the withdrawal speed up to that
    /// rounding; 0 where A = 0.
    pub push_speed: f64,
    /// Distance by which the top cylinder is lowered.
    pub fall: f64,
    /// Steps during which the walls move inwards; 0 where A = 0.
    pub push_steps: u64,
    /// Steps at rest after the push, the top cylinder still held.
    pub hold_steps: u64,
    /// Steps during which the top cylinder is lowered.
    pub fall_steps: u64,
    /// Steps at rest under the top cylinder.
    pub settle_steps: u64,
    /// Steps during which the walls move outwards.
    pub withdrawal_steps: u64,
    /// Steps at rest without walls.
    pub rest_steps: u64,
}

impl SideWallSteps {
    /// Total number of steps.
    pub fn total(&self) -> u64 {
        let until_settled = self.push_steps + self.hold_steps + self.fall_steps + self.settle_steps;
        until_settled + self.withdrawal_steps + self.rest_steps
    }

    /// Height of the top cylinder where it just touches both others, which lie at ±(1 − A/3) and 1 − ε.
    pub fn landing_height(&self, epsilon: f64) -> f64 {
        let half_distance = 1.0 - self.walls.push / 3.0;
        (1.0 - epsilon) + (4.0 - half_distance * half_distance).sqrt()
    }
}

impl SideWalls {
    /// v_fall of the paper (supplement I.B).
    pub(crate) const PAPER_FALL_SPEED: f64 = 0.1;
    /// v_wall of the paper (supplement I.B).
    pub(crate) const PAPER_WITHDRAWAL_SPEED: f64 = 1e-3;

    /// The paper's preparation for stacks of stiffness 1/ε, with walls pushed in by A = `push`.
    ///
    /// The walls are withdrawn by A + 4ε; the bottom cylinders follow by about A/3 + 0.2 ε. After rests of 400 time
    /// units the stack rings by less than 10⁻⁹ of its weight.
    pub fn paper(push: f64, epsilon: f64) -> Self {
        const BEYOND: f64 = 4.0;
        const REST: f64 = 400.0;
        Self {
            push,
            fall_speed: Self::PAPER_FALL_SPEED,
            landing_speed: 0.0,
            withdrawal_speed: Self::PAPER_WITHDRAWAL_SPEED,
            withdrawal: push + BEYOND * epsilon,
            settle_time: REST,
            rest_time: REST,
        }
    }

    /// Counts every duration in steps of `time_step`; `rounded` rounds to whole units, at least one.
    pub(super) fn steps(&self, time_step: f64, rounded: impl Fn(f64) -> u64) -> SideWallSteps {
        let pushes = self.push > 0.0;
        let push_steps = if pushes {
            rounded(self.push / self.withdrawal_speed)
        } else {
            0
        };
        let push_time = push_steps as f64 * time_step;
        let fall_steps = rounded(LOWERED_BY / self.fall_speed);
        SideWallSteps {
            walls: *self,
            push_speed: if pushes { self.push / push_time } else { 0.0 },
            fall: self.fall_speed * (fall_steps as f64 * time_step),
            push_steps,
            hold_steps: rounded(self.settle_time),
            fall_steps,
            settle_steps: rounded(self.settle_time),
            // One more unit, so that rounding does not leave the walls in contact.
            withdrawal_steps: rounded(self.withdrawal / self.withdrawal_speed) + rounded(0.0),
            rest_steps: rounded(self.rest_time),
        }
    }

    /// Checks every value, and that no phase is longer than `longest`; the error names the first that is out of range.
    pub(super) fn validate(&self, longest: f64) -> Result<(), InvalidValue> {
        let key = |name: &str| format!("protocol.preparation.{name}");
        within(&key("push"), self.push, 0.0, FARTHEST_PUSH)?;
        positive(&key("fall_speed"), self.fall_speed, FASTEST)?;
        let landing = self.landing_speed;
        within(&key("landing_speed"), landing, 0.0, self.fall_speed)?;
        positive(&key("withdrawal_speed"), self.withdrawal_speed, FASTEST)?;
        if !(self.withdrawal > self.push && self.withdrawal <= 2.0 * FARTHEST_PUSH) {
            let accepted = format!(
                "a number above the push {}, at most {}",
                self.push,
                2.0 * FARTHEST_PUSH
            );
            return Err(InvalidValue::new(
                &key("withdrawal"),
                self.withdrawal,
                accepted,
            ));
        }
        positive(&key("settle_time"), self.settle_time, longest)?;
        positive(&key("rest_time"), self.rest_time, longest)?;
        for (name, speed, way) in [
            ("fall_speed", self.fall_speed, LOWERED_BY),
            ("withdrawal_speed", self.withdrawal_speed, self.withdrawal),
        ] {
            within(&key(name), speed, way / longest, FASTEST)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn invalid_key(change: impl Fn(&mut SideWalls)) -> String {
        let mut walls = SideWalls::paper(0.01, 0.01);
        change(&mut walls);
        walls.validate(1e6).unwrap_err().key
    }

    #[test]
    fn the_paper_s_preparation_is_valid_at_any_push_and_stiffness() {
        for push in [0.0, 1e-6, 0.05, 0.5] {
            for epsilon in [1e-8, 1e-2, 0.1] {
                assert_eq!(SideWalls::paper(push, epsilon).validate(1e6), Ok(()));
            }
        }
    }

    #[test]
    fn every_value_out_of_range_is_refused_by_name() {
        type Change = fn(&mut SideWalls);
        let cases: [(&str, Change); 8] = [
            ("push", |walls| walls.push = -1e-3),
            ("push", |walls| walls.push = f64::NAN),
            ("fall_speed", |walls| walls.fall_speed = 0.0),
            ("landing_speed", |walls| walls.landing_speed = 0.2),
            ("withdrawal_speed", |walls| walls.withdrawal_speed = 1e-30),
            ("withdrawal", |walls| walls.withdrawal = walls.push),
            ("settle_time", |walls| walls.settle_time = 0.0),
            ("rest_time", |walls| walls.rest_time = f64::INFINITY),
        ];
        for (name, change) in cases {
            assert_eq!(invalid_key(change), format!("protocol.preparation.{name}"));
        }
    }

    fn steps(walls: SideWalls) -> SideWallSteps {
        walls.steps(0.1, |time| ((time / 2.0).round() as u64).max(1) * 20)
    }

    #[test]
    fn the_walls_come_to_the_push_in_whole_steps() {
        let steps_at = |push: f64| steps(SideWalls::paper(push, 0.01));
        let counted = steps_at(0.0041);
        assert_eq!(counted.push_steps, 40);
        assert_eq!(counted.fall_steps, 20);
        assert_eq!(counted.withdrawal_steps, 460);
        assert_eq!(counted.total(), 40 + 20 + 460 + 3 * 4000);
        assert!((counted.push_speed * 4.0 - 0.0041).abs() < 1e-17);
        assert!((counted.fall - 0.2).abs() < 1e-16);
        assert_eq!(steps_at(0.0).push_steps, 0);
        assert_eq!(steps_at(0.0).push_speed, 0.0);
    }

    #[test]
    fn the_top_cylinder_is_let_go_at_distance_two_from_both() {
        let height = |push: f64| steps(SideWalls::paper(push, 0.01)).landing_height(0.01);
        let rise = height(0.06) - 0.99;
        assert!((0.98f64.hypot(rise) - 2.0).abs() < 1e-15);
        assert!((height(0.0) - 0.99 - 3f64.sqrt()).abs() < 1e-15);
    }
}
