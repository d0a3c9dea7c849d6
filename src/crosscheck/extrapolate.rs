//! From a few runs at finite wall speed to the quasi-static yield force and its uncertainty.

use super::plan::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN, SPEEDS};
use crate::trace::{Estimate, YieldEstimates, value_at_zero, weights_at_zero};

/// What the uncertainty consists of, each part an expected largest error in m g.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Distance between the extrapolations of second and first order in the wall speed.
    pub wall_speed: f64,
    /// Change of the middle run with the time step doubled: the error of the single step if it is of first
    /// order, three times that if it is of second.
    pub time_step: f64,
    /// Change of the middle run with the gravity ramp halved. Damping along the ramp shifts the settled
    /// state by an amount inversely proportional to its duration, so that this is the shift itself.
    pub preparation: f64,
    /// Distance between interpolations of two orders between the rows, as the extrapolation amplifies it.
    pub sampling: f64,
    /// A few units in the last place of the positions, as the extrapolation amplifies them. Series are
    /// printed with every digit, so that print precision adds nothing to it.
    pub round_off: f64,
}

impl Budget {
    /// The uncertainty: the sum of the parts, as if they all conspired.
    pub fn total(&self) -> f64 {
        self.wall_speed + self.time_step + self.preparation + self.sampling + self.round_off
    }
}

/// A yield force at vanishing wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolation {
    /// F = f/(m g).
    pub force: f64,
    /// Where its uncertainty comes from.
    pub budget: Budget,
    /// Observed order of convergence in the wall speed; 1 is expected.
    pub order: f64,
}

/// Positions are of order r and forces differences of them: two of up to 2.8 r each.
const ROUND_OFF: f64 = 4.0 * 2.8 * f64::EPSILON;

/// Extrapolates one estimator over the runs of a measurement, in the order of its cases. `None` if it is
/// absent from any of them.
pub fn extrapolate(
    estimates: &[YieldEstimates],
    stiffness: f64,
    estimator: impl Fn(&YieldEstimates) -> Option<Estimate>,
) -> Option<Extrapolation> {
    let all: Vec<Estimate> = estimates.iter().map(estimator).collect::<Option<_>>()?;
    let by_speed = all.get(..SPEEDS.len())?;
    let change_from_middle = |run: usize| Some((all.get(run)?.force - all[MIDDLE_RUN].force).abs());
    let forces: Vec<f64> = by_speed.iter().map(|estimate| estimate.force).collect();
    let force = value_at_zero(&SPEEDS, &forces);
    let lower_order = value_at_zero(&SPEEDS[1..], &forces[1..]);
    let weights = weights_at_zero(&SPEEDS);
    let amplified = |errors: Vec<f64>| -> f64 {
        let terms = weights.iter().zip(errors);
        terms.map(|(weight, error)| weight.abs() * error).sum()
    };
    let budget = Budget {
        wall_speed: (force - lower_order).abs(),
        time_step: change_from_middle(COARSE_TIME_STEP_RUN)?,
        preparation: change_from_middle(SHORT_RAMP_RUN)?,
        sampling: amplified(by_speed.iter().map(|estimate| estimate.sampling).collect()),
        round_off: amplified(vec![ROUND_OFF * stiffness; forces.len()]),
    };
    let order = libm::log2(((forces[0] - forces[1]) / (forces[1] - forces[2])).abs());
    Some(Extrapolation {
        force,
        budget,
        order,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimates(forces: [f64; 5]) -> Vec<YieldEstimates> {
        let estimate = |force| {
            Some(Estimate {
                force,
                sampling: 1e-9,
            })
        };
        forces
            .map(|force| YieldEstimates {
                slip: estimate(force),
                peak: None,
                sliding_friction: None,
            })
            .to_vec()
    }

    #[test]
    fn a_linear_approach_is_removed_and_recognised() {
        let runs = estimates([10.4, 10.2, 10.1, 10.2003, 10.1999]);
        let result = extrapolate(&runs, 100.0, |run| run.slip).unwrap();
        assert!((result.force - 10.0).abs() < 1e-12);
        assert!((result.order - 1.0).abs() < 1e-12);
        assert!(result.budget.wall_speed < 1e-12);
        assert!((result.budget.time_step - 3e-4).abs() < 1e-12);
        assert!((result.budget.preparation - 1e-4).abs() < 1e-12);
        assert!((result.budget.sampling - 5e-9).abs() < 1e-15);
    }

    #[test]
    fn curvature_in_the_speed_shows_in_the_budget() {
        let runs = estimates([10.4 + 0.16, 10.2 + 0.04, 10.1 + 0.01, 10.24, 10.24]);
        let result = extrapolate(&runs, 100.0, |run| run.slip).unwrap();
        assert!((result.force - 10.0).abs() < 1e-12);
        assert!((result.budget.wall_speed - 0.02).abs() < 1e-12);
    }

    #[test]
    fn an_estimator_missing_from_one_run_is_missing() {
        let runs = estimates([1.0; 5]);
        assert_eq!(extrapolate(&runs, 1.0, |run| run.peak), None);
    }
}
