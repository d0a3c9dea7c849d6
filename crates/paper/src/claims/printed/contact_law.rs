//! The DEM's contact law, in the text of "Numerical results", and its damping, Eqs. (S1) and (S2).

use super::PaperTheory;
use crate::claims::truth::{NORMAL_STIFFNESS, RADIUS};
use nalgebra::Vector2;

/// A tangential contact in motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sliding {
    /// η_t.
    pub(crate) damping: f64,
    /// u, stretch of the spring.
    pub(crate) stretch: f64,
    /// v, tangential velocity.
    pub(crate) velocity: f64,
    /// μ |f_n|.
    pub(crate) cap: f64,
}

impl PaperTheory {
    /// Δ = 2r − r_ij.
    pub(crate) fn overlap(&self, distance: f64) -> f64 {
        self.overlap_diameters * RADIUS - distance
    }

    /// h_n Θ(Δ) with h_n = k_n Δ − η_n v_n.
    pub(crate) fn normal_force(&self, damping: f64, overlap: f64, velocity: f64) -> f64 {
        if overlap >= 0.0 {
            NORMAL_STIFFNESS * overlap - self.normal_damping * damping * velocity
        } else {
            0.0
        }
    }

    /// t_ij = (−y_ij, x_ij)/r_ij.
    pub(crate) fn pair_tangent(&self, separation: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(self.pair_tangent_sign * separation.y, separation.x) / separation.norm()
    }

    /// (v_i − v_j)·t_ij − r (ω_i + ω_j).
    pub(crate) fn tangential_velocity(
        &self,
        separation: Vector2<f64>,
        velocity: Vector2<f64>,
        spins: [f64; 2],
    ) -> f64 {
        let tangent = self.pair_tangent(separation);
        velocity.dot(&tangent) - self.spin_arm * RADIUS * (spins[0] + spins[1])
    }

    /// h_t = −k_t u − η_t v, for a spring k_t of [`NORMAL_STIFFNESS`].
    pub(crate) fn sticking_force(&self, contact: &Sliding) -> f64 {
        -NORMAL_STIFFNESS * contact.stretch
            - self.tangential_damping * contact.damping * contact.velocity
    }

    /// min(h_t, −μ |f_n| v/|v|), the one with the smaller norm.
    pub(crate) fn tangential_force(&self, contact: &Sliding) -> f64 {
        let sticking = self.sticking_force(contact);
        if sticking.abs() <= contact.cap {
            sticking
        } else if self.cap_along_spring != 0.0 {
            contact.cap * sticking.signum()
        } else {
            -contact.cap * contact.velocity / contact.velocity.abs()
        }
    }

    /// Returns whether u grows: |h_t| < μ |f_n|.
    pub(crate) fn sticks(&self, contact: &Sliding) -> bool {
        self.sticking_force(contact).abs() < self.stick_limit * contact.cap
    }

    /// Returns the friction coefficient that caps the force between two cylinders.
    pub(crate) fn friction_between_cylinders(&self, floor_friction: f64) -> f64 {
        if self.cap_of_cylinders == 0.0 {
            floor_friction
        } else {
            self.cylinder_friction
        }
    }

    /// η = −2 ln e_r √(m k/(π² + ln² e_r)), Eqs. (S1) and (S2).
    pub(crate) fn damping(&self, mass: f64, stiffness: f64) -> f64 {
        let logarithm = self.restitution.ln();
        let spread = std::f64::consts::PI.powi(2) + logarithm * logarithm;
        -self.damping_factor * logarithm * (self.damping_mass * mass * stiffness / spread).sqrt()
    }
}
