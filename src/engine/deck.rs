//! What a deck has to be told, under the same names in every code.

use crate::stack::Case;
use serde::Serialize;

/// The parameters of a case as the decks of the external codes read them. Stiffness and damping are those
/// of the contact itself; units r = m = k_n = 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeckParameters {
    /// k_n.
    pub normal_stiffness: f64,
    /// k_t.
    pub tangential_stiffness: f64,
    /// η_n.
    pub damping_normal: f64,
    /// η_t.
    pub damping_tangential: f64,
    /// μ.
    pub floor_friction: f64,
    /// μ_d.
    pub cylinder_friction: f64,
    /// ε.
    pub gravity: f64,
    /// Time step.
    pub time_step: f64,
    /// Speed of the wall, downwards.
    pub wall_speed: f64,
    /// Steps during which gravity rises.
    pub ramp_steps: u64,
    /// Steps at rest.
    pub rest_steps: u64,
    /// Steps of compression.
    pub compression_steps: u64,
    /// Steps between coarse rows.
    pub coarse_every: u64,
    /// First fine row.
    pub fine_from_step: u64,
    /// Steps between fine rows.
    pub fine_every: u64,
}

impl DeckParameters {
    /// The parameters of `case`.
    pub fn new(case: &Case) -> Self {
        let schedule = case.protocol.schedule();
        let tangential_stiffness = case.stack.tangential_stiffness();
        Self {
            normal_stiffness: 1.0,
            tangential_stiffness,
            damping_normal: case.convention.damping(1.0),
            damping_tangential: case.convention.damping(tangential_stiffness),
            floor_friction: case.stack.floor_friction,
            cylinder_friction: case.stack.cylinder_friction,
            gravity: case.stack.epsilon(),
            time_step: case.protocol.time_step,
            wall_speed: case.protocol.wall_speed,
            ramp_steps: schedule.ramp_steps,
            rest_steps: schedule.rest_steps,
            compression_steps: schedule.compression_steps,
            coarse_every: schedule.coarse_every,
            fine_from_step: schedule.fine_from_step,
            fine_every: schedule.fine_every,
        }
    }

    /// As a JSON object, numbers in their shortest exact form.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a struct of finite numbers has a JSON form")
            + "\n"
    }

    /// As variables of LAMMPS and LIGGGHTS. String style, because it alone passes every digit.
    pub fn to_lammps(&self) -> String {
        let value = serde_json::to_value(self).expect("a struct of finite numbers has a JSON form");
        let entries = value.as_object().into_iter().flatten();
        entries
            .map(|(name, number)| format!("variable {name} string {number}\n"))
            .collect()
    }
}
