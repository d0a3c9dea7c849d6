//! Newton's third law in the micro-tests of a pair: the forces on both cylinders are opposite.

use super::report::{Grade, Item};
use crate::runs::ProbeRecord;
use crate::series::{BodyRow, ENOUGH_DIGITS};
use crate::study::convention::Rounding;

const NAME: &str = "action and reaction";
/// Largest sum of both forces, in units of one of them, that counts as rounding.
const ROUNDING: f64 = 1e-9;
/// The same bound for numbers with few digits.
const GROSS: f64 = 1e-3;
/// The same bound for numbers of 32 bits: sums of a few forces, each rounded by 6e-8 of it.
const SINGLE: f64 = 1e-6;

/// Returns the forces of a pair at one moment, if it touches and neither cylinder touches anything else.
fn forces([one, two]: [BodyRow; 2]) -> Option<[[f64; 2]; 2]> {
    let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
    let heights = [one, two].map(|body| body.position[1]);
    let is_alone = heights.iter().all(|height| (1.05..3.45).contains(height));
    (apart[0].hypot(apart[1]) < 2.0 && is_alone).then_some([one.force, two.force])
}

/// Returns the item on the forces of all pairs.
pub(super) fn action_and_reaction(record: &ProbeRecord) -> Item {
    let motions = || {
        let answers = record.answers.iter();
        let in_the_plane = answers.filter(|answer| answer.test.space.is_none());
        in_the_plane.map(|answer| &answer.motion)
    };
    let rows = motions().flat_map(|motion| motion.rows().iter().skip(1));
    let pairs: Vec<[[f64; 2]; 2]> = rows.filter_map(|row| forces(row.bodies())).collect();
    let largest = |value: fn(&[[f64; 2]; 2]) -> f64| pairs.iter().map(value).fold(0.0, f64::max);
    let force = largest(|[one, two]| one[0].hypot(one[1]).max(two[0].hypot(two[1])));
    let sum = largest(|[one, two]| (one[0] + two[0]).hypot(one[1] + two[1]));
    let rounding = Rounding::of(&motions().collect::<Vec<_>>());
    let allowed = match (rounding.digits < ENOUGH_DIGITS, rounding.is_single()) {
        (true, _) => GROSS,
        (false, true) => SINGLE,
        (false, false) => ROUNDING,
    };
    let grade = Grade::Consistency;
    if pairs.is_empty() {
        Item::not_tested(grade, NAME, "no micro-test shows a pair")
    } else if sum <= allowed * force {
        Item::passed(
            grade,
            NAME,
            "the forces on the two cylinders of a pair are opposite",
        )
    } else {
        let expected = "forces on the two cylinders of a pair that add up to 0";
        let found = format!("they add up to {sum:.3e} where one of them is {force:.3e} k_n r");
        Item::failed(grade, NAME, expected, found, Vec::new())
    }
}
