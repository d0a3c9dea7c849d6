//! The value of one column in one row.

use serde::{Serialize, Serializer};

/// A value with all its digits, as CSV and JSON carry it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    Missing,
    Text(String),
    Integer(u64),
    Number(f64),
    Flag(bool),
}

impl Value {
    /// Returns the word of an enum variant in files, such as `floor-slip`.
    pub(crate) fn word(name: impl Serialize) -> Self {
        match serde_json::to_value(name) {
            Ok(serde_json::Value::String(word)) => Self::Text(word),
            _ => Self::Missing,
        }
    }

    /// Returns the value as CSV carries it. A spreadsheet would compute a text that begins like a formula, so that such a
    /// text begins with an apostrophe, unless it is a number.
    pub(super) fn in_csv(self) -> Self {
        match self {
            Self::Text(text) if begins_formula(&text) => Self::Text(format!("'{text}")),
            other => other,
        }
    }

    /// Formats the value for people, its numbers by `digits`.
    pub(crate) fn shown(&self, digits: fn(f64) -> String) -> String {
        match self {
            Self::Missing => "-".to_owned(),
            Self::Text(text) => text.clone(),
            Self::Integer(count) => digits(*count as f64),
            Self::Number(number) => digits(*number),
            Self::Flag(true) => "yes".to_owned(),
            Self::Flag(false) => "no".to_owned(),
        }
    }
}

/// Whether a spreadsheet would take `text` for a formula.
fn begins_formula(text: &str) -> bool {
    text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']) && text.parse::<f64>().is_err()
}

/// JSON type of the values of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ValueKind {
    Text,
    Integer,
    Number,
    Flag,
}

impl ValueKind {
    /// Returns its name in a JSON Schema.
    pub(super) fn as_str(self) -> &'static str {
        match self {
            Self::Text => "string",
            Self::Integer => "integer",
            Self::Number => "number",
            Self::Flag => "boolean",
        }
    }
}

/// A type of values whose column has one kind.
pub(crate) trait Typed: Into<Value> {
    const KIND: ValueKind;
    /// Whether a value may be missing.
    const IS_OPTIONAL: bool = false;
}

impl Typed for f64 {
    const KIND: ValueKind = ValueKind::Number;
    /// JSON has no number that is not finite.
    const IS_OPTIONAL: bool = true;
}

impl Typed for u64 {
    const KIND: ValueKind = ValueKind::Integer;
}

impl Typed for usize {
    const KIND: ValueKind = ValueKind::Integer;
}

impl Typed for bool {
    const KIND: ValueKind = ValueKind::Flag;
}

impl Typed for &str {
    const KIND: ValueKind = ValueKind::Text;
}

impl Typed for String {
    const KIND: ValueKind = ValueKind::Text;
}

/// A text that may be missing, such as the word of an enum.
impl Typed for Value {
    const KIND: ValueKind = ValueKind::Text;
    const IS_OPTIONAL: bool = true;
}

impl<T: Typed> Typed for Option<T> {
    const KIND: ValueKind = T::KIND;
    const IS_OPTIONAL: bool = true;
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Missing => serializer.serialize_none(),
            Self::Text(text) => serializer.serialize_str(text),
            Self::Integer(count) => serializer.serialize_u64(*count),
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Flag(flag) => serializer.serialize_bool(*flag),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Value {
    fn from(count: u64) -> Self {
        Self::Integer(count)
    }
}

impl From<usize> for Value {
    fn from(count: usize) -> Self {
        Self::Integer(count as u64)
    }
}

impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Missing, Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_in_csv_begins_a_formula_and_numbers_stay_numbers() {
        for hostile in [
            "=HYPERLINK(\"x\")",
            "+1+1",
            "-2+3",
            "@SUM(A1)",
            "\t=1",
            "\r=1",
            "\n=1",
            "-",
        ] {
            let expected = Value::Text(format!("'{hostile}"));
            assert_eq!(Value::from(hostile).in_csv(), expected);
        }
        for harmless in ["-0.5", "+1e-3", "1 = 1", "", "a-b", "'=1"] {
            assert_eq!(Value::from(harmless).in_csv(), Value::from(harmless));
        }
        assert_eq!(Value::from(-0.5).in_csv(), Value::from(-0.5));
    }
}
