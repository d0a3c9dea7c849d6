//! The parameters of tasks, under the same names for every code.

use crate::model::{
    Case, ContactConvention, ContactLaw, ContactTest, InitialMotion, InvalidValue,
    PreparationSteps, Pyramid, Stack,
};
use serde::Serialize;
use std::collections::BTreeMap;

/// Parameters of the contacts; units r = m = k_n = 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ContactParameters {
    #[serde(flatten)]
    law: ContactLaw,
    /// μ.
    floor_friction: f64,
    /// μ_d.
    cylinder_friction: f64,
}

impl ContactParameters {
    fn of_stack(convention: &ContactConvention, stack: &Stack) -> Self {
        Self {
            law: convention.law(stack.stiffness_ratio),
            floor_friction: stack.floor_friction,
            cylinder_friction: stack.cylinder_friction,
        }
    }
}

/// Refuses parameters that are not finite numbers: some of those of a micro-test were measured with the code.
pub(super) fn only_numbers(parameters: &serde_json::Value) -> Result<(), InvalidValue> {
    let mut named = parameters.as_object().into_iter().flatten();
    let other = named.find(|(_, value)| !value.is_number());
    other.map_or(Ok(()), |(name, value)| {
        Err(InvalidValue {
            key: name.clone(),
            value: value.to_string(),
            accepted: "a finite number".to_owned(),
        })
    })
}

/// The parameters of a case as the decks of the external codes read them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct DeckParameters {
    #[serde(flatten)]
    contact: ContactParameters,
    /// ε.
    gravity: f64,
    time_step: f64,
    /// Speed of the wall, downwards.
    wall_speed: f64,
    /// How the stack is brought to rest.
    #[serde(flatten)]
    preparation: PreparationParameters,
    /// Steps of compression.
    compression_steps: u64,
    /// Steps between coarse rows.
    coarse_every: u64,
    /// First fine row.
    fine_from_step: u64,
    /// Steps between fine rows.
    fine_every: u64,
}

impl DeckParameters {
    pub(super) fn new(case: &Case) -> Self {
        let schedule = case.protocol.schedule();
        Self {
            contact: ContactParameters::of_stack(&case.convention, &case.stack),
            gravity: case.stack.epsilon(),
            time_step: case.protocol.time_step,
            wall_speed: case.protocol.wall_speed,
            preparation: PreparationParameters::new(&schedule.preparation, case.stack.epsilon()),
            compression_steps: schedule.compression_steps,
            coarse_every: schedule.coarse_every,
            fine_from_step: schedule.fine_from_step,
            fine_every: schedule.fine_every,
        }
    }
}

/// The parameters of a preparation, each kind for a deck of its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub(super) enum PreparationParameters {
    /// Gravity rises.
    GravityRamp {
        /// Steps during which gravity rises.
        ramp_steps: u64,
        /// Steps at rest.
        rest_steps: u64,
    },
    /// Side walls hold the bottom cylinders while the top one is put on them.
    SideWalls {
        /// Speed of the walls inwards.
        push_speed: f64,
        /// Steps during which they move inwards.
        push_steps: u64,
        /// Steps at rest after that.
        hold_steps: u64,
        /// Height of the top cylinder where it is let go.
        landing_height: f64,
        /// How far it is lowered until there.
        fall: f64,
        /// Speed at which it is lowered.
        fall_speed: f64,
        /// Steps during which it is lowered.
        fall_steps: u64,
        /// Speed with which it is let go.
        landing_speed: f64,
        /// Steps at rest under it.
        settle_steps: u64,
        /// Speed of the walls outwards.
        withdrawal_speed: f64,
        /// Steps during which they move outwards.
        withdrawal_steps: u64,
        /// Steps at rest without walls.
        rest_steps: u64,
    },
}

impl PreparationParameters {
    fn new(preparation: &PreparationSteps, epsilon: f64) -> Self {
        match *preparation {
            PreparationSteps::GravityRamp { ramp, rest } => Self::GravityRamp {
                ramp_steps: ramp,
                rest_steps: rest,
            },
            PreparationSteps::SideWalls(steps) => Self::SideWalls {
                push_speed: steps.push_speed,
                push_steps: steps.push_steps,
                hold_steps: steps.hold_steps,
                landing_height: steps.landing_height(epsilon),
                fall: steps.fall,
                fall_speed: steps.walls.fall_speed,
                fall_steps: steps.fall_steps,
                landing_speed: steps.walls.landing_speed,
                settle_steps: steps.settle_steps,
                withdrawal_speed: steps.walls.withdrawal_speed,
                withdrawal_steps: steps.withdrawal_steps,
                rest_steps: steps.rest_steps,
            },
        }
    }
}

/// The parameters of a micro-test as the decks of the external codes read them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct ProbeParameters {
    #[serde(flatten)]
    contact: ContactParameters,
    time_step: f64,
    /// Number of steps.
    steps: u64,
    /// Height of the top wall at step 0.
    wall_height: f64,
    /// Speed of the top wall, downwards.
    wall_speed: f64,
    /// Position, velocity and spin of cylinders 1 and 2, as x1, y1, vx1, vy1, spin1, x2, …
    #[serde(flatten)]
    initial_motions: BTreeMap<String, f64>,
}

impl ProbeParameters {
    pub(super) fn new(test: &ContactTest) -> Self {
        let bodies = test.initial_motions.iter().zip(1..);
        let initial_motions = bodies.flat_map(|(motion, body)| {
            let InitialMotion { x, y, vx, vy, spin } = *motion;
            let values = [("x", x), ("y", y), ("vx", vx), ("vy", vy), ("spin", spin)];
            values.map(|(name, value)| (format!("{name}{body}"), value))
        });
        Self {
            contact: ContactParameters {
                law: test.convention.law(test.stiffness_ratio),
                floor_friction: test.floor_friction,
                cylinder_friction: test.cylinder_friction,
            },
            time_step: test.time_step,
            steps: test.steps,
            wall_height: test.wall_height,
            wall_speed: test.wall_speed,
            initial_motions: initial_motions.collect(),
        }
    }
}

/// The parameters of a pyramid as the decks of the external codes read them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct PyramidParameters {
    #[serde(flatten)]
    contact: ContactParameters,
    /// ε.
    gravity: f64,
    time_step: f64,
    /// Distance of the side walls from the middle.
    half_width: f64,
    /// Steps during which gravity rises.
    ramp_steps: u64,
    /// Steps at rest.
    rest_steps: u64,
    /// Steps the time for which is measured.
    timed_steps: u64,
}

impl PyramidParameters {
    pub(super) fn new(pyramid: &Pyramid) -> Self {
        let groups = &pyramid.groups;
        Self {
            contact: ContactParameters::of_stack(&pyramid.convention, groups),
            gravity: groups.epsilon(),
            time_step: pyramid.time_step,
            half_width: pyramid.half_width(),
            ramp_steps: pyramid.ramp_steps,
            rest_steps: pyramid.rest_steps,
            timed_steps: pyramid.timed_steps,
        }
    }
}

/// Name and content of the file with the cylinders of `pyramid` in its box, in the format that `read_data` of
/// LAMMPS and LIGGGHTS understands: atom, type, diameter, density, centre. Three types, as the contacts of
/// LIGGGHTS have them; the mass is set by the deck.
pub(super) fn placed_cylinders(pyramid: &Pyramid) -> (&'static str, String) {
    let (x, y) = (
        pyramid.half_width() + 1.0,
        2.0 * f64::from(pyramid.rows) + 1.0,
    );
    let mut text = format!(
        "{pyramid}\n\n{} atoms\n3 atom types\n{} {x} xlo xhi\n-1 {y} ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms\n\n",
        pyramid.cylinder_count(),
        -x,
    );
    for (atom, [x, y]) in (1..).zip(pyramid.centres()) {
        text += &format!("{atom} 1 2 1 {x} {y} 0\n");
    }
    ("cylinders.data", text)
}
