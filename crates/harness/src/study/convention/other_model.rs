//! What motions show that the model does not have: a couple that resists rolling, and friction without a spring.

use super::contact_frame::ContactRow;
use super::finding::TOLERANCE;
use super::linear_form::sticking;
use super::regression::{Measured, fit};

/// Share of the work of a couple that must be taken from the rolling before it counts as a resistance to it. Where a
/// couple stores some of the work it gives that back.
const RESISTS: f64 = 0.5;

/// Share of a couple that tangential forces may explain, if it is not that of arms that differ between the bodies.
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
    Some(share)
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
