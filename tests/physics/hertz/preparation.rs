//! What a path remembers of the order in which its loads came: docs/theory.md, section 11.2.
//!
//! The weight of cylinder 1 and the force of the wall are one load: what is said of the one holds of the other.

use super::march::Loads;
use super::{Problem, at_vanishing_step};
use std::f64::consts::SQRT_2;
use tristack::model::Power;
use tristack::model::TangentialHistory::{self, Displacement, Force};

/// Steps of the coarsest march; each further one has twice as many.
const STEPS: [usize; 4] = [60, 120, 240, 480];

/// What the march leaves of F + 3, and of a state, where it is the same in theory: it agrees so well with the follower
/// (`unreduced.rs`), and repeats itself to some 1e-11.
const MARCHED: f64 = 1e-10;

/// κ of Poisson's ratio 0.3.
const MINDLIN: f64 = 17.0 / 14.0;

/// The loads of cylinder 1 and of each lower one on the way to their weights, of which they are parts.
type Order = &'static [[f64; 2]];

const TOGETHER: Order = &[[1.0, 1.0]];
const LOWER_FIRST: Order = &[[0.0, 1.0], [1.0, 1.0]];
/// Half of gravity for all, and the rest for cylinder 1 before the others: alone on lower cylinders without weight it would
/// make them slide.
const UPPER_FIRST: Order = &[[0.5, 0.5], [1.0, 0.5], [1.0, 1.0]];
/// Three times gravity, and back.
const OVERSHOOT: Order = &[[3.0, 3.0], [1.0, 1.0]];

/// A stack under its weight, and what follows from it.
#[derive(Debug)]
struct Arrived {
    /// Overlaps, and displacement and rotation of cylinder 2, in the largest of them.
    lengths: [f64; 4],
    /// Shear of pair and floor, in weights.
    shear: [f64; 2],
    /// F at the slip of the floor.
    onset: f64,
}

impl Arrived {
    fn after(order: Order, own: &Problem) -> Self {
        let epsilon = own.epsilon();
        let parts = order
            .iter()
            .map(|&[upper, lower]| Loads::of(upper * epsilon, lower * epsilon));
        let through: Vec<Loads> = std::iter::once(Loads::NONE).chain(parts).collect();
        let marches = STEPS.map(|steps| own.arrival(&through, steps));
        let extrapolated = |read: &dyn Fn(&(super::march::State, f64)) -> f64| {
            at_vanishing_step(marches.iter().map(read).collect())
        };
        let moved = [0, 1, 2, 3].map(|at| extrapolated(&|(state, _)| state.moved[at]));
        let largest = moved
            .iter()
            .fold(0.0, |most: f64, length| most.max(length.abs()));
        Self {
            lengths: moved.map(|length| length / largest),
            shear: [0, 1].map(|at| extrapolated(&|(state, _)| own.shear(state)[at] / epsilon)),
            onset: extrapolated(&|(_, onset)| *onset),
        }
    }

    /// The largest difference of the states.
    fn state_from(&self, other: &Self) -> f64 {
        let pairs = self.lengths.iter().zip(&other.lengths);
        let pairs = pairs.chain(self.shear.iter().zip(&other.shear));
        pairs
            .map(|(own, other)| (own - other).abs())
            .fold(0.0, f64::max)
    }

    /// The difference of the onsets, in F + 3.
    fn onset_from(&self, other: &Self) -> f64 {
        (self.onset - other.onset) / (other.onset + 3.0)
    }
}

/// The differences that another order than all together makes.
fn differences(own: &Problem, order: Order) -> [f64; 2] {
    let [together, other] = [TOGETHER, order].map(|order| Arrived::after(order, own));
    let differences = [other.state_from(&together), other.onset_from(&together)];
    println!(
        "{own:?} {order:?}: {} {} {differences:?}",
        together.onset, other.onset
    );
    differences
}

const HERTZ: Problem = Problem {
    stiffness: 1e2,
    floor_ratio: SQRT_2,
    ..Problem::HERTZ
};

const LINEAR: Problem = Problem {
    power: Power::Linear,
    floor_ratio: 1.0,
    ..HERTZ
};

/// Where contact 2-3 is open, closed, or opens on the way; with any arms of pairs.
#[test]
fn springs_of_constant_stiffness_forget_the_order_if_the_arms_of_the_floor_are_0() {
    for (history, kappa, mu, pair) in [
        (Displacement, 5.25, 0.2, [0.0, 0.0]),
        (Force, 1.3, 0.3, [-0.5, -0.5]),
        (Displacement, 0.5, 0.3, [-0.5, 0.3]),
        (Displacement, 1.0, 0.35, [0.0, 0.0]),
        (Force, 1.0, 0.35, [-0.5, 0.0]),
    ] {
        let own = Problem {
            mu,
            kappa,
            history,
            arms: [pair[0], pair[1], 0.0, 0.0],
            ..LINEAR
        };
        for order in [LOWER_FIRST, UPPER_FIRST] {
            let [state, onset] = differences(&own, order);
            assert!(
                state < MARCHED && onset.abs() < MARCHED,
                "{own:?} {order:?}"
            );
        }
    }
}

/// By its arms a floor sees how deep it is pressed: the kinematic arm in what its spring collects, the torque arm alone in
/// the area that is passed.
#[test]
fn springs_of_constant_stiffness_remember_the_order_by_either_arm_of_the_floor() {
    for (floor, remembered) in [([0.0, -1.0], 1e-5), ([-1.0, 0.0], 1e-7)] {
        let own = Problem {
            stiffness: 10.0,
            kappa: 5.25,
            arms: [0.0, 0.0, floor[0], floor[1]],
            ..LINEAR
        };
        let [state, onset] = differences(&own, LOWER_FIRST);
        assert!(
            state > remembered && onset.abs() > remembered,
            "{floor:?} {state:e} {onset:e}"
        );
    }
}

/// Onsets at 1/ε = 100, arms 0, w = √2 as docs/theory.md, section 11.2, has them: κ, μ; all together, and lower cylinders
/// first, of displacements and of forces.
const ONSETS: [(f64, f64, [f64; 2], [f64; 2]); 4] = [
    (1.3, 0.2, [2.987381, 2.987538], [3.889730, 3.845494]),
    (1.3, 0.3, [23.62444, 23.62485], [27.22847, 27.33283]),
    (MINDLIN, 0.2, [2.811608, 2.811759], [3.760718, 3.683412]),
    (MINDLIN, 0.3, [21.77062, 21.77106], [28.22038, 28.31750]),
];

/// A remembered displacement depends on the order by the area that is passed, a remembered force as such.
#[test]
fn remembered_forces_depend_on_the_order_a_hundred_times_as_much_as_displacements() {
    for (kappa, mu, displacement, force) in ONSETS {
        let depends = |history, known: [f64; 2]| {
            let own = Problem {
                mu,
                kappa,
                history,
                ..HERTZ
            };
            let found = [TOGETHER, LOWER_FIRST].map(|order| Arrived::after(order, &own));
            for (found, known) in found.iter().zip(known) {
                // Half a unit in the last of seven digits.
                let rounding = 0.5e-6 * 10f64.powf(known.log10().floor());
                let deviation = (found.onset - known).abs();
                assert!(deviation < rounding, "{own:?} {found:?} {known}");
            }
            found[1].onset_from(&found[0]).abs()
        };
        let by_area = depends(Displacement, displacement);
        let by_order = depends(Force, force);
        println!("{kappa} {mu}: {by_area:e} {by_order:e}");
        // Measured: 1.5e-5 to 2.6e-5, and 3.1e-3 to 1.1e-2.
        assert!(by_area > 1e-5 && by_order > 3e-3 && by_order > 100.0 * by_area);
    }
}

/// Areas differ by an overlap, relatively, which goes where cylinders are stiff. What a force keeps of the order stays,
/// here in a stack whose contact 2-3 is closed.
#[test]
fn of_stiff_cylinders_remembered_forces_alone_depend_on_the_order() {
    let depends = |history| {
        [1e4, 1e6].map(|stiffness| {
            let own = Problem {
                mu: 0.2,
                kappa: MINDLIN,
                history,
                stiffness,
                ..HERTZ
            };
            differences(&own, LOWER_FIRST)[1].abs()
        })
    };
    // Overlaps under the weight are as ε^(2/3), to their own order.
    let [soft, stiff] = depends(Displacement);
    let exponent = (soft / stiff).log10() / 2.0;
    assert!((exponent - 2.0 / 3.0).abs() < 1e-2, "{exponent}");
    let [soft, stiff] = depends(Force);
    assert!(stiff > soft && soft > 1.5e-2, "{soft:e} {stiff:e}");
}

/// Rescaled springs do not return: measured are 0.04 to 0.24 of a state, and 0.006 to 0.09 of F + 3.
#[test]
fn an_overshoot_of_gravity_is_retraced_unless_springs_are_rescaled() {
    for (kappa, arms) in [
        (5.25, [0.0; 4]),
        (1.3, [-0.5, -0.5, -1.0, -0.5]),
        (MINDLIN, [-0.5, 0.0, 0.0, 0.0]),
    ] {
        for history in TangentialHistory::ALL {
            let own = Problem {
                kappa,
                arms,
                history,
                ..HERTZ
            };
            let [state, onset] = differences(&own, OVERSHOOT).map(f64::abs);
            match history.is_rescaled() {
                false => assert!(state < MARCHED && onset < MARCHED, "{own:?}"),
                true => assert!(state > 0.04 && onset > 5e-3, "{own:?}"),
            }
        }
    }
}
