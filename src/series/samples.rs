//! The time series that every code delivers.

use super::drop::DropWatch;
use crate::model::Schedule;
use serde::{Deserialize, Serialize};
use std::io::Read;
use thiserror::Error;

/// One row of a time series. Lengths in r, angles in radians, forces in k_n r, time in √(m/k_n).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    /// Steps since the wall began to move.
    pub step: u64,
    /// Time since the wall began to move.
    pub time: f64,
    /// Force of the top wall on cylinder 1, positive in compression.
    pub wall_force: f64,
    /// Horizontal position of cylinder 1 (top).
    pub x1: f64,
    /// Height of its centre above the floor.
    pub y1: f64,
    /// Its rotation, counter-clockwise.
    pub theta1: f64,
    /// Horizontal position of cylinder 2 (right).
    pub x2: f64,
    /// Height of its centre above the floor.
    pub y2: f64,
    /// Its rotation, counter-clockwise.
    pub theta2: f64,
    /// Horizontal position of cylinder 3 (left).
    pub x3: f64,
    /// Height of its centre above the floor.
    pub y3: f64,
    /// Its rotation, counter-clockwise.
    pub theta3: f64,
    /// Normal force of the floor on cylinder 2.
    pub floor_n2: f64,
    /// Tangential force of the floor on cylinder 2, along +x.
    pub floor_t2: f64,
    /// Normal force of the floor on cylinder 3.
    pub floor_n3: f64,
    /// Tangential force of the floor on cylinder 3, along +x.
    pub floor_t3: f64,
}

impl Sample {
    /// c, elastic part of the normal force between cylinders 2 and 3, in k_n r: their overlap 2 − |r₂ − r₃|
    /// times k_n = 1, and 0 where they do not touch. At rest it is the whole force.
    pub fn bottom_contact_force(&self) -> f64 {
        let (dx, dy) = (self.x2 - self.x3, self.y2 - self.y3);
        (2.0 - (dx * dx + dy * dy).sqrt()).max(0.0)
    }

    /// Whether every value is a finite number.
    pub fn is_finite(&self) -> bool {
        self.values().into_iter().all(f64::is_finite)
    }

    fn values(&self) -> [f64; 15] {
        [
            self.time,
            self.wall_force,
            self.x1,
            self.y1,
            self.theta1,
            self.x2,
            self.y2,
            self.theta2,
            self.x3,
            self.y3,
            self.theta3,
            self.floor_n2,
            self.floor_t2,
            self.floor_n3,
            self.floor_t3,
        ]
    }
}

/// Names of the columns of `series.csv`, in order.
pub const COLUMNS: [&str; 16] = [
    "step",
    "time",
    "wall_force",
    "x1",
    "y1",
    "theta1",
    "x2",
    "y2",
    "theta2",
    "x3",
    "y3",
    "theta3",
    "floor_n2",
    "floor_t2",
    "floor_n3",
    "floor_t3",
];

/// Why a series is not the one that was asked for.
#[derive(Debug, Error)]
pub enum SeriesError {
    /// There is no series at all.
    #[error("{message}")]
    Absent {
        /// The file or table that is missing, and what was found instead.
        message: String,
    },
    /// A row cannot be read.
    #[error("row {row}: {message}")]
    Garbled {
        /// Row, the first one after the header being 1.
        row: usize,
        /// The defect.
        message: String,
    },
    /// The columns are not the shared ones.
    #[error("the columns are `{found}`, but must be `{}`", COLUMNS.join(","))]
    Columns {
        /// The header as found.
        found: String,
    },
    /// A value is not a finite number.
    #[error("row {row} (step {step}): `{column}` is {value}, but must be a finite number")]
    NotFinite {
        /// Row, the first one after the header being 1.
        row: usize,
        /// Its step.
        step: u64,
        /// Name of the column.
        column: &'static str,
        /// The value.
        value: f64,
    },
    /// A row is at the wrong step.
    #[error("row {row} is at step {found}, but must be at step {expected}")]
    WrongStep {
        /// Row, the first one after the header being 1.
        row: usize,
        /// The step found.
        found: u64,
        /// The step planned.
        expected: u64,
    },
    /// A row is at the wrong time.
    #[error("row {row} (step {step}) is at time {found}, but must be at {expected}")]
    WrongTime {
        /// Row, the first one after the header being 1.
        row: usize,
        /// Its step.
        step: u64,
        /// The time found.
        found: f64,
        /// step × time step.
        expected: f64,
    },
    /// The series ends early, or has rows beyond its end.
    #[error("the series has {found} rows{}, but must have {expected}", or_more(*found, *expected))]
    Truncated {
        /// Rows found; of those beyond the end one at least.
        found: usize,
        /// Rows planned.
        expected: usize,
    },
}

fn planned_rows(schedule: &Schedule) -> usize {
    usize::try_from(schedule.rows()).unwrap_or(usize::MAX)
}

/// Rows beyond the end are not all counted.
fn or_more(found: usize, expected: usize) -> &'static str {
    if found > expected { " or more" } else { "" }
}

/// Whether the last row, and none before, is the one that ends the run.
fn ends_with_the_drop(samples: &[Sample], schedule: &Schedule) -> bool {
    let mut watch = DropWatch::new(schedule.stop_at_drop);
    let mut fine = samples
        .iter()
        .filter(|row| row.step >= schedule.fine_from_step);
    let ends = fine.position(|row| watch.has_dropped(row.wall_force));
    ends.is_some() && fine.next().is_none()
}

/// A checked time series of one compression.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    samples: Vec<Sample>,
}

impl Series {
    /// A series of `samples`, which must be finite and lie exactly at the steps of `schedule`.
    pub fn new(
        samples: Vec<Sample>,
        schedule: &Schedule,
        time_step: f64,
    ) -> Result<Self, SeriesError> {
        let mut planned = schedule.sampled_steps();
        for (row, sample) in (1..).zip(&samples) {
            check_finite(row, sample)?;
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
            check_time(row, sample, time_step)?;
        }
        let (found, expected) = (samples.len(), planned_rows(schedule));
        if found > expected || (found < expected && !ends_with_the_drop(&samples, schedule)) {
            return Err(SeriesError::Truncated { found, expected });
        }
        Ok(Self { samples })
    }

    /// Reads the shared CSV format and checks it against the plan.
    pub fn read(
        input: impl Read,
        schedule: &Schedule,
        time_step: f64,
    ) -> Result<Self, SeriesError> {
        let mut reader = csv::Reader::from_reader(input);
        let garbled = |row: usize, error: csv::Error| SeriesError::Garbled {
            row,
            message: error.to_string(),
        };
        let header = reader.headers().map_err(|error| garbled(0, error))?;
        if !header.iter().eq(COLUMNS) {
            return Err(SeriesError::Columns {
                found: header.iter().collect::<Vec<_>>().join(","),
            });
        }
        let rows = (1..).zip(reader.deserialize());
        let rows = rows.map(|(index, row)| row.map_err(|error| garbled(index, error)));
        // One row too many is refused; what comes after it need not be kept for that.
        let rows = rows.take(planned_rows(schedule).saturating_add(1));
        Self::new(rows.collect::<Result<_, _>>()?, schedule, time_step)
    }

    /// The series in the shared CSV format, every number in its shortest exact form.
    pub fn to_csv(&self) -> Vec<u8> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for sample in &self.samples {
            writer
                .serialize(sample)
                .expect("rows of numbers are written to memory");
        }
        writer.into_inner().expect("memory is flushed")
    }

    /// The rows, in order of time.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }
}

fn check_finite(row: usize, sample: &Sample) -> Result<(), SeriesError> {
    let values = sample.values();
    let offending = values.iter().position(|value| !value.is_finite());
    offending.map_or(Ok(()), |index| {
        Err(SeriesError::NotFinite {
            row,
            step: sample.step,
            column: COLUMNS[index + 1],
            value: values[index],
        })
    })
}

/// Codes may sum the time step instead of multiplying it, which rounds differently.
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
