//! A DEM of the stack and of the micro-tests in which every number and every part of the law can be a wrong one.
//!
//! Without a fault it is the native DEM, to rounding. What can be wrong is a field of [`OfContact`] or [`OfRun`], which
//! mistakes.toml sets by name.

use crate::model::{
    Case, ContactConvention, ContactLaw, ContactTest, CoulombOperand, HistoryUpdate,
    PreparationSteps, Schedule, SlidingSpring, TensileForce, smooth_step,
};

/// Declares numbers that have a name and a right value.
macro_rules! numbers {
    ($(#[$doc:meta])* $kind:ident: $($name:ident = $right:expr, $meaning:literal;)*) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(super) struct $kind {
            $(#[doc = $meaning] pub $name: f64,)*
        }

        impl $kind {
            const RIGHT: Self = Self { $($name: $right,)* };

            /// The number of that name.
            pub fn by_name(&mut self, name: &str) -> Option<&mut f64> {
                match name {
                    $(stringify!($name) => Some(&mut self.$name),)*
                    _ => None,
                }
            }
        }
    };
}

numbers! {
    /// The law of one contact. What is a factor is 1 where nothing is wrong, and a flag 0.
    OfContact:
    normal_stiffness = 1.0, "k_n.";
    tangential_stiffness = 1.0, "k_t.";
    damping_normal = 0.0, "η_n.";
    damping_tangential = 0.0, "η_t.";
    friction = 0.0, "μ.";
    sliding_friction = 1.0, "Factor on μ of a contact that slides.";
    exists = 1.0, "Factor on both forces.";
    gap = 0.0, "Is taken off the overlap.";
    by_diameter = 0.0, "Flag: the normal is the distance of the centres over 2 r, and no unit vector.";
    lever = 1.0, "Radius in torque and surface velocity.";
    exponent = 1.0, "Power of the overlap in the spring's force.";
    spring_growth = 1.0, "Factor on the growth of the tangential spring in a step.";
    spring_kept = 1.0, "Part of the tangential spring that is kept from one step to the next.";
    spin_one = 1.0, "Factor on the spin of the first body in the surface velocity.";
    spin_two = 1.0, "The same of the second body.";
    spin_in_spring = 1.0, "Factor on the spins in the growth of the spring.";
    spin_in_damping = 1.0, "Factor on the spins in the damping.";
    separation_two = 1.0, "Factor on the velocity of the second body along the normal.";
    sliding_one = 1.0, "Factor on the velocity of the first body along the tangent.";
    sliding_two = 1.0, "The same of the second body.";
    torque_one = 1.0, "Factor on the torque on the first body.";
    torque_two = 1.0, "The same of the second body.";
    normal_one = 1.0, "Factor on the normal force on the first body.";
    normal_two = 1.0, "The same of the second body.";
    tangential_one = 1.0, "Factor on the tangential force on the first body.";
    tangential_two = 1.0, "The same of the second body.";
    tangent = 1.0, "Factor on the direction of the tangential force.";
    damping_one = 1.0, "Factor on the normal damping on the first body.";
    damping_two = 1.0, "The same of the second body.";
    spring_one = 1.0, "Factor on the normal spring on the first body.";
    spring_two = 1.0, "The same of the second body.";
    limit_of_spring = 0.0, "Flag: μ times the spring's part of the normal force.";
    limit_of_weight = 0.0, "Flag: μ times m g.";
    limit_signed = 0.0, "Flag: μ n without the absolute value, none where it pulls.";
    keeps_sliding_spring = 0.0, "Flag: the spring grows while the contact slides.";
    clears_sliding_spring = 0.0, "Flag: it is 0 while the contact slides.";
    keeps_open_spring = 0.0, "Flag: it is kept while the contact is open.";
    stale_spring = 0.0, "Flag: the force is that of the spring before it grows.";
    damps_sliding = 0.0, "Flag: the damping is added to the force at the limit.";
    one_sided = 0.0, "The sign that the force at the limit always has.";
    uncapped_damping = 0.0, "Flag: the spring alone is capped, and the damping added.";
    caps_of = 0.0, "The only sign of forces that are capped.";
    limit_before = 0.0, "Flag: μ times the normal force of the step before.";
    damps_approach = 0.0, "Flag: only surfaces that approach are damped along the normal.";
    damping_exponent = 0.0, "Power of the overlap in the normal damping.";
    rolling = 0.0, "Rolling friction: torque over normal force.";
    pulls = 0.0, "Flag: a contact that opens goes on pulling.";
}

numbers! {
    /// Bodies, integration and loading.
    OfRun:
    mass = 1.0, "m in the acceleration.";
    weight = 1.0, "Factor on the weight.";
    weight_1 = 1.0, "The same of cylinder 1 alone.";
    weight_2 = 1.0, "The same of cylinder 2 alone.";
    weight_3 = 1.0, "The same of cylinder 3 alone.";
    tilt = 0.0, "Horizontal part of gravity.";
    radius = 1.0, "Radius wherever it counts.";
    moment_of_inertia = 0.5, "I.";
    time_step = 0.0, "dt.";
    mass_1 = 1.0, "Factor on m of cylinder 1.";
    push_x = 1.0, "Factor on horizontal forces in the kick.";
    push_y = 1.0, "The same of vertical ones.";
    push_spin = 1.0, "The same of torques.";
    drift = 1.0, "Factor on the change of positions.";
    gravity = 0.0, "g.";
    gravity_in_compression = 1.0, "Factor on the weight in the compression.";
    ramp_steps = 0.0, "Steps of the ramp.";
    rest_steps = 0.0, "Steps of the rest.";
    ramp_shape = 0.0, "0: quintic, 1: linear, 2: 3x² − 2x³, 3: half a cosine, 4: sudden, 5: x², 6: x³, 7: √x, 8: sine; 9 and 10: 1 and 0 over ramp and rest.";
    ramp_ahead = 0.0, "Steps by which the ramp is ahead.";
    unbounded_ramp = 0.0, "Flag: the ramp goes on beyond 1.";
    wall_speed = 0.0, "Speed of the top wall.";
    wall_drift = 1.0, "Factor on the movement of the top wall.";
    wall_per_step = 0.0, "Flag: it moves by its speed in every step.";
    wall_start = 0.0, "Height of its start above cylinder 1 at rest.";
    wall_ahead = 0.0, "Steps by which it is ahead of the bodies.";
    wall_from_start = 0.0, "Flag: it starts above the stack as it was before gravity.";
    wall_from_run = 0.0, "Flag: it has moved since the beginning of the run.";
    wall_presses = 1.0, "Factor on its force on cylinder 1.";
    clears_springs = 0.0, "Flag: the springs are cleared when it starts.";
    clears_velocities = 0.0, "Flag: the bodies are stopped when it starts.";
    euler = 0.0, "Flag: positions move with the velocities of before the kick.";
    mean_velocity = 0.0, "Flag: positions move with the mean of both velocities.";
    accelerates = 0.0, "Flag: positions move on by a dt²/2 in addition.";
    half_kick = 0.0, "Flag: the first kick is a half.";
    kept_forces = 0.0, "Part of the forces of the step before that is left in those of a step.";
    kept_torques = 0.0, "The same of the torques.";
    old_forces = 0.0, "Flag: bodies are moved by the forces of the step before.";
    damping = 0.0, "Part of the velocities that is lost in every step.";
    damping_rate = 0.0, "Part of the velocities that is lost in a unit of time.";
    spin_damping_rate = 0.0, "The same of the spins.";
    local_damping = 0.0, "Part of the force that opposes the velocity (Cundall).";
    damps_rest = 0.0, "Flag: that of a body at rest counts as if it moved in the positive direction.";
    twice_at_rows = 0.0, "Flag: the forces are computed twice at the steps of rows, and the springs grow twice.";
    fixed_top = 0.0, "Flag: cylinder 1 cannot move sideways.";
    no_spin = 0.0, "Flag: the cylinders do not turn.";
    one_spin = 0.0, "Flag: only cylinder 1 turns.";
    single_precision = 0.0, "Flag: positions and velocities are kept in single precision.";
    spread = 0.0, "Distance by which the bottom cylinders lie too far apart at first.";
    lift = 0.0, "Height by which cylinder 1 lies too high at first.";
}

/// Steps of a preparation that nobody waits for.
const MOST_STEPS: f64 = 2e4;

/// Bodies of each contact, in the order in which they are evaluated: pairs, then the floor, then the top wall.
pub(super) const CONTACTS: [(usize, Option<usize>); 9] = [
    (1, Some(0)),
    (2, Some(0)),
    (2, Some(1)),
    (0, None),
    (1, None),
    (2, None),
    (0, None),
    (1, None),
    (2, None),
];
pub(super) const PAIRS: std::ops::Range<usize> = 0..3;
pub(super) const FLOOR: std::ops::Range<usize> = 3..6;
pub(super) const WALL: std::ops::Range<usize> = 6..9;

/// Numbers of a body and of a contact in a row.
pub(super) const OF_BODY: [&str; 9] = ["x", "y", "theta", "vx", "vy", "spin", "fx", "fy", "torque"];
pub(super) const PER_CONTACT: usize = 5;
pub(super) const WIDTH: usize = 3 * OF_BODY.len() + CONTACTS.len() * PER_CONTACT;

/// All numbers of a step: of the bodies, then of every contact its normal and tangential force, the force of its normal
/// spring, its overlap, and the length of its tangential spring.
pub(super) type Row = [f64; WIDTH];

#[derive(Debug, Clone, Copy, Default)]
struct Body {
    at: [f64; 3],
    speed: [f64; 3],
    load: [f64; 3],
    before: [f64; 3],
}

#[derive(Debug, Clone, Copy, Default)]
struct State {
    spring: f64,
    normal: [f64; 2],
    force: [f64; 2],
    elastic: f64,
    overlap: f64,
}

/// What is run.
#[derive(Debug, Clone)]
enum Plan {
    Stack(Schedule),
    Motion(ContactTest),
}

/// A run that may be wrong.
#[derive(Debug, Clone)]
pub(super) struct Twin {
    /// The law of each of [`CONTACTS`].
    pub contacts: [OfContact; 9],
    /// Everything else.
    pub run: OfRun,
    /// The conventions of the law.
    pub convention: ContactConvention,
    plan: Plan,
    bodies: Vec<Body>,
    states: [State; 9],
    wall: f64,
    wall_speed: f64,
}

fn contact(law: &ContactLaw, friction: f64) -> OfContact {
    OfContact {
        tangential_stiffness: law.tangential_stiffness,
        damping_normal: law.damping_normal,
        damping_tangential: law.damping_tangential,
        friction,
        ..OfContact::RIGHT
    }
}

impl Twin {
    fn new(
        plan: Plan,
        (convention, stiffness_ratio): (ContactConvention, f64),
        [pairs, floor]: [f64; 2],
    ) -> Self {
        let law = convention.law(stiffness_ratio);
        let friction = |index: usize| match index {
            0..3 => pairs,
            3..6 => floor,
            _ => 0.0,
        };
        Self {
            contacts: std::array::from_fn(|index| contact(&law, friction(index))),
            run: OfRun {
                moment_of_inertia: convention.moment_of_inertia,
                ..OfRun::RIGHT
            },
            convention,
            plan,
            bodies: Vec::new(),
            states: [State::default(); 9],
            wall: f64::INFINITY,
            wall_speed: 0.0,
        }
    }

    /// The stack of `case`, without a fault.
    pub fn of_stack(case: &Case) -> Self {
        let schedule = case.protocol.schedule();
        let stack = &case.stack;
        let law = (case.convention, stack.stiffness_ratio);
        let frictions = [stack.cylinder_friction, stack.floor_friction];
        let mut twin = Self::new(Plan::Stack(schedule), law, frictions);
        let steps = match schedule.preparation {
            PreparationSteps::GravityRamp { ramp, rest } => [ramp, rest],
            PreparationSteps::SideWalls(_) => [0, 0],
        };
        [twin.run.ramp_steps, twin.run.rest_steps] = steps.map(|steps| steps as f64);
        twin.run.time_step = case.protocol.time_step;
        twin.run.gravity = stack.epsilon();
        twin.run.wall_speed = case.protocol.wall_speed;
        twin
    }

    /// A micro-test, without a fault.
    pub fn of_motion(test: &ContactTest) -> Self {
        let law = (test.convention, test.stiffness_ratio);
        let frictions = [test.cylinder_friction, test.floor_friction];
        let mut twin = Self::new(Plan::Motion(*test), law, frictions);
        twin.run.time_step = test.time_step;
        twin.run.wall_speed = test.wall_speed;
        twin
    }

    /// Runs, and gives every step of the compression or of the motion to `watch`, until that has enough.
    pub fn run(&mut self, mut watch: impl FnMut(u64, &Row) -> bool) {
        match self.plan.clone() {
            Plan::Stack(schedule) => {
                if self.run.ramp_steps + self.run.rest_steps > MOST_STEPS {
                    return;
                }
                self.prepare();
                self.start_wall();
                for step in 0..=schedule.compression_steps {
                    self.forces();
                    if self.run.twice_at_rows != 0.0 && schedule.row_from(step) == Some(step) {
                        self.forces();
                    }
                    if !watch(step, &self.row()) {
                        return;
                    }
                    self.advance();
                }
            }
            Plan::Motion(test) => {
                let start = test.initial_motions;
                self.bodies = start
                    .map(|own| Body {
                        at: [own.x, own.y, 0.0],
                        speed: [own.vx, own.vy, own.spin],
                        ..Body::default()
                    })
                    .to_vec();
                (self.wall, self.wall_speed) = (test.wall_height, self.run.wall_speed);
                for step in 0..=test.steps {
                    self.forces();
                    if !watch(step, &self.row()) {
                        return;
                    }
                    self.advance();
                }
            }
        }
    }

    fn prepare(&mut self) {
        let root = 3f64.sqrt();
        let apart = 1.0 + 0.5 * self.run.spread;
        let places = [
            [0.0, 1.0 + root + self.run.lift],
            [apart, 1.0],
            [-apart, 1.0],
        ];
        self.bodies = places
            .map(|[x, y]| Body {
                at: [x, y, 0.0],
                ..Body::default()
            })
            .to_vec();
        let asked = self.run.gravity;
        let steps = (self.run.ramp_steps + self.run.rest_steps) as u64;
        for step in 0..steps {
            self.run.gravity = asked * self.ramp(step);
            self.forces();
            self.advance();
        }
        self.run.gravity = asked * self.run.gravity_in_compression;
    }

    /// The part of gravity that is there at a step.
    fn ramp(&self, step: u64) -> f64 {
        let whole = if self.run.ramp_shape > 8.0 {
            self.run.rest_steps
        } else {
            0.0
        };
        let (step, steps) = (
            step as f64 + self.run.ramp_ahead,
            self.run.ramp_steps + whole,
        );
        let x = match self.run.unbounded_ramp {
            0.0 => (step / steps.max(f64::MIN_POSITIVE)).min(1.0),
            _ => step / steps,
        };
        match self.run.ramp_shape as u8 {
            0 if self.run.unbounded_ramp == 0.0 && steps.fract() == 0.0 && step >= 0.0 => {
                smooth_step(step as u64, steps as u64)
            }
            0 | 10 => x * x * x * (10.0 - 15.0 * x + 6.0 * (x * x)),
            1 | 9 => x,
            2 => x * x * (3.0 - 2.0 * x),
            3 => 0.5 * (1.0 - libm::cos(std::f64::consts::PI * x)),
            4 => 1.0,
            5 => x * x,
            6 => x * x * x,
            7 => x.sqrt(),
            _ => libm::sin(0.5 * std::f64::consts::PI * x),
        }
    }

    fn start_wall(&mut self) {
        self.wall = match self.run.wall_from_start {
            0.0 => self.bodies[0].at[1] + 1.0,
            _ => 2.0 + 3f64.sqrt(),
        } + self.run.wall_start;
        let early = self.run.wall_from_run * (self.run.ramp_steps + self.run.rest_steps);
        self.wall -= early * self.run.wall_speed * self.run.time_step;
        self.wall_speed = self.run.wall_speed;
        if self.run.clears_springs != 0.0 {
            self.states = Default::default();
        }
        if self.run.clears_velocities != 0.0 {
            self.bodies
                .iter_mut()
                .for_each(|body| body.speed = [0.0; 3]);
        }
    }

    fn row(&self) -> Row {
        let mut row = [0.0; WIDTH];
        for (body, cells) in self.bodies.iter().zip(row.chunks_mut(9)) {
            let numbers = body.at.iter().chain(&body.speed).chain(&body.load);
            cells
                .iter_mut()
                .zip(numbers)
                .for_each(|(cell, own)| *cell = *own);
        }
        for (own, cells) in self.states.iter().zip(row[27..].chunks_mut(PER_CONTACT)) {
            let [normal, tangential] = own.force;
            cells.copy_from_slice(&[normal, tangential, own.elastic, own.overlap, own.spring]);
        }
        row
    }

    fn forces(&mut self) {
        let run = self.run;
        let weights = [run.weight_1, run.weight_2, run.weight_3];
        for (body, weight) in self.bodies.iter_mut().zip(weights) {
            let weight = run.weight * weight * run.gravity;
            body.before = body.load;
            let [x, y, turn] = body.before;
            body.load = [
                run.tilt * run.gravity + run.kept_forces * x,
                run.kept_forces * y - weight,
                run.kept_torques * turn,
            ];
        }
        let count = self.bodies.len();
        for (index, (one, two)) in CONTACTS.into_iter().enumerate() {
            if one < count && two.is_none_or(|two| two < count) {
                self.contact(index, one, two);
            }
        }
    }

    fn contact(&mut self, index: usize, one: usize, two: Option<usize>) {
        let law = self.contacts[index];
        let radius = self.run.radius;
        let first = self.bodies[one];
        let ahead = self.run.wall_ahead * self.wall_speed * self.run.time_step;
        let (normal, distance, other) = match two {
            Some(two) => {
                let second = &self.bodies[two];
                let apart = [0, 1].map(|axis| first.at[axis] - second.at[axis]);
                let distance = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
                let length = match law.by_diameter {
                    0.0 => distance,
                    _ => 2.0 * radius,
                };
                let normal = [apart[0] / length, apart[1] / length];
                (normal, distance - radius, second.speed)
            }
            None if FLOOR.contains(&index) => ([0.0, 1.0], first.at[1], [0.0; 3]),
            None => {
                let distance = self.wall - ahead - first.at[1];
                ([0.0, -1.0], distance, [0.0, -self.wall_speed, 0.0])
            }
        };
        let overlap = radius - distance - law.gap;
        let state = &mut self.states[index];
        if overlap.is_nan() || overlap <= 0.0 && law.pulls * state.overlap == 0.0 {
            let spring = state.spring * law.keeps_open_spring;
            *state = State {
                spring,
                normal,
                ..State::default()
            };
            return;
        }
        let along = |speed: [f64; 3]| normal[0] * speed[0] + normal[1] * speed[1];
        let across = |speed: [f64; 3]| normal[0] * speed[1] - normal[1] * speed[0];
        let separation = along(first.speed) - law.separation_two * along(other);
        let sliding = law.sliding_one * across(first.speed) - law.sliding_two * across(other);
        let spin = law.spin_one * first.speed[2] + law.spin_two * other[2];
        let arms = match two {
            Some(_) => self.convention.arms.pair,
            None => self.convention.arms.floor,
        };
        let lever = radius * law.lever;
        let touching = Touching {
            overlap,
            separation,
            sliding,
            turning: (lever + arms.kinematic * overlap) * spin,
            normal,
            time_step: self.run.time_step,
            weight: self.run.gravity,
        };
        touching.press(&law, &self.convention, state);
        let [pressing, tangential] = state.force.map(|force| force * law.exists);
        state.force = [pressing, tangential];
        let arm = lever + arms.torque * overlap;
        let damping = pressing - state.elastic;
        let mut act = |body: usize, sign: f64, factors: [f64; 5]| {
            let [pressed, sheared, turned, damped, sprung] = factors;
            let n = sign
                * pressed
                * (pressing + (damped - 1.0) * damping + (sprung - 1.0) * state.elastic);
            let t = sign * sheared * law.tangent * tangential;
            let rolls = self.bodies[body].speed[2];
            let load = &mut self.bodies[body].load;
            load[0] += n * normal[0] - t * normal[1];
            load[1] += n * normal[1] + t * normal[0];
            load[2] -= turned * arm * tangential;
            if law.rolling != 0.0 && rolls != 0.0 {
                load[2] -= law.rolling * pressing * rolls.signum();
            }
        };
        let pressed = if WALL.contains(&index) {
            self.run.wall_presses
        } else {
            1.0
        };
        act(
            one,
            1.0,
            [
                pressed * law.normal_one,
                law.tangential_one,
                law.torque_one,
                law.damping_one,
                law.spring_one,
            ],
        );
        if let Some(two) = two {
            act(
                two,
                -1.0,
                [
                    law.normal_two,
                    law.tangential_two,
                    law.torque_two,
                    law.damping_two,
                    law.spring_two,
                ],
            );
        }
    }

    fn advance(&mut self) {
        let run = self.run;
        let dt = run.time_step;
        let kick = if run.half_kick != 0.0 { 0.5 * dt } else { dt };
        self.run.half_kick = 0.0;
        let push = [run.push_x, run.push_y, run.push_spin];
        for index in 0..self.bodies.len() {
            let mass = if index == 0 {
                run.mass * run.mass_1
            } else {
                run.mass
            };
            let inertia = [mass, mass, run.moment_of_inertia];
            let body = &mut self.bodies[index];
            let turns = run.no_spin == 0.0 && (run.one_spin == 0.0 || index == 0);
            for axis in 0..3 {
                let old = body.speed[axis];
                let mut force = if run.old_forces != 0.0 {
                    body.before[axis]
                } else {
                    body.load[axis]
                };
                force *= push[axis];
                if run.local_damping != 0.0 && (old != 0.0 || run.damps_rest != 0.0) {
                    force -= run.local_damping * force.abs() * old.signum();
                }
                let rate = if axis == 2 {
                    run.spin_damping_rate
                } else {
                    run.damping_rate
                };
                let kept = (1.0 - run.damping) * (1.0 - rate * dt);
                let mut new = (old + force / inertia[axis] * kick) * kept;
                if axis == 2 && !turns || axis == 0 && index == 0 && run.fixed_top != 0.0 {
                    new = 0.0;
                }
                let moves = if run.euler != 0.0 {
                    old
                } else if run.mean_velocity != 0.0 {
                    0.5 * (old + new)
                } else {
                    new
                };
                let extra = 0.5 * run.accelerates * force / inertia[axis] * dt * dt;
                body.speed[axis] = new;
                body.at[axis] += moves * run.drift * dt + extra;
                if run.single_precision != 0.0 {
                    body.at[axis] = f64::from(body.at[axis] as f32);
                    body.speed[axis] = f64::from(body.speed[axis] as f32);
                }
            }
        }
        let moved = if run.wall_per_step != 0.0 { 1.0 } else { dt };
        self.wall -= self.wall_speed * moved * run.wall_drift;
    }
}

/// A contact that is closed, at one moment.
struct Touching {
    overlap: f64,
    separation: f64,
    sliding: f64,
    /// Velocity of the surfaces by the spins.
    turning: f64,
    normal: [f64; 2],
    time_step: f64,
    weight: f64,
}

impl Touching {
    /// The forces, and the spring as they leave it.
    fn press(&self, law: &OfContact, convention: &ContactConvention, state: &mut State) {
        let overlap = self.overlap;
        let powered = if law.exponent == 1.0 {
            overlap
        } else {
            libm::pow(overlap.max(0.0), law.exponent)
        };
        let elastic = law.normal_stiffness * powered;
        let damped = match law.damping_exponent {
            0.0 => law.damping_normal * self.separation,
            power => law.damping_normal * self.separation * libm::pow(overlap.max(0.0), power),
        };
        let is_damped = law.damps_approach == 0.0 || self.separation < 0.0;
        let mut pressing = if is_damped { elastic - damped } else { elastic };
        if convention.tensile_force == TensileForce::NeverPulls {
            pressing = pressing.max(0.0);
        }
        let limit = law.friction
            * match law.limit_before {
                0.0 => self.limited(law, elastic, pressing),
                _ => state.force[0].abs(),
            };
        let velocity = self.sliding - law.spin_in_damping * self.turning;
        let stretching = self.sliding - law.spin_in_spring * self.turning;
        let old = state.spring * law.spring_kept * self.transport(convention, state.normal);
        let stretched = old + law.spring_growth * stretching * self.time_step;
        let spring = -law.tangential_stiffness
            * if law.stale_spring != 0.0 {
                old
            } else {
                stretched
            };
        let damping = law.damping_tangential * velocity;
        let operand = match convention.coulomb_operand {
            CoulombOperand::SpringAndDamping => spring - damping,
            CoulombOperand::Spring => spring,
        };
        let (force, length) = if law.uncapped_damping != 0.0 {
            let capped = spring.clamp(-limit.abs(), limit.abs());
            let slides = capped != spring;
            let length = if slides {
                self.slid(law, convention, (old, stretched), (capped, 0.0))
            } else {
                stretched
            };
            (capped - damping, length)
        } else if operand.abs() < limit || law.caps_of * operand < 0.0 {
            (spring - damping, stretched)
        } else {
            let sign = match law.one_sided {
                0.0 => 1f64.copysign(operand),
                sign => sign,
            };
            let at_limit = sign * limit * law.sliding_friction;
            let counted = match convention.coulomb_operand {
                CoulombOperand::SpringAndDamping => damping,
                CoulombOperand::Spring => 0.0,
            };
            let length = self.slid(law, convention, (old, stretched), (at_limit, counted));
            (at_limit - law.damps_sliding * damping, length)
        };
        *state = State {
            spring: length,
            normal: self.normal,
            force: [pressing, force],
            elastic,
            overlap,
        };
    }

    /// The force that μ is multiplied with.
    fn limited(&self, law: &OfContact, elastic: f64, pressing: f64) -> f64 {
        if law.limit_of_weight != 0.0 {
            self.weight
        } else if law.limit_of_spring != 0.0 {
            elastic
        } else if law.limit_signed != 0.0 {
            pressing.max(0.0)
        } else {
            pressing.abs()
        }
    }

    /// The length of the spring of a contact that slides.
    fn slid(
        &self,
        law: &OfContact,
        convention: &ContactConvention,
        (old, stretched): (f64, f64),
        (at_limit, damping): (f64, f64),
    ) -> f64 {
        if law.keeps_sliding_spring != 0.0 {
            stretched
        } else if law.clears_sliding_spring != 0.0 {
            0.0
        } else if convention.sliding_spring == SlidingSpring::FollowsLimit {
            -(at_limit + damping) / law.tangential_stiffness
        } else {
            old
        }
    }

    fn transport(&self, convention: &ContactConvention, before: [f64; 2]) -> f64 {
        let [x, y] = self.normal;
        let cosine = before[0] * x + before[1] * y;
        let sine = before[0] * y - before[1] * x;
        match convention.history_update {
            HistoryUpdate::Rotated => 1.0,
            HistoryUpdate::Projected => cosine,
            HistoryUpdate::Linearised => cosine + sine * sine,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::evidence::Evidence;
    use super::super::{ask_native, case};
    use super::*;
    use crate::dem::compress_stack;
    use crate::model::{Arms, ContactArms};

    /// The paper's convention, and one that differs from it in every way.
    fn conventions() -> [ContactConvention; 2] {
        let mut arms = Arms::PAPER;
        (arms.pair, arms.floor) = (ContactArms::reciprocal(-0.5), ContactArms::reciprocal(-1.0));
        let other = ContactConvention {
            coulomb_operand: CoulombOperand::Spring,
            sliding_spring: SlidingSpring::FollowsLimit,
            history_update: HistoryUpdate::Projected,
            tensile_force: TensileForce::NeverPulls,
            moment_of_inertia: 0.4,
            ..ContactConvention::with_arms(arms)
        };
        [ContactConvention::PAPER, other]
    }

    #[test]
    fn without_a_fault_it_is_the_native_dem() {
        for convention in conventions() {
            let case = case(convention);
            let series = compress_stack(&case, || true).unwrap();
            let stack = Evidence::of_stack(&series, &case, convention, true);
            assert!(stack.before < 1e-10, "{}", stack.before);
            for answer in ask_native(convention) {
                let motion = Evidence::of_motion(&answer, convention);
                assert!(motion.before < 1e-10, "{}: {}", answer.test, motion.before);
            }
        }
    }
}
