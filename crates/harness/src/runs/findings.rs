//! What a command has found to be wrong with a code, kept so that the other commands can say it.

use super::{Kind, Store};
use crate::code::{Identity, InstalledCode};
use crate::files::{FileError, parse_json};
use crate::model::sha256_hex;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::Path;

/// Number of findings that are told; the command itself says all.
const MOST_TOLD: usize = 3;

/// A command that finds something about a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finder {
    /// `tristack check`.
    Check,
    /// `tristack probe`.
    Probe,
    /// `tristack crosscheck`.
    Crosscheck,
}

impl Finder {
    const ALL: [Self; 3] = [Self::Check, Self::Probe, Self::Crosscheck];

    fn as_str(self) -> &'static str {
        match self {
            Self::Check => "check",
            Self::Probe => "probe",
            Self::Crosscheck => "crosscheck",
        }
    }
}

/// What one command has found to be wrong with a code.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Findings {
    /// The command.
    pub by: Finder,
    /// The program that was tried.
    pub identity: Identity,
    /// What is wrong, a text each; none if nothing is.
    pub wrong: Vec<String>,
}

impl fmt::Display for Findings {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { by, wrong, .. } = self;
        let told = &wrong[..wrong.len().min(MOST_TOLD)];
        let command = by.as_str();
        write!(
            formatter,
            "`tristack {command}` has found about this very code: {}",
            told.join("; ")
        )?;
        match wrong.len() - told.len() {
            0 => Ok(()),
            more => write!(formatter, "; and {more} more"),
        }
    }
}

impl Findings {
    /// Keeps what a command has found to be `wrong` with `code`, in place of what it had found before. Nothing is kept
    /// of a code that never was wrong.
    ///
    /// # Errors
    /// If the store cannot be read or written.
    pub fn keep(
        by: Finder,
        code: &dyn InstalledCode,
        wrong: Vec<String>,
        store: &Store,
    ) -> Result<(), FileError> {
        let address = address(by, code);
        if wrong.is_empty() && !store.holds(Kind::Finding, &address) || !store.is_kept(|_| ()) {
            return Ok(());
        }
        let own = Self {
            by,
            identity: code.identity().clone(),
            wrong,
        };
        let content = serde_json::to_string(&own).expect("plain data has a JSON form") + "\n";
        store.put_sealed(Kind::Finding, &address, &content)
    }

    /// Returns what other commands than `by` have found to be wrong with `code`, as it is today.
    ///
    /// # Errors
    /// If an entry of the store cannot be read.
    pub fn of_others(
        by: Finder,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Vec<Self>, FileError> {
        let others = Finder::ALL.into_iter().filter(|other| *other != by);
        let read = |other| store.sealed(Kind::Finding, &address(other, code), parse_json::<Self>);
        let found: Result<Vec<Option<Self>>, FileError> = others.map(read).collect();
        let found = found?.into_iter().flatten();
        Ok(found.filter(|own| !own.wrong.is_empty()).collect())
    }
}

/// Reads the program that the findings in the `text` of the file at `path` are about.
///
/// # Errors
/// If it is malformed.
pub(super) fn found_about(text: &[u8], path: &Path) -> Result<Identity, FileError> {
    parse_json::<Findings>(text, path).map(|own| own.identity)
}

/// Returns the address of what a command finds about `code`, which depends on its identity and its folder.
fn address(by: Finder, code: &dyn InstalledCode) -> String {
    let parts = (by, code.identity().deciding(), code.name().folder_hash());
    let parts = serde_json::json!(parts);
    sha256_hex(parts.to_string().as_bytes())
}
