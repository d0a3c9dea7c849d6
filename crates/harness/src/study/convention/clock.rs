//! Mass, moment of inertia, and the times to which reported velocities belong.

use super::finding::Property;
use super::regression::{Measured, fit};
use crate::code::Declaration;
use crate::model::ContactTest;
use crate::series::{BodyRow, Motion};

/// Properties of the bodies and of the integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Force over acceleration.
    pub mass: Measured,
    /// Torque over angular acceleration.
    pub moment_of_inertia: Measured,
    /// Steps by which the reported velocities lag behind the reported positions: 1/2 in a leapfrog, 0 in
    /// velocity Verlet.
    pub velocity_lag: Measured,
    /// Motions are cut off after multiples of this many steps.
    pub grain: u64,
}

impl Clock {
    /// Fits the motions of all bodies that feel a force, of motions that are cut off after multiples of `grain`
    /// steps.
    ///
    /// With the velocities v_{n−1/2} = (x_n − x_{n−1})/dt, mass and lag s follow from
    /// F_n dt = m (v_{n+1/2} − v_{n−1/2}) and v_n = v_{n−1/2} + (1/2 − s)(v_{n+1/2} − v_{n−1/2}); the inertia
    /// from ω_{n+1} − ω_n = dt [(1/2 + s) M_n + (1/2 − s) M_{n+1}]/I.
    pub fn read(motions: &[(&ContactTest, &Motion)], grain: u64) -> Self {
        let bodies: Vec<(f64, Vec<BodyRow>)> = motions
            .iter()
            .flat_map(|(test, motion)| {
                (0..2).map(|body| {
                    let rows = motion.rows().iter().map(|row| row.bodies()[body]);
                    (test.time_step, rows.collect())
                })
            })
            .collect();
        let mut kicks = Vec::new();
        let mut lags = Vec::new();
        for (dt, rows) in &bodies {
            for window in rows.windows(3).skip(1) {
                let [before, now, after] = [window[0], window[1], window[2]];
                for axis in 0..2 {
                    let earlier = (now.position[axis] - before.position[axis]) / dt;
                    let later = (after.position[axis] - now.position[axis]) / dt;
                    kicks.push(([now.force[axis] * dt], later - earlier));
                    lags.push(([later - earlier], now.velocity[axis] - earlier));
                }
            }
        }
        let [inverse_mass] = fit(&kicks);
        let [advance] = fit(&lags);
        let velocity_lag = Measured::new(0.5 - advance.value, advance.uncertainty);
        let share = velocity_lag.value;
        let mut turns = Vec::new();
        for (dt, rows) in &bodies {
            for window in rows[1..].windows(2) {
                let [now, after] = [window[0], window[1]];
                let torque = (0.5 + share) * now.torque + (0.5 - share) * after.torque;
                turns.push(([torque * dt], after.spin - now.spin));
            }
        }
        let [inverse_inertia] = fit(&turns);
        Self {
            mass: inverse_mass.inverse(),
            moment_of_inertia: inverse_inertia.inverse(),
            velocity_lag,
            grain,
        }
    }

    /// The fitted properties beside the declared ones.
    pub fn properties(&self, declared: &Declaration) -> Vec<Property> {
        let inertia = declared.convention.moment_of_inertia;
        vec![
            Property::new("mass", self.mass, 1.0),
            Property::new("moment_of_inertia", self.moment_of_inertia, inertia),
            Property::new("velocity_lag", self.velocity_lag, declared.velocity_lag),
        ]
    }

    /// Velocity and spin of a body half a step before its position.
    pub fn half_step_earlier(&self, body: &BodyRow, dt: f64) -> ([f64; 2], f64) {
        let back = (0.5 - self.velocity_lag.value) * dt;
        let velocity =
            [0, 1].map(|axis| body.velocity[axis] - back * body.force[axis] / self.mass.value);
        let spin = body.spin - back * body.torque / self.moment_of_inertia.value;
        (velocity, spin)
    }
}
