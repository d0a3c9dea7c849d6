//! The linear normal law: stiffness, damping, and the times to which overlap and velocity belong.

use super::contact_frame::ContactRow;
use super::growth::exponent;
use super::regression::{Measured, deviations, fit};

/// f_n = k_n δ(t + o dt) − η_n v_n(t − λ dt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearNormalLaw {
    /// k_n.
    pub stiffness: Measured,
    /// η_n.
    pub damping: Measured,
    /// o, lead of the overlap in the force over the reported one, in steps.
    pub overlap_lead: Measured,
    /// λ, lag of the velocity in the force behind the reported overlap, in steps.
    pub velocity_lag: Measured,
    /// q, of the best fit.
    lag_rate: f64,
}

impl LinearNormalLaw {
    /// Fits rows with two time steps.
    ///
    /// With v_n half a step before δ_n, the force is A δ_n − B v_n with A = k_n/(1 + q dt) and
    /// B = (η_n − k_n o dt)/(1 + q dt), q = η_n (1/2 − λ)/m.
    pub fn read(coarse: &[ContactRow], fine: &[ContactRow], mass: f64) -> Self {
        let ([a1, b1], [a2, b2]) = (slopes(coarse), slopes(fine));
        let step = |rows: &[ContactRow]| rows.first().map_or(f64::NAN, |row| row.time_step);
        let (dt1, dt2) = (step(coarse), step(fine));
        let q = (a1.value - a2.value) / (a2.value * dt2 - a1.value * dt1);
        let spread = (a1.uncertainty + a2.uncertainty) / (a1.value * (dt1 - dt2)).abs();
        let stiffness = scaled(a2, 1.0 + q * dt2, a2.value * spread * dt2);
        let (c1, c2) = (b1.value * (1.0 + q * dt1), b2.value * (1.0 + q * dt2));
        let tilt = (c1 - c2) / (dt1 - dt2);
        let tilt_spread = (b1.uncertainty + b2.uncertainty) / (dt1 - dt2).abs();
        let damping = Measured::new(
            c2 - tilt * dt2,
            b2.uncertainty + tilt_spread * dt2 + c2.abs() * spread * dt2,
        );
        Self {
            stiffness,
            damping,
            overlap_lead: Measured::new(-tilt, tilt_spread).over(stiffness),
            velocity_lag: Measured::new(
                0.5 - q * mass / damping.value,
                spread * mass / damping.value,
            ),
            lag_rate: q,
        }
    }

    /// The normal force that the law gives in a row, however much of the reported force is lift.
    pub fn force(&self, row: &ContactRow) -> f64 {
        let (dt, speed) = (row.time_step, row.separation_speed);
        let reported = row.normal_force + row.lift;
        self.spring_part(row) - self.damping.value * speed - self.lag_rate * dt * reported
    }

    /// The spring's part of that force.
    pub fn spring_part(&self, row: &ContactRow) -> f64 {
        let lead = self.overlap_lead.value * row.time_step;
        self.stiffness.value * (row.overlap - lead * row.separation_speed)
    }
}

/// The exponent with which the stiffness grows with the overlap, if it does, in rows with one time step.
pub fn growth(rows: &[ContactRow]) -> Option<Measured> {
    exponent(|p| {
        let pressed = rows.iter().filter(|row| row.normal_force > 0.0);
        let terms = pressed.map(|row| {
            let overlap = row.overlap * libm::pow(row.overlap, p);
            (vec![overlap, -row.separation_speed], row.normal_force)
        });
        deviations(&terms.collect::<Vec<_>>(), 2)
    })
}

fn scaled(measured: Measured, factor: f64, further: f64) -> Measured {
    Measured::new(
        measured.value * factor,
        measured.uncertainty * factor + further,
    )
}

fn slopes(rows: &[ContactRow]) -> [Measured; 2] {
    let pressed = rows.iter().filter(|row| row.normal_force > 0.0);
    let terms: Vec<([f64; 2], f64)> = pressed
        .map(|row| ([row.overlap, -row.separation_speed], row.normal_force))
        .collect();
    fit(&terms)
}

/// The fraction of a pulling normal force that is exerted: f_n/(k_n δ − η_n v_n) in the first row of a fast
/// separation.
pub fn pull(rows: &[ContactRow], law: &LinearNormalLaw) -> Measured {
    let Some(row) = rows.first() else {
        return Measured::UNKNOWN;
    };
    let spring = law.stiffness.value * row.overlap;
    let damping = law.damping.value * row.separation_speed;
    let uncertainty = law.stiffness.uncertainty * row.overlap
        + law.damping.uncertainty * row.separation_speed.abs();
    Measured::new(row.normal_force, 0.0).over(Measured::new(spring - damping, uncertainty))
}
