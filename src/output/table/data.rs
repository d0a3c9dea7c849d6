//! Declared columns with rows, in every format.

use super::columns::{Columns, Schema};
use super::{Table, Value};
use serde::ser::{Serialize, SerializeMap, Serializer};

/// A column without its values.
#[derive(Debug, Clone)]
struct Heading {
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
    heading: Option<&'static str>,
}

/// A table with its values, which are computed when they are written.
pub struct DataTable<'a> {
    schema: Schema,
    columns: Vec<Heading>,
    rows: usize,
    value: Box<dyn Fn(usize, usize) -> Value + 'a>,
    cell: Box<dyn Fn(usize, usize) -> String + 'a>,
}

impl<'a> DataTable<'a> {
    pub(super) fn new<R: 'a>(declared: Columns<'a, R>, rows: Vec<R>) -> Self {
        let columns = declared.list.iter().map(|column| Heading {
            name: column.name,
            unit: column.unit,
            meaning: column.meaning,
            heading: column.heading,
        });
        let (columns, count) = (columns.collect(), rows.len());
        let shared = std::rc::Rc::new((declared.list, rows));
        let values = shared.clone();
        Self {
            schema: declared.schema,
            columns,
            rows: count,
            value: Box::new(move |row, column| (values.0[column].value)(&values.1[row])),
            cell: Box::new(move |row, column| {
                let (column, row) = (&shared.0[column], &shared.1[row]);
                match &column.cell {
                    Some(cell) => cell(row),
                    None => (column.value)(row).shown(column.digits),
                }
            }),
        }
    }

    /// Name and version, as in JSON.
    pub(crate) fn schema(&self) -> String {
        format!("tristack/{}/{}", self.schema.name, self.schema.version)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows == 0
    }

    /// The machine-readable columns, with their index.
    fn named(&self) -> impl Iterator<Item = (usize, &Heading)> {
        let all = self.columns.iter().enumerate();
        all.filter(|(_, column)| !column.name.is_empty())
    }

    /// The machine-readable columns as CSV, with every digit.
    pub(crate) fn csv(&self) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let names: Vec<&str> = self.named().map(|(_, column)| column.name).collect();
        let header = writer.write_record(names);
        header.expect("names are written to memory");
        for row in 0..self.rows {
            let values: Vec<Value> = self.named().map(|(at, _)| (self.value)(row, at)).collect();
            let written = writer.serialize(values);
            written.expect("plain values are written to memory");
        }
        writer.into_inner().expect("memory is flushed")
    }

    /// The columns for people.
    pub fn shown(&self) -> Table {
        let all = self.columns.iter().enumerate();
        let shown = all.filter_map(|(at, column)| Some((at, column.heading?, column.unit)));
        let shown: Vec<(usize, &str, &str)> = shown.collect();
        let mut table = Table::new(
            shown
                .iter()
                .map(|(_, name, unit)| (name.to_string(), !unit.is_empty())),
        );
        for row in 0..self.rows {
            table.push(shown.iter().map(|(at, ..)| (self.cell)(row, *at)).collect());
        }
        table
    }

    /// The columns for people as lines with their units, and the rows as columns with the given names.
    pub(crate) fn transposed(&self, names: &[&str]) -> Table {
        let numbers = names.iter().map(|name| (name.to_string(), true));
        let first = [("quantity".to_owned(), false)].into_iter();
        let mut table = Table::new(first.chain(numbers).chain([("unit".to_owned(), false)]));
        for (at, column) in self.columns.iter().enumerate() {
            if let Some(heading) = column.heading {
                let unit = if column.unit == "1" { "" } else { column.unit };
                let mut cells = vec![heading.to_owned()];
                cells.extend((0..self.rows).map(|row| (self.cell)(row, at)));
                cells.push(unit.to_owned());
                table.push(cells);
            }
        }
        table
    }

    /// The section of docs/formats.md on the table.
    pub(crate) fn described(&self) -> String {
        let Schema {
            name,
            what,
            found_in,
            ..
        } = self.schema;
        let columns = Columns::<&Heading>::for_people()
            .left("column", |column| format!("`{}`", column.name))
            .left("unit", |column| column.unit.to_owned())
            .left("meaning", |column| column.meaning.to_owned())
            .rows(self.named().map(|(_, column)| column))
            .shown();
        format!(
            "## {name}\n\n{what} In {found_in}.\n\n{}",
            columns.markdown()
        )
    }
}

/// `tables` as a JSON object with the `command` that made them. A single table has its `units` and `rows` in this
/// object, several are objects in a list `tables`.
pub(crate) fn json(tables: &[DataTable], command: &str) -> Vec<u8> {
    let object = Object { tables, command };
    let mut json = serde_json::to_vec_pretty(&object).expect("plain values have a JSON form");
    json.push(b'\n');
    json
}

struct Object<'a> {
    tables: &'a [DataTable<'a>],
    command: &'a str,
}

struct Units<'a>(&'a DataTable<'a>);
struct Rows<'a>(&'a DataTable<'a>);
struct Row<'a>(&'a DataTable<'a>, usize);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if let [table] = self.tables {
            map.serialize_entry("schema", &table.schema())?;
            map.serialize_entry("command", self.command)?;
            map.serialize_entry("units", &Units(table))?;
            map.serialize_entry("rows", &Rows(table))?;
        } else {
            map.serialize_entry("schema", "tristack/tables/1")?;
            map.serialize_entry("command", self.command)?;
            map.serialize_entry("tables", self.tables)?;
        }
        map.end()
    }
}

impl Serialize for DataTable<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(3))?;
        map.serialize_entry("schema", &self.schema())?;
        map.serialize_entry("units", &Units(self))?;
        map.serialize_entry("rows", &Rows(self))?;
        map.end()
    }
}

impl Serialize for Units<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = self.0.named().map(|(_, column)| column);
        let units = columns.filter(|column| !column.unit.is_empty());
        serializer.collect_map(units.map(|column| (column.name, column.unit)))
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
        let columns = table.named();
        serializer.collect_map(columns.map(|(at, column)| (column.name, (table.value)(*row, at))))
    }
}
