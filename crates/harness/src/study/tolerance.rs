//! The largest error at which a yield force agrees.

/// Root mean square of one rounding, in units of the last place: 1/√12.
pub(crate) const ROUNDING: f64 = 0.288_675_134_594_812_9;

/// Smallest tolerance, relative to the load on the floor, which is F + 3 for cylinders: the guaranteed accuracy of the
/// limit itself for arbitrary torque arms (crates/theory/tests/theory/golden.rs).
pub const MIN_TOLERANCE: f64 = 1e-7;

/// Largest tolerance, relative to the load on the floor, unless the user accepts a larger one: agreement between independent
/// codes is worth the name at 1e-5. An uncertainty above it decides nothing.
pub const MAX_TOLERANCE: f64 = 1e-5;

/// Resolutions that can be accepted: a yield force that is known to a tenth of the load says little enough.
pub const RESOLUTIONS: std::ops::RangeInclusive<f64> = MAX_TOLERANCE..=0.1;

/// The tolerance for an uncertainty, both relative to the load on the floor: the uncertainty itself, but at least
/// [`MIN_TOLERANCE`] and at most the `largest` that is accepted.
pub fn tolerance(uncertainty: f64, largest: f64) -> f64 {
    uncertainty.clamp(MIN_TOLERANCE, largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::{Grounds, Verdict};

    /// The verdict on an error with its uncertainty, both relative to the load on the floor.
    fn judge(error: f64, uncertainty: f64) -> Verdict {
        let mut grounds = Grounds::new();
        let allowed = tolerance(uncertainty, MAX_TOLERANCE);
        grounds.compare(error, uncertainty, allowed, None);
        grounds.verdict()
    }

    #[test]
    fn a_small_error_agrees_and_a_large_one_differs() {
        assert_eq!(judge(9e-8, 1e-8), Verdict::Agrees);
        assert_eq!(judge(-1.1e-7, 1e-8), Verdict::Differs);
    }

    #[test]
    fn tolerance_follows_the_uncertainty_between_its_bounds() {
        assert_eq!(judge(4e-6, 5e-6), Verdict::Agrees);
        assert_eq!(judge(6e-6, 5e-6), Verdict::Differs);
    }

    #[test]
    fn an_uncertainty_above_the_largest_tolerance_decides_only_against_large_errors() {
        assert_eq!(judge(1e-7, 2e-5), Verdict::Inconclusive);
        assert_eq!(judge(1e-3, 2e-5), Verdict::Differs);
    }

    #[test]
    fn not_a_number_is_never_a_pass() {
        assert_eq!(judge(f64::NAN, 1e-8), Verdict::Inconclusive);
        assert_eq!(judge(1e-8, f64::NAN), Verdict::Inconclusive);
    }
}
