//! The columns of series.csv with their units, after W3C's "CSV on the Web".

use crate::series::Series;
use serde_json::{Value, json};

/// Returns the metadata of the file `name` that holds `series`: every column with its unit and meaning.
pub fn series_columns(name: &str, series: &Series) -> String {
    let columns = series.present().map(|column| {
        let kind = if column.name == "step" {
            "integer"
        } else {
            "double"
        };
        json!({
            "name": column.name,
            "titles": column.name,
            "datatype": kind,
            "dc:description": column.meaning,
            "schema:unitText": column.unit,
        })
    });
    let columns: Vec<Value> = columns.collect();
    let metadata = json!({
        "@context": "http://www.w3.org/ns/csvw",
        "url": name,
        "dc:description": "A row is one moment of a compression, in the units r = m = k_n = 1: lengths in r, times in \
                           √(m/k_n), forces in k_n r; times stiffness k_n r/(m g), forces are in m g.",
        "tableSchema": { "columns": columns },
    });
    let text = serde_json::to_string_pretty(&metadata);
    text.expect("plain values have a JSON form") + "\n"
}
