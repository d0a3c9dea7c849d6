//! Mistakes in writing: the code computes correctly, but a column holds something else that its twin knows.

use super::evidence::{Column, Evidence, ROUNDING, of_contact};
use super::table::{MOST_CAUSES, TABLE, meanings};
use super::twin::{CONTACTS, FLOOR, OF_BODY, PER_CONTACT, Row, WALL, WIDTH};

/// The columns that change their sign in a mirror.
const MIRRORED: [&str; 8] = [
    "x1", "theta1", "x2", "theta2", "x3", "theta3", "floor_t2", "floor_t3",
];
/// Orders in which the bodies may be written.
const ORDERS: [[usize; 3]; 5] = [[0, 2, 1], [1, 0, 2], [2, 1, 0], [1, 2, 0], [2, 0, 1]];

/// A stack whose rows are compared with those of its twin, which are known at every step.
pub(super) struct Written<'a> {
    pub(super) own: &'a Evidence,
    dense: Vec<Row>,
    weight: f64,
    pub(super) time_step: f64,
    /// Smallest number of steps between two rows.
    every: u64,
}

/// Returns the columns that are not as expected, with what they hold; empty unless at most [`MOST_CAUSES`] mistakes
/// in writing explain them all.
pub(super) fn explanations(own: &Evidence) -> Vec<String> {
    let run = own.twin.run;
    let steps: Vec<u64> = own.found.iter().map(|(step, _)| *step).collect();
    let every = steps
        .windows(2)
        .map(|two| two[1] - two[0])
        .min()
        .unwrap_or(1);
    let dense = own.dense();
    let written = Written {
        own,
        dense,
        weight: run.gravity,
        time_step: run.time_step,
        every,
    };
    let numbers = written.dense.iter().flatten();
    if written.dense.is_empty() || numbers.clone().any(|number| !number.is_finite()) {
        return Vec::new();
    }
    if let Some(whole) = written.reordered() {
        return vec![whole];
    }
    let off = (0..own.columns.len())
        .filter(|&column| !written.explains(column, &|step| written.right(column, step)));
    let mut told: Vec<(String, Vec<&str>)> = Vec::new();
    for column in off {
        let Some(relation) = written.relation(column) else {
            return Vec::new();
        };
        let name = own.columns[column].name;
        match told.iter_mut().find(|(known, _)| *known == relation) {
            Some((_, names)) => names.push(name),
            None => told.push((relation, vec![name])),
        }
    }
    if told.len() > MOST_CAUSES {
        told.clear();
    }
    told.into_iter()
        .map(|(relation, names)| format!("{} {relation}", written.subject(&names)))
        .collect()
}

/// Names a number of the twin.
fn title(place: usize) -> String {
    const NUMBERS: [&str; PER_CONTACT] = [
        "normal force",
        "tangential force",
        "spring's part (without the damping) of the normal force",
        "overlap",
        "length of the tangential spring",
        "tangential force before it is limited by Coulomb (the trial force)",
    ];
    const QUANTITIES: [&str; 9] = [
        "x",
        "y",
        "angle",
        "horizontal velocity",
        "vertical velocity",
        "angular velocity",
        "horizontal net force",
        "vertical net force (the sum of contacts and weight)",
        "net torque",
    ];
    let Some(contact) = place.checked_sub(3 * OF_BODY.len()) else {
        return format!(
            "the {} of cylinder {}",
            QUANTITIES[place % OF_BODY.len()],
            place / OF_BODY.len() + 1
        );
    };
    let (contact, number) = (contact / PER_CONTACT, NUMBERS[contact % PER_CONTACT]);
    let between = match CONTACTS[contact] {
        (one, Some(two)) => format!("between cylinders {} and {}", two + 1, one + 1),
        (one, None) if WALL.contains(&contact) => {
            format!("between the top wall and cylinder {}", one + 1)
        }
        (one, None) => format!("between the floor and cylinder {}", one + 1),
    };
    format!("the {number} {between}")
}

impl Written<'_> {
    /// Whether values given by step explain a column.
    pub(super) fn explains(&self, column: usize, value: &dyn Fn(f64) -> f64) -> bool {
        let allowed = self.own.allowed() * self.own.columns[column].scale;
        let mut rows = self.own.found.iter();
        rows.all(|(step, values)| (values[column] - value(*step as f64)).abs() <= allowed)
    }

    pub(super) fn right(&self, column: usize, step: f64) -> f64 {
        self.at(step, |row| self.own.columns[column].of(row))
    }

    /// Returns a number of the twin at a `step`, which may lie between two of them; before the first one the stack is
    /// at rest.
    fn at(&self, step: f64, value: impl Fn(&Row) -> f64) -> f64 {
        let last = self.dense.len() - 1;
        let place = step.clamp(0.0, last as f64);
        let before = (place as usize).min(last.saturating_sub(1));
        let share = place - before as f64;
        let (one, two) = (
            value(&self.dense[before]),
            value(&self.dense[(before + 1).min(last)]),
        );
        one + share * (two - one)
    }

    /// Detects columns that are those of other bodies, or of a mirror image.
    fn reordered(&self) -> Option<String> {
        let columns = 0..self.own.columns.len();
        let explains = |of: &dyn Fn(&Column) -> Column| {
            let all = columns.clone().all(|column| {
                let other = of(&self.own.columns[column]);
                self.explains(column, &|step| self.at(step, |row| other.of(row)))
            });
            all && self.own.is_off()
        };
        let mirror = |column: &Column| {
            let sign = if MIRRORED.contains(&column.name) {
                -1.0
            } else {
                1.0
            };
            let parts = column
                .parts
                .iter()
                .map(|(place, own)| (*place, sign * own))
                .collect();
            Column {
                parts,
                ..column.clone()
            }
        };
        if explains(&mirror) {
            let text = "left and right are exchanged: cylinder 2 is the right one, x points to the right, and angles count \
                        counter-clockwise";
            return Some(text.to_owned());
        }
        let order = ORDERS.into_iter().find(|order| {
            explains(&|column| {
                let bodies = 3 * OF_BODY.len();
                let other = |place: usize| match place < bodies {
                    true => order[place / OF_BODY.len()] * OF_BODY.len() + place % OF_BODY.len(),
                    false => place,
                };
                let parts = column
                    .parts
                    .iter()
                    .map(|(place, own)| (other(*place), *own))
                    .collect();
                Column {
                    parts,
                    ..column.clone()
                }
            })
        })?;
        let [first, second, third] = order.map(|body| body + 1);
        Some(format!(
            "the cylinders are written in another order: where 1 (top), 2 (right), 3 (left) must stand, there are {first}, \
             {second}, {third}"
        ))
    }

    /// Says what a column holds.
    fn relation(&self, column: usize) -> Option<String> {
        let own = |step: f64| self.right(column, step);
        let zero = |_: f64| 0.0;
        let tests: [&dyn Fn() -> Option<String>; 7] = [
            &|| {
                self.explains(column, &zero)
                    .then(|| "all 0: written before they are computed, or never".to_owned())
            },
            &|| Some(self.with_factor(column, self.factor(column, &own)?)),
            &|| self.late(column).filter(|_| self.own.same <= ROUNDING),
            &|| self.transformed(column),
            &|| Some(self.with_offset(self.offset(column)?)),
            &|| self.another(column),
            &|| {
                self.with_another(column)
                    .filter(|_| self.own.same <= ROUNDING)
            },
        ];
        tests.iter().find_map(|test| test())
    }

    /// Fits the factor between a column and some values; `None` if they differ by more than that.
    pub(super) fn factor(&self, column: usize, value: &dyn Fn(f64) -> f64) -> Option<f64> {
        let mut sums = [0.0; 2];
        for (step, values) in &self.own.found {
            let by = value(*step as f64);
            sums[0] += by * values[column];
            sums[1] += by * by;
        }
        let factor = sums[0] / sums[1];
        (sums[1] > 0.0 && self.explains(column, &|step| factor * value(step))).then_some(factor)
    }

    fn offset(&self, column: usize) -> Option<f64> {
        let rows = self.own.found.iter();
        let sum: f64 = rows
            .map(|(step, values)| values[column] - self.right(column, *step as f64))
            .sum();
        let offset = sum / self.own.found.len() as f64;
        self.explains(column, &|step| self.right(column, step) + offset)
            .then_some(offset)
    }

    /// Detects a column that belongs to another step.
    fn late(&self, column: usize) -> Option<String> {
        let every = self.every as f64;
        let lags = [
            1.0,
            -1.0,
            0.5,
            -0.5,
            2.0,
            -2.0,
            every,
            -every,
            0.5 * every,
            0.5 * (every - 1.0),
        ];
        let lag = lags
            .into_iter()
            .find(|lag| self.explains(column, &|step| self.right(column, step - lag)))?;
        let when = if lag > 0.0 { "before it" } else { "after it" };
        let text = format!("of a row belong to a moment {:.3} steps {when}", lag.abs());
        Some(match lag {
            1.0 => format!(
                "{text}: they are kept from the step before, or the positions have moved on before the row is written"
            ),
            -1.0 => format!(
                "{text}: the row is written after the step, and labelled with the step before"
            ),
            _ if lag.abs() == every => {
                format!("{text}, the distance of two rows: they stand in another row")
            }
            _ => format!("{text}: all values of a row must belong to the same step"),
        })
    }

    /// Detects a column that holds a multiple of another number of the twin, or of the sum of two.
    fn another(&self, column: usize) -> Option<String> {
        let known = self
            .own
            .columns
            .iter()
            .map(|other| (format!("`{}`", other.name), other.parts.clone()));
        let all = (0..WIDTH).map(|place| (title(place), vec![(place, 1.0)]));
        let forces = |number| {
            [1, 2]
                .map(|body| (of_contact(FLOOR.start + body, number), 1.0))
                .to_vec()
        };
        let borne = |row: &Row| forces(0).iter().map(|(place, _)| row[*place]).sum::<f64>();
        let sums = [0, 1].map(|number| {
            let name = ["normal", "tangential"][number];
            (
                format!("the sum of the {name} forces of the floor on both cylinders"),
                forces(number),
            )
        });
        if self.explains(column, &|step| {
            self.at(step, |row| borne(row)) - 3.0 * self.weight
        }) {
            let text = "what stands there is the sum of the normal forces of the floor less the weight of the stack";
            return Some(text.to_owned());
        }
        let all: Vec<(String, Vec<(usize, f64)>)> = known.chain(all).chain(sums).collect();
        let simple = |factor: f64| [1.0, -1.0].iter().any(|own| (factor - own).abs() < 1e-6);
        let fitting = all.iter().filter_map(|(name, parts)| {
            let other = Column {
                parts: parts.clone(),
                ..self.own.columns[column].clone()
            };
            Some((
                name,
                self.factor(column, &|step| self.at(step, |row| other.of(row)))?,
            ))
        });
        let mut fitting: Vec<(&String, f64)> = fitting.collect();
        fitting.sort_by_key(|(_, factor)| !simple(*factor));
        let (name, factor) = fitting.first()?;
        let meaning = self.meaning(*factor);
        Some(match simple(*factor) {
            true if *factor > 0.0 => {
                format!("what stands there is {name}: exchanged, or the wrong variable")
            }
            true => format!("what stands there is {name} with the opposite sign"),
            false => format!("what stands there is {factor:.6} times {name}{meaning}"),
        })
    }

    /// Detects a column that holds the right value plus a multiple of another number.
    fn with_another(&self, column: usize) -> Option<String> {
        let scale = self.own.columns[column].scale;
        let found = (0..WIDTH).find_map(|place| {
            let mut sums = [0.0; 2];
            for (step, values) in &self.own.found {
                let by = self.at(*step as f64, |row| row[place]);
                sums[0] += by * (values[column] - self.right(column, *step as f64));
                sums[1] += by * by;
            }
            let factor = sums[0] / sums[1];
            let told =
                |step: f64| self.right(column, step) + factor * self.at(step, |row| row[place]);
            (sums[1] > 1e-12 * scale * scale && self.explains(column, &told))
                .then_some((place, factor))
        })?;
        let (place, factor) = found;
        let meaning = self.meaning(factor);
        Some(format!(
            "hold {factor:+.6} times {} besides{meaning}",
            title(place)
        ))
    }

    fn meaning(&self, factor: f64) -> String {
        let meanings = meanings("", factor, 1.0, 1.0, |name| match name {
            "gravity" => self.weight,
            "time_step" => self.time_step,
            _ => f64::NAN,
        });
        meanings
            .first()
            .map_or_else(String::new, |meaning| format!(" ({meaning})"))
    }

    fn with_factor(&self, column: usize, factor: f64) -> String {
        let text = format!("{factor:.6} times what must stand there");
        if (factor + 1.0).abs() > 1e-4 {
            return format!("{text}{}", self.meaning(factor));
        }
        let sign = match self.own.columns[column].name.as_bytes()[0] {
            b'w' => {
                "the force on the wall in place of that of the wall on cylinder 1, which counts positive in compression"
            }
            b't' => {
                "they count clockwise, and must count counter-clockwise; or those of cylinders 2 and 3 are exchanged"
            }
            b'f' => {
                "the force on the floor in place of that of the floor on the cylinder (normal upwards, tangential along \
                     +x); or those of cylinders 2 and 3 are exchanged"
            }
            b'x' => "x points to the left, or those of cylinders 2 and 3 are exchanged",
            _ => "the sign is wrong",
        };
        format!("{text}: {sign}")
    }

    fn with_offset(&self, offset: f64) -> String {
        const RADIUS: &str =
            "the radius: heights must be those of the centres above the floor, not of the";
        let weights = [
            (1.0, "one cylinder"),
            (2.0, "two cylinders"),
            (3.0, "the whole stack"),
            (0.5, "half a cylinder"),
            (1.5, "half the stack"),
        ];
        let text = format!("off by {offset:+.6} throughout");
        let is = |value: f64| (offset - value).abs() <= 1e-4 * value.abs();
        if is(1.0) || is(-1.0) {
            let points = if offset > 0.0 { "uppermost" } else { "lowest" };
            return format!("{text}: {RADIUS} {points} points");
        }
        let weight = weights
            .into_iter()
            .find(|(count, _)| is(count * self.weight) || is(-count * self.weight));
        match weight {
            Some((_, whose)) if offset > 0.0 => {
                format!(
                    "{text}: it includes the weight of {whose}; it must be the contact force alone"
                )
            }
            Some((_, whose)) => format!(
                "{text}: the weight of {whose} is taken off; it must be the contact force alone"
            ),
            None => format!(
                "{text}: the origin lies elsewhere (the floor is y = 0, x = 0 in the middle), or a constant is added"
            ),
        }
    }

    /// Names the columns.
    fn subject(&self, names: &[&str]) -> String {
        let there = |name: &&str| self.own.columns.iter().any(|column| column.name == *name);
        let moves = |name: &&str| {
            let place = self
                .own
                .columns
                .iter()
                .position(|column| column.name == *name);
            place.is_some_and(|column| {
                self.own
                    .found
                    .iter()
                    .any(|(_, values)| values[column].abs() > 1e-9)
            })
        };
        // A column of zeros is right with every factor.
        let group = TABLE.group.iter().find(|group| {
            let own = group.columns.iter().map(String::as_str);
            let group: Vec<&str> = own.filter(|name| there(name) && moves(name)).collect();
            group == names
        });
        let list = || {
            names
                .iter()
                .map(|name| format!("`{name}`"))
                .collect::<Vec<_>>()
                .join(", ")
        };
        group.map_or_else(|| format!("{}:", list()), |group| format!("{}:", group.is))
    }
}
