//! Real cylinders: Young's modulus and size in, ε and the yield force in newton out.
//!
//! The paper's own estimates ("Concluding remarks") follow from ε = L ρ g/E, m = ρ L³ and f = m g/ε, hence f = E L².
//! An elastomer (1 MPa, 1000 kg/m³, L = 1 cm) then has m = 1 g, ε = 1e-4 and f = 100 N, as printed. For wood of the
//! same mass the paper prints 1e5 N without giving E. This follows from E of about 1 GPa, which is wood across its
//! grain, the direction in which the cylinders are pressed; 10 GPa, along the grain, would give 1e6 N. f = m g/ε
//! leaves out the factor 2 G(μ) of the exact limit, which is 0.2 at μ = 0.3 and 0.8 at μ = 0.5.

mod contact;
mod forecast;
#[cfg(feature = "units")]
mod quantity;

pub use contact::ContactEstimate;
pub use forecast::{Force, ForceRange, Forecast, Forecasted, FrictionRegime};
#[cfg(feature = "units")]
pub use quantity::{density, length, mass, modulus};

use crate::model::{InvalidValue, PAPER_CYLINDER_FRICTION, PAPER_STIFFNESS_RATIO, Stack};
use std::f64::consts::PI;

/// Standard gravity in m/s².
pub const GRAVITY: f64 = 9.806_65;

/// L in the paper's estimates, in m.
const PAPER_LENGTH: f64 = 0.01;
/// Mass in the paper's estimates, in kg.
const PAPER_MASS: f64 = 1e-3;

/// A solid cylinder, in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// E in Pa; across the grain, for wood.
    pub youngs_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// ρ in kg/m³.
    pub density: f64,
    /// r in m.
    pub radius: f64,
    /// l in m, along the axis.
    pub length: f64,
}

impl Cylinder {
    /// m = π ρ r² l in kg.
    pub fn mass(&self) -> f64 {
        PI * self.density * self.radius * self.radius * self.length
    }

    /// The same cylinder with the density that gives it `mass`, in kg.
    pub fn weighing(self, mass: f64) -> Self {
        let volume = PI * self.radius * self.radius * self.length;
        Self {
            density: mass / volume,
            ..self
        }
    }

    /// Returns E* = E/(2(1 − ν²)) in Pa, for two such cylinders in contact.
    fn effective_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 - self.poisson_ratio * self.poisson_ratio))
    }

    /// The paper's elastomer: 1 MPa, 1000 kg/m³, L = 1 cm, m = ρ L³ = 1 g ("Concluding remarks"). ν = 1/2.
    pub fn paper_elastomer() -> Self {
        Self::paper(1e6, 0.5, PAPER_MASS / PAPER_LENGTH.powi(3))
    }

    /// A cylinder with r = L and l = L/π, so that its mass is ρ L³ = 1 g.
    fn paper(youngs_modulus: f64, poisson_ratio: f64, density: f64) -> Self {
        let scale = libm::cbrt(PAPER_MASS / density);
        Self {
            youngs_modulus,
            poisson_ratio,
            density,
            radius: scale,
            length: scale / PI,
        }
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        let modulus = self.youngs_modulus;
        let positive = [
            ("cylinder.youngs_modulus", modulus, "a modulus above 0 Pa"),
            ("cylinder.density", self.density, "a density above 0 kg/m3"),
            ("cylinder.radius", self.radius, "a length above 0 m"),
            ("cylinder.length", self.length, "a length above 0 m"),
        ];
        for (key, value, accepted) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(InvalidValue::new(key, value, accepted));
            }
        }
        if !(0.0..=0.5).contains(&self.poisson_ratio) {
            let accepted = "a number from 0 to 0.5";
            let key = "cylinder.poisson_ratio";
            return Err(InvalidValue::new(key, self.poisson_ratio, accepted));
        }
        Ok(())
    }
}

/// Three equal cylinders on a floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Experiment {
    /// One of them.
    pub cylinder: Cylinder,
    /// Floor friction μ.
    pub mu: f64,
    /// Uncertainty of μ, as ±.
    pub mu_uncertainty: f64,
    /// Cylinder friction μ_d.
    pub mu_d: f64,
    /// Stiffness ratio κ.
    pub kappa: f64,
}

impl Experiment {
    /// `cylinder` with the floor friction `mu`, known exactly, and the paper's μ_d and κ.
    pub fn new(cylinder: Cylinder, mu: f64) -> Self {
        Self {
            cylinder,
            mu,
            mu_uncertainty: 0.0,
            mu_d: PAPER_CYLINDER_FRICTION,
            kappa: PAPER_STIFFNESS_RATIO,
        }
    }

    /// The dimensionless stack, with the stiffness k_n r/(m g) for k_n in N/m.
    fn stack(&self, mu: f64, normal_stiffness: f64) -> Stack {
        let weight = self.cylinder.mass() * GRAVITY;
        Stack {
            cylinder_friction: self.mu_d,
            stiffness_ratio: self.kappa,
            ..Stack::paper(mu, normal_stiffness * self.cylinder.radius / weight)
        }
    }

    /// Refuses values out of range.
    fn validate(&self) -> Result<(), InvalidValue> {
        self.cylinder.validate()?;
        let groups = Stack {
            stiffness: 1e4,
            ..self.stack(self.mu, 1.0)
        };
        groups.validate()?;
        if !(self.mu_uncertainty >= 0.0 && self.mu_uncertainty < self.mu) {
            let accepted = "a number from 0 to below mu";
            return Err(InvalidValue::new(
                "mu_uncertainty",
                self.mu_uncertainty,
                accepted,
            ));
        }
        Ok(())
    }
}
