//! Extrapolates a few runs at finite wall speed to the quasi-static yield force and its uncertainty.

use super::budget::Budget;
use super::runs::{MIDDLE_RUN, RunRoles, SPEEDS};
use crate::series::{Estimate, PrintedDigits, YieldEstimates, value_at_zero, weights_at_zero};
use crate::study::ROUNDING;
use crate::theory::{SpeedExcess, bracketed_root};
use serde::Serialize;

/// A yield force at vanishing wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolation {
    /// F = f/(m g), extrapolated with the parabola through the three speeds.
    pub force: f64,
    /// The same force, extrapolated with the straight line through the two slower speeds.
    pub first_order: f64,
    /// The parts of its uncertainty.
    pub budget: Budget,
    /// The order at which the differences between the speeds shrink.
    pub order: ConvergenceOrder,
}

impl Extrapolation {
    /// Uncertainty of an approach that is not quite of first order in the speed: the excess of the slowest run over the
    /// limit, times the deviation of the observed order from 1. Contact 2–3 opens over some time, which makes the
    /// approach less regular than that of a yield with c = 0.
    pub(crate) fn wrong_order(&self, slowest: f64) -> f64 {
        let order = self.order.observed.unwrap_or(ConvergenceOrder::EXPECTED);
        (slowest - self.force).abs() * (order - ConvergenceOrder::EXPECTED).abs()
    }
}

/// The quantity that a yield force is read off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Estimator {
    /// The onset of slip at the floor, which needs least extrapolation.
    SlipOnset,
    /// The peak of f, the paper's definition. The only estimator for a stack that begins at the verge of slip, and so
    /// slips without yielding before the peak.
    Peak,
}

impl Estimator {
    /// The estimate of this force in one run.
    pub(crate) fn read(self, run: &YieldEstimates) -> Option<Estimate> {
        match self {
            Self::SlipOnset => run.slip,
            Self::Peak => run.peak,
        }
    }

    /// What the wall adds to it per unit of wall speed, to first order.
    pub(crate) fn excess(self, of_both: &SpeedExcess) -> f64 {
        match self {
            Self::SlipOnset => of_both.onset,
            Self::Peak => of_both.peak,
        }
    }
}

/// Largest ratio of the second-order to the first-order part in the wall speed that is allowed for at the fastest
/// planned speed. The ratio is below about that speed itself, 2e-3; this is 25 times as much.
const CURVATURE: f64 = 0.05;

/// The order of convergence in the wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvergenceOrder {
    /// log₂ of the ratio of successive differences; absent where they are lost in noise.
    pub observed: Option<f64>,
    /// Largest distance of the observed order from the expected one that noise and curvature explain.
    pub allowance: f64,
}

impl ConvergenceOrder {
    /// The order of a single speed, and of differences that are lost in noise.
    pub(super) const NOT_OBSERVED: Self = Self {
        observed: None,
        allowance: f64::INFINITY,
    };

    /// The lag of the springs behind the wall, and with it the error, is linear in the wall speed.
    pub(crate) const EXPECTED: f64 = 1.0;

    /// The order of convergence of forces at three `speeds`, in units of the displacement; `noise` is the uncertainty
    /// of the forces. At the planned speeds the second-order term moves the order by less than 0.01; five times as
    /// much is allowed, and proportionally more at faster speeds.
    fn of(speeds: &[f64; 3], forces: &[f64], noise: f64) -> Self {
        let differences = [forces[0] - forces[1], forces[1] - forces[2]].map(f64::abs);
        let smallest = differences[0].min(differences[1]);
        if smallest <= 2.0 * noise {
            return Self::NOT_OBSERVED;
        }
        let relative_noise = 2.0 * noise / smallest;
        let curvature = CURVATURE * (speeds[0] / SPEEDS[0]).max(1.0);
        Self {
            observed: order(speeds, differences[0] / differences[1]),
            allowance: curvature + 2.0 * relative_noise / std::f64::consts::LN_2,
        }
    }

    /// Lowest and highest order that is expected where the gravity ramp slows down with the wall. What the ramp
    /// leaves behind is of second order: it may exceed a first-order lag that nearly cancels, or reduce that lag by
    /// up to a third at the fastest speed (which gives the order 1/2). The parabola covers both.
    pub(crate) const OF_RAMPS: (f64, f64) = (0.5, 2.0);

    /// Expected orders in words.
    pub fn range((lowest, highest): (f64, f64)) -> String {
        if lowest == highest {
            return lowest.to_string();
        }
        format!("{lowest} to {highest}")
    }

    /// Whether the observed order, if there is one, lies between these.
    pub(crate) fn is_between(&self, (lowest, highest): (f64, f64)) -> bool {
        let (least, most) = (lowest - self.allowance, highest + self.allowance);
        self.observed
            .is_none_or(|observed| (least..=most).contains(&observed))
    }
}

/// The order p at which the differences between three speeds have this `ratio`: (v₁ᵖ − v₂ᵖ)/(v₂ᵖ − v₃ᵖ).
fn order(speeds: &[f64; 3], ratio: f64) -> Option<f64> {
    /// Far beyond every order that a series shows.
    const HIGHEST: f64 = 20.0;
    let [fast, middle, slow] = *speeds;
    if fast / middle == middle / slow {
        return Some(libm::log2(ratio) / libm::log2(fast / middle));
    }
    // Divided by p, so that the order 0, a logarithm, is no exception.
    let power = |speed: f64, order: f64| libm::expm1(order * libm::log(speed / middle));
    let excess = |order: f64| {
        let order = if order == 0.0 { f64::EPSILON } else { order };
        -power(fast, order) / power(slow, order) - ratio
    };
    bracketed_root(excess, -HIGHEST, HIGHEST)
}

/// Largest coordinate in the stack, the top of cylinder 1, in r: its rounding is that of every step.
pub(super) const LARGEST_COORDINATE: f64 = 1.0 + 1.732_050_807_568_877_2;
/// Half a unit of the seventeenth significant digit.
const PRINTED: f64 = 0.5e-16;
/// Largest sum of the magnitudes of the weights that give the slip onset from four rows. The onset comes at most two
/// spacings after the last row, with the weights 10, 20, 15 and 4; the measured friction counts once more.
const ROW_WEIGHTS: f64 = 50.0;

/// Extrapolates one estimator over the runs of a planned measurement, in the order of its cases; `steps` are their
/// numbers of steps. `None` if the estimator is absent from any run.
pub fn extrapolate(
    estimates: &[YieldEstimates],
    steps: &[u64],
    stiffness: f64,
    estimator: impl Fn(&YieldEstimates) -> Option<Estimate>,
) -> Option<Extrapolation> {
    extrapolate_runs(&RunRoles::PLANNED, estimates, steps, stiffness, estimator)
}

/// Like [`extrapolate`], over runs with these `roles`.
pub(crate) fn extrapolate_runs(
    roles: &RunRoles,
    estimates: &[YieldEstimates],
    steps: &[u64],
    stiffness: f64,
    estimator: impl Fn(&YieldEstimates) -> Option<Estimate>,
) -> Option<Extrapolation> {
    let speeds = &roles.speeds;
    let all: Vec<Estimate> = estimates.iter().map(estimator).collect::<Option<_>>()?;
    let by_speed = all.get(..speeds.len())?;
    let change_from_middle = |run: usize| Some((all.get(run)?.force - all[MIDDLE_RUN].force).abs());
    // A run that has a role but is missing leaves no budget.
    let change = |run: Option<usize>| match run {
        Some(run) => change_from_middle(run).map(Some),
        None => Some(None),
    };
    let forces: Vec<f64> = by_speed.iter().map(|estimate| estimate.force).collect();
    let force = value_at_zero(speeds, &forces);
    let first_order = value_at_zero(&speeds[1..], &forces[1..]);
    let weights = weights_at_zero(speeds);
    let amplified = |error: &dyn Fn(&Estimate, usize) -> f64| -> f64 {
        let terms = weights.iter().zip(by_speed).enumerate();
        let terms = terms.map(|(run, (weight, estimate))| weight.abs() * error(estimate, run));
        terms.sum()
    };
    let rounded = |estimate: &Estimate, run: usize| {
        round_off(&estimates[run], estimate, steps[run], stiffness)
    };
    let printed = |estimate: &Estimate, run: usize| printing(&estimates[run], estimate, stiffness);
    let time_step = match (roles.coarse_and_fast, roles.coarse_time_step) {
        (Some(fast), Some(middle)) => Some(change_of_line(&all, [fast, middle])?),
        (_, middle) => change(middle)?,
    };
    let without_shortcuts = roles.plain.map(|plain| change_of_line(&all, plain));
    let budget = Budget {
        wall_speed: (force - first_order).abs(),
        time_step,
        preparation: change(roles.short_ramp)?,
        sampling: amplified(&|estimate, _| estimate.sampling),
        round_off: amplified(&rounded),
        print_precision: amplified(&printed),
        shortcuts: without_shortcuts.unwrap_or(Some(0.0))?,
        convention: None,
    };
    let coarse = |run: usize| estimates[run].printed.is_some();
    let noise = |(run, estimate): (usize, &Estimate)| {
        let printing = if coarse(run) {
            printed(estimate, run)
        } else {
            0.0
        };
        estimate.sampling + rounded(estimate, run) + printing
    };
    let noise = by_speed.iter().enumerate().map(noise).fold(0.0, f64::max);
    // Oscillations that a ramp leaves behind follow no power of the speed.
    let of_ramps = budget.preparation.filter(|_| roles.has_slow_ramps);
    let noise = noise + of_ramps.unwrap_or(0.0);
    Some(Extrapolation {
        force,
        first_order,
        budget,
        order: ConvergenceOrder::of(speeds, &forces, noise),
    })
}

/// Reads the force off the first run and subtracts `added`, what theory expects its wall speed to add to first order,
/// in m g. What is left is of second order. `None` if a run that has a role shows no such force.
pub(crate) fn at_one_speed(
    roles: &RunRoles,
    added: f64,
    estimates: &[YieldEstimates],
    steps: u64,
    stiffness: f64,
    estimator: Estimator,
) -> Option<Extrapolation> {
    let read = |run: usize| estimator.read(estimates.get(run)?);
    let estimate = read(0)?;
    let change = |run: Option<usize>| match run {
        Some(run) => read(run).map(|other| Some((other.force - estimate.force).abs())),
        None => Some(None),
    };
    let force = estimate.force - added;
    let second_order = (CURVATURE * roles.speeds[0] / SPEEDS[0]).min(1.0);
    Some(Extrapolation {
        force,
        first_order: force,
        budget: Budget {
            wall_speed: second_order * added.abs(),
            time_step: change(roles.coarse_time_step)?,
            preparation: change(roles.short_ramp)?,
            sampling: estimate.sampling,
            round_off: round_off(&estimates[0], &estimate, steps, stiffness),
            print_precision: printing(&estimates[0], &estimate, stiffness),
            shortcuts: 0.0,
            convention: None,
        },
        order: ConvergenceOrder::NOT_OBSERVED,
    })
}

/// Rounding of positions over this many `steps` of `run`, a random walk in double precision, as the estimator amplifies
/// it.
fn round_off(run: &YieldEstimates, estimate: &Estimate, steps: u64, stiffness: f64) -> f64 {
    let walk = || ROUNDING * LARGEST_COORDINATE * f64::EPSILON * (steps as f64).sqrt();
    run.position_drift.unwrap_or_else(walk) * stiffness * estimate.sensitivity
}

/// Error of an `estimate` of `run`, in m g, from the last digit that the code prints.
fn printing(run: &YieldEstimates, estimate: &Estimate, stiffness: f64) -> f64 {
    run.printed.map_or(
        PRINTED * LARGEST_COORDINATE * stiffness * estimate.sensitivity,
        |printed| printing_error(&printed, estimate),
    )
}

/// Largest error of an estimate in m g from rows with few `printed` digits. The margin μ n − |t| of a friction below 1
/// is off by two half units.
pub(super) fn printing_error(printed: &PrintedDigits, estimate: &Estimate) -> f64 {
    ROW_WEIGHTS * printed.half_unit * (1.0 + 2.0 * estimate.sensitivity)
}

/// Change, at vanishing wall speed, of the straight line through the two faster runs when `others` at the same speeds
/// take their place; `None` if one of `others` is missing.
fn change_of_line(all: &[Estimate], others: [usize; 2]) -> Option<f64> {
    let straight_line = |runs: [usize; 2]| {
        let [fast, middle] = runs.map(|run| Some(all.get(run)?.force));
        Some(2.0 * middle? - fast?)
    };
    Some((straight_line(others)? - straight_line([0, MIDDLE_RUN])?).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEPS: [u64; 5] = [10_000, 20_000, 40_000, 10_000, 20_000];

    fn estimates(forces: [f64; 5]) -> Vec<YieldEstimates> {
        let estimate = |force| {
            Some(Estimate {
                force,
                sampling: 1e-9,
                sensitivity: 1.0,
            })
        };
        forces
            .map(|force| YieldEstimates {
                slip: estimate(force),
                peak: None,
                sliding_friction: None,
                departure: None,
                pair_friction: None,
                printed: None,
                position_drift: None,
            })
            .to_vec()
    }

    #[test]
    fn a_linear_approach_is_removed_and_recognised() {
        let runs = estimates([10.4, 10.2, 10.1, 10.2003, 10.1999]);
        let result = extrapolate(&runs, &STEPS, 100.0, |run| run.slip).unwrap();
        assert!((result.force - 10.0).abs() < 1e-12);
        let order = result.order.observed.unwrap();
        assert!((order - 1.0).abs() < 1e-12);
        assert!(result.order.is_between((1.0, 1.0)));
        assert!(result.budget.wall_speed < 1e-12);
        assert!((result.budget.time_step.unwrap() - 3e-4).abs() < 1e-12);
        assert!((result.budget.preparation.unwrap() - 1e-4).abs() < 1e-12);
        assert!((result.budget.sampling - 5e-9).abs() < 1e-15);
    }

    #[test]
    fn an_error_of_the_time_step_that_vanishes_with_the_speed_is_none() {
        // Twice the time step: 0.04 more at the fastest speed, 0.0203 at half of it.
        let mut runs = estimates([10.4, 10.2, 10.1, 10.2203, 10.2]);
        runs.push(estimates([10.44; 5])[0]);
        let mut steps = STEPS.to_vec();
        steps.push(5_000);
        let time_step = |coarse_and_fast: Option<usize>| {
            let roles = RunRoles {
                coarse_and_fast,
                ..RunRoles::PLANNED
            };
            let found = extrapolate_runs(&roles, &runs, &steps, 100.0, |run| run.slip)?;
            found.budget.time_step
        };
        assert!((time_step(None).unwrap() - 0.0203).abs() < 1e-12);
        assert!((time_step(Some(5)).unwrap() - 0.0006).abs() < 1e-12);
        assert_eq!(time_step(Some(6)), None);
    }

    #[test]
    fn curvature_in_the_speed_shows_in_the_budget() {
        let runs = estimates([10.4 + 0.16, 10.2 + 0.04, 10.1 + 0.01, 10.24, 10.24]);
        let result = extrapolate(&runs, &STEPS, 100.0, |run| run.slip).unwrap();
        assert!((result.force - 10.0).abs() < 1e-12);
        assert!((result.budget.wall_speed - 0.02).abs() < 1e-12);
    }

    #[test]
    fn a_wrong_order_is_noticed() {
        let runs = estimates([10.0 + 1.6, 10.0 + 0.4, 10.1, 10.4, 10.4]);
        let order = extrapolate(&runs, &STEPS, 100.0, |run| run.slip)
            .unwrap()
            .order;
        assert!((order.observed.unwrap() - 2.0).abs() < 1e-12);
        assert!(!order.is_between((1.0, 1.0)) && order.is_between((1.0, 2.0)));
    }

    #[test]
    fn an_order_below_the_noise_is_not_observed() {
        let runs = estimates([10.0 + 1e-9, 10.0, 10.0 - 1e-9, 10.0, 10.0]);
        let order = extrapolate(&runs, &STEPS, 100.0, |run| run.slip)
            .unwrap()
            .order;
        assert_eq!(order.observed, None);
        assert!(order.is_between((1.0, 1.0)));
    }

    #[test]
    fn an_order_below_what_slow_ramps_leave_behind_is_not_observed() {
        let runs = estimates([10.000_03, 10.000_02, 10.0, 10.0, 10.000_03]);
        let order = |has_slow_ramps: bool| {
            let roles = RunRoles {
                has_slow_ramps,
                ..RunRoles::PLANNED
            };
            let found = extrapolate_runs(&roles, &runs, &STEPS, 100.0, |run| run.slip);
            found.unwrap().order.observed
        };
        assert!((order(false).unwrap() + 1.0).abs() < 1e-3);
        assert_eq!(order(true), None);
    }

    #[test]
    fn an_estimator_missing_from_one_run_is_missing() {
        let runs = estimates([1.0; 5]);
        assert_eq!(extrapolate(&runs, &STEPS, 1.0, |run| run.peak), None);
    }

    #[test]
    fn constants_are_their_definitions() {
        assert_eq!(LARGEST_COORDINATE, 1.0 + 3f64.sqrt());
        assert_eq!(ROUNDING, 1.0 / 12f64.sqrt());
    }

    #[test]
    fn rounding_walks_at_random_and_is_amplified_by_reading_and_extrapolation() {
        let mut runs = estimates([10.4, 10.2, 10.1, 10.2, 10.2]);
        for run in &mut runs {
            run.slip.as_mut().unwrap().sensitivity = 3.0;
        }
        let stiffness = 1e4;
        let result = extrapolate(&runs, &STEPS, stiffness, |run| run.slip).unwrap();
        // Weights 1/3, -2, 8/3 of the parabola through 4 v, 2 v and v.
        let walked: f64 = [(1e4, 1.0 / 3.0), (2e4, 2.0), (4e4, 8.0 / 3.0)]
            .map(|(steps, weight): (f64, f64)| weight * steps.sqrt())
            .iter()
            .sum();
        let one_step = (1.0 + 3f64.sqrt()) * f64::EPSILON / 12f64.sqrt() * stiffness * 3.0;
        let printed = 5.0 * 0.5e-16 * (1.0 + 3f64.sqrt()) * stiffness * 3.0;
        let budget = result.budget;
        assert!((budget.round_off / (one_step * walked) - 1.0).abs() < 1e-12);
        assert!((budget.print_precision / printed - 1.0).abs() < 1e-12);
        // The noise in the order is that of the noisiest run, here the longest.
        let noise = 1e-9 + one_step * 200.0;
        let allowance = ConvergenceOrder::of(&SPEEDS, &[10.4, 10.2, 10.1], noise).allowance;
        assert!((result.order.allowance / allowance - 1.0).abs() < 1e-12);
    }

    #[test]
    fn shortcuts_cost_what_the_straight_line_without_them_says() {
        let estimate = estimates([0.0; 5])[0].slip.unwrap();
        let forces = [10.4, 10.2, 10.1, 10.2, 10.2, 10.41, 10.202];
        let runs: Vec<YieldEstimates> = forces
            .map(|force| YieldEstimates {
                slip: Some(Estimate { force, ..estimate }),
                peak: None,
                sliding_friction: None,
                departure: None,
                pair_friction: None,
                printed: None,
                position_drift: None,
            })
            .to_vec();
        let found = |plain: Option<[usize; 2]>| {
            let roles = RunRoles {
                plain,
                ..RunRoles::PLANNED
            };
            extrapolate_runs(&roles, &runs, &[10_000; 7], 1e2, |run| run.slip)
        };
        // |(2 * 10.202 - 10.41) - (2 * 10.2 - 10.4)|
        let shortcuts = found(Some([5, 6])).unwrap().budget.shortcuts;
        assert!((shortcuts - 0.006).abs() < 1e-12);
        assert_eq!(found(None).unwrap().budget.shortcuts, 0.0);
        assert_eq!(found(Some([6, 7])), None);
    }

    #[test]
    fn an_order_is_observed_as_soon_as_differences_exceed_twice_the_noise() {
        let forces = [2.0, 1.0, 0.5];
        assert_eq!(ConvergenceOrder::of(&SPEEDS, &forces, 0.25).observed, None);
        assert_eq!(
            ConvergenceOrder::of(&SPEEDS, &forces, 0.25).allowance,
            f64::INFINITY
        );
        assert_eq!(
            ConvergenceOrder::of(&SPEEDS, &forces, 0.249).observed,
            Some(1.0)
        );
    }

    #[test]
    fn a_faster_wall_allows_the_order_to_be_off_in_proportion() {
        let forces = [10.4, 10.2, 10.1];
        let allowance = |faster| {
            let speeds = SPEEDS.map(|speed| faster * speed);
            ConvergenceOrder::of(&speeds, &forces, 0.0).allowance
        };
        assert!((allowance(0.5) - 0.05).abs() < 1e-15);
        assert!((allowance(3.0) - 0.15).abs() < 1e-15);
    }

    #[test]
    fn the_order_at_speeds_of_unequal_ratios_is_that_of_the_power() {
        let speeds = [6.0, 2.0, 1.0];
        let found = |law: &dyn Fn(f64) -> f64| {
            let [fast, middle, slow] = speeds.map(law);
            order(&speeds, (fast - middle) / (middle - slow)).unwrap()
        };
        for power in [-3.0, -1.0, 0.5, 1.0, 2.0, 3.5] {
            let order = found(&|speed| libm::pow(speed, power));
            assert!((order - power).abs() < 1e-9, "{power}: {order}");
        }
        let of_logarithm = found(&libm::log);
        assert!(of_logarithm.abs() < 1e-9, "{of_logarithm}");
    }

    #[test]
    fn a_wrong_order_costs_its_deviation_times_the_excess_of_the_slowest_run() {
        let runs = estimates([10.4, 10.2, 10.1, 10.2, 10.2]);
        let linear = extrapolate(&runs, &STEPS, 100.0, |run| run.slip).unwrap();
        let observed = |observed| Extrapolation {
            force: 10.0,
            order: ConvergenceOrder {
                observed,
                ..linear.order
            },
            ..linear
        };
        assert!((observed(Some(1.5)).wrong_order(10.25) - 0.125).abs() < 1e-15);
        assert!((observed(Some(0.25)).wrong_order(9.5) - 0.375).abs() < 1e-15);
        assert_eq!(observed(None).wrong_order(10.25), 0.0);
    }

    #[test]
    fn one_expected_order_is_a_number_and_two_are_a_range() {
        assert_eq!(ConvergenceOrder::range((1.0, 1.0)), "1");
        assert_eq!(
            ConvergenceOrder::range(ConvergenceOrder::OF_RAMPS),
            "0.5 to 2"
        );
    }

    #[test]
    fn one_run_is_read_less_what_its_speed_adds() {
        let mut runs = estimates([10.4, 10.43, 10.39, 0.0, 0.0]);
        for run in &mut runs {
            run.slip.as_mut().unwrap().sensitivity = 3.0;
            run.peak = run.slip.map(|slip| Estimate {
                force: slip.force + 1.0,
                ..slip
            });
        }
        let roles = RunRoles {
            speeds: [1e-3; 3],
            coarse_time_step: Some(1),
            short_ramp: Some(2),
            ..RunRoles::PLANNED
        };
        let found = |roles: &RunRoles, added: f64, estimator| {
            at_one_speed(roles, added, &runs, 10_000, 100.0, estimator)
        };
        let slip = found(&roles, 0.3, Estimator::SlipOnset).unwrap();
        let budget = slip.budget;
        assert!((slip.force - 10.1).abs() < 1e-12 && slip.first_order == slip.force);
        assert_eq!(slip.order, ConvergenceOrder::NOT_OBSERVED);
        // 25 times the speed, times what is subtracted.
        assert!((budget.wall_speed - 0.0075).abs() < 1e-15);
        assert!((budget.time_step.unwrap() - 0.03).abs() < 1e-12);
        assert!((budget.preparation.unwrap() - 0.01).abs() < 1e-12);
        let read = runs[0].slip.unwrap();
        assert_eq!(budget.sampling, read.sampling);
        assert_eq!(budget.round_off, round_off(&runs[0], &read, 10_000, 100.0));
        let printed = 0.5e-16 * (1.0 + 3f64.sqrt()) * 100.0 * 3.0;
        assert!((budget.print_precision / printed - 1.0).abs() < 1e-12);
        assert_eq!((budget.shortcuts, budget.convention), (0.0, None));

        let peak = found(&roles, -0.3, Estimator::Peak).unwrap();
        assert!((peak.force - 11.7).abs() < 1e-12);
        assert!((peak.budget.wall_speed - 0.0075).abs() < 1e-15);
        // At most all of it is uncertain, whatever the speed.
        let fast = RunRoles {
            speeds: [1.0; 3],
            ..roles
        };
        let fast = found(&fast, 0.3, Estimator::SlipOnset).unwrap();
        assert_eq!(fast.budget.wall_speed, 0.3);
        let alone = RunRoles {
            coarse_time_step: None,
            short_ramp: None,
            ..roles
        };
        let alone = found(&alone, 0.3, Estimator::SlipOnset).unwrap().budget;
        assert_eq!((alone.time_step, alone.preparation), (None, None));
        let missing = RunRoles {
            short_ramp: Some(7),
            ..roles
        };
        assert_eq!(found(&missing, 0.3, Estimator::SlipOnset), None);
        let excess = SpeedExcess {
            onset: 1.0,
            peak: 2.0,
        };
        let both = [Estimator::SlipOnset, Estimator::Peak].map(|one| one.excess(&excess));
        assert_eq!(both, [1.0, 2.0]);
    }

    #[test]
    fn few_printed_digits_are_an_error_and_noise() {
        let printed = PrintedDigits {
            digits: 6,
            finest: 6,
            half_unit: 1e-6,
            single: false,
        };
        let mut runs = estimates([10.4, 10.2, 10.1, 10.2, 10.2]);
        for run in &mut runs {
            run.printed = Some(printed);
            run.slip.as_mut().unwrap().sensitivity = 3.0;
        }
        let result = extrapolate(&runs, &STEPS, 100.0, |run| run.slip).unwrap();
        // The weights of rows sum to 50. Each counts half a unit of the wall force and, for the margin, three times
        // two half units.
        let one_run = 50.0 * 7.0 * 1e-6;
        assert!((result.budget.print_precision / (5.0 * one_run) - 1.0).abs() < 1e-12);
        let rounded = round_off(&runs[2], &runs[2].slip.unwrap(), STEPS[2], 100.0);
        let noise = 1e-9 + rounded + one_run;
        let allowance = ConvergenceOrder::of(&SPEEDS, &[10.4, 10.2, 10.1], noise).allowance;
        assert!((result.order.allowance / allowance - 1.0).abs() < 1e-12);
    }

    #[test]
    fn noise_allows_an_order_to_be_off_by_what_it_moves_a_logarithm() {
        // Each difference may be off by 0.002; the smaller one is 0.1.
        let order = ConvergenceOrder::of(&SPEEDS, &[10.4, 10.2, 10.1], 1e-3);
        let expected = 0.05 + 2.0 * 0.02 / 2f64.ln();
        assert!((order.allowance - expected).abs() < 1e-12);
        let at_the_limit = |observed| ConvergenceOrder {
            observed: Some(observed),
            allowance: 0.5,
        };
        assert!(
            at_the_limit(1.5).is_between((1.0, 1.0)) && at_the_limit(0.5).is_between((1.0, 1.0))
        );
        assert!(!at_the_limit(1.5 + 1e-9).is_between((1.0, 1.0)));
    }
}
