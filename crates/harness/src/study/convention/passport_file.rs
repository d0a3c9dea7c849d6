//! A passport as read from its file.

use super::finding::TOLERANCE;
use super::passport::PASSPORT;
use crate::code::{ConventionKey, Identity};
use crate::model::sha256_hex;
use crate::study::Verdict;
use serde::{Deserialize, Deserializer};
use std::collections::BTreeSet;
use thiserror::Error;

/// Digits of the digest in a permanent name.
const DIGEST_DIGITS: usize = 8;
/// The part of a name that stands for a text without letters and digits.
const NAMELESS: &str = "none";
/// Largest number of letters of a part of a name: three parts and the digest fit into the name of a file.
const LONGEST_PART: usize = 64;

/// A passport, read. The fields are described by `tristack schema passport`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PassportFile {
    /// The command that made it.
    pub command: String,
    /// Name of the code.
    pub code: String,
    /// Its name in prose.
    pub title: String,
    /// Name of the program, shared by its versions and styles; the title in older passports, which lack it.
    #[serde(default)]
    pub software: String,
    /// The contact style, the same in all versions.
    #[serde(default)]
    pub style: String,
    /// How to install the program.
    #[serde(default)]
    pub install: String,
    /// The worst verdict on a property.
    pub verdict: Verdict,
    /// The program that was probed.
    pub program: Identity,
    /// Version of tristack.
    pub tristack: String,
    /// Date of the probe, UTC.
    pub date: String,
    /// Processor and system.
    pub machine: String,
    /// What does not agree, or is not known.
    pub reservations: Vec<String>,
    /// What its contacts do differently in long time steps.
    pub time_step_effects: Vec<String>,
    /// Number of significant digits of the motions, where they are fewer than a number has.
    #[serde(default)]
    pub digits: Option<u32>,
    /// Quantities of the motions that are numbers of 32 bits.
    #[serde(default)]
    pub single_precision: Vec<String>,
    /// The keys of its convention, as measured.
    #[serde(deserialize_with = "rows")]
    pub convention: Vec<KeyRow>,
    /// What its arms change in the yield forces of three stacks.
    #[serde(deserialize_with = "rows")]
    pub arm_effects: Vec<ArmEffect>,
    /// Everything that was measured.
    #[serde(deserialize_with = "rows")]
    pub properties: Vec<PropertyRow>,
}

/// A key of the convention.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct KeyRow {
    /// The key, as in a manifest.
    pub key: String,
    /// Its value as measured; absent where the motions do not show it.
    pub measured: Option<String>,
    /// The uncertainty of a number.
    pub uncertainty: Option<f64>,
    /// Its value in the manifest.
    pub declared: Option<String>,
    /// Whether it moves the quasi-static limit.
    pub moves_limit: bool,
    /// Whether it is as declared.
    pub verdict: Verdict,
}

/// The exact yield force of a stack under the measured arms.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct ArmEffect {
    /// k_n r/(m g).
    pub stiffness: f64,
    /// Friction of the floor.
    pub mu: f64,
    /// κ = k_n/k_t.
    pub kappa: f64,
    /// The force with the paper's arms, in m g.
    pub paper_force: Option<f64>,
    /// The force with the arms of the code, in m g.
    pub force: Option<f64>,
    /// Uncertainty of that force from the uncertainty of the arms, in m g.
    pub uncertainty: Option<f64>,
}

/// A property of the contacts.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PropertyRow {
    /// Its name.
    pub property: String,
    /// As measured; absent if that failed.
    pub measured: Option<f64>,
    /// Three standard errors.
    pub uncertainty: Option<f64>,
    /// As declared or asked for.
    pub declared: Option<f64>,
    /// Whether both agree.
    pub verdict: Verdict,
}

/// Why a file is not a passport.
#[derive(Debug, Error)]
pub enum UnreadablePassport {
    /// It is not JSON, or lacks keys of a passport.
    #[error(transparent)]
    Malformed(#[from] serde_json::Error),
    /// It has another schema.
    #[error("`schema` is `{0}`; accepted is {PASSPORT}, as tristack probe --out writes it")]
    OtherSchema(String),
    /// It contradicts itself, or has a number that no probe writes.
    #[error("{0}; accepted is a passport as tristack probe --out writes it")]
    Contradictory(String),
}

impl PassportFile {
    /// Reads a passport from its JSON `text`.
    ///
    /// # Errors
    /// If it is not a passport.
    pub fn read(text: &[u8]) -> Result<Self, UnreadablePassport> {
        let schema = schema_of(text)?;
        if schema != PASSPORT {
            return Err(UnreadablePassport::OtherSchema(schema));
        }
        let mut passport: Self = serde_json::from_slice(text)?;
        passport
            .check()
            .map_err(UnreadablePassport::Contradictory)?;
        if passport.software.is_empty() {
            passport.software.clone_from(&passport.title);
        }
        if passport.style.is_empty() {
            passport.style.clone_from(&passport.code);
        }
        Ok(passport)
    }

    /// Refuses what no probe writes: somebody may have edited the file.
    fn check(&self) -> Result<(), String> {
        let keys = self.convention.iter();
        // A rule may differ although its word is not known.
        let keys = keys.map(|row| (&row.key, true, row.uncertainty, row.verdict));
        let properties = self.properties.iter().map(|row| {
            let is_known = row.measured.is_some();
            (&row.property, is_known, row.uncertainty, row.verdict)
        });
        let mut names = BTreeSet::new();
        for (name, is_known, uncertainty, verdict) in keys.chain(properties) {
            if !names.insert(name) {
                return Err(format!("`{name}` stands there twice"));
            }
            if uncertainty.is_some_and(|open| open < 0.0) {
                let open = uncertainty.unwrap_or_default();
                return Err(format!("the uncertainty of `{name}` is {open}, below 0"));
            }
            if !is_known && matches!(verdict, Verdict::Agrees | Verdict::Differs) {
                return Err(format!(
                    "`{name}` has the verdict `{verdict}`, but no measured value"
                ));
            }
            if verdict == Verdict::Differs && self.verdict == Verdict::Agrees {
                return Err(format!(
                    "`{name}` has the verdict `differs`, but the passport as a whole `agrees`"
                ));
            }
        }
        let forces = self.arm_effects.iter();
        let mut uncertainties = forces.filter_map(|row| row.uncertainty);
        if let Some(open) = uncertainties.find(|open| *open < 0.0) {
            return Err(format!("the uncertainty of a force is {open}, below 0"));
        }
        for key in ConventionKey::ARMS {
            self.check_arm(key)?;
        }
        Ok(())
    }

    /// Refuses an arm that is one number as a rule of the convention, and another one as a property.
    fn check_arm(&self, key: ConventionKey) -> Result<(), String> {
        let name = key.as_str();
        let property = name.trim_start_matches("convention.").replace('.', "_");
        let rule = self.key(name).and_then(KeyRow::number);
        let row = self.property(&property);
        let row = row.and_then(|row| row.measured.zip(row.uncertainty));
        match rule.zip(row) {
            Some(((rule, first), (number, second)))
                if (rule - number).abs() > TOLERANCE + 2.0 * (first + second) =>
            {
                Err(format!(
                    "`{name}` is {rule}, but `{property}`, the same arm, {number}"
                ))
            }
            _ => Ok(()),
        }
    }

    /// Why it may not know what another passport of the same contacts does; absent for motions in double precision with
    /// all digits.
    pub fn is_coarse_because(&self) -> Option<String> {
        let digits = self.digits.map(|digits| format!("have {digits} digits"));
        let single = || {
            format!(
                "are numbers of 32 bits ({})",
                self.single_precision.join(", ")
            )
        };
        digits.or_else(|| (!self.single_precision.is_empty()).then(single))
    }

    /// The row of a `key` of the convention.
    pub fn key(&self, key: &str) -> Option<&KeyRow> {
        self.convention.iter().find(|row| row.key == key)
    }

    /// The row of a `property`.
    pub fn property(&self, property: &str) -> Option<&PropertyRow> {
        self.properties.iter().find(|row| row.property == property)
    }
}

impl KeyRow {
    /// The measured number and its uncertainty.
    pub fn number(&self) -> Option<(f64, f64)> {
        let value = self.measured.as_ref()?.parse().ok()?;
        Some((value, self.uncertainty?))
    }
}

/// The `schema` of a JSON document.
pub(crate) fn schema_of(text: &[u8]) -> Result<String, serde_json::Error> {
    #[derive(Deserialize)]
    struct Named {
        schema: String,
    }
    serde_json::from_slice::<Named>(text).map(|named| named.schema)
}

/// The rows of a table.
fn rows<'de, D: Deserializer<'de>, T: Deserialize<'de>>(input: D) -> Result<Vec<T>, D::Error> {
    #[derive(Deserialize)]
    struct Table<T> {
        rows: Vec<T>,
    }
    Table::deserialize(input).map(|table| table.rows)
}

/// The permanent name of a passport with this JSON `text`: program, version, style, and the first digits of its
/// SHA-256.
pub fn permanent_name(passport: &PassportFile, text: &[u8]) -> String {
    let digest = sha256_hex(text);
    let parts = [
        &passport.software,
        &passport.program.version,
        &passport.style,
    ];
    let parts = parts.map(|part| plain(part));
    format!("{}_{}", parts.join("_"), &digest[..DIGEST_DIGITS])
}

/// `text` in lower-case letters, digits and points, with a hyphen for everything between them. No word begins or ends
/// with a point, so that no name is hidden or leads out of its directory; a text without letters and digits is `none`.
pub fn plain(text: &str) -> String {
    let lower = text.to_lowercase();
    let words = lower.split(|char: char| !(char.is_ascii_alphanumeric() || char == '.'));
    let words = words.map(|word| word.trim_matches('.'));
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    match words.join("-") {
        name if name.is_empty() => NAMELESS.to_owned(),
        name => name.chars().take(LONGEST_PART).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_hidden_leads_elsewhere_or_is_too_long() {
        for (text, name) in [
            ("../../x", "x"),
            (".hidden", "hidden"),
            ("a/../b", "a-b"),
            ("..", NAMELESS),
            ("", NAMELESS),
            ("$\\input{x}$", "input-x"),
            ("LAMMPS 23.06", "lammps-23.06"),
        ] {
            assert_eq!(plain(text), name, "{text}");
        }
        assert_eq!(plain(&"long".repeat(99)).len(), LONGEST_PART);
    }
}
