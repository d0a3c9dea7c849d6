//! The contact law as a case file spells it.

use super::damping::DampingGrowth;
use super::power::Power;
use super::tangential::{TangentialHistory, TangentialStiffening};
use serde::Deserialize;

/// [`super::Law`] as a case file spells it.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(
    default,
    deny_unknown_fields,
    expecting = "a table of its numbers, such as { power = 1.5 } for Hertz contacts"
)]
pub(super) struct WrittenLaw {
    /// Exponent p of the normal force K δᵖ: 1 (linear), 1.25, 1.5 (Hertz), 1.75 or 2.
    pub(super) power: Power,
    /// What tangential springs remember.
    pub(super) history: TangentialHistory,
    /// K of walls over K of pairs, from 0.1 to 10; left out, it is √2 at power 1.5 and 1 otherwise.
    pub(super) floor_ratio: Option<f64>,
    /// Stiffness ratio k_n/k_t of walls; left out, it is that of pairs.
    pub(super) floor_kappa: Option<f64>,
    /// The contacts whose k_t is multiplied by 2/(2 − δ), the distance of undeformed centres over that at the overlap δ.
    pub(super) tangential_stiffening: TangentialStiffening,
    /// Growth of the damping with the overlap.
    pub(super) damping: DampingGrowth,
}

impl Default for WrittenLaw {
    fn default() -> Self {
        Self {
            power: Power::Linear,
            history: TangentialHistory::Displacement,
            floor_ratio: None,
            floor_kappa: None,
            tangential_stiffening: TangentialStiffening::None,
            damping: DampingGrowth::ConstantRatio,
        }
    }
}
