//! One row of a crosscheck.

use crate::code::Code;
use crate::study::{Source, Verdict};

/// One row of a crosscheck. Forces in m g; `error`, `tolerance` and `model_form` relative to F + 3.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Who was measured.
    pub code: Code,
    /// In which version.
    pub version: String,
    /// Live or recorded.
    pub source: Source,
    /// Floor friction μ.
    pub mu: f64,
    /// Friction μ_d between the cylinders.
    pub mu_d: f64,
    /// Stiffness 1/ε.
    pub stiffness: f64,
    /// Stiffness ratio κ.
    pub kappa: f64,
    /// Arm coefficient r₁ of cylinder–cylinder contacts.
    pub pair_arm: f64,
    /// Arm coefficient r₁ of floor contacts.
    pub floor_arm: f64,
    /// F at vanishing wall speed, by slip onset.
    pub yield_force: Option<f64>,
    /// Its uncertainty.
    pub uncertainty: Option<f64>,
    /// The theory it is compared with.
    pub reference: String,
    /// That theory's F.
    pub reference_force: Option<f64>,
    /// (yield_force − reference_force)/(reference_force + 3).
    pub error: Option<f64>,
    /// Largest error that agrees.
    pub tolerance: Option<f64>,
    /// Distance of the limit under this code's convention from the one under the paper's.
    pub model_form: Option<f64>,
    /// What follows.
    pub verdict: Verdict,
}
