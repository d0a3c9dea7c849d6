//! Scaling of native lanes with the number of cases on one core, and with cores.

use super::stack::{LENGTHS, plans, timed_cases};
use super::statistics::median;
use super::target::{BenchError, BenchTarget, InstalledTarget};
use crate::code::{RunContext, SettledCode};
use crate::model::{Case, PAPER_BODIES};
use crate::runs::in_parallel;
use std::time::Instant;

/// Numbers of cases on one core.
const CASES: [usize; 7] = [1, 2, 4, 8, 16, 64, 256];
/// Steps of each case.
const STEPS: u64 = 50_000;
/// Smallest number of cases that are timed together, so that the time of a few can be resolved.
const LEAST_CASES: usize = 64;
/// Stacks whose planned runs are distributed over the cores of this machine.
const STACKS: usize = 32;
/// Repeats of the whole measurement, if nothing else is wanted: half a minute.
const REPEATS: usize = 5;

/// The measured scaling.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaling {
    /// A row for each number of cases.
    pub cases: Vec<ScalingRow>,
    /// A row for each number of cores.
    pub cores: Vec<ScalingRow>,
}

/// The cost of a step at one size.
#[derive(Debug, Clone, PartialEq)]
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

/// Measures the scaling with so many `repeats`, each call in a directory of its own in that of `context`.
///
/// # Errors
/// If a run is interrupted, or files cannot be written.
pub fn measure_scaling(
    repeats: Option<usize>,
    context: &RunContext,
) -> Result<Scaling, BenchError> {
    let lanes = InstalledTarget::find(BenchTarget::NativeLanes, &SettledCode::native())?;
    let planned = plans((&SettledCode::native(), PAPER_BODIES), STACKS).into_iter();
    let planned: Vec<Case> = planned.flat_map(|plan| plan.cases).collect();
    let cores = numbers_of_cores();
    let mut over_cases = CASES.map(|_| Vec::new());
    let mut over_cores = vec![Vec::new(); cores.len()];
    for _ in 0..repeats.unwrap_or(REPEATS) {
        for (&cases, measured) in CASES.iter().zip(&mut over_cases) {
            measured.push(in_lanes(&lanes, cases, context)?);
        }
        for (&cores, measured) in cores.iter().zip(&mut over_cores) {
            measured.push(on_cores(&lanes, &planned, cores, context)?);
        }
    }
    let over_cases = CASES.iter().map(|&cases| (cases, 1)).zip(&over_cases);
    let sizes = cores.iter().map(|&cores| (planned.len(), cores));
    Ok(Scaling {
        cases: rows(over_cases),
        cores: rows(sizes.zip(&over_cores)),
    })
}

/// Returns the powers of two below the number of cores of this machine, and that number.
fn numbers_of_cores() -> Vec<usize> {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let doubled = std::iter::successors(Some(1), |cores| Some(2 * cores));
    let numbers = doubled.take_while(|&cores| cores < all);
    numbers.chain([all]).collect()
}

/// Returns nanoseconds per step and case of `count` cases in one call.
fn in_lanes(
    lanes: &InstalledTarget,
    count: usize,
    context: &RunContext,
) -> Result<f64, BenchError> {
    let cases = timed_cases(
        (&SettledCode::native(), PAPER_BODIES),
        count,
        STEPS,
        LENGTHS,
    );
    let steps: u64 = cases.iter().map(Case::total_steps).sum();
    let calls = LEAST_CASES.div_ceil(count);
    let mut seconds = 0.0;
    for _ in 0..calls {
        seconds += lanes.time(&cases, context)?.duration.as_secs_f64();
    }
    Ok(1e9 * seconds / (calls as f64 * steps as f64))
}

/// Returns nanoseconds per step and case of `cases`, distributed over so many `cores`.
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

/// Returns a row for each number of cases and of cores, from the nanoseconds of all repeats.
fn rows<'a>(sizes: impl Iterator<Item = ((usize, usize), &'a Vec<f64>)>) -> Vec<ScalingRow> {
    let mut first = None;
    let rows = sizes.map(|((cases, cores), nanoseconds)| {
        let ns_per_step = median(nanoseconds);
        ScalingRow {
            cases,
            cores,
            ns_per_step,
            speedup: *first.get_or_insert(ns_per_step) / ns_per_step,
        }
    });
    rows.collect()
}
