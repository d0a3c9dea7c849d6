//! The stack as a scene: three cylinders in the plane, or spheres in space.

use super::body::Body;
use super::contact::{ContactModel, ConventionalModel};
use super::geometry::Facing;
use super::geometry::{Geometry, Space};
use super::loading::Action;
use super::real::{Composite, Real};
use super::scene::Scene;
use super::wall::PlaneWall;
use crate::model::{Case, MOST_BODIES, Preparation, Stack};
use crate::series::{Placement, Sample};

pub(super) const TOP: usize = 0;
pub(super) const RIGHT: usize = 1;
pub(super) const LEFT: usize = 2;

pub(super) const FLOOR: usize = 0;
const SIDE_WALLS: [usize; 2] = [1, 2];
pub(super) const TOP_WALL: usize = 3;
const WALLS: usize = 4;

/// Three cylinders on the floor and under the top wall, with the side walls that some preparations need.
pub(super) type StackScene<R, Model> = Scene<3, WALLS, R, Model>;

/// The spheres of any stack: a ring, and one on top.
pub(super) type SphereScene<R, Model> = Scene<MOST_BODIES, WALLS, R, Model, Space>;

/// A stack with a run in each lane of its numbers.
pub(super) trait LoadedStack {
    /// The type of its numbers.
    type Number: Real;

    /// Returns a number like those of the stack.
    fn number(&self) -> Self::Number;
    /// Applies `action` to one lane, the run of `case`.
    fn act(&mut self, lane: usize, case: &Case, action: Action);
    /// Returns the state of one lane, the run of `case`, at the given step of the compression.
    fn sample(&self, lane: usize, case: &Case, step: u64) -> Sample;
    /// Evaluates the forces.
    fn evaluate_forces(&mut self);
    /// Advances velocities, positions and walls.
    fn advance(&mut self);
    /// Does both, `count` times; the contact forces are not kept.
    fn steps(&mut self, count: u64);
}

/// A stack whose contact law is built from a convention.
pub(super) trait ConventionalStack: LoadedStack + Composite<Self::Number> {
    /// The stack of `case` at the start of its preparation, the same in every lane of numbers like `number`.
    fn of_case(case: &Case, number: Self::Number) -> Self;
}

/// Offset that puts a wall out of reach.
const OUT_OF_REACH: f64 = f64::MIN;

/// Centres of all bodies when they just touch.
fn centres<R: Real, const BODIES: usize>(stack: &Stack, number: R) -> [[R; 3]; BODIES] {
    let initial = stack.initial_positions();
    let mut centres = std::array::from_fn(|body| {
        let centre: [f64; 3] = initial.get(body).copied().unwrap_or_default();
        centre.map(|coordinate| number.like(coordinate))
    });
    if stack.bodies == 2 {
        // To the full precision of the numbers.
        centres[TOP][1] = number.like(1.0) + number.like(3.0).sqrt();
    }
    centres
}

impl<const BODIES: usize, R, Model, G> Scene<BODIES, WALLS, R, Model, G>
where
    R: Real,
    Model: ContactModel<R, G>,
    G: Geometry<R>,
{
    /// The stack of `case` at the start of its preparation, the same in every lane of numbers like `number`.
    pub(super) fn of(case: &Case, model: Model, number: R) -> Self {
        let bodies = centres::<R, BODIES>(&case.stack, number);
        let wall = |facing, offset: f64, friction: f64| PlaneWall {
            facing,
            offset: number.like(offset),
            speed: number.like(0.0),
            friction: number.like(friction),
        };
        let walls = [
            wall(Facing::Up, 0.0, case.stack.floor_friction),
            wall(Facing::Left, OUT_OF_REACH, 0.0),
            wall(Facing::Right, OUT_OF_REACH, 0.0),
            wall(Facing::Down, OUT_OF_REACH, 0.0),
        ];
        let mut scene = Self::new(
            bodies.map(|centre| Body::resting(G::vector(centre))),
            walls,
            model,
            number.like(case.protocol.time_step),
        );
        scene.sphere_count = usize::from(case.stack.bodies) + 1;
        scene.cylinder_friction = number.like(case.stack.cylinder_friction);
        scene.moment_of_inertia = number.like(case.convention.moment_of_inertia);
        match case.protocol.preparation {
            Preparation::GravityRamp { .. } | Preparation::Rigid => {
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
            let [x, y, z] = G::components(self.cylinders[cylinder].position);
            self.cylinders[cylinder].position = G::vector([x, y - self.gravity, z]);
        }
        for wall in SIDE_WALLS {
            self.walls[wall].offset = self.time_step.like(-2.0);
        }
    }

    /// Puts the top wall onto the body on top, in one lane, and sets its speed.
    pub(super) fn lower_top_wall(&mut self, lane: usize, top: usize, speed: R) {
        let [_, top, _] = G::components(self.cylinders[top].position);
        let wall = &mut self.walls[TOP_WALL];
        wall.offset.set_lane(lane, -(top + top.like(1.0)));
        wall.speed.set_lane(lane, speed);
    }
}

impl<const BODIES: usize, R, Model, G> LoadedStack for Scene<BODIES, WALLS, R, Model, G>
where
    R: Real,
    Model: ContactModel<R, G>,
    G: Geometry<R>,
{
    type Number = R;

    fn number(&self) -> R {
        self.time_step
    }

    fn act(&mut self, lane: usize, case: &Case, action: Action) {
        let number = self.time_step;
        let top = case.stack.top();
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
                let top = &mut self.cylinders[top];
                let upwards = |value| G::vector([0.0, value, 0.0].map(|value| number.like(value)));
                top.position.take_lane(lane, &upwards(height));
                top.velocity.take_lane(lane, &upwards(velocity));
            }
            Action::StartTopWall(speed) => self.lower_top_wall(lane, top, number.like(speed)),
            Action::MoveTopWall(speed) => {
                self.walls[TOP_WALL]
                    .speed
                    .set_lane(lane, number.like(speed));
            }
        }
    }

    fn sample(&self, lane: usize, case: &Case, step: u64) -> Sample {
        let in_lane = |components: [R; 3]| components.map(|component| component.lane(lane));
        let on_top = self.wall_force(TOP_WALL, case.stack.top()).normal;
        let mut sample = Sample {
            step,
            time: step as f64 * case.protocol.time_step,
            wall_force: on_top.lane(lane),
            ..Sample::default()
        };
        let bodies = self.cylinders.iter().take(self.sphere_count);
        for (index, body) in bodies.enumerate() {
            sample.bodies[index] = Placement {
                position: in_lane(G::components(body.position)),
                rotation: in_lane(G::rotation_components(body.angle)),
            };
            let force = self.wall_force(FLOOR, index);
            let force = G::put_together_at_wall(Facing::Up, force.normal, force.tangential);
            sample.floor[index] = in_lane(G::components(force));
        }
        sample
    }

    #[inline(always)]
    fn evaluate_forces(&mut self) {
        Self::evaluate_forces(self);
    }

    #[inline(always)]
    fn advance(&mut self) {
        Self::advance(self);
    }

    #[inline(always)]
    fn steps(&mut self, count: u64) {
        Self::steps(self, count);
    }
}

impl<const BODIES: usize, R, Model, G> ConventionalStack for Scene<BODIES, WALLS, R, Model, G>
where
    R: Real,
    Model: ConventionalModel<R, G>,
    G: Geometry<R>,
{
    fn of_case(case: &Case, number: R) -> Self {
        let (convention, stiffness_ratio) = (&case.convention, case.stack.stiffness_ratio);
        let model = Model::of_convention(number, convention, stiffness_ratio);
        Self::of(case, model, number)
    }
}

/// Returns every number of one lane of a `stack`.
pub(super) fn numbers<R: Real>(stack: &impl Composite<R>, lane: usize) -> Vec<f64> {
    let mut numbers = Vec::new();
    let mut collect = |number: &mut R, _: &R| numbers.push(number.lane(lane));
    stack.clone().visit(stack, &mut collect);
    numbers
}

/// Sets every number of a `stack`, in every lane, from the `numbers` that [`numbers`] has returned.
pub(super) fn set_numbers<R: Real>(stack: &mut impl Composite<R>, numbers: &[f64]) {
    let mut numbers = numbers.iter();
    let mut set = |number: &mut R, _: &R| {
        if let Some(&value) = numbers.next() {
            *number = number.like(value);
        }
    };
    let present = stack.clone();
    stack.visit(&present, &mut set);
}
