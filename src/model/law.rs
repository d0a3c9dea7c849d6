//! The contact law: linear springs, each with a dashpot beside it.
//!
//! At an overlap δ that shrinks at the speed v_n, with the spring stretched to u and the surfaces moving at v_t,
//!
//! N = k_n δ − η_n v_n,  T = −k_t u − η_t v_t,  k_n = 1,  k_t = k_n/κ,
//!
//! and η = −2 ln e_r √(m k/(π² + ln² e_r)) of either stiffness k, in √(m k_n), gives the restitution e_r (paper,
//! "Numerical results", Eqs. S1 and S2).

use serde::Serialize;

/// Coefficients of the law, under the names by which decks read them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactLaw<N = f64> {
    /// k_n.
    pub normal_stiffness: N,
    /// k_t.
    pub tangential_stiffness: N,
    /// η_n.
    pub damping_normal: N,
    /// η_t.
    pub damping_tangential: N,
}

impl<N> ContactLaw<N> {
    /// The same coefficients as other numbers.
    pub(crate) fn map<M>(self, mut number: impl FnMut(N) -> M) -> ContactLaw<M> {
        ContactLaw {
            normal_stiffness: number(self.normal_stiffness),
            tangential_stiffness: number(self.tangential_stiffness),
            damping_normal: number(self.damping_normal),
            damping_tangential: number(self.damping_tangential),
        }
    }
}

impl ContactLaw {
    /// The law of stiffness ratio κ and restitution e_r.
    pub(super) fn new(stiffness_ratio: f64, restitution: f64) -> Self {
        let tangential_stiffness = 1.0 / stiffness_ratio;
        Self {
            normal_stiffness: 1.0,
            tangential_stiffness,
            damping_normal: damping(1.0, restitution),
            damping_tangential: damping(tangential_stiffness, restitution),
        }
    }

    /// The largest slope of the normal force.
    pub(super) fn highest_stiffness(&self) -> f64 {
        self.normal_stiffness
    }

    /// The normal force at an overlap.
    pub(crate) fn force(&self, overlap: f64) -> f64 {
        self.normal_stiffness * overlap
    }

    /// The overlap at a normal force.
    pub(crate) fn overlap(&self, force: f64) -> f64 {
        force / self.normal_stiffness
    }
}

fn damping(stiffness: f64, restitution: f64) -> f64 {
    let log = libm::log(restitution);
    let pi = std::f64::consts::PI;
    2.0 * log.abs() * (stiffness / (pi * pi + log * log)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::PAPER_RESTITUTION;

    #[test]
    fn damping_gives_the_restitution_it_is_named_after() {
        // Half an oscillation of a unit mass on a unit spring with damping η keeps the fraction
        // exp(−π ζ/√(1 − ζ²)) of its speed, ζ = η/2.
        let ratio = ContactLaw::new(2.5, PAPER_RESTITUTION).damping_normal / 2.0;
        let kept = libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
        assert!((kept - PAPER_RESTITUTION).abs() < 1e-15);
    }

    #[test]
    fn an_elastic_collision_is_not_damped() {
        assert_eq!(ContactLaw::new(2.5, 1.0).damping_normal.to_bits(), 0);
    }
}
