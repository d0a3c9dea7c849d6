//! The distance between two series, branch by branch.

use crate::model::{PAPER_BODIES, Stack};
use crate::series::Sample;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Thresholds, in the unit of the quantity; the time when a deviation first exceeds each of them is reported.
pub(crate) const DEVIATIONS: [f64; 3] = [1e-6, 1e-4, 1e-2];

/// A quantity that is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// f(t), in units of its peak.
    WallForce,
    /// x₂(t), in r.
    X2,
    /// y₁(t), in r.
    Y1,
    /// θ₂(t), in radians.
    Theta2,
    /// Every coordinate of every centre, in r.
    Centres,
    /// Every component of every rotation, in radians.
    Rotations,
    /// Every component of the force of the floor on every sphere, in units of the peak of the wall force.
    FloorForces,
}

impl Quantity {
    /// The quantities compared for three cylinders.
    pub const OF_CYLINDERS: [Self; 4] = [Self::WallForce, Self::X2, Self::Y1, Self::Theta2];

    /// The quantities compared for spheres, whose motion no symmetry restricts.
    const OF_SPHERES: [Self; 4] = [
        Self::WallForce,
        Self::Centres,
        Self::Rotations,
        Self::FloorForces,
    ];

    /// The quantities compared for `stack`.
    pub fn of_stack(stack: &Stack) -> &'static [Self] {
        match stack.bodies {
            PAPER_BODIES => &Self::OF_CYLINDERS,
            _ => &Self::OF_SPHERES,
        }
    }

    /// The name in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::WallForce => "wall_force",
            Self::X2 => "x2",
            Self::Y1 => "y1",
            Self::Theta2 => "theta2",
            Self::Centres => "centres",
            Self::Rotations => "rotations",
            Self::FloorForces => "floor_forces",
        }
    }

    /// Whether it is a force, in k_n r.
    pub fn is_force(self) -> bool {
        matches!(self, Self::WallForce | Self::FloorForces)
    }

    /// Its values in a row.
    pub fn of(self, sample: &Sample) -> Vec<f64> {
        let bodies = sample.bodies.iter();
        match self {
            Self::WallForce => vec![sample.wall_force],
            Self::X2 => vec![sample.bodies[1].position[0]],
            Self::Y1 => vec![sample.bodies[0].position[1]],
            Self::Theta2 => vec![sample.bodies[1].rotation[2]],
            Self::Centres => bodies.flat_map(|body| body.position).collect(),
            Self::Rotations => bodies.flat_map(|body| body.rotation).collect(),
            Self::FloorForces => sample.floor.as_flattened().to_vec(),
        }
    }

    /// The largest distance between its values in two rows.
    fn distance(self, left: &Sample, right: &Sample) -> f64 {
        let (left, right) = (self.of(left), self.of(right));
        let pairs = left.iter().zip(&right);
        pairs
            .map(|(left, right)| (left - right).abs())
            .fold(0.0, f64::max)
    }
}

/// A part of a compression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Branch {
    /// From the row after the first to the peak of the wall force. Row 0, where the wall just touches, is
    /// left out: codes disagree on whether a contact of zero overlap exists.
    Compression,
    /// From the peak until the wall has lost cylinder 1.
    Collapse,
    /// From the loss of the wall contact until cylinder 1 has landed on the floor. The wall force is zero.
    Fall,
}

impl Branch {
    /// All of them, in order of time.
    pub const ALL: [Self; 3] = [Self::Compression, Self::Collapse, Self::Fall];

    /// The branches that are compared, in order of time. For spheres it is the compression alone: after its yield,
    /// the rounding in each code decides how the symmetric ring breaks.
    pub fn of_stack(stack: &Stack) -> &'static [Self] {
        match stack.bodies {
            PAPER_BODIES => &Self::ALL,
            _ => &Self::ALL[..1],
        }
    }

    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Compression => "compression",
            Self::Collapse => "collapse",
            Self::Fall => "fall",
        }
    }

    /// The quantities that are compared on this branch.
    pub fn quantities(self, stack: &Stack) -> &'static [Quantity] {
        match self {
            Self::Compression | Self::Collapse => Quantity::of_stack(stack),
            Self::Fall => &[Quantity::X2, Quantity::Y1, Quantity::Theta2],
        }
    }
}

/// The rows of a series at which its branches end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Milestones {
    /// The row with the highest wall force.
    pub peak: usize,
    /// The first row without a wall force after the peak, and the first row after that in which cylinder 1 touches
    /// the floor; `None` where only the compression is compared.
    pub later: Option<[usize; 2]>,
}

impl Milestones {
    /// Reads them off a series; `None` if one of them is missing, or the peak is at either end.
    pub fn read(samples: &[Sample], stack: &Stack) -> Option<Self> {
        let force = |row: usize| samples[row].wall_force;
        let peak = (0..samples.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)))?;
        let after = |row: usize, happens: fn(&Sample) -> bool| {
            let later = samples[row..].iter().position(happens)?;
            Some(row + later)
        };
        let later = match Branch::of_stack(stack) {
            [Branch::Compression] => None,
            _ => {
                let lost = after(peak, |sample| sample.wall_force <= 0.0)?;
                let landed = after(lost, |sample| sample.bodies[0].position[1] < 1.0)?;
                Some([lost, landed])
            }
        };
        (peak > 1 && peak + 1 < samples.len()).then_some(Self { peak, later })
    }

    /// The rows of a branch.
    pub fn rows(&self, branch: Branch) -> Range<usize> {
        let compressed = self.peak + 1;
        let [lost, landed] = self.later.unwrap_or([compressed; 2]);
        match branch {
            Branch::Compression => 1..compressed,
            Branch::Collapse => compressed..lost,
            Branch::Fall => lost..landed,
        }
    }
}

/// The distance between two series of the same time step in one quantity on one branch, in the unit of the
/// quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// Time step of both.
    pub time_step: f64,
    /// Largest distance between rows at the same time.
    pub largest: f64,
    /// Root of the mean square over the rows.
    pub rms: f64,
    /// Time of the first row that deviates by more than each of `DEVIATIONS`; `None` if no row does.
    pub first_above: [Option<f64>; 3],
    /// The part of the largest distance that may be rounding, or the uncertainty of measured arms.
    pub round_off: f64,
}

impl Distance {
    /// The distance between rows of two series; rows of the same index must be at the same time. Deviations
    /// are divided by `unit`.
    pub fn between(
        quantity: Quantity,
        unit: f64,
        time_step: f64,
        (left, right): (&[Sample], &[Sample]),
    ) -> Self {
        let deviations: Vec<f64> = left
            .iter()
            .zip(right)
            .map(|(left, right)| quantity.distance(left, right) / unit)
            .collect();
        let squares: f64 = deviations
            .iter()
            .map(|deviation| deviation * deviation)
            .sum();
        Self {
            time_step,
            largest: deviations.iter().copied().fold(0.0, f64::max),
            rms: (squares / deviations.len().max(1) as f64).sqrt(),
            first_above: DEVIATIONS.map(|threshold| {
                let row = deviations
                    .iter()
                    .position(|&deviation| deviation > threshold)?;
                Some(left[row].time)
            }),
            round_off: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(step: u64, wall_force: f64, y1: f64) -> Sample {
        let mut sample = Sample {
            step,
            time: step as f64 * 0.5,
            wall_force,
            ..Sample::default()
        };
        sample.bodies[0].position[1] = y1;
        sample
    }

    fn series() -> Vec<Sample> {
        let forces = [0.0, 0.1, 0.2, 0.4, 0.3, 0.0, 0.0, 0.1, 0.0];
        let heights = [2.7, 2.6, 2.5, 2.4, 2.3, 2.0, 1.1, 0.99, 0.98];
        let rows = forces.iter().zip(heights).enumerate();
        rows.map(|(step, (&force, height))| sample(step as u64, force, height))
            .collect()
    }

    #[test]
    fn branches_meet_and_leave_out_the_touch_and_the_landing() {
        let milestones = Milestones::read(&series(), &Stack::paper(0.3, 100.0)).unwrap();
        let rows = Branch::ALL.map(|branch| milestones.rows(branch));
        assert_eq!(rows, [1..4, 4..5, 5..7]);
    }

    #[test]
    fn a_series_without_landing_has_no_milestones() {
        assert_eq!(
            Milestones::read(&series()[..7], &Stack::paper(0.3, 100.0)),
            None
        );
    }

    #[test]
    fn largest_mean_and_first_deviations_are_those_of_the_rows() {
        let left = series();
        let mut right = left.clone();
        right[2].wall_force += 4e-6;
        right[3].wall_force -= 4e-4;
        let pair = (&left[..4], &right[..4]);
        let distance = Distance::between(Quantity::WallForce, 0.4, 0.5, pair);
        assert!((distance.largest - 1e-3).abs() < 1e-12);
        assert!((distance.rms - (0.25 * (1e-6 + 1e-10_f64)).sqrt()).abs() < 1e-12);
        assert_eq!(distance.first_above, [Some(1.0), Some(1.5), None]);
    }
}
