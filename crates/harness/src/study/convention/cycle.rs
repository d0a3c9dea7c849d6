//! Work of closed cycles in overlap and tangential displacement, along which a cylinder is driven.

use super::clock::Clock;
use super::contact_frame::{ContactRow, contact_rows};
use super::experiments::{ContactKind, HIGH, LOW, SHEAR, driven};
use super::finding::{PRESSED_FIRST, Property, SHEARED_FIRST};
use super::plan::TestedMotion;
use super::properties::declared_law;
use super::regression::Measured;
use super::tangential::TangentialLaw;
use crate::model::{ContactConvention, ContactTest};
use crate::series::Motion;
use crate::theory::{CycleOrder, cycle_work};

/// Largest distance between the end and the beginning of a cycle, in roundings of a position.
const ROUNDINGS: f64 = 16.0;

/// Kinds of contacts that are driven; not the top wall, which has no friction.
const KINDS: [ContactKind; 2] = [ContactKind::Pair, ContactKind::Floor];

/// The name of the work of a cycle, without the kind of contact.
fn name(order: CycleOrder) -> &'static str {
    match order {
        CycleOrder::ShearedFirst => SHEARED_FIRST,
        CycleOrder::PressedFirst => PRESSED_FIRST,
    }
}

/// The driven contacts, each in every order of pressing and shearing.
fn cycles() -> impl Iterator<Item = (ContactKind, CycleOrder)> {
    let kinds = KINDS.into_iter();
    kinds.flat_map(|kind| CycleOrder::ALL.map(|order| (kind, order)))
}

/// The micro-tests in which cylinder 1 is driven along a prescribed path. There are none for a law that is declared
/// linear, because springs of constant stiffness return all energy.
pub fn tests(convention: &ContactConvention) -> Vec<ContactTest> {
    let cycles = cycles().filter(|_| !convention.law.is_linear());
    cycles
        .map(|(kind, order)| driven(kind, convention, order))
        .collect()
}

/// The work of every cycle, in units of the energy that the spring of the measured law stores at the higher overlap.
pub fn properties<'a>(
    outcomes: &[TestedMotion],
    clock: &Clock,
    tangential: impl Fn(ContactKind) -> Option<&'a TangentialLaw>,
) -> Vec<Property> {
    let read = |((test, motion), (kind, order)): (&TestedMotion, (ContactKind, CycleOrder))| {
        let law = tangential(kind)?;
        let energy = 0.5 * law.stiffness_at(HIGH) * SHEAR * SHEAR;
        let rows = contact_rows(kind, test, motion, clock);
        let lifted = law.undamped().with_lift(&rows);
        let work = work(motion, &lifted) / energy;
        let declared = cycle_work(&declared_law(kind, test), [LOW, HIGH], order);
        let measured = Measured::new(work, uncertainty(kind, motion, energy));
        Some(Property::at(kind, name(order), measured, declared))
    };
    outcomes.iter().zip(cycles()).filter_map(read).collect()
}

/// The work done on cylinder 1 against the force of its contact without the lift. The lift is that of the rows
/// `lifted`, which begin at step 1.
fn work(motion: &Motion, lifted: &[ContactRow]) -> f64 {
    let lift = |step: usize, axis: usize| {
        let row = step.checked_sub(1).and_then(|index| lifted.get(index));
        row.map_or(0.0, |row| row.lift * row.normal[axis])
    };
    let steps = motion.rows().windows(2).enumerate().map(|(step, rows)| {
        let [before, after] = [rows[0].bodies()[0], rows[1].bodies()[0]];
        let along = |axis: usize| {
            let lift = lift(step, axis) + lift(step + 1, axis);
            let force = 0.5 * (before.force[axis] + after.force[axis] - lift);
            -force * (after.position[axis] - before.position[axis])
        };
        along(0) + along(1)
    });
    steps.sum()
}

/// Uncertainty of the work from rounding: the largest force times the distance by which the end of a cycle may miss
/// its beginning. For a pair it includes the change of the stiffness while the overlap grows along a chord, by
/// u²/(8ρ) at most.
fn uncertainty(kind: ContactKind, motion: &Motion, energy: f64) -> f64 {
    let forces = motion.rows().iter().map(|row| row.bodies()[0].force);
    let largest = forces.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
    let rounding = ROUNDINGS * f64::EPSILON * largest / energy;
    match kind {
        ContactKind::Pair => rounding + SHEAR * SHEAR / (8.0 * (2.0 - HIGH) * LOW),
        ContactKind::Floor | ContactKind::Wall => rounding,
    }
}
