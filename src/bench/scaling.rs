//! How native lanes scale: with the number of cases on one core, and with cores.

use super::contestant::{BenchError, Competitor, Contestant};
use super::stack::{LENGTHS, StackBench, timed_cases};
use super::statistics::median;
use crate::archive::{ArchiveError, Run};
use crate::crosscheck::{Load, Participant, Progress, Recorded, Settings, Store, run_all};
use crate::engine::{EngineName, Failure, Workplace};
use crate::stack::Case;
use serde::Serialize;
use std::time::Instant;

/// What is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingBench {
    /// Numbers of cases on one core.
    pub cases: Vec<usize>,
    /// Steps of each of them.
    pub steps: u64,
    /// Cases that are run together at the least, so that few of them are not over before a clock notices.
    pub least_cases: usize,
    /// Numbers of cores.
    pub cores: Vec<usize>,
    /// Stacks whose yield force is measured on these cores, store included.
    pub stacks: usize,
    /// How often everything is measured, one after the other.
    pub repeats: usize,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaling {
    /// One row a number of cases.
    pub cases: Vec<ScalingRow>,
    /// One row a number of cores.
    pub cores: Vec<ScalingRow>,
}

/// What a step costs at one size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalingRow {
    /// Number of cases.
    pub cases: usize,
    /// Number of cores.
    pub cores: usize,
    /// Wall time per step and case in nanoseconds, the median of the repeats.
    pub ns_per_step: f64,
    /// How many times as fast as the first row.
    pub speedup: f64,
}

impl Default for ScalingBench {
    /// Up to 256 cases, and all cores of this machine; half a minute.
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let doubled = std::iter::successors(Some(1), |cores| Some(2 * cores));
        let mut numbers: Vec<usize> = doubled.take_while(|&number| number < cores).collect();
        numbers.push(cores);
        Self {
            cases: vec![1, 2, 4, 8, 16, 64, 256],
            steps: 100_000,
            least_cases: 64,
            cores: numbers,
            stacks: 128,
            repeats: 5,
        }
    }
}

/// Repeated measurements at one size.
struct Size {
    cases: usize,
    cores: usize,
    nanoseconds: Vec<f64>,
}

impl ScalingBench {
    /// Measures, in directories of their own in that of `workplace`.
    ///
    /// # Errors
    /// If a run is interrupted, or there is no place for files.
    pub fn measure(&self, workplace: &Workplace) -> Result<Scaling, BenchError> {
        let lanes = Competitor::find(Contestant::NativeLanes)?;
        let load = self.load();
        let nothing = |cases, cores| Size {
            cases,
            cores,
            nanoseconds: Vec::new(),
        };
        let over_cases = self.cases.iter().map(|&cases| nothing(cases, 1));
        let mut over_cases: Vec<Size> = over_cases.collect();
        let over_cores = self.cores.iter();
        let over_cores = over_cores.map(|&cores| nothing(load.cases.len(), cores));
        let mut over_cores: Vec<Size> = over_cores.collect();
        for _ in 0..self.repeats {
            for size in &mut over_cases {
                let nanoseconds = self.in_lanes(&lanes, size.cases, workplace)?;
                size.nanoseconds.push(nanoseconds);
            }
            for size in &mut over_cores {
                size.nanoseconds
                    .push(on_cores(&load, size.cores, workplace)?);
            }
        }
        Ok(Scaling {
            cases: rows(&over_cases),
            cores: rows(&over_cores),
        })
    }

    /// The planned runs of all stacks.
    fn load(&self) -> Load {
        let bench = StackBench {
            contestants: Vec::new(),
            stacks: self.stacks,
            ..StackBench::default()
        };
        let plans = bench.plans(EngineName::Native);
        Load {
            engine: EngineName::Native,
            cases: plans.into_iter().flat_map(|plan| plan.cases).collect(),
        }
    }

    /// Nanoseconds per step and case of `count` cases in one call.
    fn in_lanes(
        &self,
        lanes: &Competitor,
        count: usize,
        workplace: &Workplace,
    ) -> Result<f64, BenchError> {
        let cases = timed_cases(EngineName::Native, count, self.steps, LENGTHS);
        let steps: u64 = cases.iter().map(Case::total_steps).sum();
        let calls = self.least_cases.div_ceil(count.max(1));
        let mut seconds = 0.0;
        for _ in 0..calls {
            seconds += lanes.time(&cases, workplace)?.duration.as_secs_f64();
        }
        Ok(1e9 * seconds / (calls as f64 * steps as f64))
    }
}

/// Nanoseconds per step and case of `load` on so many cores: scheduled, carried out and kept in a store, as by
/// `tristack sweep`.
fn on_cores(load: &Load, cores: usize, workplace: &Workplace) -> Result<f64, BenchError> {
    let directory = tempfile::tempdir_in(workplace.directory)
        .map_err(ArchiveError::writing(workplace.directory))?;
    let settings = Settings {
        store: Store::open(directory.path())?,
        recorded: Recorded::new(directory.path()),
        fresh: true,
        threads: cores,
        time_limit: workplace.time_limit,
        interrupt: workplace.interrupt,
    };
    let participants = [Participant::find(EngineName::Native)];
    let loads = std::slice::from_ref(load);
    let start = Instant::now();
    let results = run_all(loads, &participants, &settings, &Silence, |_| ());
    let seconds = start.elapsed().as_secs_f64();
    for result in results.into_iter().flatten() {
        result?;
    }
    let steps: u64 = load.cases.iter().map(Case::total_steps).sum();
    Ok(1e9 * seconds / steps as f64)
}

fn rows(sizes: &[Size]) -> Vec<ScalingRow> {
    let first = sizes
        .first()
        .map_or(f64::NAN, |size| median(&size.nanoseconds));
    let row = |size: &Size| ScalingRow {
        cases: size.cases,
        cores: size.cores,
        ns_per_step: median(&size.nanoseconds),
        speedup: first / median(&size.nanoseconds),
    };
    sizes.iter().map(row).collect()
}

/// Nobody wants to know how far it is.
struct Silence;

impl Progress for Silence {
    fn planned(&self, _total: usize, _reused: usize, _seconds: f64) {}
    fn advanced(&self, _seconds: f64) {}
    fn finished(&self, _engine: EngineName, _case: &Case, _result: Result<&Run, &Failure>) {}
    fn warn(&self, _message: &str) {}
}
