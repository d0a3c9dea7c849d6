//! Tangential springs: what they remember while their stiffness changes, and where they are stiffened.

use serde::{Deserialize, Serialize};
use std::fmt;

/// What a tangential spring remembers while its stiffness changes with the overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TangentialHistory {
    /// The displacement u: T = −k_t u, with the stiffness of the present overlap.
    Displacement,
    /// The force: dT = −k_t du, with the stiffness of the present overlap.
    Force,
    /// The displacement, reduced to u a/a₀ when the contact radius a = √δ shrinks from a₀.
    DisplacementRescaled,
    /// The force, reduced to T a/a₀ when the contact radius a = √δ shrinks from a₀.
    ForceRescaled,
}

impl TangentialHistory {
    /// Every history.
    pub const ALL: [Self; 4] = [
        Self::Displacement,
        Self::Force,
        Self::DisplacementRescaled,
        Self::ForceRescaled,
    ];

    /// Whether the force itself is remembered.
    pub const fn keeps_force(self) -> bool {
        matches!(self, Self::Force | Self::ForceRescaled)
    }

    /// Whether what is remembered is reduced when the contact radius shrinks.
    pub const fn is_rescaled(self) -> bool {
        matches!(self, Self::DisplacementRescaled | Self::ForceRescaled)
    }

    /// The name in case files and options.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Force => "force",
            Self::DisplacementRescaled => "displacement-rescaled",
            Self::ForceRescaled => "force-rescaled",
        }
    }
}

impl fmt::Display for TangentialHistory {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_str().fmt(formatter)
    }
}

/// The contacts whose tangential stiffness is multiplied by 2/(2 − δ).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TangentialStiffening {
    /// None.
    None,
    /// Those between cylinders.
    Pairs,
    /// Those with walls as well.
    Every,
}

impl TangentialStiffening {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::None, Self::Pairs, Self::Every];

    /// The name in case files and options.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Pairs => "pairs",
            Self::Every => "every",
        }
    }
}
