//! Newton's third law, in the micro-tests of a pair: what one cylinder feels the other feels with the opposite sign.

use super::report::{Grade, Item};
use crate::runs::ProbeRecord;
use crate::series::BodyRow;

const NAME: &str = "action and reaction";
/// Largest sum of both forces, in units of one of them, that is rounding.
const ROUNDING: f64 = 1e-9;
/// The same where numbers have few digits.
const GROSS: f64 = 1e-3;

/// The forces of a pair at one moment, along the normal and the tangent of cylinder 1.
struct Pair {
    one: [f64; 2],
    two: [f64; 2],
    overlap: f64,
    /// Normal and tangential velocity.
    speed: [f64; 2],
}

impl Pair {
    /// The pair, if it touches and neither cylinder touches anything else.
    fn of([one, two]: [BodyRow; 2]) -> Option<Self> {
        let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
        let distance = apart[0].hypot(apart[1]);
        let is_alone = one.position[1].min(two.position[1]) > 1.05
            && one.position[1].max(two.position[1]) < 3.45;
        let normal = apart.map(|component| component / distance);
        let of = |vector: [f64; 2]| {
            [
                normal[0] * vector[0] + normal[1] * vector[1],
                normal[0] * vector[1] - normal[1] * vector[0],
            ]
        };
        let relative = [0, 1].map(|axis| one.velocity[axis] - two.velocity[axis]);
        let speed = of(relative);
        (distance < 2.0 && is_alone).then(|| Self {
            one: of(one.force),
            two: of(two.force),
            overlap: 2.0 - distance,
            speed: [speed[0], speed[1] - one.spin - two.spin],
        })
    }
}

/// The item on the forces of all pairs.
pub(super) fn action_and_reaction(record: &ProbeRecord) -> Item {
    let motions = record.answers.iter().map(|answer| &answer.motion);
    let pairs = motions.flat_map(|motion| {
        motion
            .rows()
            .iter()
            .skip(1)
            .filter_map(|row| Pair::of(row.bodies()))
    });
    let pairs: Vec<Pair> = pairs.collect();
    let largest =
        |value: &dyn Fn(&Pair) -> f64| pairs.iter().map(value).map(f64::abs).fold(0.0, f64::max);
    let force = largest(&|pair| {
        pair.one[0]
            .hypot(pair.one[1])
            .max(pair.two[0].hypot(pair.two[1]))
    });
    let sum = largest(&|pair| (pair.one[0] + pair.two[0]).hypot(pair.one[1] + pair.two[1]));
    let few_digits = record
        .answers
        .iter()
        .map(|answer| answer.motion.most_digits())
        .max()
        .unwrap_or(0)
        < 13;
    let allowed = if few_digits { GROSS } else { ROUNDING };
    if pairs.is_empty() {
        return Item::not_tested(Grade::Consistency, NAME, "no micro-test shows a pair");
    }
    if sum <= allowed * force {
        return Item::passed(
            Grade::Consistency,
            NAME,
            "the forces on the two cylinders of a pair are opposite",
        );
    }
    Item::failed(
        Grade::Consistency,
        NAME,
        "forces on the two cylinders of a pair that add up to 0",
        format!("they add up to {sum:.3e} where one of them is {force:.3e} k_n r"),
        causes(&pairs),
    )
}

fn causes(pairs: &[Pair]) -> Vec<String> {
    let sum = |pair: &Pair, axis: usize| pair.one[axis] + pair.two[axis];
    let none = |value: &dyn Fn(&Pair) -> f64| pairs.iter().all(|pair| value(pair).abs() < ROUNDING);
    if none(&|pair| pair.two[0].hypot(pair.two[1])) {
        return vec![
            "the force acts on cylinder 1 alone: the reaction on the second body is left out"
                .to_owned(),
        ];
    }
    if none(&|pair| pair.one[0].hypot(pair.one[1])) {
        return vec![
            "the force acts on cylinder 2 alone: the reaction on the first body is left out"
                .to_owned(),
        ];
    }
    if none(&|pair| pair.one[0] - pair.two[0]) {
        return vec!["both cylinders get the force with the same sign".to_owned()];
    }
    let mut causes = Vec::new();
    for (axis, name) in [(0, "normal"), (1, "tangential")] {
        if none(&|pair| sum(pair, axis)) {
            continue;
        }
        let by_speed = proportion(pairs, &|pair| pair.speed[axis], &|pair| sum(pair, axis));
        let by_overlap = proportion(pairs, &|pair| pair.overlap, &|pair| sum(pair, axis));
        let by_force = proportion(pairs, &|pair| pair.one[axis], &|pair| sum(pair, axis));
        causes.push(match (by_force, by_overlap, by_speed) {
            (Some(share), ..) => format!("the {name} force on cylinder 2 is {:.4} times that on cylinder 1, and must be -1 times", share - 1.0),
            (_, Some(slope), _) => format!("the {name} forces differ by {slope:.4} times the overlap: the spring acts on one side alone, or with another stiffness there"),
            (.., Some(slope)) => format!("the {name} forces differ by {slope:.4} times the speed: the damping acts on one of the two cylinders alone, or on one more strongly"),
            _ => format!("the {name} forces are no opposites: one of them is computed from other positions or velocities"),
        });
    }
    causes
}

/// The factor between two quantities, if they are proportional to a few percent: speeds are known to half a step.
fn proportion(pairs: &[Pair], by: &dyn Fn(&Pair) -> f64, of: &dyn Fn(&Pair) -> f64) -> Option<f64> {
    let square: f64 = pairs.iter().map(|pair| by(pair).powi(2)).sum();
    let factor = pairs.iter().map(|pair| by(pair) * of(pair)).sum::<f64>() / square;
    let rest: f64 = pairs
        .iter()
        .map(|pair| (of(pair) - factor * by(pair)).powi(2))
        .sum();
    let whole: f64 = pairs.iter().map(|pair| of(pair).powi(2)).sum();
    (rest < 0.02 * whole).then_some(factor)
}
