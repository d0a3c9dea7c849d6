//! The result of one compression run.

use super::number::{friction, optional, significant};
use super::table::Table;
use crate::code::Run;
use crate::model::Case;
use crate::series::YieldEstimates;
use serde::Serialize;

/// What one run says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Simulation {
    /// Who ran it.
    pub code: String,
    /// In which version.
    pub version: String,
    /// What was run.
    pub case: Case,
    /// Largest wall force in m g, absent if the force still rises at the end.
    pub peak_force: Option<f64>,
    /// Wall force in m g when the floor first slips, absent if it does not.
    pub slip_force: Option<f64>,
    /// Steps in all.
    pub steps: u64,
    /// Wall time.
    pub seconds: f64,
}

impl Simulation {
    /// The result of `run`, off which `estimates` were read.
    pub fn new(run: &Run, estimates: YieldEstimates) -> Self {
        Self {
            code: run.provenance.identity.code.clone(),
            version: run.provenance.identity.version.clone(),
            case: run.case,
            peak_force: estimates.peak.map(|estimate| estimate.force),
            slip_force: estimates.slip.map(|estimate| estimate.force),
            steps: run.provenance.steps,
            seconds: run.provenance.seconds,
        }
    }
}

/// As one object.
pub fn simulation_json(simulation: &Simulation) -> String {
    serde_json::to_string_pretty(simulation).expect("plain data has a JSON form") + "\n"
}

#[derive(Serialize)]
struct FlatRow<'a> {
    code: &'a str,
    version: &'a str,
    mu: f64,
    stiffness: f64,
    kappa: f64,
    pair_torque_arm: f64,
    pair_kinematic_arm: f64,
    floor_torque_arm: f64,
    floor_kinematic_arm: f64,
    speed: f64,
    dt: f64,
    peak_force: Option<f64>,
    slip_force: Option<f64>,
    steps: u64,
    seconds: f64,
}

/// As one line.
pub fn simulation_csv(simulation: &Simulation) -> Vec<u8> {
    let case = &simulation.case;
    let mut writer = csv::Writer::from_writer(Vec::new());
    let row = FlatRow {
        code: &simulation.code,
        version: &simulation.version,
        mu: case.stack.floor_friction,
        stiffness: case.stack.stiffness,
        kappa: case.stack.stiffness_ratio,
        pair_torque_arm: case.convention.arms.pair.torque,
        pair_kinematic_arm: case.convention.arms.pair.kinematic,
        floor_torque_arm: case.convention.arms.floor.torque,
        floor_kinematic_arm: case.convention.arms.floor.kinematic,
        speed: case.protocol.wall_speed,
        dt: case.protocol.time_step,
        peak_force: simulation.peak_force,
        slip_force: simulation.slip_force,
        steps: simulation.steps,
        seconds: simulation.seconds,
    };
    writer
        .serialize(row)
        .expect("a plain row is written to memory");
    writer.into_inner().expect("memory is flushed")
}

/// For people.
pub fn simulation_table(simulation: &Simulation) -> String {
    let case = &simulation.case;
    let mut table = Table::new(&["quantity", "value>", "unit"]);
    let mut line = |name: &str, value: String, unit: &str| {
        table.push(vec![name.to_owned(), value, unit.to_owned()]);
    };
    line(
        "code",
        format!("{} {}", simulation.code, simulation.version),
        "",
    );
    line("mu", friction(case.stack.floor_friction), "");
    line("stiffness", case.stack.stiffness.to_string(), "m g/r");
    line(
        "wall speed",
        format!("{:.3e}", case.protocol.wall_speed),
        "r sqrt(k_n/m)",
    );
    line(
        "time step",
        case.protocol.time_step.to_string(),
        "sqrt(m/k_n)",
    );
    let force = |force: Option<f64>| optional(force, |force| significant(force, 9));
    line("slip onset", force(simulation.slip_force), "m g");
    line("peak", force(simulation.peak_force), "m g");
    line("steps", simulation.steps.to_string(), "");
    line("wall time", format!("{:.2}", simulation.seconds), "s");
    table.terminal()
}
