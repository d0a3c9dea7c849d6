//! The program behind the paper's figures (github.com/Ryudo-Suzuki/arXiv-2511.06807, src/compress.c): its contact law,
//! and how its runs start and end.
//!
//! It differs from the paper's text and from [`SpringDashpot`] in five points. The force takes the spring before the
//! increment of the step. Friction opposes the present velocity, not the spring. The spring of a sliding contact is
//! cut to the length that the overlap allows. Gravity is complete at once, and the wall stands still for a while. The
//! yield force is the force before the first decrease.
//!
//! [`SpringDashpot`]: super::SpringDashpot

use super::contact::{Contact, ContactForce, ContactModel};
use super::geometry::{Geometry, Linear, Plane, Tangential};
use super::many_stacks::{LaneWidth, OnNumber};
use super::real::{Composite, Real, Work};
use super::stack_scene::{FLOOR, LEFT, RIGHT, StackScene, TOP, TOP_WALL};
use crate::model::{
    Case, ContactConvention, ContactLaw, Preparation, Protocol, Sampling, Stack, sha256_hex,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Steps between two checks for finished runs, which take some milliseconds.
const STEPS_IN_A_BLOCK: u64 = 1 << 14;
/// Travel of the wall at which no stack is left.
const LONGEST_TRAVEL: f64 = 3.0;

/// Places, velocities and springs at the start of a run; bodies in the order top, right, left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GivenStart {
    /// x, y and rotation of every body, in r and rad.
    pub places: [[f64; 3]; 3],
    /// Their rates, in r and rad over the unit of time: √(m/k_n) of a [`PublishedRun`].
    pub velocities: [[f64; 3]; 3],
    /// Springs of the right and the left body against the top one, vectors in r.
    pub pair_springs: [[f64; 2]; 2],
    /// Springs of the right and the left body against the floor, vectors in r.
    pub floor_springs: [[f64; 2]; 2],
}

/// A run as made by the published program.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedRun {
    /// The state at its start.
    pub start: GivenStart,
    /// The stack.
    pub stack: Stack,
    /// Restitution e_r.
    pub restitution: f64,
    /// Initial height of the top wall, in r.
    pub wall_height: f64,
    /// Time for which the wall stands still, in √(m/k_n).
    pub wall_starts: f64,
    /// Speed at which the wall then moves down, in r √(k_n/m).
    pub wall_speed: f64,
    /// Time step, in √(m/k_n).
    pub time_step: f64,
    /// The steps whose force is kept, if any. The run then ends with the last of them, not with the first decrease.
    pub sampling: Option<ForceSampling>,
}

/// Evenly spaced steps at which the force of the wall is kept.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ForceSampling {
    /// The first step, counted from 0.
    pub first: u64,
    /// Distance from one step to the next.
    pub every: u64,
    /// Number of steps.
    pub count: u64,
}

impl ForceSampling {
    /// A single step, with which the run ends.
    pub fn at(step: u64) -> Self {
        Self {
            first: step,
            every: 1,
            count: 1,
        }
    }

    /// The step of the sample with this `index`.
    pub fn step(&self, index: u64) -> u64 {
        self.first.saturating_add(self.every.saturating_mul(index))
    }
}

/// The result of a published run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedForces {
    /// The force before its first decrease, in m g; `None` if it never decreases.
    pub yield_force: Option<f64>,
    /// The forces at the requested steps, in m g.
    pub samples: Vec<f64>,
}

impl PublishedForces {
    /// Whether there is at least one number and all are finite.
    pub fn is_usable(&self) -> bool {
        let mut all = self.yield_force.iter().chain(&self.samples);
        all.clone().next().is_some() && all.all(|force| force.is_finite())
    }
}

impl fmt::Display for PublishedRun {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Stack {
            floor_friction,
            stiffness,
            ..
        } = self.stack;
        let root = stiffness.sqrt();
        write!(
            formatter,
            "published run of mu = {floor_friction}, stiffness = {stiffness} at wall speed {:e} sqrt(g r)",
            self.wall_speed * root
        )
    }
}

impl PublishedRun {
    /// Content address: a hash of everything that decides its forces, including the sources of the native DEM.
    pub fn address(&self) -> String {
        let parts = serde_json::json!(["published-run", super::SOURCE_DIGEST, self]);
        sha256_hex(parts.to_string().as_bytes())
    }

    /// Upper bound of the number of steps.
    pub fn largest_steps(&self) -> u64 {
        match self.sampling {
            Some(sampling) => {
                let last = sampling.step(sampling.count.saturating_sub(1));
                last.saturating_add(1)
            }
            None => self.last_step(),
        }
    }

    /// The first step in which the wall moves.
    fn first_moving_step(&self) -> u64 {
        (self.wall_starts / self.time_step).ceil() as u64
    }

    /// The step at which a run ends if its force never falls.
    fn last_step(&self) -> u64 {
        let travel = (LONGEST_TRAVEL / (self.wall_speed * self.time_step)) as u64;
        self.first_moving_step().saturating_add(travel)
    }

    fn convention(&self) -> ContactConvention {
        ContactConvention {
            restitution: self.restitution,
            ..ContactConvention::PAPER
        }
    }

    /// The scene at the start, the same in every lane of numbers like `number`.
    fn scene<R: Real>(&self, number: R) -> StackScene<R, PublishedLaw<R>> {
        let law = self.convention().law(self.stack.stiffness_ratio);
        let law = PublishedLaw {
            law: law.map(|coefficient| number.like(coefficient)),
        };
        let mut scene = StackScene::of(&self.case(), law, number);
        scene.gravity = number.like(self.stack.epsilon());
        let like = |values: [f64; 2]| values.map(|value| number.like(value));
        for body in [TOP, RIGHT, LEFT] {
            let cylinder = &mut scene.cylinders[body];
            let ([x, y, angle], [u, v, spin]) =
                (self.start.places[body], self.start.velocities[body]);
            (cylinder.position, cylinder.velocity) = (like([x, y]), like([u, v]));
            (cylinder.angle, cylinder.spin) = (number.like(angle), number.like(spin));
        }
        for (index, body) in [RIGHT, LEFT].into_iter().enumerate() {
            *scene.pair_memory(body, TOP) = like(self.start.pair_springs[index]);
            *scene.wall_memory(FLOOR, body) = like(self.start.floor_springs[index]);
        }
        let wall = &mut scene.walls[TOP_WALL];
        wall.friction = number.like(self.stack.floor_friction);
        wall.offset = number.like(-self.wall_height);
        scene
    }

    /// Puts the wall where it is at the first step in which it moves, and sets its speed.
    fn start_wall<R: Real>(&self, lane: usize, scene: &mut StackScene<R, PublishedLaw<R>>) {
        let late = self.first_moving_step() as f64 * self.time_step - self.wall_starts;
        let height = self.wall_height - self.wall_speed * late;
        let wall = &mut scene.walls[TOP_WALL];
        wall.offset.set_lane(lane, wall.offset.like(-height));
        wall.speed.set_lane(lane, wall.speed.like(self.wall_speed));
    }

    /// A case with the stack and time step for building the scene.
    fn case(&self) -> Case {
        Case {
            stack: self.stack,
            convention: self.convention(),
            protocol: Protocol {
                preparation: Preparation::GravityRamp {
                    ramp_time: 1.0,
                    rest_time: 1.0,
                },
                time_step: self.time_step,
                wall_speed: self.wall_speed,
                wall_travel: LONGEST_TRAVEL,
                sampling: Sampling::default(),
                shortcuts: None,
            },
        }
    }
}

/// The contact law of the program; its memory is the spring as a vector.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PublishedLaw<R> {
    law: ContactLaw<R>,
}

impl<R: Real> Composite<R> for PublishedLaw<R> {
    #[inline(always)]
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.law.visit(&other.law, visit);
    }
}

impl<R: Real> ContactModel<R, Plane> for PublishedLaw<R> {
    type Memory = [R; 2];

    #[inline(always)]
    fn initial(&self, number: R) -> [R; 2] {
        [number.like(0.0); 2]
    }

    #[inline(always)]
    fn evaluate(&self, contact: &Contact<R, Plane>, spring: &mut [R; 2]) -> ContactForce<R, Plane> {
        let (law, normal) = (&self.law, contact.normal);
        let zero = contact.overlap.like(0.0);
        let pressing = contact.overlap - law.damping_normal * contact.separation_speed;
        let limit = contact.friction * pressing.abs();
        let rolling = <Plane as Geometry<R>>::rolling(normal, contact.spin);
        let velocity = Plane::put_together(normal, zero, contact.sliding_speed.minus(rolling));
        let damped = velocity.times(law.damping_tangential);
        let sticking = spring.times(-law.tangential_stiffness).minus(damped);
        let sticks = sticking.is_below(limit);
        let stretched = spring.plus(velocity.times(contact.time_step));
        let (force, next) = if limit.all(sticks) {
            (sticking, stretched)
        } else {
            let moves = zero.less(Plane::along(velocity, velocity));
            let direction = velocity.or_where_not(moves, spring);
            let longest = contact.friction * contact.overlap / law.tangential_stiffness;
            (
                sticking.or_where_not(sticks, &direction.of_length(limit).negated()),
                stretched.or_where_not(sticks, &direction.of_length(longest)),
            )
        };
        *spring = next;
        ContactForce::new(
            pressing + Plane::along(normal, force),
            Plane::tangential(normal, force),
            zero.like(1.0),
        )
    }
}

impl LaneWidth {
    /// Carries out `runs` while they are `wanted`. Calls `ended` with the index and the forces of each run at its end.
    pub fn run_published(
        self,
        runs: &[PublishedRun],
        wanted: impl FnMut() -> bool,
        ended: impl FnMut(usize, PublishedForces),
    ) {
        self.with_number(Published {
            runs,
            wanted,
            ended,
        });
    }
}

struct Published<'a, Wanted, Ended> {
    runs: &'a [PublishedRun],
    wanted: Wanted,
    ended: Ended,
}

impl<Wanted: FnMut() -> bool, Ended: FnMut(usize, PublishedForces)> OnNumber
    for Published<'_, Wanted, Ended>
{
    type Outcome = ();

    fn on<R: Real>(mut self, number: R) {
        let Some(first) = self.runs.first() else {
            return;
        };
        let mut group = Group {
            scene: first.scene(number),
            latest: number.like(0.0),
            largest: number.like(0.0),
            rises: number.like(0.0),
        };
        let mut lanes: Vec<Option<Lane>> = vec![None; R::LANES];
        let mut waiting = self.runs.iter().enumerate();
        loop {
            for (place, lane) in lanes.iter_mut().enumerate() {
                if lane.is_none() {
                    *lane = waiting.next().map(|(index, run)| Lane::new(index, run));
                    if let Some(lane) = lane {
                        group.begin(place, lane.run);
                    }
                }
            }
            if lanes.iter().all(Option::is_none) || !(self.wanted)() {
                return;
            }
            let steps = block(&lanes, &mut group);
            number.vectorize(Block {
                group: &mut group,
                steps,
            });
            for (place, slot) in lanes.iter_mut().enumerate() {
                let Some(lane) = slot else { continue };
                lane.step += steps;
                if let Some(forces) = lane.forces(place, &group) {
                    (self.ended)(lane.index, forces);
                    *slot = None;
                }
            }
        }
    }
}

/// A run in one lane of a group.
#[derive(Clone)]
struct Lane<'a> {
    index: usize,
    run: &'a PublishedRun,
    /// Steps completed.
    step: u64,
    samples: Vec<f64>,
}

impl<'a> Lane<'a> {
    fn new(index: usize, run: &'a PublishedRun) -> Self {
        Self {
            index,
            run,
            step: 0,
            samples: Vec::new(),
        }
    }

    /// Returns the next step whose force is kept.
    fn next_sample(&self) -> Option<u64> {
        let (sampling, done) = (self.run.sampling?, self.samples.len() as u64);
        (done < sampling.count).then_some(sampling.step(done))
    }

    /// Keeps the force of the last step if it was requested. Returns the forces of the run if it is at its end.
    fn forces<R: Real>(&mut self, place: usize, group: &Group<R>) -> Option<PublishedForces> {
        let stiffness = self.run.stack.stiffness;
        if self.next_sample() == self.step.checked_sub(1) {
            self.samples.push(group.latest.lane(place) * stiffness);
        }
        let has_fallen = group.rises.lane(place) == 0.0;
        let is_complete = match self.run.sampling {
            Some(_) => self.next_sample().is_none(),
            None => has_fallen,
        };
        let is_finite = group.latest.lane(place).is_finite();
        (is_complete || !is_finite || self.step > self.run.largest_steps()).then(|| {
            PublishedForces {
                yield_force: has_fallen.then(|| group.largest.lane(place) * stiffness),
                samples: std::mem::take(&mut self.samples),
            }
        })
    }
}

/// Starts the walls that move from now on. Returns the steps until the next wall starts or the next force is kept, at
/// most a block.
fn block<R: Real>(lanes: &[Option<Lane>], group: &mut Group<R>) -> u64 {
    let mut steps = STEPS_IN_A_BLOCK;
    for (place, lane) in lanes.iter().enumerate() {
        let Some(lane) = lane else { continue };
        match lane.run.first_moving_step().checked_sub(lane.step) {
            Some(0) => lane.run.start_wall(place, &mut group.scene),
            Some(left) => steps = steps.min(left),
            None => {}
        }
        if let Some(sample) = lane.next_sample() {
            steps = steps.min((sample - lane.step).saturating_add(1));
        }
    }
    steps
}

/// Runs in lockstep, one in each lane.
struct Group<R: Real> {
    scene: StackScene<R, PublishedLaw<R>>,
    /// The force of the wall in the last step.
    latest: R,
    /// The largest force of the wall before its first decrease.
    largest: R,
    /// 1 until that decrease, 0 afterwards.
    rises: R,
}

impl<R: Real> Group<R> {
    fn begin(&mut self, lane: usize, run: &PublishedRun) {
        let number = self.largest;
        self.scene.take_lane(lane, &run.scene(number));
        self.largest.set_lane(lane, number.like(0.0));
        self.rises.set_lane(lane, number.like(1.0));
    }
}

struct Block<'a, R: Real> {
    group: &'a mut Group<R>,
    steps: u64,
}

impl<R: Real> Work for Block<'_, R> {
    #[inline(always)]
    fn carry_out(self) {
        let Group {
            scene,
            latest,
            largest,
            rises,
        } = self.group;
        let zero = largest.like(0.0);
        for _ in 0..self.steps {
            scene.evaluate_forces();
            let force = scene.wall_force(TOP_WALL, TOP).normal;
            let falls = force.less(*largest);
            *latest = force;
            *rises = R::select(falls, zero, *rises);
            *largest = R::select(zero.less(*rises), force, *largest);
            scene.advance();
        }
    }
}
