//! Section II of the supplement, Eqs. (S3) to (S20).

use super::PaperTheory;
use crate::paper::claims::truth::{Displacements, Forces};
use nalgebra::Vector2;

impl PaperTheory {
    /// δ₁ and δ₂, Eq. (S3).
    pub(crate) fn displacement_vectors(&self, moved: &Displacements) -> [Vector2<f64>; 2] {
        [
            Vector2::new(0.0, self.sinking_sign * moved.delta_11),
            Vector2::new(moved.delta_22, self.sinking_sign * moved.delta_21),
        ]
    }

    /// r₁ and r₂, Eq. (S4).
    pub(crate) fn positions(&self, moved: &Displacements, radius: f64) -> [Vector2<f64>; 2] {
        let [upper, lower] = self.displacement_vectors(moved);
        let height = (self.upper_height + self.rise_factor) * radius;
        [
            Vector2::new(0.0, height) + upper,
            Vector2::new(radius, radius) + lower,
        ]
    }

    /// r₂₁ = (−r − δ₂₂, √3 r + δ₂₁ − δ₁₁), Eq. (S5).
    pub(crate) fn separation(&self, moved: &Displacements, radius: f64) -> Vector2<f64> {
        Vector2::new(
            -radius - moved.delta_22,
            self.rise_factor * radius + moved.delta_21 - moved.delta_11,
        )
    }

    fn length(&self, moved: &Displacements, radius: f64) -> f64 {
        let rise = self.rise_factor * radius + moved.delta_21 - moved.delta_11;
        (radius + moved.delta_22).hypot(rise)
    }

    /// n, Eq. (S6).
    pub(crate) fn normal(&self, moved: &Displacements, radius: f64) -> Vector2<f64> {
        self.separation(moved, radius) / self.length(moved, radius)
    }

    /// t, Eq. (S7), in its explicit form.
    pub(crate) fn explicit_tangent(&self, moved: &Displacements, radius: f64) -> Vector2<f64> {
        let rise = self.rise_factor * radius + moved.delta_21 - moved.delta_11;
        Vector2::new(rise, -self.tangent_sign * (radius + moved.delta_22))
            / self.length(moved, radius)
    }

    /// δ₁₂ = (δ₂₂, δ₁₁ − δ₂₁), Eq. (S8).
    pub(crate) fn relative_displacement_vector(&self, moved: &Displacements) -> Vector2<f64> {
        let vertical = -self.sinking_sign * (moved.delta_11 - moved.delta_21);
        Vector2::new(moved.delta_22, vertical)
    }

    /// −(δ₁₂·n), Eq. (S9).
    pub(crate) fn normal_component(&self, moved: &Displacements, radius: f64) -> f64 {
        let along = self
            .relative_displacement_vector(moved)
            .dot(&self.normal(moved, radius));
        -self.overlap_sign * along
    }

    /// −(δ₁₂·t) + rθ, Eq. (S10).
    pub(crate) fn tangential_component(&self, moved: &Displacements, radius: f64) -> f64 {
        let tangent = self.explicit_tangent(moved, radius);
        let along = self.relative_displacement_vector(moved).dot(&tangent);
        -along - self.pair_rotation_sign * radius * moved.theta
    }

    /// Horizontal displacement at the floor, Eq. (S13).
    pub(crate) fn floor_shear(&self, moved: &Displacements, radius: f64) -> f64 {
        let [_, lower] = self.displacement_vectors(moved);
        lower.x + self.floor_rotation_sign * radius * moved.theta
    }

    /// Vertical displacement at the floor, Eq. (S14).
    pub(crate) fn floor_sinking(&self, moved: &Displacements) -> f64 {
        let [_, lower] = self.displacement_vectors(moved);
        self.overlap_sign * lower.y
    }

    /// a, b, d and e by Eqs. (S11), (S12), (S15) and (S16).
    pub(crate) fn forces(
        &self,
        moved: &Displacements,
        radius: f64,
        stiffness: f64,
        ratio: f64,
    ) -> Forces {
        let tangential = stiffness / ratio;
        Forces {
            a: -stiffness * self.normal_component(moved, radius),
            b: -tangential * self.tangential_component(moved, radius),
            d: -stiffness * self.floor_sinking(moved),
            e: tangential * self.floor_shear(moved, radius),
        }
    }

    /// a, b, d and e by the explicit Eqs. (S17) to (S20).
    pub(crate) fn explicit_forces(
        &self,
        moved: &Displacements,
        radius: f64,
        stiffness: f64,
        ratio: f64,
    ) -> Forces {
        let Displacements {
            delta_11,
            delta_21,
            delta_22,
            theta,
        } = *moved;
        let tangential = stiffness / ratio;
        let length = self.length(moved, radius);
        let rise = self.rise_factor * radius + delta_21 - delta_11;
        let along = -delta_22 * (radius + delta_22) + (delta_11 - delta_21) * rise;
        let across = radius.powf(self.explicit_radius_power)
            * (self.shear_direction * delta_22 + delta_11 - delta_21);
        Forces {
            a: self.overlap_sign * stiffness * along / length,
            b: tangential * (across / length + self.pair_rotation_sign * radius * theta),
            d: self.overlap_sign * stiffness * delta_21,
            e: tangential * (delta_22 + self.floor_rotation_sign * radius * theta),
        }
    }
}
