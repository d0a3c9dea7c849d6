//! The arms of a code as its passport has them.

use super::passport::PASSPORT;
use crate::code::ConventionKey;
use crate::model::{Arms, ContactConvention, InvalidValue};
use serde::Deserialize;
use thiserror::Error;

/// The arms of a code, and what is not known of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredArms {
    /// Their coefficients.
    pub arms: Arms,
    /// The uncertainties of these.
    pub uncertainty: Arms,
}

/// Why a passport does not say what the arms of a code are.
#[derive(Debug, Error)]
pub enum UnusablePassport {
    /// It is no JSON, or lacks keys of a passport.
    #[error(transparent)]
    Malformed(#[from] serde_json::Error),
    /// It is something else.
    #[error("`schema` is `{0}`; accepted is {PASSPORT}, as tristack probe --out writes it")]
    OtherSchema(String),
    /// The motions of the code have not shown an arm.
    #[error("{0} is not measured in it; accepted is a passport with all four arms")]
    Unknown(ConventionKey),
    /// An uncertainty that is none.
    #[error("the uncertainty of {0} is {1}; accepted is a number from 0")]
    NoUncertainty(ConventionKey, f64),
    /// An arm that no convention has.
    #[error(transparent)]
    OutOfRange(#[from] InvalidValue),
    /// Something else than an arm is not as declared, so that the limit is not known.
    #[error(
        "the code is not what its manifest says ({0} differs), so that no limit is known for it"
    )]
    Contradicted(String),
}

/// What is read of a passport.
#[derive(Deserialize)]
struct Document {
    schema: String,
    convention: Table<KeyRow>,
    properties: Table<PropertyRow>,
}

#[derive(Deserialize)]
struct Table<T> {
    rows: Vec<T>,
}

#[derive(Deserialize)]
struct KeyRow {
    key: String,
    measured: Option<String>,
    uncertainty: Option<f64>,
}

#[derive(Deserialize)]
struct PropertyRow {
    property: String,
    verdict: String,
}

impl MeasuredArms {
    /// The arms in the JSON `text` of a passport.
    ///
    /// # Errors
    /// If it is no passport, an arm is unknown or out of range, or anything but an arm differs from what was asked for.
    pub fn of_passport(text: &[u8]) -> Result<Self, UnusablePassport> {
        let document: Document = serde_json::from_slice(text)?;
        if document.schema != PASSPORT {
            return Err(UnusablePassport::OtherSchema(document.schema));
        }
        let mut properties = document.properties.rows.into_iter();
        // An arm that is declared otherwise than measured is still the one that was measured.
        let other =
            properties.find(|own| own.verdict == "differs" && !own.property.ends_with("_arm"));
        if let Some(other) = other {
            return Err(UnusablePassport::Contradicted(other.property));
        }
        let (mut arms, mut uncertainty) = (Arms::PAPER, Arms::PAPER);
        for key in ConventionKey::ARMS {
            let mut rows = document.convention.rows.iter();
            let row = rows.find(|row| row.key == key.as_str());
            let (value, open) = row
                .and_then(KeyRow::number)
                .ok_or(UnusablePassport::Unknown(key))?;
            if !(open >= 0.0 && open.is_finite()) {
                return Err(UnusablePassport::NoUncertainty(key, open));
            }
            key.set_arm(&mut arms, value);
            key.set_arm(&mut uncertainty, open);
        }
        ContactConvention::with_arms(arms).validate()?;
        Ok(Self { arms, uncertainty })
    }
}

impl KeyRow {
    /// The measured number and its uncertainty.
    fn number(&self) -> Option<(f64, f64)> {
        let value = self.measured.as_ref()?.parse().ok()?;
        Some((value, self.uncertainty?))
    }
}
