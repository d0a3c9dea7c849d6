//! Slip onset and peak of stacks whose bottom cylinders touch, κ < 1.077: two forces, and one answer everywhere.

use crate::common::{Bench, json_rows, standard_output};
use proptest::prelude::*;
use tristack::model::HistoryUpdate::{Fixed, Rotated};
use tristack::model::{Arms, ContactArms, ContactConvention, Problem, Stack};
use tristack::theory::{Event, Limit, LoadingOutcome, bracketed_root, quasistatic_limit};

fn stack(mu: f64, stiffness: f64, stiffness_ratio: f64) -> Stack {
    Stack {
        stiffness_ratio,
        ..Stack::paper(mu, stiffness)
    }
}

fn limit(mu: f64, stiffness: f64, stiffness_ratio: f64) -> Limit {
    let stack = stack(mu, stiffness, stiffness_ratio);
    limit_under(stack, ContactConvention::TURNING)
}

fn limit_under(stack: Stack, convention: ContactConvention) -> Limit {
    quasistatic_limit(&Problem::new(stack, convention).expect("values in range"))
}

/// docs/theory.md, section 7.3: the onsets by the closed equation (50), the peaks by (55).
#[test]
fn onset_and_peak_are_those_of_the_table() {
    for (stiffness, kappa, mu, onset, peak) in [
        (1e2, 0.5, 0.2, 1.595_477, 4.532_243),
        (1e2, 1.0, 0.2, 3.997_710, 4.532_243),
        (1e2, 0.5, 0.3, 9.229_083, 47.605_935),
        (1e3, 0.2, 0.25, 1.906_887, 24.116_463),
    ] {
        let limit = limit(mu, stiffness, kappa);
        assert!(
            (limit.slip_onset.unwrap() - onset).abs() < 1e-6,
            "{limit:?}"
        );
        assert!((limit.peak_force.unwrap() - peak).abs() < 1e-6, "{limit:?}");
        assert_eq!(limit.yield_force, limit.peak_force);
        assert!(limit.bottom_force.unwrap() > 0.0);
        assert!(limit.peak_travel > limit.wall_travel);
    }
}

/// The onset on the path (50), by Runge–Kutta steps in T, which shares nothing with the follower.
fn onset_by_tangent(stack: &Stack) -> f64 {
    let (kappa, mu, epsilon) = (stack.stiffness_ratio, stack.floor_friction, stack.epsilon());
    let slope = |t: f64, g: f64| {
        let square = 1.0 + t * t;
        (2.0 * (2.0 - g) / square + kappa * square * (4.0 - 2.0 * t - 3.0 * g))
            / (t * (1.0 + 3.0 * kappa * square))
    };
    let lacking = |t: f64, g: f64| {
        let c = 2.0 - 4.0 * t * (2.0 - g) / (1.0 + t * t);
        3.0 * g * t + t * t - 4.0 * t + 1.0 - mu * (g + c * t + epsilon)
    };
    let step = |t: f64, g: f64, h: f64| {
        let k1 = slope(t, g);
        let k2 = slope(t + 0.5 * h, g + 0.5 * h * k1);
        let k3 = slope(t + 0.5 * h, g + 0.5 * h * k2);
        let k4 = slope(t + h, g + h * k3);
        g + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
    };
    let (mut t, mut g, mut h) = (2.0 - 3f64.sqrt(), 0.0, 1e-5);
    while h > 1e-15 {
        let next = step(t, g, h);
        if lacking(t + h, next) > 0.0 {
            h *= 0.5;
        } else {
            (t, g) = (t + h, next);
        }
    }
    let c = 2.0 - 4.0 * t * (2.0 - g) / (1.0 + t * t);
    2.0 * (g + c * t) / epsilon - 1.0
}

#[test]
fn onset_is_the_one_of_the_closed_equation() {
    for (mu, stiffness, kappa) in [
        (0.3, 1e2, 0.6),
        (0.3, 1e2, 1.0),
        (0.4, 1e2, 0.6),
        (0.2, 1e3, 0.9),
    ] {
        let onset = limit(mu, stiffness, kappa).slip_onset.unwrap();
        let expected = onset_by_tangent(&stack(mu, stiffness, kappa));
        assert!((onset / expected - 1.0).abs() < 1e-9, "{onset} {expected}");
    }
}

/// The unreduced balances of a sliding floor in (ρ, ψ, a, b, c, d, e), by Newton's method with differences.
fn force_at(stack: &Stack, arms: &Arms, angle: f64) -> (f64, f64) {
    let (mu, epsilon) = (stack.floor_friction, stack.epsilon());
    let lacks = |[rho, b, d]: [f64; 3]| {
        let (a, e) = (2.0 - rho, mu * d);
        let c = 2.0 - 2.0 * rho * angle.sin();
        [
            b * (1.0 + arms.pair.torque * a) - e * (1.0 + arms.floor.torque * d),
            a * angle.sin() - b * angle.cos() - e + c,
            2.0 * (a * angle.cos() + b * angle.sin()) - 2.0 * (d - epsilon),
        ]
    };
    let mut state = [1.95, 0.02, 0.1];
    for _ in 0..50 {
        let now = lacks(state);
        let mut columns = [[0.0; 3]; 3];
        for (index, column) in columns.iter_mut().enumerate() {
            let mut moved = state;
            moved[index] += 1e-7;
            let ahead = lacks(moved);
            *column = [0, 1, 2].map(|row| (ahead[row] - now[row]) / 1e-7);
        }
        let step = by_cramer(columns, now);
        state = [0, 1, 2].map(|index| state[index] - step[index]);
    }
    let [rho, _, d] = state;
    (2.0 * d / epsilon - 3.0, 2.0 - 2.0 * rho * angle.sin())
}

fn by_cramer(columns: [[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let determinant = |[u, v, w]: [[f64; 3]; 3]| {
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    };
    let all = determinant(columns);
    [0, 1, 2].map(|index| {
        let mut replaced = columns;
        replaced[index] = right;
        determinant(replaced) / all
    })
}

/// For any arms: no state of a sliding floor with c ≥ 0 bears more than the peak, and one bears as much.
#[test]
fn peak_is_the_largest_force_of_the_unreduced_balances() {
    let arms = |pair: [f64; 2], floor: [f64; 2]| {
        let [pair, floor] =
            [pair, floor].map(|[torque, kinematic]| ContactArms { torque, kinematic });
        Arms { pair, floor }
    };
    for (mu, kappa, arms) in [
        (0.3, 0.6, Arms::PAPER),
        (0.3, 0.6, Arms::reciprocal(-0.5, -0.5)),
        (0.2, 1.0, Arms::reciprocal(-0.5, -1.0)),
        (0.3, 0.6, arms([-0.5, 0.0], [0.0, 0.0])),
        (0.35, 0.4, Arms::reciprocal(0.5, -0.3)),
    ] {
        let stack = stack(mu, 1e2, kappa);
        let limit = limit_under(stack, ContactConvention::with_arms(arms));
        let (onset, peak) = (limit.slip_onset.unwrap(), limit.peak_force.unwrap());
        let from = 2.0 * limit.tangent.unwrap().atan();
        let at_onset = force_at(&stack, &arms, from);
        assert!(
            (at_onset.0 / onset - 1.0).abs() < 1e-9,
            "{at_onset:?} {onset}"
        );
        let closed = |angle: f64| force_at(&stack, &arms, angle).1;
        let opening = bracketed_root(closed, from, from + 0.4).unwrap();
        let angle = |index: u32| from + (opening - from) * f64::from(index) / 1000.0;
        let forces = (0..=1000).map(|index| force_at(&stack, &arms, angle(index)).0);
        let highest = forces.fold(f64::NEG_INFINITY, f64::max);
        assert!(
            (highest / peak - 1.0).abs() < 1e-9,
            "{arms:?}: {highest} {peak}"
        );
    }
}

/// Every command gives the same onset and the same peak; the measured ones agree.
#[test]
fn all_commands_give_one_answer() {
    let bench = Bench::without_codes();
    let row = |line: &str| {
        let text = standard_output(&mut bench.tristack(&format!("{line} --format json")));
        json_rows(&text)[0].clone()
    };
    let number = |row: &serde_json::Value, key: &str| row[key].as_f64().expect("a number");
    let options = "--mu 0.3 --stiffness 1e2 --kappa 0.6";
    let onset_and_peak = |theory: &serde_json::Value| {
        let keys = ["quasistatic.slip_onset", "quasistatic.peak_force"];
        keys.map(|key| number(theory, key))
    };
    let turning = row(&format!("theory {options} --history-update rotated"));
    let [onset, peak] = onset_and_peak(&turning);
    assert!((onset - 12.972_667_35).abs() < 1e-8 && (peak - 47.605_934_92).abs() < 1e-8);
    let theory = row(&format!("theory {options}"));
    let [onset, peak] = onset_and_peak(&theory);
    assert_eq!(
        theory["quasistatic.yield_force"],
        theory["quasistatic.peak_force"]
    );
    assert_eq!(theory["quasistatic"], theory["quasistatic.peak_force"]);
    assert!((number(&turning, "quasistatic.c") - 0.9956).abs() < 1e-4);
    let outcome = LoadingOutcome::of(&stack(0.3, 1e2, 0.6), Fixed).unwrap();
    assert!((outcome.largest_force.unwrap() / peak - 1.0).abs() < 1e-12);
    for line in ["sweep --code native", "crosscheck --codes native"] {
        let row = row(&format!("{line} {options}"));
        assert_eq!(row["verdict"], "agrees");
        assert_eq!(row["reference_onset"], theory["quasistatic.slip_onset"]);
        assert_eq!(row["reference_force"], theory["quasistatic.peak_force"]);
        assert!((number(&row, "slip_onset") / onset - 1.0).abs() < 1e-6);
        // The slowest run is 0.012 m g above the extrapolated peak, and all of that counts, beside 0.007 of the budget.
        let uncertainty = number(&row, "peak_uncertainty");
        assert!((number(&row, "peak_force") - peak).abs() < uncertainty && uncertainty < 0.02);
        assert_eq!(row["yield_force"], row["peak_force"]);
    }
    let run = row(&format!("simulate --code native {options}"));
    assert!(
        (number(&run, "slip_force") / onset - 1.0).abs() < 1e-3,
        "{run}"
    );
    assert!(
        (number(&run, "peak_force") / peak - 1.0).abs() < 1e-2,
        "{run}"
    );
}

/// With c = 0 onset and peak are one number, to the bit.
#[test]
fn onset_is_the_peak_where_nothing_presses_the_bottom_cylinders() {
    for (mu, stiffness) in [(0.12, 1e2), (0.2, 1e4), (0.3, 1e6), (0.5, 1e2)] {
        let limit = limit(mu, stiffness, 2.5);
        assert_eq!([limit.slip_onset, limit.peak_force], [limit.yield_force; 2]);
        assert_eq!(limit.peak_travel, limit.wall_travel);
        assert_eq!(limit.bottom_force, Some(0.0));
        assert!(!limit.rises_after_onset());
    }
}

/// What ends the sliding is said, as in `regimes`: there is an onset, but no yield force.
#[test]
fn a_wall_that_arrives_while_the_floor_slides_leaves_an_onset_and_a_reason() {
    let limit = limit(0.4, 1e2, 0.6);
    assert!(limit.slip_onset.is_some());
    assert_eq!([limit.yield_force, limit.peak_force], [None; 2]);
    assert!(
        limit
            .reason
            .unwrap()
            .contains("the top wall reaches the bottom cylinders")
    );
    let outcome = LoadingOutcome::of(&stack(0.4, 1e2, 0.6), Rotated).unwrap();
    assert_eq!(outcome.largest_force, None);
}

/// Slip under own weight while the bottom cylinders touch: the stack stands, without an onset under the wall.
#[test]
fn a_stack_that_slid_under_its_own_weight_and_stands_has_a_peak_alone() {
    let stack = Stack {
        stiffness_ratio: 0.3,
        ..Stack::paper(0.12, 1e2)
    };
    let limit = limit_under(stack, ContactConvention::TURNING);
    assert_eq!([limit.slip_onset, limit.wall_travel], [None; 2]);
    assert!((limit.yield_force.unwrap() - 0.608_582_4).abs() < 1e-6);
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.12 --stiffness 1e2 --kappa 0.3 --format json";
    let output = bench.tristack(line).output().expect("it runs");
    let row = json_rows(&String::from_utf8(output.stdout).expect("text"))[0].clone();
    let number = |key: &str| row[key].as_f64().expect("a number");
    let apart = (number("yield_force") - limit.yield_force.unwrap()).abs();
    assert!(apart <= number("uncertainty"), "{row}");
    assert_ne!(row["verdict"], "differs");
}

/// The wall of the plan touches so gently that the floor does not slide in any step of the three speeds.
#[test]
fn a_stiff_stack_above_the_critical_friction_is_judged() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.3 --stiffness 1e6 --format json";
    let row = json_rows(&standard_output(&mut bench.tristack(line)))[0].clone();
    assert_eq!(row["verdict"], "agrees");
    assert!(
        row["error"].as_f64().expect("a number").abs() < 1e-9,
        "{row}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    /// `regimes` and the limit are two routes to one number: in closed form from the state in which the contact
    /// just opens, and along the sliding branch.
    #[test]
    fn regimes_and_limit_give_the_same_force(
        mu in 0.05..0.6f64,
        mu_d in 0.2..1.0f64,
        stiffness in 1.0..7.0f64,
        kappa in 0.1..1.2f64,
    ) {
        let stack = Stack { cylinder_friction: mu_d, ..stack(mu, 10f64.powf(stiffness), kappa) };
        let limit = limit_under(stack, ContactConvention::TURNING);
        let outcome = LoadingOutcome::of(&stack, Rotated).unwrap();
        let yields = outcome.last.event == Event::FloorSlip;
        match (outcome.largest_force.filter(|_| yields), limit.yield_force) {
            (Some(force), Some(peak)) => {
                prop_assert!((force / peak - 1.0).abs() < 1e-10, "{} {}", force, peak);
                prop_assert_eq!(limit.event, outcome.first.event);
                prop_assert!(limit.slip_onset.is_none_or(|onset| onset <= peak));
            }
            (force, peak) => prop_assert_eq!(force, peak),
        }
    }
}
