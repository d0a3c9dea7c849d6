//! The three-cylinder stack as a scene.

use super::contact::ContactModel;
use super::loading::Action;
use super::real::{Composite, Real};
use super::scene::{Cylinder, Scene};
use super::wall::{Facing, PlaneWall};
use crate::model::{Case, Preparation};
use crate::series::Sample;

pub(super) const TOP: usize = 0;
pub(super) const RIGHT: usize = 1;
pub(super) const LEFT: usize = 2;

pub(super) const FLOOR: usize = 0;
const SIDE_WALLS: [usize; 2] = [1, 2];
pub(super) const TOP_WALL: usize = 3;

/// Three cylinders on the floor, between the side walls of some preparations, under the top wall.
pub(super) type StackScene<R, Model> = Scene<3, 4, R, Model>;

/// Offset of a wall out of reach.
const OUT_OF_REACH: f64 = f64::MIN;

impl<R: Real, Model: ContactModel<R>> StackScene<R, Model> {
    /// The stack of `case` at the start of its preparation, the same in every lane of numbers like `number`.
    pub(super) fn of(case: &Case, model: Model, number: R) -> Self {
        let [zero, one] = [0.0, 1.0].map(|value| number.like(value));
        let cylinders = [
            Cylinder::at(zero, one + number.like(3.0).sqrt()),
            Cylinder::at(one, one),
            Cylinder::at(-one, one),
        ];
        let wall = |facing, offset: f64, friction: f64| PlaneWall {
            facing,
            offset: number.like(offset),
            speed: zero,
            friction: number.like(friction),
        };
        let walls = [
            wall(Facing::Up, 0.0, case.stack.floor_friction),
            wall(Facing::Left, OUT_OF_REACH, 0.0),
            wall(Facing::Right, OUT_OF_REACH, 0.0),
            wall(Facing::Down, OUT_OF_REACH, 0.0),
        ];
        let mut scene = Self::new(
            cylinders,
            walls,
            model,
            number.like(case.protocol.time_step),
        );
        scene.cylinder_friction = number.like(case.stack.cylinder_friction);
        scene.moment_of_inertia = number.like(case.convention.moment_of_inertia);
        match case.protocol.preparation {
            Preparation::GravityRamp { .. } => {
                for wall in SIDE_WALLS {
                    scene.wall_exists[wall] = false;
                }
            }
            Preparation::SideWalls(_) => scene.enclose(case.stack.epsilon()),
        }
        scene
    }

    /// Lets gravity press the bottom cylinders into the floor, and puts the frictionless side walls at
    /// x = ±2, where they just touch them.
    fn enclose(&mut self, gravity: f64) {
        self.gravity = self.time_step.like(gravity);
        for cylinder in [RIGHT, LEFT] {
            let height = &mut self.cylinders[cylinder].position[1];
            *height = *height - self.gravity;
        }
        for wall in SIDE_WALLS {
            self.walls[wall].offset = self.time_step.like(-2.0);
        }
    }

    /// Puts the top wall onto the top cylinder, in one lane.
    pub(super) fn lower_top_wall(&mut self, lane: usize, speed: R) {
        let top = self.cylinders[TOP].position[1];
        let wall = &mut self.walls[TOP_WALL];
        wall.offset.set_lane(lane, -(top + top.like(1.0)));
        wall.speed.set_lane(lane, speed);
    }

    /// Applies `action` to one lane.
    pub(super) fn act(&mut self, lane: usize, action: Action) {
        let number = self.time_step;
        match action {
            Action::SetGravity(gravity) => self.gravity.set_lane(lane, number.like(gravity)),
            Action::MoveSideWalls(speed) => {
                for wall in SIDE_WALLS {
                    self.walls[wall].speed.set_lane(lane, number.like(speed));
                }
            }
            Action::RemoveSideWalls => {
                for wall in SIDE_WALLS {
                    let wall = &mut self.walls[wall];
                    wall.speed.set_lane(lane, number.like(0.0));
                    wall.offset.set_lane(lane, number.like(OUT_OF_REACH));
                }
            }
            Action::PlaceTop { height, velocity } => {
                let top = &mut self.cylinders[TOP];
                let [zero, height, velocity] =
                    [0.0, height, velocity].map(|value| number.like(value));
                top.position.take_lane(lane, &[zero, height]);
                top.velocity.take_lane(lane, &[zero, velocity]);
            }
            Action::StartTopWall(speed) => self.lower_top_wall(lane, number.like(speed)),
            Action::MoveTopWall(speed) => {
                self.walls[TOP_WALL]
                    .speed
                    .set_lane(lane, number.like(speed));
            }
        }
    }

    /// The state of one lane, at the given step of the compression.
    pub(super) fn sample(&self, lane: usize, step: u64, time: f64) -> Sample {
        let [top, right, left] = [TOP, RIGHT, LEFT].map(|index| &self.cylinders[index]);
        let on_right = self.wall_force(FLOOR, RIGHT);
        let on_left = self.wall_force(FLOOR, LEFT);
        Sample {
            step,
            time,
            wall_force: self.wall_force(TOP_WALL, TOP).normal.lane(lane),
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
    /// Every number of one lane.
    pub(super) fn numbers(&self, lane: usize) -> Vec<f64> {
        let mut numbers = Vec::new();
        let mut collect = |number: &mut R, _: &R| numbers.push(number.lane(lane));
        self.clone().visit(self, &mut collect);
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
        let present = self.clone();
        self.visit(&present, &mut set);
    }
}
