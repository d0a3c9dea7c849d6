//! A contact law of any power, written a second time, with numbers in the place of rules.

use tristack::dem::{Composite, Contact, ContactForce, ContactModel, Counterpart};
use tristack::model::{ContactLaw, ContactTest};

/// What of a law can be changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twin {
    /// K and k_t at an overlap of 1, of pairs and of walls.
    pub stiffness: [[f64; 2]; 2],
    /// η_n and η_t at an overlap of 1, of pairs and of walls.
    pub damping: [[f64; 2]; 2],
    /// Exponent of the normal force.
    pub power: f64,
    /// Exponents of k_t, η_n and η_t.
    pub tangential_exponent: f64,
    /// Exponents of η_n and η_t.
    pub damping_exponents: [f64; 2],
    /// Power of 2/(2 − δ) in k_t, of pairs and of walls.
    pub stiffening: [f64; 2],
    /// Share of the stiffness that is remembered: 0 of a displacement, 1 of a force.
    pub force_share: f64,
    /// Power of the ratio of the contact radii that multiplies what is remembered when they shrink.
    pub rescaling: f64,
    /// The arm r₁ of torque and spring.
    pub arm: f64,
    /// Share of the turn of a pair by which its spring turns.
    pub follows: f64,
}

/// The spring along tangent and normal, and overlap and normal in the last step.
#[derive(Debug, Clone, Copy, Default)]
pub struct Memory {
    spring: [f64; 2],
    overlap: f64,
    normal: [f64; 2],
}

impl Composite<f64> for Memory {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut f64, &f64)) {
        self.spring.visit(&other.spring, visit);
        self.overlap.visit(&other.overlap, visit);
        self.normal.visit(&other.normal, visit);
    }
}

impl Twin {
    /// The law that `test` asks for, with reciprocal arms that are the same everywhere.
    pub fn asked_for(test: &ContactTest) -> Self {
        let ratio = test.stiffness_ratio;
        let laws = [test.convention.law(ratio), test.convention.wall_law(ratio)];
        let own = laws[0];
        let share = |yes: bool| f64::from(u8::from(yes));
        let power = own.power.value();
        let stiffness = |law: &ContactLaw| [law.normal_stiffness, law.tangential_stiffness];
        let damping = |law: &ContactLaw| [law.damping_normal, law.damping_tangential];
        Self {
            stiffness: laws.each_ref().map(stiffness),
            damping: laws.each_ref().map(damping),
            power,
            tangential_exponent: power - 1.0,
            damping_exponents: [0.5 * (power - 1.0); 2],
            stiffening: laws.each_ref().map(|law| share(law.stiffens)),
            force_share: share(own.history.keeps_force()),
            rescaling: share(own.history.is_rescaled()),
            arm: test.convention.arms.pair.torque,
            follows: 1.0,
        }
    }
}

impl Memory {
    /// The spring in the frame of a contact that has turned to `normal`, against which it turns by this `share`.
    fn turned(&self, normal: [f64; 2], share: f64) -> [f64; 2] {
        let ([x, y], [along, lift]) = (self.normal, self.spring);
        let turn = libm::atan2(x * normal[1] - y * normal[0], x * normal[0] + y * normal[1]);
        let (sine, cosine) = libm::sincos(share * turn);
        [cosine * along - sine * lift, cosine * lift + sine * along]
    }
}

impl ContactModel<f64> for Twin {
    type Memory = Memory;

    fn initial(&self, _: f64) -> Memory {
        Memory::default()
    }

    fn evaluate(&self, contact: &Contact<f64>, memory: &mut Memory) -> ContactForce<f64> {
        let kind = usize::from(contact.counterpart == Counterpart::Wall);
        let ([k, kt], [en, et]) = (self.stiffness[kind], self.damping[kind]);
        let overlap = contact.overlap;
        let stretch = libm::pow(2.0 / (2.0 - overlap), self.stiffening[kind]);
        let kt = kt * libm::pow(overlap, self.tangential_exponent) * stretch;
        let en = en * libm::pow(overlap, self.damping_exponents[0]);
        let et = et * libm::pow(overlap, self.damping_exponents[1]) * stretch;
        let normal = k * libm::pow(overlap, self.power) - en * contact.separation_speed;
        let arm = 1.0 + self.arm * overlap;
        let speed = contact.sliding_speed - arm * contact.spin;
        if memory.overlap > overlap {
            let ratio = (overlap / memory.overlap).sqrt();
            let factor = libm::pow(ratio, self.rescaling);
            memory.spring = memory.spring.map(|part| part * factor);
        }
        memory.overlap = overlap;
        let [along, lift] = memory.turned(contact.normal, 1.0 - self.follows);
        memory.normal = contact.normal;
        let growth = libm::pow(kt, self.force_share) * speed * contact.time_step;
        let grown = [along + growth, lift];
        let [along, lift] = grown.map(|part| -libm::pow(kt, 1.0 - self.force_share) * part);
        let trial = [along - et * speed, lift];
        let limit = contact.friction * normal.abs();
        let size = trial[0].hypot(trial[1]);
        let sticks = size < limit;
        if sticks {
            memory.spring = grown;
        }
        let [tangential, lift] = match sticks {
            true => trial,
            // At the frictionless wall both are 0.
            false => trial.map(|part| part * (limit / size.max(f64::MIN_POSITIVE))),
        };
        ContactForce::new(normal + lift, tangential, arm)
    }
}
