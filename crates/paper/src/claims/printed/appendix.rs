//! Appendix A of the End Matter, Eqs. (E1) to (E9). Each equation is brought to the form "sum = 0"; its
//! method returns the distance of the sum from zero, relative to the largest term.

use super::PaperTheory;
use crate::claims::finding::imbalance;
use crate::claims::truth::{RADIUS, YieldState};

impl PaperTheory {
    /// r θ = μκz − y, Eq. (E1).
    pub(crate) fn slip_condition(&self, state: &YieldState) -> f64 {
        let drive = self.slip_rotation * state.friction * state.ratio * state.z();
        imbalance(&[RADIUS * state.displacements.theta, -drive, state.y()])
    }

    /// 2μκz − y.
    fn relative_displacement(&self, state: &YieldState) -> f64 {
        self.relative_slip * state.friction * state.ratio * state.z() - state.y()
    }

    /// x + √3 y.
    pub(crate) fn shear(&self, state: &YieldState) -> f64 {
        state.x() + self.shear_direction * state.y()
    }

    /// √3 r − x.
    fn rise(&self, state: &YieldState) -> f64 {
        self.rise_factor * RADIUS - state.x()
    }

    /// √((√3 r − x)² + (r + y)²).
    fn centre_distance(&self, state: &YieldState) -> f64 {
        self.rise(state).hypot(RADIUS + state.y())
    }

    /// Eq. (E2).
    pub(crate) fn first_of_xyz(&self, state: &YieldState) -> f64 {
        let left = self.centre_distance(state) * self.relative_displacement(state);
        imbalance(&[left, -RADIUS * self.shear(state)])
    }

    /// A, B and C below Eq. (E4).
    pub(crate) fn auxiliary(&self, state: &YieldState) -> [f64; 3] {
        let (x, y, z) = (state.x(), state.y(), state.z());
        let relative = self.relative_displacement(state);
        let shear = self.shear(state);
        [
            (x * self.rise(state) - y * (RADIUS + y)) * relative * relative,
            state.friction * RADIUS * shear * relative * z,
            RADIUS * RADIUS * shear * shear * z,
        ]
    }

    /// Eq. (E3).
    pub(crate) fn second_of_xyz(&self, state: &YieldState) -> f64 {
        let [a, b, c] = self.auxiliary(state);
        let outward = RADIUS + state.y();
        imbalance(&[a * outward, -b * self.rise(state), -state.friction * c])
    }

    fn weight_term(&self, state: &YieldState) -> f64 {
        let shear = self.shear(state);
        state.epsilon * RADIUS.powf(self.weight_term_power) * shear * shear
    }

    /// Eq. (E4).
    pub(crate) fn third_of_xyz(&self, state: &YieldState) -> f64 {
        let [a, b, c] = self.auxiliary(state);
        let outward = RADIUS + state.y();
        imbalance(&[
            a * self.rise(state),
            b * outward,
            -c,
            self.weight_term(state),
        ])
    }

    /// Eq. (E5).
    pub(crate) fn a_eliminated(&self, state: &YieldState) -> f64 {
        let (mu, z) = (state.friction, state.z());
        let (rise, outward) = (self.rise(state), RADIUS + state.y());
        let shear = self.shear(state);
        let first = mu * RADIUS * (rise * rise + outward * outward) * shear;
        imbalance(&[
            first * self.relative_displacement(state) * z,
            RADIUS * RADIUS * (rise * mu - outward) * shear * shear * z,
            self.weight_term(state) * outward,
        ])
    }

    /// Eq. (E6).
    pub(crate) fn sum_relation(&self, state: &YieldState) -> f64 {
        let brace = self.centre_distance(state) + self.sum_factor * self.rise(state);
        let outward = RADIUS + state.y();
        let rest = state.z() - state.epsilon * RADIUS;
        imbalance(&[state.friction * state.z() * brace, -outward * rest])
    }

    /// Eq. (E7).
    pub(crate) fn conjugate_relation(&self, state: &YieldState) -> f64 {
        let brace = self.centre_distance(state) - self.conjugate_factor * self.rise(state);
        let rest = state.z() - state.epsilon * RADIUS;
        let outward = RADIUS + state.y();
        imbalance(&[rest * brace, -state.friction * outward * state.z()])
    }

    /// Eq. (E8), r + y = [(1 − α)² − μ²]/[2μ(1 − α)] (√3 r − x).
    pub(crate) fn slope_relation(&self, state: &YieldState) -> f64 {
        let (mu, u) = (state.friction, 1.0 - state.alpha());
        let fraction = (u * u - mu * mu) / (self.slope_factor * mu * u);
        imbalance(&[
            RADIUS + state.y(),
            -fraction.powf(self.slope_power) * self.rise(state),
        ])
    }

    /// z = r 𝒟 ℰ, Eqs. (8) and (E9).
    pub(crate) fn closed_form(&self, state: &YieldState) -> f64 {
        let alpha = state.alpha();
        let product = self.geometry(state.friction, alpha)
            * self.compliance(state.friction, state.ratio, alpha);
        imbalance(&[state.z(), -RADIUS * product])
    }
}
