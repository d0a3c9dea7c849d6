//! Everything that a deck needs to carry out a task without deriving anything: units, bodies, contacts, steps and
//! starting positions. Each number and each list is declared once.

use super::feature::Feature;
use super::manifest::TaskKind;
use super::parameters::{self, merged};
use crate::model::{Case, ContactConvention, ContactTest, PAPER_BODIES, PreparationSteps, Pyramid};
use serde_json::{Map, Value, json};

/// Version of the parameters, raised when a parameter is removed or changes its meaning. Parameters and features may join, and lists may grow,
/// without another version; 1 had no lists.
pub const SCHEMA: u32 = 2;

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

/// A named list of a task.
#[derive(Debug)]
pub struct List {
    pub name: &'static str,
    pub meaning: &'static str,
    /// The tasks that have it.
    pub tasks: &'static [TaskKind],
    pub entry: Entry,
}

/// What the entries of a list are.
#[derive(Debug)]
pub enum Entry {
    /// Objects with these numbers.
    Numbers(&'static [Number]),
    /// Names of features.
    Feature,
}

/// A named number of an entry.
#[derive(Debug)]
pub struct Number {
    pub name: &'static str,
    pub unit: &'static str,
    pub meaning: &'static str,
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

use TaskKind::{Motion, Pyramid as Pile, Rigid, SideWalls, Spheres, SpheresMotion, Stack};

const EVERY: &[TaskKind] = &[
    Stack,
    SideWalls,
    Motion,
    Pile,
    Spheres,
    SpheresMotion,
    Rigid,
];
const SPRINGS: &[TaskKind] = &[Stack, SideWalls, Motion, Pile, Spheres, SpheresMotion];
const FEW_BODIES: &[TaskKind] = &[Stack, SideWalls, Motion, Spheres, SpheresMotion, Rigid];
const COMPRESSION: &[TaskKind] = &[Stack, SideWalls, Spheres, Rigid];
const AT_REST: &[TaskKind] = &[Stack, SideWalls, Pile, Spheres];
const RAMP: &[TaskKind] = &[Stack, Pile, Spheres];
const WALL: &[TaskKind] = &[Stack, SideWalls, Motion, Spheres, SpheresMotion, Rigid];
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
    "schema", "1", EVERY, "version of the parameters: 2; 1, written until 2026, had no `bodies` and no `features`";
    "radius", "r", EVERY, "radius of every body, cylinder or sphere, where all are equal: 1, the unit of length";
    "mass", "m", EVERY, "mass of every body, where all are equal: 1, the unit of mass";
    "moment_of_inertia", "m r²", EVERY, "moment of inertia of every body, where all are equal: of a cylinder about its axis; of a sphere 0.4";
    "normal_stiffness", "k_n", SPRINGS, "stiffness of every contact along its normal, those of the walls included: 1";
    "tangential_stiffness", "k_n", SPRINGS, "stiffness of the tangential spring of every contact with friction";
    "normal_power", "1", SPRINGS where NotLinear, "exponent p of the normal force: normal_stiffness overlap^p; tangential_stiffness and damping are those at an overlap of r, and grow with its powers p - 1 and, in the convention of most codes, (p - 1)/2";
    "floor_normal_stiffness", "k_n", SPRINGS where NotLinear, "normal_stiffness of the floor and of other walls";
    "floor_tangential_stiffness", "k_n", SPRINGS where NotLinear, "tangential_stiffness of the floor";
    "floor_damping_normal", DAMPING, SPRINGS where NotLinear, "damping_normal of the floor and of other walls";
    "floor_damping_tangential", DAMPING, SPRINGS where NotLinear, "damping_tangential of the floor";
    "youngs_modulus", "k_n/r", EVERY where Material, "Young's modulus of equal spheres for which Hertz's force between two of them is normal_stiffness overlap^1.5";
    "poisson_ratio", "1", EVERY where Material, "their Poisson's ratio, with which Mindlin's stiffness between two of them is tangential_stiffness overlap^0.5";
    "restitution", "1", SPRINGS, "restitution of one body at a wall by the damping of both springs; that of two bodies is smaller, since these have half the mass and the same damping";
    "damping_normal", DAMPING, SPRINGS, "force of the dashpot beside the normal spring, over the speed of approach";
    "damping_tangential", DAMPING, SPRINGS, "force of the dashpot beside the tangential spring, over the speed of sliding";
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

/// Every list of every task.
pub static LISTS: &[List] = &[
    List {
        name: "features",
        meaning: "names of what is on beyond normal forces, of those under `features`; a code that does not have one of \
                  them must end with a message",
        tasks: EVERY,
        entry: Entry::Feature,
    },
    List {
        name: "bodies",
        meaning: "an entry for each body, in the order of their numbers; cylinders.data lists those of a pyramid",
        tasks: FEW_BODIES,
        entry: Entry::Numbers(&[
            Number {
                name: "radius",
                unit: "r",
                meaning: "its radius",
            },
            Number {
                name: "mass",
                unit: "m",
                meaning: "its mass",
            },
            Number {
                name: "moment_of_inertia",
                unit: "m r²",
                meaning: "its moment of inertia: of a cylinder about its axis, of a sphere about any",
            },
        ]),
    },
];

impl TaskKind {
    /// JSON Schema of its parameters; `x-unit` is the unit of each number.
    pub fn parameters_schema(self) -> Value {
        let own = PARAMETERS.iter().filter(|one| one.tasks.contains(&self));
        let lists = LISTS.iter().filter(|one| one.tasks.contains(&self));
        let numbers = own.clone().map(|one| {
            let schema = number_schema(one.meaning, one.unit);
            (one.name.to_owned(), schema)
        });
        let described = numbers.chain(lists.clone().map(|one| (one.name.to_owned(), one.schema())));
        let required = own.filter(|one| one.when == When::Every);
        let required = required.map(|one| one.name);
        json!({
            "type": "object",
            "properties": described.collect::<Map<_, _>>(),
            "required": required.chain(lists.map(|one| one.name)).collect::<Vec<_>>(),
        })
    }
}

impl List {
    fn schema(&self) -> Value {
        let items = match self.entry {
            Entry::Feature => {
                json!({ "type": "string", "enum": Feature::ALL.map(Feature::as_str) })
            }
            Entry::Numbers(numbers) => {
                let described = numbers.iter();
                let described = described
                    .map(|one| (one.name.to_owned(), number_schema(one.meaning, one.unit)));
                json!({
                    "type": "object",
                    "properties": described.collect::<Map<_, _>>(),
                    "required": numbers.iter().map(|one| one.name).collect::<Vec<_>>(),
                })
            }
        };
        json!({ "description": self.meaning, "type": "array", "items": items })
    }
}

fn number_schema(meaning: &str, unit: &str) -> Value {
    json!({ "description": meaning, "type": "number", "x-unit": unit })
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
    let [mu, mu_d] = [case.stack.floor_friction, case.stack.cylinder_friction];
    let given = merged([
        of_equal_bodies(&case.convention),
        each_body(&case.convention, centres.len()),
        features(mu, mu_d),
        parameters::of_case(case),
        parameters::initial_positions(&centres, axes),
        json!({
            "preparation_steps": schedule.preparation.total(),
            "rows": schedule.rows(),
        }),
    ]);
    match schedule.preparation {
        PreparationSteps::Rigid => without_springs(given),
        _ => given,
    }
}

/// Leaves out of `given` what rigid bodies do not have.
fn without_springs(mut given: Value) -> Value {
    if let Some(given) = given.as_object_mut() {
        let of_springs = |name: &str| {
            let mut declared = PARAMETERS.iter().filter(|one| one.name == name);
            declared.any(|one| !one.tasks.contains(&Rigid))
        };
        given.retain(|name, _| !of_springs(name));
    }
    given
}

/// The parameters of a micro-test.
pub(super) fn of_contact_test(test: &ContactTest) -> Value {
    merged([
        of_equal_bodies(&test.convention),
        each_body(&test.convention, test.initial_motions.len()),
        features(test.floor_friction, test.cylinder_friction),
        parameters::of_contact_test(test),
        json!({ "gravity": 0.0 }),
    ])
}

/// The parameters of a pyramid. It may have half a million cylinders, which cylinders.data lists.
pub(super) fn of_pyramid(pyramid: &Pyramid) -> Value {
    let groups = &pyramid.groups;
    merged([
        of_equal_bodies(&pyramid.convention),
        features(groups.floor_friction, groups.cylinder_friction),
        parameters::of_pyramid(pyramid),
    ])
}

fn of_equal_bodies(convention: &ContactConvention) -> Value {
    merged([
        body(convention),
        json!({ "schema": SCHEMA, "restitution": convention.restitution }),
    ])
}

fn each_body(convention: &ContactConvention, count: usize) -> Value {
    json!({ "bodies": vec![body(convention); count] })
}

fn body(convention: &ContactConvention) -> Value {
    json!({ "radius": 1.0, "mass": 1.0, "moment_of_inertia": convention.moment_of_inertia })
}

/// Returns the features that are on with these friction coefficients of the floor and between bodies.
fn features(mu: f64, mu_d: f64) -> Value {
    let is_on = |feature: &Feature| match feature {
        Feature::Friction => mu > 0.0 || mu_d > 0.0,
    };
    let on = Feature::ALL.into_iter().filter(is_on);
    json!({ "features": on.map(Feature::as_str).collect::<Vec<_>>() })
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
    fn every_number_and_list_of_every_task_is_declared_and_given() {
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
                (Rigid, of_case(&case_of(Preparation::Rigid))),
                (Motion, of_contact_test(&test)),
                (Pile, of_pyramid(&pyramid)),
            ] {
                let given = given.as_object().expect("an object");
                let names = |is_kind: fn(&Value) -> bool| -> Vec<&str> {
                    let own = given.iter().filter(|(_, value)| is_kind(value));
                    own.map(|(name, _)| name.as_str()).collect()
                };
                let own = PARAMETERS.iter().filter(|one| one.tasks.contains(&kind));
                let own = own.filter(|one| one.when == When::Every || !law.is_linear());
                let mut declared: Vec<&str> = own.map(|one| one.name).collect();
                declared.sort_unstable();
                assert_eq!(names(Value::is_number), declared, "{kind:?}, {law}");
                let own = LISTS.iter().filter(|one| one.tasks.contains(&kind));
                let mut declared: Vec<&str> = own.map(|one| one.name).collect();
                declared.sort_unstable();
                assert_eq!(names(Value::is_array), declared, "{kind:?}, {law}");
                assert_eq!(
                    names(|value| !value.is_number() && !value.is_array()),
                    [""; 0]
                );
            }
        }
    }

    #[test]
    fn every_body_has_the_numbers_that_are_declared_for_each() {
        let spheres = Case {
            stack: Groups {
                bodies: 4,
                ..Groups::paper(0.3, 100.0)
            },
            ..case(ramp())
        };
        let test = witness_test(ContactConvention::TURNING);
        let declared = LISTS.iter().find_map(|list| match list.entry {
            Entry::Numbers(numbers) if list.name == "bodies" => Some(numbers),
            _ => None,
        });
        let declared = declared.expect("they are declared");
        for (given, count) in [
            (of_case(&case(ramp())), 3),
            (of_case(&spheres), 5),
            (of_contact_test(&test), 2),
        ] {
            let bodies = given["bodies"].as_array().expect("a list");
            assert_eq!(bodies.len(), count);
            for body in bodies {
                assert_eq!(body.as_object().expect("a body").len(), declared.len());
                // All are equal.
                for number in declared {
                    assert_eq!(body[number.name], given[number.name], "{}", number.name);
                    assert!(body[number.name].is_number(), "{}", number.name);
                }
            }
        }
    }

    #[test]
    fn friction_is_a_feature_where_any_contact_has_it() {
        for (mu, mu_d, on) in [
            (0.0, 0.0, json!([])),
            (0.3, 0.0, json!(["friction"])),
            (0.0, 0.7, json!(["friction"])),
        ] {
            let test = ContactTest {
                floor_friction: mu,
                cylinder_friction: mu_d,
                ..witness_test(ContactConvention::TURNING)
            };
            assert_eq!(of_contact_test(&test)["features"], on);
        }
        assert_eq!(of_case(&case(ramp()))["features"], json!(["friction"]));
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
