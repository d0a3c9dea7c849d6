//! What the properties of passports mean.

use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// What a property means.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Meaning {
    /// Name without the kind of contact and without the axis.
    pub name: String,
    /// Name in prose.
    pub title: String,
    /// The group of properties that it belongs to.
    pub group: String,
    /// Definition.
    pub text: String,
    /// Whether it moves the quasi-static yield force.
    pub moves_force: bool,
    /// How it changes the yield force.
    pub force: String,
}

/// The meanings of all properties.
pub fn meanings() -> &'static [Meaning] {
    #[derive(Deserialize)]
    struct File {
        property: Vec<Meaning>,
    }
    static MEANINGS: LazyLock<Vec<Meaning>> = LazyLock::new(|| {
        let file = toml::from_str::<File>(include_str!("properties.toml"));
        file.expect("the file is part of the program and tested")
            .property
    });
    &MEANINGS
}

/// Splits the name of a property into its base name, and the kind of contact and the axis together.
pub fn base_name(property: &str) -> (&str, String) {
    let kinds = ["pair", "floor", "wall"];
    let kind = kinds.into_iter().find_map(|kind| {
        let rest = property.strip_prefix(kind)?.strip_prefix('_')?;
        Some((kind, rest))
    });
    let (kind, rest) = kind.unwrap_or(("", property));
    let axis = rest
        .starts_with("space_spin_")
        .then_some(rest)
        .or(rest.starts_with("space_torque_").then_some(rest))
        .and_then(|rest| rest.rsplit_once('_'));
    match axis {
        Some((base, axis)) => (base, format!("{kind} {axis}")),
        None => (rest, kind.to_owned()),
    }
}
