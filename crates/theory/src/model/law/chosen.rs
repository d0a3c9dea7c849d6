//! The law that a case can choose.

use super::damping::DampingGrowth;
use super::power::Power;
use super::tangential::{TangentialHistory, TangentialStiffening};
use super::written::WrittenLaw;
use crate::model::validity::{InvalidValue, within};
use serde::{Deserialize, Serialize};
use std::fmt;

/// K of a flat floor over K of two equal cylinders in Hertz's law, where K grows with the root of the radius.
const HERTZ_FLOOR_RATIO: f64 = std::f64::consts::SQRT_2;

const FLOOR_RATIO_RANGE: (f64, f64) = (0.1, 10.0);
const FLOOR_KAPPA_RANGE: (f64, f64) = (1e-6, 1e6);

/// How contact forces grow with the overlap, and what tangential springs remember meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// The paper's law: linear springs, walls as stiff as pairs.
    pub const LINEAR: Self = Self::of_power(Power::Linear);

    /// Hertz's normal force on a flat floor, with a tangential spring that remembers the displacement.
    pub const HERTZ: Self = Self::of_power(Power::Hertz);

    /// The law of this power on a flat floor, with springs that remember the displacement.
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

    /// Whether the law is the paper's in every respect.
    pub fn is_linear(&self) -> bool {
        *self == Self::LINEAR
    }

    /// Whether gravity must be applied slowly. This is so if springs remember a force whose stiffness depends on the
    /// overlap, if what they remember is reduced whenever the overlap shrinks, or if oscillations at small overlaps
    /// hardly die away.
    pub fn needs_slow_ramp(&self) -> bool {
        let steepens = self.power != Power::Linear;
        let stiffens = steepens || self.tangential_stiffening != TangentialStiffening::None;
        let dies_slowly = steepens && self.damping == DampingGrowth::Viscoelastic;
        self.history.is_rescaled() || self.history.keeps_force() && stiffens || dies_slowly
    }

    /// Checks every value; the error names the first that is out of range.
    pub(in crate::model) fn validate(&self) -> Result<(), InvalidValue> {
        let (least, most) = FLOOR_RATIO_RANGE;
        within("convention.law.floor_ratio", self.floor_ratio, least, most)?;
        let (least, most) = FLOOR_KAPPA_RANGE;
        self.floor_kappa.map_or(Ok(()), |floor| {
            within("convention.law.floor_kappa", floor, least, most)
        })
    }
}

/// Writes the law as it appears beside numbers: power, history and floor ratio, and the other values where they are
/// not the usual ones.
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

#[cfg(test)]
mod tests {
    use super::*;

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
    fn every_key_of_a_file_is_a_part_of_the_law() {
        let text = "power = 1.5\ntangential_stiffening = \"pairs\"\ndamping = \"viscoelastic\"";
        let law: Law = toml::from_str(text).unwrap();
        let expected = Law {
            tangential_stiffening: TangentialStiffening::Pairs,
            damping: DampingGrowth::Viscoelastic,
            ..Law::HERTZ
        };
        assert_eq!(law, expected);
    }

    #[test]
    fn a_file_names_the_growth_of_damping_unless_it_is_the_usual_one() {
        for damping in DampingGrowth::ALL {
            let law = Law {
                damping,
                ..Law::HERTZ
            };
            let written = toml::to_string(&law).unwrap();
            let line = format!("damping = \"{}\"", damping.as_str());
            let is_usual = law == Law::HERTZ;
            assert_eq!(written.contains(&line), !is_usual, "{written}");
            assert_eq!(written.contains("damping"), !is_usual, "{written}");
        }
    }

    #[test]
    fn words_are_those_of_files() {
        for stiffening in TangentialStiffening::ALL {
            let written = toml::Value::try_from(stiffening).unwrap();
            assert_eq!(written.as_str(), Some(stiffening.as_str()));
        }
    }

    #[cfg(feature = "schema")]
    #[test]
    fn the_schema_of_a_power_lists_its_values() {
        let schema = schemars::schema_for!(Power);
        let values = Power::ALL.map(|power| serde_json::Value::from(power.value()));
        assert_eq!(schema.get("title"), Some(&"Power".into()));
        assert_eq!(schema.get("enum"), Some(&values.to_vec().into()));
    }

    #[test]
    fn gravity_is_slow_for_what_it_would_leave_behind() {
        use TangentialHistory::{Displacement, DisplacementRescaled, Force, ForceRescaled};
        let slow = |law: Law, history| Law { history, ..law }.needs_slow_ramp();
        let stiffening = Law {
            tangential_stiffening: TangentialStiffening::Every,
            ..Law::LINEAR
        };
        for history in [DisplacementRescaled, ForceRescaled] {
            assert!(slow(Law::LINEAR, history), "{history}");
        }
        // A remembered force, where the stiffness depends on the overlap.
        assert!(slow(Law::HERTZ, Force) && slow(stiffening, Force) && !slow(Law::LINEAR, Force));
        assert!(!slow(Law::HERTZ, Displacement) && !slow(stiffening, Displacement));
        let viscoelastic = |law| Law {
            damping: DampingGrowth::Viscoelastic,
            ..law
        };
        assert!(slow(viscoelastic(Law::HERTZ), Displacement));
        assert!(!slow(viscoelastic(Law::LINEAR), Displacement));
    }

    #[test]
    fn pairs_stiffen_with_every_contact_or_alone() {
        let stiffer = |tangential_stiffening| {
            let law = Law {
                tangential_stiffening,
                ..Law::LINEAR
            };
            [law.of_pairs(2.5, 0.7), law.of_walls(2.5, 0.7)].map(|contact| {
                assert_eq!(contact.unstiffened(0.5), 1.0 / 2.5);
                contact.at(0.5).tangential_stiffness / contact.unstiffened(0.5)
            })
        };
        // 2/(2 - 0.5).
        let more = 4.0 / 3.0;
        for (stiffening, expected) in [
            (TangentialStiffening::None, [1.0, 1.0]),
            (TangentialStiffening::Pairs, [more, 1.0]),
            (TangentialStiffening::Every, [more, more]),
        ] {
            let found = stiffer(stiffening);
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{stiffening:?}: {found}");
            }
        }
    }

    #[test]
    fn a_force_is_steepest_at_the_largest_overlap() {
        let floor = Law::HERTZ.of_walls(2.5, 0.7);
        assert!((floor.highest_stiffness() - 1.5 * HERTZ_FLOOR_RATIO).abs() < 1e-15);
        assert_eq!(Law::LINEAR.of_pairs(2.5, 0.7).highest_stiffness(), 1.0);
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
