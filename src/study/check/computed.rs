//! Mistakes in computing: the native DEM makes them, and writes the series of the code.

use super::beside::Beside;
use super::mistake::{Mistake, MistakenLaw, minimum};
use super::parameter::Parameter;
use super::rows::{Row, at_time, index};
use crate::model::{Case, Preparation};
use rayon::prelude::*;

/// Mistakes that fit as well as the best one are named too.
const AS_WELL: f64 = 3.0;
const MOST_CAUSES: usize = 3;
/// Relative distance at which two travels of the wall count as the same: its first touch rings.
const SAME_TRAVEL: f64 = 0.03;

/// The mistakes that explain the series of `case`, best first.
pub(super) fn explanations(beside: &Beside, case: &Case) -> Vec<String> {
    let single = single_mistakes(case);
    let single = single.into_par_iter().filter_map(|mistake| {
        let rows = mistake.rows()?;
        Some((beside.explained_by(&rows)?, mistake.text))
    });
    let mut fitting: Vec<(f64, String)> = single.collect();
    fitting.extend(late_wall(beside, case));
    if fitting.is_empty() {
        let fitted = Parameter::ALL.into_par_iter();
        fitting = fitted
            .filter_map(|parameter| parameter.fit(beside, case))
            .collect();
    }
    fitting.sort_by(|left, right| left.0.total_cmp(&right.0));
    let best = fitting.first().map_or(0.0, |best| best.0);
    let as_good = fitting
        .into_iter()
        .take_while(|(rest, _)| *rest <= AS_WELL * best.max(1e-6));
    let mut causes: Vec<String> = as_good.map(|(_, text)| text).collect();
    causes.truncate(MOST_CAUSES);
    causes
}

/// A mistake in words, and what it changes in the law.
type Wrong = (&'static str, fn(&mut MistakenLaw));

/// Mistakes in the law, which have no size.
const OF_LAW: [Wrong; 16] = [
    (
        "the spin enters the surface velocity with the wrong sign",
        |law| law.everywhere(|change| change.spin = -1.0),
    ),
    (
        "the spin enters the surface velocity of pairs with the wrong sign",
        |law| law.pair.spin = -1.0,
    ),
    (
        "the spin enters the surface velocity at the floor with the wrong sign",
        |law| law.floor.spin = -1.0,
    ),
    ("the surface velocity leaves out the spin", |law| {
        law.everywhere(|change| change.spin = 0.0)
    }),
    (
        "the surface velocity at the floor leaves out the spin",
        |law| law.floor.spin = 0.0,
    ),
    ("the surface velocity of pairs leaves out the spin", |law| {
        law.pair.spin = 0.0
    }),
    ("the torque has the wrong sign", |law| {
        law.everywhere(|change| change.torque = -1.0)
    }),
    ("the floor exerts no torque", |law| law.floor.torque = 0.0),
    ("the floor exerts its torque with the wrong sign", |law| {
        law.floor.torque = -1.0
    }),
    ("pairs exert no torque", |law| law.pair.torque = 0.0),
    (
        "the torque of pairs has the wrong sign on one of them or on both",
        |law| law.pair.torque = -1.0,
    ),
    ("nothing is damped", |law| {
        law.everywhere(|change| (change.normal_damping, change.tangential_damping) = (0.0, 0.0))
    }),
    ("the floor has no friction", |law| law.floor.friction = 0.0),
    (
        "the floor never slides: its tangential force is not capped",
        |law| law.floor.friction = 1e6,
    ),
    ("there is no friction between cylinders", |law| {
        law.pair.friction = 0.0
    }),
    ("there is no friction anywhere", |law| {
        law.everywhere(|change| change.friction = 0.0)
    }),
];

/// Mistakes without a size.
fn single_mistakes(case: &Case) -> Vec<Mistake> {
    let of_law = OF_LAW.iter().map(|(text, change)| {
        let mut mistake = Mistake::new(case, text);
        change(&mut mistake.law);
        mistake
    });
    let preparation = mistakes_of_preparation(case);
    of_law
        .chain(preparation)
        .chain(mixed_frictions(case))
        .collect()
}

/// Mistakes before the wall moves, and cylinders that do not turn.
fn mistakes_of_preparation(case: &Case) -> [Mistake; 3] {
    let shortest = case.protocol.sampling.fine_interval;
    let sudden =
        "gravity is there at once, and must rise over `ramp_steps` as x^3 (10 - 15 x + 6 x^2)";
    let unrested = "the stack does not rest for `rest_steps` before the wall moves";
    let still =
        "the cylinders do not turn: the torque is never applied, or rotation is switched off";
    let [mut sudden, mut unrested, mut still] =
        [sudden, unrested, still].map(|text| Mistake::new(case, text));
    if let Preparation::GravityRamp {
        ramp_time,
        rest_time,
    } = &mut sudden.case.protocol.preparation
    {
        (*ramp_time, *rest_time) = (shortest, *ramp_time + *rest_time - shortest);
    }
    if let Preparation::GravityRamp { rest_time, .. } = &mut unrested.case.protocol.preparation {
        *rest_time = shortest;
    }
    still.case.convention.moment_of_inertia = 1e12;
    [sudden, unrested, still]
}

/// One friction in place of the other, or both combined.
fn mixed_frictions(case: &Case) -> [Mistake; 5] {
    let (floor, cylinders) = (case.stack.floor_friction, case.stack.cylinder_friction);
    let mixed = [
        (
            "floor_friction and cylinder_friction are exchanged",
            cylinders,
            floor,
        ),
        ("floor_friction serves for the cylinders too", floor, floor),
        (
            "cylinder_friction serves for the floor too",
            cylinders,
            cylinders,
        ),
        (
            "the floor has the mean of floor_friction and cylinder_friction",
            0.5 * (floor + cylinders),
            cylinders,
        ),
        (
            "the floor has the geometric mean of floor_friction and cylinder_friction",
            (floor * cylinders).sqrt(),
            cylinders,
        ),
    ];
    mixed.map(|(text, of_floor, of_cylinders)| {
        let mut mistake = Mistake::new(case, text);
        mistake.law.floor.friction = of_floor / floor;
        mistake.law.pair.friction = of_cylinders / cylinders;
        mistake
    })
}

/// The whole series is late or early, because the wall does not just touch when it begins to move.
fn late_wall(beside: &Beside, case: &Case) -> Option<(f64, String)> {
    let [force, time, height] = ["wall_force", "time", "y1"].map(index);
    let load = beside
        .expected
        .iter()
        .map(|row| row[force])
        .fold(0.0, f64::max);
    let rows = beside.dense;
    let reaches = |rows: &[Row]| {
        let after = rows
            .iter()
            .position(|row| row[force] > 0.3 * load)
            .filter(|&row| row > 0)?;
        let [one, two] = [&rows[after - 1], &rows[after]];
        Some(
            one[time]
                + (two[time] - one[time]) * (0.3 * load - one[force]) / (two[force] - one[force]),
        )
    };
    let late = reaches(beside.found)? - reaches(rows)?;
    let columns = &beside.columns;
    let shifted = |late: f64| -> Vec<Row> {
        let times = beside.expected.iter().map(|row| row[time]);
        times.map(|moment| at_time(rows, moment - late)).collect()
    };
    let between = case.protocol.sampling.coarse_interval;
    let distance = |late: f64| beside.distance(&shifted(late), columns);
    let late = minimum(&distance, late - between, late + between);
    let shifted = shifted(late);
    if late.abs() < case.protocol.time_step || !beside.explains(&shifted, columns) {
        return None;
    }
    let travel = late * case.protocol.wall_speed;
    let sunk = 1.0 + 3f64.sqrt() - rows[0][height];
    let place = match (travel / sunk - 1.0).abs() < SAME_TRAVEL {
        true => {
            "it starts above the stack as it was before gravity, and must start at the present top of cylinder 1"
        }
        false => "it must start at the present top of cylinder 1, y1 + 1, and move from step 0 on",
    };
    Some((
        beside.distance(&shifted, columns),
        format!(
            "the wall touches too {}: by {:.6} r of its travel ({:.1} steps); {place}",
            if late > 0.0 { "late" } else { "early" },
            travel.abs(),
            (late / case.protocol.time_step).abs()
        ),
    ))
}
