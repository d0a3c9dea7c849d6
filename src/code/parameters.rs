//! The parameters of tasks, under the same names for every code. Units r = m = k_n = 1.

use super::definition::refused;
use super::manifest::TaskKind;
use crate::model::{
    Case, ContactConvention, ContactLaw, ContactTest, InvalidValue, PreparationSteps, Pyramid,
    Schedule, SideWallSteps, Stack,
};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::{Value, json};

/// Declares the parameters of a task, or some that several tasks share: name, type, unit and meaning.
macro_rules! parameters {
    ($(#[$doc:meta])* $group:ident, of $($shared:ident: $other:ident),*;
     $($name:ident: $kind:ty, $unit:literal, $meaning:literal;)*) => {
        $(#[$doc])*
        #[derive(Serialize, JsonSchema)]
        struct $group {
            $(#[serde(flatten)] $shared: $other,)*
            $(#[doc = $meaning] #[schemars(extend("x-unit" = $unit))] $name: $kind,)*
        }
    };
}

parameters! {
    /// All contacts.
    Contacts, of;
    normal_stiffness: f64, "k_n", "normal stiffness, 1";
    tangential_stiffness: f64, "k_n", "tangential stiffness k_t";
    damping_normal: f64, "√(m k_n)", "damping coefficient η_n of the normal force";
    damping_tangential: f64, "√(m k_n)", "damping coefficient η_t of the tangential force";
    floor_friction: f64, "1", "friction coefficient μ of cylinder and floor; the other walls are frictionless";
    cylinder_friction: f64, "1", "friction coefficient μ_d of two cylinders";
}

parameters! {
    /// Compression by the top wall, and its rows.
    Compression, of;
    gravity: f64, "k_n r/m", "gravity g, downwards: ε";
    time_step: f64, "√(m/k_n)", "time step Δt";
    wall_speed: f64, "r √(k_n/m)", "speed of the top wall, downwards, from the step in which it is put onto cylinder 1";
    compression_steps: u64, "1", "steps of the compression; its step 0 is the state at the end of the preparation";
    coarse_every: u64, "1", "a row is written every so many steps of the compression, from its step 0 on …";
    fine_from_step: u64, "1", "… until this step, a multiple of `coarse_every` …";
    fine_every: u64, "1", "… and every so many steps from there on; every number of steps of a task is a multiple of it";
}

parameters! {
    /// Compress a stack after a gravity ramp.
    StackTask, of contacts: Contacts, compression: Compression;
    ramp_steps: u64, "1", "steps n in which gravity rises from 0 as g x³ (10 − 15 x + 6 x²), x = n/`ramp_steps`";
    rest_steps: u64, "1", "steps at rest between the preparation and the compression";
}

parameters! {
    /// Compress a stack that was prepared between side walls.
    SideWallsTask, of contacts: Contacts, compression: Compression;
    push_speed: f64, "r √(k_n/m)", "speed at which the side walls move inwards, from x = ±2";
    push_steps: u64, "1", "steps during which they move inwards; 0 if they do not push";
    hold_steps: u64, "1", "steps at rest after that, the top cylinder still held";
    landing_height: f64, "r", "height of the top cylinder's centre where it is let go";
    fall: f64, "r", "distance by which it is lowered until there";
    fall_speed: f64, "r √(k_n/m)", "speed at which it is lowered";
    fall_steps: u64, "1", "steps during which it is lowered";
    landing_speed: f64, "r √(k_n/m)", "speed with which it is let go, downwards";
    settle_steps: u64, "1", "steps at rest under the top cylinder";
    withdrawal_speed: f64, "r √(k_n/m)", "speed at which the side walls move outwards";
    withdrawal_steps: u64, "1", "steps during which they move outwards; then they are taken away";
    rest_steps: u64, "1", "steps at rest between the preparation and the compression";
}

parameters! {
    /// Move two cylinders without gravity.
    MotionTask, of contacts: Contacts;
    time_step: f64, "√(m/k_n)", "time step Δt";
    steps: u64, "1", "number of steps; a row is written for each, and one for step 0";
    wall_height: f64, "r", "height of the top wall at step 0";
    wall_speed: f64, "r √(k_n/m)", "speed of the top wall, downwards";
    x1: f64, "r", "horizontal position of cylinder 1 at step 0";
    y1: f64, "r", "height of its centre above the floor at step 0";
    vx1: f64, "r √(k_n/m)", "its horizontal velocity, at the moment at which the code keeps it";
    vy1: f64, "r √(k_n/m)", "its vertical velocity, upwards, at the same moment";
    spin1: f64, "√(k_n/m)", "its angular velocity, counter-clockwise, at the same moment";
    x2: f64, "r", "horizontal position of cylinder 2 at step 0";
    y2: f64, "r", "height of its centre above the floor at step 0";
    vx2: f64, "r √(k_n/m)", "its horizontal velocity, at the moment at which the code keeps it";
    vy2: f64, "r √(k_n/m)", "its vertical velocity, upwards, at the same moment";
    spin2: f64, "√(k_n/m)", "its angular velocity, counter-clockwise, at the same moment";
}

parameters! {
    /// Carry a pyramid; its cylinders are in the file `cylinders.data`.
    PyramidTask, of contacts: Contacts;
    gravity: f64, "k_n r/m", "gravity g, downwards";
    time_step: f64, "√(m/k_n)", "time step Δt";
    half_width: f64, "r", "distance of the side walls from the middle";
    ramp_steps: u64, "1", "steps in which gravity rises, as in the task `stack`";
    rest_steps: u64, "1", "steps at rest after that";
    timed_steps: u64, "1", "steps that are timed";
}

impl TaskKind {
    /// JSON Schema of its parameters; `x-unit` is the unit of each.
    pub(crate) fn parameters_schema(self) -> Value {
        let settings = SchemaSettings::draft2020_12().for_serialize();
        let settings = settings.with(|settings| settings.meta_schema = None);
        let generator = settings.into_generator();
        let schema = match self {
            Self::Stack => generator.into_root_schema_for::<StackTask>(),
            Self::SideWalls => generator.into_root_schema_for::<SideWallsTask>(),
            Self::Motion => generator.into_root_schema_for::<MotionTask>(),
            Self::Pyramid => generator.into_root_schema_for::<PyramidTask>(),
        };
        schema.to_value()
    }
}

/// Refuses parameters that are not finite numbers: some of those of a micro-test were measured with the code.
pub(super) fn only_numbers(parameters: &Value) -> Result<(), InvalidValue> {
    let mut named = parameters.as_object().into_iter().flatten();
    let other = named.find(|(_, value)| !value.is_number());
    other.map_or(Ok(()), |(name, value)| {
        Err(refused(name, value, "a finite number"))
    })
}

/// The parameters of a case as the decks of the external codes read them, each kind of preparation for a deck of its own.
pub(super) fn of_case(case: &Case) -> Value {
    let schedule = case.protocol.schedule();
    let contacts = Contacts::of_stack(&case.convention, &case.stack);
    let compression = Compression::of(case, &schedule);
    match schedule.preparation {
        PreparationSteps::GravityRamp { ramp, rest } => json!(StackTask {
            contacts,
            compression,
            ramp_steps: ramp,
            rest_steps: rest,
        }),
        PreparationSteps::SideWalls(steps) => {
            json!(SideWallsTask::of(contacts, compression, &steps))
        }
    }
}

impl Contacts {
    fn new(law: ContactLaw, floor_friction: f64, cylinder_friction: f64) -> Self {
        let ContactLaw {
            normal_stiffness,
            tangential_stiffness,
            damping_normal,
            damping_tangential,
        } = law;
        Self {
            normal_stiffness,
            tangential_stiffness,
            damping_normal,
            damping_tangential,
            floor_friction,
            cylinder_friction,
        }
    }

    fn of_stack(convention: &ContactConvention, stack: &Stack) -> Self {
        let law = convention.law(stack.stiffness_ratio);
        Self::new(law, stack.floor_friction, stack.cylinder_friction)
    }
}

impl Compression {
    fn of(case: &Case, schedule: &Schedule) -> Self {
        Self {
            gravity: case.stack.epsilon(),
            time_step: case.protocol.time_step,
            wall_speed: case.protocol.wall_speed,
            compression_steps: schedule.compression_steps,
            coarse_every: schedule.coarse_every,
            fine_from_step: schedule.fine_from_step,
            fine_every: schedule.fine_every,
        }
    }
}

impl SideWallsTask {
    fn of(contacts: Contacts, compression: Compression, steps: &SideWallSteps) -> Self {
        Self {
            push_speed: steps.push_speed,
            push_steps: steps.push_steps,
            hold_steps: steps.hold_steps,
            landing_height: steps.landing_height(compression.gravity),
            fall: steps.fall,
            fall_speed: steps.walls.fall_speed,
            fall_steps: steps.fall_steps,
            landing_speed: steps.walls.landing_speed,
            settle_steps: steps.settle_steps,
            withdrawal_speed: steps.walls.withdrawal_speed,
            withdrawal_steps: steps.withdrawal_steps,
            rest_steps: steps.rest_steps,
            contacts,
            compression,
        }
    }
}

/// The parameters of a micro-test.
pub(super) fn of_contact_test(test: &ContactTest) -> Value {
    let [one, two] = &test.initial_motions;
    let law = test.convention.law(test.stiffness_ratio);
    json!(MotionTask {
        contacts: Contacts::new(law, test.floor_friction, test.cylinder_friction),
        time_step: test.time_step,
        steps: test.steps,
        wall_height: test.wall_height,
        wall_speed: test.wall_speed,
        x1: one.x,
        y1: one.y,
        vx1: one.vx,
        vy1: one.vy,
        spin1: one.spin,
        x2: two.x,
        y2: two.y,
        vx2: two.vx,
        vy2: two.vy,
        spin2: two.spin,
    })
}

/// The parameters of a pyramid.
pub(super) fn of_pyramid(pyramid: &Pyramid) -> Value {
    let stack = &pyramid.groups;
    json!(PyramidTask {
        contacts: Contacts::of_stack(&pyramid.convention, stack),
        gravity: stack.epsilon(),
        time_step: pyramid.time_step,
        half_width: pyramid.half_width(),
        ramp_steps: pyramid.ramp_steps,
        rest_steps: pyramid.rest_steps,
        timed_steps: pyramid.timed_steps,
    })
}

/// Name and content of the file with the cylinders of `pyramid` in its box, in the format that `read_data` of
/// LAMMPS and LIGGGHTS understands: atom, type, diameter, density, centre. Three types, as the contacts of
/// LIGGGHTS have them; the mass is set by the deck.
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
