//! Supplement, figure on convergence: the yield force over wall speed and time step, at μ = 0.2 and 1/ε = 1e4.

use crate::archive::Reading;
use crate::crosscheck::{
    Load, PAPER_TIME_STEP, Participant, Progress, RunError, Settings, protocol_at_speed, read_all,
};
use crate::engine::EngineName;
use crate::stack::{Case, Protocol, Sampling, Stack};
use crate::theory::quasistatic_limit;
use serde::Serialize;

/// Wall speeds at the paper's time step. The slowest is for the native DEM alone.
const WALL_SPEEDS: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// Time steps at [`FAST_WALL`]. The smallest is for the native DEM alone.
const TIME_STEPS: [f64; 6] = [1e-1, 5e-2, 1e-2, 5e-3, 1e-3, 1e-4];
/// Wall speed at which the paper varies the time step.
pub const FAST_WALL: f64 = 1e-3;
/// A fast wall passes the yield within a few time units: rows must be close.
const FINE_INTERVAL: f64 = 0.1;

/// The stack of the paper's convergence study.
pub fn convergence_stack() -> Stack {
    Stack::paper(0.2, 1e4)
}

/// One run of the study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConvergencePoint {
    /// Who ran it.
    pub engine: EngineName,
    /// Wall speed in r √(k_n/m).
    pub wall_speed: f64,
    /// Time step in √(m/k_n).
    pub time_step: f64,
    /// F at the onset of slip, in m g.
    pub slip_force: Option<f64>,
    /// Largest F, the paper's yield force, in m g.
    pub peak_force: Option<f64>,
    /// Exact limit under the engine's convention, in m g.
    pub limit: Option<f64>,
    /// Why there is no number.
    pub remark: Option<String>,
}

impl ConvergencePoint {
    /// (peak − limit)/limit.
    pub fn excess_of_peak(&self) -> Option<f64> {
        let (peak, limit) = self.peak_force.zip(self.limit)?;
        Some((peak - limit) / limit)
    }

    /// (slip onset − limit)/limit.
    pub fn excess_of_slip(&self) -> Option<f64> {
        let (slip, limit) = self.slip_force.zip(self.limit)?;
        Some((slip - limit) / limit)
    }
}

/// The whole study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Convergence {
    /// Over the wall speed, at the paper's time step.
    pub wall_speeds: Vec<ConvergencePoint>,
    /// Over the time step, at [`FAST_WALL`].
    pub time_steps: Vec<ConvergencePoint>,
}

/// The runs of one engine: those over the wall speed first.
fn load(engine: EngineName) -> Load {
    let own = |count: usize| match engine {
        EngineName::Native => count,
        _ => count - 1,
    };
    let speeds = WALL_SPEEDS[..own(WALL_SPEEDS.len())]
        .iter()
        .map(|&speed| (speed, PAPER_TIME_STEP));
    let steps = TIME_STEPS[..own(TIME_STEPS.len())]
        .iter()
        .map(|&step| (FAST_WALL, step));
    let cases = speeds
        .chain(steps)
        .filter_map(|(speed, step)| case(engine, speed, step));
    Load {
        engine,
        cases: cases.collect(),
    }
}

fn case(engine: EngineName, wall_speed: f64, time_step: f64) -> Option<Case> {
    let (stack, convention) = (convergence_stack(), engine.convention());
    let limit = quasistatic_limit(&stack, convention.pair_arm, convention.floor_arm);
    let protocol = protocol_at_speed(&limit, wall_speed, time_step)?;
    let sampling = Sampling {
        fine_interval: FINE_INTERVAL,
        ..protocol.sampling
    };
    let protocol = Protocol {
        sampling,
        ..protocol
    };
    Some(Case {
        stack,
        convention,
        protocol,
    })
}

/// The runs of the study, engine by engine.
pub fn convergence_loads(engines: &[EngineName]) -> Vec<Load> {
    engines.iter().map(|&engine| load(engine)).collect()
}

/// Carries out the study; also returns every reading.
pub fn converge(
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
) -> (Convergence, Vec<Reading>) {
    let engines: Vec<EngineName> = participants.iter().map(|who| who.name).collect();
    let loads = convergence_loads(&engines);
    let results = read_all(&loads, participants, settings, progress);
    let mut study = Convergence {
        wall_speeds: Vec::new(),
        time_steps: Vec::new(),
    };
    let mut readings = Vec::new();
    for (load, results) in loads.iter().zip(results) {
        let speeds = load.cases.iter();
        let speeds = speeds.filter(|case| case.protocol.time_step == PAPER_TIME_STEP);
        let speeds = speeds.count().saturating_sub(1);
        for (index, (case, result)) in load.cases.iter().zip(results).enumerate() {
            let point = point(load.engine, case, &result);
            if index < speeds {
                study.wall_speeds.push(point);
            } else {
                study.time_steps.push(point);
            }
            readings.extend(result.ok());
        }
    }
    (study, readings)
}

fn point(engine: EngineName, case: &Case, result: &Result<Reading, RunError>) -> ConvergencePoint {
    let convention = &case.convention;
    let limit = quasistatic_limit(&case.stack, convention.pair_arm, convention.floor_arm);
    let estimates = result.as_ref().ok().map(|reading| reading.estimates);
    let force = |estimate: Option<crate::trace::Estimate>| estimate.map(|estimate| estimate.force);
    ConvergencePoint {
        engine,
        wall_speed: case.protocol.wall_speed,
        time_step: case.protocol.time_step,
        slip_force: estimates.and_then(|read| force(read.slip)),
        peak_force: estimates.and_then(|read| force(read.peak)),
        limit: limit.yield_force,
        remark: result.as_ref().err().map(ToString::to_string),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_of_the_study_is_valid_and_short_enough_for_every_day() {
        for load in convergence_loads(&EngineName::ALL) {
            let native = load.engine == EngineName::Native;
            assert_eq!(load.cases.len(), if native { 11 } else { 9 });
            for case in &load.cases {
                case.validate().unwrap();
                assert!(native || case.total_steps() < 3_000_000);
            }
        }
    }
}
