//! What all vector files share: provenance, agreement of two routes, layout, and the tables of the second route.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tristack::model::sha256_hex;

pub const LICENCE: &str = "CC0-1.0";
const COMMAND: &str = "TRISTACK_UPDATE_GOLDEN=1 cargo test --test physics vectors";
const GENERATOR: &str = "python3 reference/golden/vectors.py";

/// What made the numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Name and version of the program of the first route.
    program: String,
    /// SHA-256 of its sources that decide the numbers.
    program_sources: String,
    /// The command that writes this file.
    command: String,
    /// The command that computes the numbers of the second route; it needs mpmath.
    second_route: String,
    /// SHA-256 of its sources.
    second_sources: String,
}

impl Provenance {
    pub fn of(program_sources: String) -> Self {
        let generator = ["vectors.py", "generate.py"].map(golden);
        let generator = generator.map(|path| fs::read(path).expect("the generator is there"));
        Self {
            program: format!("tristack {}", env!("CARGO_PKG_VERSION")),
            program_sources,
            command: COMMAND.to_owned(),
            second_route: GENERATOR.to_owned(),
            second_sources: sha256_hex(&generator.concat()),
        }
    }
}

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

pub fn folder() -> PathBuf {
    project("reference/vectors")
}

fn golden(name: &str) -> PathBuf {
    project("reference/golden").join(name)
}

/// SHA-256 of all Rust sources below the `folders` of the project, in the order of their paths.
pub fn sources_hash(folders: &[&str]) -> String {
    let mut waiting: Vec<PathBuf> = folders.iter().map(|folder| project(folder)).collect();
    let mut files = Vec::new();
    while let Some(path) = waiting.pop() {
        match path.is_dir() {
            true => waiting.extend(
                fs::read_dir(path)
                    .expect("a folder")
                    .map(|entry| entry.expect("an entry").path()),
            ),
            false => files.push(path),
        }
    }
    files.sort();
    let contents: Vec<Vec<u8>> = files
        .iter()
        .map(|path| fs::read(path).expect("a source"))
        .collect();
    sha256_hex(&contents.concat())
}

pub fn updating() -> bool {
    std::env::var_os("TRISTACK_UPDATE_GOLDEN").is_some()
}

/// The file `name` as it is, after writing `now` there if that is asked for.
pub fn kept(name: &str, now: &str) -> String {
    let path = folder().join(name);
    if updating() {
        fs::write(&path, now).expect("the file is written");
    }
    fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("{}: {error}; {COMMAND}", path.display()))
}

/// Indented JSON with every entry of the lists `long` on a line of its own.
pub fn layout(document: &impl Serialize, long: &[&str]) -> String {
    let mut document = serde_json::to_value(document).expect("plain values");
    let mut lists = Vec::new();
    for name in long {
        let entries = document[name].take();
        let entries = entries.as_array().expect("a list").iter();
        lists.push((name, entries.map(Value::to_string).collect::<Vec<_>>()));
    }
    let mut text = serde_json::to_string_pretty(&document).expect("plain values") + "\n";
    for (name, lines) in lists {
        let lines = lines.join(",\n    ");
        text = text.replace(
            &format!("\"{name}\": null"),
            &format!("\"{name}\": [\n    {lines}\n  ]"),
        );
    }
    text
}

/// The JSON Schema of `T`, as a file.
pub fn schema<T: JsonSchema>() -> String {
    let schema = schemars::schema_for!(T);
    serde_json::to_string_pretty(&schema).expect("plain values") + "\n"
}

/// Rows of a table of the second route, by the names of their columns.
pub fn second_route(name: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(golden(name)).expect("the table is there");
    let rows = reader.deserialize();
    rows.map(|row| row.expect("a row")).collect()
}

/// Digits to which `first` and `second` agree, relative to `scale`: they are no further apart than half of
/// 10^−digits of it.
pub fn digits_of_agreement(first: f64, second: f64, scale: f64, most: u32) -> u32 {
    let apart = 2.0 * (first - second).abs();
    let fits = |digits: &u32| apart <= scale.abs() * 10f64.powi(-(*digits as i32));
    (0..=most).rev().find(fits).unwrap_or(0)
}
