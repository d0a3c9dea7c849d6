//! Tests of the path itself: where it is known, how its legs join, and when contact 2–3 closes.

#![cfg(test)]

use super::super::regimes::CLOSING_STIFFNESS_RATIO;
use super::*;
use crate::model::{Arms, Law, TangentialHistory};

fn path(stiffness: f64, stiffness_ratio: f64, bottom: BottomContact) -> FollowedPath {
    let stack = Stack {
        stiffness_ratio,
        ..Stack::paper(0.3, stiffness)
    };
    let convention = ContactConvention::with_arms(Arms::reciprocal(-0.5, -0.5));
    followed_path(&stack, &convention, bottom)
}

#[test]
fn stations_are_dense_at_the_start_and_evenly_spread_in_the_logarithm_under_the_wall() {
    let path = path(1e2, 2.5, BottomContact::Ignored);
    let stations = path.stations();
    let last_on_ramp = stations
        .iter()
        .position(|&at| at == path.settled())
        .unwrap();
    let (ramp, wall) = (&stations[..last_on_ramp], &stations[last_on_ramp..]);
    assert_eq!(ramp[0], FIRST_STATION);
    for pair in ramp.windows(2) {
        assert_eq!(pair[1], pair[0] + pair[0].min(RAMP_SPACING));
    }
    assert!(path.settled() - ramp[ramp.len() - 1] <= RAMP_SPACING);
    // In units of the angle that gravity turns to first order; the second is 2 % at this stiffness.
    assert!((path.settled() - 1.0).abs() < 0.03, "{}", path.settled());
    let spacing = wall[1] - wall[0];
    assert!(spacing <= WALL_SPACING && spacing > 0.9 * WALL_SPACING);
    for pair in wall.windows(2) {
        assert!((pair[1] - pair[0] - spacing).abs() < 1e-12);
    }
    let end = path.point(wall[wall.len() - 1]).tangent;
    assert!((end - 1.0).abs() < 1e-10, "{end}: T = 1 at 90 degrees");
}

#[test]
fn states_under_gravity_and_under_the_wall_join_where_gravity_is_complete() {
    let path = path(1e2, 2.5, BottomContact::Ignored);
    let settled = path.point(path.settled());
    assert_eq!(settled.wall_force, 0.0);
    assert!(
        (settled.floor_overlap / 0.015 - 1.0).abs() < 1e-12,
        "3 epsilon/2"
    );
    let after = path.point(path.settled() * (1.0 + 1e-9));
    assert!(after.wall_force > 0.0 && after.wall_force < 1e-9);
    assert!((after.floor_overlap - settled.floor_overlap).abs() < 1e-9);
    assert!((after.floor_overlap - (0.015 + 0.5 * after.wall_force)).abs() < 1e-12);
}

#[test]
fn a_stack_too_soft_to_carry_itself_is_followed_to_the_level_of_its_bottom() {
    let path = path(1.0, 1e3, BottomContact::Ignored);
    assert_eq!(path.settled(), f64::INFINITY);
    let stations = path.stations();
    let end = path.point(stations[stations.len() - 1]);
    assert!((end.tangent - 1.0).abs() < 1e-10, "{}", end.tangent);
    assert_eq!(end.wall_force, 0.0);
}

#[test]
fn contact_of_the_bottom_is_closed_from_the_start_below_the_closing_stiffness_ratio() {
    let closed = |factor: f64, bottom| {
        let path = path(1e2, CLOSING_STIFFNESS_RATIO * factor, bottom);
        path.knots[0].closed
    };
    assert!(closed(1.0 - 1e-6, BottomContact::Followed));
    assert!(!closed(1.0 + 1e-6, BottomContact::Followed));
    assert!(!closed(0.5, BottomContact::Ignored));
}

/// So close to κ_c, the contact opens before the first place at which the search looks for a change.
#[test]
fn a_contact_that_opens_within_round_off_of_the_start_is_open_from_there_on() {
    let paths = (0..8).map(|units| {
        let ratio = CLOSING_STIFFNESS_RATIO * (1.0 - f64::from(units) * f64::EPSILON);
        path(1e2, ratio, BottomContact::Followed)
    });
    let closed: Vec<_> = paths.filter(|path| path.knots[0].closed).collect();
    assert!(!closed.is_empty());
    for path in closed {
        assert!(path.knots[1..].iter().all(|knot| !knot.closed));
    }
}

/// At rest the contact 1–2 carries about half a weight w: with N = δ^(3/2) its stiffness is 3/2 (w/2)^(1/3).
#[test]
fn a_stack_of_soft_contacts_says_that_it_is_slow() {
    let stack = Stack::paper(0.3, 1e4);
    let of = |law: Law| {
        let convention = ContactConvention {
            law,
            ..ContactConvention::PAPER
        };
        let limit = followed_limit(&Problem::new(stack, convention).unwrap());
        (limit.time_scale, limit.needs_slow_ramp)
    };
    assert_eq!(of(Law::LINEAR), (1.0, false));
    let remembering = Law {
        history: TangentialHistory::Force,
        ..Law::HERTZ
    };
    let (time_scale, needs_slow_ramp) = of(remembering);
    let expected = (1.5 * libm::cbrt(0.5e-4)).sqrt().recip();
    assert!((time_scale / expected - 1.0).abs() < 1e-14, "{time_scale}");
    assert!(needs_slow_ramp);
}
