//! From a few runs at finite wall speed to the quasi-static yield force and its uncertainty.

use super::runs::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, PLAIN_RUNS, SHORT_RAMP_RUN, SPEEDS};
use crate::series::{Estimate, PrintedDigits, YieldEstimates, value_at_zero, weights_at_zero};

/// The parts of the numerical uncertainty, u_num of ASME V&V 20; each is an expected largest error in m g.
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
    /// Rounding of positions in every step, accumulated like a random walk, as the estimator of the force and
    /// the extrapolation amplify it. Contacts restore positions, so that twins of higher precision find ten
    /// times less (tests/round_off.rs).
    pub round_off: f64,
    /// Half a unit of the last digit that the code prints, amplified in the same way: the seventeenth, unless the
    /// series has fewer.
    pub print_precision: f64,
    /// Change of the straight line through the two faster runs without their shortcuts; 0 where none are taken.
    /// Their error is mostly linear in the wall speed, and vanishes with it.
    pub shortcuts: f64,
    /// Change of the exact limit within the uncertainty of arms that were measured; absent where all are declared.
    pub convention: Option<f64>,
}

/// One part of a [`Budget`], as tables and explanations give it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BudgetPart {
    /// Name of its column in files.
    pub name: &'static str,
    /// Name in explanations.
    pub heading: &'static str,
    /// Its formula, in words.
    pub how: &'static str,
    /// Its value in m g; absent where it does not apply.
    pub value: fn(&Budget) -> Option<f64>,
}

impl Budget {
    /// The parts, in order; the uncertainty is their sum.
    pub(crate) const PARTS: [BudgetPart; 8] = [
        BudgetPart {
            name: "wall_speed",
            heading: "wall speed",
            how: "parabola minus straight line",
            value: |budget| Some(budget.wall_speed),
        },
        BudgetPart {
            name: "time_step",
            heading: "time step",
            how: "run 4 minus run 2 (time step doubled)",
            value: |budget| Some(budget.time_step),
        },
        BudgetPart {
            name: "preparation",
            heading: "preparation",
            how: "run 5 minus run 2 (gravity ramp halved)",
            value: |budget| Some(budget.preparation),
        },
        BudgetPart {
            name: "sampling",
            heading: "sampling",
            how: "distance between interpolations, weighted",
            value: |budget| Some(budget.sampling),
        },
        BudgetPart {
            name: "round_off",
            heading: "round-off",
            how: "random walk of rounding, amplified, weighted",
            value: |budget| Some(budget.round_off),
        },
        BudgetPart {
            name: "print_precision",
            heading: "print precision",
            how: "half a unit of the last digit printed, amplified, weighted",
            value: |budget| Some(budget.print_precision),
        },
        BudgetPart {
            name: "shortcuts",
            heading: "shortcuts",
            how: "straight line through runs 6 and 7 (without shortcuts) minus that through 1 and 2",
            value: |budget| Some(budget.shortcuts),
        },
        BudgetPart {
            name: "convention",
            heading: "convention",
            how: "slopes of the limit times the uncertainty of measured arms, if any",
            value: |budget| budget.convention,
        },
    ];

    /// The expanded uncertainty: the sum of the parts, which is never below their root sum of squares, by which V&V 20
    /// combines independent parts.
    pub fn total(&self) -> f64 {
        Self::PARTS
            .iter()
            .filter_map(|part| (part.value)(self))
            .sum()
    }
}

/// A yield force at vanishing wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolation {
    /// F = f/(m g), extrapolated with the parabola through the three speeds.
    pub force: f64,
    /// The same with the straight line through the two slower ones.
    pub first_order: f64,
    /// The parts of its uncertainty.
    pub budget: Budget,
    /// The order at which the differences between the speeds shrink.
    pub order: ConvergenceOrder,
}

/// The order of convergence in the wall speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConvergenceOrder {
    /// log₂ of the ratio of successive differences; absent where they are lost in noise.
    pub observed: Option<f64>,
    /// Largest distance of the observed order from the expected one that noise and curvature explain.
    pub allowance: f64,
}

impl ConvergenceOrder {
    /// The lag of the springs behind the wall, and with it the error, is linear in the wall speed.
    pub(crate) const EXPECTED: f64 = 1.0;

    /// The order of forces at three speeds, each half the one before, known up to `noise`. The term of second order
    /// is smaller than that of first by about the speed itself, at most 2e-3 in units of the displacement;
    /// that moves the order by less than 0.01. Five times as much is allowed.
    fn of(forces: &[f64], noise: f64) -> Self {
        const CURVATURE: f64 = 0.05;
        let differences = [forces[0] - forces[1], forces[1] - forces[2]].map(f64::abs);
        let smallest = differences[0].min(differences[1]);
        if smallest <= 2.0 * noise {
            return Self {
                observed: None,
                allowance: f64::INFINITY,
            };
        }
        let relative_noise = 2.0 * noise / smallest;
        Self {
            observed: Some(libm::log2(differences[0] / differences[1])),
            allowance: CURVATURE + 2.0 * relative_noise / std::f64::consts::LN_2,
        }
    }

    /// Whether the observed order, if there is one, is the expected one.
    pub(crate) fn is_expected(&self) -> bool {
        let off = |observed: f64| (observed - Self::EXPECTED).abs();
        self.observed
            .is_none_or(|observed| off(observed) <= self.allowance)
    }
}

/// Largest coordinate in the stack, the top of cylinder 1, in r: its rounding is that of every step.
pub(super) const LARGEST_COORDINATE: f64 = 1.0 + 1.732_050_807_568_877_2;
/// Root mean square of one rounding, in units of the last place: 1/√12.
const ROUNDING: f64 = 0.288_675_134_594_812_9;
/// Half a unit of the seventeenth significant digit.
const PRINTED: f64 = 0.5e-16;
/// Largest sum of the magnitudes of the weights with which the slip onset follows from four rows: it comes two
/// spacings after the last of them at most, 10 + 20 + 15 + 4; and the measured friction counts once more.
const ROW_WEIGHTS: f64 = 50.0;

/// Extrapolates one estimator over the runs of a measurement, in the order of its cases, which take so many
/// `steps` each. `None` if it is absent from any of them.
pub fn extrapolate(
    estimates: &[YieldEstimates],
    steps: &[u64],
    stiffness: f64,
    estimator: impl Fn(&YieldEstimates) -> Option<Estimate>,
) -> Option<Extrapolation> {
    let all: Vec<Estimate> = estimates.iter().map(estimator).collect::<Option<_>>()?;
    let by_speed = all.get(..SPEEDS.len())?;
    let change_from_middle = |run: usize| Some((all.get(run)?.force - all[MIDDLE_RUN].force).abs());
    let forces: Vec<f64> = by_speed.iter().map(|estimate| estimate.force).collect();
    let force = value_at_zero(&SPEEDS, &forces);
    let first_order = value_at_zero(&SPEEDS[1..], &forces[1..]);
    let weights = weights_at_zero(&SPEEDS);
    let amplified = |error: &dyn Fn(&Estimate, usize) -> f64| -> f64 {
        let terms = weights.iter().zip(by_speed).enumerate();
        let terms = terms.map(|(run, (weight, estimate))| weight.abs() * error(estimate, run));
        terms.sum()
    };
    let rounded = |estimate: &Estimate, run: usize| round_off(estimate, steps[run], stiffness);
    let printed = |estimate: &Estimate, run: usize| {
        let few_digits = estimates[run].printed;
        few_digits.map_or(
            PRINTED * LARGEST_COORDINATE * stiffness * estimate.sensitivity,
            |printed| printing_error(&printed, estimate),
        )
    };
    let budget = Budget {
        wall_speed: (force - first_order).abs(),
        time_step: change_from_middle(COARSE_TIME_STEP_RUN)?,
        preparation: change_from_middle(SHORT_RAMP_RUN)?,
        sampling: amplified(&|estimate, _| estimate.sampling),
        round_off: amplified(&rounded),
        print_precision: amplified(&printed),
        shortcuts: change_without_shortcuts(&all).unwrap_or(0.0),
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
    Some(Extrapolation {
        force,
        first_order,
        budget,
        order: ConvergenceOrder::of(&forces, noise),
    })
}

/// Rounding of positions in so many `steps`, a random walk, as the estimator amplifies it.
fn round_off(estimate: &Estimate, steps: u64, stiffness: f64) -> f64 {
    let per_step = ROUNDING * LARGEST_COORDINATE * f64::EPSILON * stiffness;
    per_step * (steps as f64).sqrt() * estimate.sensitivity
}

/// Largest error of an estimate in m g from rows with few `printed` digits. The margin μ n − |t| of a friction below 1
/// is off by two half units.
pub(super) fn printing_error(printed: &PrintedDigits, estimate: &Estimate) -> f64 {
    ROW_WEIGHTS * printed.half_unit * (1.0 + 2.0 * estimate.sensitivity)
}

/// Change of the straight line through the two faster runs without their shortcuts; `None` if there are no such runs.
fn change_without_shortcuts(all: &[Estimate]) -> Option<f64> {
    let straight_line = |runs: [usize; 2]| {
        let [fast, middle] = runs.map(|run| Some(all.get(run)?.force));
        Some(2.0 * middle? - fast?)
    };
    Some((straight_line(PLAIN_RUNS)? - straight_line([0, MIDDLE_RUN])?).abs())
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
        assert!(result.order.is_expected());
        assert!(result.budget.wall_speed < 1e-12);
        assert!((result.budget.time_step - 3e-4).abs() < 1e-12);
        assert!((result.budget.preparation - 1e-4).abs() < 1e-12);
        assert!((result.budget.sampling - 5e-9).abs() < 1e-15);
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
        assert!(!order.is_expected());
    }

    #[test]
    fn an_order_below_the_noise_is_not_observed() {
        let runs = estimates([10.0 + 1e-9, 10.0, 10.0 - 1e-9, 10.0, 10.0]);
        let order = extrapolate(&runs, &STEPS, 100.0, |run| run.slip)
            .unwrap()
            .order;
        assert_eq!(order.observed, None);
        assert!(order.is_expected());
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
    fn the_budget_lists_its_parts_in_order_and_adds_them_up() {
        let budget = Budget {
            wall_speed: 1.0,
            time_step: 2.0,
            preparation: 4.0,
            sampling: 8.0,
            round_off: 16.0,
            print_precision: 32.0,
            shortcuts: 64.0,
            convention: None,
        };
        let parts = [
            ("wall speed", 1.0),
            ("time step", 2.0),
            ("preparation", 4.0),
            ("sampling", 8.0),
            ("round-off", 16.0),
            ("print precision", 32.0),
            ("shortcuts", 64.0),
        ];
        let named = |budget: &Budget| {
            let parts = Budget::PARTS.into_iter();
            let named = parts.filter_map(|part| Some((part.heading, (part.value)(budget)?)));
            named.collect::<Vec<_>>()
        };
        assert_eq!(named(&budget), parts);
        assert_eq!(budget.total(), 127.0);
        let measured = Budget {
            convention: Some(128.0),
            ..budget
        };
        assert_eq!(named(&measured).last(), Some(&("convention", 128.0)));
        assert_eq!(measured.total(), 255.0);
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
        let allowance = ConvergenceOrder::of(&[10.4, 10.2, 10.1], noise).allowance;
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
            })
            .to_vec();
        let budget = |count: usize| {
            let steps = [10_000; 7];
            let result = extrapolate(&runs[..count], &steps[..count], 1e2, |run| run.slip);
            result.unwrap().budget
        };
        // |(2 * 10.202 - 10.41) - (2 * 10.2 - 10.4)|
        assert!((budget(7).shortcuts - 0.006).abs() < 1e-12);
        assert_eq!(budget(5).shortcuts, 0.0);
    }

    #[test]
    fn an_order_is_observed_as_soon_as_differences_exceed_twice_the_noise() {
        let forces = [2.0, 1.0, 0.5];
        assert_eq!(ConvergenceOrder::of(&forces, 0.25).observed, None);
        assert_eq!(ConvergenceOrder::of(&forces, 0.25).allowance, f64::INFINITY);
        assert_eq!(ConvergenceOrder::of(&forces, 0.249).observed, Some(1.0));
    }

    #[test]
    fn noise_allows_an_order_to_be_off_by_what_it_moves_a_logarithm() {
        // Each of two differences of which the smaller is 0.1 may be off by 0.002.
        let order = ConvergenceOrder::of(&[10.4, 10.2, 10.1], 1e-3);
        let expected = 0.05 + 2.0 * 0.02 / 2f64.ln();
        assert!((order.allowance - expected).abs() < 1e-12);
        let at_the_limit = |observed| ConvergenceOrder {
            observed: Some(observed),
            allowance: 0.5,
        };
        assert!(at_the_limit(1.5).is_expected() && at_the_limit(0.5).is_expected());
        assert!(!at_the_limit(1.5 + 1e-9).is_expected());
    }
}
