//! The limit against the balances of all spheres: that they move alike, that the top one does not turn, and that neighbours
//! do not shear each other comes out.

use super::Problem;
use super::march::Stack;
use tristack_theory::model::{Power, TangentialHistory};

/// Steps of the coarsest march; each further one has twice as many.
const STEPS: [usize; 4] = [40, 80, 160, 320];

/// The value at step 0 of one that is known at steps h, h/2, h/4, …, with an error in even powers of h.
fn at_vanishing_step(mut values: Vec<f64>) -> f64 {
    let mut factor = 4.0;
    while values.len() > 1 {
        let pairs = values.windows(2);
        values = pairs
            .map(|pair| pair[1] + (pair[1] - pair[0]) / (factor - 1.0))
            .collect();
        factor *= 4.0;
    }
    values[0]
}

/// Holds F and c at the onset to this route, where neighbours press each other as said at rest and at the onset.
fn compare(own: Problem, closed: [bool; 2]) {
    // Of F + n + 1; the two show less than 4e-11.
    const BOUND: f64 = 1e-10;
    let limit = own.limit();
    let found = [limit.slip_onset, limit.bottom_force];
    let found = found.map(|force| force.unwrap_or_else(|| panic!("{own:?} {limit:?}")));
    let [rest, _, _] = limit.rest.expect("it stands");
    assert_eq!([rest < own.radius(), found[1] > 0.0], closed, "{own:?}");
    let stack = Stack::new(own, closed[0]);
    let steps = STEPS.map(|steps| {
        // The search begins at what is to be checked; where it ends is for the balances to say.
        let (onset, state) = stack.stepped_onset(steps, found[0]);
        let asymmetry = stack.asymmetry(&state);
        assert!(asymmetry < 1e-9, "{own:?} {asymmetry:e}");
        let neighbours = &stack.contacts[2 * usize::from(own.bodies)];
        let force = stack.normal_force(neighbours, stack.neighbour_overlap(&state).max(0.0));
        [onset, force * own.stiffness]
    });
    for (index, found) in found.into_iter().enumerate() {
        let expected = at_vanishing_step(steps.map(|forces| forces[index]).to_vec());
        let deviation = own.deviation(found, expected);
        println!("{own:?}: {found} {expected} {deviation:.1e}");
        assert!(
            deviation < BOUND,
            "{own:?} {found} {expected} {deviation:e}"
        );
    }
}

const ARMS: [[f64; 4]; 3] = [[0.0; 4], [-0.5, 0.0, 0.1, -0.2], [-0.5, -0.5, -1.0, -0.5]];

/// Springs of displacements and of forces, in a linear law and in Hertz's.
fn laws(kappas: [f64; 3]) -> [Problem; 3] {
    let [linear, displacement, force] = kappas;
    [
        Problem {
            kappa: linear,
            ..Problem::LINEAR
        },
        Problem {
            kappa: displacement,
            ..Problem::HERTZ
        },
        Problem {
            kappa: force,
            history: TangentialHistory::Force,
            ..Problem::HERTZ
        },
    ]
}

fn compare_all(bodies: u8, places: [(f64, f64); 3], kappas: [f64; 3], closed: bool) {
    for (arms, (mu, stiffness)) in ARMS.into_iter().zip(places) {
        for law in laws(kappas) {
            let own = Problem {
                bodies,
                mu,
                stiffness,
                arms,
                ..law
            };
            compare(own, [closed; 2]);
        }
    }
}

#[test]
fn onset_is_that_of_the_balances_of_four_spheres() {
    let places = [(0.22, 130.0), (0.3, 1.7e3), (0.36, 460.0)];
    compare_all(3, places, [3.1, 4.4, 3.7], false);
}

#[test]
fn onset_is_that_of_the_balances_of_five_spheres() {
    let places = [(0.25, 310.0), (0.39, 150.0), (0.44, 2.4e3)];
    compare_all(4, places, [2.2, 4.9, 3.3], false);
}

#[test]
fn onset_is_that_of_the_balances_of_six_spheres() {
    let own = Problem {
        bodies: 5,
        mu: 0.47,
        arms: ARMS[1],
        ..Problem::LINEAR
    };
    compare(own, [false; 2]);
}

#[test]
fn onset_is_that_of_the_balances_of_four_spheres_whose_neighbours_press_each_other() {
    let places = [(0.22, 130.0), (0.28, 900.0), (0.3, 75.0)];
    compare_all(3, places, [0.7, 1.3, 0.9], true);
}

#[test]
fn onset_is_that_of_the_balances_of_five_spheres_whose_neighbours_press_each_other() {
    let places = [(0.25, 310.0), (0.31, 90.0), (0.35, 1.4e3)];
    compare_all(4, places, [0.8, 1.4, 1.0], true);
}

#[test]
fn onset_is_that_of_the_balances_of_six_spheres_whose_neighbours_press_each_other() {
    let own = Problem {
        bodies: 5,
        mu: 0.4,
        kappa: 0.9,
        power: Power::FiveQuarters,
        ..Problem::LINEAR
    };
    compare(own, [true; 2]);
}

#[test]
fn onset_is_that_of_the_balances_beyond_the_parting_of_neighbours() {
    let [linear, _, force] = laws([1.06, 1.5, 1.43]);
    for (bodies, mu, arms, law) in [(3, 0.36, ARMS[0], linear), (4, 0.45, ARMS[1], force)] {
        let stiffness = 120.0;
        let own = Problem {
            bodies,
            mu,
            stiffness,
            arms,
            ..law
        };
        compare(own, [true, false]);
    }
}
