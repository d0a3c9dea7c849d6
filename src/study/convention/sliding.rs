//! The contact at Coulomb's limit: friction, operand, damping, and what becomes of the spring.

use super::contact_frame::ContactRow;
use super::regression::{Measured, fit};
use super::tangential::{TangentialLaw, carried};

/// |f_t|/f_n of all rows that slide are equal up to rounding, and up to what a linearised transport of the
/// spring adds to the normal force (3e-8); where the contact sticks they change by a thousand times more from
/// row to row.
const SAME_RATIO: f64 = 1e-7;

/// How far below and above the limit a contact is brought to see whether it sticks or slides.
pub const NEAR_SLIP: f64 = 1e-10;

/// What a motion that slides and sticks again says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingLaw {
    /// μ.
    pub friction: Measured,
    /// Damping beyond the limit, in units of η_t.
    pub damping: Measured,
    /// Part of the spring's length at the onset that is still there at the end, on the scale from the length
    /// that follows the limit (0) to the frozen one (1).
    pub memory: Measured,
}

impl SlidingLaw {
    /// Read off one motion; `operand_damping` says how much of the damping counts in the operand.
    pub fn read(rows: &[ContactRow], law: &TangentialLaw, operand_damping: f64) -> Self {
        let slides = slides(rows);
        let sliding = rows.iter().zip(&slides).filter(|(_, slides)| **slides);
        let terms: Vec<([f64; 2], f64)> = sliding
            .map(|(row, _)| {
                let damping = law.damping.value * law.surface_speed(row).abs();
                ([row.normal_force, damping], row.tangential_force.abs())
            })
            .collect();
        let [friction, damping] = fit(&terms);
        Self {
            friction,
            damping,
            memory: memory(rows, &slides, law, operand_damping),
        }
    }
}

/// Which rows slide: those with the ratio of forces that most rows have.
fn slides(rows: &[ContactRow]) -> Vec<bool> {
    let ratios: Vec<f64> = rows
        .iter()
        .map(|row| row.tangential_force.abs() / row.normal_force)
        .collect();
    let same = |left: f64, right: f64| (left - right).abs() < SAME_RATIO * right;
    let like = |ratio: f64| ratios.iter().filter(|&&other| same(other, ratio)).count();
    let most = ratios.iter().copied().max_by_key(|&ratio| like(ratio));
    ratios
        .iter()
        .map(|&ratio| most.is_some_and(|most| same(ratio, most)))
        .collect()
}

/// The stretch of sliding between two rows that stick on which the two lengths are furthest apart decides.
fn memory(
    rows: &[ContactRow],
    slides: &[bool],
    law: &TangentialLaw,
    operand_damping: f64,
) -> Measured {
    let begins = (1..rows.len()).filter(|&index| slides[index] && !slides[index - 1]);
    let stretches = begins.filter_map(|begin| {
        let end = (begin..rows.len()).find(|&index| !slides[index])?;
        (rows[end].normal_force > 0.0).then_some(&rows[begin - 1..=end])
    });
    let lengths = stretches.map(|stretch| spring_lengths(stretch, law, operand_damping));
    let contrast = |[_, followed, frozen]: &[f64; 3]| (frozen - followed).abs();
    let widest = lengths.max_by(|left, right| contrast(left).total_cmp(&contrast(right)));
    widest.map_or(Measured::UNKNOWN, |[length, followed, frozen]| {
        let noise = (law.stiffness.uncertainty / law.stiffness.value
            + law.damping.uncertainty / law.damping.value)
            * followed.abs();
        Measured::new(length - followed, noise).over(Measured::new(frozen - followed, noise))
    })
}

/// Length of the spring at the end of a stretch of sliding, which is enclosed by two rows that stick: as it
/// is, as it would be if it followed the limit, and as it was before.
fn spring_lengths(stretch: &[ContactRow], law: &TangentialLaw, operand_damping: f64) -> [f64; 3] {
    let stiffness = law.stiffness.value;
    let [before, last, next] = [0, stretch.len() - 2, stretch.len() - 1].map(|at| &stretch[at]);
    let growth = law.surface_speed(next) * next.time_step;
    let factor = carried(last, next, law.transport.value);
    let counted = operand_damping * law.damping.value * law.surface_speed(last);
    [
        (-law.spring_force(next) / stiffness - growth) / factor,
        -(last.tangential_force + counted) / stiffness,
        -law.spring_force(before) / stiffness,
    ]
}

/// The row of a motion near the limit at which the operand, with so much of the damping in it, is largest
/// relative to the limit, and that ratio.
pub fn largest_operand(
    rows: &[ContactRow],
    law: &TangentialLaw,
    operand_damping: f64,
) -> Option<(usize, f64)> {
    let ratio = |row: &ContactRow| {
        let damping = law.damping.value * law.surface_speed(row);
        let operand = law.spring_force(row) - operand_damping * damping;
        operand.abs() / (row.friction * row.normal_force)
    };
    let ratios = rows.iter().map(ratio).enumerate();
    ratios.max_by(|(_, left), (_, right)| left.total_cmp(right))
}

/// Whether a row is at the limit rather than a [`NEAR_SLIP`] below or above it.
pub fn is_at_limit(row: &ContactRow) -> bool {
    let limit = row.friction * row.normal_force;
    (row.tangential_force.abs() / limit - 1.0).abs() < 0.5 * NEAR_SLIP
}
