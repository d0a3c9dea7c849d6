//! Mistakes in what is written: the code computes rightly, and some columns are something else.

use super::beside::Beside;
use super::factor::{is_about, of_factor};
use super::rows::{
    ANGLES, FLOOR, FORCES, HEIGHTS, LENGTHS, MIRRORED, NORMALS, Row, SHEARS, WALL, WIDTHS, at_time,
    index, indices, name,
};
use crate::model::Case;

/// Most relations that together count as an explanation.
const MOST_RELATIONS: usize = 3;

/// Columns that are likely to share a mistake, with their names in messages.
const GROUPS: [(&str, &[&str]); 9] = [
    ("the lengths", &LENGTHS),
    ("the forces", &FORCES),
    ("the forces of the floor", &FLOOR),
    ("the normal forces of the floor", &NORMALS),
    ("the tangential forces of the floor", &SHEARS),
    ("the heights", &HEIGHTS),
    ("the horizontal positions", &WIDTHS),
    ("the angles", &ANGLES),
    ("the wall force", &WALL),
];

/// What explains the columns that deviate, if mistakes in what is written explain them all.
pub(super) fn explanations(beside: &Beside, case: &Case) -> Vec<String> {
    let mut open = beside.deviating();
    if let Some(whole) = mirrored(beside, &open).or_else(|| exchanged_bodies(beside)) {
        return vec![whole];
    }
    let mut found = Vec::new();
    let single = open.clone();
    let single = single
        .iter()
        .map(|&column| (format!("`{}`", name(column)), vec![column]));
    let groups = GROUPS
        .iter()
        .map(|(what, names)| (what.to_string(), indices(names)));
    for (what, group) in groups.chain(single) {
        let group: Vec<usize> = group
            .into_iter()
            .filter(|column| beside.columns.contains(column))
            .collect();
        // A column of zeros is right with every factor.
        let moves = |column: &&usize| beside.expected.iter().any(|row| row[**column].abs() > 1e-9);
        let moving: Vec<usize> = group.iter().filter(moves).copied().collect();
        if !moving.iter().any(|column| open.contains(column)) {
            continue;
        }
        if let Some(relation) = relation(beside, &what, &group, case) {
            open.retain(|column| !group.contains(column));
            found.push(relation);
        }
    }
    match open.is_empty() && found.len() <= MOST_RELATIONS {
        true => found,
        false => exchanged_columns(beside, &beside.deviating())
            .into_iter()
            .collect(),
    }
}

/// Whether the stack is written as a mirror shows it.
fn mirrored(beside: &Beside, deviating: &[usize]) -> Option<String> {
    let mirrored = beside.expected.iter().map(|row| {
        let mut row = *row;
        indices(&MIRRORED)
            .into_iter()
            .for_each(|column| row[column] = -row[column]);
        row
    });
    let mirrored: Vec<Row> = mirrored.collect();
    let explains = !deviating.is_empty() && beside.explains(&mirrored, &beside.columns);
    explains.then(|| {
        let text = "left and right are exchanged: cylinder 2 is the right one, x points to the right, and angles count \
                    counter-clockwise";
        text.to_owned()
    })
}

/// Whether the bodies are written in another order.
fn exchanged_bodies(beside: &Beside) -> Option<String> {
    const ORDERS: [[usize; 3]; 5] = [[0, 2, 1], [1, 0, 2], [2, 1, 0], [1, 2, 0], [2, 0, 1]];
    let bodies = ["x1", "x2", "x3"].map(index);
    let order = ORDERS.into_iter().find(|order| {
        let reordered: Vec<Row> = beside
            .expected
            .iter()
            .map(|row| {
                let mut other = *row;
                for (body, from) in order.iter().enumerate() {
                    let (to, from) = (bodies[body], bodies[*from]);
                    other[to..to + 3].copy_from_slice(&row[from..from + 3]);
                }
                other
            })
            .collect();
        beside.explains(&reordered, &beside.columns)
    })?;
    Some(format!(
        "the cylinders are written in another order: where 1 (top), 2 (right), 3 (left) must stand, there are {}, {}, {}",
        order[0] + 1,
        order[1] + 1,
        order[2] + 1
    ))
}

/// Whether two columns, on one side or on both, stand in place of each other.
fn exchanged_columns(beside: &Beside, deviating: &[usize]) -> Option<String> {
    let both: [(&[&str], &[&str]); 3] = [
        (&NORMALS, &SHEARS),
        (&WIDTHS, &HEIGHTS),
        (&["floor_n2", "floor_t2"], &["floor_n3", "floor_t3"]),
    ];
    let both = both
        .into_iter()
        .map(|(left, right)| (indices(left), indices(right)));
    let pairs = deviating
        .iter()
        .flat_map(|&left| deviating.iter().map(move |&right| (left, right)));
    let pairs = pairs
        .filter(|(left, right)| left < right)
        .map(|(left, right)| (vec![left], vec![right]));
    let mut all = both.chain(pairs);
    let (left, right) = all.find(|(left, right)| {
        let exchanged: Vec<Row> = beside
            .expected
            .iter()
            .map(|row| {
                let mut other = *row;
                left.iter()
                    .zip(right)
                    .for_each(|(&left, &right)| other.swap(left, right));
                other
            })
            .collect();
        beside.explains(&exchanged, &beside.columns)
    })?;
    let names = |columns: &[usize]| {
        columns
            .iter()
            .map(|&column| name(column))
            .collect::<Vec<_>>()
            .join(", ")
    };
    Some(format!(
        "{} and {} are exchanged",
        names(&left),
        names(&right)
    ))
}

/// The relation between found and expected values of a group of columns, in words.
fn relation(beside: &Beside, what: &str, group: &[usize], case: &Case) -> Option<String> {
    let weight = case.stack.epsilon();
    let change = |value: &dyn Fn(usize, usize) -> f64| -> Vec<Row> {
        let rows = 0..beside.expected.len();
        rows.map(|row| std::array::from_fn(|column| value(row, column)))
            .collect()
    };
    let expected = |row: usize, column: usize| beside.expected[row][column];
    let explains = |rows: &[Row]| beside.explains(rows, group);
    let factor = slope(beside, group, &expected);
    if explains(&change(&|row, column| factor * expected(row, column))) {
        return Some(with_factor(what, factor, weight, group));
    }
    let start = |column: usize| expected(0, column);
    if explains(&change(&|row, column| {
        expected(row, column) - start(column)
    })) {
        return Some(format!(
            "{what} count from the beginning of the compression, and must count from the floor and \
                             from the stack before gravity rose"
        ));
    }
    let factor = slope(beside, group, &|row, column| {
        expected(row, column) - start(column)
    });
    if explains(&change(&|row, column| {
        factor * (expected(row, column) - start(column))
    })) {
        return Some(format!(
            "{what}: {factor:.6} times the change since the beginning of the compression stands in \
                             place of the value"
        ));
    }
    let offset = offset(beside, group);
    if explains(&change(&|row, column| expected(row, column) + offset)) {
        return Some(with_offset(what, offset, weight));
    }
    let changes: Vec<Row> = change(&|row, column| match group.contains(&column) {
        true => change_in_a_step(beside, row, column),
        false => 0.0,
    });
    let lag = slope_of(
        beside,
        group,
        &|row, column| -changes[row][column],
        &|row, column| beside.found[row][column] - expected(row, column),
    );
    let (time, step) = (index("time"), case.protocol.time_step);
    let late = |lag: f64| -> Vec<Row> {
        let times = beside.expected.iter().map(|row| row[time]);
        times
            .map(|time| at_time(beside.dense, time - lag * step))
            .collect()
    };
    let lags = [lag.round(), 0.5 * (2.0 * lag).round(), lag];
    if let Some(lag) = lags.into_iter().find(|&lag| explains(&late(lag))) {
        return Some(with_lag(what, lag, case));
    }
    let magnitude = change(&|row, column| expected(row, column).abs());
    explains(&magnitude).then(|| format!("{what} are written without their signs"))
}

/// Change of a column per step, from the steps before and after a row.
fn change_in_a_step(beside: &Beside, row: usize, column: usize) -> f64 {
    let time = index("time");
    let step = beside.dense[1][time];
    let now = beside.expected[row][time];
    let [before, after] = [now - step, now + step].map(|time| at_time(beside.dense, time)[column]);
    0.5 * (after - before)
}

/// The factor of `by` that is nearest to what was found.
fn slope(beside: &Beside, group: &[usize], by: &dyn Fn(usize, usize) -> f64) -> f64 {
    slope_of(beside, group, by, &|row, column| beside.found[row][column])
}

fn slope_of(
    beside: &Beside,
    group: &[usize],
    by: &dyn Fn(usize, usize) -> f64,
    of: &dyn Fn(usize, usize) -> f64,
) -> f64 {
    let rows = 0..=super::rows::peak(beside.expected);
    let places: Vec<(usize, usize)> = rows
        .flat_map(|row| group.iter().map(move |&column| (row, column)))
        .collect();
    let square: f64 = places
        .iter()
        .map(|&(row, column)| by(row, column).powi(2))
        .sum();
    let product: f64 = places
        .iter()
        .map(|&(row, column)| by(row, column) * of(row, column))
        .sum();
    product / square.max(f64::MIN_POSITIVE)
}

fn offset(beside: &Beside, group: &[usize]) -> f64 {
    let rows = super::rows::peak(beside.expected) + 1;
    let apart = (0..rows).flat_map(|row| {
        group
            .iter()
            .map(move |&column| beside.found[row][column] - beside.expected[row][column])
    });
    apart.sum::<f64>() / (rows * group.len()) as f64
}

fn with_factor(what: &str, factor: f64, weight: f64, group: &[usize]) -> String {
    let text = format!("{what}: {factor:.6} times what must stand there");
    if is_about(factor, -1.0) {
        let is = |names: &[&str]| group.iter().all(|column| indices(names).contains(column));
        let sign = if is(&WALL) {
            "the force on the wall in place of that of the wall on cylinder 1, which counts positive in compression"
        } else if is(&ANGLES) {
            "they count clockwise, and must count counter-clockwise; or those of cylinders 2 and 3 are exchanged"
        } else if is(&FLOOR) {
            "the force on the floor in place of that of the floor on the cylinder (normal upwards, tangential along +x); \
             or those of cylinders 2 and 3 are exchanged"
        } else if is(&WIDTHS) {
            "x points to the left, or those of cylinders 2 and 3 are exchanged"
        } else {
            "the sign is wrong"
        };
        return format!("{text}: {sign}");
    }
    if factor.abs() < 1e-9 {
        return format!("{what} are all 0: they are written before they are computed, or never");
    }
    let meanings = of_factor(factor, weight);
    match (meanings.is_empty(), factor < 0.0) {
        (false, _) => format!("{text}: {}", meanings.join("; or ")),
        (true, true) => {
            let meanings = of_factor(-factor, weight);
            let meanings = if meanings.is_empty() {
                "and another unit".to_owned()
            } else {
                meanings.join("; or ")
            };
            format!("{text}: the sign is wrong, {meanings}")
        }
        (true, false) => format!("{text}: another unit, or a factor too many"),
    }
}

fn with_offset(what: &str, offset: f64, weight: f64) -> String {
    let text = format!("{what} are off by {offset:+.6} throughout");
    let own = |value: f64, meaning: &str| (value, meaning.to_owned());
    let mut candidates = vec![
        own(
            1.0,
            "one radius: heights must be those of the centres above the floor, not of the uppermost points, and \
                  the floor is y = 0",
        ),
        own(
            -1.0,
            "one radius: heights must be those of the centres above the floor, not of the lowest points",
        ),
        own(2.0, "a diameter: the origin lies elsewhere"),
    ];
    for (count, whose) in [
        (1.0, "one cylinder"),
        (2.0, "two cylinders"),
        (3.0, "the whole stack"),
        (0.5, "half a cylinder"),
        (1.5, "half the stack"),
    ] {
        candidates.push((
            count * weight,
            format!("it includes the weight of {whose}; it must be the contact force alone"),
        ));
        candidates.push((
            -count * weight,
            format!("the weight of {whose} is taken off; it must be the contact force alone"),
        ));
    }
    let meanings = super::factor::meanings(offset, &candidates);
    match meanings.is_empty() {
        true => format!(
            "{text}: the origin lies elsewhere (the floor is y = 0, x = 0 in the middle), or a constant is added"
        ),
        false => format!("{text}: {}", meanings.join("; or ")),
    }
}

fn with_lag(what: &str, steps: f64, case: &Case) -> String {
    let schedule = case.protocol.schedule();
    let text = format!(
        "{what} of a row belong to a moment {:.3} steps {}",
        steps.abs(),
        if steps > 0.0 { "before it" } else { "after it" }
    );
    if is_about(steps, 1.0) {
        format!(
            "{text}: they are kept from the step before, or the positions have moved on before the row is written"
        )
    } else if is_about(steps, -1.0) {
        format!("{text}: the row is written after the step, and labelled with the step before")
    } else if is_about(2.0 * steps, schedule.fine_every as f64) {
        format!("{text}: they are averages over the interval between rows; a row is one moment")
    } else {
        format!("{text}: all values of a row must belong to the same step")
    }
}
