//! How the coefficients of a contact grow with its overlap, and what its tangential spring remembers meanwhile.

use super::contact_frame::ContactRow;

/// Growth of a coefficient: its ratio to that at an overlap of 1 is δᵉ (2/(2 − δ))ˢ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// e.
    pub exponent: f64,
    /// s: 1 where the motion of the surfaces is scaled by the distance of undeformed centres over that at the overlap.
    pub stiffening: f64,
}

impl Growth {
    /// The growth of a constant.
    pub const NONE: Self = Self {
        exponent: 0.0,
        stiffening: 0.0,
    };

    /// δᵉ (2/(2 − δ))ˢ.
    pub fn at(self, overlap: f64) -> f64 {
        let power = libm::pow(overlap, self.exponent);
        power * libm::pow(2.0 / (2.0 - overlap), self.stiffening)
    }
}

/// What a spring remembers while its stiffness k_t changes: k_tᶠ u, which is its displacement at f = 0 and its force at
/// f = 1. Where the overlap shrinks from δ₀ to δ, that is multiplied by (δ/δ₀)^(g/2), the ratio of the contact radii to
/// the power of g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Memory {
    /// f.
    pub force_share: f64,
    /// g.
    pub rescaling: f64,
}

impl Memory {
    /// The displacement, whatever the overlap does.
    pub const DISPLACEMENT: Self = Self {
        force_share: 0.0,
        rescaling: 0.0,
    };

    /// Every memory that codes have: displacement or force, rescaled or not.
    pub const KNOWN: [Self; 4] = [
        Self::DISPLACEMENT,
        Self::new(1.0, 0.0),
        Self::new(0.0, 1.0),
        Self::new(1.0, 1.0),
    ];

    /// The memory with this force share and this rescaling.
    pub const fn new(force_share: f64, rescaling: f64) -> Self {
        Self {
            force_share,
            rescaling,
        }
    }

    /// The factor by which a change of the overlap between two rows changes what is remembered.
    pub fn rescaled(self, before: &ContactRow, row: &ContactRow) -> f64 {
        match row.overlap < before.overlap {
            true => libm::pow(row.overlap / before.overlap, 0.5 * self.rescaling),
            false => 1.0,
        }
    }
}
