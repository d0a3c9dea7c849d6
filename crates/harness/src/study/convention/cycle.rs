//! Work of closed cycles in overlap and tangential displacement, in which a cylinder is moved as prescribed.

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

/// Roundings of a position by which the end of a cycle may differ from its beginning.
const ROUNDINGS: f64 = 16.0;

/// Kinds of contacts that are driven: the top wall has no friction.
const KINDS: [ContactKind; 2] = [ContactKind::Pair, ContactKind::Floor];

/// The name of the work of a cycle, without the kind of contact.
fn name(order: CycleOrder) -> &'static str {
    match order {
        CycleOrder::ShearedFirst => SHEARED_FIRST,
        CycleOrder::PressedFirst => PRESSED_FIRST,
    }
}

/// The contacts that are driven, and what comes first.
fn cycles() -> impl Iterator<Item = (ContactKind, CycleOrder)> {
    let kinds = KINDS.into_iter();
    kinds.flat_map(|kind| CycleOrder::ALL.map(|order| (kind, order)))
}

/// The micro-tests in which cylinder 1 is moved as prescribed. Springs of constant stiffness give back what they are
/// given: none where the law is declared to be linear.
pub fn tests(convention: &ContactConvention) -> Vec<ContactTest> {
    let cycles = cycles().filter(|_| !convention.law.is_linear());
    cycles
        .map(|(kind, order)| driven(kind, convention, order))
        .collect()
}

/// The work of every cycle, over the energy that the spring of the measured law has at the higher overlap.
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

/// The work that is done on cylinder 1, against the force of its contact without the lift, which the rows of the contact have
/// from step 1 on.
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

/// What rounding of the largest force leaves of the work, where the end of a cycle is not exactly its beginning; and of a
/// pair, what the stiffness changes by while the overlap grows along a chord, by u²/(8ρ) at most.
fn uncertainty(kind: ContactKind, motion: &Motion, energy: f64) -> f64 {
    let forces = motion.rows().iter().map(|row| row.bodies()[0].force);
    let largest = forces.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
    let rounding = ROUNDINGS * f64::EPSILON * largest / energy;
    match kind {
        ContactKind::Pair => rounding + SHEAR * SHEAR / (8.0 * (2.0 - HIGH) * LOW),
        ContactKind::Floor | ContactKind::Wall => rounding,
    }
}
