//! The three-cylinder stack as one scene: prepared, compressed, sampled.

use super::contact::ContactLaw;
use super::scene::{Cylinder, PlaneWall, Scene};
use crate::stack::{Case, sha256_hex};
use crate::trace::{Sample, SeriesError, Trace};
use std::sync::LazyLock;

/// Digest of the sources that decide the numbers of the native DEM; it takes the place that the hash of
/// the deck has for an external code.
pub static SOURCE_DIGEST: LazyLock<String> = LazyLock::new(|| {
    let sources = [
        include_str!("contact.rs"),
        include_str!("scene.rs"),
        include_str!("stack_run.rs"),
    ];
    sha256_hex(sources.concat().as_bytes())
});

/// Some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

pub(super) const TOP: usize = 0;
pub(super) const RIGHT: usize = 1;
pub(super) const LEFT: usize = 2;

/// Prepares and compresses the stack of `case`, and samples the compression as planned.
///
/// # Errors
/// If the motion leaves the finite numbers.
pub fn compress_stack(case: &Case) -> Result<Trace, SeriesError> {
    compress_stack_while(case, || true)
}

/// The same as [`compress_stack`], but gives up once `wanted` is false; the series is then reported as
/// truncated.
///
/// # Errors
/// If the motion leaves the finite numbers, or is no longer wanted.
pub fn compress_stack_while(case: &Case, wanted: impl Fn() -> bool) -> Result<Trace, SeriesError> {
    let schedule = case.protocol.schedule();
    let given_up = |step: u64| step.is_multiple_of(STEPS_BETWEEN_QUESTIONS) && !wanted();
    let (mut scene, floor) = stress_free_stack(case);
    for step in 0..schedule.ramp_steps + schedule.rest_steps {
        if given_up(step) {
            break;
        }
        scene.gravity = case.stack.epsilon() * smooth_step(step, schedule.ramp_steps);
        scene.evaluate_forces();
        scene.advance();
    }
    scene.gravity = case.stack.epsilon();
    let top_wall = scene.add_wall(PlaneWall {
        normal: [0.0, -1.0],
        offset: -(scene.cylinders[TOP].position[1] + 1.0),
        speed: case.protocol.wall_speed,
        friction: 0.0,
    });
    let mut samples = Vec::new();
    let mut planned = schedule.sampled_steps().peekable();
    for step in 0..=schedule.compression_steps {
        if given_up(step) {
            break;
        }
        scene.evaluate_forces();
        if planned.next_if_eq(&step).is_some() {
            let time = step as f64 * case.protocol.time_step;
            samples.push(sample(&scene, floor, top_wall, step, time));
        }
        scene.advance();
    }
    Trace::new(samples, &schedule, case.protocol.time_step)
}

/// Three just-touching cylinders on the floor, and the index of the floor.
pub(super) fn stress_free_stack(case: &Case) -> (Scene, usize) {
    let tangential_stiffness = case.stack.tangential_stiffness();
    let law = ContactLaw {
        normal_stiffness: 1.0,
        tangential_stiffness,
        normal_damping: case.convention.damping(1.0),
        tangential_damping: case.convention.damping(tangential_stiffness),
    };
    let cylinders = vec![
        Cylinder::at(0.0, 1.0 + 3f64.sqrt()),
        Cylinder::at(1.0, 1.0),
        Cylinder::at(-1.0, 1.0),
    ];
    let mut scene = Scene::new(cylinders, law, case.protocol.time_step);
    scene.cylinder_friction = case.stack.cylinder_friction;
    scene.pair_arm = case.convention.pair_arm;
    scene.wall_arm = case.convention.floor_arm;
    let floor = scene.add_wall(PlaneWall {
        normal: [0.0, 1.0],
        offset: 0.0,
        speed: 0.0,
        friction: case.stack.floor_friction,
    });
    (scene, floor)
}

/// x³(10 − 15x + 6x²) at x = step/steps, 1 beyond.
fn smooth_step(step: u64, steps: u64) -> f64 {
    if step >= steps {
        return 1.0;
    }
    let x = step as f64 / steps as f64;
    x * x * x * (10.0 - 15.0 * x + 6.0 * (x * x))
}

fn sample(scene: &Scene, floor: usize, top_wall: usize, step: u64, time: f64) -> Sample {
    let [top, right, left] = [TOP, RIGHT, LEFT].map(|index| &scene.cylinders[index]);
    let on_right = scene.wall_contact(floor, RIGHT);
    let on_left = scene.wall_contact(floor, LEFT);
    Sample {
        step,
        time,
        wall_force: scene.wall_contact(top_wall, TOP).normal_force,
        x1: top.position[0],
        y1: top.position[1],
        theta1: top.angle,
        x2: right.position[0],
        y2: right.position[1],
        theta2: right.angle,
        x3: left.position[0],
        y3: left.position[1],
        theta3: left.angle,
        floor_n2: on_right.normal_force,
        // The tangent of the floor is t = (−1, 0).
        floor_t2: -on_right.tangential_force,
        floor_n3: on_left.normal_force,
        floor_t3: -on_left.tangential_force,
    }
}
