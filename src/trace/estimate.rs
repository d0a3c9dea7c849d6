//! The yield force read off a series, by the two estimators of the field.

use super::polynomial::value_at_zero;
use super::series::{Sample, Trace};
use crate::stack::Stack;
use serde::{Deserialize, Serialize};

/// A force read off a series, with what the spacing of the rows may have cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// F = f/(m g).
    pub force: f64,
    /// Distance between the interpolations of two orders, in m g.
    pub sampling: f64,
}

/// Both estimators; absent where the series does not show what they look for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct YieldEstimates {
    /// Wall force when a floor contact first reaches the Coulomb limit, e = μ d.
    pub slip: Option<Estimate>,
    /// Largest wall force, the paper's definition of the yield force.
    pub peak: Option<Estimate>,
}

impl YieldEstimates {
    /// Reads both estimators off `trace`.
    pub fn read(trace: &Trace, stack: &Stack) -> Self {
        let in_weights = |estimate: Estimate| Estimate {
            force: estimate.force * stack.stiffness,
            sampling: estimate.sampling * stack.stiffness,
        };
        let samples = trace.samples();
        let Some(highest) = highest(samples) else {
            return Self {
                slip: None,
                peak: None,
            };
        };
        Self {
            slip: slip_onset(&samples[..=highest], stack.floor_friction).map(in_weights),
            peak: peak(samples, highest).map(in_weights),
        }
    }
}

/// Index of the row with the largest wall force.
fn highest(samples: &[Sample]) -> Option<usize> {
    let force = |index: usize| samples[index].wall_force;
    (0..samples.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)))
}

/// μ n − |t| of the floor contact that is closer to sliding.
fn slip_margin(sample: &Sample, friction: f64) -> f64 {
    let margin = |normal: f64, tangential: f64| friction * normal - tangential.abs();
    margin(sample.floor_n2, sample.floor_t2).min(margin(sample.floor_n3, sample.floor_t3))
}

/// Wall force as a function of the slip margin, extrapolated to margin 0 from four rows that certainly
/// still stick: rows at which the contact slides say nothing about when it began to.
///
/// The margin falls smoothly while the contact sticks. The onset lies before the first row at which the
/// straight line through the two rows before it has reached zero; the last of these is left out too, since
/// it may lie just beyond. A threshold on the margin itself would not do, because a contact whose spring
/// is frozen while it slides (the paper's law) sticks again now and then as the normal force grows.
fn slip_onset(samples: &[Sample], friction: f64) -> Option<Estimate> {
    let margins: Vec<f64> = samples
        .iter()
        .map(|sample| slip_margin(sample, friction))
        .collect();
    let line_reaches_zero = |index: &usize| {
        let time = |back: usize| samples[index - back].time;
        let slope = (margins[index - 1] - margins[index - 2]) / (time(1) - time(2));
        margins[index - 1] + slope * (time(0) - time(1)) <= 0.0
    };
    let beyond = (2..samples.len()).find(line_reaches_zero)?;
    let rows = beyond.checked_sub(5)?..beyond - 1;
    let margins = &margins[rows.clone()];
    let forces: Vec<f64> = samples[rows]
        .iter()
        .map(|sample| sample.wall_force)
        .collect();
    let force = value_at_zero(margins, &forces);
    let lower_order = value_at_zero(&margins[1..], &forces[1..]);
    Some(Estimate {
        force,
        sampling: (force - lower_order).abs(),
    })
}

/// Vertex of the parabola through the highest row and its neighbours, compared with the one through the
/// neighbours one further away.
fn peak(samples: &[Sample], highest: usize) -> Option<Estimate> {
    if highest < 2 || highest + 2 >= samples.len() {
        return None;
    }
    let vertex = |reach: usize| {
        parabola_vertex([highest - reach, highest, highest + reach].map(|index| {
            let sample = &samples[index];
            (sample.time - samples[highest].time, sample.wall_force)
        }))
    };
    let (near, far) = (vertex(1), vertex(2));
    Some(Estimate {
        force: near,
        sampling: (near - far).abs(),
    })
}

/// Largest value of the parabola through three points, the middle one at argument 0 and highest.
fn parabola_vertex([left, middle, right]: [(f64, f64); 3]) -> f64 {
    let left_slope = (middle.1 - left.1) / (middle.0 - left.0);
    let right_slope = (right.1 - middle.1) / (right.0 - middle.0);
    let curvature = (right_slope - left_slope) / (right.0 - left.0);
    if curvature >= 0.0 {
        return middle.1;
    }
    let slope = left_slope - curvature * left.0;
    middle.1 - slope * slope / (4.0 * curvature)
}
