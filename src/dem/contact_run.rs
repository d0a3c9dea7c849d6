//! A micro-test in the native DEM.

use super::contact::{ContactModel, SpringDashpot};
use super::scene::{Cylinder, PlaneWall, Scene};
use crate::stack::{ContactTest, Launch};
use crate::trace::{Motion, MotionRow, SeriesError};

const BODIES: [usize; 2] = [0, 1];

/// Runs `test` and reports every step.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test(test: &ContactTest) -> Result<Motion, SeriesError> {
    let model = SpringDashpot::like(0.0, &test.convention, test.tangential_stiffness());
    run_contact_test_with(test, model)
}

/// The same with any contact law.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test_with<Model: ContactModel<f64>>(
    test: &ContactTest,
    model: Model,
) -> Result<Motion, SeriesError> {
    let mut scene = Scene::new(
        test.launches.iter().map(launched).collect(),
        model,
        test.time_step,
    );
    scene.cylinder_friction = test.cylinder_friction;
    scene.pair_arm = test.convention.pair_arm;
    scene.wall_arm = test.convention.floor_arm;
    scene.moment_of_inertia = test.convention.moment_of_inertia;
    scene.add_wall(PlaneWall {
        normal: [0.0, 1.0],
        offset: 0.0,
        speed: 0.0,
        friction: test.floor_friction,
    });
    let top_wall = scene.add_wall(PlaneWall {
        normal: [0.0, -1.0],
        offset: -test.wall_height,
        speed: test.wall_speed,
        friction: 0.0,
    });
    let rows = (0..=test.steps).map(|step| {
        scene.evaluate_forces();
        let row = row(&scene, top_wall, step);
        scene.advance();
        row
    });
    Motion::new(rows.collect(), test.steps)
}

fn launched(launch: &Launch) -> Cylinder {
    Cylinder {
        velocity: [launch.vx, launch.vy],
        spin: launch.spin,
        ..Cylinder::at(launch.x, launch.y)
    }
}

fn row<Model: ContactModel<f64>>(
    scene: &Scene<f64, Model>,
    top_wall: usize,
    step: u64,
) -> MotionRow {
    let [one, two] = BODIES.map(|index| &scene.cylinders[index]);
    let [on_one, on_two] = BODIES.map(|index| scene.load(index));
    let wall_force = BODIES.map(|index| scene.wall_force(top_wall, index).normal);
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
