//! What differs between two passports.

use super::meanings::{base_name, meanings};
use crate::study::Verdict;
use crate::study::convention::{ArmEffect, PassportFile, PropertyRow, TOLERANCE};

/// Uncertainties between a value that is read from rounded numbers and the true one: stated is what eight roundings have
/// moved, and the tests of the probe hold twice that for every number of digits.
const COVERAGE_OF_ROUNDING: f64 = 2.0;
/// Share of a number that both uncertainties together may be for the number to be compared. It is 1e-4 at most in the
/// passports on file.
const COARSEST: f64 = 1e-3;

/// Everything in which two passports differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Rules and properties that differ, in the order of the passports.
    pub changes: Vec<Change>,
    /// Rules and properties that only one of them knows, where the motions of either have few digits.
    pub unknown: Vec<String>,
    /// Rules and properties that neither knows.
    pub neither: Vec<String>,
    /// Properties that both know, but so coarsely that a difference would not show.
    pub undecided: Vec<String>,
    /// Number of rules and properties that both know well enough to tell a difference.
    pub compared: usize,
    /// The exact yield forces of the stacks that both have.
    pub forces: Vec<ForceChange>,
}

/// A rule or a property that differs.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// The key of the convention or the name of the property.
    pub name: String,
    /// Its value in the first passport; absent if unknown there.
    pub before: Option<String>,
    /// Its value in the second one.
    pub after: Option<String>,
    /// Second minus first number.
    pub change: Option<f64>,
    /// The sum of both uncertainties.
    pub uncertainty: Option<f64>,
    /// Whether it is an arm, on which the yield force depends.
    pub moves_limit: bool,
}

/// The exact yield force of one stack under the arms of both.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceChange {
    /// The stack, with its force in the first passport.
    pub before: ArmEffect,
    /// The force under the arms of the second one, in m g.
    pub after: Option<f64>,
    /// Second minus first, in m g.
    pub change: Option<f64>,
    /// The sum of both uncertainties, in m g.
    pub uncertainty: Option<f64>,
}

impl Difference {
    /// Whether nothing has changed.
    pub fn is_none(&self) -> bool {
        self.changes.is_empty()
    }

    /// Whether what was compared says nothing: nothing could be, or an uncertainty hides a difference without few digits
    /// as its cause.
    pub fn is_open(&self, is_coarse: bool) -> bool {
        self.compared == 0 || !(is_coarse || self.undecided.is_empty())
    }

    /// Returns the changes that move the yield force but are not of arms; `forces` leaves them out.
    pub fn beside_arms(&self) -> Vec<&str> {
        let moves = |own: &&Change| {
            let mut meanings = meanings().iter();
            let meaning = meanings.find(|one| one.name == base_name(&own.name).0);
            !own.moves_limit && meaning.is_some_and(|one| one.moves_force)
        };
        let changes = self.changes.iter().filter(moves);
        changes.map(|own| own.name.as_str()).collect()
    }
}

impl Change {
    /// Returns the change in units of its uncertainty; absent for words and for exact numbers.
    pub fn uncertainties(&self) -> Option<f64> {
        let (change, uncertainty) = self.change.zip(self.uncertainty)?;
        (uncertainty > 0.0).then(|| change.abs() / uncertainty)
    }
}

/// Compares the passports `before` and `after`. Rules in words differ if their words do; numbers differ by more than
/// their uncertainties and the tolerance between a property and its declaration. What only one of them knows is no
/// difference if the motions of either have few digits, and twice the uncertainty is allowed then.
pub fn difference(before: &PassportFile, after: &PassportFile) -> Difference {
    let is_coarse = [before, after]
        .iter()
        .any(|own| own.is_coarse_because().is_some());
    let coverage = if is_coarse { COVERAGE_OF_ROUNDING } else { 1.0 };
    let (mut neither, mut undecided, mut compared) = (Vec::new(), Vec::new(), 0);
    let further = after.convention.iter();
    let further = further.filter(|own| before.key(&own.key).is_none());
    let keys = before.convention.iter().chain(further);
    let words = keys.filter_map(|own| {
        let rows = [before.key(&own.key), after.key(&own.key)];
        let is_number = rows.into_iter().flatten().any(|row| row.number().is_some());
        let [first, second] = rows.map(|row| row?.measured.clone());
        match (&first, &second) {
            (None, None) => neither.push(own.key.clone()),
            (Some(_), Some(_)) if !is_number => compared += 1,
            _ => {}
        }
        (!is_number && first != second).then(|| Change {
            name: own.key.clone(),
            before: first,
            after: second,
            change: None,
            uncertainty: None,
            moves_limit: own.moves_limit,
        })
    });
    let words: Vec<Change> = words.collect();
    let further = after.properties.iter();
    let further = further.filter(|own| before.property(&own.property).is_none());
    let names = before.properties.iter().chain(further);
    let numbers = names.filter_map(|own| {
        let name = &own.property;
        let rows = [before.property(name), after.property(name)];
        match Knowledge::of(rows) {
            Knowledge::Both => compared += 1,
            Knowledge::Coarse => undecided.push(name.clone()),
            Knowledge::Neither => neither.push(name.clone()),
            Knowledge::One => {}
        }
        changed(name, rows[0], rows[1], coverage)
    });
    let numbers: Vec<Change> = numbers.collect();
    let forces = before.arm_effects.iter().filter_map(|own| {
        let mut others = after.arm_effects.iter();
        let other = others.find(|other| {
            let stack = |own: &ArmEffect| (own.stiffness, own.mu, own.kappa);
            stack(own) == stack(other)
        })?;
        Some(force(own, other))
    });
    // What few digits leave open decides which properties are read, too.
    let is_unknown = |own: &Change| is_coarse && (own.before.is_none() || own.after.is_none());
    let (unknown, changes): (Vec<_>, Vec<_>) =
        words.into_iter().chain(numbers).partition(is_unknown);
    undecided.retain(|name| changes.iter().all(|own| own.name != *name));
    Difference {
        changes,
        unknown: unknown.into_iter().map(|own| own.name).collect(),
        neither,
        undecided,
        compared,
        forces: forces.collect(),
    }
}

/// What two passports know of a property.
enum Knowledge {
    Both,
    /// Both know it, but their uncertainties hide a difference.
    Coarse,
    One,
    Neither,
}

impl Knowledge {
    fn of(rows: [Option<&PropertyRow>; 2]) -> Self {
        let has_value = |row: Option<&PropertyRow>| row.is_some_and(|row| row.measured.is_some());
        match rows.map(known) {
            [Some((_, first)), Some((_, second))] if first + second <= COARSEST * scale(rows) => {
                Self::Both
            }
            // A value without an uncertainty was written as one that is not finite.
            _ if rows.into_iter().all(has_value) => Self::Coarse,
            [None, None] if !rows.into_iter().any(has_value) => Self::Neither,
            _ => Self::One,
        }
    }
}

/// Returns the value of a property with its uncertainty.
fn known(row: Option<&PropertyRow>) -> Option<(f64, f64)> {
    let row = row?;
    row.measured.zip(row.uncertainty)
}

/// Returns the size of what both rows declare, or 1 where that is 0 or absent.
fn scale(rows: [Option<&PropertyRow>; 2]) -> f64 {
    let declared = rows.into_iter().flatten().filter_map(|own| own.declared);
    let largest = declared.map(f64::abs).fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

/// Returns the change of the property `name`, if it is by more than `coverage` times the uncertainties.
fn changed(
    name: &str,
    before: Option<&PropertyRow>,
    after: Option<&PropertyRow>,
    coverage: f64,
) -> Option<Change> {
    let (first, second) = (known(before), known(after));
    let both = first.zip(second);
    let change = both.map(|((first, _), (second, _))| second - first);
    let uncertainty = both.map(|((_, first), (_, second))| first + second);
    let scale = scale([before, after]);
    let same = match change.zip(uncertainty) {
        Some((change, open)) => {
            Verdict::of(change, coverage * open, TOLERANCE * scale) != Verdict::Differs
        }
        None => first.is_none() && second.is_none(),
    };
    (!same).then(|| Change {
        name: name.to_owned(),
        before: first.map(|(value, _)| value.to_string()),
        after: second.map(|(value, _)| value.to_string()),
        change,
        uncertainty,
        moves_limit: name.ends_with("_arm"),
    })
}

fn force(before: &ArmEffect, after: &ArmEffect) -> ForceChange {
    let both = |own: fn(&ArmEffect) -> Option<f64>| own(before).zip(own(after));
    ForceChange {
        before: before.clone(),
        after: after.force,
        change: both(|own| own.force).map(|(first, second)| second - first),
        uncertainty: both(|own| own.uncertainty).map(|(first, second)| first + second),
    }
}
