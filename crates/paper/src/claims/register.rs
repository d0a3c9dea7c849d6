//! The register of claims, `reference/claims.toml`: the paper's statements, their places, and the checks that
//! test them. It holds no verdicts.

use super::checks;
use super::notation::number;
use super::printed::PaperTheory;
use crate::model::InvalidValue;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use thiserror::Error;

const TEXT: &str = include_str!("../../reference/claims.toml");
const FILE: &str = "reference/claims.toml";

/// The kind of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ClaimKind {
    /// A formula.
    Equation,
    /// A number in the text.
    Number,
    /// A statement in words.
    Statement,
}

/// The correction of a claim that does not hold.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// The corrected form; `@name@` stands for the value of a constant of the corrected paper.
    pub text: String,
    /// The constants of [`PaperTheory`] with which the check must hold.
    pub set: BTreeMap<String, f64>,
}

impl Erratum {
    /// Returns the corrected paper; `None` if `set` names a constant that the paper does not have.
    pub fn apply(&self, paper: &PaperTheory) -> Option<PaperTheory> {
        let mut set = self.set.iter();
        set.try_fold(paper.clone(), |paper, (name, &value)| {
            paper.with(name, value)
        })
    }

    /// Returns the corrected form with the constants of the `corrected` paper in place; `None` if it names a constant
    /// that does not exist.
    pub fn words(&self, corrected: &PaperTheory) -> Option<String> {
        let parts = self.text.split('@').enumerate();
        let words = parts.map(|(index, part)| match index % 2 {
            0 => Some(part.to_owned()),
            _ => corrected.constant(part).map(number),
        });
        words.collect()
    }

    fn validate_text(&self) -> Result<(), InvalidValue> {
        let accepted = || format!("text with placeholders @name@ of {}", a_constant());
        if self.text.matches('@').count() % 2 == 1 {
            return Err(invalid("erratum.text", &self.text, accepted()));
        }
        let mut names = self.text.split('@').skip(1).step_by(2);
        let unknown = names.find(|name| !PaperTheory::NAMES.contains(name));
        unknown.map_or(Ok(()), |name| {
            let placeholder = format!("@{name}@");
            Err(invalid("erratum.text", placeholder, accepted()))
        })
    }
}

/// A deviation that the words of a claim allow.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Allowance {
    /// The largest allowed deviation, in the check's own measure.
    pub size: f64,
    /// What `size` is a part of, or counted in.
    pub of: String,
    /// Why the words allow that much.
    pub because: String,
}

/// One claim.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Unique name.
    pub id: String,
    /// Place in the paper.
    pub place: String,
    /// The numbers, as printed, of the displayed equations that it covers.
    #[serde(default)]
    pub equations: Vec<String>,
    /// Statement, in words or as a formula.
    pub statement: String,
    /// Kind of the statement.
    pub kind: ClaimKind,
    /// The check that tests it.
    pub check: Option<String>,
    /// The deviation that the words of the claim allow.
    pub allowed: Option<Allowance>,
    /// The reason why it cannot be tested.
    pub untestable: Option<String>,
    /// Anchors of the report's figures and tables that show its numbers, such as `figure-scaling`.
    #[serde(default)]
    pub see: Vec<String>,
    /// Correction, if the claim does not hold as printed.
    pub erratum: Option<Erratum>,
}

/// All claims.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Register {
    /// The claims, in the order of the paper.
    #[serde(rename = "claim")]
    pub claims: Vec<Claim>,
}

/// A register that cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{file}: {message}")]
pub struct RegisterError {
    /// The file.
    pub file: String,
    /// The defect and its place.
    pub message: String,
}

fn invalid(key: &str, value: impl ToString, accepted: impl Into<String>) -> InvalidValue {
    InvalidValue {
        key: key.to_owned(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}

/// Describes the constants that are accepted.
fn a_constant() -> String {
    format!("a constant of the paper: {}", PaperTheory::NAMES.join(", "))
}

impl Register {
    /// Reads the claims of the paper.
    pub fn paper() -> Result<Self, RegisterError> {
        Self::from_toml(TEXT, FILE)
    }

    /// Reads and validates claims from the `text` of a `file`.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, RegisterError> {
        let refused = |message: String| RegisterError {
            file: file.to_owned(),
            message,
        };
        let register: Self = toml::from_str(text).map_err(|error| refused(error.to_string()))?;
        let mut seen = BTreeSet::new();
        for claim in &register.claims {
            let valid = claim.validate(&mut seen);
            valid.map_err(|invalid| refused(format!("claim `{}`: {invalid}", claim.id)))?;
        }
        Ok(register)
    }
}

impl Claim {
    fn validate<'a>(&'a self, seen: &mut BTreeSet<&'a str>) -> Result<(), InvalidValue> {
        if !seen.insert(&self.id) {
            return Err(invalid("id", &self.id, "different for every claim"));
        }
        match (&self.check, &self.untestable) {
            (Some(check), None) if checks::find(check).is_some() => {}
            (Some(check), None) => {
                let accepted = format!("one of {}", checks::check_names().join(", "));
                return Err(invalid("check", check, accepted));
            }
            (None, Some(_)) => {}
            _ => {
                let accepted = "given where there is no `untestable`, and only there";
                let value = self.check.as_deref().unwrap_or("absent");
                return Err(invalid("check", value, accepted));
            }
        }
        let allowed = self.allowed.as_ref().map_or(1.0, |allowed| allowed.size);
        if !(allowed.is_finite() && allowed > 0.0) {
            return Err(invalid("allowed.size", allowed, "a number above 0"));
        }
        self.validate_erratum()
    }

    fn validate_erratum(&self) -> Result<(), InvalidValue> {
        let Some(erratum) = &self.erratum else {
            return Ok(());
        };
        if erratum.set.is_empty() || self.check.is_none() {
            let accepted = "given, with a check that tests it";
            return Err(invalid("erratum.set", "absent", accepted));
        }
        for (name, value) in &erratum.set {
            if !value.is_finite() {
                let key = format!("erratum.set.{name}");
                return Err(invalid(&key, value, "a finite number"));
            }
            if !PaperTheory::NAMES.contains(&name.as_str()) {
                return Err(invalid("erratum.set", name, a_constant()));
            }
        }
        erratum.validate_text()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(change: &str) -> String {
        let text =
            format!("[[claim]]\nid = 'a'\nplace = 'p'\nstatement = 's'\nkind = 'number'\n{change}");
        Register::from_toml(&text, "my.toml")
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn errors_name_file_key_value_and_what_is_accepted() {
        let message = error("check = 'no-such-check'");
        assert!(
            message
                .starts_with("my.toml: claim `a`: `check` is no-such-check, but must be one of ")
        );
        assert!(error("").contains("`check` is absent"));
        assert!(error("verdict = 'holds'").contains("unknown field `verdict`"));
        let allowed = "untestable = 'x'\nallowed = { size = -1, of = 'x', because = 'y' }";
        assert!(error(allowed).contains("`allowed.size` is -1"));
        let message =
            error("check = 'quintic'\n[claim.erratum]\ntext = 't'\nset = { nothing = 1 }");
        assert!(message.contains("`erratum.set` is nothing"), "{message}");
    }

    #[test]
    fn placeholders_of_an_erratum_are_constants_of_the_paper() {
        let erratum = |text: &str| {
            format!(
                "check = 'quintic'\n[claim.erratum]\ntext = '{text}'\nset = {{ restitution = 1 }}"
            )
        };
        let message = error(&erratum("$@nothing@$"));
        let expected = "my.toml: claim `a`: `erratum.text` is @nothing@, but must be text with placeholders \
                        @name@ of a constant of the paper: mass_factor, ";
        assert!(message.starts_with(expected), "{message}");
        let message = error(&erratum("$@restitution$"));
        assert!(message.contains("`erratum.text` is $@restitution$, but must be text with"));
    }

    #[test]
    fn words_of_an_erratum_hold_the_constants_of_the_corrected_paper() {
        let erratum = Erratum {
            text: r"$v = @compression_speed@$ and $e_r = @restitution@$".to_owned(),
            set: BTreeMap::from([("compression_speed".to_owned(), 1e-7)]),
        };
        let corrected = erratum.apply(&PaperTheory::printed()).unwrap();
        let words = erratum.words(&corrected).unwrap();
        assert_eq!(words, "$v = 10^{-7}$ and $e_r = 0.7$");
    }
}
