//! Declared columns with rows, in every format.

use super::columns::{Column, Columns, Schema};
use super::look::TerminalLook;
use super::{Table, Value};
use crate::number::CRITICAL;
use serde::{Serialize, Serializer};
use serde_json::json;

/// A table whose values are computed when they are written.
pub struct DataTable<'a> {
    pub(super) schema: Schema,
    /// The columns, which take the index of a row.
    pub(super) columns: Vec<Column<'a, usize>>,
    /// Number of rows.
    pub(super) rows: usize,
}

impl DataTable<'_> {
    /// Returns the JSON object. It has the `command` that made it, unless a larger object states it.
    fn object<'b>(&'b self, command: Option<&'b str>) -> Object<'b> {
        Object {
            schema: format!("tristack/{}/{}", self.schema.name, self.schema.version),
            command,
            units: Units(self),
            rows: Rows(self),
        }
    }

    /// Returns the JSON object without a command, for use in a larger one.
    pub(crate) fn part(&self) -> impl Serialize + '_ {
        self.object(None)
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// Returns the machine-readable columns.
    fn named(&self) -> impl Iterator<Item = &Column<'_, usize>> {
        let all = self.columns.iter();
        all.filter(|column| !column.name.is_empty())
    }

    /// Returns the columns for people with their headings.
    pub(super) fn headed(&self) -> impl Iterator<Item = (&str, &Column<'_, usize>)> + Clone {
        let all = self.columns.iter();
        all.filter_map(|column| Some((column.heading.as_deref()?, column)))
    }

    /// Formats the machine-readable columns as CSV, with every digit. No text begins a formula of a spreadsheet.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header = writer.write_record(self.named().map(|column| column.name.as_ref()));
        header.expect("names are written to memory");
        for row in 0..self.rows {
            let values: Vec<Value> = self
                .named()
                .map(|column| column.value(&row).in_csv())
                .collect();
            let written = writer.serialize(values);
            written.expect("plain values are written to memory");
        }
        let bytes = writer.into_inner().expect("memory is flushed");
        String::from_utf8(bytes).expect("values are text")
    }

    /// Returns the table of the columns for people.
    pub fn shown(&self) -> Table {
        let headings = self.headed();
        let mut table = Table::new(
            headings.map(|(heading, column)| (heading.to_owned(), !column.unit.is_empty())),
        );
        for row in 0..self.rows {
            table.push(self.headed().map(|(_, column)| column.cell(&row)).collect());
        }
        let columns = self.headed().map(|(_, column)| column);
        table.from_outside = self.of_outside();
        table.on_terminals(TerminalLook {
            dispensable: columns.clone().map(|column| column.dispensable).collect(),
            with_verdicts: columns.map(|column| column.has_verdicts).collect(),
            in_files: !self.schema.name.is_empty(),
        })
    }

    /// Returns the table of the columns for people, for a page with mathematics.
    pub(crate) fn titled(&self) -> Table {
        let headings = self.headed().map(|(heading, column)| {
            let title = column.title.unwrap_or(heading);
            (title.to_owned(), !column.unit.is_empty())
        });
        let mut table = Table::new(headings);
        for row in 0..self.rows {
            let cells = self.headed().map(|(_, column)| column.cell(&row));
            table.push(cells.map(in_mathematics).collect());
        }
        table.from_outside = self.of_outside();
        table
    }

    /// Returns whether the texts of each column for people come from outside.
    fn of_outside(&self) -> Vec<bool> {
        let columns = self.headed();
        columns.map(|(_, column)| column.is_from_outside).collect()
    }

    /// Returns the transposed table: a line for each column for people, with its unit, and a column for each row,
    /// with its name from `names`.
    pub fn transposed(&self, names: &[&str]) -> Table {
        let numbers = names.iter().map(|name| (name.to_string(), true));
        let first = [("quantity".to_owned(), false)].into_iter();
        let mut table = Table::new(first.chain(numbers).chain([("unit".to_owned(), false)]));
        for (heading, column) in self.headed() {
            let unit = if column.unit == "1" { "" } else { column.unit };
            let mut cells = vec![heading.to_owned()];
            cells.extend((0..self.rows).map(|row| column.cell(&row)));
            cells.push(unit.to_owned());
            table.push(cells);
        }
        table
    }

    /// Returns the JSON Schema of the table as an object. It does not require `command`, which stands above several
    /// tables.
    pub(crate) fn json_schema(&self) -> serde_json::Value {
        let Schema {
            name,
            version,
            what,
            found_in,
        } = self.schema;
        let columns = |of: fn(&Column<usize>) -> serde_json::Value| -> serde_json::Value {
            let columns = self
                .named()
                .map(|column| (column.name.to_string(), of(column)));
            serde_json::Value::Object(columns.collect())
        };
        let names: Vec<&str> = self.named().map(|column| column.name.as_ref()).collect();
        json!({
            "description": format!("{what} In {found_in}."),
            "type": "object",
            "properties": {
                "schema": { "const": format!("tristack/{name}/{version}") },
                "command": { "type": "string" },
                "units": {
                    "description": "The unit of every column of numbers, `1` for pure ones.",
                    "type": "object",
                    "additionalProperties": { "type": "string" },
                },
                "rows": {
                    "type": "array",
                    "items": {
                        "type": "object",
                        "properties": columns(column_schema),
                        "required": names,
                        "additionalProperties": false,
                    },
                },
            },
            "required": ["schema", "units", "rows"],
            "additionalProperties": false,
        })
    }

    /// Returns the JSON Schema of a row of a file of numbers, in which whole columns may be missing.
    pub(crate) fn rows_schema(&self) -> serde_json::Value {
        let columns = self.named().map(|column| {
            let schema =
                json!({ "description": column.meaning, "type": "number", "x-unit": column.unit });
            (column.name.to_string(), schema)
        });
        let columns: serde_json::Map<_, _> = columns.collect();
        let needed = self.named().filter(|column| !column.is_optional);
        let names: Vec<&str> = needed.map(|column| column.name.as_ref()).collect();
        json!({
            "description": self.schema.what,
            "type": "object",
            "properties": columns,
            "required": names,
            "additionalProperties": false,
        })
    }

    /// Returns the name of the table.
    pub(crate) fn name(&self) -> &'static str {
        self.schema.name
    }

    /// Formats the section of docs/formats.md on the table.
    pub(crate) fn described(&self) -> String {
        let Schema {
            name,
            what,
            found_in,
            ..
        } = self.schema;
        let columns = Columns::<&Column<usize>>::for_people()
            .left("column", |column| format!("`{}`", column.name))
            .left("unit", |column| column.unit.to_owned())
            .left("meaning", |column| column.meaning.to_string())
            .rows(self.named())
            .shown();
        format!(
            "## {name}\n\n{what} In {found_in}.\n\n{}",
            columns.markdown()
        )
    }
}

/// Formats `cell` for a page with mathematics: the name of the critical friction becomes a formula.
fn in_mathematics(cell: String) -> String {
    match cell.as_str() {
        CRITICAL => "$\\mu_c$".to_owned(),
        _ => cell,
    }
}

fn column_schema(column: &Column<usize>) -> serde_json::Value {
    let kind = column.kind.as_str();
    let mut schema = json!({ "description": column.meaning, "type": kind });
    if column.is_optional {
        schema["type"] = json!([kind, "null"]);
    }
    if !column.unit.is_empty() {
        schema["x-unit"] = json!(column.unit);
    }
    schema
}

/// Formats `tables` as a JSON object with the `command` that made them. A single table has its `units` and `rows` in
/// this object; several tables are objects in its list `tables`.
pub fn json(tables: &[DataTable], command: &str) -> String {
    let json = match tables {
        [table] => serde_json::to_string_pretty(&table.object(Some(command))),
        _ => serde_json::to_string_pretty(&Objects {
            schema: "tristack/tables/1",
            command,
            tables: tables.iter().map(|table| table.object(None)).collect(),
        }),
    };
    json.expect("plain values have a JSON form") + "\n"
}

#[derive(Serialize)]
struct Objects<'a> {
    schema: &'static str,
    command: &'a str,
    tables: Vec<Object<'a>>,
}

#[derive(Serialize)]
struct Object<'a> {
    schema: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    command: Option<&'a str>,
    units: Units<'a>,
    rows: Rows<'a>,
}

struct Units<'a>(&'a DataTable<'a>);
struct Rows<'a>(&'a DataTable<'a>);
struct Row<'a>(&'a DataTable<'a>, usize);

impl Serialize for Units<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let units = self.0.named().filter(|column| !column.unit.is_empty());
        serializer.collect_map(units.map(|column| (&column.name, column.unit)))
    }
}

impl Serialize for Rows<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((0..self.0.rows).map(|row| Row(self.0, row)))
    }
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self(table, row) = self;
        serializer.collect_map(
            table
                .named()
                .map(|column| (&column.name, column.value(row))),
        )
    }
}
