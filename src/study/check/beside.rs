//! The series of a code beside that of the native DEM, in units in which a deviation of 1 is as large as the load or the
//! whole displacement.

use super::rows::{ANGLES, FORCES, LENGTHS, Row, WIDTH, index, indices, peak};

/// Largest distance of two codes with the same law, whose integrators differ: ten times that of LAMMPS.
pub(super) const SAME: f64 = 1e-3;
/// Part of a deviation that may remain where its cause is found, and part of the largest that is none.
const EXPLAINED: f64 = 0.1;

/// Both series, row by row.
pub(super) struct Beside<'a> {
    /// What the code wrote.
    pub found: &'a [Row],
    /// What the native DEM writes.
    pub expected: &'a [Row],
    /// The same in every step.
    pub dense: &'a [Row],
    scales: Row,
    /// The columns that are there, but for step and time.
    pub columns: Vec<usize>,
}

impl<'a> Beside<'a> {
    pub fn new(found: &'a [Row], expected: &'a [Row], dense: &'a [Row]) -> Self {
        let is_there = |column: &usize| found.iter().all(|row| row[*column].is_finite());
        let all = (index("time") + 1..WIDTH).filter(is_there);
        Self {
            columns: all.collect(),
            scales: scales(expected),
            found,
            expected,
            dense,
        }
    }

    /// The largest distance in `columns` between what was found and the rows `other`, which are those that are expected
    /// with a mistake in what is written, up to the peak.
    pub fn distance(&self, other: &[Row], columns: &[usize]) -> f64 {
        self.distance_until(peak(self.expected), other, columns)
    }

    /// The same of another run, which may have its peak elsewhere, up to the later peak.
    pub fn distance_of_run(&self, run: &[Row]) -> f64 {
        let last = peak(run).max(peak(self.found));
        self.distance_until(last, run, &self.columns)
    }

    fn distance_until(&self, last: usize, other: &[Row], columns: &[usize]) -> f64 {
        let rows = self.found.iter().zip(other).take(last + 1);
        let apart = rows.flat_map(|(found, other)| {
            let apart =
                |column: &usize| (found[*column] - other[*column]).abs() / self.scales[*column];
            columns.iter().map(apart)
        });
        apart.fold(0.0, |worst, apart| match apart > worst || apart.is_nan() {
            true => apart,
            false => worst,
        })
    }

    /// The distance of one column from what is expected.
    pub fn of_column(&self, column: usize) -> f64 {
        self.distance(self.expected, &[column])
    }

    /// The columns that are not as expected; those that deviate most where all deviations are small.
    pub fn deviating(&self) -> Vec<usize> {
        let least = SAME.min(EXPLAINED * self.distance(self.expected, &self.columns));
        let columns = self.columns.iter().copied();
        let deviates = |column: &usize| {
            let distance = self.of_column(*column);
            distance > least || distance.is_nan()
        };
        columns.filter(deviates).collect()
    }

    /// Whether the rows `other` explain what was found in `columns`.
    pub fn explains(&self, other: &[Row], columns: &[usize]) -> bool {
        let before = self.distance(self.expected, columns);
        let rest = self.distance(other, columns);
        rest < SAME && rest <= EXPLAINED * before
    }

    /// The distance of another run, if it explains what was found.
    pub fn explained_by(&self, run: &[Row]) -> Option<f64> {
        let before = self.distance(self.expected, &self.columns);
        let rest = self.distance_of_run(run);
        (rest < SAME && rest <= EXPLAINED * before).then_some(rest)
    }

    /// The first row in which a column is off, and its values: found, expected.
    pub fn first_off(&self, column: usize) -> Option<(usize, f64, f64)> {
        let values = self.found.iter().zip(self.expected);
        let mut values = values.map(|(found, expected)| (found[column], expected[column]));
        let off = values
            .position(|(found, expected)| (found - expected).abs() >= SAME * self.scales[column]);
        off.map(|row| (row, self.found[row][column], self.expected[row][column]))
    }
}

/// The load, the largest displacement, and the largest rotation.
fn scales(rows: &[Row]) -> Row {
    let rows = &rows[..=peak(rows).min(rows.len().saturating_sub(1))];
    let mut scales = [1.0; WIDTH];
    let largest = |names: &[&str], value: &dyn Fn(&Row, usize) -> f64| {
        let columns = indices(names);
        let values = rows
            .iter()
            .flat_map(|row| columns.iter().map(|&column| value(row, column).abs()));
        values.fold(f64::MIN_POSITIVE, f64::max)
    };
    let start = rows.first().copied().unwrap_or([0.0; WIDTH]);
    for (names, scale) in [
        (&FORCES[..], largest(&FORCES, &|row, column| row[column])),
        (
            &LENGTHS,
            largest(&LENGTHS, &|row, column| row[column] - start[column]),
        ),
        (
            &ANGLES,
            largest(&ANGLES, &|row, column| row[column] - start[column]),
        ),
    ] {
        for column in indices(names) {
            scales[column] = scale;
        }
    }
    scales
}
