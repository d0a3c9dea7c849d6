//! The equations of motion of an impact, written a second time.

use std::f64::consts::PI;
use tristack::model::{DampingGrowth, Impact, ImpactTarget, TensileForce};

/// The equations of motion of one impact.
pub struct Equations {
    stiffness: f64,
    power: f64,
    damping: f64,
    damping_power: f64,
    pub never_pulls: bool,
    impact: Impact,
}

/// Overlap, its rate, angular momentum, spin and time.
pub type State = [f64; 5];

impl Equations {
    pub fn of(impact: &Impact) -> Self {
        let (convention, law) = (&impact.convention, &impact.convention.law);
        let power = law.power.value();
        let stiffness = match impact.target {
            ImpactTarget::Pair => 1.0,
            ImpactTarget::Floor => law.floor_ratio,
        };
        // At an overlap of r the damping ratio of a unit mass is that of the declared restitution.
        let log = convention.restitution.ln();
        let ratio = -log / (PI * PI + log * log).sqrt();
        let damping = 2.0 * ratio * ((power + 1.0) / 2.0 * stiffness).sqrt();
        Self {
            stiffness,
            power,
            damping,
            damping_power: match law.damping {
                DampingGrowth::ConstantRatio => 0.5 * (power - 1.0),
                DampingGrowth::Viscoelastic => power - 1.0,
            },
            never_pulls: convention.tensile_force == TensileForce::NeverPulls,
            impact: *impact,
        }
    }

    fn force(&self, [overlap, rate, ..]: &State) -> f64 {
        let overlap = overlap.max(0.0);
        self.stiffness * overlap.powf(self.power)
            + self.damping * overlap.powf(self.damping_power) * rate
    }

    /// Derivatives with respect to time. `friction` also turns the line of centres of a pair.
    fn rates(&self, state: &State, friction: f64) -> State {
        let force = match self.force(state) {
            pulling if self.never_pulls => pulling.max(0.0),
            force => force,
        };
        let [overlap, rate, momentum, ..] = *state;
        let limit = friction * force.abs();
        let arms = &self.impact.convention.arms;
        let inertia = self.impact.convention.moment_of_inertia;
        match self.impact.target {
            ImpactTarget::Floor => {
                let torque = (1.0 + arms.floor.torque * overlap) * limit;
                [rate, -force, limit, torque / inertia, 1.0]
            }
            ImpactTarget::Pair => {
                let apart = 2.0 - overlap;
                let torque = (1.0 + arms.pair.torque * overlap) * limit;
                let centrifugal = momentum * momentum / apart.powi(3);
                let acceleration = -2.0 * force - centrifugal;
                let spin = torque / inertia;
                [rate, acceleration, 2.0 * apart * limit, spin, 1.0]
            }
        }
    }

    /// One step of Runge's and Kutta's method. Over x, the fourth root of the overlap, every law is smooth where the bodies
    /// touch; over the time where they turn round.
    fn step(&self, from: &State, x: Option<f64>, by: f64, friction: f64) -> State {
        let rates = |state: State, x: Option<f64>| {
            let Some(x) = x else {
                return self.rates(&state, friction);
            };
            let overlap = x.powi(4);
            let state = [overlap, state[1], state[2], state[3], state[4]];
            let per_x = 4.0 * x.powi(3) / state[1];
            self.rates(&state, friction).map(|rate| rate * per_x)
        };
        let moved = |rate: &State, by: f64| std::array::from_fn(|i| from[i] + by * rate[i]);
        let at = |part: f64| x.map(|x| x + part * by);
        let first = rates(*from, at(0.0));
        let second = rates(moved(&first, 0.5 * by), at(0.5));
        let third = rates(moved(&second, 0.5 * by), at(0.5));
        let fourth = rates(moved(&third, by), at(1.0));
        std::array::from_fn(|i| {
            from[i] + by / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i])
        })
    }

    /// Just after `event` has become 0 in the step from `state`.
    fn zero(&self, state: &State, by: f64, friction: f64, event: impl Fn(&State) -> f64) -> State {
        let (mut low, mut high) = (0.0, by);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match event(&self.step(state, None, middle, friction)) > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        self.step(state, None, high, friction)
    }

    /// The deepest state, and the one in which the force ends.
    pub fn solve(&self, friction: f64) -> [State; 2] {
        const STEPS: u32 = 20_000;
        let speed = self.impact.approach_speed;
        let mass = match self.impact.target {
            ImpactTarget::Floor => 1.0,
            ImpactTarget::Pair => 0.5,
        };
        let energy = 0.5 * mass * speed * speed;
        let depth = ((self.power + 1.0) * energy / self.stiffness).powf(1.0 / (self.power + 1.0));
        let shallow = (0.01 * depth).powf(0.25);
        let by = shallow / f64::from(STEPS);
        let mut state = [0.0, speed, 0.0, 0.0, 0.0];
        for step in 0..STEPS {
            let x = by * f64::from(step);
            state = self.step(&state, Some(x), by, friction);
        }
        let by = depth / speed / f64::from(STEPS);
        let mut deepest = state;
        loop {
            let next = self.step(&state, None, by, friction);
            if state[1] > 0.0 && next[1] <= 0.0 {
                deepest = self.zero(&state, by, friction, |own| own[1]);
            }
            if self.never_pulls && self.force(&next) <= 0.0 {
                let end = self.zero(&state, by, friction, |own| self.force(own));
                return [deepest, end];
            }
            if next[1] < 0.0 && self.force(&state) > 0.0 && self.force(&next) <= 0.0 {
                // The limit μ |N| has a kink there.
                state = self.zero(&state, by, friction, |own| self.force(own));
                continue;
            }
            if next[1] < 0.0 && next[0] <= shallow.powi(4) {
                state = self.zero(&state, by, friction, |own| own[0] - shallow.powi(4));
                break;
            }
            state = next;
        }
        let by = -shallow / f64::from(STEPS);
        for step in 0..STEPS {
            let x = shallow + by * f64::from(step);
            state = self.step(&state, Some(x), by, friction);
        }
        [deepest, state]
    }
}
