//! Errors of a manifest: file, line, key, value, what is accepted, and the word that was probably meant.

use super::folder::MANIFEST;
use crate::model::{InvalidValue, readable, shown};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Words that are less alike than this, as [`strsim::jaro`] has it, are not taken for one another.
const ALIKE: f64 = 0.7;

/// A place in a manifest.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Place {
    /// The manifest.
    pub path: PathBuf,
    /// The line, if it is known.
    pub line: Option<usize>,
}

/// The reason why a folder describes no code.
#[derive(Debug, Clone, Error)]
#[error("{}{}: {message}", shown(&place.path), place.line.map_or(String::new(), |line| format!(", line {line}")))]
pub struct ManifestError {
    place: Place,
    message: String,
}

impl ManifestError {
    pub(super) fn new(place: Place, message: &str) -> Self {
        let message = readable(message);
        Self { place, message }
    }

    /// An error about the manifest of `folder` as a whole.
    pub(super) fn of_folder(folder: &Path, message: &str) -> Self {
        let (path, line) = (folder.join(MANIFEST), None);
        Self::new(Place { path, line }, message)
    }
}

/// A value that a manifest may not have.
pub(super) fn refused(
    key: &str,
    value: impl ToString,
    accepted: impl Into<String>,
) -> InvalidValue {
    InvalidValue {
        key: key.to_owned(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}

/// The `message` of a parser about what stands at the key `path`, with the accepted word that is most like a wrong one.
pub(super) fn explained(message: &str, path: &str) -> String {
    let (problem, accepted) = message.split_once(", expected ").unwrap_or((message, ""));
    let unknown = ["unknown field `", "unknown variant `"];
    let word = unknown.iter().find_map(|start| problem.strip_prefix(start));
    let Some(word) = word.and_then(|word| word.strip_suffix('`')) else {
        return match path {
            "" => message.to_owned(),
            path => format!("`{path}`: {message}"),
        };
    };
    let found = match path.rsplit('.').next() == Some(word) {
        true => format!("`{path}` is no known key"),
        false => format!("`{path}` is `{word}`"),
    };
    let known: Vec<&str> = accepted.split('`').skip(1).step_by(2).collect();
    let meant =
        nearest(word, &known).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
    format!("{found}; accepted is {accepted}{meant}")
}

/// The one of `known` that is most like `word`, if any is.
fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let likeness = |other: &&str| strsim::jaro(word, other);
    let alike = known
        .iter()
        .copied()
        .filter(|other| likeness(other) > ALIKE);
    alike.max_by(|one, other| likeness(one).total_cmp(&likeness(other)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_key_is_told_with_the_nearest_known_one() {
        let message = "unknown field `comand`, expected one of `command`, `version`";
        assert_eq!(
            explained(message, "program.comand"),
            "`program.comand` is no known key; accepted is one of `command`, `version`; did you mean `command`?"
        );
        assert!(!explained(&message.replace("comand", "xyz"), "program.xyz").contains("mean"));
    }

    #[test]
    fn a_wrong_value_is_told_with_its_key() {
        let message = "unknown variant `yaml`, expected one of `json`, `toml`";
        assert_eq!(
            explained(message, "parameters.format"),
            "`parameters.format` is `yaml`; accepted is one of `json`, `toml`"
        );
        let message = "invalid type: integer `3`, expected a string";
        assert_eq!(explained(message, "name"), format!("`name`: {message}"));
    }
}
