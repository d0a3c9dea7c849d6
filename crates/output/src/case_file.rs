//! A case file with the meaning of each key.

use crate::model::{Case, Law, PartialCase};
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

const HEAD: &str = "# A case for `tristack simulate --case FILE`, with every key and its default.
# A case needs only what differs: `[stack]` with `mu = 0.3` alone is one. The defaults of
# [protocol] depend on the stack; those of [convention] are for native: another code has its own.
# [protocol.shortcuts] is left out: by default there are none. So is floor_kappa of [convention.law], the stiffness
# ratio k_n/k_t of walls: by default it is that of the stack, which is 2.5 in this law and 17/14 in those that are not linear;
# and so is `bodies` of [stack], which is 2.
";

/// JSON Schema of a case file.
pub(super) fn case_schema<T: JsonSchema>() -> Value {
    let settings =
        SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let generator = settings.into_generator();
    generator.into_root_schema_for::<T>().to_value()
}

/// Formats `case` as a TOML file with a description above each key.
pub fn commented_case(case: &Case) -> String {
    let mut table = toml::Table::try_from(case).unwrap_or_default();
    let law = case.convention.law;
    // Serialization leaves out the law of linear springs; this inserts it.
    if let Some(convention) = table
        .get_mut("convention")
        .and_then(|own| own.as_table_mut())
        && let Ok(law) = toml::Value::try_from(law)
    {
        convention.insert("law".to_owned(), law);
    }
    let mut file = CommentedFile {
        text: HEAD.to_owned(),
        in_order: format!("{}\"law\":{}", case.to_json(), in_order(&law)),
    };
    file.write(&[], &table, &case_schema::<PartialCase>());
    file.text
}

fn in_order(law: &Law) -> String {
    serde_json::to_string(law).expect("a law has only named fields and finite numbers")
}

struct CommentedFile {
    text: String,
    /// The same values as JSON, with their keys in the order of the declarations.
    in_order: String,
}

impl CommentedFile {
    /// Writes values before tables: in TOML, keys that follow a table header belong to that table.
    fn write(&mut self, path: &[&str], table: &toml::Table, schema: &Value) {
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, value)| {
            (value.is_table(), self.in_order.find(&format!("\"{key}\":")))
        });
        for (key, value) in entries {
            let described = described(schema, key);
            match value.as_table() {
                None => self.text += &format!("{}{key} = {value}\n", comment(&described)),
                Some(inner) => {
                    let path = [path, &[key]].concat();
                    self.text += &format!("\n{}[{}]\n", comment(&described), path.join("."));
                    self.write(&path, inner, &described);
                }
            }
        }
    }
}

/// Returns the schema of the property `key`. If `key` holds the word that tells alternatives apart, the schema lists
/// all of them.
fn described(schema: &Value, key: &str) -> Value {
    let found = property(schema, key).cloned().unwrap_or_default();
    if found["const"].is_null() {
        return found;
    }
    let alternatives =
        alternatives(schema).flat_map(|part| [part].into_iter().chain(alternatives(part)));
    let words = alternatives.filter_map(|part| {
        let word = part["properties"].get(key)?;
        Some(json!({ "const": word["const"], "description": part["description"] }))
    });
    json!({ "description": "One of:", "oneOf": words.collect::<Vec<_>>() })
}

/// Returns the schema of the property `key`: that of `schema` itself, or of the first alternative that has it.
fn property<'a>(schema: &'a Value, key: &str) -> Option<&'a Value> {
    let own = schema["properties"].get(key);
    own.or_else(|| alternatives(schema).find_map(|part| property(part, key)))
}

fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    let parts = ["anyOf", "oneOf", "allOf"].map(|name| schema[name].as_array());
    parts.into_iter().flatten().flatten()
}

/// Formats the description of a key as TOML comments, followed by the words that it accepts.
fn comment(schema: &Value) -> String {
    let description = schema["description"].as_str().unwrap_or_default();
    let mut lines: Vec<String> = description.lines().map(str::to_owned).collect();
    let words = alternatives(schema).filter_map(|part| {
        let word = part["const"].as_str()?;
        let meaning = part["description"].as_str().unwrap_or_default();
        Some(format!("- \"{word}\": {}", meaning.replace('\n', " ")))
    });
    lines.extend(words);
    let lines = lines.iter().map(|line| format!("# {line}"));
    lines
        .map(|line| line.trim_end().to_owned() + "\n")
        .collect()
}
