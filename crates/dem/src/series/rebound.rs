//! Properties of an impact, read from its motion.

use super::motion::{BodyRow, Motion, MotionRow};
use crate::model::ImpactTarget;
use serde::{Deserialize, Serialize};

/// Rows without contact at the end of a motion that show that the bodies have separated.
const ROWS_APART: usize = 4;

/// The numbers of an impact. Velocities are those of free flight, before and after.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rebound {
    /// Largest overlap, in r: the vertex of the polynomial through five rows.
    pub greatest_overlap: f64,
    /// Time for which the bodies overlap, in √(m/k_n). Each end is the zero of the straight line through the rows just
    /// before and just after it, between which the bodies are taken to fly freely.
    pub duration: f64,
    /// Speed of separation over speed of approach.
    pub restitution: f64,
    /// Change of the tangential velocity: of the cylinder along the floor, against its motion, or of half the relative
    /// angular momentum of a pair, counter-clockwise.
    pub tangential_velocity: f64,
    /// Loss of spin, counter-clockwise; the mean over a pair.
    pub spin: f64,
    /// The largest number of significant digits with which a number is printed, at most 17.
    pub digits: u32,
}

impl Rebound {
    /// Reads `motion`, which has this time step. `None` if the bodies touch in the first row or never, or have not
    /// separated for good some rows before the end.
    pub fn read(motion: &Motion, target: ImpactTarget, time_step: f64) -> Option<Self> {
        let rows = motion.rows();
        let overlaps: Vec<f64> = rows.iter().map(|row| overlap(target, row)).collect();
        let first = overlaps.iter().position(|&overlap| overlap > 0.0)?;
        let last = overlaps.iter().rposition(|&overlap| overlap > 0.0)?;
        if first == 0 || last + ROWS_APART >= rows.len() {
            return None;
        }
        let line = |row: usize| row as f64 + overlaps[row] / (overlaps[row] - overlaps[row + 1]);
        let [before, after] = [rows.first()?, rows.last()?].map(|row| Flight::of(target, row));
        Some(Self {
            greatest_overlap: greatest(&overlaps)?,
            duration: (line(last) - line(first - 1)) * time_step,
            restitution: -after.separation / before.separation,
            tangential_velocity: after.tangential - before.tangential,
            spin: before.spin - after.spin,
            digits: motion.most_digits(),
        })
    }
}

fn overlap(target: ImpactTarget, row: &MotionRow) -> f64 {
    let [one, two] = row.bodies();
    match target {
        ImpactTarget::Floor => 1.0 - one.position[1],
        ImpactTarget::Pair => {
            let [x, y] = difference(one.position, two.position);
            2.0 - (x * x + y * y).sqrt()
        }
    }
}

fn difference(one: [f64; 2], two: [f64; 2]) -> [f64; 2] {
    [one[0] - two[0], one[1] - two[1]]
}

/// Two bodies that do not touch.
struct Flight {
    /// Speed at which they separate, at the distance at which they just touch.
    separation: f64,
    /// Tangential velocity at that distance.
    tangential: f64,
    spin: f64,
}

impl Flight {
    fn of(target: ImpactTarget, row: &MotionRow) -> Self {
        let bodies = row.bodies();
        match target {
            ImpactTarget::Floor => Self {
                separation: bodies[0].velocity[1],
                // Against its motion to the right.
                tangential: -bodies[0].velocity[0],
                spin: bodies[0].spin,
            },
            ImpactTarget::Pair => Self::of_pair(&bodies),
        }
    }

    fn of_pair([one, two]: &[BodyRow; 2]) -> Self {
        let [x, y] = difference(one.position, two.position);
        let [vx, vy] = difference(one.velocity, two.velocity);
        let tangential = 0.5 * (x * vy - y * vx);
        let square = vx * vx + vy * vy - tangential * tangential;
        Self {
            separation: square.max(0.0).sqrt().copysign(x * vx + y * vy),
            tangential,
            spin: 0.5 * (one.spin + two.spin),
        }
    }
}

/// Returns the maximum of the polynomial through the highest of `values` and two on each side. `None` if the highest
/// is too close to an end.
fn greatest(values: &[f64]) -> Option<f64> {
    let highest = (0..values.len()).max_by(|&i, &j| values[i].total_cmp(&values[j]))?;
    let first = highest.checked_sub(2)?;
    let five = values.get(first..first + 5)?;
    let [before, left, right, after] = [0, 1, 3, 4].map(|index| five[index] - five[2]);
    let slope = (8.0 * (right - left) - (after - before)) / 12.0;
    let bend = (16.0 * (right + left) - (after + before)) / 12.0;
    let third = 0.5 * (after - before) - (right - left);
    let fourth = after + before - 4.0 * (right + left);
    let mut place = 0.0;
    // Newton's method for the zero of the slope, which lies within half a row of a smooth maximum.
    for _ in 0..8 {
        let rise = slope + place * (bend + place * (third / 2.0 + place * fourth / 6.0));
        let curvature = bend + place * (third + place * fourth / 2.0);
        place -= rise / curvature;
    }
    let rise =
        place * (slope + place * (bend / 2.0 + place * (third / 6.0 + place * fourth / 24.0)));
    Some(five[2] + rise)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vertex_of_a_quartic_is_exact() {
        let value = |x: f64| 3.0 - (x - 0.3).powi(2) * (1.0 + 0.1 * (x - 0.3) + 0.05 * x * x);
        let rows: Vec<f64> = (-4..5).map(|row| value(f64::from(row))).collect();
        assert!((greatest(&rows).unwrap() - 3.0).abs() < 1e-14);
        assert_eq!(greatest(&rows[4..]), None, "the highest row is the first");
    }
}
