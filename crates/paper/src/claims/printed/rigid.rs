//! Setup and rigid cylinders, Eqs. (1) to (4).

use super::PaperTheory;
use crate::claims::truth::Balanced;
use crate::model::Stack;
use nalgebra::Vector2;

impl PaperTheory {
    /// Returns a stack with the paper's stiffness ratio.
    pub(crate) fn stack(&self, friction: f64, stiffness: f64) -> Stack {
        Stack {
            stiffness_ratio: self.stiffness_ratio,
            ..Stack::paper(friction, stiffness)
        }
    }

    /// t = (n_y, −n_x).
    pub(crate) fn tangent(&self, normal: Vector2<f64>) -> Vector2<f64> {
        Vector2::new(normal.y, self.tangent_sign * normal.x)
    }

    /// Terms of Eqs. (1) and (S21), b − e = 0.
    pub(crate) fn torque_terms(&self, state: &Balanced) -> [f64; 2] {
        [state.forces.b, -self.torque_ratio * state.forces.e]
    }

    /// Terms of Eqs. (2) and (S22), a n_x + b (t_x + 1) = 0.
    pub(crate) fn horizontal_terms(&self, state: &Balanced) -> [f64; 2] {
        let outward = self.tangent(state.normal).x + self.floor_share;
        [state.forces.a * state.normal.x, state.forces.b * outward]
    }

    /// Terms of Eqs. (3) and (S23), 2 a n_y + 2 b t_y − f − m g = 0.
    pub(crate) fn vertical_terms(&self, state: &Balanced) -> [f64; 4] {
        [
            self.pair_contacts * state.forces.a * state.normal.y,
            self.pair_contacts * state.forces.b * self.tangent(state.normal).y,
            -state.f,
            -self.upper_weights * state.weight,
        ]
    }

    /// Terms of f + 3 m g = 2 d.
    pub(crate) fn stack_terms(&self, state: &Balanced) -> [f64; 3] {
        [
            state.f,
            self.stack_weights * state.weight,
            -self.floor_contacts * state.forces.d,
        ]
    }

    /// n = (−1/2, √3/2).
    pub(crate) fn rigid_normal(&self) -> Vector2<f64> {
        Vector2::new(self.rigid_normal_x, self.rigid_normal_y)
    }

    /// t = (√3/2, 1/2).
    pub(crate) fn rigid_tangent(&self) -> Vector2<f64> {
        Vector2::new(self.rigid_tangent_x, self.rigid_tangent_y)
    }

    /// d = (f + 3 m g)/2 of rigid cylinders.
    pub(crate) fn rigid_floor_load(&self, state: &Balanced) -> f64 {
        (state.f + self.rigid_load_weights * state.weight) / 2.0
    }

    /// e = μ_c (f + m g)/2 of rigid cylinders.
    pub(crate) fn rigid_floor_shear(&self, state: &Balanced) -> f64 {
        self.critical_friction * (state.f + self.rigid_shear_weights * state.weight) / 2.0
    }

    /// f₀(μ)/(m g), Eq. (4).
    pub(crate) fn rigid_yield_force(&self, friction: f64) -> f64 {
        let critical = self.critical_friction;
        if friction < critical / self.rigid_threshold {
            0.0
        } else if friction < critical {
            (self.rigid_friction_weight * friction - critical) / (critical - friction)
        } else {
            f64::INFINITY
        }
    }

    /// m = π ρ r² l.
    pub(crate) fn mass(&self, density: f64, radius: f64, length: f64) -> f64 {
        self.mass_factor * density * radius * radius * length
    }
}
