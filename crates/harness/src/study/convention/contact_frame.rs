//! A motion in the frame of the contact: overlap, relative velocities, force components.

use super::clock::Clock;
use super::experiments::ContactKind;
use crate::model::ContactTest;
use crate::series::{Motion, MotionRow};

/// A contact at one step. Velocities belong to the half step before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactRow {
    /// Unit normal, towards cylinder 1.
    pub normal: [f64; 2],
    /// The normal of the step before.
    pub last_normal: [f64; 2],
    pub overlap: f64,
    /// Normal velocity, positive when separating.
    pub separation_speed: f64,
    /// Tangential velocity of the centres.
    pub tangential_speed: f64,
    /// Angular velocities of both sides; 0 for the floor and the wall.
    pub spins: [f64; 2],
    /// Normal force without the lift.
    pub normal_force: f64,
    /// Tangential force on cylinder 1.
    pub tangential_force: f64,
    /// Component of the force of spring and friction along the normal, if the spring does not turn with its contact;
    /// 0 in a row as read.
    pub lift: f64,
    /// The spring's part of the normal force, if Coulomb's limit counts that alone; `None` in a row as read.
    pub limiting_part: Option<f64>,
    /// Torque on cylinder 1.
    pub torque: f64,
    /// Torque on cylinder 2.
    pub other_torque: f64,
    /// Reported force of the top wall.
    pub wall_force: f64,
    pub time_step: f64,
    pub friction: f64,
    /// Whether a motion may be cut off after it.
    pub may_be_last: bool,
}

impl ContactRow {
    /// Sum of the angular velocities.
    pub fn spin(&self) -> f64 {
        self.spins[0] + self.spins[1]
    }

    /// Magnitude of the force of spring and friction.
    pub fn friction_force(&self) -> f64 {
        self.tangential_force.hypot(self.lift)
    }

    /// The normal force that Coulomb's limit counts.
    pub fn limiting_force(&self) -> f64 {
        self.limiting_part.unwrap_or(self.normal_force)
    }

    /// The same row with this part of its normal force as `lift`.
    pub fn lifted_by(self, lift: f64) -> Self {
        Self {
            normal_force: self.normal_force + self.lift - lift,
            lift,
            ..self
        }
    }

    /// The larger of the angles by which the two sides turn in a step.
    pub fn turn(&self) -> f64 {
        self.spins[0].abs().max(self.spins[1].abs()) * self.time_step
    }
}

/// The rows of `motion` from step 1 on, as long as the contact is closed.
pub fn contact_rows(
    kind: ContactKind,
    test: &ContactTest,
    motion: &Motion,
    clock: &Clock,
) -> Vec<ContactRow> {
    let read = |before, row| contact_row(kind, test, before, row, clock);
    let two = motion.rows().windows(2);
    two.map(|two| ContactRow {
        last_normal: read(&two[0], &two[0]).normal,
        ..read(&two[0], &two[1])
    })
    .take_while(|row| row.overlap > 0.0)
    .collect()
}

/// The first rows, as long as they are `wanted`; if there are others, to the last row where motions may be cut off.
pub fn as_long_as(rows: &[ContactRow], wanted: impl Fn(&ContactRow) -> bool) -> &[ContactRow] {
    let Some(end) = rows.iter().position(|row| !wanted(row)) else {
        return rows;
    };
    let last = rows[..end].iter().rposition(|row| row.may_be_last);
    &rows[..last.map_or(0, |last| last + 1)]
}

fn contact_row(
    kind: ContactKind,
    test: &ContactTest,
    before: &MotionRow,
    row: &MotionRow,
    clock: &Clock,
) -> ContactRow {
    let dt = test.time_step;
    let ([one, two], before) = (row.bodies(), before.bodies());
    let [(velocity, spin), (other_velocity, other_spin)] = [(&before[0], &one), (&before[1], &two)]
        .map(|(before, body)| clock.half_step_earlier(before, body, dt));
    let (normal, overlap, relative, spins) = match kind {
        ContactKind::Floor => ([0.0, 1.0], 1.0 - one.position[1], velocity, [spin, 0.0]),
        ContactKind::Wall => {
            let height = test.wall_height_at(row.step);
            let relative = [velocity[0], velocity[1] + test.wall_speed];
            let overlap = 1.0 - (height - one.position[1]);
            ([0.0, -1.0], overlap, relative, [spin, 0.0])
        }
        ContactKind::Pair => {
            let apart = [0, 1].map(|axis| one.position[axis] - two.position[axis]);
            let distance = apart[0].hypot(apart[1]);
            let relative = [0, 1].map(|axis| velocity[axis] - other_velocity[axis]);
            let normal = apart.map(|component| component / distance);
            (normal, 2.0 - distance, relative, [spin, other_spin])
        }
    };
    let along = |vector: [f64; 2]| normal[0] * vector[0] + normal[1] * vector[1];
    let across = |vector: [f64; 2]| normal[0] * vector[1] - normal[1] * vector[0];
    ContactRow {
        normal,
        last_normal: normal,
        overlap,
        separation_speed: along(relative),
        tangential_speed: across(relative),
        spins,
        normal_force: along(one.force),
        tangential_force: across(one.force),
        lift: 0.0,
        limiting_part: None,
        torque: one.torque,
        other_torque: two.torque,
        wall_force: row.wall_force,
        time_step: dt,
        friction: kind.friction(test),
        may_be_last: row.step.is_multiple_of(clock.grain),
    }
}
