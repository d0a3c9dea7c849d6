//! Appendix A of the End Matter, Eqs. (E1) to (E9). Each method gives the terms of an equation brought to
//! the form "sum = 0".

use super::PaperTheory;
use crate::paper::claims::truth::{RADIUS, YieldState};

impl PaperTheory {
    /// r θ = μκz − y, Eq. (E1).
    pub fn slip_condition_terms(&self, state: &YieldState) -> [f64; 3] {
        let drive = self.slip_rotation * state.friction * state.ratio * state.z();
        [RADIUS * state.displacements.theta, -drive, state.y()]
    }

    /// 2μκz − y.
    fn relative_displacement(&self, state: &YieldState) -> f64 {
        self.relative_slip * state.friction * state.ratio * state.z() - state.y()
    }

    /// x + √3 y.
    pub fn shear(&self, state: &YieldState) -> f64 {
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
    pub fn first_terms(&self, state: &YieldState) -> [f64; 2] {
        let left = self.centre_distance(state) * self.relative_displacement(state);
        [left, -RADIUS * self.shear(state)]
    }

    /// A, B and C below Eq. (E4).
    pub fn auxiliary(&self, state: &YieldState) -> [f64; 3] {
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
    pub fn second_terms(&self, state: &YieldState) -> [f64; 3] {
        let [a, b, c] = self.auxiliary(state);
        let outward = RADIUS + state.y();
        [a * outward, -b * self.rise(state), -state.friction * c]
    }

    fn weight_term(&self, state: &YieldState) -> f64 {
        let shear = self.shear(state);
        state.epsilon * RADIUS.powf(self.weight_term_power) * shear * shear
    }

    /// Eq. (E4).
    pub fn third_terms(&self, state: &YieldState) -> [f64; 4] {
        let [a, b, c] = self.auxiliary(state);
        let outward = RADIUS + state.y();
        [
            a * self.rise(state),
            b * outward,
            -c,
            self.weight_term(state),
        ]
    }

    /// Eq. (E5).
    pub fn eliminated_terms(&self, state: &YieldState) -> [f64; 3] {
        let (mu, z) = (state.friction, state.z());
        let (rise, outward) = (self.rise(state), RADIUS + state.y());
        let shear = self.shear(state);
        let first = mu * RADIUS * (rise * rise + outward * outward) * shear;
        [
            first * self.relative_displacement(state) * z,
            RADIUS * RADIUS * (rise * mu - outward) * shear * shear * z,
            self.weight_term(state) * outward,
        ]
    }

    /// Eq. (E6).
    pub fn sum_terms(&self, state: &YieldState) -> [f64; 2] {
        let brace = self.centre_distance(state) + self.sum_factor * self.rise(state);
        let outward = RADIUS + state.y();
        let rest = state.z() - state.epsilon * RADIUS;
        [state.friction * state.z() * brace, -outward * rest]
    }

    /// Eq. (E7).
    pub fn conjugate_terms(&self, state: &YieldState) -> [f64; 2] {
        let brace = self.centre_distance(state) - self.conjugate_factor * self.rise(state);
        let rest = state.z() - state.epsilon * RADIUS;
        let outward = RADIUS + state.y();
        [rest * brace, -state.friction * outward * state.z()]
    }

    /// Eq. (E8), r + y = [(1 − α)² − μ²]/[2μ(1 − α)] (√3 r − x).
    pub fn slope_terms(&self, state: &YieldState) -> [f64; 2] {
        let (mu, u) = (state.friction, 1.0 - state.alpha());
        let fraction = (u * u - mu * mu) / (self.slope_factor * mu * u);
        [
            RADIUS + state.y(),
            -fraction.powf(self.slope_power) * self.rise(state),
        ]
    }

    /// z = r 𝒟 ℰ, Eqs. (8) and (E9).
    pub fn closed_terms(&self, state: &YieldState) -> [f64; 2] {
        let alpha = state.alpha();
        let product = self.geometry(state.friction, alpha)
            * self.compliance(state.friction, state.ratio, alpha);
        [state.z(), -RADIUS * product]
    }
}
