//! What is said of a comparison.

use serde::{Deserialize, Serialize};

/// The verdict on a measured number. Only `agrees` is a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Within the tolerance of what it should be.
    Agrees,
    /// Further from what it should be than both tolerance and uncertainty.
    Differs,
    /// The uncertainty is larger than the tolerance, or something else speaks against an agreement.
    Inconclusive,
    /// The series, or the theory, shows no yield.
    NoYield,
    /// The code did not deliver.
    Failed,
    /// The code is not installed, and no recorded run stands in for it.
    Missing,
}

impl Verdict {
    /// The verdict on a number that is off by `error`, known to `uncertainty`, where `tolerance` is allowed.
    pub fn of(error: f64, uncertainty: f64, tolerance: f64) -> Self {
        if error.abs() > tolerance.max(uncertainty) {
            Self::Differs
        } else if uncertainty > tolerance || !error.is_finite() || !uncertainty.is_finite() {
            Self::Inconclusive
        } else {
            Self::Agrees
        }
    }

    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::Inconclusive => "inconclusive",
            Self::NoYield => "no-yield",
            Self::Failed => "failed",
            Self::Missing => "missing",
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.as_str())
    }
}

/// Smallest tolerance, relative to F + 3: the accuracy that is guaranteed of the limit itself for arbitrary
/// torque arms (tests/golden_theory.rs).
pub const MIN_TOLERANCE: f64 = 1e-7;

/// Largest tolerance, relative to F + 3: agreement between independent codes is worth the name at 1e-5.
/// An uncertainty above it decides nothing.
pub const MAX_TOLERANCE: f64 = 1e-5;

/// The verdict on an error with an expanded uncertainty, both relative to F + 3.
pub fn judge(error: f64, uncertainty: f64) -> Verdict {
    Verdict::of(error, uncertainty, tolerance(uncertainty))
}

/// The tolerance that goes with an uncertainty, both relative to F + 3: the uncertainty itself, but at
/// least [`MIN_TOLERANCE`] and at most [`MAX_TOLERANCE`].
pub fn tolerance(uncertainty: f64) -> f64 {
    uncertainty.clamp(MIN_TOLERANCE, MAX_TOLERANCE)
}

/// Whether the numbers of a row were computed now or read from a recorded run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Run on this machine, now or earlier (from the store).
    Live,
    /// Read from the recorded runs, because the code is not installed.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_small_error_that_is_known_well_agrees() {
        assert_eq!(Verdict::of(0.5, 0.5, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(-2.0, 0.5, 1.0), Verdict::Differs);
        assert_eq!(Verdict::of(0.5, 2.0, 1.0), Verdict::Inconclusive);
        assert_eq!(Verdict::of(3.0, 2.0, 1.0), Verdict::Differs);
        assert_eq!(Verdict::of(f64::NAN, 0.0, 1.0), Verdict::Inconclusive);
        assert_eq!(Verdict::of(0.0, f64::NAN, 1.0), Verdict::Inconclusive);
    }

    #[test]
    fn what_is_just_allowed_agrees() {
        assert_eq!(Verdict::of(1.0, 0.5, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(-1.0, 1.0, 1.0), Verdict::Agrees);
        assert_eq!(Verdict::of(2.0, 2.0, 1.0), Verdict::Inconclusive);
    }

    #[test]
    fn the_word_in_tables_is_the_one_in_files() {
        for (verdict, word) in [
            (Verdict::Agrees, "agrees"),
            (Verdict::Differs, "differs"),
            (Verdict::Inconclusive, "inconclusive"),
            (Verdict::NoYield, "no-yield"),
            (Verdict::Failed, "failed"),
            (Verdict::Missing, "missing"),
        ] {
            assert_eq!(verdict.to_string(), word);
            assert_eq!(serde_json::to_value(verdict).unwrap(), word);
        }
    }

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
