//! The contact law: a normal force that grows with a power of the overlap, a tangential spring, and a dashpot beside
//! each.
//!
//! At an overlap δ that shrinks at the speed v_n, with surfaces that move at v_t,
//!
//! N = K δᵖ − η_n v_n,  T = −k_t u − η_t v_t (or dT = −k_t v_t dt and damping), u̇ = v_t,
//! k_n = p K δᵖ⁻¹,  k_t = k_n/κ,
//!
//! with K = 1 for a pair and the [floor ratio](Law::floor_ratio) for walls. The paper's law has p = 1 (its "Numerical
//! results", Eqs. S1 and S2), Hertz's p = 3/2. The damping is that of one damping ratio at every overlap,
//!
//! η = −2 ln e_r √((p+1)/(2p)) √(m k/(π² + ln² e_r))
//!
//! of either stiffness k, which gives a free collision the restitution e_r whatever its speed (docs/theory.md,
//! section 11.1), or viscoelastic: it has this size at an overlap of r, and grows like the stiffness.

use super::validity::{InvalidValue, within};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::ops::Mul;

/// K of a flat floor over K of two equal cylinders in Hertz's law, where K grows with the root of the radius.
const HERTZ_FLOOR_RATIO: f64 = std::f64::consts::SQRT_2;

const FLOOR_RATIO_RANGE: (f64, f64) = (0.1, 10.0);
const FLOOR_KAPPA_RANGE: (f64, f64) = (1e-6, 1e6);

/// Exponent p of the normal force, in quarters: powers of an overlap then take square roots alone.
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

    /// δᵖ⁻¹ of an overlap δ; `None` where it is 1 at any overlap.
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

impl JsonSchema for Power {
    fn schema_name() -> Cow<'static, str> {
        "Power".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
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

/// What a tangential spring remembers while its stiffness changes with the overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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

    /// The word of case files and options.
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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

    /// The word of case files and options.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Pairs => "pairs",
            Self::Every => "every",
        }
    }
}

/// How the damping coefficients grow with the overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DampingGrowth {
    /// Like the root of the stiffness: the damping ratio, and hence the restitution, is the same at every overlap.
    #[default]
    ConstantRatio,
    /// Like the stiffness.
    Viscoelastic,
}

impl DampingGrowth {
    /// Every growth.
    pub const ALL: [Self; 2] = [Self::ConstantRatio, Self::Viscoelastic];

    /// The word of case files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::ConstantRatio => "constant-ratio",
            Self::Viscoelastic => "viscoelastic",
        }
    }

    fn is_usual(&self) -> bool {
        *self == Self::ConstantRatio
    }
}

/// How contact forces grow with the overlap, and what tangential springs remember meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "WrittenLaw")]
pub struct Law {
    /// Exponent p of the normal force K δᵖ.
    pub power: Power,
    /// What tangential springs remember.
    pub history: TangentialHistory,
    /// K of walls over K of pairs.
    pub floor_ratio: f64,
    /// Stiffness ratio k_n/k_t of walls; without it, that of pairs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub floor_kappa: Option<f64>,
    /// The contacts whose k_t is multiplied by 2/(2 − δ), the distance of undeformed centres over that at the overlap δ.
    pub tangential_stiffening: TangentialStiffening,
    /// Growth of the damping, which the quasi-static limit does not see.
    #[serde(skip_serializing_if = "DampingGrowth::is_usual")]
    pub damping: DampingGrowth,
}

/// [`Law`] as a case file spells it.
#[derive(Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
struct WrittenLaw {
    /// Exponent p of the normal force K δᵖ: 1 (linear), 1.25, 1.5 (Hertz), 1.75 or 2.
    power: Power,
    /// What tangential springs remember.
    history: TangentialHistory,
    /// K of walls over K of pairs, from 0.1 to 10; left out, it is √2 at power 1.5 and 1 otherwise.
    floor_ratio: Option<f64>,
    /// Stiffness ratio k_n/k_t of walls; left out, it is that of pairs.
    floor_kappa: Option<f64>,
    /// The contacts whose k_t is multiplied by 2/(2 − δ), the distance of undeformed centres over that at the overlap δ.
    tangential_stiffening: TangentialStiffening,
    /// Growth of the damping with the overlap.
    damping: DampingGrowth,
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

impl From<WrittenLaw> for Law {
    fn from(written: WrittenLaw) -> Self {
        let plain = Self::of_power(written.power);
        Self {
            history: written.history,
            floor_ratio: written.floor_ratio.unwrap_or(plain.floor_ratio),
            floor_kappa: written.floor_kappa,
            tangential_stiffening: written.tangential_stiffening,
            damping: written.damping,
            ..plain
        }
    }
}

impl Default for Law {
    fn default() -> Self {
        Self::LINEAR
    }
}

impl Law {
    /// The paper's: linear springs, walls as stiff as pairs.
    pub const LINEAR: Self = Self::of_power(Power::Linear);

    /// Hertz's normal force with a tangential spring that remembers the displacement, on a flat floor.
    pub const HERTZ: Self = Self::of_power(Power::Hertz);

    /// The law of a power whose springs remember the displacement, on a flat floor.
    pub const fn of_power(power: Power) -> Self {
        Self {
            power,
            history: TangentialHistory::Displacement,
            floor_ratio: match power {
                Power::Hertz => HERTZ_FLOOR_RATIO,
                _ => 1.0,
            },
            floor_kappa: None,
            tangential_stiffening: TangentialStiffening::None,
            damping: DampingGrowth::ConstantRatio,
        }
    }

    /// Whether it is the paper's in every respect.
    pub fn is_linear(&self) -> bool {
        *self == Self::LINEAR
    }

    /// Whether gravity must be applied slowly: a force is remembered while the stiffness with which it grew depends on the
    /// overlap, what is remembered is reduced whenever the overlap shrinks, or oscillations at small overlaps hardly die
    /// away.
    pub(crate) fn needs_slow_ramp(&self) -> bool {
        let steepens = self.power != Power::Linear;
        let stiffens = steepens || self.tangential_stiffening != TangentialStiffening::None;
        let dies_slowly = steepens && self.damping == DampingGrowth::Viscoelastic;
        self.history.is_rescaled() || self.history.keeps_force() && stiffens || dies_slowly
    }

    /// The contact of two cylinders at their stiffness ratio κ.
    pub(super) fn of_pairs(&self, stiffness_ratio: f64, restitution: f64) -> ContactLaw {
        let stiffens = self.tangential_stiffening != TangentialStiffening::None;
        ContactLaw::new(self, 1.0, stiffness_ratio, restitution, stiffens)
    }

    /// The contact of a cylinder and a wall, κ being the stiffness ratio of pairs.
    pub(super) fn of_walls(&self, stiffness_ratio: f64, restitution: f64) -> ContactLaw {
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

    /// The lowest ratio k_n/k_t of any contact at any overlap, κ being that of pairs.
    pub(super) fn lowest_stiffness_ratio(&self, stiffness_ratio: f64) -> f64 {
        let lowest = self
            .floor_kappa
            .map_or(stiffness_ratio, |floor| floor.min(stiffness_ratio));
        let stiffens = self.tangential_stiffening != TangentialStiffening::None;
        lowest / stiffening(stiffens, LARGEST_OVERLAP)
    }

    /// Every value in its range, or the first one that is not.
    pub(super) fn validate(&self) -> Result<(), InvalidValue> {
        let (least, most) = FLOOR_RATIO_RANGE;
        within("convention.law.floor_ratio", self.floor_ratio, least, most)?;
        let (least, most) = FLOOR_KAPPA_RANGE;
        self.floor_kappa.map_or(Ok(()), |floor| {
            within("convention.law.floor_kappa", floor, least, most)
        })
    }
}

/// The law as it is named beside numbers; nothing but its power is named where the rest is as usual.
impl fmt::Display for Law {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = match self.power {
            Power::Linear => "linear".to_owned(),
            Power::Hertz => "hertz".to_owned(),
            power => format!("power {power}"),
        };
        write!(formatter, "law {name}, {} history", self.history)?;
        write!(formatter, ", floor ratio {}", self.floor_ratio)?;
        if let Some(floor_kappa) = self.floor_kappa {
            write!(formatter, ", floor kappa {floor_kappa}")?;
        }
        match self.tangential_stiffening {
            TangentialStiffening::None => {}
            TangentialStiffening::Pairs => {
                formatter.write_str(", tangential stiffening of pairs")?
            }
            TangentialStiffening::Every => formatter.write_str(", tangential stiffening")?,
        }
        match self.damping {
            DampingGrowth::ConstantRatio => Ok(()),
            DampingGrowth::Viscoelastic => formatter.write_str(", viscoelastic damping"),
        }
    }
}

/// The largest overlap for which time steps are stable, in r: no path of equilibria comes near to it.
const LARGEST_OVERLAP: f64 = 1.0;

/// The factor 2/(2 − δ) of tangential stiffness, or 1.
fn stiffening(stiffens: bool, overlap: f64) -> f64 {
    match stiffens {
        true => 2.0 / (2.0 - overlap),
        false => 1.0,
    }
}

/// The law of one kind of contact. Its coefficients are those at an overlap of r without stiffening, under the names by
/// which decks read them; those of the linear law hold at any overlap.
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
    /// N/δ of the spring: k_n of the linear law.
    pub secant: N,
    /// k_t.
    pub tangential_stiffness: N,
    /// η_n.
    pub damping_normal: N,
    /// η_t.
    pub damping_tangential: N,
}

impl<N> ContactLaw<N> {
    /// The same coefficients as other numbers.
    pub(crate) fn map<M>(self, mut number: impl FnMut(N) -> M) -> ContactLaw<M> {
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

impl<N: Copy + Mul<Output = N>> ContactLaw<N> {
    /// The coefficients at an overlap; `root` is the square root, and `stiffening` is 2/(2 − δ) at that overlap.
    #[inline(always)]
    pub(crate) fn coefficients(
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
            // The surfaces count as moving so many times as far, for the dashpot as for the spring.
            own.damping_tangential = own.damping_tangential * factor;
        }
        own
    }
}

impl ContactLaw {
    /// A contact whose normal force is K δᵖ, of stiffness ratio κ and restitution e_r.
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
    pub(super) fn highest_stiffness(&self) -> f64 {
        self.stiffness(LARGEST_OVERLAP)
    }

    /// Stiffness and damping at an overlap. Of a negative overlap, which trial steps of the theory meet, they are those
    /// of the same overlap with the other sign.
    pub(crate) fn at(&self, overlap: f64) -> ContactCoefficients {
        self.coefficients(overlap.abs(), f64::sqrt, |overlap| 2.0 / (2.0 - overlap))
    }

    /// The normal force at an overlap, which has the sign of the overlap.
    pub(crate) fn force(&self, overlap: f64) -> f64 {
        self.at(overlap).secant * overlap
    }

    /// The overlap at a normal force, which has the sign of the force.
    pub(crate) fn overlap(&self, force: f64) -> f64 {
        let ratio = force / self.normal_stiffness;
        match self.power {
            Power::Linear => ratio,
            power => libm::pow(ratio.abs(), power.value().recip()).copysign(ratio),
        }
    }

    /// dN/dδ at an overlap.
    pub(crate) fn stiffness(&self, overlap: f64) -> f64 {
        self.power.value() * self.at(overlap).secant
    }

    /// k_t at an overlap without stiffening, which it has to first order in small overlaps.
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

fn damping(stiffness: f64, restitution: f64, power: f64) -> f64 {
    let log = libm::log(restitution);
    let pi = std::f64::consts::PI;
    let of_power = ((power + 1.0) / (2.0 * power)).sqrt();
    of_power * (2.0 * log.abs() * (stiffness / (pi * pi + log * log)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::PAPER_RESTITUTION;

    fn linear(restitution: f64) -> ContactLaw {
        Law::LINEAR.of_pairs(2.5, restitution)
    }

    #[test]
    fn damping_gives_the_restitution_it_is_named_after() {
        // Half an oscillation of a unit mass on a unit spring with damping η keeps the fraction
        // exp(−π ζ/√(1 − ζ²)) of its speed, ζ = η/2.
        let ratio = linear(PAPER_RESTITUTION).damping_normal / 2.0;
        let kept = libm::exp(-std::f64::consts::PI * ratio / (1.0 - ratio * ratio).sqrt());
        assert!((kept - PAPER_RESTITUTION).abs() < 1e-15);
    }

    #[test]
    fn an_elastic_collision_is_not_damped() {
        assert_eq!(linear(1.0).damping_normal.to_bits(), 0);
    }

    /// Restitution of a unit mass that meets the spring at `speed`, by Runge's and Kutta's method in so many steps.
    fn restitution(law: &ContactLaw, speed: f64, step: f64) -> f64 {
        let rate = |[overlap, speed]: [f64; 2]| {
            let own = law.at(overlap.max(0.0));
            [speed, -own.secant * overlap - own.damping_normal * speed]
        };
        let moved = |from: [f64; 2], by: f64, rate: [f64; 2]| {
            [from[0] + by * rate[0], from[1] + by * rate[1]]
        };
        let mut state = [0.0, speed];
        loop {
            let first = rate(state);
            let second = rate(moved(state, 0.5 * step, first));
            let third = rate(moved(state, 0.5 * step, second));
            let fourth = rate(moved(state, step, third));
            let mean: [f64; 2] = std::array::from_fn(|index| {
                (first[index] + 2.0 * (second[index] + third[index]) + fourth[index]) / 6.0
            });
            let next = moved(state, step, mean);
            if next[0] <= 0.0 {
                return -state[1] / speed;
            }
            state = next;
        }
    }

    #[test]
    fn a_free_collision_has_the_same_restitution_at_every_power_and_speed() {
        for power in Power::ALL {
            for law in [
                Law::of_power(power).of_pairs(2.5, 0.7),
                Law::of_power(power).of_walls(2.5, 0.7),
            ] {
                for speed in [1e-3, 0.1] {
                    // The contact ends within the last step, in which the speed changes by a few times the step.
                    let found = restitution(&law, speed, 1e-4);
                    assert!((found - 0.7).abs() < 1e-3, "{power} {speed} {found}");
                }
            }
        }
    }

    #[test]
    fn force_overlap_and_stiffness_belong_together_at_every_power() {
        // Each side has at most five operations, a power among them.
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
                // The difference is off by width²/6 times the third derivative, at most 250.
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

    #[test]
    fn what_a_file_leaves_out_depends_on_the_power() {
        let read = |text: &str| toml::from_str::<Law>(text);
        assert_eq!(read("").unwrap(), Law::LINEAR);
        assert_eq!(read("power = 1.5").unwrap(), Law::HERTZ);
        let written =
            read("power = 2\nhistory = \"force-rescaled\"\nfloor_kappa = 3.0\nfloor_ratio = 1.2")
                .unwrap();
        assert_eq!(written.power, Power::Square);
        assert_eq!(written.history, TangentialHistory::ForceRescaled);
        assert_eq!((written.floor_ratio, written.floor_kappa), (1.2, Some(3.0)));
        let again: Law = toml::from_str(&toml::to_string(&written).unwrap()).unwrap();
        assert_eq!(again, written);
        for (text, part) in [
            (
                "power = 1.4",
                "the power 1.4 is not 1, 1.25, 1.5, 1.75 or 2",
            ),
            ("histroy = \"force\"", "unknown field `histroy`"),
        ] {
            let message = read(text).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn a_law_is_named_with_everything_that_it_changes() {
        assert_eq!(
            Law {
                floor_ratio: 1.5,
                ..Law::HERTZ
            }
            .to_string(),
            "law hertz, displacement history, floor ratio 1.5"
        );
        let law = Law {
            power: Power::FiveQuarters,
            history: TangentialHistory::Force,
            floor_ratio: 1.0,
            floor_kappa: Some(2.0),
            tangential_stiffening: TangentialStiffening::Every,
            damping: DampingGrowth::Viscoelastic,
        };
        let shown = law.to_string();
        assert!(shown.starts_with("law power 1.25, force history, floor ratio 1, floor kappa 2"));
        assert!(shown.ends_with("tangential stiffening, viscoelastic damping"));
    }

    #[test]
    fn values_out_of_range_name_their_key() {
        let key = |law: Law| law.validate().unwrap_err().key;
        let soft = Law {
            floor_ratio: 0.0,
            ..Law::HERTZ
        };
        let stiff = Law {
            floor_kappa: Some(0.0),
            ..Law::HERTZ
        };
        assert_eq!(key(soft), "convention.law.floor_ratio");
        assert_eq!(key(stiff), "convention.law.floor_kappa");
        assert_eq!(Law::HERTZ.validate(), Ok(()));
    }
}
