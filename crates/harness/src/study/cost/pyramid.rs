//! The cost of a step of a pyramid, per cylinder.

use super::statistics::{fastest, median};
use super::target::{BenchError, convention};
use crate::code::{Code, InstalledCode, RunContext, SettledCode};
use crate::model::{Power, Pyramid};
use crate::series::PyramidRun;

/// Stiffness at which gravity hardly deforms the lowest of a hundred rows.
const STIFFNESS: f64 = 1e5;

/// Steps per row in which gravity rises. All rows carry load by then, though the largest pyramid still sways a
/// little.
const RAMP_STEPS_A_ROW: u64 = 50;

/// The pyramids, the codes and the amount of work that are timed.
#[derive(Debug, Clone, PartialEq)]
pub struct PyramidBench {
    /// Numbers of rows; n rows are n(n + 1)/2 cylinders.
    pub rows: Vec<u32>,
    /// The codes, each of which must be able to build pyramids.
    pub codes: Vec<SettledCode>,
    /// Steps times cylinders that are timed in every run.
    pub cylinder_steps: u64,
    /// Repeats of each run. Codes and pyramids take turns, so that other load on the machine slows down all of them.
    pub repeats: usize,
}

/// The cost of a step of one pyramid with one code.
#[derive(Debug, Clone, PartialEq)]
pub struct PyramidCost {
    /// The code.
    pub code: Code,
    /// Its version.
    pub version: String,
    /// Number of rows.
    pub rows: u32,
    /// Number of cylinders.
    pub cylinders: usize,
    /// Timed steps of each run.
    pub timed_steps: u64,
    /// Wall time per step and cylinder in nanoseconds, of each repeat in order.
    pub nanoseconds: Vec<f64>,
}

impl Default for PyramidBench {
    /// About 1, 2, 5 and 10 thousand cylinders, with every code that builds pyramids; some minutes.
    fn default() -> Self {
        let codes = Code::with_power(Power::Linear).into_iter();
        Self {
            rows: vec![44, 62, 99, 140],
            codes: codes
                .filter(|code| code.builds_pyramids())
                .map(|code| code.unmeasured(""))
                .collect(),
            cylinder_steps: 10_000_000,
            repeats: 5,
        }
    }
}

impl PyramidBench {
    /// Measures every pyramid with every code, each in a directory of its own in that of `context`. The code itself
    /// times the last steps of a run (the loop time in its log), so that start-up, neighbour lists of the beginning
    /// and the rise of gravity do not count.
    ///
    /// # Errors
    /// If a code is missing or does not build pyramids, or a run fails.
    pub fn measure(&self, context: &RunContext) -> Result<Vec<PyramidCost>, BenchError> {
        let find = |settled| {
            let code = SettledCode::name(settled).clone();
            let found = code.find().ok_or(BenchError::Missing { code })?;
            Ok((settled, found))
        };
        let codes = self.codes.iter().map(find);
        let codes: Vec<_> = codes.collect::<Result<_, BenchError>>()?;
        let pairs = self.rows.iter();
        let pairs = pairs.flat_map(|&rows| codes.iter().map(move |code| (code, rows)));
        let costs = pairs.map(|(code, rows)| (code, self.nothing_measured_yet(code, rows)));
        let mut costs: Vec<_> = costs.collect();
        for _ in 0..self.repeats {
            for ((settled, code), cost) in &mut costs {
                let directory = format!("{}-{}", cost.code, cost.rows);
                let context = RunContext {
                    directory: &context.directory.join(directory),
                    ..*context
                };
                let pyramid = self.pyramid(settled, cost.rows);
                for run in code.build(&[pyramid], &context)? {
                    cost.add(&run);
                }
            }
        }
        Ok(costs.into_iter().map(|(_, cost)| cost).collect())
    }

    /// Returns the pyramid of so many `rows` as `code` builds it. Native takes the convention of an external code
    /// with the paper's arms, so that the two compute the same thing.
    pub fn pyramid(&self, code: &SettledCode, rows: u32) -> Pyramid {
        let pyramid = Pyramid::touching(rows, STIFFNESS, convention(code));
        let cylinders = pyramid.cylinder_count().max(1) as u64;
        Pyramid {
            ramp_steps: RAMP_STEPS_A_ROW * u64::from(rows),
            timed_steps: self.cylinder_steps.div_ceil(cylinders),
            ..pyramid
        }
    }

    fn nothing_measured_yet(
        &self,
        (settled, code): &(&SettledCode, Box<dyn InstalledCode>),
        rows: u32,
    ) -> PyramidCost {
        let pyramid = self.pyramid(settled, rows);
        PyramidCost {
            code: code.name().clone(),
            version: code.identity().version.clone(),
            rows,
            cylinders: pyramid.cylinder_count(),
            timed_steps: pyramid.timed_steps,
            nanoseconds: Vec::new(),
        }
    }
}

impl PyramidCost {
    fn add(&mut self, run: &PyramidRun) {
        let cylinder_steps = self.timed_steps as f64 * self.cylinders as f64;
        let nanoseconds = 1e9 * run.timed_seconds() / cylinder_steps;
        self.nanoseconds.push(nanoseconds);
    }

    /// Returns the median of the repeats, in nanoseconds per step and cylinder; NaN without repeats.
    pub fn median(&self) -> f64 {
        median(&self.nanoseconds)
    }

    /// Returns the fastest of the repeats, which other load on the machine disturbs least, in nanoseconds per step
    /// and cylinder.
    pub fn fastest(&self) -> f64 {
        fastest(&self.nanoseconds)
    }

    /// Returns the cost in units of that of `other`: the median of the ratios of consecutive runs.
    pub fn ratio_to(&self, other: &Self) -> f64 {
        let pairs = self.nanoseconds.iter().zip(&other.nanoseconds);
        let ratios: Vec<f64> = pairs.map(|(own, other)| own / other).collect();
        median(&ratios)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cost(nanoseconds: &[f64]) -> PyramidCost {
        PyramidCost {
            code: Code::native(),
            version: String::new(),
            rows: 2,
            cylinders: 3,
            timed_steps: 1,
            nanoseconds: nanoseconds.to_vec(),
        }
    }

    #[test]
    fn a_ratio_is_taken_run_by_run() {
        // The machine was twice as slow in the second round.
        let (one, other) = (cost(&[40.0, 80.0, 41.0]), cost(&[120.0, 240.0, 123.0]));
        assert_eq!(other.ratio_to(&one), 3.0);
        assert_eq!(one.median(), 41.0);
        assert_eq!(one.fastest(), 40.0);
    }

    #[test]
    fn every_pyramid_is_valid_and_timed_for_as_long() {
        let bench = PyramidBench::default();
        for code in &bench.codes {
            for rows in &bench.rows {
                let pyramid = bench.pyramid(code, *rows);
                pyramid.validate().expect("a pyramid");
                let work = pyramid.timed_steps * pyramid.cylinder_count() as u64;
                assert!(work >= bench.cylinder_steps);
                assert!(work < bench.cylinder_steps + pyramid.cylinder_count() as u64);
            }
        }
    }
}
