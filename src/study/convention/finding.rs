//! A property of a code, as measured and as declared, and the verdict on it.

use super::experiments::ContactKind;
use super::regression::Measured;
use crate::code::Code;
use crate::study::Verdict;

/// Largest deviation of an external code that agrees, relative to the declared value (to 1 where that is 0): a tenth of
/// the largest tolerance for yield forces, and a thousand times the largest deviation of the known codes.
pub const TOLERANCE: f64 = 1e-6;

/// The same for the native code, which deviates from its declaration by rounding alone.
pub const NATIVE_TOLERANCE: f64 = 1e-9;

/// A property of one code, measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// The code.
    pub code: Code,
    /// Version of the code.
    pub version: String,
    /// Name of the property.
    pub property: String,
    /// Measured value; absent if the measurement failed.
    pub measured: Option<f64>,
    /// Three standard errors; absent with the measured value.
    pub uncertainty: Option<f64>,
    /// Declared value.
    pub declared: f64,
    /// Whether the two agree.
    pub verdict: Verdict,
}

/// A property as measured and as declared.
#[derive(Debug, Clone, PartialEq)]
pub struct Property {
    /// Name, which begins with the kind of contact if it belongs to one.
    pub name: String,
    /// As measured.
    pub measured: Measured,
    /// As declared.
    pub declared: f64,
}

impl Property {
    /// A property of the whole code.
    pub fn new(name: &str, measured: Measured, declared: f64) -> Self {
        Self {
            name: name.to_owned(),
            measured,
            declared,
        }
    }

    /// A property of the contacts at `kind`.
    pub fn at(kind: ContactKind, name: &str, measured: Measured, declared: f64) -> Self {
        Self::new(&format!("{}_{name}", kind.as_str()), measured, declared)
    }

    /// The finding on `code`.
    pub fn judge(self, code: Code, version: &str) -> Finding {
        let scale = match self.declared {
            0.0 => 1.0,
            declared => declared.abs(),
        };
        let relative = match code {
            Code::NATIVE => NATIVE_TOLERANCE,
            _ => TOLERANCE,
        };
        let Measured { value, uncertainty } = self.measured;
        let known = value.is_finite() && uncertainty.is_finite();
        Finding {
            code,
            version: version.to_owned(),
            property: self.name,
            measured: known.then_some(value),
            uncertainty: known.then_some(uncertainty),
            declared: self.declared,
            verdict: Verdict::of(value - self.declared, uncertainty, relative * scale),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_declared_value_has_a_tolerance_of_its_own() {
        let verdict = |measured: f64, declared: f64| {
            let property = Property::new("damping", Measured::new(measured, 0.0), declared);
            property.judge(Code::named("yade").unwrap(), "").verdict
        };
        assert_eq!(verdict(0.067 * (1.0 + 0.9e-6), 0.067), Verdict::Agrees);
        assert_eq!(verdict(0.067 * (1.0 + 1.1e-6), 0.067), Verdict::Differs);
        assert_eq!(verdict(0.9e-6, 0.0), Verdict::Agrees);
        assert_eq!(verdict(1.1e-6, 0.0), Verdict::Differs);
    }
}
