//! Checks of single values, with errors that say which key, which value and what is accepted.

use thiserror::Error;

/// The error of a value outside its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{key}` is {value}, but must be {accepted}")]
pub struct InvalidValue {
    /// Key in the case file, or flag on the command line.
    pub key: String,
    /// The value as given.
    pub value: String,
    /// The accepted values.
    pub accepted: String,
}

impl InvalidValue {
    /// An error for `key` with the `value` given and a description of what is `accepted`.
    pub fn new(key: &str, value: f64, accepted: impl Into<String>) -> Self {
        Self {
            key: key.to_owned(),
            value: short(value),
            accepted: accepted.into(),
        }
    }
}

/// Checks that `value` is finite and within `[lowest, highest]`.
pub fn within(key: &str, value: f64, lowest: f64, highest: f64) -> Result<(), InvalidValue> {
    if (lowest..=highest).contains(&value) {
        return Ok(());
    }
    let accepted = format!("a number from {} to {}", short(lowest), short(highest));
    Err(InvalidValue::new(key, value, accepted))
}

/// Checks that `value` is finite, above zero and at most `highest`.
pub fn positive(key: &str, value: f64, highest: f64) -> Result<(), InvalidValue> {
    if value > 0.0 && value <= highest {
        return Ok(());
    }
    let accepted = format!("a number above 0, at most {}", short(highest));
    Err(InvalidValue::new(key, value, accepted))
}

/// Formats `value` with every digit: in plain notation up to 24 characters, which is enough for any number that is
/// neither large nor small, and in scientific notation beyond.
pub fn exact(value: f64) -> String {
    const LONGEST: usize = 24;
    let plain = value.to_string();
    if plain.len() > LONGEST {
        format!("{value:e}")
    } else {
        plain
    }
}

/// Formats `value` in plain or scientific notation, whichever is shorter.
fn short(value: f64) -> String {
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() {
        scientific
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_is_out_of_every_range() {
        assert!(within("x", f64::NAN, 0.0, 1.0).is_err());
        assert!(positive("x", f64::NAN, 1.0).is_err());
        assert!(positive("x", f64::INFINITY, 1.0).is_err());
    }

    #[test]
    fn the_message_names_key_value_and_range() {
        let error = positive("stack.stiffness", -3.0, 1e8).unwrap_err();
        assert_eq!(
            error.to_string(),
            "`stack.stiffness` is -3, but must be a number above 0, at most 1e8"
        );
    }
}
