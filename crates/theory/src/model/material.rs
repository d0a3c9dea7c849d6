//! Elastic material of two equal bodies in Hertz's and Mindlin's theory.

use super::law::Power;
use serde::Serialize;
use std::f64::consts::SQRT_2;

/// K = 4/3 E* √R of two bodies of radius r, R = r/2, over E* √r.
const PAIR_STIFFNESS: f64 = 4.0 / (3.0 * SQRT_2);

/// Young's modulus and Poisson's ratio of equal bodies, from which Hertz's normal and Mindlin's tangential stiffness
/// of a pair follow:
///
/// K = 4/3 E* √R, E* = E/(2(1 − ν²)), R = r/2, κ = k_n/k_t = (2 − ν)/(2(1 − ν)).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Material {
    /// E, in the unit of K over √r.
    pub youngs_modulus: f64,
    /// ν, from 0 to 1/2.
    pub poisson_ratio: f64,
}

impl Material {
    /// κ of Poisson's ratio 0.3, the default of Hertz contacts.
    pub const USUAL_STIFFNESS_RATIO: f64 = 17.0 / 14.0;

    /// The material of pairs with the normal force δ^1.5 (K = 1) and the stiffness ratio κ. `None` for another power,
    /// and for a ratio that no Poisson's ratio from 0 to 1/2 gives.
    pub fn of_pairs(power: Power, stiffness_ratio: f64) -> Option<Self> {
        let twice = 2.0 * stiffness_ratio;
        let poisson_ratio = (twice - 2.0) / (twice - 1.0);
        let is_one = power == Power::Hertz && (1.0..=1.5).contains(&stiffness_ratio);
        is_one.then(|| Self {
            youngs_modulus: 2.0 * (1.0 - poisson_ratio * poisson_ratio) / PAIR_STIFFNESS,
            poisson_ratio,
        })
    }

    /// K of a pair, in the unit of E √r.
    pub fn pair_stiffness(&self) -> f64 {
        let nu = self.poisson_ratio;
        PAIR_STIFFNESS * self.youngs_modulus / (2.0 * (1.0 - nu * nu))
    }

    /// κ.
    pub fn stiffness_ratio(&self) -> f64 {
        (2.0 - self.poisson_ratio) / (2.0 * (1.0 - self.poisson_ratio))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_material_gives_back_the_stiffness_and_the_ratio_that_it_was_made_from() {
        for ratio in [1.0, Material::USUAL_STIFFNESS_RATIO, 1.5] {
            let material = Material::of_pairs(Power::Hertz, ratio).unwrap();
            assert!((material.pair_stiffness() - 1.0).abs() < 1e-15);
            assert!((material.stiffness_ratio() - ratio).abs() < 1e-15);
        }
        let usual = Material::of_pairs(Power::Hertz, Material::USUAL_STIFFNESS_RATIO);
        assert!((usual.unwrap().poisson_ratio - 0.3).abs() < 1e-15);
        assert_eq!(Material::of_pairs(Power::Hertz, 5.25), None);
        assert_eq!(Material::of_pairs(Power::Linear, 1.2), None);
    }
}
