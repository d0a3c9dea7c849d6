//! The parameters of tasks, under the same names for every code. Units r = m = k_n = 1.

use super::manifest_error::refused;
use crate::model::{
    Case, ContactConvention, ContactTest, Drive, InvalidValue, Material, PAPER_BODIES,
    PreparationSteps, Pyramid, Stack,
};
use serde_json::{Map, Value, json};

/// Refuses parameters that are not finite numbers, or lists of such and of words: some parameters of a micro-test were
/// measured with the code.
pub(super) fn only_numbers(parameters: &Value) -> Result<(), InvalidValue> {
    let mut named = parameters.as_object().into_iter().flatten();
    named.try_for_each(|(name, value)| finite(name, value))
}

fn finite(name: &str, value: &Value) -> Result<(), InvalidValue> {
    match value {
        Value::Number(_) => Ok(()),
        Value::Array(entries) => (1..)
            .zip(entries)
            .filter(|(_, entry)| !entry.is_string())
            .try_for_each(|(number, entry)| finite(&format!("{name}[{number}]"), entry)),
        Value::Object(entries) => entries
            .iter()
            .try_for_each(|(key, value)| finite(&format!("{name}.{key}"), value)),
        other => Err(refused(name, other, "a finite number")),
    }
}

/// Returns the parameters of a case as the decks of the external codes read them.
pub(super) fn of_case(case: &Case) -> Value {
    let schedule = case.protocol.schedule();
    let epsilon = case.stack.epsilon();
    merged([
        of_stack(&case.convention, &case.stack),
        of_preparation(&schedule.preparation, epsilon),
        of_spheres(&case.stack),
        json!({
            "gravity": epsilon,
            "time_step": case.protocol.time_step,
            // Downwards.
            "wall_speed": case.protocol.wall_speed,
            "compression_steps": schedule.compression_steps,
            "coarse_every": schedule.coarse_every,
            "fine_from_step": schedule.fine_from_step,
            "fine_every": schedule.fine_every,
        }),
    ])
}

/// Returns where spheres start and how they are numbered; nothing for cylinders.
fn of_spheres(stack: &Stack) -> Value {
    if stack.bodies == PAPER_BODIES {
        return json!({});
    }
    let centres = stack.initial_positions();
    merged([
        json!({ "spheres": centres.len(), "top": stack.top() + 1 }),
        initial_positions(&centres, "xyz"),
    ])
}

/// Returns initial_x1, initial_y1, …
pub(super) fn initial_positions(centres: &[[f64; 3]], axes: &str) -> Value {
    let mut own = json!({});
    for (number, centre) in (1..).zip(centres) {
        for (axis, coordinate) in axes.chars().zip(centre) {
            own[format!("initial_{axis}{number}")] = (*coordinate).into();
        }
    }
    own
}

fn of_stack(convention: &ContactConvention, stack: &Stack) -> Value {
    let (mu, mu_d) = (stack.floor_friction, stack.cylinder_friction);
    of_contacts(convention, stack.stiffness_ratio, mu, mu_d)
}

fn of_contacts(convention: &ContactConvention, stiffness_ratio: f64, mu: f64, mu_d: f64) -> Value {
    merged([
        json!(convention.law(stiffness_ratio)),
        json!({ "floor_friction": mu, "cylinder_friction": mu_d }),
        of_law(convention, stiffness_ratio),
    ])
}

/// Returns what a deck needs beyond the coefficients of a pair if the law is not linear.
fn of_law(convention: &ContactConvention, stiffness_ratio: f64) -> Value {
    let law = &convention.law;
    if law.is_linear() {
        return json!({});
    }
    let wall = convention.wall_law(stiffness_ratio);
    let material = Material::of_pairs(law.power, stiffness_ratio);
    merged([
        json!({
            "normal_power": law.power,
            "floor_normal_stiffness": wall.normal_stiffness,
            "floor_tangential_stiffness": wall.tangential_stiffness,
            "floor_damping_normal": wall.damping_normal,
            "floor_damping_tangential": wall.damping_tangential,
        }),
        material.map_or(json!({}), |material| json!(material)),
    ])
}

/// Returns the parameters of a preparation; each kind has its own deck.
fn of_preparation(preparation: &PreparationSteps, epsilon: f64) -> Value {
    match preparation {
        PreparationSteps::GravityRamp { ramp, rest } => json!({
            "ramp_steps": ramp,
            "rest_steps": rest,
        }),
        PreparationSteps::SideWalls(steps) => json!({
            "push_speed": steps.push_speed,
            "push_steps": steps.push_steps,
            "hold_steps": steps.hold_steps,
            // Height at which the top cylinder is let go, and how far it is lowered to get there.
            "landing_height": steps.landing_height(epsilon),
            "fall": steps.fall,
            "fall_speed": steps.walls.fall_speed,
            "fall_steps": steps.fall_steps,
            "landing_speed": steps.walls.landing_speed,
            "settle_steps": steps.settle_steps,
            "withdrawal_speed": steps.walls.withdrawal_speed,
            "withdrawal_steps": steps.withdrawal_steps,
            "rest_steps": steps.rest_steps,
        }),
        PreparationSteps::Rigid => json!({}),
    }
}

/// The parameters of a micro-test: cylinders 1 and 2 start with x1, y1, vx1, vy1, spin1, x2, …
pub(super) fn of_contact_test(test: &ContactTest) -> Value {
    let (mu, mu_d) = (test.floor_friction, test.cylinder_friction);
    let [one, two] = &test.initial_motions;
    let bodies = match &test.space {
        None => merged([
            json!({ "x1": one.x, "y1": one.y, "vx1": one.vx, "vy1": one.vy, "spin1": one.spin }),
            json!({ "x2": two.x, "y2": two.y, "vx2": two.vx, "vy2": two.vy, "spin2": two.spin }),
            of_drive(test),
        ]),
        Some(space) => {
            let bodies = test.initial_motions.iter().zip(space);
            let mut own = json!({});
            for (number, (plane, beyond)) in (1..).zip(bodies) {
                for (name, value) in [
                    ("x", plane.x),
                    ("y", plane.y),
                    ("z", beyond.z),
                    ("vx", plane.vx),
                    ("vy", plane.vy),
                    ("vz", beyond.vz),
                    ("spinx", beyond.spinx),
                    ("spiny", beyond.spiny),
                    ("spinz", plane.spin),
                ] {
                    own[format!("{name}{number}")] = value.into();
                }
            }
            own
        }
    };
    merged([
        of_contacts(&test.convention, test.stiffness_ratio, mu, mu_d),
        json!({
            "time_step": test.time_step,
            "steps": test.steps,
            "wall_height": test.wall_height,
            // Downwards.
            "wall_speed": test.wall_speed,
        }),
        bodies,
    ])
}

/// Returns the legs of a prescribed motion: none for the linear law, whose decks do not know them; no steps where
/// both cylinders are free.
fn of_drive(test: &ContactTest) -> Value {
    if test.convention.law.is_linear() {
        return json!({});
    }
    let free = Drive {
        leg_steps: 0,
        legs: [[0.0; 2]; 4],
    };
    let Drive { leg_steps, legs } = test.drive.unwrap_or(free);
    let mut own = json!({ "leg_steps": leg_steps });
    for (number, [vx, vy]) in (1..).zip(legs) {
        own[format!("leg{number}_vx1")] = vx.into();
        own[format!("leg{number}_vy1")] = vy.into();
    }
    own
}

/// The parameters of a pyramid.
pub(super) fn of_pyramid(pyramid: &Pyramid) -> Value {
    merged([
        of_stack(&pyramid.convention, &pyramid.groups),
        json!({
            "gravity": pyramid.groups.epsilon(),
            "time_step": pyramid.time_step,
            // Distance of the side walls from the middle.
            "half_width": pyramid.half_width(),
            "ramp_steps": pyramid.ramp_steps,
            "rest_steps": pyramid.rest_steps,
            "timed_steps": pyramid.timed_steps,
        }),
    ])
}

/// Merges the entries of all `objects` into one.
pub(super) fn merged<const N: usize>(objects: [Value; N]) -> Value {
    let mut entries = Map::new();
    for mut object in objects {
        entries.append(object.as_object_mut().unwrap_or(&mut Map::new()));
    }
    entries.into()
}

/// Returns name and content of the file with the cylinders of `pyramid` in its box, in the format that `read_data` of
/// LAMMPS and LIGGGHTS understands: atom, type, diameter, density, centre. There are three types, as the contacts of
/// LIGGGHTS need them; the deck sets the mass.
pub(super) fn placed_cylinders(pyramid: &Pyramid) -> (&'static str, String) {
    let x = pyramid.half_width() + 1.0;
    let y = 2.0 * f64::from(pyramid.rows) + 1.0;
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
