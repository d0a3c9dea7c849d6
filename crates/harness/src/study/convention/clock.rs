//! Mass, moment of inertia, and the times to which reported velocities and the forces in a step belong.

use super::finding::{FORCE_LAG, LOCAL_DAMPING, Property, StepEffect, TOLERANCE, VELOCITY_LAG};
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
    /// Share of each component of force and torque by which what moves a body is less than it while the body moves
    /// along it, and more while it moves against it (local damping, as Cundall's); `None` if there is none.
    pub local_damping: Option<Measured>,
    /// Motions are cut off after multiples of this many steps.
    pub grain: u64,
}

impl Clock {
    /// Fits the motions of all bodies that feel a force, of motions that are cut off after multiples of `grain`
    /// steps.
    ///
    /// With the velocities v_{n−1/2} = (x_n − x_{n−1})/dt, mass, lag l of forces and lag s of velocities follow from
    /// [(1 − l) F_n + l F_{n−1}] dt = m (v_{n+1/2} − v_{n−1/2}) and v_n = v_{n−1/2} + (1/2 − s)(v_{n+1/2} − v_{n−1/2});
    /// the inertia from ω_{n+1} − ω_n = dt [(1/2 + s) T_n + (1/2 − s) T_{n+1}]/I with T_n = (1 − l) M_n + l M_{n−1}. With
    /// local damping α, F − α |F| sign v takes the place of F, and the same of M.
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
                    kicks.push(Kick {
                        forces,
                        velocities: [earlier, later],
                    });
                    lags.push(([later - earlier], now.velocity[axis] - earlier));
                }
            }
        }
        let Kicked {
            inverse_mass,
            force_lag,
            local_damping,
        } = Kicked::by(&kicks);
        let moving = |before: f64, now: f64, speed: f64| {
            moving(force_lag, before, now) - damped(local_damping, now, speed)
        };
        let [advance] = fit(&lags);
        let velocity_lag = Measured::new(0.5 - advance.value, advance.uncertainty);
        let share = velocity_lag.value;
        let mut turns = Vec::new();
        for (dt, rows) in &bodies {
            for window in rows.windows(3) {
                let [before, now, after] = [window[0], window[1], window[2]];
                if local_damping.is_some() && before.spin * after.spin <= 0.0 {
                    continue;
                }
                let [this, next] = [[before, now], [now, after]]
                    .map(|[before, now]| moving(before.torque, now.torque, now.spin));
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
            local_damping,
            grain,
        }
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
        let damping = self.local_damping;
        properties.extend(damping.map(|share| Property::new(LOCAL_DAMPING, share, 0.0)));
        properties
    }

    /// The component of force (torque) that moves a body in a step, from those of the step `before` and of the step
    /// itself, `now`, and from its `speed` in the same direction.
    pub fn moving(&self, before: f64, now: f64, speed: f64) -> f64 {
        moving(self.force_lag, before, now) - damped(self.local_damping, now, speed)
    }

    /// Velocity and spin of a body half a step before its position, from the rows of that step and of the step
    /// `before`.
    pub fn half_step_earlier(&self, before: &BodyRow, body: &BodyRow, dt: f64) -> ([f64; 2], f64) {
        let back = (0.5 - self.velocity_lag.value) * dt;
        let velocity = [0, 1].map(|axis| {
            let force = self.moving(before.force[axis], body.force[axis], body.velocity[axis]);
            body.velocity[axis] - back * force / self.mass.value
        });
        let torque = self.moving(before.torque, body.torque, body.spin);
        let spin = body.spin - back * torque / self.moment_of_inertia.value;
        (velocity, spin)
    }
}

/// The force that moves a body in a step, from those of the step `before` and of the step itself, `now`.
fn moving(lag: Option<Measured>, before: f64, now: f64) -> f64 {
    lag.map_or(now, |lag| (1.0 - lag.value) * now + lag.value * before)
}

/// What local damping takes from a force, or adds to it.
fn damped(damping: Option<Measured>, force: f64, speed: f64) -> f64 {
    let share = damping.map_or(0.0, |share| share.value);
    match speed == 0.0 {
        true => 0.0,
        false => share * force.abs() * speed.signum(),
    }
}

/// A step of one body along one axis.
struct Kick {
    /// The forces of the step and of the step before, times dt.
    forces: [f64; 2],
    /// The velocities half a step before and after.
    velocities: [f64; 2],
}

impl Kick {
    fn change(&self) -> f64 {
        self.velocities[1] - self.velocities[0]
    }
}

/// What moves the bodies.
struct Kicked {
    inverse_mass: Measured,
    force_lag: Option<Measured>,
    local_damping: Option<Measured>,
}

impl Kicked {
    /// Fits the changes of velocities to the forces: to those of the step alone, unless they leave something that those of
    /// the step before, or local damping, explain to the last digits.
    fn by(kicks: &[Kick]) -> Self {
        let plain = kicks.iter().map(|kick| ([kick.forces[0]], kick.change()));
        let [inverse_mass] = fit(&plain.collect::<Vec<_>>());
        let plain = Self {
            inverse_mass,
            force_lag: None,
            local_damping: None,
        };
        Self::with_lag(kicks)
            .or_else(|| Self::with_local_damping(kicks))
            .unwrap_or(plain)
    }

    fn with_lag(kicks: &[Kick]) -> Option<Self> {
        let terms = kicks.iter().map(|kick| (kick.forces, kick.change()));
        let [same, before] = fit(&terms.collect::<Vec<_>>());
        let inverse_mass = Measured::new(
            same.value + before.value,
            same.uncertainty + before.uncertainty,
        );
        let force_lag = seen(before.over(inverse_mass));
        force_lag.is_some().then_some(Self {
            inverse_mass,
            force_lag,
            local_damping: None,
        })
    }

    /// Steps in which a velocity changes its sign are left out: codes take the sign at different moments of a step.
    fn with_local_damping(kicks: &[Kick]) -> Option<Self> {
        let goes_on = |kick: &&Kick| kick.velocities[0] * kick.velocities[1] > 0.0;
        let terms = kicks.iter().filter(goes_on).map(|kick| {
            let force = kick.forces[0];
            let against = -force.abs() * kick.velocities[0].signum();
            ([force, against], kick.change())
        });
        let [inverse_mass, against] = fit(&terms.collect::<Vec<_>>());
        let local_damping = seen(against.over(inverse_mass));
        local_damping.is_some().then_some(Self {
            inverse_mass,
            force_lag: None,
            local_damping,
        })
    }
}

/// A share that is known to the last digits and is not 0.
fn seen(share: Measured) -> Option<Measured> {
    (share.uncertainty <= TOLERANCE && share.value.abs() > TOLERANCE).then_some(share)
}
