//! As much of JSON Schema 2020-12 as the schemas of tristack use; `unknown_keywords` finds what is missing here.

use serde_json::Value;

/// Keywords that constrain nothing.
const NOTES: [&str; 10] = [
    "$schema",
    "$id",
    "$defs",
    "title",
    "description",
    "default",
    "format",
    "x-unit",
    "examples",
    "readOnly",
];
/// Keywords whose values are schemas, or hold some.
const CONSTRAINTS: [&str; 16] = [
    "$ref",
    "type",
    "const",
    "enum",
    "properties",
    "required",
    "additionalProperties",
    "items",
    "oneOf",
    "anyOf",
    "allOf",
    "minimum",
    "maximum",
    "minItems",
    "maxItems",
    "unevaluatedProperties",
];

/// Keywords of `schema`, at any depth, that are not known here.
pub fn unknown_keywords(schema: &Value) -> Vec<String> {
    let Some(entries) = schema.as_object() else {
        return Vec::new();
    };
    let mut unknown = Vec::new();
    for (key, value) in entries {
        if !NOTES.contains(&key.as_str()) && !CONSTRAINTS.contains(&key.as_str()) {
            unknown.push(key.clone());
        }
        match key.as_str() {
            "properties" | "$defs" => {
                let inner = value.as_object().into_iter().flatten();
                unknown.extend(inner.flat_map(|(_, schema)| unknown_keywords(schema)));
            }
            "items" | "additionalProperties" | "unevaluatedProperties" => {
                unknown.extend(unknown_keywords(value))
            }
            "oneOf" | "anyOf" | "allOf" => {
                let inner = value.as_array().into_iter().flatten();
                unknown.extend(inner.flat_map(unknown_keywords));
            }
            _ => {}
        }
    }
    unknown
}

/// Where and why `document` is none of `schema`; `None` if it is.
pub fn violation(schema: &Value, document: &Value) -> Option<String> {
    Checker { root: schema }.check(schema, document, "")
}

struct Checker<'a> {
    root: &'a Value,
}

impl Checker<'_> {
    fn check(&self, schema: &Value, value: &Value, path: &str) -> Option<String> {
        let entries = match schema {
            Value::Bool(true) => return None,
            Value::Object(entries) => entries,
            _ => return Some(format!("{path}: nothing is accepted here")),
        };
        let mut violations = entries.iter().filter_map(|(keyword, constraint)| {
            self.keyword(schema, keyword, constraint, value, path)
        });
        violations.next()
    }

    fn keyword(
        &self,
        schema: &Value,
        keyword: &str,
        constraint: &Value,
        value: &Value,
        path: &str,
    ) -> Option<String> {
        let refused =
            |ok: bool| (!ok).then(|| format!("{path}: {value} is against {keyword} {constraint}"));
        match keyword {
            "$ref" => {
                let pointer = constraint
                    .as_str()?
                    .strip_prefix('#')
                    .expect("a local reference");
                let target = self
                    .root
                    .pointer(pointer)
                    .expect("the target of a reference");
                self.check(target, value, path)
            }
            "type" => {
                let words = constraint
                    .as_array()
                    .cloned()
                    .unwrap_or(vec![constraint.clone()]);
                refused(
                    words
                        .iter()
                        .any(|word| has_type(value, word.as_str().unwrap_or_default())),
                )
            }
            "const" => refused(value == constraint),
            "enum" => refused(constraint.as_array()?.contains(value)),
            "minimum" => refused(
                value
                    .as_f64()
                    .is_none_or(|number| Some(number) >= constraint.as_f64()),
            ),
            "maximum" => refused(
                value
                    .as_f64()
                    .is_none_or(|number| Some(number) <= constraint.as_f64()),
            ),
            "minItems" => refused(value.as_array()?.len() as u64 >= constraint.as_u64()?),
            "maxItems" => refused(value.as_array()?.len() as u64 <= constraint.as_u64()?),
            "required" => {
                let names = constraint.as_array()?.iter().filter_map(Value::as_str);
                let object = value.as_object()?;
                let missing = names.into_iter().find(|name| !object.contains_key(*name));
                missing.map(|name| format!("{path}: `{name}` is missing"))
            }
            "properties" => {
                let mut entries = value.as_object()?.iter();
                entries.find_map(|(key, inner)| {
                    self.check(constraint.get(key)?, inner, &format!("{path}/{key}"))
                })
            }
            "additionalProperties" | "unevaluatedProperties" => {
                let known = self.properties(schema, value);
                let mut others = value
                    .as_object()?
                    .iter()
                    .filter(|(key, _)| !known.contains(key));
                others.find_map(|(key, inner)| {
                    self.check(constraint, inner, &format!("{path}/{key}"))
                })
            }
            "items" => {
                let mut items = value.as_array()?.iter().enumerate();
                items.find_map(|(index, item)| {
                    self.check(constraint, item, &format!("{path}/{index}"))
                })
            }
            "allOf" => constraint
                .as_array()?
                .iter()
                .find_map(|part| self.check(part, value, path)),
            "anyOf" | "oneOf" => self.some(keyword, constraint.as_array()?, value, path),
            _ => None,
        }
    }

    /// At least one part fits, or exactly one; the reason of each if none does.
    fn some(&self, keyword: &str, parts: &[Value], value: &Value, path: &str) -> Option<String> {
        let reasons: Vec<Option<String>> = parts
            .iter()
            .map(|part| self.check(part, value, path))
            .collect();
        let fitting = reasons.iter().filter(|reason| reason.is_none()).count();
        match fitting {
            0 => Some(
                reasons
                    .into_iter()
                    .flatten()
                    .collect::<Vec<_>>()
                    .join("; or "),
            ),
            1 => None,
            _ => (keyword == "oneOf").then(|| format!("{path}: several parts of oneOf fit")),
        }
    }

    /// The properties that `schema` names, its alternatives included.
    fn properties<'b>(&'b self, schema: &'b Value, value: &Value) -> Vec<&'b String> {
        let own = schema["properties"].as_object().into_iter().flatten();
        let mut names: Vec<&String> = own.map(|(name, _)| name).collect();
        for part in ["allOf", "anyOf", "oneOf"]
            .iter()
            .filter_map(|key| schema[*key].as_array())
            .flatten()
        {
            if self.check(part, value, "").is_none() {
                names.extend(self.properties(part, value));
            }
        }
        names
    }
}

fn has_type(value: &Value, word: &str) -> bool {
    match word {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("{other} is no type"),
    }
}
