//! The contact at Coulomb's limit: friction, operand, damping, and the length of the spring.

use super::contact_frame::ContactRow;
use super::regression::{Measured, fit};
use super::tangential::TangentialLaw;

/// Largest relative difference between |f_t|/f_n of rows that slide: rounding, and the contribution of a linearised
/// history update to the normal force (3e-8). Where the contact sticks, the ratio changes a thousand times as much from
/// row to row.
const SAME_RATIO: f64 = 1e-7;

/// Fewest rows with the same ratio that count as sliding: friction and damping follow from them.
const FEWEST: usize = 3;

/// Relative distance below and above the limit at which the contact is observed to stick or slide.
pub const MARGIN: f64 = 1e-10;

/// The law of a contact that slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingLaw {
    /// μ.
    pub friction: Measured,
    /// Damping beyond the limit, in units of η_t.
    pub damping: Measured,
    /// Length of the spring at the end of sliding, on the scale from the length that follows the limit (0) to the
    /// length at the onset (1).
    pub memory: Measured,
}

impl SlidingLaw {
    /// Fits one motion that slides and sticks again; `operand_damping` is the share of the damping in the operand.
    pub fn read(rows: &[ContactRow], law: &TangentialLaw, operand_damping: f64) -> Self {
        let slides = slides(rows);
        let sliding = rows.iter().zip(&slides).filter(|(_, slides)| **slides);
        let terms: Vec<([f64; 2], f64)> = sliding
            .map(|(row, _)| {
                let damping = law.damping_at(row) * law.surface_speed(row).abs();
                ([row.limiting_force(), damping], row.friction_force())
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

/// Whether Coulomb's limit counts a part of the normal force alone in rows of one motion: they slide with the same ratio to
/// that part, and with none to the whole force. `by_part` are the same rows with that part.
pub fn is_limited_by(by_part: &[ContactRow], rows: &[ContactRow]) -> bool {
    let slides = |rows| slides(rows).contains(&true);
    slides(by_part) && !slides(rows)
}

/// Marks the rows that slide: those with the most frequent ratio of forces.
fn slides(rows: &[ContactRow]) -> Vec<bool> {
    let ratios = rows.iter();
    let ratios = ratios.map(|row| row.friction_force() / row.limiting_force());
    let ratios: Vec<f64> = ratios.collect();
    let same = |left: f64, right: f64| (left - right).abs() < SAME_RATIO * right;
    let like = |ratio: f64| ratios.iter().filter(|&&other| same(other, ratio)).count();
    let often = ratios
        .iter()
        .copied()
        .filter(|&ratio| like(ratio) >= FEWEST);
    let most = often.max_by_key(|&ratio| like(ratio));
    let slides = |&ratio: &f64| most.is_some_and(|most| same(ratio, most));
    ratios.iter().map(slides).collect()
}

/// The memory of the spring, from the stretch of sliding on which the two lengths are furthest apart.
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
        let noise = law.open_share() * followed.abs();
        Measured::new(length - followed, noise).over(Measured::new(frozen - followed, noise))
    })
}

/// Length of the spring after a stretch of sliding between two rows that stick, before it grows again: as measured,
/// as it would be if it followed the limit, and as it was before the stretch, turned along with the contact.
fn spring_lengths(stretch: &[ContactRow], law: &TangentialLaw, operand_damping: f64) -> [f64; 3] {
    let [before, last, next] = [0, stretch.len() - 2, stretch.len() - 1].map(|at| &stretch[at]);
    let length = |row: &ContactRow, along: f64| [along, row.lift].map(|part| law.length(row, part));
    let counted = operand_damping * law.damping_at(last) * law.surface_speed(last);
    let [followed, _] = law.turned(length(last, last.tangential_force + counted), last, next);
    let [frozen, _] = stretch
        .windows(2)
        .fold(length(before, law.spring_force(before)), |spring, two| {
            law.turned(spring, &two[0], &two[1])
        });
    let measured = law.length(next, law.spring_force(next)) - law.growth_of_length(next);
    [measured, followed, frozen]
}

/// Index of the row with the largest ratio of operand to limit, and that ratio; `operand_damping` is the share of the
/// damping in the operand.
pub fn largest_operand(
    rows: &[ContactRow],
    law: &TangentialLaw,
    operand_damping: f64,
) -> Option<(usize, f64)> {
    let ratio = |row: &ContactRow| {
        let damping = law.damping_at(row) * law.surface_speed(row);
        let operand = law.spring_force(row) - operand_damping * damping;
        operand.hypot(row.lift) / (row.friction * row.limiting_force())
    };
    let ratios = rows.iter().map(ratio).enumerate();
    ratios.max_by(|(_, left), (_, right)| left.total_cmp(right))
}

/// Whether a row is at the limit rather than a [`MARGIN`] below or above it.
pub fn is_at_limit(row: &ContactRow) -> bool {
    let limit = row.friction * row.limiting_force();
    (row.friction_force() / limit - 1.0).abs() < 0.5 * MARGIN
}
