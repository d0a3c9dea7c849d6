//! A case file with the meaning of each key.

use crate::model::{Case, PartialCase};
use schemars::generate::SchemaSettings;
use serde_json::Value;

const HEAD: &str = "# A case for `tristack simulate --case FILE`, with every key and its default.
# A case needs only what differs: `[stack]` with `mu = 0.3` alone is one. The defaults of
# [protocol] depend on the stack; those of [convention] are for native: another code has its own.
";

/// JSON Schema of a case file.
pub(super) fn case_schema() -> Value {
    let settings =
        SchemaSettings::draft2020_12().with(|settings| settings.inline_subschemas = true);
    let generator = settings.into_generator();
    generator.into_root_schema_for::<PartialCase>().to_value()
}

/// `case` as a TOML file, each key below its description.
pub(crate) fn commented_case(case: &Case) -> String {
    let table = toml::Table::try_from(case).unwrap_or_default();
    let mut text = HEAD.to_owned();
    write_table(&mut text, "", &table, &case_schema());
    text
}

/// Values first: in TOML what follows a table belongs to it.
fn write_table(text: &mut String, path: &str, table: &toml::Table, schema: &Value) {
    let described = |key: &str| property(schema, key).cloned().unwrap_or_default();
    for (key, value) in table.iter().filter(|(_, value)| !value.is_table()) {
        *text += &comment(&described(key));
        *text += &format!("{key} = {value}\n");
    }
    for (key, value) in table {
        if let Some(inner) = value.as_table() {
            let path = if path.is_empty() {
                key.clone()
            } else {
                format!("{path}.{key}")
            };
            let schema = described(key);
            *text += &format!("\n{}[{path}]\n", comment(&schema));
            write_table(text, &path, inner, &schema);
        }
    }
}

/// The schema of the property `key`, in the first alternative that has it.
fn property<'a>(schema: &'a Value, key: &str) -> Option<&'a Value> {
    let own = schema["properties"].get(key);
    own.or_else(|| alternatives(schema).find_map(|part| property(part, key)))
}

fn alternatives(schema: &Value) -> impl Iterator<Item = &Value> {
    let parts = ["anyOf", "oneOf", "allOf"].map(|name| schema[name].as_array());
    parts.into_iter().flatten().flatten()
}

/// The description of a key as comments, with the words that it may have.
fn comment(schema: &Value) -> String {
    let description = schema["description"].as_str().unwrap_or_default();
    let mut lines: Vec<String> = description.lines().map(str::to_owned).collect();
    let words = alternatives(schema).filter_map(|part| {
        let word = part["const"].as_str()?;
        let meaning = part["description"].as_str().unwrap_or_default();
        Some(format!("- \"{word}\": {}", meaning.replace('\n', " ")))
    });
    lines.extend(words);
    lines
        .iter()
        .map(|line| format!("# {line}").trim_end().to_owned() + "\n")
        .collect()
}
