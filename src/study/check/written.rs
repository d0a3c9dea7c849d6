//! Mistakes in what is written: the code computes rightly, and some columns are something else.

use super::beside::Beside;
use super::factor::{is_about, of_factor};
use super::rows::{
    ANGLES, FLOOR, FORCES, HEIGHTS, LENGTHS, MIRRORED, NORMALS, Row, SHEARS, WALL, WIDTHS, at_time,
    index, indices, name, peak,
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
        let group = Group {
            beside,
            case,
            what: &what,
            columns: &group,
        };
        if let Some(relation) = group.relation() {
            open.retain(|column| !group.columns.contains(column));
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

/// Columns that may share a mistake.
struct Group<'a> {
    beside: &'a Beside<'a>,
    case: &'a Case,
    what: &'a str,
    columns: &'a [usize],
}

impl Group<'_> {
    /// The relation between found and expected values, in words.
    fn relation(&self) -> Option<String> {
        self.factor()
            .or_else(|| self.since_start())
            .or_else(|| self.offset())
            .or_else(|| self.lag())
            .or_else(|| self.magnitude())
    }

    fn expected(&self, row: usize, column: usize) -> f64 {
        self.beside.expected[row][column]
    }

    /// Change of a column since the wall began to move.
    fn change(&self, row: usize, column: usize) -> f64 {
        self.expected(row, column) - self.expected(0, column)
    }

    /// Whether these values explain the columns.
    fn explains(&self, value: impl Fn(usize, usize) -> f64) -> bool {
        let rows = 0..self.beside.expected.len();
        let rows: Vec<Row> = rows
            .map(|row| std::array::from_fn(|column| value(row, column)))
            .collect();
        self.beside.explains(&rows, self.columns)
    }

    /// Rows up to the peak, and the columns.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        let rows = 0..=peak(self.beside.expected);
        rows.flat_map(|row| self.columns.iter().map(move |&column| (row, column)))
    }

    /// The factor of `by` that is nearest to `of`.
    fn slope(&self, by: impl Fn(usize, usize) -> f64, of: impl Fn(usize, usize) -> f64) -> f64 {
        let sum = |value: &dyn Fn(usize, usize) -> f64| -> f64 {
            self.places().map(|(row, column)| value(row, column)).sum()
        };
        let square = sum(&|row, column| by(row, column).powi(2));
        sum(&|row, column| by(row, column) * of(row, column)) / square.max(f64::MIN_POSITIVE)
    }

    fn found(&self, row: usize, column: usize) -> f64 {
        self.beside.found[row][column]
    }

    fn factor(&self) -> Option<String> {
        let factor = self.slope(|r, c| self.expected(r, c), |r, c| self.found(r, c));
        let explains = self.explains(|row, column| factor * self.expected(row, column));
        let weight = self.case.stack.epsilon();
        explains.then(|| with_factor(self.what, factor, weight, self.columns))
    }

    fn since_start(&self) -> Option<String> {
        let what = self.what;
        if self.explains(|row, column| self.change(row, column)) {
            return Some(format!(
                "{what} count from the beginning of the compression, and must count from the floor, \
                 from the middle, and from the stack before gravity rose"
            ));
        }
        let factor = self.slope(|r, c| self.change(r, c), |r, c| self.found(r, c));
        let explains = self.explains(|row, column| factor * self.change(row, column));
        explains.then(|| {
            format!(
                "{what}: {factor:.6} times the change since the beginning of the compression stands in \
                 place of the value"
            )
        })
    }

    fn offset(&self) -> Option<String> {
        let apart = self
            .places()
            .map(|(r, c)| self.found(r, c) - self.expected(r, c));
        let offset = apart.sum::<f64>() / self.places().count() as f64;
        let explains = self.explains(|row, column| self.expected(row, column) + offset);
        explains.then(|| with_offset(self.what, offset, self.case.stack.epsilon()))
    }

    fn lag(&self) -> Option<String> {
        let (time, step) = (index("time"), self.case.protocol.time_step);
        let rows = self.beside.expected.iter();
        let late = |lag: f64| -> Vec<Row> {
            let moments = rows.clone().map(|row| row[time] - lag * step);
            moments
                .map(|moment| at_time(self.beside.dense, moment))
                .collect()
        };
        let [before, after] = [late(0.5), late(-0.5)];
        let lag = self.slope(
            |row, column| before[row][column] - after[row][column],
            |row, column| self.found(row, column) - self.expected(row, column),
        );
        let mut lags = [lag.round(), 0.5 * (2.0 * lag).round(), lag].into_iter();
        let lag = lags.find(|&lag| self.beside.explains(&late(lag), self.columns))?;
        Some(with_lag(self.what, lag, self.case))
    }

    fn magnitude(&self) -> Option<String> {
        let explains = self.explains(|row, column| self.expected(row, column).abs());
        explains.then(|| format!("{} are written without their signs", self.what))
    }
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
