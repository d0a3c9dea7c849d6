//! The checks of a series that need more than its forces.

use super::samples::Sample;

/// The checks, in words, each with the columns that it needs.
const CHECKS: [(&str, &[&str]); 7] = [
    (
        "the balance of forces of every cylinder",
        &["x1", "y1", "x2", "y2", "theta2", "x3", "y3"],
    ),
    (
        "the mirror symmetry of all bodies",
        &["x1", "theta1", "x2", "y2", "theta2", "x3", "y3", "theta3"],
    ),
    ("wall force against overlap", &["y1"]),
    ("floor force against overlap", &["y2", "y3"]),
    ("the state of rest", &["x2", "y1", "y2"]),
    ("the friction between the cylinders", &PAIR),
    ("whether the floor slides from onset to peak", &FLOOR),
];

/// What the contact of cylinders 1 and 2 is computed from.
pub(super) const PAIR: [&str; 5] = ["x1", "y1", "x2", "y2", "theta2"];
/// What the sliding of the floor is computed from.
pub(super) const FLOOR: [&str; 5] = ["x2", "y2", "theta2", "x3", "y3"];

/// The checks, in words, that a series without the columns `absent` does not undergo, or not in full.
pub(crate) fn not_tested<'a>(
    absent: &'a [impl AsRef<str>],
) -> impl Iterator<Item = &'static str> + 'a {
    let is_absent = |column: &&str| absent.iter().any(|name| name.as_ref() == *column);
    let checks = CHECKS.iter();
    checks.filter_map(move |(check, needed)| needed.iter().any(&is_absent).then_some(*check))
}

/// Whether the rows hold all `columns`.
pub(super) fn reports(samples: &[Sample], columns: &[&str]) -> bool {
    let Some(first) = samples.first() else {
        return false;
    };
    let named = Sample::COLUMNS.into_iter();
    let mut named = named.filter(|column| columns.contains(&column.name));
    named.all(|column| !(column.value)(first).is_nan())
}
