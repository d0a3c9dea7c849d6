//! JSON Schema (2020-12) of the documents that tristack reads and writes, generated from their declarations. The
//! keyword `x-unit` holds the unit of a number.

use super::case_file::case_schema;
use super::formats::{json_tables, result_files};
use super::passport::passport_schema;
use crate::code::{Definition, TASK_SCHEMA, TaskKind};
use crate::model::PartialCase;
use crate::paper::published::GivenCase;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

const DIALECT: &str = "https://json-schema.org/draft/2020-12/schema";

/// A kind of document.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Document {
    /// Parameters of a task.
    Task,
    /// A case file.
    Case,
    /// A case file with a given start.
    GivenCase,
    /// A manifest.
    Manifest,
    /// A passport.
    Passport,
    /// The result of a task.
    Result,
    /// Tables of the commands.
    Rows,
}

impl Document {
    /// Every kind.
    pub const ALL: [Self; 7] = [
        Self::Task,
        Self::Case,
        Self::GivenCase,
        Self::Manifest,
        Self::Passport,
        Self::Result,
        Self::Rows,
    ];

    /// Describes the document for users.
    pub fn description(self) -> &'static str {
        match self {
            Self::Task => "Parameters of a task, as a code is given them",
            Self::Case => "A case file, as `simulate --case` reads it",
            Self::GivenCase => "A case file with a given start, which `simulate --case` reads too",
            Self::Manifest => "code.toml, the manifest of a folder",
            Self::Passport => "Passport of a code, from `probe --out`",
            Self::Result => {
                "Result of a task: rows of a series or a motion, which a code writes as CSV"
            }
            Self::Rows => "Tables that the commands print and write as JSON",
        }
    }

    /// Returns the JSON Schema of the document.
    pub fn json_schema(self) -> Value {
        let mut schema = match self {
            Self::Task => task(),
            Self::Case => case_schema::<PartialCase>(),
            Self::GivenCase => case_schema::<GivenCase>(),
            Self::Manifest => manifest(),
            Self::Passport => passport_schema(),
            Self::Result => result(),
            Self::Rows => rows(),
        };
        schema["$schema"] = json!(DIALECT);
        schema["$id"] = json!(self.id());
        schema
    }

    /// The name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Task => "task",
            Self::Case => "case",
            Self::GivenCase => "given-case",
            Self::Manifest => "manifest",
            Self::Passport => "passport",
            Self::Result => "result",
            Self::Rows => "rows",
        }
    }

    fn id(self) -> String {
        let version = match self {
            Self::Task => TASK_SCHEMA,
            _ => 1,
        };
        format!("urn:tristack:{}:{version}", self.as_str())
    }
}

/// Returns one schema that defines those of all documents, each under its name.
pub fn all_json_schemas() -> Value {
    let documents = Document::ALL.into_iter();
    let named = documents.map(|one| (one.as_str().to_owned(), one.json_schema()));
    json!({ "$schema": DIALECT, "$defs": named.collect::<Map<_, _>>() })
}

/// Returns a schema that accepts any one of `parts`, each defined under its name.
fn one_of(description: &str, parts: impl IntoIterator<Item = (&'static str, Value)>) -> Value {
    let parts: Map<_, _> = parts
        .into_iter()
        .map(|(name, part)| (name.to_owned(), part))
        .collect();
    let links: Vec<Value> = parts.keys().map(|name| link(name)).collect();
    json!({ "description": description, "oneOf": links, "$defs": parts })
}

fn link(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

fn task() -> Value {
    let kinds = TaskKind::ALL.map(|kind| (kind.as_str(), kind.parameters_schema()));
    let about = "Parameters of a task, one object of numbers and lists, in the units r = m = k_n = 1; decks with `content = \"deck\"` are \
                 given fewer, and no lists.";
    // What a rigid stack is given is a part of what an elastic one is.
    let mut schema = one_of(about, kinds);
    if let Some(keywords) = schema.as_object_mut() {
        let parts = keywords.remove("oneOf");
        keywords.extend(parts.map(|parts| ("anyOf".to_owned(), parts)));
    }
    schema
}

fn manifest() -> Value {
    let settings =
        SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let schema = settings
        .into_generator()
        .into_root_schema_for::<Definition>();
    let mut schema = schema.to_value();
    // Keys of the convention that a manifest leaves out have no default: they are measured.
    let convention = without(&schema["properties"]["convention"], "default");
    schema["properties"]["convention"] = convention;
    // A variant overrides single keys, so that it requires none.
    let mut variant = without(&schema, "required");
    if let Some(keys) = variant["properties"].as_object_mut() {
        for own in ["schema", "name", "variants"] {
            keys.remove(own);
        }
    }
    if let Some(entries) = variant.as_object_mut() {
        entries.retain(|key, _| !["$schema", "title", "description"].contains(&key.as_str()));
    }
    schema["properties"]["variants"]["additionalProperties"] = variant;
    // A manifest that extends another one takes its other keys from there, so that they are not required.
    let mut extending = without(&schema, "required");
    extending["required"] = json!(["schema", "name", "extends"]);
    if let Some(keys) = schema["properties"].as_object_mut() {
        keys.remove("extends");
    }
    json!({ "title": "Manifest", "anyOf": [schema, extending] })
}

/// Returns `schema` without `keyword` at any depth.
fn without(schema: &Value, keyword: &str) -> Value {
    match schema {
        Value::Object(entries) => {
            let kept = entries.iter().filter(|(key, _)| *key != keyword);
            let kept = kept.map(|(key, value)| (key.clone(), without(value, keyword)));
            Value::Object(kept.collect())
        }
        Value::Array(items) => items.iter().map(|item| without(item, keyword)).collect(),
        other => other.clone(),
    }
}

fn result() -> Value {
    let about = "What a code delivers for a task: CSV, or the table of a log, of which each line is one of these rows.";
    let files = result_files();
    one_of(
        about,
        files.iter().map(|file| (file.name(), file.rows_schema())),
    )
}

fn rows() -> Value {
    let tables = json_tables();
    let tables = tables
        .iter()
        .map(|table| (table.name(), table.json_schema()));
    let mut schema = one_of(
        "One or several tables, and the command that gives the same rows again.",
        tables,
    );
    let one = json!({ "oneOf": schema["oneOf"].take(), "required": ["command"] });
    schema["oneOf"] = json!([one, {
        "type": "object",
        "properties": {
            "schema": { "const": "tristack/tables/1" },
            "command": { "type": "string" },
            "tables": { "type": "array", "items": { "oneOf": one["oneOf"] } },
        },
        "required": ["schema", "command", "tables"],
        "additionalProperties": false,
    }]);
    schema
}
