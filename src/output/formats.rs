//! docs/formats.md, generated from the declared columns.

use super::page::declared_tables;
use super::table::{Columns, DataTable};
use super::{
    bench, boundaries, budget, crosscheck, forecasts, inventory, largest_forces, probe, pyramids,
    regimes, scaling, simulations, theory, trajectories,
};
use crate::series::{COLUMNS, Sample};

const TOP: &str = "# Tables and their columns

Made from the declarations in the source (`tristack::output::formats_page`); a test compares, and
`TRISTACK_UPDATE_GOLDEN=1 cargo test --test formats` writes it anew.

Every table has the same columns and the same numbers, with all their digits, in CSV and in JSON. A missing value is an
empty field in CSV and `null` in JSON. Tables on a terminal, in Markdown, LaTeX and HTML show some of the columns, with
the digits that people want.

JSON is an object:

| key       | value                                                                                        |
|-----------|----------------------------------------------------------------------------------------------|
| `schema`  | `tristack/NAME/VERSION`; the version is raised when a column goes or changes its meaning     |
| `command` | the command that gives the same rows again, without what changes no number (`--out`, `--jobs`) |
| `units`   | the unit of every column of numbers, `1` for pure ones                                       |
| `rows`    | a list of objects, one a row                                                                 |

Where a command has several tables (`tristack regimes`), `schema` is `tristack/tables/1`, and `tables` is a list of
objects with `schema`, `units` and `rows`.

Units: mass m, radius r and normal stiffness k_n of the cylinders, and gravity g; forces F = f/(m g) are in m g.
";

/// The content of docs/formats.md: every machine-readable table, with the unit and the meaning of its columns.
pub fn formats_page() -> String {
    let mut tables = vec![
        crosscheck(&[]),
        budget(&[]),
        trajectories(&[]),
        probe(&[]),
        regimes(&[], 0, 0),
        boundaries(&[]),
        largest_forces(&[]),
        theory(&[]),
        forecasts(&[]),
        simulations(&[]),
        series(),
        bench(&[]),
        scaling(&[]),
        pyramids(&[]),
        inventory(&[]),
    ];
    tables.extend(declared_tables());
    let described = tables
        .iter()
        .map(|table| format!("\n{}", table.described()));
    TOP.to_owned() + &described.collect::<String>()
}

/// The columns of a time series, which `series` itself writes as CSV.
fn series() -> DataTable<'static> {
    let mut columns = Columns::<Sample>::new(
        "series",
        "A row is one moment of a compression. A series is CSV alone, also between tristack and a code.",
        "`tristack simulate` (series.csv)",
    );
    for column in COLUMNS {
        columns = columns.number(column.name, column.unit, column.meaning, column.value);
    }
    columns.rows([])
}
