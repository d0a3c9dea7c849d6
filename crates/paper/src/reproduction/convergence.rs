//! Supplement, figure on convergence: the yield force over wall speed and time step, at μ = 0.2 and 1/ε = 1e4.

use super::case_at_speed;
use crate::code::{Code, SettledCode};
use crate::model::{Case, Stack};
use crate::runs::{RunError, RunSummary, Workload};
use crate::study::Campaign;
use crate::study::yield_force::PAPER_TIME_STEP;
use crate::theory::quasistatic_limit;

/// Wall speeds at the paper's time step. Only the native DEM runs the slowest.
pub const WALL_SPEEDS: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Time steps at [`FAST_WALL`]. Only the native DEM runs the smallest.
const TIME_STEPS: [f64; 6] = [1e-1, 5e-2, 1e-2, 5e-3, 1e-3, 1e-4];
/// Wall speed at which the paper varies the time step.
pub const FAST_WALL: f64 = 1e-3;
/// Interval of the rows, small because a fast wall passes the yield within a few time units.
const FINE_INTERVAL: f64 = 0.1;

/// Returns the stack of the paper's convergence study.
pub fn convergence_stack() -> Stack {
    Stack::paper(0.2, 1e4)
}

/// One run of the study.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvergencePoint {
    /// The code that ran it.
    pub code: Code,
    /// Wall speed in r √(k_n/m).
    pub wall_speed: f64,
    /// Time step in √(m/k_n).
    pub time_step: f64,
    /// F at the onset of slip, in m g.
    pub slip_force: Option<f64>,
    /// Largest F, the paper's yield force, in m g.
    pub peak_force: Option<f64>,
    /// Exact limit under the code's convention, in m g.
    pub limit: Option<f64>,
    /// The reason why there is no number.
    pub remark: Option<String>,
}

impl ConvergencePoint {
    /// Returns (peak − limit)/limit.
    pub fn excess_of_peak(&self) -> Option<f64> {
        self.excess(self.peak_force)
    }

    /// Returns (slip onset − limit)/limit.
    pub fn excess_of_slip(&self) -> Option<f64> {
        self.excess(self.slip_force)
    }

    fn excess(&self, force: Option<f64>) -> Option<f64> {
        let (force, limit) = force.zip(self.limit)?;
        Some((force - limit) / limit)
    }
}

/// The whole study.
#[derive(Debug, Clone, PartialEq)]
pub struct Convergence {
    /// Over the wall speed, at the paper's time step.
    pub wall_speeds: Vec<ConvergencePoint>,
    /// Over the time step, at a wall speed of 1e-3.
    pub time_steps: Vec<ConvergencePoint>,
}

/// Returns the wall speeds at which `code` runs.
fn wall_speeds(code: &Code) -> &'static [f64] {
    &WALL_SPEEDS[..WALL_SPEEDS.len() - usize::from(!code.is_native())]
}

/// Returns the time steps at which `code` runs.
fn time_steps(code: &Code) -> &'static [f64] {
    &TIME_STEPS[..TIME_STEPS.len() - usize::from(!code.is_native())]
}

/// Returns the runs of one code, those over the wall speed first.
fn workload(code: &SettledCode) -> Workload {
    let speeds = wall_speeds(code.name()).iter();
    let speeds = speeds.filter_map(|&speed| case(code, speed, PAPER_TIME_STEP));
    let steps = time_steps(code.name()).iter();
    let steps = steps.filter_map(|&step| case(code, FAST_WALL, step));
    Workload {
        code: code.name().clone(),
        tasks: speeds.chain(steps).collect(),
    }
}

fn case(code: &SettledCode, wall_speed: f64, time_step: f64) -> Option<Case> {
    let mut case = case_at_speed(code, convergence_stack(), wall_speed, time_step)?;
    case.protocol.sampling.fine_interval = FINE_INTERVAL;
    Some(case)
}

/// Returns the runs of the study, code by code.
pub fn convergence_workloads(codes: &[SettledCode]) -> Vec<Workload> {
    codes.iter().map(workload).collect()
}

/// Runs the study; also returns every summary.
pub fn converge(campaign: &Campaign) -> (Convergence, Vec<RunSummary>) {
    let workloads = convergence_workloads(&campaign.settled());
    let results: Vec<Vec<Result<RunSummary, RunError>>> = campaign.read(&workloads);
    let mut study = Convergence {
        wall_speeds: Vec::new(),
        time_steps: Vec::new(),
    };
    for (workload, results) in workloads.iter().zip(&results) {
        let runs = workload.tasks.iter().zip(results);
        let mut points = runs.map(|(case, result)| point(&workload.code.clone(), case, result));
        let speeds = wall_speeds(&workload.code).len();
        study.wall_speeds.extend(points.by_ref().take(speeds));
        study.time_steps.extend(points);
    }
    let summaries = results.into_iter().flatten().flatten();
    (study, summaries.collect())
}

fn point(code: &Code, case: &Case, result: &Result<RunSummary, RunError>) -> ConvergencePoint {
    let problem = case.problem().ok();
    let estimates = result.as_ref().ok().map(|summary| summary.estimates);
    ConvergencePoint {
        code: code.clone(),
        wall_speed: case.protocol.wall_speed,
        time_step: case.protocol.time_step,
        slip_force: estimates.and_then(|read| Some(read.slip?.force)),
        peak_force: estimates.and_then(|read| Some(read.peak?.force)),
        limit: problem.and_then(|own| quasistatic_limit(&own).yield_force),
        remark: result.as_ref().err().map(ToString::to_string),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Power;

    #[test]
    fn every_run_of_the_study_is_valid_and_short_enough_for_every_day() {
        for workload in convergence_workloads(&SettledCode::with_power(Power::Linear)) {
            let native = workload.code.is_native();
            assert_eq!(workload.tasks.len(), if native { 11 } else { 9 });
            for case in &workload.tasks {
                case.validate().unwrap();
                assert!(native || case.total_steps() < 3_000_000);
            }
        }
    }
}
