//! Errors of a manifest: file, line, key, value, what is accepted, and the word that was probably meant.

use super::convention::ConventionKey;
use super::folder::MANIFEST;
use crate::model::{InvalidValue, readable, shown};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Least similarity ([`strsim::jaro`]) of a word to the one that it is taken to mean.
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

    /// Returns an error about the manifest of `folder` as a whole.
    pub(super) fn of_folder(folder: &Path, message: &str) -> Self {
        let (path, line) = (folder.join(MANIFEST), None);
        Self::new(Place { path, line }, message)
    }
}

/// Returns the refusal of a value that a manifest may not have.
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

/// Explains the `message` of a parser about what stands at the key `path`, and suggests the accepted word that is
/// most like a wrong one.
pub(super) fn explained(message: &str, path: &str) -> String {
    let (problem, accepted) = message.split_once(", expected ").unwrap_or((message, ""));
    let word_after = |start: &str| problem.strip_prefix(start)?.strip_suffix('`');
    let (key, value) = (
        word_after("unknown field `"),
        word_after("unknown variant `"),
    );
    let Some(word) = key.or(value) else {
        return match path {
            "" => message.to_owned(),
            path => format!("`{path}`: {message}"),
        };
    };
    let is_own = path.rsplit('.').next() == Some(word);
    let found = match (is_own, key) {
        (true, _) => format!("`{path}` is no known key"),
        (false, Some(_)) => format!("`{path}.{word}` is no known key"),
        (false, None) => format!("`{path}` is `{word}`"),
    };
    let listed: Vec<&str> = accepted.split('`').skip(1).step_by(2).collect();
    // The parser does not list the keys of a convention.
    let known = match listed.is_empty() {
        true => convention_keys(path),
        false => listed,
    };
    let meant = nearest(word, &known).map(|word| format!("; did you mean `{word}`?"));
    let accepted = match accepted {
        "" => format!("one of `{}`", known.join("`, `")),
        accepted => accepted.to_owned(),
    };
    format!(
        "{found}; accepted is {accepted}{}",
        meant.unwrap_or_default()
    )
}

/// Returns the keys below `path` that describe the convention of a code.
fn convention_keys(path: &str) -> Vec<&'static str> {
    let known = ConventionKey::ALL.into_iter().map(ConventionKey::as_str);
    let known = known.chain(["convention.restitution"]);
    let below =
        known.filter_map(|key| key.strip_prefix(path)?.strip_prefix('.')?.split('.').next());
    let mut keys: Vec<&str> = below.collect();
    keys.dedup();
    keys
}

/// Returns the one of `known` that is most like `word`, if any is similar enough.
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
    fn a_wrong_key_of_a_convention_is_told_with_the_known_ones() {
        let told = explained("unknown field `history_updat`", "convention");
        assert!(told.starts_with(
            "`convention.history_updat` is no known key; accepted is one of `pair`, `floor`, "
        ));
        assert!(told.ends_with("did you mean `history_update`?"), "{told}");
        let message = "unknown field `torqe_arm`, expected `torque_arm` or `kinematic_arm`";
        assert_eq!(
            explained(message, "convention.pair"),
            "`convention.pair.torqe_arm` is no known key; accepted is `torque_arm` or `kinematic_arm`; did you mean \
             `torque_arm`?"
        );
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
