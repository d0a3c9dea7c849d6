//! Impacts: the motion of two bodies through one contact, without gravity (docs/theory.md, section 12).

mod closed_form;
mod integrated;

pub use integrated::{SlidingChange, integrated_impact, sliding_change};

use crate::model::{ContactLaw, DampingGrowth, Impact};
use closed_form::Oscillator;

/// The relative motion of two bodies along their normal, from the moment at which they touch. Values that the law does
/// not determine are NaN, such as those of a contact that is damped more than critically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalImpact {
    /// The largest overlap, in r.
    pub greatest_overlap: f64,
    /// Speed of separation over speed of approach.
    pub restitution: f64,
    /// Time from the touch until the force is 0 for good, in √(m/k_n).
    pub force_duration: f64,
    /// Time from the touch until the bodies no longer overlap. Bodies that never pull separate freely at its end.
    pub duration: f64,
    /// ∫ |N| dt over the effective mass, in r √(k_n/m).
    pub total_impulse: f64,
    /// |dN/dt| where the force changes from pushing to pulling, in k_n r √(k_n/m); 0 where it does not.
    pub slope_at_sign_change: f64,
}

impl NormalImpact {
    const UNKNOWN: Self = Self {
        greatest_overlap: f64::NAN,
        restitution: f64::NAN,
        force_duration: f64::NAN,
        duration: f64::NAN,
        total_impulse: f64::NAN,
        slope_at_sign_change: f64::NAN,
    };
}

/// Whether the normal motion of `impact` has a closed form: its damping ratio does not depend on the overlap.
pub fn has_closed_form(impact: &Impact) -> bool {
    let law = impact.law();
    law.damping == DampingGrowth::ConstantRatio || law.damping_normal == 0.0
}

/// Returns the normal motion of `impact`, in closed form where there is one.
pub fn normal_impact(impact: &Impact) -> NormalImpact {
    match has_closed_form(impact) {
        true => Oscillator::of(impact).impact(),
        false => integrated_impact(impact).unwrap_or(NormalImpact::UNKNOWN),
    }
}

/// Returns the power of the overlap with which damping grows.
pub fn damping_exponent(law: &ContactLaw) -> f64 {
    let steepening = law.power.value() - 1.0;
    match law.damping {
        DampingGrowth::ConstantRatio => 0.5 * steepening,
        DampingGrowth::Viscoelastic => steepening,
    }
}

/// Returns |dN/dt| of a contact with this law when its force is 0 at this overlap, while the bodies separate at this
/// speed.
///
/// There K δᵖ = c δᵃ |dδ/dt|, and the acceleration is 0.
fn slope_without_force(law: &ContactLaw, overlap: f64, speed: f64) -> f64 {
    (law.power.value() - damping_exponent(law)) * law.at(overlap).secant * speed
}
