//! The yield force of a series, by the two estimators of the field.

use super::differences::FiveRows;
use super::digits::{PrintedDigits, Rounding, SINGLE_COORDINATE, STEP_IN_SINGLE_PRECISION};
use super::pair_contact::PairContact;
use super::polynomial::value_at_zero;
use super::reported::{of_floor, of_pair, reports};
use super::sample::{FloorContact, Sample};
use super::samples::Series;
use crate::model::{Case, ContactLaw, CoulombOperand, SlidingSpring, Stack};
use serde::{Deserialize, Serialize};

/// Number of rows needed on each side of the peak.
const ROWS_AROUND_PEAK: usize = 4;

/// A force estimated from a series, with the possible error from the spacing of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// F = f/(m g).
    pub force: f64,
    /// Distance between the interpolations of two orders, in m g.
    pub sampling: f64,
    /// Factor by which the estimate amplifies an error of the recorded forces.
    pub sensitivity: f64,
}

/// Both estimates; each is absent where the series does not show what it needs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct YieldEstimates {
    /// Wall force when a floor contact begins to slide.
    pub slip: Option<Estimate>,
    /// Largest wall force, the paper's definition of the yield force.
    pub peak: Option<Estimate>,
    /// |t|/n of the floor contacts while they slide, as measured from the series.
    pub sliding_friction: Option<f64>,
    /// The first row between slip and peak in which a floor contact does not slide: there is no onset then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub departure: Option<Departure>,
    /// Largest |q|/a, tangential over normal force, that the contacts of cylinder 1 surely carry, rounded down to a
    /// multiple of 1e-9: they have at least this much friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pair_friction: Option<f64>,
    /// The digits with which the code has printed the forces; absent if it has printed all digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub printed: Option<PrintedDigits>,
    /// Rounding of a position that the steps of the whole run add up, in r, where positions are numbers of 32 bits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position_drift: Option<f64>,
}

/// A row in which a floor contact should slide, and does not.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Departure {
    /// Steps since the wall began to move.
    pub step: u64,
    /// |t|/n in that row.
    pub ratio: f64,
}

impl YieldEstimates {
    /// Reads both estimates from `series`, the run of `case`.
    pub fn read(series: &Series, case: &Case) -> Self {
        let stiffness = case.stack.stiffness;
        let in_weights = |estimate: Estimate| Estimate {
            force: estimate.force * stiffness,
            sampling: estimate.sampling * stiffness,
            ..estimate
        };
        let samples = series.samples();
        let rounding = Rounding::read(samples);
        let peak_row = peak_row(samples);
        let sliding_friction = peak_row.and_then(|row| sliding_friction(samples, row, &case.stack));
        let sliding = peak_row.zip(sliding_friction);
        let beyond =
            sliding.and_then(|(row, friction)| row_beyond(&samples[..=row], friction, &case.stack));
        let slides = beyond.zip(sliding);
        let slides = slides.map(|(beyond, (row, friction))| (beyond, row, friction));
        // While cylinders 2 and 3 touch, the floor slides no faster than the load grows, and sticks now and then.
        let is_last = |beyond: usize| samples[beyond].bottom_overlap(&case.stack) <= 0.0;
        let ends = slides.filter(|&(beyond, ..)| {
            reports(samples, |row| of_floor(row, &case.stack)) && is_last(beyond)
        });
        let departure = ends.and_then(|(beyond, row, friction)| {
            Sliding::of(case, friction, rounding).departure(samples, beyond, row)
        });
        let slip = slides.filter(|_| departure.is_none());
        let slip = slip.and_then(|(beyond, row, friction)| {
            slip_onset(&samples[..=row], beyond, friction, &case.stack)
        });
        Self {
            slip: slip.map(in_weights),
            peak: peak_row.map(|row| in_weights(peak(samples, row))),
            sliding_friction,
            departure,
            pair_friction: beyond.and_then(|beyond| pair_friction(samples, beyond, case, rounding)),
            printed: PrintedDigits::read(samples, stiffness),
            position_drift: rounding
                .has_single_positions()
                .then(|| position_drift(case)),
        }
    }
}

/// Rounding of positions in single precision that the steps of `case` add up, in r: a random walk, if bodies move by many
/// units in the last place in a step. Otherwise successive steps round alike, and the sum grows as those units become
/// fewer: with a wall that moves by 8 to 120 of them, peaks are off by 0.1 to 1.3 of it.
fn position_drift(case: &Case) -> f64 {
    let protocol = &case.protocol;
    let steps = case.total_steps() as f64;
    let walk = (steps / 12.0).sqrt() * SINGLE_COORDINATE;
    let alike = STEP_IN_SINGLE_PRECISION / (protocol.wall_speed * protocol.time_step);
    (walk * alike.max(1.0)).min(0.5 * steps * SINGLE_COORDINATE)
}

/// Returns the index of the row with the largest wall force, if the series has enough rows on both sides.
fn peak_row(samples: &[Sample]) -> Option<usize> {
    let force = |index: usize| samples[index].wall_force;
    let highest = (0..samples.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)))?;
    (highest >= ROWS_AROUND_PEAK && highest + ROWS_AROUND_PEAK < samples.len()).then_some(highest)
}
/// Returns the largest |t|/n of the floor contacts at the peak and in the rows after it, when they slide and their
/// force is capped. It is measured, not taken from the input of the code, so that a wrong friction in the code shows
/// in the yield force.
fn sliding_friction(samples: &[Sample], peak_row: usize, stack: &Stack) -> Option<f64> {
    let rows = &samples[peak_row..=peak_row + ROWS_AROUND_PEAK];
    let contacts = rows.iter().flat_map(|row| row.floor_contacts(stack));
    let ratios = contacts
        .filter(|contact| contact.normal > 0.0)
        .map(|contact| contact.friction() / contact.normal);
    let largest = ratios.fold(0.0, f64::max);
    (largest > 0.0).then_some(largest)
}

/// Returns μ n − |t| of the floor contact that is closer to sliding.
fn slip_margin(sample: &Sample, friction: f64, stack: &Stack) -> f64 {
    let contacts = sample.floor_contacts(stack);
    let margins = contacts.map(|contact| friction * contact.normal - contact.friction());
    margins.fold(f64::INFINITY, f64::min)
}

/// Returns the first row at which the straight line through the slip margins of the two rows before has reached zero.
fn row_beyond(samples: &[Sample], friction: f64, stack: &Stack) -> Option<usize> {
    let margin = |row: usize| slip_margin(&samples[row], friction, stack);
    let line_reaches_zero = |row: &usize| {
        let time = |back: usize| samples[row - back].time;
        let slope = (margin(row - 1) - margin(row - 2)) / (time(1) - time(2));
        margin(row - 1) + slope * (time(0) - time(1)) <= 0.0
    };
    (2..samples.len()).find(line_reaches_zero)
}

/// Fraction of the friction below which a floor contact surely sticks.
const SURELY_STICKS: f64 = 1.0 - 1e-3;

/// Returns the rows before the floor contacts come close to sliding, at the measured friction or, where nothing
/// slides, at that of `stack`.
pub(super) fn sticking_rows<'a>(samples: &'a [Sample], stack: &Stack) -> &'a [Sample] {
    let measured = peak_row(samples).and_then(|row| sliding_friction(samples, row, stack));
    let friction = SURELY_STICKS * measured.unwrap_or(stack.floor_friction);
    let slides = |sample: &Sample| slip_margin(sample, friction, stack) <= 0.0;
    let end = samples.iter().skip(1).position(slides);
    &samples[..end.map_or(samples.len(), |end| end + 1)]
}

/// Largest relative difference between |t|/n of a sliding contact and the friction: codes cap the force at exactly μ
/// n.
const AT_THE_LIMIT: f64 = 1e-9;

/// The range of |t|/n that the convention of a code allows for a sliding floor contact.
struct Sliding<'a> {
    case: &'a Case,
    wall: ContactLaw,
    friction: f64,
    rounding: Rounding,
}

impl<'a> Sliding<'a> {
    fn of(case: &'a Case, friction: f64, rounding: Rounding) -> Self {
        Self {
            case,
            wall: case.convention.wall_law(case.stack.stiffness_ratio),
            friction,
            rounding,
        }
    }

    /// The first body on the floor.
    fn first(&self, sample: &Sample) -> FloorContact {
        sample.first(&self.case.stack)
    }

    /// Returns the first row from `beyond`, which lies after the onset, to `peak_row` in which a floor contact is
    /// further from its limit than the convention allows.
    fn departure(&self, samples: &[Sample], beyond: usize, peak_row: usize) -> Option<Departure> {
        let mut has_slid = false;
        (beyond..=peak_row).find_map(|row| {
            let sample = &samples[row];
            let contacts = sample.floor_contacts(&self.case.stack);
            let excesses: Vec<f64> = contacts
                .map(|contact| {
                    (contact.friction() / contact.normal - self.friction) / self.friction
                })
                .collect();
            let [below, above] = self.allowed(samples, row, has_slid);
            let exact = self.at_the_limit(sample);
            has_slid |= excesses.iter().all(|excess| excess.abs() <= exact);
            let away = excesses
                .into_iter()
                .find(|excess| !(-below..=above).contains(excess));
            away.map(|excess| Departure {
                step: sample.step,
                ratio: self.friction * (1.0 + excess),
            })
        })
    }

    /// Relative difference between |t|/n and the friction that rounding explains.
    fn at_the_limit(&self, sample: &Sample) -> f64 {
        let printed = (1.0 + self.friction) * self.rounding.force;
        AT_THE_LIMIT + 2.0 * printed / (self.friction * self.first(sample).normal)
    }

    /// Returns how far |t|/n may be below and above the friction in `row`, relative to it.
    ///
    /// A frozen spring sticks again for one step when the normal force has grown. Where Coulomb's limit applies to the
    /// spring alone, damping is added until the spring has reached the limit.
    fn allowed(&self, samples: &[Sample], row: usize, has_slid: bool) -> [f64; 2] {
        let convention = &self.case.convention;
        let below = match convention.sliding_spring {
            SlidingSpring::Frozen => self.growth_in_a_step(samples, row),
            SlidingSpring::FollowsLimit => 0.0,
        };
        let above = match convention.coulomb_operand {
            CoulombOperand::Spring if !has_slid => self.damping(samples, row),
            CoulombOperand::Spring | CoulombOperand::SpringAndDamping => 0.0,
        };
        let exact = self.at_the_limit(&samples[row]);
        [below, above].map(|allowed| allowed + exact)
    }

    /// Relative growth of the normal force of the floor in one step.
    fn growth_in_a_step(&self, samples: &[Sample], row: usize) -> f64 {
        let (before, after) = (
            &samples[row - 1],
            &samples[(row + 1).min(samples.len() - 1)],
        );
        let sample = &samples[row];
        let growth = |from: &Sample, to: &Sample| {
            let steps = to.step.saturating_sub(from.step).max(1) as f64;
            let [from, to, own] = [from, to, sample].map(|row| self.first(row).normal);
            (to - from).abs() / (steps * own)
        };
        growth(before, sample).max(growth(sample, after))
    }

    /// Damping of the floor contact, relative to its limit.
    fn damping(&self, samples: &[Sample], row: usize) -> f64 {
        let first = self.first(&samples[row]);
        let speed = FiveRows::around(samples, row, self.rounding).map(|five| {
            let x2 = five.rates(|row| self.first(row).outwards);
            let turn = five.rates(|row| self.first(row).turn);
            let radius = 1.0 + self.case.convention.arms.floor.kinematic * (1.0 - first.height);
            let speed = |x: f64, turn: f64| (x + radius * turn).abs();
            speed(x2.velocity, turn.velocity)
                + self.case.protocol.time_step * speed(x2.acceleration, turn.acceleration)
                + x2.velocity_error
                + radius * turn.velocity_error
        });
        let speed = speed.unwrap_or_else(|| self.case.protocol.fast_speed());
        let damping = self.wall.at(1.0 - first.height).damping_tangential;
        damping * speed / (self.friction * first.normal)
    }
}

/// A kink in the motion spoils the differences over five rows that contain it; of this many successive ones, at least
/// one does not contain it.
const ROWS_BEYOND_A_KINK: usize = 6;

/// Returns the largest ratio |q|/a that is surely carried in several successive rows from `beyond` on, while the top
/// wall presses and cylinder 2 stands on the floor.
fn pair_friction(
    samples: &[Sample],
    beyond: usize,
    case: &Case,
    rounding: Rounding,
) -> Option<f64> {
    if !reports(samples, |row| of_pair(row, &case.stack)) {
        return None;
    }
    let law = case.convention.law(case.stack.stiffness_ratio);
    let ratios = (beyond..samples.len()).map_while(|row| {
        let bears = samples[row].wall_force > 0.0 && samples[row].first(&case.stack).normal > 0.0;
        let five = FiveRows::around(samples, row, rounding).filter(|_| bears)?;
        Some(PairContact::of(case, &law, five).carried_ratio())
    });
    let ratios: Vec<f64> = ratios.collect();
    let least = |rows: &[f64]| rows.iter().copied().fold(f64::INFINITY, f64::min);
    let sustained = ratios.windows(ROWS_BEYOND_A_KINK).map(least);
    let largest = sustained.fold(0.0, f64::max);
    (largest > 0.0).then(|| (1e9 * largest).floor() / 1e9)
}

/// Extrapolates the wall force, as a function of the slip margin, to margin 0 from four rows that certainly still
/// stick, all before the peak. Rows in which the contact slides do not tell when it began to slide.
///
/// The margin falls smoothly while the contact sticks. The onset lies before the first row at which the
/// straight line through the two rows before it has reached zero; the last of these is left out too, since
/// it may lie just beyond. A threshold on the margin itself would not do, because a contact whose spring
/// is frozen while it slides (the paper's law) sticks again now and then as the normal force grows.
///
/// A force outside the rows that enclose the onset is extrapolated noise, and is rejected.
fn slip_onset(samples: &[Sample], beyond: usize, friction: f64, stack: &Stack) -> Option<Estimate> {
    let rows = beyond.checked_sub(5)?..beyond - 1;
    let last_sticking = samples[rows.end - 1].wall_force;
    let after = samples[(beyond + 1).min(samples.len() - 1)].wall_force;
    let sticking = samples[rows].iter();
    let (margins, forces): (Vec<f64>, Vec<f64>) = sticking
        .map(|sample| (slip_margin(sample, friction, stack), sample.wall_force))
        .unzip();
    let force = value_at_zero(&margins, &forces);
    let lower_order = value_at_zero(&margins[1..], &forces[1..]);
    let enclosed = (last_sticking..=after).contains(&force);
    let (margin_change, force_change) = (margins[3] - margins[2], forces[3] - forces[2]);
    enclosed.then(|| Estimate {
        force,
        sampling: (force - lower_order).abs(),
        sensitivity: (force_change / margin_change).abs().max(1.0),
    })
}

/// Vertex of the parabola through the highest row and its neighbours, compared with that through the highest row and
/// the next but one on each side.
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

/// Returns the largest value of the parabola through three points, of which the middle one is the highest and at
/// argument 0.
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
