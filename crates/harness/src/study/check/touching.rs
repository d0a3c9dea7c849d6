//! The forces of a contact of the twin, by a law that may be wrong.

use super::numbers::OfContact;
use crate::model::{ContactConvention, CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce};

/// The memory and the forces of a contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct State {
    pub spring: f64,
    pub normal: [f64; 2],
    pub force: [f64; 2],
    pub elastic: f64,
    pub overlap: f64,
    /// The tangential force before it is limited.
    pub trial: f64,
}

/// A closed contact at one moment.
pub(super) struct Touching {
    pub overlap: f64,
    pub separation: f64,
    pub sliding: f64,
    /// Velocity of the surfaces due to the spins.
    pub turning: f64,
    pub normal: [f64; 2],
    pub time_step: f64,
    pub weight: f64,
}

impl Touching {
    /// Computes the forces, and the spring that they leave, and stores both in `state`.
    pub fn press(&self, law: &OfContact, convention: &ContactConvention, state: &mut State) {
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
            trial: spring - damping,
        };
    }

    /// Returns the force that μ multiplies.
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

    /// Returns the length of the spring of a contact that slides.
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
        } else if law.flips_sliding_spring != 0.0 {
            at_limit / law.tangential_stiffness
        } else if law.keeps_whole_force != 0.0 {
            -at_limit / law.tangential_stiffness
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
            // A spring that nothing turns is a vector, which the twin never runs (`Twin::makes`).
            HistoryUpdate::Rotated | HistoryUpdate::Fixed => 1.0,
            HistoryUpdate::Projected => cosine,
            HistoryUpdate::Linearised => cosine + sine * sine,
        }
    }
}
