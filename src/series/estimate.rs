//! The yield force read off a series, by the two estimators of the field.

use super::digits::PrintedDigits;
use super::polynomial::value_at_zero;
use super::samples::{Sample, Series};
use crate::model::Stack;
use serde::{Deserialize, Serialize};

/// Rows needed on both sides of the peak.
const ROWS_AROUND_PEAK: usize = 4;

/// A force read off a series, with what the spacing of the rows may have cost.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// F = f/(m g).
    pub force: f64,
    /// Distance between the interpolations of two orders, in m g.
    pub sampling: f64,
    /// Factor by which an error of the recorded forces is amplified in it.
    pub sensitivity: f64,
}

/// Both estimators; absent where the series does not show what they look for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct YieldEstimates {
    /// Wall force when a floor contact begins to slide.
    pub slip: Option<Estimate>,
    /// Largest wall force, the paper's definition of the yield force.
    pub peak: Option<Estimate>,
    /// |t|/n of the floor contacts while they slide, as measured.
    pub sliding_friction: Option<f64>,
    /// The digits with which the code has printed the forces; absent if it has printed all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub printed: Option<PrintedDigits>,
}

impl YieldEstimates {
    /// Reads both estimators off `series`.
    pub fn read(series: &Series, stack: &Stack) -> Self {
        let in_weights = |estimate: Estimate| Estimate {
            force: estimate.force * stack.stiffness,
            sampling: estimate.sampling * stack.stiffness,
            ..estimate
        };
        let samples = series.samples();
        let peak_row = peak_row(samples);
        let sliding_friction = peak_row.and_then(|row| sliding_friction(samples, row));
        let slip = peak_row
            .zip(sliding_friction)
            .and_then(|(row, friction)| slip_onset(&samples[..=row], friction));
        Self {
            slip: slip.map(in_weights),
            peak: peak_row.map(|row| in_weights(peak(samples, row))),
            sliding_friction,
            printed: PrintedDigits::read(samples, stack.stiffness),
        }
    }
}

/// Index of the row with the largest wall force, if the series goes on for some rows on both sides.
fn peak_row(samples: &[Sample]) -> Option<usize> {
    let force = |index: usize| samples[index].wall_force;
    let highest = (0..samples.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)))?;
    (highest >= ROWS_AROUND_PEAK && highest + ROWS_AROUND_PEAK < samples.len()).then_some(highest)
}

/// Normal and tangential force of both floor contacts.
fn floor_contacts(sample: &Sample) -> [(f64, f64); 2] {
    [
        (sample.floor_n2, sample.floor_t2.abs()),
        (sample.floor_n3, sample.floor_t3.abs()),
    ]
}

/// Largest |t|/n of the floor contacts at the peak and in the rows after it, when they slide and their
/// force is capped. It is measured, not taken from the input of the code, so that a wrong friction
/// in the code shows in the yield force.
fn sliding_friction(samples: &[Sample], peak_row: usize) -> Option<f64> {
    let rows = &samples[peak_row..=peak_row + ROWS_AROUND_PEAK];
    let contacts = rows.iter().flat_map(floor_contacts);
    let ratios = contacts
        .filter(|&(normal, _)| normal > 0.0)
        .map(|(normal, tangential)| tangential / normal);
    let largest = ratios.fold(0.0, f64::max);
    (largest > 0.0).then_some(largest)
}

/// μ n − |t| of the floor contact that is closer to sliding.
fn slip_margin(sample: &Sample, friction: f64) -> f64 {
    let [right, left] =
        floor_contacts(sample).map(|(normal, tangential)| friction * normal - tangential);
    right.min(left)
}

/// Wall force as a function of the slip margin, extrapolated to margin 0 from four rows that certainly
/// still stick, all before the peak: rows at which the contact slides say nothing about when it began to.
///
/// The margin falls smoothly while the contact sticks. The onset lies before the first row at which the
/// straight line through the two rows before it has reached zero; the last of these is left out too, since
/// it may lie just beyond. A threshold on the margin itself would not do, because a contact whose spring
/// is frozen while it slides (the paper's law) sticks again now and then as the normal force grows.
///
/// A force outside the rows that enclose the onset is no onset but noise continued, and is refused.
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
    let last_sticking = samples[rows.end - 1].wall_force;
    let after = samples[(beyond + 1).min(samples.len() - 1)].wall_force;
    let margins = &margins[rows.clone()];
    let forces: Vec<f64> = samples[rows]
        .iter()
        .map(|sample| sample.wall_force)
        .collect();
    let force = value_at_zero(margins, &forces);
    let lower_order = value_at_zero(&margins[1..], &forces[1..]);
    let enclosed = (last_sticking..=after).contains(&force);
    let (margin_change, force_change) = (margins[3] - margins[2], forces[3] - forces[2]);
    enclosed.then(|| Estimate {
        force,
        sampling: (force - lower_order).abs(),
        sensitivity: (force_change / margin_change).abs().max(1.0),
    })
}

/// Vertex of the parabola through the highest row and its neighbours, compared with the one through the
/// neighbours one further away.
fn peak(samples: &[Sample], highest: usize) -> Estimate {
    let vertex = |reach: usize| {
        parabola_vertex([highest - reach, highest, highest + reach].map(|index| {
            let sample = &samples[index];
            (sample.time - samples[highest].time, sample.wall_force)
        }))
    };
    let (near, far) = (vertex(1), vertex(2));
    Estimate {
        force: near,
        sampling: (near - far).abs(),
        sensitivity: 1.0,
    }
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
