//! The regime map: known boundaries, and what the events do.

use tristack_theory::model::HistoryUpdate::{Fixed, Rotated};
use tristack_theory::model::{
    CRITICAL_FRICTION, ContactConvention, PAPER_STIFFNESS_RATIO, Problem, Stack,
};
use tristack_theory::theory::{
    Across, Axis, Boundary, BoundaryPoint, CLOSING_STIFFNESS_RATIO, EquilibriumPath, Event,
    FailureMode, Line, LoadingOutcome, LoadingPhase, RegimeMap, bracketed_root, pair_overlap,
    quasistatic_limit, released_frictions,
};

/// Relative distance of the neighbours of a boundary: it is right to three digits.
const THREE_DIGITS: f64 = 5e-4;

fn boundaries(stack: &Stack) -> Vec<Boundary> {
    Boundary::in_friction(&EquilibriumPath::new(stack, Rotated), stack)
}

fn boundary_points(count: usize) -> Vec<BoundaryPoint> {
    let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO, Rotated).into_iter();
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
        let [below, above] = [1.0 - 1e-7, 1.0 + 1e-7].map(|factor| {
            LoadingOutcome::of(&point.across.scale(&point.stack, factor), Rotated).unwrap()
        });
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
        let outcome = LoadingOutcome::of(&stack, Rotated).unwrap();
        let problem = Problem::new(stack, ContactConvention::TURNING).unwrap();
        let limit = quasistatic_limit(&problem);
        assert_eq!(outcome.first.event, limit.event);
        assert_eq!(outcome.failure_mode, FailureMode::Yields);
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
        let outcome = LoadingOutcome::of(&slippery(mu), Rotated).unwrap();
        assert_eq!(outcome.failure_mode, FailureMode::Saturates);
        assert!((outcome.largest_force.unwrap() / expected - 1.0).abs() < 1e-12);
    }
    assert!(
        LoadingOutcome::of(&slippery(0.38), Rotated)
            .unwrap()
            .largest_force
            .unwrap()
            < expected
    );
}

#[test]
fn force_of_a_stack_that_slips_with_its_fifth_contact_closed_does_not_depend_on_kappa() {
    let outcome = |stiffness_ratio| {
        let stack = Stack {
            stiffness_ratio,
            ..Stack::paper(0.3, 1e2)
        };
        LoadingOutcome::of(&stack, Rotated).unwrap()
    };
    let forces = [0.2, 0.5, 0.9].map(|kappa| outcome(kappa).largest_force.unwrap());
    assert!(
        forces
            .iter()
            .all(|force| force.to_bits() == forces[0].to_bits())
    );
    for kappa in [0.2, 0.5, 0.9] {
        let outcome = outcome(kappa);
        assert_eq!(outcome.failure_mode, FailureMode::Shares);
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
    let falls = LoadingOutcome::of(&Stack::paper(0.05, 1e2), Rotated).unwrap();
    assert_eq!(falls.failure_mode, FailureMode::Collapses);
    assert_eq!(falls.first.stage, LoadingPhase::OwnWeight);
    let rough = LoadingOutcome::of(&Stack::paper(0.6, 1e2), Rotated).unwrap();
    assert_eq!(rough.failure_mode, FailureMode::SecondLoadPath);
    assert_eq!([falls.largest_force, rough.largest_force], [None, None]);
}

fn stack(mu: f64, cylinder_friction: f64, stiffness: f64, stiffness_ratio: f64) -> Stack {
    Stack {
        cylinder_friction,
        stiffness_ratio,
        ..Stack::paper(mu, stiffness)
    }
}

/// Forces to the seven digits that the table of `tristack regimes` shows, where the native DEM has confirmed
/// them (tests/snapshots, docs/theory.md, section 7); `None` where it falls, or where the force grows.
#[test]
fn outcomes_are_those_that_the_dem_has_shown() {
    let table = [
        (0.3, 0.7, 1e2, 2.5, "floor-slip", Some(30.22705)),
        (0.45, 0.4, 1e2, 2.5, "cylinder-slip", Some(59.41787)),
        (0.6, 0.5, 1e3, 2.5, "cylinder-slip", Some(791.0639)),
        (
            0.12,
            0.7,
            1e2,
            0.3,
            "contact-closes, then floor-slip under own weight",
            Some(0.608_582_4),
        ),
        (
            0.2,
            0.7,
            1e3,
            0.6,
            "contact-closes, then floor-slip",
            Some(4.847_753),
        ),
        (
            0.3,
            0.7,
            1e2,
            1.0,
            "contact-closes, then floor-slip",
            Some(47.60593),
        ),
        (
            0.6,
            0.32,
            1e2,
            0.3,
            "contact-closes, then cylinder-slip under own weight",
            Some(54.5),
        ),
        (0.6, 0.7, 1e1, 2.5, "wall-contact", None),
        (0.78, 1.0, 1e2, 10.0, "floor-slip", Some(28.62661)),
        (0.08953, 0.7, 1e2, 0.3, "floor-slip under own weight", None),
    ];
    for (mu, mu_d, stiffness, kappa, regime, force) in table {
        let outcome = LoadingOutcome::of(&stack(mu, mu_d, stiffness, kappa), Rotated).unwrap();
        assert_eq!(outcome.regime().to_string(), regime, "{mu} {kappa}");
        assert_eq!(
            outcome.largest_force.is_some(),
            force.is_some(),
            "{mu} {kappa}"
        );
        if let (Some(largest), Some(force)) = (outcome.largest_force, force) {
            assert!(
                (largest / force - 1.0).abs() < 2e-7,
                "{mu} {kappa}: {largest}"
            );
        }
    }
}

#[test]
fn a_stack_that_passes_its_maximum_before_it_slips_softens() {
    let overlap = |tangent: f64| pair_overlap(tangent - CRITICAL_FRICTION, 10.0);
    let outcome = LoadingOutcome::of(&stack(0.78, 1.0, 1e2, 10.0), Rotated).unwrap();
    assert_eq!(outcome.failure_mode, FailureMode::Softens);
    assert!(outcome.largest_force.unwrap() > outcome.end.unwrap().force * (1.0 + 1e-9));
    // The largest force of the path is 2 max G/epsilon - 1, where the right-hand side of its equation vanishes.
    let slope = |tangent: f64| {
        let square = 1.0 + tangent * tangent;
        4.0 / square - overlap(tangent) * (2.0 / square + 10.0 * square)
    };
    let highest = 200.0 * overlap(bracketed_root(slope, 0.3, 1.0).unwrap()) - 1.0;
    assert!((outcome.largest_force.unwrap() / highest - 1.0).abs() < 1e-12);
}

/// Where neither friction suffices from the start, floor needs e/d = T/3 and cylinders b/a = T.
#[test]
fn of_two_contacts_that_are_too_smooth_the_one_that_lacks_more_slides() {
    let first = |mu, mu_d| {
        let outcome = LoadingOutcome::of(&stack(mu, mu_d, 1e2, 2.5), Rotated).unwrap();
        assert_eq!(outcome.failure_mode, FailureMode::Collapses);
        assert_eq!(outcome.first.wall_travel, 0.0);
        outcome.first.event
    };
    assert_eq!(first(0.05, 0.2), Event::FloorSlip);
    assert_eq!(first(0.08, 0.2), Event::CylinderSlip);
    // 3 mu = mu_d but for the deformation.
    assert_eq!(first(0.0499, 0.15), Event::FloorSlip);
    assert_eq!(first(0.0501, 0.15), Event::CylinderSlip);
}

/// y = rho sin(psi) - 1 and the ratios of forces at the two ends of the path, from T and G alone.
#[test]
fn course_knows_its_state_at_rest_and_at_wall_contact() {
    let stack = stack(0.3, 0.7, 1e2, 2.5);
    let path = EquilibriumPath::new(&stack, Rotated);
    let overlap = |tangent: f64| pair_overlap(tangent - CRITICAL_FRICTION, 2.5);
    let outward = |tangent: f64| (2.0 - overlap(tangent)) * (2.0 * tangent.atan()).sin() - 1.0;
    let at_rest = |tangent: f64| 2.0 * overlap(tangent) - 0.01;
    let rest = bracketed_root(at_rest, CRITICAL_FRICTION, 1.0).unwrap();
    assert!((path.settled_pair_ratio() - rest).abs() < 1e-12);
    assert!((path.settled_outward() - outward(rest)).abs() < 1e-12);
    let above = |tangent: f64| {
        let rise = (2.0 - overlap(tangent)) * (2.0 * tangent.atan()).cos();
        rise - (2.0 * overlap(tangent) - 0.01)
    };
    let contact = bracketed_root(above, CRITICAL_FRICTION, 1.0).unwrap();
    assert!((path.wall_contact_pair_ratio().unwrap() - contact).abs() < 1e-12);
    assert!((path.wall_contact_outward().unwrap() - outward(contact)).abs() < 1e-12);
}

#[test]
fn a_path_without_wall_contact_has_no_state_there() {
    // So compliant that the springs never bear what the wall would need.
    let path = EquilibriumPath::new(&stack(0.3, 0.7, 1e2, 1e3), Rotated);
    assert_eq!(path.wall_contact_pair_ratio(), None);
    assert_eq!(path.wall_contact_outward(), None);
}

#[test]
fn axes_reach_what_they_are_named_after() {
    let base = stack(0.3, 0.7, 1e2, 2.5);
    let table = [
        (Axis::Stiffness, "stiffness", 1e2, stack(0.3, 0.7, 5.0, 2.5)),
        (
            Axis::CylinderFriction,
            "mu_d",
            0.7,
            stack(0.3, 5.0, 1e2, 2.5),
        ),
        (
            Axis::StiffnessRatio,
            "kappa",
            2.5,
            stack(0.3, 0.7, 1e2, 5.0),
        ),
    ];
    for (axis, name, value, changed) in table {
        assert_eq!(axis.as_str(), name);
        assert_eq!(axis.get(&base), value);
        assert_eq!(axis.set(&base, 5.0), changed);
        assert_eq!(axis.is_logarithmic(), axis != Axis::CylinderFriction);
        assert_eq!(
            Across::Axis(axis).scale(&base, 2.0),
            axis.set(&base, 2.0 * value)
        );
    }
    assert_eq!(
        Across::Friction.scale(&base, 2.0),
        stack(0.6, 0.7, 1e2, 2.5)
    );
}

#[test]
fn a_map_spreads_its_values_over_the_scale_of_its_axis() {
    let ratios = RegimeMap::standard(3.0, Rotated).map(|map| map.base.stiffness_ratio);
    assert_eq!(ratios, [3.0; 3]);
    let [over_stiffness, over_friction, over_ratio] = RegimeMap::standard(2.5, Rotated);
    let close = |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-12);
    let all_close = |values: Vec<f64>, expected: &[f64]| {
        assert_eq!(values.len(), expected.len());
        values
            .iter()
            .zip(expected)
            .for_each(|(&value, &expected)| close(value, expected));
    };
    all_close(over_stiffness.axis_values(5), &[1e1, 1e2, 1e3, 1e4, 1e5]);
    all_close(over_friction.axis_values(4), &[0.2, 0.4, 0.6, 0.8]);
    all_close(over_ratio.friction_values(3), &[0.02, 0.41, 0.8]);
    assert_eq!(over_friction.axis_values(1), [0.2]);
    close(over_stiffness.width((1e2, 1e4)), 1e2f64.ln());
    close(over_friction.width((0.3, 0.5)), 0.2);
    close(over_stiffness.middle((1e2, 1e4)), 1e3);
    close(over_friction.middle((0.3, 0.5)), 0.4);
    assert_eq!(over_ratio.stack(5.0, 0.4), stack(0.4, 0.7, 1e2, 5.0));
}

#[test]
fn boundaries_beside_the_map_are_left_out() {
    let [map, ..] = RegimeMap::standard(2.5, Rotated);
    let frictions = |range| {
        let narrow = RegimeMap {
            frictions: range,
            ..map
        };
        let boundaries = narrow.friction_boundaries(1e2).into_iter();
        boundaries
            .map(|boundary| boundary.floor_friction)
            .collect::<Vec<_>>()
    };
    let all = frictions((0.02, 0.8));
    assert_eq!(all.len(), 2);
    assert_eq!(frictions((0.02, 0.3)), all[..1]);
    assert_eq!(frictions((0.3, 0.8)), all[1..]);
    assert_eq!(frictions((all[0], all[1])), all);
}

#[test]
fn lines_are_where_their_conditions_hold() {
    let [over_stiffness, over_friction, over_ratio] = RegimeMap::standard(2.5, Rotated);
    assert_eq!(over_stiffness.lines(), []);
    let path = EquilibriumPath::new(&stack(0.3, 0.7, 1e2, 2.5), Rotated);
    let [
        Line::CylindersBearTheirWeight(weight),
        Line::WallArrivesAsCylindersSlip(wall),
    ] = over_friction.lines()[..]
    else {
        panic!("two lines: {:?}", over_friction.lines());
    };
    assert!((weight - path.settled_pair_ratio()).abs() < 1e-12);
    assert!((wall - path.wall_contact_pair_ratio().unwrap()).abs() < 1e-12);
    let [
        Line::WallArrivesAsCylindersSlip(ratio),
        Line::ContactCloses(CLOSING_STIFFNESS_RATIO),
    ] = over_ratio.lines()[..]
    else {
        panic!("two lines: {:?}", over_ratio.lines());
    };
    let at_wall =
        EquilibriumPath::new(&stack(0.3, 0.7, 1e2, ratio), Rotated).wall_contact_pair_ratio();
    assert!((at_wall.unwrap() - 0.7).abs() < 1e-10);
    let above = RegimeMap {
        range: (1.1, 2.0),
        ..over_ratio
    };
    assert_eq!(above.lines(), []);
}

/// To the three digits of the table of `tristack regimes`, where the native DEM has confirmed them.
#[test]
fn a_line_matters_from_the_friction_on_that_it_takes_to_get_there() {
    let [_, over_friction, over_ratio] = RegimeMap::standard(2.5, Rotated);
    let lowest = |map: &RegimeMap| -> Vec<f64> {
        let lines = map.lines().into_iter();
        lines.map(|line| map.lowest_friction_of(line)).collect()
    };
    let points = |map: &RegimeMap, count| {
        let points = map.boundary_points(count, THREE_DIGITS).into_iter();
        let on_lines = points.filter(|point| point.across != Across::Friction);
        on_lines.map(|point| point.stack).collect::<Vec<_>>()
    };
    let [weight, wall] = lowest(&over_friction)[..] else {
        panic!("two lines");
    };
    // e/d = T/3 at rest; at wall contact the boundary between floor slip and wall contact.
    assert!((weight - 0.089_759_4).abs() < 1e-6);
    assert!((wall - 0.539_936).abs() < 1e-6);
    let shown = points(&over_friction, 2);
    assert_eq!(shown.len(), 4);
    let quarter = |lowest: f64, part: f64| lowest + (0.8 - lowest) * part;
    let expected = [(weight, 0.25), (weight, 0.75), (wall, 0.25), (wall, 0.75)];
    for (stack, (lowest, part)) in shown.iter().zip(expected) {
        assert!((stack.floor_friction - quarter(lowest, part)).abs() < 1e-12);
    }
    // A quarter of the way up, where that table begins.
    for (lowest, shown) in lowest(&over_ratio).into_iter().zip([0.708, 0.267]) {
        assert!((quarter(lowest, 0.25) - shown).abs() < 5e-4, "{lowest}");
    }
    // A map that begins above the lowest friction shows a line from its own edge on.
    let high = RegimeMap {
        frictions: (0.7, 0.8),
        ..over_friction
    };
    assert_eq!(lowest(&high), [0.7, 0.7]);
}

#[test]
fn neighbours_lie_on_both_sides_at_the_distance_asked_for() {
    for point in boundary_points(2) {
        let value = |stack: &Stack| match point.across {
            Across::Friction => stack.floor_friction,
            Across::Axis(axis) => axis.get(stack),
        };
        let [below, above] = point
            .neighbours()
            .map(|stack| value(&stack) / value(&point.stack));
        assert!((below - (1.0 - THREE_DIGITS)).abs() < 1e-12);
        assert!((above - (1.0 + THREE_DIGITS)).abs() < 1e-12);
        let sides = point
            .neighbours()
            .map(|stack| LoadingOutcome::of(&stack, Rotated).unwrap());
        assert_eq!(point.sides, sides);
    }
}

/// At the values found, contact 2-3 just opens (y = 0), or the released stack reaches the wall at T = mu_d.
#[test]
fn reopenings_are_where_the_fifth_contact_just_opens() {
    let [_, over_friction, over_ratio] = RegimeMap::standard(2.5, Rotated);
    let values = over_ratio.reopenings();
    assert_eq!(values.len(), 2, "{values:?}");
    let path = |kappa| EquilibriumPath::new(&stack(0.3, 0.7, 1e2, kappa), Rotated);
    assert!(path(values[0]).settled_outward().abs() < 1e-12);
    assert!(path(values[1]).wall_contact_outward().unwrap().abs() < 1e-12);
    let [wall_tangent] = over_friction.reopenings()[..] else {
        panic!("one value: {:?}", over_friction.reopenings());
    };
    // T where G0 = 2 - (1 + T^2)/(2T) and rho cos(psi) = 2 G0 - epsilon.
    let overlap = 2.0 - (1.0 + wall_tangent * wall_tangent) / (2.0 * wall_tangent);
    let rise = (2.0 - overlap) * (2.0 * wall_tangent.atan()).cos();
    assert!((rise - (2.0 * overlap - 0.01)).abs() < 1e-12);
}

/// (R6): with c > 0 the end is at y = 0, at the largest force.
#[test]
fn a_released_stack_ends_where_its_bottom_cylinders_part() {
    for (mu, mu_d) in [(0.3, 0.7), (0.6, 0.32)] {
        let stack = stack(mu, mu_d, 1e2, 0.3);
        let outcome = LoadingOutcome::of(&stack, Rotated).unwrap();
        let end = outcome.end.unwrap();
        let overlap = 2.0 - (1.0 + end.tangent * end.tangent) / (2.0 * end.tangent);
        let angle = 2.0 * end.tangent.atan();
        assert!(((2.0 - overlap) * angle.sin() - 1.0).abs() < 1e-12);
        assert!((end.force - (200.0 * overlap - 1.0)).abs() < 1e-9);
        assert!((end.floor_overlap - (end.force + 3.0) * 0.005).abs() < 1e-12);
        assert_eq!((end.bottom_force, end.stage), (0.0, LoadingPhase::Wall));
        if end.event == Event::FloorSlip {
            assert!((overlap * (end.tangent - mu) - 0.01 * mu).abs() < 1e-12);
        } else {
            assert!((end.tangent - mu_d).abs() < 1e-15);
        }
        let rise = (2.0 - overlap) * angle.cos();
        let wall = 2.0 - end.floor_overlap + rise - 0.01 * end.force;
        // From 2 + sqrt 3, undeformed, the stack has sunk by some 2 epsilon when the wall touches it.
        let sunk = 2.0 + 3f64.sqrt() - (end.wall_travel + wall);
        assert!(sunk > 0.01 && sunk < 0.04, "{sunk}");
    }
}

#[test]
fn released_frictions_are_where_the_released_stack_stands_and_where_it_meets_wall_or_cylinder() {
    let stack = |mu, mu_d| stack(mu, mu_d, 1e2, 0.3);
    let released = |stack: &Stack| released_frictions(&EquilibriumPath::new(stack, Rotated), stack);
    let (lowest, highest) = released(&stack(0.3, 0.7)).unwrap();
    // The native DEM, on both sides of either: tests/snapshots, `tristack regimes`.
    assert!(lowest > 0.08953 && lowest < 0.08962, "{lowest}");
    assert!(highest > 0.3881 && highest < 0.3885, "{highest}");
    let force = |mu| {
        LoadingOutcome::of(&stack(mu, 0.7), Rotated)
            .unwrap()
            .largest_force
    };
    assert!(force(lowest * (1.0 - 1e-9)).is_none());
    assert!(force(lowest * (1.0 + 1e-9)).unwrap() < 1e-6);
    assert!(force(highest * (1.0 - 1e-9)).is_some() && force(highest * (1.0 + 1e-9)).is_none());
    // T (F + 1) = mu (F + 3) with T = mu_d, where the cylinders slip before the wall arrives.
    let (_, slips) = released(&stack(0.3, 0.32)).unwrap();
    assert!((slips * (54.5 + 3.0) - 0.32 * (54.5 + 1.0)).abs() < 1e-6);
    assert_eq!(released(&stack(0.3, 0.2)), None);
}

/// With springs that nothing turns the branch is integrated. The higher friction then depends on κ; the lower one is that of
/// stacks that slide from the start, and hardly differs from the one of springs that turn.
#[test]
fn released_frictions_of_fixed_springs_are_where_the_followed_stack_stands_and_where_it_meets_the_wall()
 {
    let found = [0.3, 0.9].map(|ratio| {
        let at = |mu: f64| stack(mu, 0.7, 1e2, ratio);
        let path = EquilibriumPath::new(&at(0.3), Fixed);
        let (lowest, highest) = released_frictions(&path, &at(0.3)).unwrap();
        let force = |mu: f64| LoadingOutcome::on(&path, &at(mu)).unwrap().largest_force;
        assert!(force(lowest * (1.0 - 1e-6)).is_none());
        assert!(force(lowest * (1.0 + 1e-6)).unwrap() < 1e-3);
        assert!(force(highest * (1.0 - 1e-6)).is_some());
        assert!(force(highest * (1.0 + 1e-6)).is_none());
        (lowest, highest)
    });
    let turning = EquilibriumPath::new(&stack(0.3, 0.7, 1e2, 0.3), Rotated);
    let (lowest, highest) = released_frictions(&turning, &stack(0.3, 0.7, 1e2, 0.3)).unwrap();
    for (low, high) in found {
        println!("{low} {high}, with springs that turn {lowest} {highest}");
        assert!((low / lowest - 1.0).abs() < 1e-6 && low != lowest);
        assert!((high / highest - 1.0).abs() < 0.1 && high != highest);
    }
    assert_ne!(found[0], found[1]);
}

/// The limit of the crosscheck and the end in the regime map are computed along different ways through the program.
#[test]
fn fixed_springs_end_where_the_limit_says() {
    for (mu, stiffness, ratio) in [
        (0.2, 1e2, 2.5),
        (0.4, 1e3, 2.5),
        (0.3, 1e2, 0.6),
        (0.12, 1e2, 0.3),
    ] {
        let stack = stack(mu, 0.7, stiffness, ratio);
        let outcome = LoadingOutcome::of(&stack, Fixed).unwrap();
        let problem = Problem::new(stack, ContactConvention::PAPER).unwrap();
        let limit = quasistatic_limit(&problem);
        assert_eq!(outcome.first.event, limit.event);
        let difference = outcome.largest_force.unwrap() - limit.yield_force.unwrap();
        assert!(difference.abs() < 1e-9 * (limit.yield_force.unwrap() + 3.0));
    }
    // Cylinders slip while the bottom ones touch: nobody follows that.
    let outcome = LoadingOutcome::of(&stack(0.6, 0.32, 1e2, 0.3), Fixed).unwrap();
    assert!(!outcome.is_end_known && outcome.end.is_none());
}
