//! Formats of numbers for people.

use crate::model::{CRITICAL_FRICTION, exact};
use crate::paper::claims::scientific;

/// The name of the critical friction.
pub(crate) const CRITICAL: &str = "mu_c";

/// Formats `value` with `digits` significant digits, in plain notation where that is short.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let exponent = libm::floor(libm::log10(value.abs())) as i32;
    let decimals = digits as i32 - 1 - exponent;
    if (-5..7).contains(&exponent) && decimals >= 0 {
        format!("{value:.*}", decimals as usize)
    } else {
        format!("{value:.*e}", digits - 1)
    }
}

/// Formats `value` with `N` significant digits.
pub(crate) fn digits<const N: usize>(value: f64) -> String {
    significant(value, N)
}

/// Rounds `value` to four significant digits, in the shorter notation.
pub(crate) fn rounded(value: f64) -> String {
    let value: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() {
        scientific
    } else {
        plain
    }
}

/// Rounds `value` to three significant digits, in plain notation without trailing zeros.
pub(crate) fn plain(value: f64) -> String {
    let value: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    value.to_string()
}

/// Formats a relative deviation: sign, two digits, exponent.
pub(crate) fn relative(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    format!("{value:+.1e}")
}

/// Formats a friction coefficient; the critical one by its name.
pub fn friction(value: f64) -> String {
    if value == CRITICAL_FRICTION {
        CRITICAL.to_owned()
    } else {
        exact(value)
    }
}

/// Formats a friction coefficient as TeX; the critical one by its name.
pub(crate) fn friction_in_tex(value: f64) -> String {
    friction(value).replace(CRITICAL, "\\mu_c")
}

/// Formats a stiffness as TeX; powers of ten from 10^5 on by their exponent.
pub(crate) fn stiffness_in_tex(value: f64) -> String {
    match value >= 1e5 && exact(value).trim_end_matches('0') == "1" {
        true => scientific(value, 0),
        false => exact(value),
    }
}

/// Formats a deviation as TeX, with one digit and a power of ten.
pub(crate) fn power_of_ten(value: f64) -> String {
    format!("${}$", scientific(value, 0))
}

/// Formats a small distance: two digits and an exponent.
pub(crate) fn small(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    format!("{value:.1e}")
}

/// Formats an uncertainty: one digit and an exponent.
pub(crate) fn one_digit(value: f64) -> String {
    format!("{value:.0e}")
}

/// Formats a fraction in percent, with its sign.
pub(crate) fn percent(value: f64) -> String {
    format!("{:+.2} %", 100.0 * value)
}

/// Returns `text`, or a dash if it is empty.
pub(crate) fn or_dash(text: &str) -> String {
    if text.is_empty() { "-" } else { text }.to_owned()
}

/// Formats a value, or returns a dash if it is absent.
pub(crate) fn optional<T>(value: Option<T>, format: impl FnOnce(T) -> String) -> String {
    value.map_or_else(|| "-".to_owned(), format)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_significant_ones() {
        assert_eq!(significant(2124.669922154, 8), "2124.6699");
        assert_eq!(significant(0.59912362, 6), "0.599124");
        assert_eq!(significant(3.2e-9, 2), "3.2e-9");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(rounded(1e6), "1e6");
        assert_eq!(rounded(0.020_000_1), "0.02");
        assert_eq!(rounded(435.6891), "435.7");
        assert_eq!(exact(1e-300), "1e-300");
        assert_eq!(exact(0.300_000_000_000_000_04), "0.30000000000000004");
        assert_eq!(power_of_ten(1e-7), "$10^{-7}$");
        assert_eq!(power_of_ten(-5.7e-8), "$-6\\times10^{-8}$");
        assert_eq!(stiffness_in_tex(1e6), "10^6");
        assert_eq!(stiffness_in_tex(1e3), "1000");
        assert_eq!(stiffness_in_tex(2e6), "2000000");
        assert_eq!(plain(2283.4), "2280");
        assert_eq!(plain(8.6399), "8.64");
    }
}
