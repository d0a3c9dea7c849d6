//! The onset after a common growth of all weights, by the march of the bodies.

use super::march::Loads;
use super::{Problem, at_vanishing_step};
use tristack::model::{Power, TangentialHistory};

/// Steps of the coarsest march; each further one has twice as many.
const STEPS: [usize; 4] = [60, 120, 240, 480];

/// F at the slip of the floor.
fn onset(own: &Problem) -> f64 {
    let weights = Loads::of(own.epsilon(), own.epsilon());
    let stepped = |steps| own.arrival(&[Loads::NONE, weights], steps).1;
    at_vanishing_step(STEPS.map(stepped).to_vec())
}

/// Largest deviation of the follower from this route, in F + 3.
fn worst(problems: &[Problem], closed_at_onset: bool) -> f64 {
    let mut worst = 0.0f64;
    for own in problems {
        let limit = own.limit();
        let found = limit
            .slip_onset
            .unwrap_or_else(|| panic!("{own:?} {limit:?}"));
        assert_eq!(
            limit.bottom_force.unwrap() > 0.0,
            closed_at_onset,
            "{own:?}"
        );
        let expected = onset(own);
        let deviation = ((found - expected) / (expected + 3.0)).abs();
        println!("{own:?}: {found} {expected} {deviation:e}");
        worst = worst.max(deviation);
    }
    worst
}

const ARMS: [[f64; 4]; 3] = [[0.0; 4], [-0.5, 0.0, 0.1, -0.2], [-0.5, -0.5, -1.0, -0.5]];
const HISTORIES: [TangentialHistory; 2] =
    [TangentialHistory::Displacement, TangentialHistory::Force];

#[test]
fn onset_is_that_of_the_unreduced_balances_where_no_contact_closes() {
    let mut problems = Vec::new();
    for (arms, (mu, stiffness)) in
        ARMS.into_iter()
            .zip([(0.21, 137.0), (0.27, 4.1e3), (0.33, 560.0)])
    {
        for history in HISTORIES {
            for (power, stiffening) in [
                (Power::Hertz, false),
                (Power::Hertz, true),
                (Power::SevenQuarters, false),
            ] {
                problems.push(Problem {
                    mu,
                    stiffness,
                    kappa: 4.7,
                    power,
                    history,
                    stiffening,
                    arms,
                    ..Problem::HERTZ
                });
            }
        }
    }
    let worst = worst(&problems, false);
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn onset_is_that_of_the_unreduced_balances_with_a_closed_contact() {
    let mut problems = Vec::new();
    for (arms, (mu, stiffness)) in
        ARMS.into_iter()
            .zip([(0.21, 137.0), (0.25, 4.1e3), (0.28, 90.0)])
    {
        for (history, kappa) in [
            (TangentialHistory::Displacement, 1.3),
            (TangentialHistory::Force, 0.92),
        ] {
            for (power, stiffening) in [
                (Power::Hertz, false),
                (Power::Hertz, true),
                (Power::FiveQuarters, false),
            ] {
                problems.push(Problem {
                    mu,
                    stiffness,
                    kappa,
                    power,
                    history,
                    stiffening,
                    arms,
                    ..Problem::HERTZ
                });
            }
        }
    }
    let worst = worst(&problems, true);
    assert!(worst < 1e-8, "{worst:e}");
}

/// With this stiffness ratio contact 2-3 is closed under the stack's own weight, and open when the floor slips.
#[test]
fn onset_is_that_of_the_unreduced_balances_beyond_the_opening_of_a_contact() {
    let own = Problem {
        mu: 0.31,
        kappa: 1.22,
        history: TangentialHistory::Force,
        floor_ratio: std::f64::consts::SQRT_2,
        ..Problem::HERTZ
    };
    assert!(own.limit().event == tristack::theory::Event::ContactCloses);
    let worst = worst(&[own], false);
    assert!(worst < 1e-8, "{worst:e}");
}
