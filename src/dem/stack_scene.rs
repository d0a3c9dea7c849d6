//! The three-cylinder stack as a scene.

use super::contact::ContactModel;
use super::loading::Action;
use super::real::{Composite, Real};
use super::scene::{Cylinder, PlaneWall, Scene};
use crate::stack::{Case, Preparation};
use crate::trace::Sample;

pub(super) const TOP: usize = 0;
pub(super) const RIGHT: usize = 1;
pub(super) const LEFT: usize = 2;

/// Index of the floor.
pub(super) const FLOOR: usize = 0;

/// Offset of a wall that is out of reach.
const OUT_OF_REACH: f64 = f64::MIN;

/// Three cylinders on the floor, the side walls that some preparations have, and the top wall.
pub(super) struct StackScene<R: Real, Model: ContactModel<R>> {
    pub(super) scene: Scene<R, Model>,
    side_walls: Option<[usize; 2]>,
    pub(super) top_wall: usize,
}

impl<R: Real, Model: ContactModel<R>> StackScene<R, Model> {
    /// The stack of `case` at the start of its preparation, the same in every lane of numbers like `number`.
    pub(super) fn new(case: &Case, model: Model, number: R) -> Self {
        let mut scene = stress_free_stack(case, model, number);
        let side_walls = match case.protocol.preparation {
            Preparation::GravityRamp { .. } => None,
            Preparation::SideWalls(_) => Some(enclose(&mut scene, case.stack.epsilon())),
        };
        let zero = number.like(0.0);
        let top_wall = scene.add_wall(PlaneWall {
            normal: [zero, -number.like(1.0)],
            offset: number.like(OUT_OF_REACH),
            speed: zero,
            friction: zero,
        });
        Self {
            scene,
            side_walls,
            top_wall,
        }
    }

    /// Does `action` to one lane of the stack of `case`.
    pub(super) fn act(&mut self, lane: usize, case: &Case, action: Action) {
        let scene = &mut self.scene;
        let number = scene.time_step;
        match action {
            Action::SetGravity(gravity) => scene.gravity.set_lane(lane, number.like(gravity)),
            Action::MoveSideWalls(speed) => {
                for wall in self.side_walls.into_iter().flatten() {
                    scene.walls[wall].speed.set_lane(lane, number.like(speed));
                }
            }
            Action::RemoveSideWalls => {
                for wall in self.side_walls.into_iter().flatten() {
                    let wall = &mut scene.walls[wall];
                    wall.speed.set_lane(lane, number.like(0.0));
                    wall.offset.set_lane(lane, number.like(OUT_OF_REACH));
                }
            }
            Action::PlaceTop { height, velocity } => {
                let top = &mut scene.cylinders[TOP];
                let [zero, height, velocity] =
                    [0.0, height, velocity].map(|value| number.like(value));
                top.position.take_lane(lane, &[zero, height]);
                top.velocity.take_lane(lane, &[zero, velocity]);
            }
            Action::StartTopWall => {
                let top = scene.cylinders[TOP].position[1];
                let wall = &mut scene.walls[self.top_wall];
                wall.offset.set_lane(lane, -(top + number.like(1.0)));
                wall.speed
                    .set_lane(lane, number.like(case.protocol.wall_speed));
            }
        }
    }

    /// One lane of the stack, at the given step of the compression and at its time.
    pub(super) fn sample(&self, lane: usize, step: u64, time: f64) -> Sample {
        let scene = &self.scene;
        let [top, right, left] = [TOP, RIGHT, LEFT].map(|index| &scene.cylinders[index]);
        let on_right = scene.wall_force(FLOOR, RIGHT);
        let on_left = scene.wall_force(FLOOR, LEFT);
        Sample {
            step,
            time,
            wall_force: scene.wall_force(self.top_wall, TOP).normal.lane(lane),
            x1: top.position[0].lane(lane),
            y1: top.position[1].lane(lane),
            theta1: top.angle.lane(lane),
            x2: right.position[0].lane(lane),
            y2: right.position[1].lane(lane),
            theta2: right.angle.lane(lane),
            x3: left.position[0].lane(lane),
            y3: left.position[1].lane(lane),
            theta3: left.angle.lane(lane),
            floor_n2: on_right.normal.lane(lane),
            // The tangent of the floor is t = (−1, 0).
            floor_t2: -on_right.tangential.lane(lane),
            floor_n3: on_left.normal.lane(lane),
            floor_t3: -on_left.tangential.lane(lane),
        }
    }
}

impl<R: Real, Model: ContactModel<R> + Composite<R>> StackScene<R, Model> {
    /// Takes over one lane of another stack.
    pub(super) fn take_lane(&mut self, lane: usize, other: &Self) {
        self.scene.take_lane(lane, &other.scene);
    }

    /// Every number of one lane.
    pub(super) fn numbers(&self, lane: usize) -> Vec<f64> {
        let mut numbers = Vec::new();
        let mut collect = |number: &mut R, _: &R| numbers.push(number.lane(lane));
        self.scene.clone().visit(&self.scene, &mut collect);
        numbers
    }

    /// Sets every number, in every lane; `numbers` are as many as [`Self::numbers`] gives.
    pub(super) fn set_numbers(&mut self, numbers: &[f64]) {
        let mut numbers = numbers.iter();
        let mut set = |number: &mut R, _: &R| {
            if let Some(&value) = numbers.next() {
                *number = number.like(value);
            }
        };
        let present = self.scene.clone();
        self.scene.visit(&present, &mut set);
    }
}

/// Three just-touching cylinders on the floor, which is the only wall.
pub(super) fn stress_free_stack<R: Real, Model: ContactModel<R>>(
    case: &Case,
    model: Model,
    number: R,
) -> Scene<R, Model> {
    let [zero, one] = [0.0, 1.0].map(|value| number.like(value));
    let cylinders = vec![
        Cylinder::at(zero, one + number.like(3.0).sqrt()),
        Cylinder::at(one, one),
        Cylinder::at(-one, one),
    ];
    let mut scene = Scene::new(cylinders, model, number.like(case.protocol.time_step));
    scene.cylinder_friction = number.like(case.stack.cylinder_friction);
    scene.pair_arm = number.like(case.convention.pair_arm);
    scene.wall_arm = number.like(case.convention.floor_arm);
    scene.moment_of_inertia = number.like(case.convention.moment_of_inertia);
    scene.add_wall(PlaneWall {
        normal: [zero, one],
        offset: zero,
        speed: zero,
        friction: number.like(case.stack.floor_friction),
    });
    scene
}

/// Lets gravity press the bottom cylinders into the floor, and puts frictionless walls at x = ±2, which just
/// touch them.
fn enclose<R: Real, Model: ContactModel<R>>(
    scene: &mut Scene<R, Model>,
    gravity: f64,
) -> [usize; 2] {
    let number = scene.time_step;
    let [zero, one] = [0.0, 1.0].map(|value| number.like(value));
    scene.gravity = number.like(gravity);
    for cylinder in [RIGHT, LEFT] {
        let height = &mut scene.cylinders[cylinder].position[1];
        *height = *height - number.like(gravity);
    }
    [[-one, zero], [one, zero]].map(|normal| {
        scene.add_wall(PlaneWall {
            normal,
            offset: number.like(-2.0),
            speed: zero,
            friction: zero,
        })
    })
}
