//! The regime map against the native DEM, on both sides of every boundary.

use tristack::code::Interrupt;
use tristack::dem::{Loading, Until, watch_stack};
use tristack::model::{PAPER_STIFFNESS_RATIO, Stack};
use tristack::study::Verdict;
use tristack::study::regimes::{THREE_DIGITS, confirm, examine, examined_stacks};
use tristack::theory::{BoundaryPoint, Event, LoadingOutcome, LoadingPhase, RegimeMap};

static INTERRUPT: Interrupt = Interrupt::new();

fn boundary_points(count: usize) -> Vec<BoundaryPoint> {
    let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO).into_iter();
    maps.flat_map(|map| map.boundary_points(count, THREE_DIGITS))
        .collect()
}

#[test]
fn val_the_dem_agrees_on_both_sides_of_every_boundary() {
    let points = boundary_points(3);
    assert!(points.len() > 25);
    for point in points {
        let confirmation = confirm(&point, &INTERRUPT);
        assert_eq!(confirmation.verdict(), Verdict::Agrees, "{confirmation:?}");
    }
}

#[test]
fn val_the_dem_contradicts_a_boundary_that_is_wrong_by_two_in_a_thousand() {
    for (index, mut point) in boundary_points(2).into_iter().enumerate() {
        let factor = if index.is_multiple_of(2) {
            1.002
        } else {
            0.998
        };
        point.stack = point.across.scale(&point.stack, factor);
        let confirmation = confirm(&point, &INTERRUPT);
        assert_eq!(confirmation.verdict(), Verdict::Differs, "{confirmation:?}");
    }
}

/// The extended follower, at the moment the floor slips with c > 0. Two wall speeds are extrapolated; what
/// remains is the force that one time step adds, less than 1e-6 of F + 3.
#[test]
fn val_the_dem_slips_where_the_path_with_a_closed_contact_says() {
    for (mu, stiffness_ratio) in [(0.3, 0.3), (0.25, 0.8)] {
        let stack = Stack {
            stiffness_ratio,
            ..Stack::paper(mu, 1e2)
        };
        let claimed = LoadingOutcome::of(&stack).unwrap().last;
        assert!(claimed.bottom_force > 0.0);
        let force = |speed: f64| {
            let loading = Loading {
                gravity_rate: 2e-3,
                wall_speed: speed * claimed.floor_overlap,
                wall_travel: 1.05 * claimed.wall_travel,
                time_step: 0.1,
            };
            let seen = watch_stack(&stack, &loading, Until::LastEvent, || true);
            assert_eq!(seen.last, Some((Event::FloorSlip, LoadingPhase::Wall)));
            seen.force
        };
        let extrapolated = 2.0 * force(2e-5) - force(4e-5);
        let error = (extrapolated - claimed.force) / (claimed.force + 3.0);
        println!(
            "mu {mu} kappa {stiffness_ratio}: {extrapolated} {} {error:e}",
            claimed.force
        );
        assert!(error.abs() < 1e-5, "{error:e}");
    }
}

#[test]
fn val_the_dem_bears_the_largest_forces() {
    // One of each kind: yield, saturated, contact 2-3 closed, wall contact, softened.
    for index in [0, 2, 8, 15, 17] {
        let stack = &examined_stacks()[index];
        let examination = examine(stack, &INTERRUPT).unwrap();
        assert_eq!(examination.verdict, Verdict::Agrees, "{examination:?}");
    }
}
