//! What moves the limit of a code, read from its passport: arms, and whether springs turn.

use super::passport_file::{KeyRow, PassportFile, UnreadablePassport};
use crate::code::ConventionKey;
use crate::model::{Arms, ContactConvention, HistoryUpdate, InvalidValue};
use crate::study::Verdict;
use thiserror::Error;

/// The arms of a code with their uncertainties, and whether its springs turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredArms {
    /// A convention with these arms.
    pub convention: ContactConvention,
    /// The uncertainties of the arms.
    pub uncertainty: Arms,
}

/// Why a passport does not say what the arms of a code are.
#[derive(Debug, Error)]
pub enum UnusablePassport {
    /// It is not a passport.
    #[error(transparent)]
    Unreadable(#[from] UnreadablePassport),
    /// The motions of the code have not shown an arm.
    #[error("{0} is not measured in it; accepted is a passport with all four arms")]
    Unknown(ConventionKey),
    /// An uncertainty is not a finite number from 0.
    #[error("the uncertainty of {0} is {1}; accepted is a number from 0")]
    NoUncertainty(ConventionKey, f64),
    /// An arm is out of range.
    #[error(transparent)]
    OutOfRange(#[from] InvalidValue),
    /// Something other than an arm is not as declared, so that the limit is not known.
    #[error(
        "the code is not what its manifest says ({0} differs), so that no limit is known for it"
    )]
    Contradicted(String),
}

impl MeasuredArms {
    /// Reads the arms from the JSON `text` of a passport.
    ///
    /// # Errors
    /// If it is not a passport, an arm is unknown or out of range, or anything but an arm differs from what was asked
    /// for.
    pub fn of_passport(text: &[u8]) -> Result<Self, UnusablePassport> {
        let passport = PassportFile::read(text)?;
        let mut properties = passport.properties.iter();
        // An arm that is not as declared is still known as measured.
        let other = properties
            .find(|own| own.verdict == Verdict::Differs && !own.property.ends_with("_arm"));
        if let Some(other) = other {
            return Err(UnusablePassport::Contradicted(other.property.clone()));
        }
        let (mut arms, mut uncertainty) = (Arms::PAPER, Arms::PAPER);
        for key in ConventionKey::ARMS {
            let (value, open) = passport
                .key(key.as_str())
                .and_then(KeyRow::number)
                .ok_or(UnusablePassport::Unknown(key))?;
            if !(open >= 0.0 && open.is_finite()) {
                return Err(UnusablePassport::NoUncertainty(key, open));
            }
            key.set_arm(&mut arms, value);
            key.set_arm(&mut uncertainty, open);
        }
        // Springs turn unless they are seen not to; the rule by which they turn does not matter.
        let update = passport.key(ConventionKey::HistoryUpdate.as_str());
        let measured = update.and_then(|own| own.measured.as_deref());
        let convention = ContactConvention {
            history_update: match measured == Some(HistoryUpdate::Fixed.as_str()) {
                true => HistoryUpdate::Fixed,
                false => HistoryUpdate::Rotated,
            },
            ..ContactConvention::with_arms(arms)
        };
        convention.validate()?;
        Ok(Self {
            convention,
            uncertainty,
        })
    }
}
