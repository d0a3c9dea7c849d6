//! How the stack is prepared, compressed and sampled.

use super::validity::{InvalidValue, positive, within};
use serde::{Deserialize, Serialize};

const SMALLEST_TIME_STEP: f64 = 1e-6;
/// Quasi-static loading ends far below the speed of sound, which is of order 1.
const FASTEST_WALL: f64 = 0.01;
/// The height of the stack, and a little more.
const LONGEST_TRAVEL: f64 = 4.0;
const LONGEST_TIME: f64 = 1e9;
const MOST_STEPS: f64 = 1e11;
const MOST_ROWS: u64 = 1_000_000;

/// How the stack is brought to rest under gravity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Preparation {
    /// Three just-touching cylinders, stress free; gravity rises from 0 to g as the smooth step
    /// x³(10 − 15x + 6x²) over `ramp_time`, then the stack rests for `rest_time`. Ends with c = 0.
    GravityRamp {
        /// Duration of the ramp.
        ramp_time: f64,
        /// Duration of the rest after it.
        rest_time: f64,
    },
}

/// When rows of the time series are taken: coarsely at first, finely around the yield.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sampling {
    /// Time between rows far from the yield.
    pub coarse_interval: f64,
    /// Wall travel from which rows are taken finely.
    pub fine_from_travel: f64,
    /// Time between rows near the yield.
    pub fine_interval: f64,
}

/// One compression run: prepare, then lower a frictionless wall at constant speed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// How the stack is brought to rest.
    pub preparation: Preparation,
    /// Time step of the integrator.
    pub time_step: f64,
    /// Speed of the top wall, downwards.
    pub wall_speed: f64,
    /// How far the wall moves in all.
    pub wall_travel: f64,
    /// When rows are taken.
    pub sampling: Sampling,
}

/// The protocol counted in time steps, as every code runs it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// Steps during which gravity rises. Like every other count, a multiple of `fine_every`: codes that
    /// average over windows need windows that fit.
    pub ramp_steps: u64,
    /// Steps at rest under full gravity.
    pub rest_steps: u64,
    /// Steps of compression.
    pub compression_steps: u64,
    /// Steps between coarse rows.
    pub coarse_every: u64,
    /// Step of the compression from which rows are fine; a multiple of `coarse_every`.
    pub fine_from_step: u64,
    /// Steps between fine rows.
    pub fine_every: u64,
}

impl Schedule {
    /// Steps of the compression at which a row is taken, in order, first and last step included.
    pub fn sampled_steps(&self) -> impl Iterator<Item = u64> + use<> {
        let coarse = (0..self.fine_from_step).step_by(self.coarse_every as usize);
        let fine = (self.fine_from_step..=self.compression_steps).step_by(self.fine_every as usize);
        coarse.chain(fine)
    }

    /// How many they are.
    pub fn rows(&self) -> u64 {
        let fine = (self.compression_steps - self.fine_from_step) / self.fine_every;
        self.fine_from_step / self.coarse_every + fine + 1
    }

    /// All steps of the run, preparation included.
    pub fn total_steps(&self) -> u64 {
        self.ramp_steps + self.rest_steps + self.compression_steps
    }
}

impl Protocol {
    /// The protocol in whole steps, every duration rounded to whole fine intervals.
    pub fn schedule(&self) -> Schedule {
        let Preparation::GravityRamp {
            ramp_time,
            rest_time,
        } = self.preparation;
        let fine_every = ((self.sampling.fine_interval / self.time_step).round() as u64).max(1);
        let fine_time = fine_every as f64 * self.time_step;
        let rounded = |time: f64| ((time / fine_time).round() as u64).max(1) * fine_every;
        let coarse_every = rounded(self.sampling.coarse_interval);
        let until_fine = rounded(self.sampling.fine_from_travel / self.wall_speed);
        let fine_from_step = until_fine / coarse_every * coarse_every;
        let all = rounded(self.wall_travel / self.wall_speed);
        Schedule {
            ramp_steps: rounded(ramp_time),
            rest_steps: rounded(rest_time),
            compression_steps: all.max(fine_from_step + fine_every),
            coarse_every,
            fine_from_step,
            fine_every,
        }
    }

    /// Every value in its range, or the first one that is not.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        let sampling = &self.sampling;
        within(
            "protocol.time_step",
            self.time_step,
            SMALLEST_TIME_STEP,
            1.0,
        )?;
        positive("protocol.wall_speed", self.wall_speed, FASTEST_WALL)?;
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
        self.validate_length()
    }

    fn validate_length(&self) -> Result<(), InvalidValue> {
        let Preparation::GravityRamp {
            ramp_time,
            rest_time,
        } = self.preparation;
        for (key, time) in [("ramp_time", ramp_time), ("rest_time", rest_time)] {
            let longest = MOST_STEPS * self.time_step;
            positive(&format!("protocol.preparation.{key}"), time, longest)?;
        }
        let steps = self.wall_travel / (self.wall_speed * self.time_step);
        if steps > MOST_STEPS {
            let slowest = self.wall_travel / (MOST_STEPS * self.time_step);
            let accepted =
                format!("at least {slowest:e}, so that the run takes at most {MOST_STEPS:e} steps");
            let key = "protocol.wall_speed";
            return Err(InvalidValue::new(key, self.wall_speed, accepted));
        }
        let schedule = self.schedule();
        if schedule.total_steps() as f64 > 2.0 * MOST_STEPS {
            let accepted = format!("short enough for at most {MOST_STEPS:e} steps in all");
            let key = "protocol.sampling.fine_interval";
            return Err(InvalidValue::new(
                key,
                self.sampling.fine_interval,
                accepted,
            ));
        }
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
        let schedule = protocol().schedule();
        let counts = [
            schedule.ramp_steps,
            schedule.rest_steps,
            schedule.compression_steps,
            schedule.coarse_every,
            schedule.fine_from_step,
        ];
        assert!(counts.iter().all(|count| count % schedule.fine_every == 0));
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
