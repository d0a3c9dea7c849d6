//! The normal law of any power: exponent, stiffness, and how the damping grows with the overlap.

use super::beside::{Rows, fit_beside};
use super::contact_frame::ContactRow;
use super::regression::{Measured, deviations};
use super::shape::Growth;
use crate::model::Power;

/// Growths of the damping from which the search begins, in units of that of the stiffness p − 1: constant damping, constant
/// damping ratio, viscoelastic damping.
const DAMPINGS: [f64; 3] = [0.0, 0.5, 1.0];
/// Step over which slopes are taken, and rounds of Gauss–Newton, each of which gains at least two digits.
const STEP: f64 = 1e-4;
const ROUNDS: usize = 8;
/// K and η_n.
const COEFFICIENTS: usize = 2;

/// f_n = K δᵖ(t + o dt) − η_n δˢ v_n(t − λ dt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalPowerLaw {
    /// p.
    pub exponent: Measured,
    /// K.
    pub stiffness: Measured,
    /// η_n at an overlap of 1.
    pub damping: Measured,
    /// s.
    pub damping_exponent: Measured,
    /// o, lead of the overlap in the force over the reported one, in steps.
    pub overlap_lead: Measured,
    /// λ, lag of the velocity in the force behind the reported overlap, in steps.
    pub velocity_lag: Measured,
    /// p, s, o and λ of the best fit.
    at: [f64; 4],
    /// Effective mass of the contact.
    mass: f64,
}

impl NormalPowerLaw {
    /// Fits rows with two time steps; `mass` is the effective mass of the contact.
    pub fn read(rows: &[ContactRow], mass: f64) -> Self {
        let pressed: Vec<&ContactRow> = rows.iter().filter(|row| row.normal_force > 0.0).collect();
        let with = |numbers| terms(&pressed, mass, numbers);
        let found = fit_beside(start(&with), STEP, ROUNDS, COEFFICIENTS, with);
        let [exponent, damping_exponent, overlap_lead, velocity_lag] = found.others;
        Self {
            exponent,
            stiffness: found.coefficients[0],
            damping: found.coefficients[1],
            damping_exponent,
            overlap_lead,
            velocity_lag,
            at: found.at,
            mass,
        }
    }

    /// The normal force that the law gives in a row, however much of the reported force is lift.
    pub fn force(&self, row: &ContactRow) -> f64 {
        let parts = parts(row, self.mass, self.at);
        self.stiffness.value * parts[0] + self.damping.value * parts[1]
    }

    /// The spring's part of that force.
    pub fn spring_part(&self, row: &ContactRow) -> f64 {
        self.stiffness.value * parts(row, self.mass, self.at)[0]
    }

    /// Growth of the stiffness dN/dδ in the best fit.
    pub fn stiffening(&self) -> Growth {
        Growth {
            exponent: self.at[0] - 1.0,
            ..Growth::NONE
        }
    }

    /// The fraction of a pulling normal force that is exerted, in the first row of a fast separation.
    pub fn pull(&self, rows: &[ContactRow]) -> Measured {
        let Some(row) = rows.first() else {
            return Measured::UNKNOWN;
        };
        let [p, s] = [self.at[0], self.at[1]].map(|exponent| libm::pow(row.overlap, exponent));
        let (spring, damping) = (
            self.stiffness.value * p,
            self.damping.value * s * row.separation_speed,
        );
        let log = libm::log(row.overlap).abs();
        let left = |own: Measured, exponent: Measured, part: f64| {
            (own.uncertainty / own.value.abs() + exponent.uncertainty * log) * part.abs()
        };
        let uncertainty = left(self.stiffness, self.exponent, spring)
            + left(self.damping, self.damping_exponent, damping);
        Measured::new(row.normal_force, 0.0).over(Measured::new(spring - damping, uncertainty))
    }
}

/// Start of the search: the powers and growths of the damping that fit best, and the lead and lag of a code that is timed as
/// usual.
fn start(with: &impl Fn([f64; 4]) -> Rows) -> [f64; 4] {
    let left = |numbers: &[f64; 4]| {
        deviations(&with(*numbers), COEFFICIENTS).map_or(f64::INFINITY, |(mean, _)| mean)
    };
    let powers = Power::ALL
        .map(Power::value)
        .into_iter()
        .flat_map(|power| DAMPINGS.map(|damping| [power, damping * (power - 1.0), 0.0, 0.5]));
    let best = powers.min_by(|one, other| left(one).total_cmp(&left(other)));
    best.unwrap_or([1.0, 0.0, 0.0, 0.5])
}

/// Terms and force of every row, at p, s, o and λ.
fn terms(rows: &[&ContactRow], mass: f64, numbers: [f64; 4]) -> Rows {
    let terms = rows
        .iter()
        .map(|row| (parts(row, mass, numbers).to_vec(), row.normal_force));
    terms.collect()
}

/// The factors of K and η_n in a row, at p, s, o and λ.
fn parts(row: &ContactRow, mass: f64, [p, s, lead, lag]: [f64; 4]) -> [f64; COEFFICIENTS] {
    let earlier = (0.5 - lag) * row.time_step;
    let speed = row.separation_speed + earlier * (row.normal_force + row.lift) / mass;
    let overlap = row.overlap - lead * row.time_step * row.separation_speed;
    [libm::pow(overlap, p), -speed * libm::pow(overlap, s)]
}
