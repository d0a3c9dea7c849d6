//! Micro-tests in the native DEM.

use super::body::Body;
use super::contact::{ContactModel, ConventionalModel, SpringDashpot};
use super::geometry::Facing;
use super::geometry::{Geometry, Plane, Space};
use super::power_law::PowerLaw;
use super::scene::Scene;
use super::wall::PlaneWall;
use crate::model::{ContactTest, Drive, MotionInSpace};
use crate::series::{Motion, MotionRow, RowInSpace, SeriesError};

const BODIES: [usize; 2] = [0, 1];
const TOP_WALL: usize = 1;

/// Runs `test` and reports every step.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test(test: &ContactTest) -> Result<Motion, SeriesError> {
    match test.convention.law.is_linear() {
        true => run_by::<SpringDashpot<f64>>(test),
        false => run_by::<PowerLaw<f64>>(test),
    }
}

fn run_by<Model>(test: &ContactTest) -> Result<Motion, SeriesError>
where
    Model: ConventionalModel<f64> + ConventionalModel<f64, Space>,
{
    let (convention, stiffness_ratio) = (&test.convention, test.stiffness_ratio);
    match test.space {
        None => {
            let of = <Model as ConventionalModel<f64, Plane>>::of_convention;
            run_contact_test_with(test, of(0.0, convention, stiffness_ratio))
        }
        Some(_) => {
            let of = <Model as ConventionalModel<f64, Space>>::of_convention;
            run_contact_test_in::<Model, Space>(test, of(0.0, convention, stiffness_ratio))
        }
    }
}

/// Runs `test` in the plane with any contact law.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test_with<Model: ContactModel<f64>>(
    test: &ContactTest,
    model: Model,
) -> Result<Motion, SeriesError> {
    run_contact_test_in::<Model, Plane>(test, model)
}

/// Runs `test` with any contact law, in the plane or in space.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn run_contact_test_in<Model: ContactModel<f64, G>, G: Geometry<f64>>(
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
    let bodies = BODIES.map(|body| launched(test, body));
    let mut scene = Scene::<2, 2, f64, Model, G>::new(bodies, walls, model, test.time_step);
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

/// The bodies at one step of a prescribed motion.
fn driven<G: Geometry<f64>>(test: &ContactTest, drive: &Drive, step: u64) -> [Body<f64, G>; 2] {
    let [one, other] = test.initial_motions;
    let [distance, velocity] = drive.motion_at(step, test.time_step);
    let at = |x, y| Body::resting(G::vector([x, y, 0.0]));
    let moved = Body {
        velocity: G::vector([velocity[0], velocity[1], 0.0]),
        ..at(one.x + distance[0], one.y + distance[1])
    };
    [moved, at(other.x, other.y)]
}

fn launched<G: Geometry<f64>>(test: &ContactTest, body: usize) -> Body<f64, G> {
    let plane = &test.initial_motions[body];
    let beyond = test
        .space
        .map_or(MotionInSpace::default(), |space| space[body]);
    Body {
        velocity: G::vector([plane.vx, plane.vy, beyond.vz]),
        spin: G::rotation([beyond.spinx, beyond.spiny, plane.spin]),
        ..Body::resting(G::vector([plane.x, plane.y, beyond.z]))
    }
}

fn row<Model: ContactModel<f64, G>, G: Geometry<f64>>(
    scene: &Scene<2, 2, f64, Model, G>,
    step: u64,
) -> MotionRow {
    let wall_force = BODIES.map(|index| scene.wall_force(TOP_WALL, index).normal);
    let bodies = BODIES.map(|index| {
        let (body, load) = (&scene.cylinders[index], scene.load(index));
        let [x, y, z] = G::components(body.position);
        let [vx, vy, vz] = G::components(body.velocity);
        let [spinx, spiny, spin] = G::rotation_components(body.spin);
        let [fx, fy, fz] = G::components(load.force);
        let [torquex, torquey, torque] = G::rotation_components(load.torque);
        let beyond = RowInSpace {
            z,
            vz,
            fz,
            spin: [spinx, spiny],
            torque: [torquex, torquey],
        };
        ([x, y, vx, vy, spin, fx, fy, torque], beyond)
    });
    let [
        ([x1, y1, vx1, vy1, spin1, fx1, fy1, torque1], one),
        (two, other),
    ] = bodies;
    let [x2, y2, vx2, vy2, spin2, fx2, fy2, torque2] = two;
    MotionRow {
        step,
        x1,
        y1,
        vx1,
        vy1,
        spin1,
        fx1,
        fy1,
        torque1,
        x2,
        y2,
        vx2,
        vy2,
        spin2,
        fx2,
        fy2,
        torque2,
        wall_force: wall_force[0] + wall_force[1],
        space: [one, other],
    }
}
