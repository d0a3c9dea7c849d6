//! The checks of a series that need more than its forces.

use super::sample::Sample;
use crate::model::Stack;

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

/// The columns from which the contact of cylinders 1 and 2 is computed.
const PAIR: [&str; 5] = ["x1", "y1", "x2", "y2", "theta2"];
/// The columns from which the sliding of the floor is computed.
const FLOOR: [&str; 5] = ["x2", "y2", "theta2", "x3", "y3"];

/// Returns the checks, in words, that a series without the columns `absent` skips, wholly or in part.
pub fn not_tested<'a>(absent: &'a [impl AsRef<str>]) -> impl Iterator<Item = &'static str> + 'a {
    // The rotation of cylinders is about z alone.
    let plain = |name: &str| name.replace("thetaz", "theta");
    let absent: Vec<String> = absent.iter().map(|name| plain(name.as_ref())).collect();
    let is_absent = move |column: &&str| absent.iter().any(|name| name == *column);
    let checks = CHECKS.iter();
    checks.filter_map(move |(check, needed)| needed.iter().any(&is_absent).then_some(*check))
}

/// Whether all `needed` numbers are reported, judged by the first row.
pub(super) fn reports(samples: &[Sample], needed: impl Fn(&Sample) -> Vec<f64>) -> bool {
    let first = samples.first();
    first.is_some_and(|first| !needed(first).iter().any(|number| number.is_nan()))
}

/// The numbers needed for the forces between the top body and the first body on the floor.
pub(super) fn of_pair(sample: &Sample, stack: &Stack) -> Vec<f64> {
    let first = sample.first(stack);
    let [x, y, z] = sample.top(stack);
    vec![x, y, z, first.outwards, first.height, first.turn]
}

/// The numbers needed for the sliding of the floor.
pub(super) fn of_floor(sample: &Sample, stack: &Stack) -> Vec<f64> {
    let contacts = sample.floor_contacts(stack);
    contacts
        .flat_map(|contact| [contact.outwards, contact.height, contact.turn])
        .collect()
}
