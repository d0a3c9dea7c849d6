//! Preparation, compression and sampling of a run.

use super::shortcuts::Shortcuts;
use super::side_walls::{SideWallSteps, SideWalls};
use super::{InvalidValue, positive, within};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const SMALLEST_TIME_STEP: f64 = 1e-6;
/// Quasi-static loading requires speeds far below the speed of sound, which is of order 1.
const FASTEST_WALL: f64 = 0.01;
/// A little more than the height of the stack.
const LONGEST_TRAVEL: f64 = 4.0;
const LONGEST_TIME: f64 = 1e9;
const MOST_STEPS: f64 = 1e11;
const MOST_ROWS: u64 = 1_000_000;
/// Largest relative change of a duration that counts as rounding.
const ROUNDING: f64 = 1e-9;
/// Largest relative change of a duration that is accepted. It exceeds the effect of any time step on a ramp of 100
/// with rows at intervals of 2, the values that `simulate` chooses.
const MOST_CHANGED: f64 = 0.02;

/// The way in which the stack is brought to rest under gravity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Preparation<N = f64> {
    /// Three just-touching cylinders, stress free; gravity rises from 0 to g as the smooth step
    /// x³(10 − 15x + 6x²) over `ramp_time`, then the stack rests for `rest_time`. Ends with c = 0.
    GravityRamp {
        /// Duration of the ramp, in √(m/k_n).
        ramp_time: N,
        /// Duration of the rest after it, in √(m/k_n).
        rest_time: N,
    },
    /// The paper's protocol (supplement I.B): side walls pushed in by A, the top cylinder lowered, the walls
    /// withdrawn. A determines the final c and the final tangential forces.
    SideWalls(SideWalls<N>),
    /// None: three just-touching rigid cylinders, which rest on each other; gravity is g from the first step on. Their
    /// contacts have no springs, so that the stiffness of the stack is the unit of force alone.
    Rigid,
}

/// A preparation counted in time steps, as every code runs it. Every count is a multiple of
/// [`Schedule::fine_every`]: codes that average over windows need windows that fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PreparationSteps {
    /// Steps of the gravity ramp.
    GravityRamp {
        /// Steps during which gravity rises.
        ramp: u64,
        /// Steps at rest under full gravity.
        rest: u64,
    },
    /// Steps of the preparation between side walls.
    SideWalls(SideWallSteps),
    /// Rigid bodies need no preparation.
    Rigid,
}

impl PreparationSteps {
    /// Number of steps.
    pub fn total(&self) -> u64 {
        match self {
            Self::GravityRamp { ramp, rest } => ramp + rest,
            Self::SideWalls(steps) => steps.total(),
            Self::Rigid => 0,
        }
    }
}

impl Preparation<f64> {
    /// The name on the command line and in case files.
    pub fn as_str(&self) -> &'static str {
        match self {
            Self::GravityRamp { .. } => "gravity-ramp",
            Self::SideWalls(_) => "side-walls",
            Self::Rigid => "rigid",
        }
    }

    fn steps(&self, time_step: f64, rounded: impl Fn(f64) -> u64) -> PreparationSteps {
        match *self {
            Self::GravityRamp {
                ramp_time,
                rest_time,
            } => PreparationSteps::GravityRamp {
                ramp: rounded(ramp_time),
                rest: rounded(rest_time),
            },
            Self::SideWalls(walls) => PreparationSteps::SideWalls(walls.steps(time_step, rounded)),
            Self::Rigid => PreparationSteps::Rigid,
        }
    }

    /// The requested durations, each with its key and the steps that it takes by [`Self::steps`].
    fn durations(&self, steps: &PreparationSteps) -> [(&'static str, f64, u64); 2] {
        const RAMP: &str = "protocol.preparation.ramp_time";
        const REST: &str = "protocol.preparation.rest_time";
        const SETTLE: &str = "protocol.preparation.settle_time";
        match (*self, *steps) {
            (
                Self::GravityRamp {
                    ramp_time,
                    rest_time,
                },
                PreparationSteps::GravityRamp { ramp, rest },
            ) => [(RAMP, ramp_time, ramp), (REST, rest_time, rest)],
            (Self::SideWalls(walls), PreparationSteps::SideWalls(steps)) => [
                (SETTLE, walls.settle_time, steps.settle_steps),
                (REST, walls.rest_time, steps.rest_steps),
            ],
            _ => [(RAMP, 0.0, 0), (REST, 0.0, 0)],
        }
    }

    /// Checks every value, and that no phase is longer than `longest`.
    fn validate(&self, longest: f64) -> Result<(), InvalidValue> {
        match *self {
            Self::GravityRamp {
                ramp_time,
                rest_time,
            } => {
                positive("protocol.preparation.ramp_time", ramp_time, longest)?;
                positive("protocol.preparation.rest_time", rest_time, longest)
            }
            Self::SideWalls(walls) => walls.validate(longest),
            Self::Rigid => Ok(()),
        }
    }
}

/// Rounds `value` to ten digits, which removes the round-off of a product.
fn ten_digits(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

/// x³(10 − 15x + 6x²) at x = step/steps, 1 beyond.
pub fn smooth_step(step: u64, steps: u64) -> f64 {
    if step >= steps {
        return 1.0;
    }
    let x = step as f64 / steps as f64;
    x * x * x * (10.0 - 15.0 * x + 6.0 * (x * x))
}

/// Times at which rows of the time series are taken: coarsely at first, finely around the yield.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sampling<N = f64> {
    /// Time between rows far from the yield, in √(m/k_n).
    pub coarse_interval: N,
    /// Wall travel from which rows are taken finely, in r.
    pub fine_from_travel: N,
    /// Time between rows near the yield, in √(m/k_n).
    pub fine_interval: N,
}

/// One compression run: a preparation, then a frictionless wall that moves down at constant speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// The way in which the stack is brought to rest.
    pub preparation: Preparation,
    /// Time step of the integrator.
    pub time_step: f64,
    /// Speed of the top wall, downwards.
    pub wall_speed: f64,
    /// Total distance that the wall moves.
    pub wall_travel: f64,
    /// Times at which rows are taken.
    pub sampling: Sampling,
    /// Options that make the run shorter, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shortcuts: Option<Shortcuts>,
}

/// The protocol counted in time steps, as every code runs it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// Steps of the preparation.
    pub preparation: PreparationSteps,
    /// Steps of the compression.
    pub compression_steps: u64,
    /// Steps between coarse rows.
    pub coarse_every: u64,
    /// Step of the compression from which rows are fine; a multiple of `coarse_every`.
    pub fine_from_step: u64,
    /// Steps between fine rows.
    pub fine_every: u64,
    /// Steps at the beginning of the compression during which the wall is faster.
    pub fast_steps: u64,
    /// Further steps during which the wall slows down.
    pub slowing_steps: u64,
    /// Drop of the wall force that ends the run, relative to its largest value; 0 for none.
    pub stop_at_drop: f64,
}

impl Schedule {
    /// Steps of the compression at which a row is taken, in order, including the first and the last step.
    pub fn sampled_steps(&self) -> impl Iterator<Item = u64> + use<> {
        let schedule = *self;
        let next = move |step: &u64| schedule.row_from(step + 1);
        std::iter::successors(self.row_from(0), next)
    }

    /// Returns the first step of the compression at or after `step` at which a row is taken.
    pub fn row_from(&self, step: u64) -> Option<u64> {
        if step < self.fine_from_step {
            return Some(
                step.next_multiple_of(self.coarse_every)
                    .min(self.fine_from_step),
            );
        }
        let fine = (step - self.fine_from_step).next_multiple_of(self.fine_every);
        Some(self.fine_from_step + fine).filter(|&row| row <= self.compression_steps)
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        let fine = (self.compression_steps - self.fine_from_step) / self.fine_every;
        self.fine_from_step / self.coarse_every + fine + 1
    }

    /// Number of steps of the run, including the preparation.
    pub fn total_steps(&self) -> u64 {
        self.preparation.total() + self.compression_steps
    }
}

impl Protocol {
    /// The protocol in whole steps, every duration rounded to whole fine intervals.
    pub fn schedule(&self) -> Schedule {
        let fine_every = ((self.sampling.fine_interval / self.time_step).round() as u64).max(1);
        let fine_time = fine_every as f64 * self.time_step;
        let rounded = |time: f64| ((time / fine_time).round() as u64).max(1) * fine_every;
        let coarse_every = rounded(self.sampling.coarse_interval);
        let slowing = self
            .shortcuts
            .map_or(0, |_| rounded(Shortcuts::SLOWING_TIME));
        let slowing_travel = slowing as f64 * self.time_step * self.mean_slowing_speed();
        let fast_steps = self.shortcuts.map_or(0, |shortcuts| {
            let fast_travel = (shortcuts.fast_until_travel - slowing_travel).max(0.0);
            rounded(fast_travel / self.fast_speed())
        });
        let fast_travel = fast_steps as f64 * self.time_step * self.fast_speed();
        let steps_until = |travel: f64| {
            let slow = (travel - fast_travel - slowing_travel).max(0.0) / self.wall_speed;
            fast_steps + slowing + rounded(slow)
        };
        let fine_from_step =
            steps_until(self.sampling.fine_from_travel) / coarse_every * coarse_every;
        let all = steps_until(self.wall_travel);
        Schedule {
            preparation: self.preparation.steps(self.time_step, rounded),
            compression_steps: all.max(fine_from_step + fine_every),
            coarse_every,
            fine_from_step,
            fine_every,
            fast_steps,
            slowing_steps: slowing,
            stop_at_drop: self
                .shortcuts
                .map_or(0.0, |shortcuts| shortcuts.stop_at_drop),
        }
    }

    /// The durations of the preparation that differ from those requested, because these are not whole multiples of the
    /// fine interval in whole steps: key, requested value, and actual value.
    pub fn changed_durations(&self) -> Vec<(&'static str, f64, f64)> {
        let durations = self.preparation.durations(&self.schedule().preparation);
        let durations = durations
            .map(|(key, asked, steps)| (key, asked, ten_digits(steps as f64 * self.time_step)));
        let changed = |(_, asked, made): &(&str, f64, f64)| (made - asked).abs() > ROUNDING * asked;
        durations.into_iter().filter(changed).collect()
    }

    /// Refuses durations that rounding to fine intervals changes by more than the time step could.
    fn validate_durations(&self) -> Result<(), InvalidValue> {
        let fine = self.schedule().fine_every as f64 * self.time_step;
        for (key, asked, made) in self.changed_durations() {
            if (made - asked).abs() > MOST_CHANGED * asked {
                let below = (asked / fine).floor() * fine;
                let below = if below > 0.0 { below } else { fine };
                let accepted = format!(
                    "a multiple of {}, the fine interval of the rows in whole time steps, such as {} or {}; a \
                     smaller protocol.sampling.fine_interval accepts more",
                    ten_digits(fine),
                    ten_digits(below),
                    ten_digits(below + fine)
                );
                return Err(InvalidValue::new(key, asked, accepted));
            }
        }
        Ok(())
    }

    /// Speed of the wall in the first [`Schedule::fast_steps`] steps.
    pub(crate) fn fast_speed(&self) -> f64 {
        let factor = self
            .shortcuts
            .map_or(1.0, |shortcuts| shortcuts.speed_factor);
        factor * self.wall_speed
    }

    /// Speed of the wall during `step` of the compression, as counted by `schedule`.
    pub(crate) fn speed_at(&self, schedule: &Schedule, step: u64) -> f64 {
        let fast = self.fast_speed();
        match step.checked_sub(schedule.fast_steps) {
            None => fast,
            Some(_) if schedule.slowing_steps == 0 => self.wall_speed,
            Some(since) => {
                let slowed = smooth_step(since, schedule.slowing_steps);
                fast + (self.wall_speed - fast) * slowed
            }
        }
    }

    /// Distance that the wall has moved before `step` of the compression.
    pub(crate) fn travel_at(&self, schedule: &Schedule, step: u64) -> f64 {
        let fast = step.min(schedule.fast_steps);
        let slowed = fast + (step - fast).min(schedule.slowing_steps);
        let slowing = (fast..slowed).map(|step| self.speed_at(schedule, step));
        let speeds = fast as f64 * self.fast_speed()
            + slowing.sum::<f64>()
            + (step - slowed) as f64 * self.wall_speed;
        speeds * self.time_step
    }

    fn mean_slowing_speed(&self) -> f64 {
        0.5 * (self.fast_speed() + self.wall_speed)
    }

    /// Checks every value; the error names the first that is out of range.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        let sampling = &self.sampling;
        within(
            "protocol.time_step",
            self.time_step,
            SMALLEST_TIME_STEP,
            1.0,
        )?;
        positive("protocol.wall_speed", self.fast_speed(), FASTEST_WALL)?;
        positive("protocol.wall_travel", self.wall_travel, LONGEST_TRAVEL)?;
        positive(
            "protocol.sampling.coarse_interval",
            sampling.coarse_interval,
            LONGEST_TIME,
        )?;
        positive(
            "protocol.sampling.fine_interval",
            sampling.fine_interval,
            LONGEST_TIME,
        )?;
        within(
            "protocol.sampling.fine_from_travel",
            sampling.fine_from_travel,
            0.0,
            self.wall_travel,
        )?;
        if let Some(shortcuts) = &self.shortcuts {
            let shortest = Shortcuts::SLOWING_TIME * self.mean_slowing_speed();
            shortcuts.validate(shortest, self.wall_travel)?;
        }
        self.validate_length()
    }

    fn validate_length(&self) -> Result<(), InvalidValue> {
        self.preparation.validate(MOST_STEPS * self.time_step)?;
        let steps = self.wall_travel / (self.wall_speed * self.time_step);
        if steps > MOST_STEPS {
            let slowest = self.wall_travel / (MOST_STEPS * self.time_step);
            let accepted =
                format!("at least {slowest:e}, so that the run takes at most {MOST_STEPS:e} steps");
            let key = "protocol.wall_speed";
            return Err(InvalidValue::new(key, self.wall_speed, accepted));
        }
        let schedule = self.schedule();
        let most_in_all = 2.0 * MOST_STEPS;
        if schedule.total_steps() as f64 > most_in_all {
            let accepted = format!("short enough for at most {most_in_all:e} steps in all");
            let key = "protocol.sampling.fine_interval";
            return Err(InvalidValue::new(
                key,
                self.sampling.fine_interval,
                accepted,
            ));
        }
        self.validate_durations()?;
        let rows = schedule.rows();
        if rows > MOST_ROWS {
            let key = "protocol.sampling";
            let accepted = format!("such that the series has at most {MOST_ROWS} rows");
            return Err(InvalidValue {
                key: key.to_owned(),
                value: format!("{rows} rows"),
                accepted,
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn protocol() -> Protocol {
        Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 200.0,
                rest_time: 100.0,
            },
            time_step: 0.1,
            wall_speed: 1e-4,
            wall_travel: 0.0101,
            sampling: Sampling {
                coarse_interval: 3.0,
                fine_from_travel: 0.008,
                fine_interval: 0.7,
            },
            shortcuts: None,
        }
    }

    #[test]
    fn rows_are_coarse_then_fine_and_end_with_the_last_step() {
        let schedule = protocol().schedule();
        let steps: Vec<u64> = schedule.sampled_steps().collect();
        assert_eq!(schedule.fine_every, 7);
        assert_eq!(schedule.coarse_every, 28);
        assert_eq!(schedule.fine_from_step, 784);
        assert_eq!(schedule.compression_steps, 1008);
        assert_eq!(&steps[..2], &[0, 28]);
        assert_eq!(&steps[26..31], &[728, 756, 784, 791, 798]);
        assert_eq!(steps.last(), Some(&1008));
        assert_eq!(schedule.rows(), steps.len() as u64);
    }

    #[test]
    fn every_count_is_a_multiple_of_the_fine_interval() {
        let between_walls = Preparation::SideWalls(SideWalls::paper(0.0123, 0.01));
        for preparation in [protocol().preparation, between_walls] {
            let protocol = Protocol {
                preparation,
                ..protocol()
            };
            let schedule = protocol.schedule();
            let preparation = match schedule.preparation {
                PreparationSteps::Rigid => Vec::new(),
                PreparationSteps::GravityRamp { ramp, rest } => vec![ramp, rest],
                PreparationSteps::SideWalls(steps) => vec![
                    steps.push_steps,
                    steps.hold_steps,
                    steps.fall_steps,
                    steps.settle_steps,
                    steps.withdrawal_steps,
                    steps.rest_steps,
                ],
            };
            let compression = [
                schedule.compression_steps,
                schedule.coarse_every,
                schedule.fine_from_step,
            ];
            let mut counts = preparation.iter().chain(&compression);
            assert!(counts.all(|count| count % schedule.fine_every == 0));
            assert_eq!(
                schedule.total_steps(),
                preparation.iter().sum::<u64>() + schedule.compression_steps
            );
        }
    }

    #[test]
    fn side_walls_have_a_word_and_their_values_in_case_files() {
        let preparation = Preparation::SideWalls(SideWalls::paper(0.005, 0.01));
        let json = serde_json::to_string(&preparation).unwrap();
        assert!(json.starts_with(r#"{"kind":"side-walls","push":0.005,"#));
        assert_eq!(
            serde_json::from_str::<Preparation>(&json).unwrap(),
            preparation
        );
        let misspelt = json.replace("fall_speed", "fallspeed");
        let error = serde_json::from_str::<Preparation>(&misspelt).unwrap_err();
        assert!(error.to_string().contains("fallspeed"), "{error}");
    }

    #[test]
    fn a_wall_that_would_take_for_ever_is_refused() {
        let mut slow = protocol();
        slow.wall_speed = 1e-15;
        let error = slow.validate().unwrap_err();
        assert_eq!(error.key, "protocol.wall_speed");
    }

    #[test]
    fn a_series_that_would_fill_the_memory_is_refused() {
        let mut long = protocol();
        long.wall_speed = 1e-10;
        long.sampling.fine_interval = 0.1;
        let error = long.validate().unwrap_err();
        assert_eq!(error.key, "protocol.sampling");
    }
}
