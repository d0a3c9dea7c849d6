//! The law of one kind of contact: its forces, stiffness and damping at an overlap.

use super::chosen::Law;
use super::damping::{DampingGrowth, damping};
use super::power::Power;
use super::tangential::{TangentialHistory, TangentialStiffening};
use serde::Serialize;
use std::ops::Mul;

/// The largest overlap for which time steps are stable, in r: no path of equilibria comes near to it.
const LARGEST_OVERLAP: f64 = 1.0;

/// The factor 2/(2 − δ) on the tangential stiffness, or 1.
fn stiffening(stiffens: bool, overlap: f64) -> f64 {
    match stiffens {
        true => 2.0 / (2.0 - overlap),
        false => 1.0,
    }
}

impl Law {
    /// The contact of two cylinders at their stiffness ratio κ.
    pub(in crate::model) fn of_pairs(&self, stiffness_ratio: f64, restitution: f64) -> ContactLaw {
        let stiffens = self.tangential_stiffening != TangentialStiffening::None;
        ContactLaw::new(self, 1.0, stiffness_ratio, restitution, stiffens)
    }

    /// The contact of a cylinder and a wall, where κ is the stiffness ratio of pairs.
    pub(in crate::model) fn of_walls(&self, stiffness_ratio: f64, restitution: f64) -> ContactLaw {
        let stiffness_ratio = self.floor_kappa.unwrap_or(stiffness_ratio);
        let stiffens = self.tangential_stiffening == TangentialStiffening::Every;
        ContactLaw::new(
            self,
            self.floor_ratio,
            stiffness_ratio,
            restitution,
            stiffens,
        )
    }

    /// The lowest ratio k_n/k_t of any contact at any overlap, where κ is the ratio of pairs.
    pub(in crate::model) fn lowest_stiffness_ratio(&self, stiffness_ratio: f64) -> f64 {
        let lowest = self
            .floor_kappa
            .map_or(stiffness_ratio, |floor| floor.min(stiffness_ratio));
        let stiffens = self.tangential_stiffening != TangentialStiffening::None;
        lowest / stiffening(stiffens, LARGEST_OVERLAP)
    }
}

/// The law of one kind of contact. Its coefficients are those at an overlap of r, without stiffening, under the names
/// that decks use; those of the linear law hold at any overlap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ContactLaw<N = f64> {
    /// K.
    pub normal_stiffness: N,
    /// k_t.
    pub tangential_stiffness: N,
    /// η_n.
    pub damping_normal: N,
    /// η_t.
    pub damping_tangential: N,
    /// p.
    #[serde(skip)]
    pub power: Power,
    /// Whether k_t and η_t are multiplied by 2/(2 − δ).
    #[serde(skip)]
    pub stiffens: bool,
    /// Growth of η_n and η_t.
    #[serde(skip)]
    pub damping: DampingGrowth,
    /// What the tangential spring remembers.
    #[serde(skip)]
    pub history: TangentialHistory,
}

/// Stiffness and damping of a contact at one overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactCoefficients<N = f64> {
    /// N/δ of the spring, which is k_n in the linear law.
    pub secant: N,
    /// k_t.
    pub tangential_stiffness: N,
    /// η_n.
    pub damping_normal: N,
    /// η_t.
    pub damping_tangential: N,
}

impl<N> ContactLaw<N> {
    /// Converts every coefficient with `number`.
    pub fn map<M>(self, mut number: impl FnMut(N) -> M) -> ContactLaw<M> {
        ContactLaw {
            normal_stiffness: number(self.normal_stiffness),
            tangential_stiffness: number(self.tangential_stiffness),
            damping_normal: number(self.damping_normal),
            damping_tangential: number(self.damping_tangential),
            power: self.power,
            stiffens: self.stiffens,
            damping: self.damping,
            history: self.history,
        }
    }
}

impl ContactCoefficients {
    /// The normal force of spring and dashpot, positive in compression, at this `overlap` while it grows at the speed
    /// `approach`.
    pub fn normal_force(&self, overlap: f64, approach: f64) -> f64 {
        self.secant * overlap + self.damping_normal * approach
    }
}

impl<N: Copy + Mul<Output = N>> ContactLaw<N> {
    /// Returns the coefficients at an overlap; `root` computes the square root, and `stiffening` computes 2/(2 − δ).
    #[inline(always)]
    pub fn coefficients(
        &self,
        overlap: N,
        root: impl Fn(N) -> N,
        stiffening: impl Fn(N) -> N,
    ) -> ContactCoefficients<N> {
        let mut own = ContactCoefficients {
            secant: self.normal_stiffness,
            tangential_stiffness: self.tangential_stiffness,
            damping_normal: self.damping_normal,
            damping_tangential: self.damping_tangential,
        };
        if let Some(factor) = self.power.steepened(overlap, &root) {
            let growth = match self.damping {
                DampingGrowth::ConstantRatio => root(factor),
                DampingGrowth::Viscoelastic => factor,
            };
            own.secant = own.secant * factor;
            own.tangential_stiffness = own.tangential_stiffness * factor;
            own.damping_normal = own.damping_normal * growth;
            own.damping_tangential = own.damping_tangential * growth;
        }
        if self.stiffens {
            let factor = stiffening(overlap);
            own.tangential_stiffness = own.tangential_stiffness * factor;
            // The surface displacement is multiplied by this factor, for the dashpot as for the spring.
            own.damping_tangential = own.damping_tangential * factor;
        }
        own
    }
}

impl ContactLaw {
    /// A contact with the normal force K δᵖ, where K is `scale`, the stiffness ratio κ and the restitution e_r.
    fn new(law: &Law, scale: f64, stiffness_ratio: f64, restitution: f64, stiffens: bool) -> Self {
        let power = law.power.value();
        let stiffness = power * scale;
        let tangential_stiffness = stiffness / stiffness_ratio;
        let damping = |stiffness| damping(stiffness, restitution, power);
        Self {
            normal_stiffness: scale,
            tangential_stiffness,
            damping_normal: damping(stiffness),
            damping_tangential: damping(tangential_stiffness),
            power: law.power,
            stiffens,
            damping: law.damping,
            history: law.history,
        }
    }

    /// The largest slope of the normal force up to an overlap of r.
    pub(in crate::model) fn highest_stiffness(&self) -> f64 {
        self.stiffness(LARGEST_OVERLAP)
    }

    /// Stiffness and damping at an overlap. A negative overlap, which occurs in trial steps of the theory, counts as
    /// its absolute value.
    pub fn at(&self, overlap: f64) -> ContactCoefficients {
        self.coefficients(overlap.abs(), f64::sqrt, |overlap| 2.0 / (2.0 - overlap))
    }

    /// The normal force at an overlap, with the sign of the overlap.
    pub fn force(&self, overlap: f64) -> f64 {
        self.at(overlap).secant * overlap
    }

    /// The overlap at a normal force, with the sign of the force.
    pub fn overlap(&self, force: f64) -> f64 {
        let ratio = force / self.normal_stiffness;
        match self.power {
            Power::Linear => ratio,
            power => libm::pow(ratio.abs(), power.value().recip()).copysign(ratio),
        }
    }

    /// dN/dδ at an overlap.
    pub fn stiffness(&self, overlap: f64) -> f64 {
        self.power.value() * self.at(overlap).secant
    }

    /// η/k at a normal force, in √(m/k_n); the smaller one of the normal and the tangential direction. An oscillation of
    /// frequency ω decays at ω²/2 times this or faster, less the time by which forces are late.
    pub fn damping_time(&self, force: f64) -> f64 {
        let overlap = self.overlap(force);
        let own = self.at(overlap);
        let normal = own.damping_normal / self.stiffness(overlap);
        normal.min(own.damping_tangential / own.tangential_stiffness)
    }

    /// k_t at an overlap without stiffening, which is k_t to first order in small overlaps.
    pub(crate) fn unstiffened(&self, overlap: f64) -> f64 {
        let plain = Self {
            stiffens: false,
            ..*self
        };
        plain.at(overlap).tangential_stiffness
    }

    /// d ln k_t/dδ at an overlap.
    pub(crate) fn tangential_steepening(&self, overlap: f64) -> f64 {
        let of_power = match self.power {
            Power::Linear => 0.0,
            power => (power.value() - 1.0) / overlap,
        };
        match self.stiffens {
            true => of_power + 1.0 / (2.0 - overlap),
            false => of_power,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn force_overlap_and_stiffness_belong_together_at_every_power() {
        // Each side takes at most five operations, one of them a power.
        const ROUNDED: f64 = 8.0 * f64::EPSILON;
        for power in Power::ALL {
            let law = Law {
                floor_ratio: 1.7,
                ..Law::of_power(power)
            };
            let law = law.of_walls(2.5, 0.7);
            for overlap in [1e-6, 0.03, 0.4] {
                let force = law.force(overlap);
                let direct = 1.7 * libm::pow(overlap, power.value());
                assert!((force / direct - 1.0).abs() < ROUNDED, "{power}");
                assert!((law.overlap(force) / overlap - 1.0).abs() < ROUNDED);
                let slope = power.value() * force / overlap;
                assert!((law.stiffness(overlap) / slope - 1.0).abs() < ROUNDED);
                let tangential = law.at(overlap).tangential_stiffness;
                assert!((tangential * 2.5 / slope - 1.0).abs() < ROUNDED);
                assert_eq!(law.force(-overlap), -force);
                assert_eq!(law.overlap(-force), -law.overlap(force));
            }
        }
    }

    #[test]
    fn steepening_is_the_logarithmic_slope_of_the_tangential_stiffness() {
        for power in Power::ALL {
            for tangential_stiffening in TangentialStiffening::ALL {
                let law = Law {
                    tangential_stiffening,
                    ..Law::of_power(power)
                };
                let law = law.of_pairs(1.3, 0.7);
                let log = |overlap: f64| libm::log(law.at(overlap).tangential_stiffness);
                let (overlap, width) = (0.2, 1e-5);
                let slope = (log(overlap + width) - log(overlap - width)) / (2.0 * width);
                // The error of the difference is width²/6 times the third derivative, which is at most 250.
                assert!((law.tangential_steepening(overlap) - slope).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn a_floor_may_have_another_stiffness_and_another_ratio() {
        let law = Law {
            floor_kappa: Some(0.5),
            ..Law::HERTZ
        };
        let [pair, floor] = [law.of_pairs(2.0, 0.7), law.of_walls(2.0, 0.7)];
        assert_eq!(
            (pair.normal_stiffness, pair.tangential_stiffness),
            (1.0, 0.75)
        );
        assert_eq!(floor.normal_stiffness, std::f64::consts::SQRT_2);
        assert_eq!(floor.tangential_stiffness, 3.0 * floor.normal_stiffness);
        assert_eq!(law.lowest_stiffness_ratio(2.0), 0.5);
        let stiffened = Law {
            tangential_stiffening: TangentialStiffening::Every,
            ..law
        };
        assert_eq!(stiffened.lowest_stiffness_ratio(0.4), 0.2);
    }
}
