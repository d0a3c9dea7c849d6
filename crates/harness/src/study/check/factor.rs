//! Factors by which quantities are often off, and what they mean.

use super::table::meanings;

/// Relative distance at which two numbers count as the same.
const SAME_NUMBER: f64 = 2e-3;

/// Whether `found` is `value`, to three digits.
pub(super) fn is_about(found: f64, value: f64) -> bool {
    (found - value).abs() <= SAME_NUMBER * value.abs().max(f64::MIN_POSITIVE)
}

/// Returns the meanings of a factor by which a force, a length or a stiffness is off, where m g is `weight` k_n r.
pub(super) fn of_factor(factor: f64, weight: f64) -> Vec<String> {
    let number = |name: &str| if name == "gravity" { weight } else { f64::NAN };
    meanings("", factor, 1.0, 1.0, number)
}

/// Returns the meanings of a friction `found` in place of `asked`, where `other` is that of the other contacts.
pub(super) fn of_friction(found: f64, asked: f64, other: f64) -> Vec<String> {
    meanings("friction", found, asked, other, |_| f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_factor_has_the_meanings_that_it_may_have_and_no_others() {
        let told = |factor| of_factor(factor, 0.0123).join(" ");
        assert!(told(1.0 / 0.0123).contains("unit is m g"));
        assert!(told(180.0 / PI).contains("degrees"));
        assert!(told(4.0 / 3.0 * PI).contains("sphere"));
        assert_eq!(told(1.234), "");
        // Without a weight nothing is mistaken for one.
        assert!(of_factor(7.0, f64::NAN).is_empty());
    }

    #[test]
    fn a_friction_is_told_from_its_angles() {
        let told = |found| of_friction(found, 0.3, 0.7).join(" ");
        assert!(told(libm::tan(0.3)).starts_with("tan(mu)"));
        assert!(told(libm::atan(0.3)).starts_with("atan(mu)"));
        assert!(told(0.7).contains("exchanged"));
        assert!(told(0.5).contains("mean"));
        assert!(told(0.0).contains("left out"));
        assert_eq!(told(0.44), "");
    }
}
