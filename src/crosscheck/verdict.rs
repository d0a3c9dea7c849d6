//! The verdict on one row, derived from its numbers.

use crate::engine::EngineName;
use crate::verdict::Verdict;
use serde::{Deserialize, Serialize};

/// Smallest tolerance, relative to F + 3: the accuracy that is guaranteed of the limit itself for arbitrary
/// torque arms (tests/golden_theory.rs).
pub const FLOOR: f64 = 1e-7;

/// Largest tolerance, relative to F + 3: agreement between independent codes is worth the name at 1e-5.
/// An uncertainty above it decides nothing.
pub const BAR: f64 = 1e-5;

/// The verdict on an error with an expanded uncertainty, both relative to F + 3.
pub fn judge(error: f64, uncertainty: f64) -> Verdict {
    Verdict::of(error, uncertainty, tolerance(uncertainty))
}

/// The tolerance that goes with an uncertainty, both relative to F + 3: the uncertainty itself, but at
/// least [`FLOOR`] and at most [`BAR`].
pub fn tolerance(uncertainty: f64) -> f64 {
    uncertainty.clamp(FLOOR, BAR)
}

/// Whether the numbers of a row were computed now or read from a recorded run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Run on this machine, now or earlier (from the store).
    Live,
    /// Read from the recorded runs, because the engine is not installed.
    Recorded,
}

impl Source {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Live => "live",
            Self::Recorded => "recorded",
        }
    }
}

/// One row of a crosscheck. Forces in m g; `error`, `tolerance` and `model_form` relative to F + 3.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Who was measured.
    pub engine: EngineName,
    /// In which version.
    pub version: String,
    /// Live or recorded.
    pub source: Source,
    /// Floor friction μ.
    pub mu: f64,
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
    /// Distance of the limit under this engine's convention from the one under the paper's.
    pub model_form: Option<f64>,
    /// What follows.
    pub verdict: Verdict,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_error_agrees_and_a_large_one_differs() {
        assert_eq!(judge(9e-8, 1e-8), Verdict::Agrees);
        assert_eq!(judge(-1.1e-7, 1e-8), Verdict::Differs);
    }

    #[test]
    fn tolerance_follows_the_uncertainty_between_floor_and_bar() {
        assert_eq!(judge(4e-6, 5e-6), Verdict::Agrees);
        assert_eq!(judge(6e-6, 5e-6), Verdict::Differs);
    }

    #[test]
    fn an_uncertainty_above_the_bar_decides_only_against_large_errors() {
        assert_eq!(judge(1e-7, 2e-5), Verdict::Inconclusive);
        assert_eq!(judge(1e-3, 2e-5), Verdict::Differs);
    }

    #[test]
    fn not_a_number_is_never_a_pass() {
        assert_eq!(judge(f64::NAN, 1e-8), Verdict::Inconclusive);
        assert_eq!(judge(1e-8, f64::NAN), Verdict::Inconclusive);
    }

    #[test]
    fn a_row_says_where_it_comes_from() {
        assert_eq!(Source::Live.as_str(), "live");
        assert_eq!(Source::Recorded.as_str(), "recorded");
    }
}
