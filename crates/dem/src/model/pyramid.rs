//! A pyramid: many cylinders in rows, each row one cylinder shorter than the one below.

use super::protocol::smooth_step;
use super::{ContactConvention, Stack};
use super::{InvalidValue, positive, within};
use serde::{Deserialize, Serialize};

/// Largest number of rows, which is about half a million cylinders.
const MOST_ROWS: u32 = 1000;

/// Largest number of steps in each of the three phases.
const MOST_STEPS: f64 = 1e11;

/// Upper limit of the spacing: from 2√3 on, cylinders touch those two rows below.
const WIDEST_SPACING: f64 = 3.0;

/// A pyramid of equal cylinders on a rough floor. Its lowest row stands between two frictionless side walls, and
/// gravity rises smoothly from zero.
///
/// The side walls keep the outer cylinders from rolling away: without them, a pyramid with the paper's friction stands
/// only up to four rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pyramid {
    /// Number of rows, which is also the number of cylinders in the lowest one.
    pub rows: u32,
    /// Distance between the centres of neighbours in a row, in r; at least 2, where they just touch.
    pub spacing: f64,
    /// Friction, stiffness and stiffness ratio.
    pub groups: Stack,
    /// Contact law.
    pub convention: ContactConvention,
    /// Time step in √(m/k_n).
    pub time_step: f64,
    /// Steps in which gravity rises to its value.
    pub ramp_steps: u64,
    /// Steps at rest after that.
    pub rest_steps: u64,
    /// Steps after that, whose run time is measured.
    pub timed_steps: u64,
}

impl Pyramid {
    /// A pyramid of touching cylinders with the paper's stiffness ratio and the paper's friction between cylinders.
    /// Gravity rises within a few periods of the slowest oscillation, which lasts some three time units per row.
    pub fn touching(rows: u32, stiffness: f64, convention: ContactConvention) -> Self {
        Self {
            rows,
            spacing: 2.0,
            groups: Stack::paper(0.5, stiffness),
            convention,
            time_step: 0.1,
            ramp_steps: 200 * u64::from(rows),
            rest_steps: 0,
            timed_steps: 1000,
        }
    }

    /// Number of cylinders, n(n + 1)/2.
    pub fn cylinder_count(&self) -> usize {
        let rows = self.rows as usize;
        rows * (rows + 1) / 2
    }

    /// Total number of time steps.
    pub fn total_steps(&self) -> u64 {
        self.ramp_steps + self.rest_steps + self.timed_steps
    }

    /// Centres of the cylinders before gravity acts, in r: row by row upwards, from left to right. Each
    /// cylinder just touches the two below it, and the lowest row the floor y = 0.
    pub fn centres(&self) -> Vec<[f64; 2]> {
        let half = 0.5 * self.spacing;
        let row_height = (4.0 - half * half).sqrt();
        let row = |row: u32| {
            let others = self.rows - row - 1;
            let height = 1.0 + f64::from(row) * row_height;
            (0..=others).map(move |place| {
                // Exactly symmetric about x = 0.
                [half * (2.0 * f64::from(place) - f64::from(others)), height]
            })
        };
        (0..self.rows).flat_map(row).collect()
    }

    /// Distance of each side wall from the middle, in r; the lowest row just touches the walls.
    pub fn half_width(&self) -> f64 {
        1.0 + 0.5 * self.spacing * f64::from(self.rows - 1)
    }

    /// Gravity at a step, in k_n r/m.
    pub fn gravity_at(&self, step: u64) -> f64 {
        self.groups.epsilon() * smooth_step(step, self.ramp_steps)
    }

    /// The longest time step of a stable integration, in √(m/k_n). A cylinder has at most six contacts; with
    /// a sixth of its mass and moment of inertia I in each, the normal spring oscillates with ω² = 12 k/m and the
    /// tangential one with 12 (1 + 1/I)/κ k/m at a stiffness k, and no mode of the whole is faster.
    pub fn longest_time_step(&self) -> f64 {
        const SAFETY: f64 = 0.6;
        let turning = 1.0 + self.convention.moment_of_inertia.recip();
        let ratio = self.groups.stiffness_ratio;
        let stiffness = self.convention.highest_stiffness(ratio);
        let fastest = (stiffness * (12.0 * f64::max(1.0, turning / ratio))).sqrt();
        SAFETY * 2.0 / fastest
    }

    /// Checks every value; the error names the first that is out of range.
    ///
    /// # Errors
    /// It names the key, the value and what is accepted.
    pub fn validate(&self) -> Result<(), InvalidValue> {
        let rows = f64::from(self.rows);
        within("pyramid.rows", rows, 1.0, f64::from(MOST_ROWS))?;
        within("pyramid.spacing", self.spacing, 2.0, WIDEST_SPACING)?;
        self.groups.validate()?;
        self.convention.validate()?;
        self.validate_law()?;
        positive(
            "pyramid.time_step",
            self.time_step,
            self.longest_time_step(),
        )?;
        for (name, steps, fewest) in [
            ("ramp_steps", self.ramp_steps, 1.0),
            ("rest_steps", self.rest_steps, 0.0),
            ("timed_steps", self.timed_steps, 1.0),
        ] {
            within(&format!("pyramid.{name}"), steps as f64, fewest, MOST_STEPS)?;
        }
        Ok(())
    }
}

impl Pyramid {
    /// Refuses laws that are not linear, which a packing does not support.
    fn validate_law(&self) -> Result<(), InvalidValue> {
        let law = self.convention.law;
        if law.is_linear() {
            return Ok(());
        }
        Err(InvalidValue {
            key: "pyramid.convention.law".to_owned(),
            value: law.to_string(),
            accepted: "linear springs, on walls as stiff as pairs".to_owned(),
        })
    }
}

impl std::fmt::Display for Pyramid {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (rows, count) = (self.rows, self.cylinder_count());
        write!(formatter, "a pyramid of {rows} rows, {count} cylinders")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pyramid(rows: u32, spacing: f64) -> Pyramid {
        Pyramid {
            spacing,
            ..Pyramid::touching(rows, 1e4, ContactConvention::TURNING)
        }
    }

    #[test]
    fn every_cylinder_just_touches_the_two_below_it() {
        for spacing in [2.0, 2.5] {
            let rows = 5;
            let centres = pyramid(rows, spacing).centres();
            assert_eq!(centres.len(), 15);
            let mut below = 0;
            for row in 1..rows as usize {
                let width = rows as usize - row + 1;
                for place in 0..width - 1 {
                    let [x, y] = centres[below + width + place];
                    for [other_x, other_y] in &centres[below + place..=below + place + 1] {
                        assert!((f64::hypot(x - other_x, y - other_y) - 2.0).abs() < 1e-14);
                    }
                }
                below += width;
            }
        }
    }

    #[test]
    fn it_is_symmetric_and_fills_the_space_between_the_walls() {
        let pyramid = pyramid(4, 2.25);
        let centres = pyramid.centres();
        let lowest: Vec<f64> = centres[..4].iter().map(|centre| centre[0]).collect();
        let mirrored: Vec<f64> = lowest.iter().rev().map(|x| -x).collect();
        assert_eq!(lowest, mirrored);
        assert_eq!(lowest[3] + 1.0, pyramid.half_width());
    }

    #[test]
    fn gravity_rises_to_its_value() {
        let pyramid = pyramid(3, 2.0);
        assert_eq!(pyramid.gravity_at(0), 0.0);
        assert_eq!(pyramid.gravity_at(pyramid.ramp_steps / 2), 0.5e-4);
        assert_eq!(pyramid.gravity_at(pyramid.ramp_steps), 1e-4);
    }

    #[test]
    fn what_is_no_pyramid_is_refused() {
        assert!(pyramid(3, 2.0).validate().is_ok());
        for (rows, spacing) in [(0, 2.0), (1001, 2.0), (3, 1.9), (3, f64::NAN)] {
            assert!(pyramid(rows, spacing).validate().is_err());
        }
        let hasty = Pyramid {
            time_step: 0.4,
            ..pyramid(3, 2.0)
        };
        let error = hasty.validate().unwrap_err();
        assert!(error.to_string().starts_with("`pyramid.time_step` is 0.4"));
        let abrupt = Pyramid {
            ramp_steps: 0,
            ..pyramid(3, 2.0)
        };
        assert!(abrupt.validate().is_err());
    }
}
