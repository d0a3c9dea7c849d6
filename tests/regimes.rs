//! The regime map: known boundaries, what the events do, and the native DEM on both sides.

use tristack::crosscheck::{THREE_DIGITS, confirm, examine, examined_stacks};
use tristack::dem::{Loading, Until, watch_stack};
use tristack::engine::Interrupt;
use tristack::stack::{CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO, Stack};
use tristack::theory::{
    Boundary, BoundaryPoint, Consequence, Course, Event, Outcome, RegimeMap, Stage, pair_overlap,
    quasistatic_limit,
};
use tristack::verdict::Verdict;

static INTERRUPT: Interrupt = Interrupt::new();

fn boundaries(stack: &Stack) -> Vec<Boundary> {
    Boundary::in_friction(&Course::new(stack), stack)
}

fn boundary_points(count: usize) -> Vec<BoundaryPoint> {
    let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO).into_iter();
    maps.flat_map(|map| map.boundary_points(count, THREE_DIGITS))
        .collect()
}

/// Golden: roots of the closed form, found another way (reference/golden).
#[test]
fn boundaries_are_where_they_are_known_to_be() {
    let known = [
        (1e1, 0.47377),
        (1e2, 0.53994),
        (1e3, 0.54852),
        (1e4, 0.54941),
    ];
    for (stiffness, wall_contact) in known {
        let [own_weight, wall] = boundaries(&Stack::paper(0.3, stiffness))[..] else {
            panic!("two boundaries");
        };
        assert!((wall.floor_friction - wall_contact).abs() < 1e-5);
        assert_eq!(wall.above, Event::WallContact);
        // mu_c/3 and a little more, of first order in epsilon.
        let excess = own_weight.floor_friction - CRITICAL_FRICTION / 3.0;
        assert!(excess > 0.0 && excess < 0.06 / stiffness, "{excess}");
    }
}

#[test]
fn the_first_event_changes_exactly_at_a_boundary() {
    for point in boundary_points(5) {
        let [below, above] = [1.0 - 1e-7, 1.0 + 1e-7]
            .map(|factor| Outcome::of(&point.across.scale(&point.stack, factor)).unwrap());
        let [far_below, far_above] = point.sides;
        assert_eq!(below.regime(), far_below.regime(), "{:?}", point.stack);
        assert_eq!(above.regime(), far_above.regime(), "{:?}", point.stack);
        assert_ne!(below.regime(), above.regime(), "{:?}", point.stack);
    }
}

#[test]
fn a_yield_is_that_of_the_quasistatic_limit() {
    for (mu, stiffness) in [(0.1, 1e2), (0.2, 1e4), (0.3, 1e3), (0.5, 1e1 * 1e1)] {
        let stack = Stack::paper(mu, stiffness);
        let outcome = Outcome::of(&stack).unwrap();
        let limit = quasistatic_limit(&stack, 0.0, 0.0);
        assert_eq!(outcome.first.event, limit.event);
        assert_eq!(outcome.consequence, Consequence::Yields);
        let (force, expected) = (outcome.largest_force.unwrap(), limit.yield_force.unwrap());
        assert!((force / expected - 1.0).abs() < 1e-10);
        assert!((outcome.last.wall_travel / limit.wall_travel.unwrap() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn saturated_force_does_not_depend_on_the_floor() {
    let slippery = |mu| Stack {
        cylinder_friction: 0.4,
        ..Stack::paper(mu, 1e2)
    };
    let expected = 200.0 * pair_overlap(0.4 - CRITICAL_FRICTION, PAPER_STIFFNESS_RATIO) - 1.0;
    for mu in [0.4, 0.5, 0.9, 100.0] {
        let outcome = Outcome::of(&slippery(mu)).unwrap();
        assert_eq!(outcome.consequence, Consequence::Saturates);
        assert!((outcome.largest_force.unwrap() / expected - 1.0).abs() < 1e-12);
    }
    assert!(Outcome::of(&slippery(0.38)).unwrap().largest_force.unwrap() < expected);
}

#[test]
fn force_of_a_stack_that_slips_with_its_fifth_contact_closed_does_not_depend_on_kappa() {
    let outcome = |stiffness_ratio| {
        let stack = Stack {
            stiffness_ratio,
            ..Stack::paper(0.3, 1e2)
        };
        Outcome::of(&stack).unwrap()
    };
    let forces = [0.2, 0.5, 0.9].map(|kappa| outcome(kappa).largest_force.unwrap());
    assert!(
        forces
            .iter()
            .all(|force| force.to_bits() == forces[0].to_bits())
    );
    for kappa in [0.2, 0.5, 0.9] {
        let outcome = outcome(kappa);
        assert_eq!(outcome.consequence, Consequence::Shares);
        assert_eq!(outcome.first.event, Event::ContactCloses);
        assert_eq!(outcome.last.event, Event::FloorSlip);
        assert!(outcome.last.bottom_force > 0.0 && outcome.last.force < forces[0]);
        // T (F + 1) = mu (F + 3) where the contact opens.
        let end = outcome.end.unwrap();
        assert!((end.tangent * (end.force + 1.0) / (0.3 * (end.force + 3.0)) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_stack_without_friction_falls_and_one_with_much_of_it_has_no_peak() {
    let falls = Outcome::of(&Stack::paper(0.05, 1e2)).unwrap();
    assert_eq!(falls.consequence, Consequence::Collapses);
    assert_eq!(falls.first.stage, Stage::OwnWeight);
    let rough = Outcome::of(&Stack::paper(0.6, 1e2)).unwrap();
    assert_eq!(rough.consequence, Consequence::SecondLoadPath);
    assert_eq!([falls.largest_force, rough.largest_force], [None, None]);
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
        let claimed = Outcome::of(&stack).unwrap().last;
        assert!(claimed.bottom_force > 0.0);
        let force = |speed: f64| {
            let loading = Loading {
                gravity_rate: 2e-3,
                wall_speed: speed * claimed.floor_overlap,
                wall_travel: 1.05 * claimed.wall_travel,
                time_step: 0.1,
            };
            let seen = watch_stack(&stack, &loading, Until::LastEvent, || true);
            assert_eq!(seen.last, Some((Event::FloorSlip, Stage::Wall)));
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
