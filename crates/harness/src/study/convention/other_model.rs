//! What motions show that the model does not have: a couple that resists rolling, and friction without a spring.

use super::contact_frame::ContactRow;
use super::finding::TOLERANCE;
use super::linear_form::sticking;
use super::regression::{Measured, fit};

/// Share of the work of a couple, net of what it gives back, from which on it resists the rolling: 1 of friction, less of a
/// couple that stores some of the work, and about 0 of one whose sign has nothing to do with the rolling.
const RESISTS: f64 = 0.5;

/// Share of the square of a couple that tangential forces explain if it comes from arms that differ between the bodies: all but
/// rounding of it, and much less of a couple that follows the rolling.
const EXPLAINED_BY_ARMS: f64 = 0.9;

/// Share of the work done on a contact that a spring gives back at least: about half of it in the time of the
/// micro-tests, and nothing without a spring.
const GIVEN_BACK: f64 = 0.05;

/// The couple that resists the rolling of two bodies on each other, over the normal force, in r, as sticking `motions`
/// show it; `None` if there is none. Contact forces turn both bodies alike, a couple turns them against each other.
pub fn rolling_couple(motions: &[Vec<ContactRow>]) -> Option<Measured> {
    let rows = motions.iter().flat_map(|rows| sticking(rows));
    let rows: Vec<&ContactRow> = rows.filter(|row| row.other_torque != 0.0).collect();
    let couple = |row: &ContactRow| 0.5 * (row.torque - row.other_torque);
    let rolling = |row: &ContactRow| row.spins[0] - row.spins[1];
    let sum = |term: &dyn Fn(&ContactRow) -> f64| rows.iter().map(|row| term(row)).sum::<f64>();
    let squares = sum(&|row| couple(row) * couple(row));
    let torques = sum(&|row| row.torque * row.torque + row.other_torque * row.other_torque);
    if squares.is_nan() || squares <= TOLERANCE * TOLERANCE * torques {
        return None;
    }
    let terms = rows.iter().map(|row| {
        let force = row.tangential_force;
        ([force, row.overlap * force], couple(row))
    });
    let [of_radius, of_arm] = fit(&terms.collect::<Vec<_>>());
    let left = sum(&|row| {
        let force = (of_radius.value + of_arm.value * row.overlap) * row.tangential_force;
        (couple(row) - force) * (couple(row) - force)
    });
    let is_of_arms = left < (1.0 - EXPLAINED_BY_ARMS) * squares;
    let work = sum(&|row| couple(row) * rolling(row));
    let size = sum(&|row| (couple(row) * rolling(row)).abs());
    if is_of_arms || -work < RESISTS * size {
        return None;
    }
    let terms = rows.iter().map(|row| {
        let against = -row.normal_force.abs() * rolling(row).signum();
        ([against], couple(row))
    });
    let [share] = fit(&terms.collect::<Vec<_>>());
    (share.value > share.uncertainty.max(TOLERANCE)).then_some(share)
}

/// Whether the tangential forces of `motions` only ever oppose the sliding: in those in which the surfaces come to rest,
/// they give back nothing of the work that they have taken, as a stretched spring would.
pub fn has_no_spring(motions: &[Vec<ContactRow>]) -> bool {
    let power = |row: &ContactRow| row.tangential_force * surface_speed(row);
    let comes_to_rest = |rows: &&Vec<ContactRow>| {
        let turns_round =
            |two: &[ContactRow]| surface_speed(&two[0]) * surface_speed(&two[1]) < 0.0;
        rows.windows(2).any(turns_round)
    };
    let rows: Vec<&ContactRow> = motions.iter().filter(comes_to_rest).flatten().collect();
    let all: f64 = rows.iter().map(|row| power(row).abs()).sum();
    let given_back: f64 = rows.iter().map(|row| power(row).max(0.0)).sum();
    all > 0.0 && given_back < GIVEN_BACK * all
}

/// The velocity of the surfaces of bodies with the radius r.
fn surface_speed(row: &ContactRow) -> f64 {
    row.tangential_speed - row.spin()
}

#[cfg(test)]
mod tests {
    use super::super::clock::Clock;
    use super::super::contact_frame::contact_rows;
    use super::super::experiments::{self, ContactKind};
    use super::*;
    use crate::dem::run_contact_test;
    use crate::model::{ContactConvention, ContactTest};
    use crate::series::{Motion, MotionRow};

    /// The gentle motions of a pair by the native code.
    fn motions() -> Vec<(ContactTest, Motion)> {
        let tests = experiments::common(ContactKind::Pair, &ContactConvention::TURNING);
        let tests = tests.into_iter().take(3);
        tests
            .map(|test| (test, run_contact_test(&test).expect("it is finite")))
            .collect()
    }

    fn rows(motions: &[(ContactTest, Motion)]) -> Vec<Vec<ContactRow>> {
        let whole = motions.iter().map(|(test, motion)| (test, motion));
        let clock = Clock::read(&whole.collect::<Vec<_>>(), 1);
        let rows = motions
            .iter()
            .map(|(test, motion)| contact_rows(ContactKind::Pair, test, motion, &clock));
        rows.collect()
    }

    #[test]
    fn the_native_code_has_a_spring_and_no_couple() {
        let rows = rows(&motions());
        assert_eq!(rolling_couple(&rows), None);
        assert!(!has_no_spring(&rows));
    }

    #[test]
    fn a_couple_against_rolling_is_seen_and_arms_that_differ_are_none() {
        let with = |couple: &dyn Fn(&ContactRow) -> f64| {
            let mut rows = rows(&motions());
            for row in rows.iter_mut().flatten() {
                let couple = couple(row);
                row.torque += couple;
                row.other_torque -= couple;
            }
            rolling_couple(&rows)
        };
        let against = |row: &ContactRow| (row.spins[0] - row.spins[1]).signum();
        let found = with(&|row| -0.01 * row.normal_force * against(row)).expect("a couple");
        assert!((found.value - 0.01).abs() < 1e-12, "{found:?}");
        assert_eq!(with(&|row| 0.01 * row.normal_force * against(row)), None);
        assert_eq!(with(&|row| -0.01 * row.tangential_force), None);
    }

    #[test]
    fn friction_without_a_spring_gives_nothing_back() {
        let mut rows = rows(&motions());
        for row in rows.iter_mut().flatten() {
            row.tangential_force = -0.3 * row.normal_force * surface_speed(row).signum();
        }
        assert!(has_no_spring(&rows));
        // Bodies that slide all the time show nothing about a spring.
        for row in rows.iter_mut().flatten() {
            row.tangential_speed = 1.0;
            row.tangential_force = -0.3 * row.normal_force;
        }
        assert!(!has_no_spring(&rows));
    }

    /// A code that damps the bodies reports the forces of contacts, which are larger along the motion than what moves them.
    #[test]
    fn local_damping_is_measured_beside_mass_and_inertia() {
        const SHARE: f64 = 0.2;
        let undamped = |force: f64, speed: f64| match force * speed > 0.0 {
            true => force / (1.0 - SHARE),
            false => force / (1.0 + SHARE),
        };
        let reported = |motion: &Motion| {
            let rows = motion.rows().iter().map(|row| MotionRow {
                fx1: undamped(row.fx1, row.vx1),
                fy1: undamped(row.fy1, row.vy1),
                torque1: undamped(row.torque1, row.spin1),
                fx2: undamped(row.fx2, row.vx2),
                fy2: undamped(row.fy2, row.vy2),
                torque2: undamped(row.torque2, row.spin2),
                ..*row
            });
            let rows: Vec<MotionRow> = rows.collect();
            let steps = rows.len() as u64 - 1;
            Motion::new(rows, steps).expect("it is finite")
        };
        let motions = motions();
        let damped: Vec<Motion> = motions.iter().map(|(_, motion)| reported(motion)).collect();
        let tested = motions.iter().map(|(test, _)| test).zip(&damped);
        let clock = Clock::read(&tested.collect::<Vec<_>>(), 1);
        let share = clock.local_damping.expect("it is seen");
        for (found, expected) in [
            (share, SHARE),
            (clock.mass, 1.0),
            (clock.moment_of_inertia, 0.5),
        ] {
            assert!(
                (found.value - expected).abs() < 1e-9,
                "{found:?} {expected}"
            );
        }
    }
}
