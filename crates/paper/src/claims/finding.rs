//! The finding of a check, and the one rule that derives a verdict from it.

use super::notation::size;

/// Deviation below which two formulas count as the same. The states at which they are evaluated are known to
/// some 1e-11.
pub const ROUND_OFF: f64 = 1e-8;

/// The verdict on a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClaimVerdict {
    /// The claim holds as stated.
    Holds,
    /// It holds within the deviation that its own words allow.
    Approximately,
    /// It does not hold as stated.
    Fails,
    /// It cannot be tested here.
    Untestable,
}

impl std::fmt::Display for ClaimVerdict {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Holds => "holds",
            Self::Approximately => "approximately",
            Self::Fails => "fails",
            Self::Untestable => "untestable",
        })
    }
}

/// The result of a check.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Finding {
    /// Distance of the claim from the truth.
    pub(crate) deviation: f64,
    /// Largest deviation with which the claim holds as stated.
    pub(crate) bound: f64,
    /// The quantities compared, and their values.
    pub(crate) evidence: String,
}

impl Finding {
    /// Holds a deviation to `bound`.
    pub(crate) fn new(deviation: f64, bound: f64, evidence: impl Into<String>) -> Self {
        Self {
            deviation,
            bound,
            evidence: evidence.into(),
        }
    }

    /// Judges a statement that is true or false.
    pub(crate) fn statement(holds: bool, evidence: impl Into<String>) -> Self {
        Self::new(violation(holds), 0.0, evidence)
    }

    /// Judges a statement that allows no exceptions, by the number of those that were found.
    pub(crate) fn exceptions(count: usize, evidence: impl Into<String>) -> Self {
        Self::new(count as f64, 0.0, evidence)
    }

    /// Judges an identity by the relative deviations of its two sides at several points.
    pub(crate) fn identity(deviations: impl IntoIterator<Item = f64>, compared: &str) -> Self {
        let deviations: Vec<f64> = deviations.into_iter().collect();
        let count = deviations.len();
        let largest = worst(deviations);
        let found = size(largest, ROUND_OFF);
        let evidence = match count {
            0 => format!("{compared}: nothing to compare"),
            1 => format!("{compared}; the relative deviation is {found}"),
            _ => format!("{compared}; at {count} points the largest relative deviation is {found}"),
        };
        Self::new(largest, ROUND_OFF, evidence)
    }

    /// Derives the verdict, where the words of the claim allow a deviation up to `allowed`.
    pub(crate) fn verdict(&self, allowed: Option<f64>) -> ClaimVerdict {
        if self.deviation <= self.bound {
            ClaimVerdict::Holds
        } else if allowed.is_some_and(|allowed| self.deviation <= allowed) {
            ClaimVerdict::Approximately
        } else {
            ClaimVerdict::Fails
        }
    }
}

/// Returns the larger of two deviations; NaN counts as larger than any number.
fn worse(left: f64, right: f64) -> f64 {
    if left.is_nan() || right.is_nan() {
        f64::NAN
    } else {
        left.max(right)
    }
}

/// Returns the largest of all deviations, or NaN if there are none.
pub(crate) fn worst(deviations: impl IntoIterator<Item = f64>) -> f64 {
    let largest = deviations.into_iter().reduce(worse);
    largest.unwrap_or(f64::NAN)
}

/// Returns 0 if a condition holds, else 1.
pub(crate) fn violation(holds: bool) -> f64 {
    if holds { 0.0 } else { 1.0 }
}

/// Returns the distance of a sum from zero, relative to its largest term.
pub(crate) fn imbalance(terms: &[f64]) -> f64 {
    let largest = terms
        .iter()
        .fold(0.0, |largest: f64, term| largest.max(term.abs()));
    (terms.iter().sum::<f64>() / largest).abs()
}

/// Returns |left/right − 1|.
pub(crate) fn relative(left: f64, right: f64) -> f64 {
    (left / right - 1.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_rule_for_every_verdict() {
        let finding = |deviation| Finding::new(deviation, 1e-8, "");
        assert_eq!(finding(1e-9).verdict(None), ClaimVerdict::Holds);
        assert_eq!(finding(1e-3).verdict(None), ClaimVerdict::Fails);
        assert_eq!(
            finding(1e-3).verdict(Some(0.01)),
            ClaimVerdict::Approximately
        );
        assert_eq!(finding(0.1).verdict(Some(0.01)), ClaimVerdict::Fails);
        assert_eq!(finding(f64::NAN).verdict(Some(1.0)), ClaimVerdict::Fails);
    }

    #[test]
    fn nothing_compared_is_nothing_found() {
        assert!(Finding::identity([], "nothing").deviation.is_nan());
        assert!(worst([]).is_nan());
        assert!(worst([1.0, f64::NAN, 2.0]).is_nan());
    }
}
