//! Section II of the supplement, Eqs. (S3) to (S20).

use super::PaperTheory;
use crate::claims::truth::{Displacements, Forces, NORMAL_STIFFNESS, RADIUS};
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
    pub(crate) fn positions(&self, moved: &Displacements) -> [Vector2<f64>; 2] {
        let [upper, lower] = self.displacement_vectors(moved);
        let height = (self.upper_height + self.rise_factor) * RADIUS;
        let centres = [Vector2::new(0.0, height), Vector2::new(RADIUS, RADIUS)];
        [centres[0] + upper, centres[1] + lower]
    }

    /// r₂₁ = (−r − δ₂₂, √3 r + δ₂₁ − δ₁₁), Eq. (S5).
    pub(crate) fn separation(&self, moved: &Displacements) -> Vector2<f64> {
        Vector2::new(
            -RADIUS - moved.delta_22,
            self.rise_factor * RADIUS + moved.delta_21 - moved.delta_11,
        )
    }

    fn length(&self, moved: &Displacements) -> f64 {
        let apart = self.separation(moved);
        apart.x.hypot(apart.y)
    }

    /// n, Eq. (S6).
    pub(crate) fn normal(&self, moved: &Displacements) -> Vector2<f64> {
        self.separation(moved) / self.length(moved)
    }

    /// t, Eq. (S7), in its explicit form.
    pub(crate) fn explicit_tangent(&self, moved: &Displacements) -> Vector2<f64> {
        self.tangent(self.separation(moved)) / self.length(moved)
    }

    /// δ₁₂ = (δ₂₂, δ₁₁ − δ₂₁), Eq. (S8).
    pub(crate) fn relative_displacement_vector(&self, moved: &Displacements) -> Vector2<f64> {
        let vertical = -self.sinking_sign * (moved.delta_11 - moved.delta_21);
        Vector2::new(moved.delta_22, vertical)
    }

    /// −(δ₁₂·n), Eq. (S9).
    pub(crate) fn normal_component(&self, moved: &Displacements) -> f64 {
        let normal = self.normal(moved);
        let along = self.relative_displacement_vector(moved).dot(&normal);
        -self.overlap_sign * along
    }

    /// −(δ₁₂·t) + rθ, Eq. (S10).
    pub(crate) fn tangential_component(&self, moved: &Displacements) -> f64 {
        let tangent = self.explicit_tangent(moved);
        let along = self.relative_displacement_vector(moved).dot(&tangent);
        -along - self.pair_rotation_sign * RADIUS * moved.theta
    }

    /// Horizontal displacement at the floor, Eq. (S13).
    pub(crate) fn floor_shear(&self, moved: &Displacements) -> f64 {
        let [_, lower] = self.displacement_vectors(moved);
        lower.x + self.floor_rotation_sign * RADIUS * moved.theta
    }

    /// Vertical displacement at the floor, Eq. (S14).
    pub(crate) fn floor_sinking(&self, moved: &Displacements) -> f64 {
        let [_, lower] = self.displacement_vectors(moved);
        self.overlap_sign * lower.y
    }

    /// a, b, d and e by Eqs. (S11), (S12), (S15) and (S16).
    pub(crate) fn forces(&self, moved: &Displacements, ratio: f64) -> Forces {
        let tangential = NORMAL_STIFFNESS / ratio;
        Forces {
            a: -NORMAL_STIFFNESS * self.normal_component(moved),
            b: -tangential * self.tangential_component(moved),
            d: -NORMAL_STIFFNESS * self.floor_sinking(moved),
            e: tangential * self.floor_shear(moved),
        }
    }

    /// a, b, d and e by the explicit Eqs. (S17) to (S20).
    pub(crate) fn explicit_forces(&self, moved: &Displacements, ratio: f64) -> Forces {
        let (delta_11, delta_21) = (moved.delta_11, moved.delta_21);
        let (delta_22, theta) = (moved.delta_22, moved.theta);
        let tangential = NORMAL_STIFFNESS / ratio;
        let length = self.length(moved);
        let rise = self.separation(moved).y;
        let along = -delta_22 * (RADIUS + delta_22) + (delta_11 - delta_21) * rise;
        let across = RADIUS.powf(self.explicit_radius_power)
            * (self.shear_direction * delta_22 + delta_11 - delta_21);
        Forces {
            a: self.overlap_sign * NORMAL_STIFFNESS * along / length,
            b: tangential * (across / length + self.pair_rotation_sign * RADIUS * theta),
            d: self.overlap_sign * NORMAL_STIFFNESS * delta_21,
            e: tangential * (delta_22 + self.floor_rotation_sign * RADIUS * theta),
        }
    }
}
