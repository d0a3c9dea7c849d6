//! Mass, moment of inertia, and the times to which reported velocities and the forces in a step belong.

use super::finding::{FORCE_LAG, Property, StepEffect, TOLERANCE, VELOCITY_LAG};
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
    /// Steps by which the forces that move the bodies lag behind the positions; `None` if they do not, as in a
    /// leapfrog and in velocity Verlet. In explicit Euler it is 1.
    pub force_lag: Option<Measured>,
    /// Motions are cut off after multiples of this many steps.
    pub grain: u64,
}

impl Clock {
    /// Fits the motions of all bodies that feel a force, of motions that are cut off after multiples of `grain`
    /// steps.
    ///
    /// With the velocities v_{n−1/2} = (x_n − x_{n−1})/dt, mass, lag l of forces and lag s of velocities follow from
    /// [(1 − l) F_n + l F_{n−1}] dt = m (v_{n+1/2} − v_{n−1/2}) and v_n = v_{n−1/2} + (1/2 − s)(v_{n+1/2} − v_{n−1/2});
    /// the inertia from ω_{n+1} − ω_n = dt [(1/2 + s) T_n + (1/2 − s) T_{n+1}]/I with T_n = (1 − l) M_n + l M_{n−1}.
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
                    let forces = [now.force[axis] * dt, before.force[axis] * dt];
                    kicks.push((forces, later - earlier));
                    lags.push(([later - earlier], now.velocity[axis] - earlier));
                }
            }
        }
        let (inverse_mass, force_lag) = Self::read_kicks(&kicks);
        let [advance] = fit(&lags);
        let velocity_lag = Measured::new(0.5 - advance.value, advance.uncertainty);
        let share = velocity_lag.value;
        let mut turns = Vec::new();
        for (dt, rows) in &bodies {
            for window in rows.windows(3) {
                let [before, now, after] = [window[0], window[1], window[2]];
                let [this, next] = [[before, now], [now, after]]
                    .map(|[before, now]| moving(force_lag, before.torque, now.torque));
                let torque = (0.5 + share) * this + (0.5 - share) * next;
                turns.push(([torque * dt], after.spin - now.spin));
            }
        }
        let [inverse_inertia] = fit(&turns);
        Self {
            mass: inverse_mass.inverse(),
            moment_of_inertia: inverse_inertia.inverse(),
            velocity_lag,
            force_lag,
            grain,
        }
    }

    /// Fits the changes of velocities to the forces, times dt, of the same step and of the step before. Returns the
    /// inverse of the mass, and the lag of the forces where one explains the changes to the last digits.
    fn read_kicks(kicks: &[([f64; 2], f64)]) -> (Measured, Option<Measured>) {
        let [same, before] = fit(kicks);
        let sum = Measured::new(
            same.value + before.value,
            same.uncertainty + before.uncertainty,
        );
        let lag = before.over(sum);
        if lag.uncertainty <= TOLERANCE && lag.value.abs() > TOLERANCE {
            return (sum, Some(lag));
        }
        let own = kicks.iter().map(|([same, _], change)| ([*same], *change));
        let [inverse_mass] = fit(&own.collect::<Vec<_>>());
        (inverse_mass, None)
    }

    /// The fitted properties beside the declared ones.
    pub fn properties(&self, declared: &Declaration) -> Vec<Property> {
        let inertia = declared.convention.moment_of_inertia;
        let mut properties = vec![
            Property::new("mass", self.mass, 1.0),
            Property::new("moment_of_inertia", self.moment_of_inertia, inertia),
            Property::new(VELOCITY_LAG, self.velocity_lag, declared.velocity_lag),
        ];
        // Nobody declares it: it is an error of the scheme that vanishes with the step.
        properties.extend(self.force_lag.map(|lag| Property {
            declared: None,
            step_effect: Some(StepEffect {
                at_step: lag.value,
                uncertainty: lag.uncertainty,
                order: 1,
            }),
            ..Property::new(FORCE_LAG, lag, 0.0)
        }));
        properties
    }

    /// The force (torque) that moves a body in a step, from those of the step `before` and of the step itself, `now`.
    pub fn moving(&self, before: f64, now: f64) -> f64 {
        moving(self.force_lag, before, now)
    }

    /// Velocity and spin of a body half a step before its position, from the rows of that step and of the step
    /// `before`.
    pub fn half_step_earlier(&self, before: &BodyRow, body: &BodyRow, dt: f64) -> ([f64; 2], f64) {
        let back = (0.5 - self.velocity_lag.value) * dt;
        let velocity = [0, 1].map(|axis| {
            let force = self.moving(before.force[axis], body.force[axis]);
            body.velocity[axis] - back * force / self.mass.value
        });
        let torque = self.moving(before.torque, body.torque);
        let spin = body.spin - back * torque / self.moment_of_inertia.value;
        (velocity, spin)
    }
}

/// The force that moves a body in a step, from those of the step `before` and of the step itself, `now`.
fn moving(lag: Option<Measured>, before: f64, now: f64) -> f64 {
    lag.map_or(now, |lag| (1.0 - lag.value) * now + lag.value * before)
}
