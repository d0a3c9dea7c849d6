//! Which event comes first in a run: what slides, what closes, what touches, and under which load.
//!
//! The boundaries of the regime map are so close to each other's runs that preparation and compression
//! must be much slower than for a yield force. Gravity therefore does not rise over a fixed time but at a
//! fixed relative rate: with g(t) = g x/(1 + x), x growing by a constant factor a step, every force of the
//! stack grows by the same factor, and inertia changes the ratio of any two by the square of the rate.

use super::contact::SpringDashpot;
use super::stack_scene::{FLOOR, LEFT, RIGHT, StackScene, TOP, TOP_WALL};
use crate::model::{Case, ContactConvention, Preparation, Protocol, Sampling, Stack};
use crate::theory::{Event, LoadingPhase};

/// How slowly the stack is loaded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loading {
    /// Relative growth of gravity per unit time.
    pub gravity_rate: f64,
    /// Speed of the top wall, downwards.
    pub wall_speed: f64,
    /// How far the wall moves at most.
    pub wall_travel: f64,
    /// Time step.
    pub time_step: f64,
}

/// When a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Until {
    /// With the event that ends the path of equilibria.
    LastEvent,
    /// When the wall has travelled all its way.
    EndOfTravel,
}

/// What happened in a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// When contact 2–3 formed, if it did before `last`.
    pub closed: Option<LoadingPhase>,
    /// The first of floor slip, cylinder slip and wall contact, and when it came.
    pub last: Option<(Event, LoadingPhase)>,
    /// Force of the top wall on cylinder 1 at that moment, in m g; 0 under own weight.
    pub force: f64,
    /// How far the wall had moved then.
    pub travel: f64,
    /// Whether the stack still stands when gravity is complete.
    pub stands: bool,
    /// Force of the whole top wall at its first maximum, or the largest so far, in m g.
    pub peak_force: f64,
    /// Whether the force has fallen after that, by more than the stack can ring.
    pub peaked: bool,
    /// Time steps taken.
    pub steps: u64,
    /// Whether the run went as far as it should, rather than being given up.
    pub complete: bool,
}

/// Part of its final value from which gravity grows. What this first step excites is gone long before …
const FIRST_LOAD: f64 = 1e-7;
/// … gravity has reached this part of its final value, from which on events count: on the ramp they are there
/// from the start or come near its end.
const COUNTED_LOAD: f64 = 1e-2;
/// The part of gravity that is missing when the ramp ends.
const MISSING_LOAD: f64 = 1e-6;
/// Cylinder 1 rests √3 above the others, and falls until it is level with them.
const LOWEST_RISE: f64 = 1.0;
/// The wall starts with a jolt of a few time units; what the stack loads in this time is more than it rings.
const RINGING: f64 = 20.0;
/// Some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

/// Prepares and compresses `stack`, under the paper's convention, and watches what happens, for as long as
/// it is `wanted`.
pub fn watch_stack(
    stack: &Stack,
    loading: &Loading,
    until: Until,
    wanted: impl Fn() -> bool,
) -> Observation {
    let law = SpringDashpot::like(0.0, &ContactConvention::PAPER, stack.tangential_stiffness());
    let scene = StackScene::of(&case(stack, loading), law, 0.0);
    let mut run = Run {
        scene,
        stack: *stack,
        observation: Observation {
            closed: None,
            last: None,
            force: 0.0,
            travel: 0.0,
            stands: false,
            peak_force: 0.0,
            peaked: false,
            steps: 0,
            complete: false,
        },
    };
    let wanted = |step: u64| !step.is_multiple_of(STEPS_BETWEEN_QUESTIONS) || wanted();
    let prepared = run.prepare(loading, until, wanted);
    let complete = prepared && run.compress(loading, until, wanted);
    Observation {
        complete,
        ..run.observation
    }
}

struct Run {
    scene: StackScene<f64, SpringDashpot<f64>>,
    stack: Stack,
    observation: Observation,
}

impl Run {
    /// Raises gravity; false if no longer wanted.
    fn prepare(&mut self, loading: &Loading, until: Until, wanted: impl Fn(u64) -> bool) -> bool {
        let gravity = self.stack.epsilon();
        let growth = 1.0 + loading.gravity_rate * loading.time_step;
        let mut load = FIRST_LOAD;
        let mut step = 0;
        while load < 1.0 / MISSING_LOAD {
            if !wanted(step) {
                return false;
            }
            self.scene.gravity = gravity * (load / (1.0 + load));
            self.scene.evaluate_forces();
            if load >= COUNTED_LOAD {
                if self.observation.last.is_none() {
                    self.watch(LoadingPhase::OwnWeight);
                }
                if until == Until::LastEvent && self.observation.last.is_some() {
                    return true;
                }
            }
            self.advance();
            load *= growth;
            step += 1;
        }
        self.scene.gravity = gravity;
        self.observation.stands = self.rise() > LOWEST_RISE;
        true
    }

    /// Lowers the wall; false if no longer wanted.
    fn compress(&mut self, loading: &Loading, until: Until, wanted: impl Fn(u64) -> bool) -> bool {
        if until == Until::LastEvent && self.observation.last.is_some() {
            return true;
        }
        self.scene.lower_top_wall(0, 0.0);
        let (mut step, mut travel) = (0, 0.0);
        while travel < loading.wall_travel {
            if !wanted(step) {
                return false;
            }
            // At first the load grows as slowly, compared with the weight, as gravity did.
            let gentle = loading.gravity_rate * (self.stack.epsilon() + travel);
            self.scene.walls[TOP_WALL].speed = loading.wall_speed.min(gentle);
            self.scene.evaluate_forces();
            self.record(travel);
            if until == Until::LastEvent && self.observation.last.is_some() {
                return true;
            }
            self.advance();
            travel += self.scene.walls[TOP_WALL].speed * loading.time_step;
            step += 1;
        }
        true
    }

    fn advance(&mut self) {
        self.scene.advance();
        self.observation.steps += 1;
    }

    /// Height of cylinder 1 above cylinder 2.
    fn rise(&self) -> f64 {
        let [top, right] = [TOP, RIGHT].map(|index| self.scene.cylinders[index].position[1]);
        top - right
    }

    fn record(&mut self, travel: f64) {
        let force = |cylinder| self.scene.wall_force(TOP_WALL, cylinder).normal;
        let on_top = force(TOP) * self.stack.stiffness;
        let whole = on_top + (force(RIGHT) + force(LEFT)) * self.stack.stiffness;
        if !self.observation.peaked {
            let peak = self.observation.peak_force.max(whole);
            let fallen = (peak - whole) * self.stack.epsilon();
            self.observation.peak_force = peak;
            self.observation.peaked = fallen > RINGING * self.scene.walls[TOP_WALL].speed;
        }
        if self.observation.last.is_none() {
            self.observation.force = on_top;
            self.observation.travel = travel;
            self.watch(LoadingPhase::Wall);
        }
    }

    /// Notes what has happened, once the forces are evaluated.
    fn watch(&mut self, stage: LoadingPhase) {
        let scene = &self.scene;
        let touches = |cylinder| scene.wall_force(TOP_WALL, cylinder).normal != 0.0;
        let event = if self.floor_slides() {
            Some(Event::FloorSlip)
        } else if self.cylinders_slide() {
            Some(Event::CylinderSlip)
        } else if touches(RIGHT) || touches(LEFT) {
            Some(Event::WallContact)
        } else {
            None
        };
        let closed = scene.pair_force(LEFT, RIGHT).normal != 0.0;
        if closed && self.observation.closed.is_none() {
            self.observation.closed = Some(stage);
        }
        self.observation.last = event.map(|event| (event, stage));
    }

    /// Whether either floor contact bears all the tangential force it can.
    fn floor_slides(&self) -> bool {
        let friction = self.scene.walls[FLOOR].friction;
        [RIGHT, LEFT].into_iter().any(|cylinder| {
            let contact = self.scene.wall_force(FLOOR, cylinder);
            let limit = friction * contact.normal.abs();
            limit > 0.0 && contact.tangential.abs() >= limit
        })
    }

    /// The same of the contacts of cylinder 1 with the others.
    fn cylinders_slide(&self) -> bool {
        [RIGHT, LEFT].into_iter().any(|cylinder| {
            let contact = self.scene.pair_force(cylinder, TOP);
            let limit = self.scene.cylinder_friction * contact.normal.abs();
            limit > 0.0 && contact.tangential.abs() >= limit
        })
    }
}

/// The run as a case, for what the scene takes from one: stack, convention and time step.
fn case(stack: &Stack, loading: &Loading) -> Case {
    Case {
        stack: *stack,
        convention: ContactConvention::PAPER,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 1.0 / loading.gravity_rate,
                rest_time: 0.0,
            },
            time_step: loading.time_step,
            wall_speed: loading.wall_speed,
            wall_travel: loading.wall_travel,
            sampling: Sampling {
                coarse_interval: loading.time_step,
                fine_from_travel: 0.0,
                fine_interval: loading.time_step,
            },
            shortcuts: None,
        },
    }
}
