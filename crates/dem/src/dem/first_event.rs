//! Runs that report which event comes first (slip, closing of contact 2–3, wall contact) and under which load.
//!
//! Stacks on both sides of a boundary of the regime map differ so little that preparation and compression must be much
//! slower than for a yield force. Gravity therefore rises at a fixed relative rate rather than over a fixed time:
//! g(t) = g x/(1 + x), where x grows by a constant factor per step. Every force of the stack then grows by the same
//! factor, and inertia changes the ratio of any two forces by the square of the rate.

use super::body::Body;
use super::contact::{Contact, SpringDashpot};
use super::stack_scene::{FLOOR, LEFT, RIGHT, StackScene, TOP, TOP_WALL};
use crate::model::{
    Case, ContactConvention, HistoryUpdate, Preparation, Protocol, Sampling, Stack, sha256_hex,
};
use crate::theory::{Event, LoadingPhase};
use serde::{Deserialize, Serialize};

/// How slowly the stack is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Loading {
    /// Relative growth of gravity per unit time.
    pub gravity_rate: f64,
    /// Speed of the top wall, downwards.
    pub wall_speed: f64,
    /// Largest travel of the wall.
    pub wall_travel: f64,
    /// Time step.
    pub time_step: f64,
}

/// When a run ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Until {
    /// At the event that ends the path of equilibria, or at the end of the travel.
    LastEvent,
    /// At the end of the travel.
    EndOfTravel,
}

/// A run that reports its events and its largest force. Its convention is the paper's, except for the rule by which
/// springs change as their contacts turn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventRun {
    /// The stack.
    pub stack: Stack,
    /// The rule by which tangential springs change as their contacts turn.
    pub history_update: HistoryUpdate,
    /// How it is loaded.
    pub loading: Loading,
    /// When the run ends.
    pub until: Until,
}

/// The events of a run, and its largest force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Observation {
    /// The phase in which contact 2–3 closed, if it closed no later than `last`.
    pub closed: Option<LoadingPhase>,
    /// The first of floor slip, cylinder slip and wall contact, and the phase in which it came.
    pub last: Option<(Event, LoadingPhase)>,
    /// Force of the top wall on cylinder 1 at that moment, in m g; 0 under own weight.
    pub force: f64,
    /// Travel of the wall at that moment.
    pub travel: f64,
    /// Whether the stack still stands when gravity is complete.
    pub stands: bool,
    /// Force of the whole top wall at its first maximum, or the largest so far, in m g.
    pub peak_force: f64,
    /// Whether the force has fallen from that maximum by more than vibration can explain.
    pub peaked: bool,
    /// Time steps taken.
    pub steps: u64,
    /// Whether the run reached its end, and was not given up.
    pub complete: bool,
}

/// Fraction of full gravity at which the ramp starts. The vibration that this first step excites dies out long before
/// [`COUNTED_LOAD`].
const FIRST_LOAD: f64 = 1e-7;
/// Fraction of full gravity from which events count. Under own weight, events are present from the start or come near
/// the end of the ramp.
const COUNTED_LOAD: f64 = 1e-2;
/// Fraction of gravity that is missing when the ramp ends.
const MISSING_LOAD: f64 = 1e-6;
/// Height of cylinder 1 above the others below which the stack has fallen. At rest it is √3, and it falls to 0.
const LOWEST_RISE: f64 = 1.0;
/// Time in which the load grows by more than the stack vibrates: the start of the wall excites it for a few time
/// units.
const RINGING: f64 = 20.0;
/// Relative rounding error of a force at its limit.
const SAME: f64 = 1e-14;
/// Steps between two calls of `wanted`, which take some milliseconds.
const STEPS_BETWEEN_QUESTIONS: u64 = 1 << 16;

impl EventRun {
    /// Content address: a hash of everything that decides the observation, including the sources of the native DEM.
    pub fn address(&self) -> String {
        let parts = serde_json::json!(["event-run", super::SOURCE_DIGEST, self.convention(), self]);
        sha256_hex(parts.to_string().as_bytes())
    }

    fn convention(&self) -> ContactConvention {
        ContactConvention {
            history_update: self.history_update,
            ..ContactConvention::TURNING
        }
    }

    /// Upper bound of the number of time steps.
    pub fn largest_steps(&self) -> f64 {
        let loading = &self.loading;
        let ramp = -libm::log(FIRST_LOAD * MISSING_LOAD) / loading.gravity_rate;
        let gentle = loading.gravity_rate * self.stack.epsilon();
        let start = libm::log((loading.wall_speed / gentle).max(1.0)) / loading.gravity_rate;
        (ramp + start + loading.wall_travel / loading.wall_speed) / loading.time_step
    }

    /// Prepares and compresses the stack, and observes it while the run is `wanted`.
    pub fn observe(&self, wanted: impl Fn() -> bool) -> Observation {
        let Self {
            stack,
            loading,
            until,
            ..
        } = self;
        let convention = self.convention();
        let law = SpringDashpot::like(0.0, &convention, stack.stiffness_ratio);
        let mut run = Run {
            scene: StackScene::of(&case(stack, convention, loading), law, 0.0),
            stack: *stack,
            observation: Observation::NOTHING,
        };
        let wanted = |step: u64| !step.is_multiple_of(STEPS_BETWEEN_QUESTIONS) || wanted();
        let prepared = run.prepare(loading, *until, wanted);
        let complete = prepared && run.compress(loading, *until, wanted);
        Observation {
            complete,
            ..run.observation
        }
    }
}

impl std::fmt::Display for EventRun {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Stack {
            floor_friction,
            cylinder_friction,
            stiffness,
            stiffness_ratio,
            ..
        } = self.stack;
        write!(
            formatter,
            "events of mu = {floor_friction}, mu_d = {cylinder_friction}, stiffness = {stiffness}, kappa = \
             {stiffness_ratio}"
        )
    }
}

impl Observation {
    /// The observation before the first step.
    pub const NOTHING: Self = Self {
        closed: None,
        last: None,
        force: 0.0,
        travel: 0.0,
        stands: false,
        peak_force: 0.0,
        peaked: false,
        steps: 0,
        complete: false,
    };

    /// Whether the run reached its end within the finite numbers.
    pub fn is_usable(&self) -> bool {
        let forces = [self.force, self.travel, self.peak_force];
        self.complete && forces.into_iter().all(f64::is_finite)
    }
}

struct Run {
    scene: StackScene<f64, SpringDashpot<f64>>,
    stack: Stack,
    observation: Observation,
}

impl Run {
    /// Raises gravity; returns false if the run was given up.
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

    /// Lowers the wall; returns false if the run was given up.
    fn compress(&mut self, loading: &Loading, until: Until, wanted: impl Fn(u64) -> bool) -> bool {
        if until == Until::LastEvent && self.observation.last.is_some() {
            return true;
        }
        self.scene.lower_top_wall(0, TOP, 0.0);
        let (mut step, mut travel) = (0, 0.0);
        while travel < loading.wall_travel {
            if !wanted(step) {
                return false;
            }
            // At first the load grows at the relative rate at which gravity rose.
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

    /// Records force and events at the given travel of the wall.
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

    /// Records the events that the current forces show.
    fn watch(&mut self, phase: LoadingPhase) {
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
            self.observation.closed = Some(phase);
        }
        self.observation.last = event.map(|event| (event, phase));
    }

    /// Whether a floor contact is at Coulomb's limit.
    fn floor_slides(&self) -> bool {
        let friction = self.scene.walls[FLOOR].friction;
        [RIGHT, LEFT].into_iter().any(|cylinder| {
            let contact = self.scene.wall_force(FLOOR, cylinder);
            let limit = friction * contact.normal.abs();
            limit > 0.0 && contact.tangential.abs() >= limit
        })
    }

    /// Whether a contact of cylinder 1 with one of the others is at Coulomb's limit.
    fn cylinders_slide(&self) -> bool {
        [RIGHT, LEFT].into_iter().any(|cylinder| {
            let force = self.scene.pair_force(cylinder, TOP);
            let pressed = self.pressed([cylinder, TOP]);
            // The force along the normal of a spring that does not turn is part of the tangential force.
            let whole = libm::hypot(force.tangential, force.normal - pressed);
            let limit = self.scene.cylinder_friction * pressed.abs();
            limit > 0.0 && whole >= limit * (1.0 - SAME)
        })
    }

    /// The normal force of two cylinders from their overlap and damping alone.
    fn pressed(&self, pair: [usize; 2]) -> f64 {
        let scene = &self.scene;
        let bodies = pair.map(|index| &scene.cylinders[index]);
        let apart = Body::apart(bodies);
        let contact = Contact::of_pair(bodies, apart, scene.cylinder_friction, scene.time_step);
        let model = &scene.model;
        model.normal_force(contact.overlap, contact.separation_speed)
    }
}

/// A case with the stack, convention and time step for building the scene.
fn case(stack: &Stack, convention: ContactConvention, loading: &Loading) -> Case {
    Case {
        stack: *stack,
        convention,
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
