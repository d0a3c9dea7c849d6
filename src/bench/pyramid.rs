//! The cost of a step of a pyramid, per cylinder.

use super::contestant::{BenchError, convention};
use super::statistics::{fastest, median};
use crate::engine::{Engine, EngineName, Workplace};
use crate::stack::Pyramid;

/// Softer than this the lowest row of a hundred would be pressed flat.
const STIFFNESS: f64 = 1e5;

/// Enough for all rows to carry; the largest pyramid still sways a little then.
const RAMP_STEPS_A_ROW: u64 = 50;

/// Which pyramids are built by whom, and how long is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct PyramidBench {
    /// Numbers of rows; n rows are n(n + 1)/2 cylinders.
    pub rows: Vec<u32>,
    /// The engines, each of which must be able to build pyramids.
    pub engines: Vec<EngineName>,
    /// Steps times cylinders that are timed in every run.
    pub cylinder_steps: u64,
    /// How often each run is made. Engines and pyramids take turns, so that a machine which is busy for a
    /// while slows down all of them.
    pub repeats: usize,
}

/// What a step of one pyramid costs one engine.
#[derive(Debug, Clone, PartialEq)]
pub struct PyramidCost {
    /// Who ran it.
    pub engine: EngineName,
    /// Its version.
    pub version: String,
    /// Number of rows.
    pub rows: u32,
    /// Number of cylinders.
    pub cylinders: usize,
    /// Steps that were timed in each run.
    pub timed_steps: u64,
    /// Wall time per step and cylinder in nanoseconds, of each repeat in order.
    pub nanoseconds: Vec<f64>,
}

impl Default for PyramidBench {
    /// About 1, 2, 5 and 10 thousand cylinders, native, LAMMPS and LIGGGHTS; some minutes.
    fn default() -> Self {
        Self {
            rows: vec![44, 62, 99, 140],
            engines: vec![EngineName::Native, EngineName::Lammps, EngineName::Liggghts],
            cylinder_steps: 10_000_000,
            repeats: 5,
        }
    }
}

impl PyramidBench {
    /// Measures, in directories of their own in that of `workplace`. Only the last steps of a run are timed, by
    /// the code itself (the loop time in the log of LAMMPS and LIGGGHTS): start-up, neighbour lists of the
    /// beginning and the rise of gravity do not count.
    ///
    /// # Errors
    /// If an engine is missing or does not build pyramids, or a run fails.
    pub fn measure(&self, workplace: &Workplace) -> Result<Vec<PyramidCost>, BenchError> {
        let find = |name: &EngineName| name.find().ok_or(BenchError::Missing { engine: *name });
        let engines: Vec<_> = self.engines.iter().map(find).collect::<Result<_, _>>()?;
        let mut costs = self.nothing_measured_yet(&engines);
        for _ in 0..self.repeats {
            for (index, cost) in costs.iter_mut().enumerate() {
                let engine = &engines[index % engines.len()];
                let directory = format!("{}-{}", cost.engine, cost.rows);
                let workplace = Workplace {
                    directory: &workplace.directory.join(directory),
                    ..*workplace
                };
                let run = engine.pyramid(&self.pyramid(cost.engine, cost.rows), &workplace)?;
                let cylinder_steps = cost.timed_steps as f64 * cost.cylinders as f64;
                cost.nanoseconds
                    .push(1e9 * run.timed_seconds() / cylinder_steps);
            }
        }
        Ok(costs)
    }

    /// The pyramid of so many rows as `engine` builds it. Native takes the convention of LAMMPS, so that the two
    /// compute the same thing.
    pub fn pyramid(&self, engine: EngineName, rows: u32) -> Pyramid {
        let pyramid = Pyramid::touching(rows, STIFFNESS, convention(engine));
        let cylinders = pyramid.cylinder_count().max(1) as u64;
        Pyramid {
            ramp_steps: RAMP_STEPS_A_ROW * u64::from(rows),
            timed_steps: self.cylinder_steps.div_ceil(cylinders),
            ..pyramid
        }
    }

    fn nothing_measured_yet(&self, engines: &[Box<dyn Engine>]) -> Vec<PyramidCost> {
        let cost = |rows: u32, engine: &dyn Engine| {
            let pyramid = self.pyramid(engine.name(), rows);
            PyramidCost {
                engine: engine.name(),
                version: engine.identity().version.clone(),
                rows,
                cylinders: pyramid.cylinder_count(),
                timed_steps: pyramid.timed_steps,
                nanoseconds: Vec::new(),
            }
        };
        let rows = self.rows.iter();
        rows.flat_map(|rows| engines.iter().map(move |engine| cost(*rows, &**engine)))
            .collect()
    }
}

impl PyramidCost {
    /// The median of the repeats, in nanoseconds per step and cylinder; not a number if there is none.
    pub fn median(&self) -> f64 {
        median(&self.nanoseconds)
    }

    /// The fastest of the repeats, which a busy machine disturbs least, in nanoseconds per step and cylinder.
    pub fn fastest(&self) -> f64 {
        fastest(&self.nanoseconds)
    }

    /// How many times the cost of `other` this is: the median of the ratios of those runs that were made one
    /// after the other.
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
            engine: EngineName::Native,
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
        for engine in &bench.engines {
            for rows in &bench.rows {
                let pyramid = bench.pyramid(*engine, *rows);
                pyramid.validate().expect("a pyramid");
                let work = pyramid.timed_steps * pyramid.cylinder_count() as u64;
                assert!(work >= bench.cylinder_steps);
                assert!(work < bench.cylinder_steps + pyramid.cylinder_count() as u64);
            }
        }
    }
}
