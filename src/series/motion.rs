//! Result of a micro-test: the motion of two cylinders and the forces on them, step by step.

use super::SeriesError;
use super::column::columns;
use super::digits::most_digits;
use super::header::{ColumnSources, csv_rows};
use serde::{Deserialize, Serialize};
use std::io::Read;

columns! {
    /// One step. Lengths in r, forces in k_n r, torques in k_n r², speeds in r √(k_n/m).
    MotionRow of Motion, 18:
    step: u64, "1", "steps since the beginning";
    x1: f64, "r", "horizontal position of cylinder 1";
    y1: f64, "r", "height of its centre above the floor";
    vx1: f64, "r √(k_n/m)", "its horizontal velocity, at the moment at which the code keeps it";
    vy1: f64, "r √(k_n/m)", "its vertical velocity, at the same moment";
    spin1: f64, "√(k_n/m)", "its angular velocity, counter-clockwise, at the same moment";
    fx1: f64, "k_n r", "horizontal force on it";
    fy1: f64, "k_n r", "vertical force on it";
    torque1: f64, "k_n r²", "torque on it about its centre, counter-clockwise";
    x2: f64, "r", "horizontal position of cylinder 2";
    y2: f64, "r", "height of its centre above the floor";
    vx2: f64, "r √(k_n/m)", "its horizontal velocity, at the moment at which the code keeps it";
    vy2: f64, "r √(k_n/m)", "its vertical velocity, at the same moment";
    spin2: f64, "√(k_n/m)", "its angular velocity, counter-clockwise, at the same moment";
    fx2: f64, "k_n r", "horizontal force on it";
    fy2: f64, "k_n r", "vertical force on it";
    torque2: f64, "k_n r²", "torque on it about its centre, counter-clockwise";
    wall_force: f64, "k_n r", "force of the top wall, positive in compression";
}

/// A cylinder at one step, as the code reports it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyRow {
    /// Centre.
    pub position: [f64; 2],
    /// Velocity, at whichever moment the code keeps it.
    pub velocity: [f64; 2],
    /// Angular velocity, counter-clockwise.
    pub spin: f64,
    /// Total force.
    pub force: [f64; 2],
    /// Total torque about the centre.
    pub torque: f64,
}

impl MotionRow {
    /// Cylinders 1 and 2.
    pub fn bodies(&self) -> [BodyRow; 2] {
        [
            BodyRow {
                position: [self.x1, self.y1],
                velocity: [self.vx1, self.vy1],
                spin: self.spin1,
                force: [self.fx1, self.fy1],
                torque: self.torque1,
            },
            BodyRow {
                position: [self.x2, self.y2],
                velocity: [self.vx2, self.vy2],
                spin: self.spin2,
                force: [self.fx2, self.fy2],
                torque: self.torque2,
            },
        ]
    }
}

/// One for every step and one for the beginning.
fn planned_rows(steps: u64) -> usize {
    usize::try_from(steps)
        .unwrap_or(usize::MAX)
        .saturating_add(1)
}

/// A checked motion: one row for every step, finite numbers only.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Motion {
    rows: Vec<MotionRow>,
}

impl Motion {
    /// A motion of `rows`, which must be those of the steps 0 to `steps`.
    ///
    /// # Errors
    /// If a row is missing, out of place, or not finite.
    pub fn new(rows: Vec<MotionRow>, steps: u64) -> Result<Self, SeriesError> {
        for (index, row) in rows.iter().enumerate() {
            if row.step != index as u64 {
                return Err(SeriesError::WrongStep {
                    row: index + 1,
                    found: row.step,
                    expected: index as u64,
                });
            }
            if !row.is_finite() {
                let message = "not every value is a finite number";
                return Err(SeriesError::garbled(index + 1, message));
            }
        }
        let (found, expected) = (rows.len(), planned_rows(steps));
        if found != expected {
            return Err(SeriesError::Truncated { found, expected });
        }
        Ok(Self { rows })
    }

    /// Reads a motion in CSV and checks it. Columns may be in any order, and further ones are ignored.
    pub fn read(input: impl Read, steps: u64) -> Result<Self, SeriesError> {
        Self::read_from(input, &ColumnSources::new(), steps)
    }

    /// The same of a CSV in which some columns are others.
    pub fn read_from(
        input: impl Read,
        sources: &ColumnSources,
        steps: u64,
    ) -> Result<Self, SeriesError> {
        // One row too many is enough to refuse the motion.
        let limit = planned_rows(steps).saturating_add(1);
        let (rows, _) = csv_rows(input, sources, limit)?;
        Self::new(rows, steps)
    }

    /// The most significant digits with which a number is printed; 17 are all.
    pub(crate) fn most_digits(&self) -> u32 {
        let columns = MotionRow::COLUMNS.iter();
        let rows = self.rows.iter();
        most_digits(rows.flat_map(|row| columns.clone().map(move |column| (column.value)(row))))
    }

    /// The rows, step by step.
    pub fn rows(&self) -> &[MotionRow] {
        &self.rows
    }
}
