//! The result of a micro-test: the motion of two cylinders or spheres and the forces on them, step by step.

use super::column::{Column, Number, columns};
use super::digits::most_digits;
use super::header::{ColumnSources, csv_rows};
use super::{NotFinite, SeriesError};
use serde::{Deserialize, Serialize};
use std::io::Read;

columns! {
    /// One step. Lengths in r, forces in k_n r, torques in k_n r², speeds in r √(k_n/m).
    MotionRow of Motion, 18, and
    /// Further values of the bodies in space.
    #[serde(default, skip_serializing_if = "is_in_the_plane")]
    space: [RowInSpace; 2]:
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

/// The values of a body in space beyond those in the plane.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RowInSpace {
    /// Position along z.
    pub z: f64,
    /// Velocity along z.
    pub vz: f64,
    /// Force along z.
    pub fz: f64,
    /// Angular velocity about x and y.
    pub spin: [f64; 2],
    /// Torque about x and y.
    pub torque: [f64; 2],
}

fn is_in_the_plane(space: &[RowInSpace; 2]) -> bool {
    *space == [RowInSpace::default(); 2]
}

macro_rules! number {
    ($name:expr, $unit:literal, $meaning:expr, $($field:tt)*) => {
        Column {
            name: $name,
            unit: $unit,
            meaning: $meaning,
            is_optional: false,
            value: |row: &MotionRow| row.$($field)* as f64,
            set: |row: &mut MotionRow, value| {
                Number::of(value).map(|number| row.$($field)* = number).is_some()
            },
        }
    };
}

macro_rules! in_space {
    ($($number:literal at $index:literal: $x:ident $y:ident $vx:ident $vy:ident $spin:ident $fx:ident $fy:ident $torque:ident),*) => {
        /// The columns of a micro-test of spheres.
        static IN_SPACE: [Column<MotionRow>; 32] = [
            number!("step", "1", "steps since the beginning", step),
            $(
                number!(concat!("x", $number), "r", concat!("horizontal position of sphere ", $number), $x),
                number!(concat!("y", $number), "r", "height of its centre above the floor", $y),
                number!(concat!("z", $number), "r", "its other horizontal position; x, y, z are right-handed", space[$index].z),
                number!(concat!("vx", $number), "r √(k_n/m)", "its velocity along x, at the moment at which the code keeps it", $vx),
                number!(concat!("vy", $number), "r √(k_n/m)", "the same along y", $vy),
                number!(concat!("vz", $number), "r √(k_n/m)", "the same along z", space[$index].vz),
                number!(concat!("spinx", $number), "√(k_n/m)", "its angular velocity about x, at the same moment", space[$index].spin[0]),
                number!(concat!("spiny", $number), "√(k_n/m)", "the same about y", space[$index].spin[1]),
                number!(concat!("spinz", $number), "√(k_n/m)", "the same about z", $spin),
                number!(concat!("fx", $number), "k_n r", "force on it along x", $fx),
                number!(concat!("fy", $number), "k_n r", "the same along y", $fy),
                number!(concat!("fz", $number), "k_n r", "the same along z", space[$index].fz),
                number!(concat!("torquex", $number), "k_n r²", "torque on it about its centre, about x", space[$index].torque[0]),
                number!(concat!("torquey", $number), "k_n r²", "the same about y", space[$index].torque[1]),
                number!(concat!("torquez", $number), "k_n r²", "the same about z", $torque),
            )*
            number!("wall_force", "k_n r", "force of the top wall, positive in compression", wall_force),
        ];
    };
}

in_space!(
    1 at 0: x1 y1 vx1 vy1 spin1 fx1 fy1 torque1,
    2 at 1: x2 y2 vx2 vy2 spin2 fx2 fy2 torque2
);

impl MotionRow {
    /// The columns of a micro-test, of spheres if it is `in_space`, of cylinders otherwise.
    pub fn columns(in_space: bool) -> &'static [Column<Self>] {
        match in_space {
            true => &IN_SPACE,
            false => &Self::COLUMNS,
        }
    }
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

/// Number of rows: one for every step and one for the start.
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
    /// A motion with these `rows`, which must be those of the steps 0 to `steps`.
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
                let columns: Vec<&Column<MotionRow>> = MotionRow::COLUMNS.iter().collect();
                let found = NotFinite::find(&rows[..=index], &columns, |row| row.step);
                return Err(found.map_or_else(
                    || SeriesError::garbled(index + 1, "not every value is a finite number"),
                    SeriesError::from,
                ));
            }
        }
        let (found, expected) = (rows.len(), planned_rows(steps));
        if found != expected {
            return Err(SeriesError::Truncated { found, expected });
        }
        Ok(Self { rows })
    }

    /// Parses a motion from CSV and checks it. Columns may be in any order, and other columns are ignored.
    pub fn read(input: impl Read, steps: u64) -> Result<Self, SeriesError> {
        Self::read_from(input, &MotionRow::COLUMNS, &ColumnSources::new(), steps)
    }

    /// Parses a motion from CSV with these `columns`, some of which `sources` may rename.
    pub fn read_from(
        input: impl Read,
        columns: &'static [Column<MotionRow>],
        sources: &ColumnSources,
        steps: u64,
    ) -> Result<Self, SeriesError> {
        // One extra row is enough to refuse the motion.
        let limit = planned_rows(steps).saturating_add(1);
        let (rows, _) = csv_rows(input, columns, sources, limit)?;
        Self::new(rows, steps)
    }

    /// Returns the motion in the format of codes, in the plane or in space, with every number in its shortest exact
    /// form.
    pub fn to_csv(&self) -> Vec<u8> {
        const WRITTEN: &str = "numbers are written to memory";
        let moves_in_space = |row: &MotionRow| !is_in_the_plane(&row.space);
        let columns = MotionRow::columns(self.rows.iter().any(moves_in_space));
        let mut writer = csv::Writer::from_writer(Vec::new());
        let names = columns.iter().map(|column| column.name);
        writer.write_record(names).expect(WRITTEN);
        for row in &self.rows {
            let numbers = columns.iter().skip(1).map(|column| (column.value)(row));
            let numbers: Vec<f64> = numbers.collect();
            writer.serialize((row.step, numbers)).expect(WRITTEN);
        }
        writer.into_inner().expect("memory is flushed")
    }

    /// Returns the largest number of significant digits with which a number is printed, at most 17.
    pub fn most_digits(&self) -> u32 {
        let columns = MotionRow::COLUMNS.iter();
        let rows = self.rows.iter();
        most_digits(rows.flat_map(|row| columns.clone().map(move |column| (column.value)(row))))
    }

    /// The rows, in order of the steps.
    pub fn rows(&self) -> &[MotionRow] {
        &self.rows
    }
}
