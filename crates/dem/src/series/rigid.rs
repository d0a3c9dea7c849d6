//! The force with which a rigid stack gives way, read from its series.

use super::sample::Sample;
use super::samples::Series;
use crate::model::{Case, Preparation};
use crate::theory::rigid_force;
use serde::{Deserialize, Serialize};

/// Fraction of the rows at the beginning in which the impact of the wall may show.
const TOUCH: f64 = 0.1;
/// Number of groups of rows, whose mean forces scatter less than those of rows.
const GROUPS: usize = 10;
/// Number of rows from which each group has several.
const FEWEST_ROWS: usize = 5 * GROUPS;
/// Factor from a standard error with `GROUPS` - 2 degrees of freedom to an uncertainty with a confidence of 99.9 %
/// (Student's t).
const CONFIDENCE: f64 = 5.04;

/// What the series of a rigid stack shows. Forces in m g.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RigidReading {
    /// Force of the wall above the exact one at the same travel, by a straight line at vanishing travel; absent where no
    /// exact one is known, and where there are too few rows.
    pub excess: Option<f64>,
    /// The statistical uncertainty of that.
    pub scatter: f64,
    /// How far cylinders 2 and 3 have slid, as a fraction of how far they must slide so that cylinder 1 sinks with the wall;
    /// absent where their places are not reported.
    pub slid: Option<f64>,
    /// How far cylinders 2 and 3 have turned, as a fraction of how far they turn if they roll on cylinder 1; that of the one
    /// where it is further from 1; absent where their rotations are not reported.
    pub turned: Option<f64>,
    /// What floor and wall are out of balance by, beside three weights: the mean over the rows.
    pub unbalanced: f64,
    /// Difference of the normal forces of the floor on cylinders 2 and 3: the mean over the rows.
    pub asymmetry: f64,
    /// |t|/n at the floor, 0 in rows where that bears nothing: the mean over the rows.
    pub friction: f64,
}

impl RigidReading {
    /// Reads the series of `case`; `None` if its bodies are not rigid, or there are too few rows.
    pub(super) fn read(series: &Series, case: &Case) -> Option<Self> {
        if case.protocol.preparation != Preparation::Rigid {
            return None;
        }
        let samples = series.samples();
        let touched = 1 + (TOUCH * samples.len() as f64) as usize;
        let rows = samples
            .get(touched..)
            .filter(|rows| rows.len() >= FEWEST_ROWS)?;
        let (stack, speed) = (&case.stack, case.protocol.wall_speed);
        let mean = |value: &dyn Fn(&Sample) -> f64| {
            rows.iter().map(value).sum::<f64>() / rows.len() as f64
        };
        let weights = |force: f64| force * stack.stiffness;
        let points: Option<Vec<[f64; 2]>> = rows
            .iter()
            .map(|row| {
                let travel = speed * row.time;
                let exact = rigid_force(stack, travel)?;
                Some([travel, weights(row.wall_force) - exact])
            })
            .collect();
        let line = points.and_then(|points| at_no_travel(&points));
        let apart = |row: &Sample| row.neighbour_distance(stack);
        let (first, last) = (rows.first()?, rows.last()?);
        // 2 cos ψ is the height of cylinder 1 over the others.
        let sine = |travel: f64| {
            let cosine = 0.5 * (stack.ring().rise - travel);
            (1.0 - cosine * cosine).max(0.0).sqrt()
        };
        let [begun, ended] = [first, last].map(|row| sine(speed * row.time));
        let slid = (apart(last) - apart(first)) / (4.0 * (ended - begun));
        let rolls = 2.0 * (libm::asin(ended) - libm::asin(begun));
        let turns = last.floor_contacts(stack).zip(first.floor_contacts(stack));
        let turns = turns.map(|(last, first)| (last.turn - first.turn) / rolls);
        let turned = turns.max_by(|one, other| (one - 1.0).abs().total_cmp(&(other - 1.0).abs()));
        Some(Self {
            excess: line.map(|[excess, _]| excess),
            scatter: line.map_or(0.0, |[_, scatter]| scatter),
            slid: Some(slid).filter(|slid| slid.is_finite()),
            turned: turned.filter(|turned| turned.is_finite()),
            unbalanced: mean(&|row| weights(row.borne(stack) - stack.floor_force(row.wall_force))),
            asymmetry: mean(&|row| {
                let [one, other] = normals(row, case);
                weights(one - other)
            }),
            friction: mean(&|row| {
                let contacts = row.floor_contacts(stack);
                let (load, tangential) =
                    (row.borne(stack), contacts.map(|own| own.tangential.abs()));
                match load > 0.0 {
                    true => tangential.sum::<f64>() / load,
                    false => 0.0,
                }
            }),
        })
    }
}

/// The normal forces of the floor on cylinders 2 and 3.
fn normals(row: &Sample, case: &Case) -> [f64; 2] {
    let mut own = row
        .floor_contacts(&case.stack)
        .map(|contact| contact.normal);
    [own.next(), own.next()].map(Option::unwrap_or_default)
}

/// Returns the value at 0 of the straight line through the means of groups of successive `points`, and its uncertainty.
fn at_no_travel(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let groups = points.chunks(points.len().div_ceil(GROUPS));
    let means: Vec<[f64; 2]> = groups
        .map(|group| {
            let mean = |axis: usize| {
                group.iter().map(|point| point[axis]).sum::<f64>() / group.len() as f64
            };
            [mean(0), mean(1)]
        })
        .collect();
    let count = means.len() as f64;
    let centre = [0, 1].map(|axis| means.iter().map(|mean| mean[axis]).sum::<f64>() / count);
    let spread: f64 = means.iter().map(|mean| (mean[0] - centre[0]).powi(2)).sum();
    let rise = |mean: &[f64; 2]| (mean[0] - centre[0]) * (mean[1] - centre[1]);
    let slope = means.iter().map(rise).sum::<f64>() / spread;
    let off = |mean: &[f64; 2]| mean[1] - centre[1] - slope * (mean[0] - centre[0]);
    let variance = means.iter().map(|mean| off(mean).powi(2)).sum::<f64>() / (count - 2.0);
    let error = (variance * (1.0 / count + centre[0] * centre[0] / spread)).sqrt();
    let value = centre[1] - slope * centre[0];
    (value.is_finite() && error.is_finite()).then_some([value, CONFIDENCE * error])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_with_scatter_is_read_within_its_uncertainty() {
        let noise = |row: usize| 1e-5 * libm::sin(17.0 * (row * row) as f64);
        let points: Vec<[f64; 2]> = (1..=200)
            .map(|row| {
                let travel = 1e-6 * row as f64;
                [travel, 0.25 + 3.0 * travel + noise(row)]
            })
            .collect();
        let [value, uncertainty] = at_no_travel(&points).unwrap();
        assert!((value - 0.25).abs() < uncertainty, "{value} {uncertainty}");
        assert!(uncertainty < 2e-5, "{uncertainty}");
    }
}
