//! Exponent of the normal force.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Mul;

/// Exponent p of the normal force, in quarters, so that powers of an overlap take square roots alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub enum Power {
    /// p = 1.
    Linear,
    /// p = 1.25.
    FiveQuarters,
    /// p = 1.5.
    Hertz,
    /// p = 1.75.
    SevenQuarters,
    /// p = 2.
    Square,
}

impl Power {
    /// Every power, the lowest first.
    pub const ALL: [Self; 5] = [
        Self::Linear,
        Self::FiveQuarters,
        Self::Hertz,
        Self::SevenQuarters,
        Self::Square,
    ];

    /// p.
    pub const fn value(self) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::FiveQuarters => 1.25,
            Self::Hertz => 1.5,
            Self::SevenQuarters => 1.75,
            Self::Square => 2.0,
        }
    }

    /// Returns δᵖ⁻¹ for an overlap δ; `None` for p = 1, where it is 1 at any overlap.
    #[inline(always)]
    pub(crate) fn steepened<N: Copy + Mul<Output = N>>(
        self,
        overlap: N,
        root: impl Fn(N) -> N,
    ) -> Option<N> {
        match self {
            Self::Linear => None,
            Self::FiveQuarters => Some(root(root(overlap))),
            Self::Hertz => Some(root(overlap)),
            Self::SevenQuarters => {
                let half = root(overlap);
                Some(half * root(half))
            }
            Self::Square => Some(overlap),
        }
    }
}

impl TryFrom<f64> for Power {
    type Error = String;

    fn try_from(value: f64) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|power| power.value() == value);
        known.ok_or_else(|| format!("the power {value} is not 1, 1.25, 1.5, 1.75 or 2"))
    }
}

impl From<Power> for f64 {
    fn from(power: Power) -> Self {
        power.value()
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Power {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Power".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "type": "number",
            "enum": Self::ALL.map(Self::value),
            "description": "Exponent p of the normal force K δᵖ: 1, 1.25, 1.5, 1.75 or 2."
        })
    }
}

impl fmt::Display for Power {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value().fmt(formatter)
    }
}
