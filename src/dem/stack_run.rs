//! The three-cylinder stack as one scene: prepared, compressed, sampled.

use super::contact::{ContactModel, SpringDashpot};
use super::real::{Real, real};
use super::scene::{Cylinder, PlaneWall, Scene};
use super::side_walls::prepare_between_walls;
use crate::stack::{Case, PreparationSteps, sha256_hex};
use crate::trace::{Sample, SeriesError, Trace};
use std::sync::LazyLock;
use twofloat::TwoFloat;

/// Digest of the sources that decide the numbers of the native DEM; it takes the place that the hash of
/// the deck has for an external code.
pub static SOURCE_DIGEST: LazyLock<String> = LazyLock::new(|| {
    let sources = [
        include_str!("contact.rs"),
        include_str!("contact_run.rs"),
        include_str!("real.rs"),
        include_str!("scene.rs"),
        include_str!("side_walls.rs"),
        include_str!("stack_run.rs"),
    ];
    sha256_hex(sources.concat().as_bytes())
});

/// Some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

pub(super) const TOP: usize = 0;
pub(super) const RIGHT: usize = 1;
pub(super) const LEFT: usize = 2;

/// Prepares and compresses the stack of `case`, and samples the compression as planned. Gives up once
/// `wanted` is false; the series is then reported as truncated.
///
/// # Errors
/// If the motion leaves the finite numbers, or is no longer wanted.
pub fn compress_stack(case: &Case, wanted: impl Fn() -> bool) -> Result<Trace, SeriesError> {
    compress_stack_with(case, law::<f64>(case), wanted)
}

/// The same in double-double arithmetic, 106 bits, at some forty times the cost: what is left of the
/// difference to [`compress_stack`] is the round-off of the latter.
///
/// # Errors
/// If the motion leaves the finite numbers, or is no longer wanted.
pub fn compress_stack_precisely(
    case: &Case,
    wanted: impl Fn() -> bool,
) -> Result<Trace, SeriesError> {
    compress_stack_with(case, law::<TwoFloat>(case), wanted)
}

/// The contact law of `case`.
pub(super) fn law<R: Real>(case: &Case) -> SpringDashpot<R> {
    SpringDashpot::new(&case.convention, case.stack.tangential_stiffness())
}

/// The same as [`compress_stack`], in any arithmetic and with any contact law.
///
/// # Errors
/// If the motion leaves the finite numbers, or is no longer wanted.
pub fn compress_stack_with<R: Real, Model: ContactModel<R>>(
    case: &Case,
    model: Model,
    wanted: impl Fn() -> bool,
) -> Result<Trace, SeriesError> {
    compress_stack_watched(case, model, wanted, |_, _| ())
}

/// The same, every sampled state being shown to `watch`, with the index of the top wall.
pub(super) fn compress_stack_watched<R: Real, Model: ContactModel<R>>(
    case: &Case,
    model: Model,
    wanted: impl Fn() -> bool,
    mut watch: impl FnMut(&Scene<R, Model>, usize),
) -> Result<Trace, SeriesError> {
    let schedule = case.protocol.schedule();
    let given_up = |step: u64| step.is_multiple_of(STEPS_BETWEEN_QUESTIONS) && !wanted();
    let (mut scene, floor) = stress_free_stack(case, model);
    match schedule.preparation {
        PreparationSteps::GravityRamp { ramp, rest } => {
            raise_gravity(&mut scene, case.stack.epsilon(), ramp, rest, given_up);
        }
        PreparationSteps::SideWalls(steps) => {
            prepare_between_walls(&mut scene, case.stack.epsilon(), &steps, given_up);
        }
    }
    scene.gravity = real(case.stack.epsilon());
    let top_wall = scene.add_wall(PlaneWall {
        normal: [R::zero(), -R::one()],
        offset: -(scene.cylinders[TOP].position[1] + R::one()),
        speed: real(case.protocol.wall_speed),
        friction: R::zero(),
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
            watch(&scene, top_wall);
        }
        scene.advance();
    }
    Trace::new(samples, &schedule, case.protocol.time_step)
}

/// Raises gravity from 0 to `gravity` in `ramp` steps, and rests.
fn raise_gravity<R: Real, Model: ContactModel<R>>(
    scene: &mut Scene<R, Model>,
    gravity: f64,
    ramp: u64,
    rest: u64,
    given_up: impl Fn(u64) -> bool,
) {
    for step in 0..ramp + rest {
        if given_up(step) {
            break;
        }
        scene.gravity = real(gravity * smooth_step(step, ramp));
        scene.evaluate_forces();
        scene.advance();
    }
}

/// Three just-touching cylinders on the floor, and the index of the floor.
pub(super) fn stress_free_stack<R: Real, Model: ContactModel<R>>(
    case: &Case,
    model: Model,
) -> (Scene<R, Model>, usize) {
    let one = R::one();
    let cylinders = vec![
        Cylinder::at(R::zero(), one + real::<R>(3.0).sqrt()),
        Cylinder::at(one, one),
        Cylinder::at(-one, one),
    ];
    let mut scene = Scene::new(cylinders, model, real(case.protocol.time_step));
    scene.cylinder_friction = real(case.stack.cylinder_friction);
    scene.pair_arm = real(case.convention.pair_arm);
    scene.wall_arm = real(case.convention.floor_arm);
    scene.moment_of_inertia = real(case.convention.moment_of_inertia);
    let floor = scene.add_wall(PlaneWall {
        normal: [R::zero(), one],
        offset: R::zero(),
        speed: R::zero(),
        friction: real(case.stack.floor_friction),
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

fn sample<R: Real, Model: ContactModel<R>>(
    scene: &Scene<R, Model>,
    floor: usize,
    top_wall: usize,
    step: u64,
    time: f64,
) -> Sample {
    let [top, right, left] = [TOP, RIGHT, LEFT].map(|index| &scene.cylinders[index]);
    let on_right = scene.wall_force(floor, RIGHT);
    let on_left = scene.wall_force(floor, LEFT);
    Sample {
        step,
        time,
        wall_force: scene.wall_force(top_wall, TOP).normal.into(),
        x1: top.position[0].into(),
        y1: top.position[1].into(),
        theta1: top.angle.into(),
        x2: right.position[0].into(),
        y2: right.position[1].into(),
        theta2: right.angle.into(),
        x3: left.position[0].into(),
        y3: left.position[1].into(),
        theta3: left.angle.into(),
        floor_n2: on_right.normal.into(),
        // The tangent of the floor is t = (−1, 0).
        floor_t2: (-on_right.tangential).into(),
        floor_n3: on_left.normal.into(),
        floor_t3: (-on_left.tangential).into(),
    }
}
