//! Case files with a given start, which are run as the authors' program runs, for stacks that they have not
//! published.

use super::points::{RESTITUTION, WALL_STARTS, limit, run, wall_height};
use crate::dem::{ForceSampling, GivenStart, LaneWidth, PublishedForces, PublishedRun};
use crate::files::case_content;
use crate::model::{CaseError, ContactConvention, InvalidValue, Power, Stack, WrittenStack};
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;

/// Largest number of steps of a run, which takes some days.
const MOST_STEPS: f64 = 1e11;
/// Largest number of rows of f(t).
const MOST_ROWS: f64 = 1e6;

/// A compression from a given start, as the program behind the paper's figures makes it. Lengths are in r, times in √(r/g),
/// forces in m g.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenCase {
    /// The stack, of two cylinders on the floor.
    pub stack: WrittenStack,
    /// The state at the beginning, in which the wall stands.
    pub start: GivenStart,
    /// Speed of the top wall, downwards, in √(g r).
    pub wall_speed: f64,
    /// Time step, in √(r/g).
    pub time_step: f64,
    /// Restitution coefficient.
    #[serde(default = "restitution")]
    pub restitution: f64,
    /// Height at which the top wall stands at first, in r.
    #[serde(default = "wall_height")]
    pub wall_height: f64,
    /// Time for which it stands, in √(r/g).
    #[serde(default = "wall_starts")]
    pub wall_starts: f64,
    /// Time at which the run ends, in √(r/g); without it, with the first decrease of the wall force.
    pub end_time: Option<f64>,
    /// Time from one row of f(t) to the next, in √(r/g); only together with `end_time`.
    pub interval: Option<f64>,
}

fn restitution() -> f64 {
    RESTITUTION
}

fn wall_starts() -> f64 {
    WALL_STARTS
}

/// Result of running a case with a given start.
#[derive(Debug, Clone, PartialEq)]
pub struct GivenOutcome {
    /// The case.
    pub case: GivenCase,
    /// Its stack.
    pub stack: Stack,
    /// The wall force before its first decrease, in m g; `None` if it never falls before the end.
    pub yield_force: Option<f64>,
    /// The exact limit of the stack with springs that do not turn with the contact, in m g; `None` if it has none.
    pub limit: Option<f64>,
    /// Times in √(r/g), and the wall force in m g.
    pub rows: Vec<(f64, f64)>,
}

impl GivenCase {
    /// Reads a case with a given start; returns `None` for a case that is prepared, or a file that is not a case.
    ///
    /// # Errors
    /// If the file cannot be read, has a start and is malformed otherwise, or has a value out of its range.
    pub fn read(path: &Path) -> Result<Option<Self>, CaseError> {
        Self::parse(&case_content(path)?, path)
    }

    /// Does the same with the content of the file at `path`.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn parse(content: &[u8], path: &Path) -> Result<Option<Self>, CaseError> {
        let keys = CaseError::deserialized::<serde_json::Value>(content, path);
        if !keys.is_ok_and(|keys| keys.get("start").is_some()) {
            return Ok(None);
        }
        let case: Self = CaseError::deserialized(content, path)?;
        case.validate().map_err(CaseError::in_file(path))?;
        Ok(Some(case))
    }

    /// Returns the stack.
    pub fn stack(&self) -> Stack {
        self.stack.in_law(Power::Linear)
    }

    /// Checks that every value is in its range; the error names the first one that is not.
    fn validate(&self) -> Result<(), InvalidValue> {
        let stack = self.stack();
        stack.validate()?;
        let within = |key: &str, value: f64, accepted: bool, words: String| {
            let invalid = || InvalidValue::new(key, value, words);
            accepted.then_some(()).ok_or_else(invalid)
        };
        let bodies = f64::from(stack.bodies);
        within("stack.bodies", bodies, stack.bodies == 2, "2".to_owned())?;
        let GivenStart {
            places,
            velocities,
            pair_springs,
            floor_springs,
        } = &self.start;
        for (key, numbers) in [
            ("start.places", places.as_flattened()),
            ("start.velocities", velocities.as_flattened()),
            ("start.pair_springs", pair_springs.as_flattened()),
            ("start.floor_springs", floor_springs.as_flattened()),
        ] {
            for &number in numbers {
                let accepted = (-10.0..=10.0).contains(&number);
                within(key, number, accepted, "numbers from -10 to 10".to_owned())?;
            }
        }
        let restitution = self.restitution;
        let accepted = (1e-3..=1.0).contains(&restitution);
        let words = "a number from 1e-3 to 1".to_owned();
        within("restitution", restitution, accepted, words)?;
        let convention = ContactConvention {
            restitution,
            ..ContactConvention::PAPER
        };
        let longest = stack.longest_time_step(&convention) / stack.stiffness.sqrt();
        let positive = |key: &str, value: f64, highest: f64| {
            let words = format!("a number above 0, at most {highest:.3e}");
            within(key, value, value > 0.0 && value <= highest, words)
        };
        positive("time_step", self.time_step, longest)?;
        positive("wall_speed", self.wall_speed, 1.0)?;
        positive("wall_height", self.wall_height, 10.0)?;
        let longest_time = MOST_STEPS * self.time_step;
        positive("wall_starts", self.wall_starts, longest_time)?;
        if let Some(end) = self.end_time {
            positive("end_time", end, longest_time)?;
        }
        match (self.interval, self.end_time) {
            (None, _) => {}
            (Some(interval), None) => {
                let words = "together with `end_time`".to_owned();
                within("interval", interval, false, words)?;
            }
            (Some(interval), Some(end)) => {
                let least = (end / MOST_ROWS).max(self.time_step);
                let words = format!("a number from {least:.3e} to {end}, the end");
                let accepted = (least..=end).contains(&interval);
                within("interval", interval, accepted, words)?;
            }
        }
        let steps = self.run().largest_steps() as f64;
        let words = format!("so large that a run takes at most {MOST_STEPS:e} steps");
        within("wall_speed", self.wall_speed, steps <= MOST_STEPS, words)
    }

    /// Returns the run, in the units of the native DEM.
    pub fn run(&self) -> PublishedRun {
        let stack = self.stack();
        let root = stack.stiffness.sqrt();
        let base = run(&self.start, &stack, self.wall_speed, self.time_step);
        let steps = |time: f64| (time / self.time_step).round() as u64;
        let sampling = self.end_time.map(|end| match self.interval {
            None => ForceSampling::at(steps(end)),
            Some(interval) => {
                let every = steps(interval).max(1);
                ForceSampling {
                    first: 0,
                    every,
                    count: steps(end) / every + 1,
                }
            }
        });
        PublishedRun {
            restitution: self.restitution,
            wall_height: self.wall_height,
            wall_starts: self.wall_starts * root,
            sampling,
            ..base
        }
    }

    /// Runs the case; returns `None` if it stops being `wanted` before the end.
    pub fn carry_out(&self, wanted: impl FnMut() -> bool) -> Option<GivenOutcome> {
        let run = self.run();
        let mut found: Option<PublishedForces> = None;
        LaneWidth::ONE.run_published(&[run], wanted, |_, forces| found = Some(forces));
        let forces = found?;
        let samples = forces.samples.iter().enumerate();
        let sampling = run.sampling;
        let rows = samples.filter_map(|(index, &force)| {
            let step = sampling?.step(index as u64);
            Some((step as f64 * self.time_step, force))
        });
        Some(GivenOutcome {
            case: *self,
            stack: run.stack,
            yield_force: forces.yield_force,
            limit: limit(&run.stack),
            rows: rows.collect(),
        })
    }
}

impl GivenOutcome {
    /// Returns whether there are any numbers and all of them are finite.
    pub fn is_usable(&self) -> bool {
        let forces = self.rows.iter().map(|row| row.1);
        let mut all = self.yield_force.into_iter().chain(forces);
        all.clone().next().is_some() && all.all(f64::is_finite)
    }
}
