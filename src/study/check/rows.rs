//! A series as rows of numbers, so that mistakes can be made with columns.

use crate::series::{Sample, Series};

/// Number of columns.
pub(super) const WIDTH: usize = Sample::COLUMNS.len();

/// One row, in the order of the columns.
pub(super) type Row = [f64; WIDTH];

/// Names of the columns that hold forces, heights, widths and angles.
pub(super) const WALL: [&str; 1] = ["wall_force"];
pub(super) const NORMALS: [&str; 2] = ["floor_n2", "floor_n3"];
pub(super) const SHEARS: [&str; 2] = ["floor_t2", "floor_t3"];
pub(super) const FORCES: [&str; 5] = ["wall_force", "floor_n2", "floor_t2", "floor_n3", "floor_t3"];
pub(super) const FLOOR: [&str; 4] = ["floor_n2", "floor_t2", "floor_n3", "floor_t3"];
pub(super) const HEIGHTS: [&str; 3] = ["y1", "y2", "y3"];
pub(super) const WIDTHS: [&str; 3] = ["x1", "x2", "x3"];
pub(super) const LENGTHS: [&str; 6] = ["x1", "y1", "x2", "y2", "x3", "y3"];
pub(super) const ANGLES: [&str; 3] = ["theta1", "theta2", "theta3"];
/// The columns that change their sign in a mirror.
pub(super) const MIRRORED: [&str; 8] = [
    "x1", "theta1", "x2", "theta2", "x3", "theta3", "floor_t2", "floor_t3",
];

/// The place of a column.
pub(super) fn index(name: &str) -> usize {
    let place = Sample::COLUMNS.iter().position(|own| own.name == name);
    place.expect("it names a column of a series")
}

/// The places of columns.
pub(super) fn indices(names: &[&str]) -> Vec<usize> {
    names.iter().map(|name| index(name)).collect()
}

/// The name of the column at a place.
pub(super) fn name(column: usize) -> &'static str {
    Sample::COLUMNS[column].name
}

/// The rows of `series`.
pub(super) fn rows_of(series: &Series) -> Vec<Row> {
    let rows = series.samples().iter();
    rows.map(|sample| Sample::COLUMNS.map(|column| (column.value)(sample)))
        .collect()
}

/// The row with the largest wall force.
pub(super) fn peak(rows: &[Row]) -> usize {
    let force = index("wall_force");
    let highest = (0..rows.len()).max_by(|&i, &j| rows[i][force].total_cmp(&rows[j][force]));
    highest.unwrap_or(0)
}

/// The row at a time between two of `rows`; before the first one the stack is at rest.
pub(super) fn at_time(rows: &[Row], time: f64) -> Row {
    let place = index("time");
    let after = rows.partition_point(|row| row[place] < time);
    let after = after.clamp(1, rows.len() - 1);
    let [one, two] = [&rows[after - 1], &rows[after]];
    let share = ((time - one[place]) / (two[place] - one[place])).max(0.0);
    let mut row: Row =
        std::array::from_fn(|column| one[column] + share * (two[column] - one[column]));
    if time < 0.0 {
        row[index("wall_force")] = 0.0;
    }
    row
}
