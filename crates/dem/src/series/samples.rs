//! The time series that every code delivers, and its checks.

use super::column::Column;
use super::drop::DropWatch;
use super::header::{ColumnSources, csv_rows};
use super::sample::Sample;
use crate::model::{Case, Schedule, readable_lines};
use std::io::Read;
use thiserror::Error;

/// Why a series is not the one that was requested. Rows are counted from 1, the row after the header.
#[derive(Debug, Error)]
#[allow(missing_docs)] // The messages say what each is.
pub enum SeriesError {
    #[error("{message}")]
    Absent { message: String },
    #[error("row {row}: {message}")]
    Garbled { row: usize, message: String },
    #[error("the columns are `{found}`; {problem}")]
    Columns { found: String, problem: String },
    #[error(transparent)]
    NotFinite(#[from] NotFinite),
    #[error("row {row} is at step {found}, but must be at step {expected}")]
    WrongStep {
        row: usize,
        found: u64,
        expected: u64,
    },
    #[error("row {row} (step {step}) is at time {found}, but must be at {expected}")]
    WrongTime {
        row: usize,
        step: u64,
        found: f64,
        expected: f64,
    },
    #[error("the series has {found} rows{}, but must have {expected}", or_more(*found, *expected))]
    Truncated { found: usize, expected: usize },
}

/// Numbers of a row that are not finite.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("row {row} (step {step}): `{}` is {value}, but must be a finite number{}", .columns[0], and_others(.columns))]
pub struct NotFinite {
    /// The row, counted from 1.
    pub row: usize,
    /// Its step.
    pub step: u64,
    /// The columns with these numbers, at least one.
    pub columns: Vec<&'static str>,
    /// The number in the first of them.
    pub value: f64,
    /// How many other columns there are, beside step and time.
    pub finite: usize,
    /// The largest magnitude of a number in those, and in the rows before.
    pub largest: f64,
}

/// Names the further `columns` with numbers that are not finite.
fn and_others(columns: &[&str]) -> String {
    match columns {
        [] | [_] => String::new(),
        [_, others @ ..] => format!(", and so must {}", others.join(", ")),
    }
}

impl NotFinite {
    /// Finds the first of `rows` with a number in `columns` that is not finite; `step` gives the step of a row.
    pub(super) fn find<R>(
        rows: &[R],
        columns: &[&Column<R>],
        step: impl Fn(&R) -> u64,
    ) -> Option<Self> {
        let mut largest = 0.0_f64;
        for (row, own) in (1..).zip(rows) {
            let mut bad = Vec::new();
            let mut finite = 0;
            for column in columns {
                let value = (column.value)(own);
                if !value.is_finite() {
                    bad.push((column.name, value));
                } else if !COUNTERS.contains(&column.name) {
                    finite += 1;
                    largest = largest.max(value.abs());
                }
            }
            if let Some(&(_, value)) = bad.first() {
                return Some(Self {
                    row,
                    step: step(own),
                    columns: bad.into_iter().map(|(name, _)| name).collect(),
                    value,
                    finite,
                    largest,
                });
            }
        }
        None
    }
}

/// Columns that count, and say nothing about sizes.
const COUNTERS: [&str; 2] = ["step", "time"];

impl SeriesError {
    /// There is no series; `message` names what is missing, and what was found instead.
    pub fn absent(message: impl Into<String>) -> Self {
        let message = readable_lines(&message.into());
        Self::Absent { message }
    }

    /// `row` cannot be used, for the reason that `message` gives.
    pub fn garbled(row: usize, message: impl ToString) -> Self {
        let message = readable_lines(&message.to_string());
        Self::Garbled { row, message }
    }
}

fn planned_rows(schedule: &Schedule) -> usize {
    usize::try_from(schedule.rows()).unwrap_or(usize::MAX)
}

/// Marks a count as a lower bound, since not all rows beyond the expected end are counted.
fn or_more(found: usize, expected: usize) -> &'static str {
    if found > expected { " or more" } else { "" }
}

/// Whether the drop of the wall force ends the run at the last row, and not before.
fn ends_with_the_drop(samples: &[Sample], schedule: &Schedule) -> bool {
    let mut watch = DropWatch::new(schedule.stop_at_drop);
    let mut fine = samples
        .iter()
        .filter(|row| row.step >= schedule.fine_from_step);
    let ends = fine.position(|row| watch.has_dropped(row.wall_force));
    ends.is_some() && fine.next().is_none()
}

/// Largest number of rows in a series without a plan; a plan may have as many.
const MOST_UNPLANNED_ROWS: usize = 1_000_000;

/// A checked time series of one compression.
#[derive(Debug, Clone)]
pub struct Series {
    columns: &'static [Column<Sample>],
    samples: Vec<Sample>,
    absent: Vec<&'static str>,
}

impl PartialEq for Series {
    /// Compares the reported values only.
    fn eq(&self, other: &Self) -> bool {
        let numbers = |series: &Self| -> Vec<f64> {
            let rows = series.samples.iter();
            rows.flat_map(|row| series.present().map(|column| (column.value)(row)))
                .collect()
        };
        self.absent == other.absent && numbers(self) == numbers(other)
    }
}

impl Series {
    /// Names of the columns of a stack of cylinders, in order.
    pub const COLUMNS: [&'static str; 16] = Sample::NAMES;

    /// A series of `samples`, which must be finite and lie exactly at the steps of `case`.
    pub fn new(samples: Vec<Sample>, case: &Case) -> Result<Self, SeriesError> {
        Self::without(Vec::new(), samples, case)
    }

    /// A series without the columns named `absent`, which are not checked.
    pub fn without(
        absent: Vec<&'static str>,
        samples: Vec<Sample>,
        case: &Case,
    ) -> Result<Self, SeriesError> {
        let columns = Sample::columns(case.stack.bodies);
        let schedule = case.protocol.schedule();
        let mut planned = schedule.sampled_steps();
        for (row, sample) in (1..).zip(&samples) {
            check_finite(row, &samples, columns, &absent)?;
            let Some(expected) = planned.next() else {
                break;
            };
            if sample.step != expected {
                return Err(SeriesError::WrongStep {
                    row,
                    found: sample.step,
                    expected,
                });
            }
            check_time(row, sample, case.protocol.time_step)?;
        }
        let (found, expected) = (samples.len(), planned_rows(&schedule));
        if found > expected || (found < expected && !ends_with_the_drop(&samples, &schedule)) {
            return Err(SeriesError::Truncated { found, expected });
        }
        Ok(Self {
            columns,
            samples,
            absent,
        })
    }

    /// Names of the columns that the code does not report.
    pub fn absent(&self) -> &[&'static str] {
        &self.absent
    }

    /// The columns that the code reports, in order.
    pub fn present(&self) -> impl Iterator<Item = &'static Column<Sample>> + '_ {
        let columns = self.columns.iter();
        columns.filter(|column| !self.absent.contains(&column.name))
    }

    /// Parses the shared CSV format and checks it against the plan. Columns may be in any order, and other columns are
    /// ignored.
    pub fn read(input: impl Read, case: &Case) -> Result<Self, SeriesError> {
        Self::read_from(input, &ColumnSources::new(), case)
    }

    /// Parses a CSV some of whose columns `sources` rename.
    pub fn read_from(
        input: impl Read,
        sources: &ColumnSources,
        case: &Case,
    ) -> Result<Self, SeriesError> {
        // One extra row is enough to refuse the series.
        let limit = planned_rows(&case.protocol.schedule()).saturating_add(1);
        let columns = Sample::columns(case.stack.bodies);
        let (samples, absent) = csv_rows(input, columns, sources, limit)?;
        Self::without(absent, samples, case)
    }

    /// Parses a series without a plan, for this many bodies on the floor, and returns it with its time step. Numbers
    /// must be finite, steps must rise, and times must be multiples of one time step.
    pub fn read_unplanned(input: impl Read, bodies: u8) -> Result<(Self, f64), SeriesError> {
        let columns = Sample::columns(bodies);
        let (samples, absent) =
            csv_rows(input, columns, &ColumnSources::new(), MOST_UNPLANNED_ROWS)?;
        let last = samples.last().filter(|last| last.step > 0);
        let last = last.ok_or_else(|| SeriesError::absent("it has no row after step 0"))?;
        let time_step = last.time / last.step as f64;
        if time_step <= 0.0 || time_step.is_nan() {
            let message = format!("`time` is {}, but must rise from 0", last.time);
            return Err(SeriesError::garbled(samples.len(), message));
        }
        let mut before = None;
        for (row, sample) in (1..).zip(&samples) {
            check_finite(row, &samples, columns, &absent)?;
            if before.is_some_and(|before| sample.step <= before) {
                let message = format!("step {} does not come after the one before", sample.step);
                return Err(SeriesError::garbled(row, message));
            }
            before = Some(sample.step);
            check_time(row, sample, time_step)?;
        }
        let series = Self {
            columns,
            samples,
            absent,
        };
        Ok((series, time_step))
    }

    /// Returns the series in the shared CSV format, with every number in its shortest exact form.
    pub fn to_csv(&self) -> Vec<u8> {
        const WRITTEN: &str = "numbers are written to memory";
        let mut writer = csv::Writer::from_writer(Vec::new());
        let names = self.present().map(|column| column.name);
        writer.write_record(names).expect(WRITTEN);
        for sample in &self.samples {
            let numbers = self.present().skip(1).map(|column| (column.value)(sample));
            let numbers: Vec<f64> = numbers.collect();
            writer.serialize((sample.step, numbers)).expect(WRITTEN);
        }
        writer.into_inner().expect("memory is flushed")
    }

    /// The rows, in order of time.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }
}

/// Checks that the numbers of a row, counted from 1, are finite, but for columns that are `absent`.
fn check_finite(
    row: usize,
    samples: &[Sample],
    columns: &[Column<Sample>],
    absent: &[&str],
) -> Result<(), SeriesError> {
    let present = columns
        .iter()
        .filter(|column| !absent.contains(&column.name));
    let is_finite = |column: &&Column<Sample>| (column.value)(&samples[row - 1]).is_finite();
    if present.clone().all(|column| is_finite(&column)) {
        return Ok(());
    }
    let present: Vec<&Column<Sample>> = present.collect();
    match NotFinite::find(&samples[..row], &present, |sample| sample.step) {
        Some(found) => Err(found.into()),
        None => Ok(()),
    }
}

/// Checks the time of a row. Codes may sum the time step instead of multiplying it, which rounds differently.
fn check_time(row: usize, sample: &Sample, time_step: f64) -> Result<(), SeriesError> {
    let expected = sample.step as f64 * time_step;
    if (sample.time - expected).abs() <= 1e-9 * expected {
        return Ok(());
    }
    Err(SeriesError::WrongTime {
        row,
        step: sample.step,
        found: sample.time,
        expected,
    })
}
