//! A CSV table of JSON objects that share most of their values: values that all rows share stand once, in comments
//! above the header.
//!
//! Nested keys are joined by dots. A cell is JSON, or plain text that cannot be taken for JSON; an empty cell is an
//! absent value. The first line holds the digest of all others.

use crate::model::sha256_hex;
use serde_json::{Map, Value};
use std::collections::{BTreeMap, BTreeSet};

const DIGEST: &str = "# sha256 of all below: ";
const SHARED: &str = "# = ";

/// Most bytes of comments above the header, and deepest nesting of a key.
const MAX_SHARED: usize = 1 << 16;
const MAX_DEPTH: usize = 8;

/// A row by its columns.
type Row = BTreeMap<String, Value>;

/// Writes the table of `objects` under `title`. Columns that begin with one of `first` come first, in that order.
pub(super) fn to_csv(objects: &[Value], title: &str, first: &[&str]) -> String {
    let rows: Vec<Row> = objects.iter().map(flattened).collect();
    let keys: BTreeSet<&str> = rows
        .iter()
        .flat_map(|row| row.keys().map(String::as_str))
        .collect();
    let is_shared = |key: &&str| {
        let value = rows[0].get(*key);
        rows.len() > 1 && value.is_some() && rows.iter().all(|row| row.get(*key) == value)
    };
    let (shared, mut columns): (Vec<&str>, Vec<&str>) = keys.into_iter().partition(is_shared);
    let rank = |key: &str| first.iter().position(|start| key.starts_with(start));
    columns.sort_by_key(|key| rank(key).unwrap_or(first.len()));
    let mut text = format!("# {title}\n");
    for key in shared {
        text += &format!("{SHARED}{key} = {}\n", cell(&rows[0][key]));
    }
    text += &body(&rows, &columns);
    format!("{DIGEST}{}\n{text}", sha256_hex(text.as_bytes()))
}

/// Whether `text` begins like a table under `title`.
pub(super) fn has_title(text: &[u8], title: &str) -> bool {
    let mut lines = text.split(|&byte| byte == b'\n');
    let digest = lines
        .next()
        .is_some_and(|line| line.starts_with(DIGEST.as_bytes()));
    digest && lines.next() == Some(format!("# {title}").as_bytes())
}

fn body(rows: &[Row], columns: &[&str]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let header = columns.iter().map(|&key| key.to_owned()).collect();
    let cells = rows.iter().map(|row| {
        let values = columns.iter().map(|&key| row.get(key));
        let cells = values.map(|value| value.map_or_else(String::new, cell));
        cells.collect()
    });
    for record in std::iter::once::<Vec<String>>(header).chain(cells) {
        let written = writer.write_record(record);
        written.expect("rows are written to memory");
    }
    let bytes = writer.into_inner().expect("memory is flushed");
    String::from_utf8(bytes).expect("cells are text")
}

/// Reads the objects of the table in `text`.
///
/// # Errors
/// The first error, with its line.
pub(super) fn from_csv(text: &str) -> Result<Vec<Value>, String> {
    let (digest, text) = text.split_once('\n').unwrap_or((text, ""));
    let (digest, found) = (digest.trim_end(), sha256_hex(text.as_bytes()));
    if digest.strip_prefix(DIGEST) != Some(found.as_str()) {
        return Err(format!(
            "line 1 is `{digest}`, but the SHA-256 of all below is {found}; make the table again with: tristack \
             record"
        ));
    }
    let shared = shared(text)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|error| error.to_string())?.clone();
    let rows = reader.into_records().map(|record| {
        let record = record.map_err(|error| error.to_string())?;
        let line = record.position().map_or(0, csv::Position::line) + 1;
        let cells = header
            .iter()
            .zip(&record)
            .filter(|(_, text)| !text.is_empty());
        let cells = cells.map(|(key, text)| (key, value(text)));
        nested(shared.iter().cloned().chain(cells)).map_err(|error| format!("line {line}: {error}"))
    });
    rows.collect()
}

/// Reads the shared values from the comments at the beginning of `text`.
fn shared(text: &str) -> Result<Vec<(&str, Value)>, String> {
    let comments = text.lines().take_while(|line| line.starts_with('#'));
    let length: usize = comments.clone().map(str::len).sum();
    if length > MAX_SHARED {
        return Err(format!(
            "there are {length} bytes of comments, accepted are {MAX_SHARED}"
        ));
    }
    let pairs = comments.filter_map(|line| line.strip_prefix(SHARED)?.split_once(" = "));
    Ok(pairs.map(|(key, text)| (key, value(text))).collect())
}

/// Returns the text of `value` in a cell.
fn cell(value: &Value) -> String {
    match value {
        Value::String(text) if is_plain(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Whether `text` can stand in a cell as it is.
fn is_plain(text: &str) -> bool {
    !text.is_empty()
        && text.trim() == text
        && !text.starts_with('#')
        && !text.contains(char::is_control)
        && serde_json::from_str::<Value>(text).is_err()
}

fn value(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|_| Value::from(text))
}

/// Returns the values of an object by their joined keys, without nulls.
fn flattened(object: &Value) -> Row {
    let mut row = Row::new();
    flatten(object, "", &mut row);
    row
}

fn flatten(value: &Value, key: &str, row: &mut Row) {
    match value {
        Value::Null => {}
        Value::Object(entries) => {
            for (name, value) in entries {
                let dot = if key.is_empty() { "" } else { "." };
                flatten(value, &format!("{key}{dot}{name}"), row);
            }
        }
        leaf => drop(row.insert(key.to_owned(), leaf.clone())),
    }
}

/// Builds the object that has the given values by their joined keys.
fn nested<'a>(values: impl Iterator<Item = (&'a str, Value)>) -> Result<Value, String> {
    let mut root = Map::new();
    for (key, value) in values {
        if key.split('.').count() > MAX_DEPTH {
            return Err(format!("a column has more than {MAX_DEPTH} parts"));
        }
        let (path, name) = key.rsplit_once('.').unwrap_or(("", key));
        let mut place = &mut root;
        for part in path.split('.').filter(|part| !part.is_empty()) {
            let next = place.entry(part).or_insert_with(|| Map::new().into());
            place = next
                .as_object_mut()
                .ok_or_else(|| format!("`{key}` lies in `{part}`, which is a value"))?;
        }
        if place.insert(name.to_owned(), value).is_some() {
            return Err(format!("`{key}` is there twice"));
        }
    }
    Ok(root.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn objects() -> Vec<Value> {
        let object = |speed: f64, version: &str| {
            json!({
                "code": "yade", "date": "2026-11-21T12:22:28Z", "command": ["yade", "-n, -x"],
                "case": {"speed": speed, "kind": "1e5", "steps": 3},
                "version": version,
            })
        };
        let odd = [
            "1.0",
            "null",
            "",
            "a,\"b\"",
            "two\nlines",
            "# no comment",
            " x ",
            "[",
            "true",
        ];
        let odd = odd.iter().zip(1..);
        let mut objects: Vec<Value> = odd
            .map(|(text, n)| object(0.1 * f64::from(n), text))
            .collect();
        objects[1]["case"]["push"] = json!(6.776_87e-8);
        objects
    }

    #[test]
    fn what_was_written_comes_back() {
        let text = to_csv(&objects(), "A test", &["case"]);
        assert_eq!(from_csv(&text).unwrap(), objects(), "{text}");
        assert_eq!(
            text.matches("2026").count(),
            1,
            "shared values stand once: {text}"
        );
        let header = text.lines().find(|line| !line.starts_with('#'));
        assert_eq!(header, Some("case.push,case.speed,version"));
        let single = &objects()[..1];
        assert_eq!(from_csv(&to_csv(single, "A test", &[])).unwrap(), single);
        assert_eq!(
            from_csv(&to_csv(&[], "A test", &[])).unwrap(),
            [Value::Null; 0]
        );
    }

    #[test]
    fn what_is_cut_or_changed_anywhere_is_refused() {
        let text = to_csv(&objects(), "A test", &["case"]);
        for length in 0..text.len() {
            assert!(from_csv(&text[..length]).is_err(), "{length}");
            let mut changed = text.clone().into_bytes();
            changed[length] ^= 1;
            assert!(
                from_csv(&String::from_utf8(changed).unwrap()).is_err(),
                "{length}"
            );
        }
    }

    #[test]
    fn columns_that_contradict_each_other_are_refused() {
        let deep = format!("a{},b", ".a".repeat(100_000));
        for (header, expected) in [
            ("a,a.b", "lies in"),
            ("a,a", "is there twice"),
            (&*deep, "more than 8 parts"),
        ] {
            let text = format!("{header}\n1,2\n");
            let text = format!("{DIGEST}{}\n{text}", sha256_hex(text.as_bytes()));
            let message = from_csv(&text).unwrap_err();
            assert!(
                message.starts_with("line 3: ") && message.contains(expected),
                "{message}"
            );
        }
    }
}
