//! Velocities and accelerations from equally spaced rows.

use super::digits::Rounding;
use super::sample::Sample;

/// Time for which the stack rings, in √(m/k_n); with a restitution of 0.7 it is about ten.
pub(super) const RINGING_TIME: f64 = 10.0;

/// Time derivatives of a coordinate.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rates {
    pub(super) velocity: f64,
    pub(super) acceleration: f64,
    /// Difference between the formulas of second and of fourth order.
    pub(super) velocity_error: f64,
    pub(super) acceleration_error: f64,
}

/// Five rows that are equally spaced in time.
#[derive(Debug, Clone, Copy)]
pub(super) struct FiveRows<'a> {
    pub(super) rows: &'a [Sample; 5],
    rounding: Rounding,
}

impl<'a> FiveRows<'a> {
    /// The rows around `row`, two on each side, with this `rounding`. `None` if there are not enough
    /// rows, or if they are not equally spaced. The first row of a series is never used, because forces of some codes
    /// belong to another moment there.
    pub(super) fn around(samples: &'a [Sample], row: usize, rounding: Rounding) -> Option<Self> {
        let first = row.checked_sub(2).filter(|&first| first > 0)?;
        let rows: &[Sample; 5] = samples.get(first..first + 5)?.try_into().ok()?;
        let mut steps = rows.windows(2).map(|pair| pair[1].step - pair[0].step);
        let every = steps.next()?;
        steps
            .all(|step| step == every)
            .then_some(Self { rows, rounding })
    }

    /// Rounding error of a coordinate.
    pub(super) fn unit(self) -> f64 {
        self.rounding.coordinate
    }

    /// Time between two successive rows.
    pub(super) fn interval(self) -> f64 {
        self.rows[3].time - self.rows[2].time
    }

    /// Noise of a coordinate: it is rounded in every step, and the stack remembers each rounding error while it rings.
    pub(super) fn rounding(self) -> f64 {
        let time_step = self.rows[3].time / self.rows[3].step as f64;
        let Rounding {
            coordinate, step, ..
        } = self.rounding;
        coordinate.max(step * (RINGING_TIME / time_step).max(1.0).sqrt())
    }

    /// Returns central differences at the middle row.
    pub(super) fn rates(self, coordinate: impl Fn(&Sample) -> f64) -> Rates {
        let middle = coordinate(&self.rows[2]);
        let [before, left, _, right, after] =
            self.rows.each_ref().map(|row| coordinate(row) - middle);
        let interval = self.interval();
        let square = interval * interval;
        let velocity = (8.0 * (right - left) - (after - before)) / (12.0 * interval);
        let acceleration = (16.0 * (right + left) - (after + before)) / (12.0 * square);
        Rates {
            velocity,
            acceleration,
            velocity_error: (velocity - (right - left) / (2.0 * interval)).abs(),
            acceleration_error: (acceleration - (right + left) / square).abs(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample_at(step: u64, interval: f64) -> Sample {
        Sample {
            step,
            time: interval * step as f64,
            ..Sample::default()
        }
    }

    #[test]
    fn a_quartic_has_exact_rates_and_the_error_of_second_order_shows() {
        let rows: Vec<Sample> = (0..9).map(|step| sample_at(step, 0.5)).collect();
        let five = FiveRows::around(&rows, 4, Rounding::DOUBLE).unwrap();
        let rates = five.rates(|row| row.time.powi(3) - 2.0 * row.time);
        assert!((rates.velocity - (3.0 * 4.0 - 2.0)).abs() < 1e-12);
        assert!((rates.acceleration - 12.0).abs() < 1e-12);
        assert!((rates.velocity_error - 0.25).abs() < 1e-12, "h² f‴/6");
        assert!(rates.acceleration_error < 1e-12);
    }

    #[test]
    fn rows_at_other_distances_and_the_first_one_have_no_rates() {
        let mut rows: Vec<Sample> = (0..9).map(|step| sample_at(step, 0.5)).collect();
        assert!(FiveRows::around(&rows, 2, Rounding::DOUBLE).is_none());
        assert!(FiveRows::around(&rows, 3, Rounding::DOUBLE).is_some());
        assert!(FiveRows::around(&rows, 7, Rounding::DOUBLE).is_none());
        rows[8].step = 9;
        assert!(FiveRows::around(&rows, 6, Rounding::DOUBLE).is_none());
    }
}
