//! What a code has written, compared with what its twin writes. A deviation of 1 is as large as the load, the whole
//! displacement, or the largest force of a micro-test.

use super::twin::{FLOOR, OF_BODY, PER_CONTACT, Row, Twin, WALL};
use crate::model::{Case, ContactConvention, ContactTest};
use crate::runs::Answer;
use crate::series::{Column as Declared, MotionRow, Sample, Series};

/// Largest distance of two codes with the same law but different integrators: ten times that of LAMMPS.
pub(super) const SAME: f64 = 1e-3;
/// Largest distance of two codes with the same law and integrator: rounding, which grows in a contact that slides.
pub(super) const ROUNDING: f64 = 1e-6;
/// Fraction of a deviation that may remain once its cause is found.
const EXPLAINED: f64 = 0.1;
/// Prefix of the text on a stack that moves differently although its micro-tests are right.
pub(super) const MOVED: &str = "single contacts are right";
/// Largest deviation, in units of its scale, of a column that is nearly a multiple of the right values.
const NEARLY: f64 = 1e-2;
/// Factor by which a small distance, that of another integrator, may grow.
const AS_BEFORE: f64 = 3.0;

/// Returns the index in a row of a number of a contact: 0 normal force, 1 tangential force, 2 force of the normal
/// spring, 3 overlap, 4 length of the tangential spring, 5 trial force.
pub(super) const fn of_contact(contact: usize, number: usize) -> usize {
    3 * OF_BODY.len() + contact * PER_CONTACT + number
}

/// A column of a result, as a signed sum of the twin's numbers.
#[derive(Debug, Clone)]
pub(super) struct Column {
    pub name: &'static str,
    pub parts: Vec<(usize, f64)>,
    pub scale: f64,
}

impl Column {
    pub fn of(&self, row: &Row) -> f64 {
        self.parts
            .iter()
            .map(|(place, sign)| sign * row[*place])
            .sum()
    }

    /// Returns the column called `name`: a number of a body, or a contact force.
    fn named(name: &'static str, is_motion: bool) -> Option<Self> {
        let (letters, body) = name.split_at(name.len() - 1);
        let body = body
            .parse::<usize>()
            .ok()
            .and_then(|body| body.checked_sub(1));
        let on_floor = |number, sign| Some(vec![(of_contact(FLOOR.start + body?, number), sign)]);
        let parts = match (name, letters) {
            ("wall_force", _) if is_motion => Some(
                (0..2)
                    .map(|body| (of_contact(WALL.start + body, 0), 1.0))
                    .collect(),
            ),
            ("wall_force", _) => Some(vec![(of_contact(WALL.start, 0), 1.0)]),
            (_, "floor_n") => on_floor(0, 1.0),
            // The tangent of the floor is (-1, 0).
            (_, "floor_t") => on_floor(1, -1.0),
            _ => {
                let number = OF_BODY.iter().position(|own| *own == letters);
                number
                    .zip(body)
                    .map(|(number, body)| vec![(body * OF_BODY.len() + number, 1.0)])
            }
        }?;
        Some(Self {
            name,
            parts,
            scale: 1.0,
        })
    }
}

/// One run of a code, and its twin.
#[derive(Debug, Clone)]
pub(super) struct Evidence {
    pub twin: Twin,
    pub columns: Vec<Column>,
    /// Step and values of every row.
    pub found: Vec<(u64, Vec<f64>)>,
    /// Distance from the twin without a fault.
    pub before: f64,
    /// Distance from which the rows count as different.
    pub same: f64,
}

impl Evidence {
    /// Returns the evidence of a stack that a code with this `convention` has compressed: to its end if `is_whole`,
    /// else up to its peak.
    pub fn of_stack(
        series: &Series,
        case: &Case,
        convention: ContactConvention,
        is_whole: bool,
    ) -> Self {
        let case = Case {
            convention,
            ..*case
        };
        let samples = series.samples();
        let highest = (0..samples.len())
            .max_by(|&one, &two| samples[one].wall_force.total_cmp(&samples[two].wall_force));
        let until = highest.map_or(0, |peak| peak + 1);
        let until = if is_whole { samples.len() } else { until };
        let columns = Sample::columns(case.stack.bodies);
        Self::new(Twin::of_stack(&case), columns, &samples[..until])
    }

    /// Returns the evidence of a micro-test under this `convention`, with the restitution of the test.
    pub fn of_motion(answer: &Answer, convention: ContactConvention) -> Self {
        let test = test_under(answer, convention);
        let columns = &MotionRow::COLUMNS;
        Self::new(Twin::of_motion(&test), columns, answer.motion.rows())
    }

    fn new<R>(twin: Twin, declared: &[Declared<R>], rows: &[R]) -> Self {
        let is_motion = twin.is_motion();
        let known = declared
            .iter()
            .filter_map(|own| Some((own.value, Column::named(own.name, is_motion)?)));
        let (values, columns): (Vec<_>, Vec<Column>) = known
            .filter(|(value, _)| rows.iter().all(|row| value(row).is_finite()))
            .unzip();
        let step = declared[0].value;
        let found = rows.iter().map(|row| {
            (
                step(row) as u64,
                values.iter().map(|value| value(row)).collect(),
            )
        });
        let mut own = Self {
            found: found.collect(),
            twin,
            columns,
            before: f64::INFINITY,
            same: SAME,
        };
        own.set_scales();
        own.before = own.distance(|_| (), f64::INFINITY);
        own
    }

    /// Replaces the rows by those of a twin with a `fault` that is interrupted ([`Twin::run_interrupted`]).
    #[cfg(test)]
    pub fn written_by(
        mut self,
        fault: impl Fn(&mut Twin),
        interrupt: impl FnMut(&mut Twin, u64),
    ) -> Self {
        let mut wrong = self.twin.clone();
        fault(&mut wrong);
        let (columns, found) = (&self.columns, &mut self.found);
        wrong.run_interrupted(interrupt, |step, row| {
            if let Ok(place) = found.binary_search_by_key(&step, |(own, _)| *own) {
                found[place].1 = columns.iter().map(|column| column.of(row)).collect();
            }
            found.last().is_some_and(|(last, _)| step < *last)
        });
        self.before = self.distance(|_| (), f64::INFINITY);
        self
    }

    /// Returns the rows of the twin without a fault, at every step.
    pub fn dense(&self) -> Vec<Row> {
        let mut rows = Vec::new();
        self.twin.clone().run(|_, row| {
            rows.push(*row);
            true
        });
        rows
    }

    /// Sets the scale of every column: the twin's largest displacement, rotation, speed or force.
    fn set_scales(&mut self) {
        let mut largest = [f64::MIN_POSITIVE; 4];
        let mut first: Option<Row> = None;
        let last = self.found.last().map_or(0, |(step, _)| *step);
        let columns = self.columns.clone();
        self.twin.clone().run(|step, row| {
            let start = *first.get_or_insert(*row);
            for column in &columns {
                let kind = kind(column.name);
                let origin = if kind < 2 { column.of(&start) } else { 0.0 };
                largest[kind] = largest[kind].max((column.of(row) - origin).abs());
            }
            step < last
        });
        self.columns
            .iter_mut()
            .for_each(|column| column.scale = largest[kind(column.name)]);
    }

    /// Returns the largest distance from the twin with a `fault`, or the first one above `limit`; infinite if the
    /// twin does not reach all rows or gives NaN.
    pub fn distance(&self, fault: impl Fn(&mut Twin), limit: f64) -> f64 {
        let mut twin = self.twin.clone();
        fault(&mut twin);
        self.distance_of(limit, |watch| twin.run(watch))
    }

    /// Returns the same from the twin without a fault which is interrupted ([`Twin::run_interrupted`]).
    pub fn distance_interrupted(&self, interrupt: impl Fn(&mut Twin, u64), limit: f64) -> f64 {
        let mut twin = self.twin.clone();
        self.distance_of(limit, |watch| twin.run_interrupted(interrupt, watch))
    }

    fn distance_of(&self, limit: f64, run: impl FnOnce(&mut dyn FnMut(u64, &Row) -> bool)) -> f64 {
        let (mut rows, mut worst) = (self.found.iter().peekable(), 0.0);
        run(&mut |step, row| {
            if let Some((_, values)) = rows.next_if(|(own, _)| *own == step) {
                let apart = self.apart(row, values);
                worst = if apart > worst || apart.is_nan() {
                    apart
                } else {
                    worst
                };
            }
            worst <= limit && rows.peek().is_some()
        });
        let is_cut = worst <= limit && rows.peek().is_some();
        match worst.is_nan() || is_cut {
            true => f64::INFINITY,
            false => worst,
        }
    }

    /// Returns the largest distance between a row of a twin and the values in a row of the code; NaN if one is.
    fn apart(&self, row: &Row, values: &[f64]) -> f64 {
        let each = self.columns.iter().zip(values);
        let each = each.map(|(column, value)| (column.of(row) - value).abs() / column.scale);
        each.fold(0.0, |worst, apart| match apart > worst || apart.is_nan() {
            true => apart,
            false => worst,
        })
    }

    /// Returns the distance of a row of a twin from that of the code at the same step, if there is one; infinite if a
    /// number is NaN.
    pub fn distance_at(&self, step: u64, row: &Row) -> Option<f64> {
        let place = self.found.partition_point(|(own, _)| *own < step);
        let (_, values) = self.found.get(place).filter(|(own, _)| *own == step)?;
        let apart = self.apart(row, values);
        Some(if apart.is_nan() { f64::INFINITY } else { apart })
    }

    /// Returns the distance of a twin that goes on from a step, in the next row.
    pub fn next_distance(&self, (step, mut twin): (u64, Twin)) -> f64 {
        let mut found = f64::INFINITY;
        let mut look = |step: u64, row: &Row| {
            self.distance_at(step, row).is_none_or(|distance| {
                found = distance;
                false
            })
        };
        twin.go_on(step, |_, _| (), &mut look);
        found
    }

    /// Returns how many rows are those of a twin that goes on from a step, until one is further off than `same`.
    pub fn rows_right(&self, (step, mut twin): (u64, Twin), same: f64) -> usize {
        let mut right = 0;
        let mut look = |step: u64, row: &Row| match self.distance_at(step, row) {
            Some(distance) if distance >= same => false,
            Some(_) => {
                right += 1;
                right < self.found.len()
            }
            None => true,
        };
        twin.go_on(step, |_, _| (), &mut look);
        right
    }

    /// Returns the first row that is off, in the column that is furthest off: name, step, found, expected.
    pub fn first_off(&self) -> (&'static str, u64, f64, f64) {
        let dense = self.dense();
        let rows = self
            .found
            .iter()
            .filter_map(|(step, values)| Some((*step, values, dense.get(*step as usize)?)));
        let mut worst = rows.map(|(step, values, right)| {
            let each = self.columns.iter().zip(values).map(|(column, value)| {
                let expected = column.of(right);
                (
                    (value - expected).abs() / column.scale,
                    (column.name, step, *value, expected),
                )
            });
            each.max_by(|one, two| one.0.total_cmp(&two.0))
                .unwrap_or((0.0, ("", step, 0.0, 0.0)))
        });
        worst
            .find(|(apart, _)| *apart >= self.same)
            .map_or(("", 0, 0.0, 0.0), |(_, told)| told)
    }

    /// Says where the rows begin to deviate from the twin: in a few columns alone, or in the motion of a stack whose
    /// micro-tests are right. `None` if nothing is off.
    pub fn beginning(&self) -> Option<String> {
        let dense = self.dense();
        let right = |step: u64, column: &Column| {
            dense
                .get(step as usize)
                .map_or(f64::NAN, |row| column.of(row))
        };
        let pairs = |index: usize| {
            let own = &self.columns[index];
            self.found
                .iter()
                .map(move |(step, values)| (values[index], right(*step, own)))
        };
        let furthest = |index: usize, factor: f64| {
            pairs(index).fold(0.0, |worst, (found, right)| {
                f64::max(worst, (found - factor * right).abs())
            }) / self.columns[index].scale
        };
        let off: Vec<usize> = (0..self.columns.len())
            .filter(|own| furthest(*own, 1.0) > ROUNDING)
            .collect();
        let own = Self {
            same: ROUNDING,
            ..self.clone()
        };
        let (name, step, found, expected) = own.first_off();
        let told = format!("{name} is {found:.9} at step {step}, where {expected:.9} is expected");
        if off.is_empty() {
            return None;
        }
        if off.len() < self.columns.len() / 2 {
            let each = off.iter().map(|&index| {
                let sums = pairs(index).fold([0.0; 2], |[by, own], (found, right)| {
                    [by + found * right, own + right * right]
                });
                let (name, factor) = (self.columns[index].name, sums[0] / sums[1]);
                match furthest(index, factor) {
                    rest if rest < NEARLY => {
                        format!("{name} (nearly {factor:.4} times the right values, to {rest:.0e})")
                    }
                    _ => name.to_owned(),
                }
            });
            let names = each.collect::<Vec<_>>().join(" and ");
            return Some(format!(
                "the motion is right: only the values of {names} are off, so that they are read or written wrongly; {told}"
            ));
        }
        let when = match step {
            0 => {
                "the stack is another one before the wall moves: what is wrong happens in its preparation (first places, \
                 gravity, ramp, rest) or where several contacts act at once"
            }
            _ => {
                "so is the stack at rest: what is wrong happens in its compression (the movement of the wall, what changes \
                 when it starts)"
            }
        };
        Some(format!("{MOVED}, and {when}; {told}"))
    }

    /// Whether the right half mirrors the left one, judged by the normal forces of the floor.
    pub fn is_symmetric(&self) -> bool {
        let place = |name: &str| self.columns.iter().position(|column| column.name == name);
        place("floor_n2")
            .zip(place("floor_n3"))
            .is_some_and(|(right, left)| {
                let apart = |values: &Vec<f64>| {
                    (values[right] - values[left]).abs() / self.columns[right].scale
                };
                self.found
                    .iter()
                    .all(|(_, values)| apart(values) < ROUNDING)
            })
    }

    /// Whether the rows differ from those of the twin without a fault.
    pub fn is_off(&self) -> bool {
        self.before >= self.same
    }

    /// Whether any column other than `names` is off.
    pub fn is_off_beside(&self, names: &[&str]) -> bool {
        let mut beside = self.clone();
        for column in beside
            .columns
            .iter_mut()
            .filter(|own| names.contains(&own.name))
        {
            column.scale = f64::INFINITY;
        }
        beside.distance(|_| (), self.same) >= self.same
    }

    /// Returns the largest distance at which a twin with a fault explains these rows.
    pub fn allowed(&self) -> f64 {
        match self.is_off() {
            true => self.same.min(EXPLAINED * self.before),
            false => (AS_BEFORE * self.before).max(ROUNDING),
        }
    }
}

/// The test of an answer under this `convention`, with the restitution of the test.
pub(super) fn test_under(answer: &Answer, convention: ContactConvention) -> ContactTest {
    let restitution = answer.test.convention.restitution;
    ContactTest {
        convention: ContactConvention {
            restitution,
            ..convention
        },
        ..answer.test
    }
}

/// Returns the kind of a column: 0 length, 1 angle, 2 speed, 3 force or torque.
fn kind(name: &str) -> usize {
    match name.as_bytes()[0] {
        b'x' | b'y' => 0,
        _ if name.starts_with("theta") => 1,
        _ if name.starts_with('v') || name.starts_with("spin") => 2,
        _ => 3,
    }
}
