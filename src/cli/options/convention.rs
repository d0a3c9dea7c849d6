//! The contact convention: arms and law in place of those of a code.

use super::flag::as_flag;
use super::numbers::number;
use crate::code::SettledCode;
use crate::model::{
    Arms, ContactArms, ContactConvention, HistoryUpdate, InvalidValue, Law, Power,
    TangentialHistory, TangentialStiffening,
};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Parts of the contact convention that replace those of the code.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct ConventionOptions {
    /// Arm coefficient r1 of cylinder-cylinder contacts, in R = r + r1 overlap [default: that of the code]
    #[arg(long, value_name = "R1", value_parser = number)]
    pub pair_arm: Option<f64>,
    /// Arm coefficient r1 of the surface velocity at these contacts [default: as --pair-arm]
    #[arg(long, value_name = "R1", value_parser = number)]
    pub pair_kinematic_arm: Option<f64>,
    /// Arm coefficient r1 of floor contacts [default: that of the code]
    #[arg(long, value_name = "R1", value_parser = number)]
    pub floor_arm: Option<f64>,
    /// Arm coefficient r1 of the surface velocity at these contacts [default: as --floor-arm]
    #[arg(long, value_name = "R1", value_parser = number)]
    pub floor_kinematic_arm: Option<f64>,
    /// What becomes of the tangential spring when a contact turns. With `fixed` it is a vector that never turns, which has
    /// a yield force of its own; all other rules share one [default: that of the code; if it does not say, `fixed` for the
    /// paper's two cylinders with linear springs and arms 0, otherwise `rotated`]
    #[arg(long, value_parser = history_update(), value_name = "RULE")]
    history_update: Option<HistoryUpdate>,
    #[command(flatten)]
    pub law: LawOptions,
}

/// The contact law, or parts of it that replace those of the code.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct LawOptions {
    /// Normal force K overlap^p: `linear` (p = 1), `hertz` (p = 1.5), 1.25, 1.75 or 2 [default: that of the code]
    #[arg(long, value_parser = power, value_name = "LAW")]
    law: Option<Power>,
    /// What tangential springs remember: the displacement or the force, perhaps rescaled by the contact radius while that
    /// shrinks [default: displacement]
    #[arg(long, value_parser = history(), value_name = "WHAT")]
    history: Option<TangentialHistory>,
    /// K of the floor and other walls over K of cylinders [default: root of 2 for Hertz, else 1]
    #[arg(long, value_name = "W", value_parser = number)]
    floor_ratio: Option<f64>,
    /// Stiffness ratio k_n/k_t of the floor [default: as --kappa]
    #[arg(long, value_name = "K", value_parser = number)]
    floor_kappa: Option<f64>,
    /// Multiply the tangential stiffness of these contacts by 2/(2 - overlap); every contact, if none are named
    #[arg(long, value_parser = stiffening(), value_name = "CONTACTS", num_args = 0..=1, require_equals = true,
        default_missing_value = "every")]
    tangential_stiffening: Option<TangentialStiffening>,
}

/// Reads `--law`.
pub(in crate::cli) fn power(text: &str) -> Result<Power, String> {
    let named = match text {
        "linear" => Ok(Power::Linear),
        "hertz" => Ok(Power::Hertz),
        number => number
            .parse()
            .map_err(|_| String::new())
            .and_then(|value: f64| Power::try_from(value)),
    };
    named.map_err(|_| {
        "accepted are `linear`, `hertz`, and the powers 1, 1.25, 1.5, 1.75 and 2".to_owned()
    })
}

/// Reads `--history-update`.
pub(in crate::cli) fn history_update() -> impl TypedValueParser<Value = HistoryUpdate> {
    one_of(HistoryUpdate::ALL, HistoryUpdate::as_str)
}

/// Reads `--history`.
fn history() -> impl TypedValueParser<Value = TangentialHistory> {
    one_of(TangentialHistory::ALL, TangentialHistory::as_str)
}

/// Reads `--tangential-stiffening`.
fn stiffening() -> impl TypedValueParser<Value = TangentialStiffening> {
    one_of(TangentialStiffening::ALL, TangentialStiffening::as_str)
}

/// Reads one of `all` by its word.
fn one_of<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    word: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(word)).map(move |given| {
        let named = all.into_iter().find(|value| word(*value) == given);
        named.expect("one of the possible values")
    })
}

impl LawOptions {
    /// Returns the power, if it is given.
    pub fn power(&self) -> Option<Power> {
        self.law
    }

    /// Returns `own` with the given parts. A power other than its own brings its usual other parts with it.
    fn over(&self, own: Law) -> Law {
        let other = self.law.filter(|power| *power != own.power);
        let base = other.map_or(own, Law::of_power);
        Law {
            power: base.power,
            history: self.history.unwrap_or(base.history),
            floor_ratio: self.floor_ratio.unwrap_or(base.floor_ratio),
            floor_kappa: self.floor_kappa.or(base.floor_kappa),
            tangential_stiffening: self
                .tangential_stiffening
                .unwrap_or(base.tangential_stiffening),
            damping: base.damping,
        }
    }
}

impl ConventionOptions {
    /// Refuses options that leave out an arm.
    pub fn check_named_arms(&self) -> Result<(), InvalidValue> {
        let arms = [
            ("--pair-arm", self.pair_arm),
            ("--floor-arm", self.floor_arm),
        ];
        let missing = arms.into_iter().find(|(_, arm)| arm.is_none());
        missing.map_or(Ok(()), |(flag, _)| {
            Err(InvalidValue {
                key: flag.to_owned(),
                value: "left out".to_owned(),
                accepted:
                    "the arm of the code, which moves the limit, or --passport FILE of a probe"
                        .to_owned(),
            })
        })
    }

    /// Returns the convention of `code` for stacks of this number of `bodies`, with the given parts in place of its
    /// own.
    pub fn of(&self, code: &SettledCode, bodies: u8) -> Result<ContactConvention, InvalidValue> {
        self.over(code, |arms, law| {
            ContactConvention::usual(arms, law, bodies)
        })
    }

    /// Does the same for contacts outside a stack, or in a stack of which nothing else is known.
    pub fn of_contacts(&self, code: &SettledCode) -> Result<ContactConvention, InvalidValue> {
        self.over(code, |arms, law| ContactConvention {
            arms,
            law,
            ..ContactConvention::TURNING
        })
    }

    /// Puts the given parts in place of those of `code`. If the code takes any convention, the other parts are the
    /// `usual` ones.
    fn over(
        &self,
        code: &SettledCode,
        usual: impl Fn(Arms, Law) -> ContactConvention,
    ) -> Result<ContactConvention, InvalidValue> {
        let own = code.convention();
        let arms = Arms {
            pair: replaced(own.arms.pair, self.pair_arm, self.pair_kinematic_arm),
            floor: replaced(own.arms.floor, self.floor_arm, self.floor_kinematic_arm),
        };
        let law = self.law.over(own.law);
        let base = match code.name().accepts_any_convention() {
            true => usual(arms, law),
            false => ContactConvention { arms, law, ..own },
        };
        let convention = ContactConvention {
            history_update: self.history_update.unwrap_or(base.history_update),
            ..base
        };
        convention.validate().map_err(as_flag)?;
        code.check_convention(&convention).map_err(as_flag)?;
        Ok(convention)
    }
}

/// Returns `own` with the given coefficients. A given torque arm is also the kinematic arm, unless that is given as
/// well.
fn replaced(own: ContactArms, torque: Option<f64>, kinematic: Option<f64>) -> ContactArms {
    // Adding zero turns -0 into 0, which is the same arm and must be the same case.
    ContactArms {
        torque: torque.unwrap_or(own.torque) + 0.0,
        kinematic: kinematic.or(torque).unwrap_or(own.kinematic) + 0.0,
    }
}
