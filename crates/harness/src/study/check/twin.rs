//! A DEM of the stack and of the micro-tests in which every number and every part of the law can be wrong.
//!
//! Without a fault it equals the native DEM, to rounding. Whatever can be wrong is a field of [`OfContact`] or
//! [`OfRun`], which mistakes.toml sets by name.

use super::numbers::{OfContact, OfRun};
use super::touching::{State, Touching};
use crate::model::{
    Case, ContactConvention, ContactLaw, ContactTest, PreparationSteps, Schedule, smooth_step,
};
use crate::series::BodyRow;

/// Longest preparation that is run, in units of the one that the task asks for: a wrong number of steps may be a
/// thousand times the right one.
const LONGEST_PREPARATION: f64 = 10.0;

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
pub(super) const PER_CONTACT: usize = 6;
pub(super) const WIDTH: usize = 3 * OF_BODY.len() + CONTACTS.len() * PER_CONTACT;

/// All numbers of a step: those of the bodies, then of every contact its normal and tangential force, the force of
/// its normal spring, its overlap, the length of its tangential spring, and its tangential force before it is
/// limited.
pub(super) type Row = [f64; WIDTH];

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Body {
    pub at: [f64; 3],
    pub speed: [f64; 3],
    load: [f64; 3],
    before: [f64; 3],
}

/// A body with this position and these velocities, the last of which is its spin.
fn placed([x, y]: [f64; 2], speed: [f64; 3]) -> Body {
    Body {
        at: [x, y, 0.0],
        speed,
        ..Body::default()
    }
}

/// What the twin runs.
#[derive(Debug, Clone)]
enum Plan {
    Stack(Schedule),
    Motion(ContactTest),
}

/// Which contacts have forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lists {
    /// All that are closed.
    None,
    /// Those of them that were closed when they were listed.
    Kept,
    /// All that are closed, and these are listed.
    Renewed,
}

/// A run that may have faults.
#[derive(Debug, Clone)]
pub(super) struct Twin {
    /// The law of each of [`CONTACTS`].
    pub contacts: [OfContact; 9],
    /// Everything else.
    pub run: OfRun,
    /// The conventions of the law.
    pub convention: ContactConvention,
    /// How the coefficients of pairs and of walls depend on the overlap, with 1 for each.
    units: [ContactLaw; 2],
    plan: Plan,
    pub bodies: Vec<Body>,
    pub states: [State; 9],
    /// Which contacts have forces.
    pub lists: Lists,
    /// Whether lists are those of pairs, so that floor and wall need none.
    pub lists_pairs_alone: bool,
    listed: [bool; 9],
    /// The velocities of all bodies that contacts take for those of their second body; none where these are the present ones.
    pub seen_speeds: Vec<[f64; 3]>,
    /// Contacts whose forces are not computed in the next step.
    pub left_out: &'static [usize],
    /// The tangential spring that all contacts of a kind share, if they do.
    shared: [[f64; 2]; 3],
    pub wall: f64,
    wall_speed: f64,
}

fn contact(law: &ContactLaw, friction: f64) -> OfContact {
    OfContact {
        normal_stiffness: law.normal_stiffness,
        tangential_stiffness: law.tangential_stiffness,
        damping_normal: law.damping_normal,
        damping_tangential: law.damping_tangential,
        friction,
        ..OfContact::RIGHT
    }
}

/// Returns the steps of the gravity ramp and of the rest after it.
fn preparation_steps(schedule: &Schedule) -> [f64; 2] {
    match schedule.preparation {
        PreparationSteps::GravityRamp { ramp, rest } => [ramp as f64, rest as f64],
        PreparationSteps::SideWalls(_) | PreparationSteps::Rigid => [0.0; 2],
    }
}

impl Twin {
    /// Whether it runs a micro-test.
    pub fn is_motion(&self) -> bool {
        matches!(self.plan, Plan::Motion(_))
    }

    fn new(
        plan: Plan,
        (convention, stiffness_ratio): (ContactConvention, f64),
        [pairs, floor]: [f64; 2],
    ) -> Self {
        let laws = [
            convention.law(stiffness_ratio),
            convention.wall_law(stiffness_ratio),
        ];
        let of_contact = |index: usize| match index {
            0..3 => contact(&laws[0], pairs),
            3..6 => contact(&laws[1], floor),
            _ => contact(&laws[1], 0.0),
        };
        Self {
            contacts: std::array::from_fn(of_contact),
            units: laws.map(|law| law.map(|_| 1.0)),
            run: OfRun {
                moment_of_inertia: convention.moment_of_inertia,
                ..OfRun::RIGHT
            },
            convention,
            plan,
            bodies: Vec::new(),
            states: [State::default(); 9],
            lists: Lists::None,
            lists_pairs_alone: false,
            seen_speeds: Vec::new(),
            listed: [false; 9],
            left_out: &[],
            shared: [[0.0; 2]; 3],
            wall: f64::INFINITY,
            wall_speed: 0.0,
        }
    }

    /// Returns the twin of the stack of `case`, without a fault.
    pub fn of_stack(case: &Case) -> Self {
        let schedule = case.protocol.schedule();
        let stack = &case.stack;
        let law = (case.convention, stack.stiffness_ratio);
        let frictions = [stack.cylinder_friction, stack.floor_friction];
        let mut twin = Self::new(Plan::Stack(schedule), law, frictions);
        [twin.run.ramp_steps, twin.run.rest_steps] = preparation_steps(&schedule);
        twin.run.time_step = case.protocol.time_step;
        twin.run.gravity = stack.epsilon();
        twin.run.wall_speed = case.protocol.wall_speed;
        twin
    }

    /// Returns the twin of a micro-test, without a fault.
    pub fn of_motion(test: &ContactTest) -> Self {
        let law = (test.convention, test.stiffness_ratio);
        let frictions = [test.cylinder_friction, test.floor_friction];
        let mut twin = Self::new(Plan::Motion(*test), law, frictions);
        twin.run.time_step = test.time_step;
        twin.run.wall_speed = test.wall_speed;
        twin
    }

    /// Runs, and passes every step of the compression or of the motion to `watch`, until that returns `false`.
    pub fn run(&mut self, watch: impl FnMut(u64, &Row) -> bool) {
        self.run_interrupted(|_, _| (), watch);
    }

    /// Runs in the same way; `interrupt` may change the twin before the forces of each step, which is counted from the
    /// beginning of the run, its preparation included.
    pub fn run_interrupted(
        &mut self,
        mut interrupt: impl FnMut(&mut Self, u64),
        watch: impl FnMut(u64, &Row) -> bool,
    ) {
        if self.start(&mut interrupt) {
            self.go_on(0, interrupt, watch);
        }
    }

    /// The twin before the forces of step 0.
    pub fn started(&self) -> Self {
        let mut own = self.clone();
        own.start(&mut |_, _| ());
        own
    }

    /// Goes as far as step 0; returns `false` if that takes too long.
    fn start(&mut self, interrupt: &mut impl FnMut(&mut Self, u64)) -> bool {
        match self.plan.clone() {
            Plan::Stack(schedule) => {
                let [ramp, rest] = preparation_steps(&schedule);
                let most = LONGEST_PREPARATION * (ramp + rest);
                if self.run.ramp_steps + self.run.rest_steps > most {
                    return false;
                }
                self.prepare(interrupt);
                self.start_wall();
            }
            Plan::Motion(test) => {
                let start = test.initial_motions;
                self.bodies = start
                    .map(|own| placed([own.x, own.y], [own.vx, own.vy, own.spin]))
                    .to_vec();
                (self.wall, self.wall_speed) = (test.wall_height, self.run.wall_speed);
            }
        }
        true
    }

    /// Goes on with the compression or the motion from a step whose forces are not computed yet.
    pub fn go_on(
        &mut self,
        from: u64,
        mut interrupt: impl FnMut(&mut Self, u64),
        mut watch: impl FnMut(u64, &Row) -> bool,
    ) {
        let (plan, before) = (self.plan.clone(), self.preparation());
        let last = match &plan {
            Plan::Stack(schedule) => schedule.compression_steps,
            Plan::Motion(test) => test.steps,
        };
        for step in from..=last {
            if let Plan::Motion(ContactTest {
                drive: Some(drive),
                initial_motions: start,
                time_step,
                ..
            }) = &plan
            {
                let [[x, y], [vx, vy]] = drive.motion_at(step, *time_step);
                self.bodies = vec![
                    placed([start[0].x + x, start[0].y + y], [vx, vy, 0.0]),
                    placed([start[1].x, start[1].y], [0.0; 3]),
                ];
            }
            interrupt(self, before + step);
            self.forces();
            if let Plan::Stack(schedule) = &plan
                && self.run.twice_at_rows != 0.0
                && schedule.row_from(step) == Some(step)
            {
                self.forces();
            }
            if !watch(step, &self.row()) {
                return;
            }
            self.advance();
        }
    }

    /// The number of steps before step 0.
    pub fn preparation(&self) -> u64 {
        match self.plan {
            Plan::Stack(_) => (self.run.ramp_steps + self.run.rest_steps) as u64,
            Plan::Motion(_) => 0,
        }
    }

    /// Computes the forces of the law at the positions and velocities that a code has written, and updates the
    /// springs.
    pub fn compute_forces_at(&mut self, written: &[BodyRow; 2], wall: f64) {
        let bodies = written.iter();
        let bodies =
            bodies.map(|own| placed(own.position, [own.velocity[0], own.velocity[1], own.spin]));
        self.bodies = bodies.collect();
        (self.wall, self.wall_speed) = (wall, self.run.wall_speed);
        self.forces();
    }

    /// Sets the length of the tangential springs of the first body from the force that a code has written, where the
    /// contact sticks.
    pub fn follow(&mut self, written: &BodyRow) {
        // The first body of a pair is the second of its contact.
        for (contact, sign) in [(0, -1.0), (FLOOR.start, 1.0)] {
            let (state, law) = (&mut self.states[contact], &self.contacts[contact]);
            let (memory, [normal, tangential]) = (state.memory, state.force);
            let pressing = normal - state.sheared[1];
            let ([x, y], [along_x, along_y]) = (state.normal, written.force);
            let found = sign * (x * along_y - y * along_x);
            let sticks = tangential == state.trial && found.abs() < law.friction * pressing.abs();
            if state.overlap > 0.0 && sticks {
                let longer = (tangential - found) / (law.tangential_stiffness * memory.growth);
                state.spring[0] += longer * memory.unit;
            }
        }
    }

    fn prepare(&mut self, interrupt: &mut impl FnMut(&mut Self, u64)) {
        let root = 3f64.sqrt();
        let places = [[0.0, 1.0 + root], [1.0, 1.0], [-1.0, 1.0]];
        self.bodies = places.map(|place| placed(place, [0.0; 3])).to_vec();
        let asked = self.run.gravity;
        for step in 0..self.preparation() {
            self.run.gravity = asked * self.ramp(step);
            interrupt(self, step);
            self.forces();
            self.advance();
        }
        self.run.gravity = asked * self.run.gravity_in_compression;
    }

    /// Returns the fraction of gravity at a step of the preparation.
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
        };
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
            let trial = own.trial;
            cells.copy_from_slice(&[
                normal,
                tangential,
                own.elastic,
                own.overlap,
                own.length,
                trial,
            ]);
        }
        row
    }

    pub(super) fn forces(&mut self) {
        let run = &self.run;
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
        let left_out = std::mem::take(&mut self.left_out);
        for (index, (one, two)) in CONTACTS.into_iter().enumerate() {
            if left_out.contains(&index) {
                self.states[index].force = [0.0; 2];
            } else if one < count && two.is_none_or(|two| two < count) {
                let kind = index / 3;
                let shares = self.contacts[index].shares_spring != 0.0;
                if shares {
                    self.states[index].spring = self.shared[kind];
                }
                self.contact(index, one, two);
                if shares {
                    self.shared[kind] = self.states[index].spring;
                }
            }
        }
    }

    /// Leaves the springs at their places in the list of closed contacts, where these are closed now.
    pub fn displace_springs(&mut self) {
        let mut next = self.clone();
        next.forces();
        let closed = |own: &Self| {
            let all = 0..own.states.len();
            let own = all.filter(|index| own.states[*index].overlap > 0.0);
            own.collect::<Vec<_>>()
        };
        let springs = closed(self).into_iter().map(|own| self.states[own].spring);
        let springs: Vec<[f64; 2]> = springs.collect();
        for (place, own) in closed(&next).into_iter().enumerate() {
            self.states[own].spring = springs.get(place).copied().unwrap_or_default();
        }
    }

    fn contact(&mut self, index: usize, one: usize, two: Option<usize>) {
        let Self {
            contacts,
            run,
            convention,
            units,
            bodies,
            states,
            lists,
            lists_pairs_alone,
            listed,
            seen_speeds,
            ..
        } = self;
        let (law, state) = (&contacts[index], &mut states[index]);
        let radius = run.radius;
        let first = bodies[one];
        let ahead = run.wall_ahead * self.wall_speed * run.time_step;
        let (normal, distance, other) = match two {
            Some(two) => {
                let second = &bodies[two];
                let apart = [0, 1].map(|axis| first.at[axis] - second.at[axis]);
                let distance = (apart[0] * apart[0] + apart[1] * apart[1]).sqrt();
                let length = match law.by_diameter {
                    0.0 => distance,
                    _ => 2.0 * radius,
                };
                let normal = [apart[0] / length, apart[1] / length];
                let speed = seen_speeds.get(two).copied().unwrap_or(second.speed);
                (normal, distance - radius, speed)
            }
            None if FLOOR.contains(&index) => ([0.0, 1.0], first.at[1], [0.0; 3]),
            None => {
                let distance = self.wall - ahead - first.at[1];
                ([0.0, -1.0], distance, [0.0, -self.wall_speed, 0.0])
            }
        };
        let overlap = radius - distance;
        if *lists == Lists::Renewed {
            listed[index] = overlap > 0.0;
        }
        let needs_list = *lists != Lists::None && (!*lists_pairs_alone || two.is_some());
        let is_unknown = needs_list && !listed[index];
        let is_open = is_unknown || overlap <= 0.0 && (overlap < 0.0 || law.touches == 0.0);
        if overlap.is_nan() || is_open && law.pulls * state.overlap == 0.0 {
            let is_forgotten = state.overlap == 0.0 && state.spring == [0.0; 2];
            if is_forgotten && law.stretches_open_spring == 0.0 {
                return;
            }
            let ([x, y], [dx, dy]) = (normal, [0, 1].map(|axis| first.speed[axis] - other[axis]));
            let sliding = x * dy - y * dx - radius * (first.speed[2] + other[2]);
            let [along, across] = state.spring;
            let stretched = along + sliding * run.time_step;
            *state = State {
                spring: [
                    along * law.keeps_open_spring + stretched * law.stretches_open_spring,
                    across * law.keeps_open_spring,
                ],
                normal,
                ..State::default()
            };
            return;
        }
        let normal = match law.first_normal != 0.0 && state.overlap > 0.0 {
            true => state.normal,
            false => normal,
        };
        let along = |speed: [f64; 3]| normal[0] * speed[0] + normal[1] * speed[1];
        let across = |speed: [f64; 3]| normal[0] * speed[1] - normal[1] * speed[0];
        let separation = along(first.speed) - law.separation_two * along(other);
        let sliding = law.sliding_one * across(first.speed) - law.sliding_two * across(other);
        let spin = law.spin_one * first.speed[2] + law.spin_two * other[2];
        let (arms, unit) = match two {
            Some(_) => (convention.arms.pair, &units[0]),
            None => (convention.arms.floor, &units[1]),
        };
        let lever = radius * law.lever;
        let touching = Touching {
            overlap,
            separation,
            sliding,
            turning: (lever + arms.kinematic * overlap) * spin,
            normal,
            time_step: run.time_step,
            weight: run.gravity,
        };
        touching.press(law, unit, convention, state);
        let [pressing, tangential] = state.force.map(|force| force * law.exists);
        state.force = [pressing, tangential];
        let arm = lever + arms.torque * overlap;
        let damping = pressing - state.elastic - state.sheared[1];
        let mut act = |body: usize, sign: f64, factors: [f64; 5]| {
            let [pressed, sheared, turned, damped, sprung] = factors;
            let n = sign
                * pressed
                * (pressing + (damped - 1.0) * damping + (sprung - 1.0) * state.elastic);
            let t = sign * sheared * law.tangent * tangential;
            let load = &mut bodies[body].load;
            load[0] += n * normal[0] - t * normal[1];
            load[1] += n * normal[1] + t * normal[0];
            load[2] -= turned * arm * tangential;
        };
        let pressed = if WALL.contains(&index) {
            run.wall_presses
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
        let dt = self.run.time_step;
        let kick = match self.run.half_kick {
            0.0 => dt,
            _ => 0.5 * dt,
        };
        self.run.half_kick = 0.0;
        let run = &self.run;
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
                let mut new = old + force / inertia[axis] * kick;
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
        let times = match run.wall_per_body {
            0.0 => 1.0,
            _ => self.bodies.len() as f64,
        };
        self.wall -= self.wall_speed * moved * run.wall_drift * times;
    }
}

#[cfg(test)]
mod tests {
    use super::super::evidence::Evidence;
    use super::super::{ask_native, case, conventions};
    use crate::dem::compress_stack;

    #[test]
    fn without_a_fault_it_is_the_native_dem() {
        for convention in conventions() {
            let case = case(convention);
            let series = compress_stack(&case, || true).unwrap();
            let stack = Evidence::of_stack(&series, &case, convention, true);
            assert!(stack.before < 1e-10, "{convention:?}: {}", stack.before);
            for answer in ask_native(convention) {
                let motion = Evidence::of_motion(&answer, convention);
                assert!(
                    motion.before < 1e-10,
                    "{convention:?}, {}: {}",
                    answer.test,
                    motion.before
                );
            }
        }
    }
}
