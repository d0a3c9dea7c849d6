//! The forces of a contact of the twin, by a law that may be wrong.

use super::numbers::OfContact;
use crate::model::{
    ContactConvention, ContactLaw, CoulombOperand, HistoryUpdate, SlidingSpring, TensileForce,
};

/// A part along the tangent of a contact, and one along its normal.
type Parts = [f64; 2];

/// The memory and the forces of a contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct State {
    /// The tangential spring as the law remembers it. Only a spring that nothing turns has a part along the normal.
    pub spring: Parts,
    pub normal: [f64; 2],
    /// Normal and tangential force.
    pub force: [f64; 2],
    /// The normal spring's part of the normal force.
    pub elastic: f64,
    /// Force of the tangential spring.
    pub sheared: Parts,
    /// The same at the length of the step before.
    pub sheared_before: Parts,
    /// Length of the tangential spring along the tangent.
    pub length: f64,
    pub overlap: f64,
    /// The tangential force before it is limited.
    pub trial: f64,
    pub memory: Memory,
}

/// How a law remembers the tangential spring at an overlap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Memory {
    /// Part of what is remembered that the change of the overlap since the step before leaves.
    pub kept: f64,
    /// What is remembered of a unit of length.
    pub unit: f64,
    /// Stiffness, in units of the tangential stiffness.
    pub growth: f64,
    /// Tangential damping, in units of its coefficient.
    pub damping: f64,
}

impl Default for Memory {
    fn default() -> Self {
        let [kept, unit, growth, damping] = [1.0; 4];
        Self {
            kept,
            unit,
            growth,
            damping,
        }
    }
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

fn length([along, across]: Parts) -> f64 {
    match across {
        0.0 => along.abs(),
        _ => (along * along + across * across).sqrt(),
    }
}

/// Returns `own` shortened to a length.
fn limited(own: Parts, limit: f64) -> Parts {
    let length = length(own);
    match length > limit {
        true => own.map(|part| part / length * limit),
        false => own,
    }
}

impl Touching {
    /// Computes the forces, and the spring that they leave, and stores both in `state`. The coefficients of `law` are
    /// those at an overlap of 1; `unit` says how they depend on the overlap.
    pub fn press(
        &self,
        law: &OfContact,
        unit: &ContactLaw,
        convention: &ContactConvention,
        state: &mut State,
    ) {
        let overlap = self.overlap;
        let growth = unit.at(overlap);
        let power = |exponent: f64| match exponent {
            0.0 => 1.0,
            exponent => libm::pow(overlap.max(0.0), exponent),
        };
        let elastic = law.normal_stiffness * growth.secant * overlap * power(law.exponent);
        let damped = law.damping_normal * growth.damping_normal * self.separation;
        let is_damped = law.damps_approach == 0.0 || self.separation < 0.0;
        let mut pressing = match is_damped {
            true => elastic - damped * power(law.damping_exponent),
            false => elastic,
        };
        if convention.tensile_force == TensileForce::NeverPulls {
            pressing = pressing.max(0.0);
        }
        let limit = law.friction
            * match law.limit_before {
                0.0 => self.limiting(law, elastic, pressing),
                _ => state.force[0].abs(),
            };
        let memory = Memory {
            kept: match unit.history.is_rescaled() && overlap < state.overlap {
                true => (overlap / state.overlap).sqrt(),
                false => 1.0,
            },
            unit: match unit.history.keeps_force() {
                true => growth.tangential_stiffness,
                false => 1.0,
            },
            growth: growth.tangential_stiffness * power(law.tangential_exponent),
            damping: growth.damping_tangential * power(law.tangential_damping_exponent),
        };
        let velocity = self.sliding - law.spin_in_damping * self.turning;
        let stretching = self.sliding - law.spin_in_spring * self.turning;
        let kept = law.spring_kept * memory.kept / memory.unit;
        let old = self.transported(convention, state).map(|own| own * kept);
        let stretched = [
            old[0] + law.spring_growth * stretching * self.time_step,
            old[1],
        ];
        let stiffness = law.tangential_stiffness * memory.growth;
        let force_of = |length: Parts| length.map(|own| -stiffness * own);
        let spring = force_of(match law.stale_spring {
            0.0 => stretched,
            _ => old,
        });
        let damping = law.damping_tangential * memory.damping * velocity;
        let sticking = [spring[0] - damping, spring[1]];
        let operand = match convention.coulomb_operand {
            CoulombOperand::SpringAndDamping => sticking,
            CoulombOperand::Spring => spring,
        };
        let slid = |at_limit| self.slid(law, convention, stiffness, (old, stretched), at_limit);
        let (force, left) = if law.uncapped_damping != 0.0 {
            let capped = limited(spring, limit.abs());
            let left = match capped == spring {
                true => stretched,
                false => slid((capped, 0.0)),
            };
            ([capped[0] - damping, capped[1]], left)
        } else if length(operand) < limit || law.caps_of * operand[0] < 0.0 {
            let left = match law.keeps_damping {
                0.0 => stretched,
                _ => sticking.map(|own| -own / stiffness),
            };
            (sticking, left)
        } else {
            let direction = match (law.one_sided, length(operand)) {
                (0.0, 0.0) => [1f64.copysign(operand[0]), 0.0],
                (0.0, length) => operand.map(|own| own / length),
                (sign, _) => [sign, 0.0],
            };
            let at_limit = direction.map(|own| own * limit * law.sliding_friction);
            let counted = match convention.coulomb_operand {
                CoulombOperand::SpringAndDamping => damping,
                CoulombOperand::Spring => 0.0,
            };
            let force = [at_limit[0] - law.damps_sliding * damping, at_limit[1]];
            (force, slid((at_limit, counted)))
        };
        *state = State {
            spring: left.map(|own| own * memory.unit),
            normal: self.normal,
            force: [pressing + force[1], force[0]],
            elastic,
            sheared: force_of(left),
            sheared_before: force_of(old),
            length: left[0],
            overlap,
            trial: sticking[0],
            memory,
        };
    }

    /// Returns the force that μ multiplies.
    fn limiting(&self, law: &OfContact, elastic: f64, pressing: f64) -> f64 {
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

    /// Returns the length of the spring of a contact that slides, whose limited force has the part `damping` that is
    /// none of the spring's.
    fn slid(
        &self,
        law: &OfContact,
        convention: &ContactConvention,
        stiffness: f64,
        (old, stretched): (Parts, Parts),
        (at_limit, damping): (Parts, f64),
    ) -> Parts {
        let borne_by = |force: Parts| force.map(|own| -own / stiffness);
        if law.keeps_sliding_spring != 0.0 {
            stretched
        } else if law.clears_sliding_spring != 0.0 {
            [0.0; 2]
        } else if law.flips_sliding_spring != 0.0 {
            borne_by(at_limit).map(|own| -own)
        } else if law.keeps_whole_force != 0.0 {
            borne_by(at_limit)
        } else if convention.sliding_spring == SlidingSpring::FollowsLimit {
            borne_by([at_limit[0] + damping, at_limit[1]])
        } else {
            old
        }
    }

    /// Returns the spring of the step before along the present tangent and normal.
    fn transported(&self, convention: &ContactConvention, state: &State) -> Parts {
        let ([x, y], before) = (self.normal, state.normal);
        let cosine = before[0] * x + before[1] * y;
        let sine = before[0] * y - before[1] * x;
        let [along, across] = state.spring;
        match convention.history_update {
            HistoryUpdate::Rotated => [along, 0.0],
            HistoryUpdate::Projected => [along * cosine, 0.0],
            HistoryUpdate::Linearised => [along * (cosine + sine * sine), 0.0],
            HistoryUpdate::Fixed => [
                along * cosine - across * sine,
                along * sine + across * cosine,
            ],
        }
    }
}
