//! Everything that a deck needs to carry out a task without deriving anything: units, bodies, contacts, steps and
//! starting positions. Each number is declared once.

use super::manifest::TaskKind;
use super::parameters::{self, merged};
use crate::model::{Case, ContactConvention, ContactTest, PAPER_BODIES, PreparationSteps, Pyramid};
use serde_json::{Map, Value, json};

/// Raised when a parameter is removed or changes its meaning.
const SCHEMA: u32 = 1;

/// A named number of a task.
#[derive(Debug)]
pub struct Parameter {
    pub name: &'static str,
    pub unit: &'static str,
    pub meaning: &'static str,
    /// The tasks that have it.
    pub tasks: &'static [TaskKind],
    /// The condition under which they have it.
    pub when: When,
}

/// The condition under which a task has a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// Always.
    Every,
    /// With every law except the paper's linear one.
    NotLinear,
    /// With Hertz's law, at a stiffness ratio from 1 to 1.5.
    Material,
    /// In stacks of five spheres or more.
    FiveSpheres,
    /// In stacks of six spheres.
    SixSpheres,
}

impl When {
    /// The condition in words; `None` if there is none.
    pub fn limits(self) -> Option<&'static str> {
        match self {
            Self::Every => None,
            Self::NotLinear => Some("laws other than linear alone"),
            Self::Material => Some("power 1.5 at a stiffness ratio from 1 to 1.5 alone"),
            Self::FiveSpheres => Some("stacks of five spheres or more alone"),
            Self::SixSpheres => Some("stacks of six spheres alone"),
        }
    }
}

use TaskKind::{Motion, Pyramid as Pile, SideWalls, Spheres, SpheresMotion, Stack};

const EVERY: &[TaskKind] = &[Stack, SideWalls, Motion, Pile, Spheres, SpheresMotion];
const COMPRESSION: &[TaskKind] = &[Stack, SideWalls, Spheres];
const AT_REST: &[TaskKind] = &[Stack, SideWalls, Pile, Spheres];
const RAMP: &[TaskKind] = &[Stack, Pile, Spheres];
const WALL: &[TaskKind] = &[Stack, SideWalls, Motion, Spheres, SpheresMotion];
const WALLS: &[TaskKind] = &[SideWalls];
const TESTS: &[TaskKind] = &[Motion, SpheresMotion];
const TEST: &[TaskKind] = &[Motion];
const TEST_IN_SPACE: &[TaskKind] = &[SpheresMotion];
const PILE: &[TaskKind] = &[Pile];
const RING: &[TaskKind] = &[Spheres];

const TIME: &str = "√(m/k_n)";
const SPEED: &str = "r √(k_n/m)";
const DAMPING: &str = "√(m k_n)";

macro_rules! parameters {
    ($($name:literal, $unit:expr, $tasks:ident $(where $when:ident)?, $meaning:literal;)*) => {
        /// Every parameter of every task.
        pub static PARAMETERS: &[Parameter] = &[$(Parameter {
            name: $name,
            unit: $unit,
            meaning: $meaning,
            tasks: $tasks,
            when: parameters!(@when $($when)?),
        }),*];
    };
    (@when) => { When::Every };
    (@when $when:ident) => { When::$when };
}

parameters! {
    "schema", "1", EVERY, "version of this list";
    "radius", "r", EVERY, "radius of a body, a cylinder or sphere: 1, the unit of length";
    "mass", "m", EVERY, "mass of a body: 1, the unit of mass";
    "moment_of_inertia", "m r²", EVERY, "moment of inertia of a body: of a cylinder about its axis; of a sphere 0.4";
    "normal_stiffness", "k_n", EVERY, "stiffness of every contact along its normal, those of the walls included: 1";
    "tangential_stiffness", "k_n", EVERY, "stiffness of the tangential spring of every contact with friction";
    "normal_power", "1", EVERY where NotLinear, "exponent p of the normal force: normal_stiffness overlap^p; tangential_stiffness and damping are those at an overlap of r, and grow with its powers p - 1 and, in the convention of most codes, (p - 1)/2";
    "floor_normal_stiffness", "k_n", EVERY where NotLinear, "normal_stiffness of the floor and of other walls";
    "floor_tangential_stiffness", "k_n", EVERY where NotLinear, "tangential_stiffness of the floor";
    "floor_damping_normal", DAMPING, EVERY where NotLinear, "damping_normal of the floor and of other walls";
    "floor_damping_tangential", DAMPING, EVERY where NotLinear, "damping_tangential of the floor";
    "youngs_modulus", "k_n/r", EVERY where Material, "Young's modulus of equal spheres for which Hertz's force between two of them is normal_stiffness overlap^1.5";
    "poisson_ratio", "1", EVERY where Material, "their Poisson's ratio, with which Mindlin's stiffness between two of them is tangential_stiffness overlap^0.5";
    "restitution", "1", EVERY, "restitution that the damping of both springs gives";
    "damping_normal", DAMPING, EVERY, "force of the dashpot beside the normal spring, over the speed of approach";
    "damping_tangential", DAMPING, EVERY, "force of the dashpot beside the tangential spring, over the speed of sliding";
    "floor_friction", "1", EVERY, "friction coefficient of body and floor; the other walls have none";
    "cylinder_friction", "1", EVERY, "friction coefficient between bodies";
    "gravity", "k_n r/m", EVERY, "gravity, downwards, at its full value, which it has from the first step where it does not rise; 0 in a micro-test";
    "time_step", TIME, EVERY, "time step";
    "initial_x1", "r", COMPRESSION, "horizontal position of body 1 before the first step, of cylinders the one on top; every body starts at rest and without rotation";
    "initial_y1", "r", COMPRESSION, "height of its centre above the floor";
    "initial_x2", "r", COMPRESSION, "horizontal position of body 2 before the first step, of cylinders the one on the right";
    "initial_y2", "r", COMPRESSION, "height of its centre above the floor";
    "initial_x3", "r", COMPRESSION, "horizontal position of body 3 before the first step, of cylinders the one on the left";
    "initial_y3", "r", COMPRESSION, "height of its centre above the floor";
    "spheres", "1", RING, "number of spheres: those of the ring and the one on top";
    "top", "1", RING, "number of the sphere on top, from 1 on";
    "initial_z1", "r", RING, "its other horizontal position; x, y and z are right-handed";
    "initial_z2", "r", RING, "its other horizontal position; x, y and z are right-handed";
    "initial_z3", "r", RING, "its other horizontal position; x, y and z are right-handed";
    "initial_x4", "r", RING, "horizontal position of sphere 4 before the first step";
    "initial_y4", "r", RING, "height of its centre above the floor";
    "initial_z4", "r", RING, "its other horizontal position; x, y and z are right-handed";
    "initial_x5", "r", RING where FiveSpheres, "horizontal position of sphere 5 before the first step";
    "initial_y5", "r", RING where FiveSpheres, "height of its centre above the floor";
    "initial_z5", "r", RING where FiveSpheres, "its other horizontal position; x, y and z are right-handed";
    "initial_x6", "r", RING where SixSpheres, "horizontal position of sphere 6 before the first step";
    "initial_y6", "r", RING where SixSpheres, "height of its centre above the floor";
    "initial_z6", "r", RING where SixSpheres, "its other horizontal position; x, y and z are right-handed";
    "ramp_steps", "1", RAMP, "steps in which gravity rises from 0 as x³(10 − 15x + 6x²), x = step/ramp_steps";
    "push_speed", SPEED, WALLS, "speed with which the side walls, at ±2, move inwards";
    "push_steps", "1", WALLS, "steps in which they do; cylinder 1 is held where it starts";
    "hold_steps", "1", WALLS, "steps of rest after that";
    "landing_height", "r", WALLS, "height of cylinder 1 where it is let go";
    "fall", "r", WALLS, "distance by which it is lowered until there";
    "fall_speed", SPEED, WALLS, "speed with which it is lowered, without rotation";
    "fall_steps", "1", WALLS, "steps in which it is lowered";
    "landing_speed", SPEED, WALLS, "its speed when it is let go, downwards";
    "settle_steps", "1", WALLS, "steps of rest under cylinder 1";
    "withdrawal_speed", SPEED, WALLS, "speed with which the side walls move outwards";
    "withdrawal_steps", "1", WALLS, "steps in which they do; then they are gone";
    "rest_steps", "1", AT_REST, "steps of rest before the compression, or before the timed steps";
    "preparation_steps", "1", COMPRESSION, "steps before the compression in all";
    "wall_speed", SPEED, WALL, "speed of the top wall, downwards; in a compression it starts where it just touches the body on top";
    "compression_steps", "1", COMPRESSION, "steps of the compression, which step 0 of the series begins";
    "coarse_every", "1", COMPRESSION, "steps between rows from step 0 on";
    "fine_from_step", "1", COMPRESSION, "step from which rows are closer: a multiple of coarse_every";
    "fine_every", "1", COMPRESSION, "steps between rows from there to the last step, with which the series ends";
    "rows", "1", COMPRESSION, "number of rows in all";
    "wall_height", "r", TESTS, "height of the top wall at step 0";
    "steps", "1", TESTS, "number of steps; there is a row for each of them and for step 0";
    "x1", "r", TESTS, "horizontal position of body 1 at step 0";
    "y1", "r", TESTS, "height of its centre above the floor";
    "vx1", SPEED, TESTS, "its horizontal velocity";
    "vy1", SPEED, TESTS, "its vertical velocity";
    "spin1", "√(k_n/m)", TEST, "its angular velocity, counter-clockwise";
    "x2", "r", TESTS, "horizontal position of body 2 at step 0";
    "y2", "r", TESTS, "height of its centre above the floor";
    "vx2", SPEED, TESTS, "its horizontal velocity";
    "vy2", SPEED, TESTS, "its vertical velocity";
    "spin2", "√(k_n/m)", TEST, "its angular velocity, counter-clockwise";
    "z1", "r", TEST_IN_SPACE, "its other horizontal position; x, y and z are right-handed";
    "vz1", SPEED, TEST_IN_SPACE, "its velocity along z";
    "spinx1", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about x";
    "spiny1", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about y";
    "spinz1", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about z";
    "z2", "r", TEST_IN_SPACE, "its other horizontal position; x, y and z are right-handed";
    "vz2", SPEED, TEST_IN_SPACE, "its velocity along z";
    "spinx2", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about x";
    "spiny2", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about y";
    "spinz2", "√(k_n/m)", TEST_IN_SPACE, "its angular velocity about z";
    "leg_steps", "1", TEST where NotLinear, "steps of each of the four legs in which cylinder 1 is moved as prescribed, without rotation, and cylinder 2 held, from rest at step 0; 0 where both move freely";
    "leg1_vx1", SPEED, TEST where NotLinear, "horizontal velocity of cylinder 1 in leg 1";
    "leg1_vy1", SPEED, TEST where NotLinear, "its vertical velocity there";
    "leg2_vx1", SPEED, TEST where NotLinear, "horizontal velocity of cylinder 1 in leg 2";
    "leg2_vy1", SPEED, TEST where NotLinear, "its vertical velocity there";
    "leg3_vx1", SPEED, TEST where NotLinear, "horizontal velocity of cylinder 1 in leg 3";
    "leg3_vy1", SPEED, TEST where NotLinear, "its vertical velocity there";
    "leg4_vx1", SPEED, TEST where NotLinear, "horizontal velocity of cylinder 1 in leg 4";
    "leg4_vy1", SPEED, TEST where NotLinear, "its vertical velocity there";
    "half_width", "r", PILE, "distance of the side walls from the middle; cylinders.data has the starting positions";
    "timed_steps", "1", PILE, "steps whose duration is measured, the last ones";
}

impl TaskKind {
    /// JSON Schema of its parameters; `x-unit` is the unit of each.
    pub fn parameters_schema(self) -> Value {
        let own: Vec<&Parameter> = PARAMETERS
            .iter()
            .filter(|one| one.tasks.contains(&self))
            .collect();
        let described = own.iter().map(|one| {
            let schema =
                json!({ "description": one.meaning, "type": "number", "x-unit": one.unit });
            (one.name.to_owned(), schema)
        });
        json!({
            "type": "object",
            "properties": described.collect::<Map<_, _>>(),
            "required": own.iter().filter(|one| one.when == When::Every).map(|one| one.name).collect::<Vec<_>>(),
        })
    }
}

/// The parameters of a case.
pub(super) fn of_case(case: &Case) -> Value {
    let (schedule, epsilon) = (case.protocol.schedule(), case.stack.epsilon());
    let mut centres = case.stack.initial_positions();
    if let PreparationSteps::SideWalls(walls) = &schedule.preparation {
        // Cylinder 1 is held, and the others start with their weight on the floor.
        for (body, centre) in centres.iter_mut().enumerate() {
            centre[1] = match body {
                0 => walls.landing_height(epsilon) + walls.fall,
                _ => 1.0 - epsilon,
            };
        }
    }
    let axes = match case.stack.bodies {
        PAPER_BODIES => "xy",
        _ => "xyz",
    };
    merged([
        of_bodies(&case.convention),
        parameters::of_case(case),
        parameters::initial_positions(&centres, axes),
        json!({
            "preparation_steps": schedule.preparation.total(),
            "rows": schedule.rows(),
        }),
    ])
}

/// The parameters of a micro-test.
pub(super) fn of_contact_test(test: &ContactTest) -> Value {
    merged([
        of_bodies(&test.convention),
        parameters::of_contact_test(test),
        json!({ "gravity": 0.0 }),
    ])
}

/// The parameters of a pyramid.
pub(super) fn of_pyramid(pyramid: &Pyramid) -> Value {
    merged([
        of_bodies(&pyramid.convention),
        parameters::of_pyramid(pyramid),
    ])
}

fn of_bodies(convention: &ContactConvention) -> Value {
    json!({
        "schema": SCHEMA,
        "radius": 1.0,
        "mass": 1.0,
        "moment_of_inertia": convention.moment_of_inertia,
        "restitution": convention.restitution,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::witness_test;
    use crate::model::{Law, Preparation, Protocol, Sampling, SideWalls as Walls, Stack as Groups};

    fn case(preparation: Preparation) -> Case {
        Case {
            stack: Groups::paper(0.3, 100.0),
            convention: ContactConvention::TURNING,
            protocol: Protocol {
                preparation,
                time_step: 0.1,
                wall_speed: 1e-4,
                wall_travel: 0.7,
                sampling: Sampling {
                    coarse_interval: 60.0,
                    fine_from_travel: 0.6,
                    fine_interval: 2.0,
                },
                shortcuts: None,
            },
        }
    }

    fn ramp() -> Preparation {
        Preparation::GravityRamp {
            ramp_time: 100.0,
            rest_time: 100.0,
        }
    }

    #[test]
    fn every_number_of_every_task_is_declared_and_given() {
        let walls = Preparation::SideWalls(Walls::paper(0.005, 0.01));
        for law in [Law::LINEAR, Law::HERTZ] {
            let convention = ContactConvention::with_law(law);
            let stiffness_ratio = Groups::usual_stiffness_ratio(law.power);
            let case_of = |preparation| {
                let mut case = Case {
                    convention,
                    ..case(preparation)
                };
                case.stack.stiffness_ratio = stiffness_ratio;
                case
            };
            let test = ContactTest {
                stiffness_ratio,
                ..witness_test(convention)
            };
            let mut pyramid = Pyramid::touching(3, 100.0, convention);
            pyramid.groups.stiffness_ratio = stiffness_ratio;
            for (kind, given) in [
                (Stack, of_case(&case_of(ramp()))),
                (SideWalls, of_case(&case_of(walls))),
                (Motion, of_contact_test(&test)),
                (Pile, of_pyramid(&pyramid)),
            ] {
                let given = given.as_object().expect("an object");
                assert!(given.values().all(Value::is_number), "numbers only");
                let given: Vec<&str> = given.keys().map(String::as_str).collect();
                let own = PARAMETERS.iter().filter(|one| one.tasks.contains(&kind));
                let own = own.filter(|one| one.when == When::Every || !law.is_linear());
                let mut declared: Vec<&str> = own.map(|one| one.name).collect();
                declared.sort_unstable();
                assert_eq!(given, declared, "{kind:?}, {law}");
            }
        }
    }

    #[test]
    fn bodies_start_where_they_just_touch() {
        let given = of_case(&case(ramp()));
        let number = |name: &str| given[name].as_f64().expect("a number");
        let distance = libm::hypot(
            number("initial_x2"),
            number("initial_y1") - number("initial_y2"),
        );
        assert!((distance - 2.0).abs() < 1e-15);
        assert_eq!(
            number("initial_x2") - number("initial_x3"),
            2.0 * number("radius")
        );
        assert_eq!(number("preparation_steps"), 2000.0);
        assert_eq!(
            number("rows"),
            case(ramp()).protocol.schedule().rows() as f64
        );
    }
}
