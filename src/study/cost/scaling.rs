//! Scaling of native lanes with the number of cases on one core, and with cores.

use super::stack::{LENGTHS, StackBench, timed_cases};
use super::statistics::median;
use super::target::{BenchError, BenchTarget, InstalledTarget};
use crate::code::{Code, RunContext};
use crate::model::Case;
use crate::runs::in_parallel;
use serde::Serialize;
use std::time::Instant;

/// The sizes that are measured.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingBench {
    /// Numbers of cases on one core.
    pub cases: Vec<usize>,
    /// Steps of each of them.
    pub steps: u64,
    /// Smallest number of cases that are timed together, so that the time of a few can be resolved.
    pub least_cases: usize,
    /// Numbers of cores.
    pub cores: Vec<usize>,
    /// Stacks whose planned runs are distributed over these cores.
    pub stacks: usize,
    /// Repeats of the whole measurement.
    pub repeats: usize,
}

/// The measured scaling.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaling {
    /// A row for each number of cases.
    pub cases: Vec<ScalingRow>,
    /// A row for each number of cores.
    pub cores: Vec<ScalingRow>,
}

/// The cost of a step at one size.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScalingRow {
    /// Number of cases.
    pub cases: usize,
    /// Number of cores.
    pub cores: usize,
    /// Wall time per step and case in nanoseconds, the median of the repeats.
    pub ns_per_step: f64,
    /// Speed in units of that of the first row.
    pub speedup: f64,
}

impl Default for ScalingBench {
    /// Up to 256 cases, and all cores of this machine: half a minute.
    fn default() -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let doubled = std::iter::successors(Some(1), |cores| Some(2 * cores));
        let mut numbers: Vec<usize> = doubled.take_while(|&number| number < cores).collect();
        numbers.push(cores);
        Self {
            cases: vec![1, 2, 4, 8, 16, 64, 256],
            steps: 50_000,
            least_cases: 64,
            cores: numbers,
            stacks: 32,
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
    /// Measures, each call in a directory of its own in that of `context`.
    ///
    /// # Errors
    /// If a run is interrupted, or files cannot be written.
    pub fn measure(&self, context: &RunContext) -> Result<Scaling, BenchError> {
        let lanes = InstalledTarget::find(BenchTarget::NativeLanes)?;
        let planned = self.planned_cases();
        let nothing = |cases, cores| Size {
            cases,
            cores,
            nanoseconds: Vec::new(),
        };
        let over_cases = self.cases.iter().map(|&cases| nothing(cases, 1));
        let mut over_cases: Vec<Size> = over_cases.collect();
        let over_cores = self.cores.iter();
        let over_cores = over_cores.map(|&cores| nothing(planned.len(), cores));
        let mut over_cores: Vec<Size> = over_cores.collect();
        for _ in 0..self.repeats {
            for size in &mut over_cases {
                let nanoseconds = self.in_lanes(&lanes, size.cases, context)?;
                size.nanoseconds.push(nanoseconds);
            }
            for size in &mut over_cores {
                size.nanoseconds
                    .push(on_cores(&lanes, &planned, size.cores, context)?);
            }
        }
        Ok(Scaling {
            cases: rows(&over_cases),
            cores: rows(&over_cores),
        })
    }

    /// The planned runs of all stacks.
    fn planned_cases(&self) -> Vec<Case> {
        let bench = StackBench {
            targets: Vec::new(),
            stacks: self.stacks,
            ..StackBench::default()
        };
        let plans = bench.plans(Code::NATIVE).into_iter();
        plans.flat_map(|plan| plan.cases).collect()
    }

    /// Nanoseconds per step and case of `count` cases in one call.
    fn in_lanes(
        &self,
        lanes: &InstalledTarget,
        count: usize,
        context: &RunContext,
    ) -> Result<f64, BenchError> {
        let cases = timed_cases(Code::NATIVE, count, self.steps, LENGTHS);
        let steps: u64 = cases.iter().map(Case::total_steps).sum();
        let calls = self.least_cases.div_ceil(count.max(1));
        let mut seconds = 0.0;
        for _ in 0..calls {
            seconds += lanes.time(&cases, context)?.duration.as_secs_f64();
        }
        Ok(1e9 * seconds / (calls as f64 * steps as f64))
    }
}

/// Nanoseconds per step and case of `cases`, distributed over so many `cores`.
fn on_cores(
    lanes: &InstalledTarget,
    cases: &[Case],
    cores: usize,
    context: &RunContext,
) -> Result<f64, BenchError> {
    let hand = |core| cases.iter().copied().skip(core).step_by(cores).collect();
    let hands: Vec<Vec<Case>> = (0..cores).map(hand).collect();
    let start = Instant::now();
    let results = in_parallel(&hands, cores, |hand| lanes.time(hand, context));
    let seconds = start.elapsed().as_secs_f64();
    for result in results {
        result?;
    }
    let steps: u64 = cases.iter().map(Case::total_steps).sum();
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
