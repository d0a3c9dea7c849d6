//! The paper's preparation (supplement I.B): side walls pushed in, the top cylinder lowered, the walls
//! withdrawn. What each phase does is told at [`crate::stack::SideWalls`].

use super::contact::ContactModel;
use super::real::{Real, real};
use super::scene::{PlaneWall, Scene};
use super::stack_run::{LEFT, RIGHT, TOP};
use crate::stack::SideWallSteps;

/// Prepares the stress-free stack of `scene`, on whose floor alone the cylinders stand, under `gravity`.
pub(super) fn prepare_between_walls<R: Real, Model: ContactModel<R>>(
    scene: &mut Scene<R, Model>,
    gravity: f64,
    steps: &SideWallSteps,
    given_up: impl Fn(u64) -> bool,
) {
    let floor_only = scene.walls.len();
    scene.gravity = real(gravity);
    for cylinder in [RIGHT, LEFT] {
        scene.cylinders[cylinder].position[1] -= real(gravity);
    }
    let landing = steps.landing_height(gravity);
    let start = landing + steps.fall;
    let fall = |step: u64| start - steps.fall * (step as f64 / steps.fall_steps as f64);
    let walls = SideWallPair::add(scene);
    let mut run = Phases { scene, given_up };
    walls.set_speed(run.scene, steps.push_speed);
    run.hold_top(steps.push_steps, |_| start);
    walls.set_speed(run.scene, 0.0);
    run.hold_top(steps.hold_steps, |_| start);
    run.hold_top(steps.fall_steps, fall);
    run.let_go(landing, steps.walls.landing_speed);
    run.go_on(steps.settle_steps);
    walls.set_speed(run.scene, -steps.walls.withdrawal_speed);
    run.go_on(steps.withdrawal_steps);
    run.scene.remove_walls_from(floor_only);
    run.go_on(steps.rest_steps);
}

/// Frictionless walls at x = ±2, which just touch the bottom cylinders.
struct SideWallPair([usize; 2]);

impl SideWallPair {
    fn add<R: Real, Model: ContactModel<R>>(scene: &mut Scene<R, Model>) -> Self {
        let normals = [[-R::one(), R::zero()], [R::one(), R::zero()]];
        Self(normals.map(|normal| {
            scene.add_wall(PlaneWall {
                normal,
                offset: real(-2.0),
                speed: R::zero(),
                friction: R::zero(),
            })
        }))
    }

    /// Inwards.
    fn set_speed<R: Real, Model: ContactModel<R>>(&self, scene: &mut Scene<R, Model>, speed: f64) {
        for wall in self.0 {
            scene.walls[wall].speed = real(speed);
        }
    }
}

struct Phases<'a, R: Real, Model: ContactModel<R>, GivenUp> {
    scene: &'a mut Scene<R, Model>,
    given_up: GivenUp,
}

impl<R: Real, Model: ContactModel<R>, GivenUp: Fn(u64) -> bool> Phases<'_, R, Model, GivenUp> {
    fn go_on(&mut self, steps: u64) {
        for step in 0..steps {
            if (self.given_up)(step) {
                break;
            }
            self.scene.evaluate_forces();
            self.scene.advance();
        }
    }

    /// The same with the top cylinder held at `height`, a function of the step.
    fn hold_top(&mut self, steps: u64, height: impl Fn(u64) -> f64) {
        for step in 0..steps {
            if (self.given_up)(step) {
                break;
            }
            self.put_top(height(step), 0.0);
            self.scene.evaluate_forces();
            self.scene.advance();
        }
    }

    /// Puts the top cylinder at `height`, where it moves down with `speed`.
    fn let_go(&mut self, height: f64, speed: f64) {
        self.put_top(height, -speed);
    }

    fn put_top(&mut self, height: f64, velocity: f64) {
        let top = &mut self.scene.cylinders[TOP];
        top.position = [R::zero(), real(height)];
        top.velocity = [R::zero(), real(velocity)];
    }
}
