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
    /// The engine did not deliver.
    Failed,
    /// The engine is not installed, and no recorded run stands in for it.
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
}
