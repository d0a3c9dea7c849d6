//! Tables of the differences between two passports.

use super::number::{digits, one_digit, optional, or_dash, plain, relative, significant};
use super::table::{Columns, DataTable};
use crate::study::atlas::{Change, ForceChange};

/// Returns the table of the rules and properties that differ.
pub fn passport_changes(changes: &[Change]) -> DataTable<'_> {
    Columns::<&Change>::new(
        "passport_changes",
        "A row is a rule or a property in which two passports differ by more than their uncertainties.",
        "`tristack passport diff`, `tristack atlas` (changes.json)",
    )
    .text("name", |own| own.name.clone())
    .means("key of the convention, or name of the property")
    .shown("what")
    .text("before", |own| own.before.clone())
    .means("as the first passport has it; absent where that does not know it")
    .shown("before")
    .cell(|own| cell(own.before.as_deref()))
    .text("after", |own| own.after.clone())
    .means("as the second passport has it")
    .shown("after")
    .cell(|own| cell(own.after.as_deref()))
    .number("change", "1", |own| own.change)
    .means("second minus first; absent for words")
    .shown_as("change", relative)
    .number("uncertainty", "1", |own| own.uncertainty)
    .means("sum of both uncertainties")
    .shown_as("±", one_digit)
    .number("uncertainties", "1", |own| own.uncertainties())
    .means("size of the change in units of that")
    .shown_as("uncertainties", one_digit)
    .text("moves_limit", |own| own.moves_limit)
    .means("whether it is an arm, which moves the quasi-static limit of the yield force")
    .shown("an arm")
    .rows(changes)
}

/// Returns the table of yield forces under the arms of two passports.
pub fn passport_forces(forces: &[ForceChange]) -> DataTable<'_> {
    Columns::<&ForceChange>::new(
        "passport_forces",
        "A row is the exact yield force of one stack under the arms of two passports.",
        "`tristack passport diff`",
    )
    .number("stiffness", "m g/r", |own| own.before.stiffness)
    .means("k_n")
    .shown_as("stiffness", plain)
    .number("mu", "1", |own| own.before.mu)
    .means("friction of the floor")
    .shown_as("mu", plain)
    .number("kappa", "1", |own| own.before.kappa)
    .means("κ = k_n/k_t")
    .shown_as("kappa", plain)
    .number("before", "m g", |own| own.before.force)
    .means("F under the arms of the first passport; absent where one is not known")
    .shown_as("F before", digits::<9>)
    .number("after", "m g", |own| own.after)
    .means("F under the arms of the second passport")
    .shown_as("F after", digits::<9>)
    .number("change", "m g", |own| own.change)
    .means("second minus first")
    .shown_as("change", relative)
    .number("uncertainty", "m g", |own| own.uncertainty)
    .means("what the uncertainties of both leave open")
    .shown_as("±", one_digit)
    .rows(forces)
}

/// Formats a number to nine digits; a word stays as it is.
fn cell(value: Option<&str>) -> String {
    let number = value.and_then(|text| text.parse::<f64>().ok());
    match number {
        Some(number) => significant(number + 0.0, 9),
        None => or_dash(&optional(value, str::to_owned)),
    }
}
