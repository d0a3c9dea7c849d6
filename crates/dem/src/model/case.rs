//! A case: every input of one time series.

use super::{
    ContactConvention, InvalidValue, Preparation, Problem, Protocol, Stack, WrittenStack, exact,
    sha256_hex, shown,
};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// One compression run of one stack under one contact convention.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenCase")]
pub struct Case {
    /// The stack.
    pub stack: Stack,
    /// The contact convention.
    pub convention: ContactConvention,
    /// Preparation, compression and sampling.
    pub protocol: Protocol,
}

/// [`Case`] as files spell it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCase {
    stack: WrittenStack,
    convention: ContactConvention,
    protocol: Protocol,
}

impl From<WrittenCase> for Case {
    fn from(written: WrittenCase) -> Self {
        Self {
            stack: written.stack.in_law(written.convention.law.power),
            convention: written.convention,
            protocol: written.protocol,
        }
    }
}

/// Why a case could not be read.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The file could not be read.
    #[error("cannot read the case file {}: {source}", shown(path))]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// The file is neither named `.toml` nor `.json`.
    #[error("the case file {} must end in .toml or .json", shown(path))]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The text is not a case: unknown, missing or mistyped key.
    #[error("{} is not a case: {message}", shown(path))]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The parser's message, which names the key, the place and what it expected.
        message: String,
    },
    /// A value is out of its range.
    #[error("in the case file {}: {invalid}", shown(path))]
    Invalid {
        /// The file.
        path: PathBuf,
        /// Key, value and what is accepted.
        invalid: InvalidValue,
    },
}

impl Case {
    /// Checks every value; the error names the first that is out of range.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        self.stack.validate()?;
        self.convention.validate()?;
        self.protocol.validate()?;
        if !matches!(self.protocol.preparation, Preparation::GravityRamp { .. }) {
            self.stack.refuse_spheres()?;
        }
        match self.protocol.preparation {
            // Without springs nothing oscillates.
            Preparation::Rigid => Ok(()),
            _ => self.validate_stability(),
        }
    }

    /// Returns its stack under its convention, both checked.
    ///
    /// # Errors
    /// The first value that is out of range.
    pub fn problem(&self) -> Result<Problem, InvalidValue> {
        Problem::new(self.stack, self.convention)
    }

    fn validate_stability(&self) -> Result<(), InvalidValue> {
        let largest = self.stack.longest_time_step(&self.convention);
        if self.protocol.time_step <= largest {
            return Ok(());
        }
        let accepted = format!(
            "at most {largest:.2e} for a stable integration at stiffness ratio {}",
            self.stack.stiffness_ratio
        );
        let key = "protocol.time_step";
        Err(InvalidValue::new(key, self.protocol.time_step, accepted))
    }

    /// Number of time steps, including the preparation.
    pub fn total_steps(&self) -> u64 {
        self.protocol.schedule().total_steps()
    }

    /// Returns the SHA-256, in hexadecimal, of the case as compact JSON with keys in the order of the fields and
    /// numbers in their shortest exact form. Equal cases have equal hashes on every machine.
    pub fn content_hash(&self) -> String {
        let json =
            serde_json::to_vec(self).expect("a case has only named fields and finite numbers");
        sha256_hex(&json)
    }

    /// Returns the case as it is kept in files: indented JSON with a final newline.
    pub fn to_json(&self) -> String {
        let json = serde_json::to_string_pretty(self);
        json.expect("a case has only named fields and finite numbers") + "\n"
    }

    /// Parses and validates a case from the content of the file at `path`, whose extension determines the format.
    pub fn parse(content: &[u8], path: &Path) -> Result<Self, CaseError> {
        let case: Self = CaseError::deserialized(content, path)?;
        case.validate().map_err(CaseError::in_file(path))?;
        Ok(case)
    }
}

impl CaseError {
    /// Turns a value out of its range into the error for the file at `path`.
    pub fn in_file(path: &Path) -> impl FnOnce(InvalidValue) -> Self {
        let path = path.to_owned();
        |invalid| Self::Invalid { path, invalid }
    }

    /// Parses the content of the file at `path`, whose extension determines the format.
    pub fn deserialized<T: DeserializeOwned>(content: &[u8], path: &Path) -> Result<T, Self> {
        let parsed = match path.extension().and_then(|extension| extension.to_str()) {
            Some("toml") => toml::from_slice(content).map_err(|error| error.to_string()),
            Some("json") => serde_json::from_slice(content).map_err(|error| error.to_string()),
            _ => {
                return Err(Self::UnknownFormat {
                    path: path.to_owned(),
                });
            }
        };
        parsed.map_err(|message| Self::Malformed {
            path: path.to_owned(),
            message,
        })
    }
}

impl std::fmt::Display for Case {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            stack, protocol, ..
        } = self;
        write!(
            formatter,
            "mu = {}, stiffness = {}, wall speed = {:e}, time step = {}",
            exact(stack.floor_friction),
            stack.stiffness,
            protocol.wall_speed,
            protocol.time_step
        )?;
        match protocol.preparation {
            Preparation::GravityRamp { .. } => Ok(()),
            Preparation::SideWalls(walls) => {
                write!(formatter, ", side walls, A = {}", exact(walls.push))
            }
            Preparation::Rigid => formatter.write_str(", rigid"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Preparation, Sampling};

    fn case() -> Case {
        Case {
            stack: Stack::paper(0.3, 100.0),
            convention: ContactConvention::TURNING,
            protocol: Protocol {
                preparation: Preparation::GravityRamp {
                    ramp_time: 100.0,
                    rest_time: 100.0,
                },
                time_step: 0.1,
                wall_speed: 1e-4,
                wall_travel: 0.7,
                sampling: Sampling {
                    coarse_interval: 60.0,
                    fine_from_travel: 0.6,
                    fine_interval: 2.0,
                },
                shortcuts: None,
            },
        }
    }

    #[test]
    fn json_and_toml_give_the_same_case_back() {
        let json: Case = serde_json::from_str(&case().to_json()).unwrap();
        let toml: Case = toml::from_str(&toml::to_string(&case()).unwrap()).unwrap();
        assert_eq!([json, toml], [case(), case()]);
    }

    /// Pinned: a change of this hash would orphan every stored and recorded run.
    #[test]
    fn content_hash_is_stable_and_sees_every_value() {
        let hash = case().content_hash();
        assert_eq!(
            hash,
            "6e121619e8566e12c4e39739b2c790e89dc842e04b59f1dce84eff96fee0b2f0"
        );
        let mut other = case();
        other.stack.cylinder_friction = 0.71;
        assert_ne!(other.content_hash(), hash);
        other = case();
        other.stack.bodies = 3;
        assert_ne!(other.content_hash(), hash);
        assert_eq!(other.validate(), Ok(()));
        let spheres = other.content_hash();
        other.stack.arrangement.turn = 1.0;
        assert_ne!(other.content_hash(), spheres);
        other.stack.arrangement.turn = 0.0;
        let text = other.to_json().replace("\"bodies\": 3", "\"bodies\": 2");
        let written: Case = serde_json::from_str(&text).unwrap();
        assert_eq!(written.content_hash(), hash);
    }

    #[test]
    fn a_soft_tangential_spring_allows_a_longer_step_than_a_stiff_one() {
        let mut stiff = case();
        stiff.stack.stiffness_ratio = 0.01;
        assert_eq!(stiff.validate().unwrap_err().key, "protocol.time_step");
        assert_eq!(case().validate(), Ok(()));
    }
}
