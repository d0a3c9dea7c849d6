//! A micro-test in the native DEM.

use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::power_law::PowerLaw;
use super::scene::{Cylinder, Scene};
use super::wall::{Facing, PlaneWall};
use crate::model::{ContactTest, Drive, InitialMotion};
use crate::series::{Motion, MotionRow, SeriesError};

const BODIES: [usize; 2] = [0, 1];
const TOP_WALL: usize = 1;

/// Runs `test` and reports every step.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test(test: &ContactTest) -> Result<Motion, SeriesError> {
    match test.convention.law.is_linear() {
        true => run_contact_test_with::<SpringDashpot<f64>>(test, law(test)),
        false => run_contact_test_with::<PowerLaw<f64>>(test, law(test)),
    }
}

fn law<Model: ConventionalModel<f64>>(test: &ContactTest) -> Model {
    Model::of_convention(0.0, &test.convention, test.stiffness_ratio)
}

/// Runs `test` with any contact law.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test_with<Model: ContactModel<f64>>(
    test: &ContactTest,
    model: Model,
) -> Result<Motion, SeriesError> {
    let wall = |facing, offset, speed, friction| PlaneWall {
        facing,
        offset,
        speed,
        friction,
    };
    let walls = [
        wall(Facing::Up, 0.0, 0.0, test.floor_friction),
        wall(Facing::Down, -test.wall_height, test.wall_speed, 0.0),
    ];
    let cylinders = BODIES.map(|body| launched(&test.initial_motions[body]));
    let mut scene = Scene::new(cylinders, walls, model, test.time_step);
    scene.cylinder_friction = test.cylinder_friction;
    scene.moment_of_inertia = test.convention.moment_of_inertia;
    let rows = (0..=test.steps).map(|step| {
        if let Some(drive) = &test.drive {
            scene.cylinders = driven(test, drive, step);
        }
        scene.evaluate_forces();
        let row = row(&scene, step);
        scene.advance();
        row
    });
    Motion::new(rows.collect(), test.steps)
}

/// The cylinders at a step of a prescribed motion.
fn driven(test: &ContactTest, drive: &Drive, step: u64) -> [Cylinder; 2] {
    let [one, other] = test.initial_motions;
    let [distance, velocity] = drive.motion_at(step, test.time_step);
    let moved = Cylinder {
        velocity,
        ..Cylinder::at(one.x + distance[0], one.y + distance[1])
    };
    [moved, Cylinder::at(other.x, other.y)]
}

fn launched(initial_motion: &InitialMotion) -> Cylinder {
    Cylinder {
        velocity: [initial_motion.vx, initial_motion.vy],
        spin: initial_motion.spin,
        ..Cylinder::at(initial_motion.x, initial_motion.y)
    }
}

fn row<Model: ContactModel<f64>>(scene: &Scene<2, 2, f64, Model>, step: u64) -> MotionRow {
    let [one, two] = BODIES.map(|index| &scene.cylinders[index]);
    let [on_one, on_two] = BODIES.map(|index| scene.load(index));
    let wall_force = BODIES.map(|index| scene.wall_force(TOP_WALL, index).normal);
    MotionRow {
        step,
        x1: one.position[0],
        y1: one.position[1],
        vx1: one.velocity[0],
        vy1: one.velocity[1],
        spin1: one.spin,
        fx1: on_one.force[0],
        fy1: on_one.force[1],
        torque1: on_one.torque,
        x2: two.position[0],
        y2: two.position[1],
        vx2: two.velocity[0],
        vy2: two.velocity[1],
        spin2: two.spin,
        fx2: on_two.force[0],
        fy2: on_two.force[1],
        torque2: on_two.torque,
        wall_force: wall_force[0] + wall_force[1],
    }
}
