//! The terms that an equation of motion has, or has wrongly, and the conditions under which it may fail.

use crate::model::InitialMotion;
use crate::series::BodyRow;

/// A term of an equation, by axis: 0 and 1 for translation, 2 for rotation.
pub(super) struct Term {
    pub name: &'static str,
    /// Whether the law has it.
    pub is_part: bool,
    /// What it means where the law does not have it.
    pub called: &'static str,
    pub value: fn(&Moment, usize) -> f64,
}

/// One body at one step, with what the law gives there.
#[derive(Clone, Copy)]
pub(super) struct Moment {
    pub now: BodyRow,
    pub before: Option<BodyRow>,
    pub asked: InitialMotion,
    pub step: u64,
    pub time_step: f64,
    pub inertia: [f64; 3],
    /// 1 for the first body of a contact, −1 for the second.
    pub sign: f64,
    /// Radius of the torque.
    pub arm: f64,
    pub touch: Touch,
}

/// The contact of a micro-test at one step, by the law.
#[derive(Clone, Copy, Default)]
pub(super) struct Touch {
    /// Normal towards the first body.
    pub normal: [f64; 2],
    pub pressing: f64,
    pub tangential: f64,
    /// The springs' parts of `pressing` and `tangential`.
    pub elastic: f64,
    pub sheared: f64,
    /// Coulomb's limit.
    pub limit: f64,
    /// The tangential damping by the velocities, which a contact that slides does not show.
    pub damped: f64,
    /// Force along the normal of a tangential spring that nothing turns.
    pub pulled: f64,
    /// Negative where the surfaces are apart.
    pub overlap: f64,
    pub separation: f64,
    pub sliding: f64,
    /// Since the beginning: the angles by which both surfaces have turned, the path of the centres along the tangent,
    /// and the distance by which the surfaces have approached.
    pub ways: [f64; 4],
    /// The first three of them, each as the law remembers the stretching of a tangential spring by it, and the force
    /// of a unit of that, in units of the tangential stiffness.
    pub stretches: [f64; 3],
    pub stiffness: f64,
    /// Tangential damping at this overlap, in units of its coefficient.
    pub damping_growth: f64,
    /// Normal and tangential force of the step before, minus those of this one.
    pub late: [f64; 2],
    /// Force of the tangential spring of the step before, along the present tangent and normal.
    pub sheared_before: [f64; 2],
    pub first_overlap: f64,
    pub largest_overlap: f64,
}

impl Moment {
    pub fn along(&self, axis: usize) -> f64 {
        self.sign * self.touch.normal[axis]
    }

    pub fn across(&self, axis: usize) -> f64 {
        let [x, y] = self.touch.normal;
        self.sign * [-y, x][axis]
    }

    /// Returns the force that the code has written, along the tangent.
    fn sideways(&self) -> f64 {
        let [x, y] = self.now.force;
        x * self.across(0) + y * self.across(1)
    }

    /// Returns a force that has these parts along tangent and normal.
    fn spring(&self, axis: usize, [sheared, pulled]: [f64; 2]) -> f64 {
        sheared * self.across(axis) + pulled * self.along(axis)
    }

    /// Returns the position that the task asks for at step 0.
    pub fn place(&self, axis: usize) -> f64 {
        [self.asked.x, self.asked.y][axis]
    }

    /// Returns the velocity that the task asks for at step 0.
    pub fn asked_rate(&self, axis: usize) -> f64 {
        [self.asked.vx, self.asked.vy, self.asked.spin][axis]
    }

    /// Returns the displacement along the axis `along` towards `side`; 0 for any other `axis`.
    fn moved(&self, axis: usize, along: usize, side: f64) -> f64 {
        on(axis, along) * (side * (self.now.position[along] - self.place(along))).max(0.0)
    }

    /// Returns the change of a velocity by the load in this step.
    pub fn kick(&self, axis: usize) -> f64 {
        load(&self.now, axis) / self.inertia[axis] * self.time_step
    }

    /// Returns the change of a velocity by the load in the step before.
    fn kick_before(&self, axis: usize) -> f64 {
        self.before.map_or(0.0, |before| {
            load(&before, axis) / self.inertia[axis] * self.time_step
        })
    }

    /// Returns the change of a velocity since the step before.
    fn faster(&self, axis: usize) -> f64 {
        self.before
            .map_or(0.0, |before| rate(&self.now, axis) - rate(&before, axis))
    }
}

impl Touch {
    /// Returns the force of a tangential spring that one of the ways has stretched.
    fn of_way(&self, way: usize) -> f64 {
        self.stiffness * self.stretches[way]
    }

    fn damping(&self) -> f64 {
        self.pressing - self.elastic
    }

    /// The two parts of the tangential force multiplied, where the law adds them.
    fn product(&self) -> f64 {
        (self.tangential - self.damped) * self.damped
    }

    fn tangential_damping(&self) -> f64 {
        self.tangential - self.sheared
    }
}

pub(super) fn rate(body: &BodyRow, axis: usize) -> f64 {
    [body.velocity[0], body.velocity[1], body.spin][axis]
}

fn load(body: &BodyRow, axis: usize) -> f64 {
    [body.force[0], body.force[1], body.torque][axis]
}

fn on(axis: usize, along: usize) -> f64 {
    f64::from(u8::from(axis == along))
}

fn sign_of(number: f64) -> f64 {
    if number == 0.0 { 0.0 } else { number.signum() }
}

macro_rules! terms {
    ($($name:literal $(, $called:literal)? => |$moment:tt, $axis:tt| $value:expr;)*) => {
        [$(Term {
            name: $name,
            is_part: [$($called,)? ""].len() == 1,
            called: [$($called,)? ""][0],
            value: |$moment: &Moment, $axis: usize| $value,
        }),*]
    };
}

/// Name of the term that a force at Coulomb's limit has wherever the law has less, whatever the reason.
pub(super) const TO_THE_LIMIT: &str =
    "what is missing from the tangential force to Coulomb's limit";

/// A force on a body.
pub(super) static FORCE: [Term; 39] = terms! {
    "the normal force" => |m, axis| m.touch.pressing * m.along(axis);
    "the spring's part of the normal force" => |m, axis| m.touch.elastic * m.along(axis);
    "the damping of the normal force" => |m, axis| m.touch.damping() * m.along(axis);
    "the tangential force" => |m, axis| m.spring(axis, [m.touch.tangential, m.touch.pulled]);
    "the spring's part of the tangential force" => |m, axis| m.spring(axis, [m.touch.sheared, m.touch.pulled]);
    "the damping of the tangential force" => |m, axis| m.touch.tangential_damping() * m.across(axis);
    "the horizontal component of the normal force" => |m, axis| m.touch.pressing * m.along(0) * on(axis, 0);
    "the vertical component of the normal force" => |m, axis| m.touch.pressing * m.along(1) * on(axis, 1);
    "the horizontal component of the tangential force (its direction is not the tangent)" =>
        |m, axis| m.touch.tangential * m.across(0) * on(axis, 0);
    "the vertical component of the tangential force (its direction is not the tangent)" =>
        |m, axis| m.touch.tangential * m.across(1) * on(axis, 1);
    "the tangential spring of the step before (its history: it is cleared where this is left out)" =>
        |m, axis| m.spring(axis, m.touch.sheared_before);
    "the overlap", "a linear spring; where the contact is open, it acts across a gap: its range is too large, or it is not ended" =>
        |m, axis| m.touch.overlap * m.along(axis);
    "the largest overlap so far", "the force depends on the history of the overlap: hysteresis, another stiffness on unloading" =>
        |m, axis| m.touch.largest_overlap * m.along(axis);
    "the overlap at the beginning", "the force counts from there and not from the overlap itself, if this is -1" =>
        |m, axis| m.touch.first_overlap * m.along(axis);
    "the way by which the surfaces have approached", "the force is summed up from their velocity, if the spring's part is left out" =>
        |m, axis| m.touch.ways[3] * m.along(axis);
    "the difference to the normal force of the step before", "the force is that of the step before, if this is 1" =>
        |m, axis| m.touch.late[0] * m.along(axis);
    "the difference to the tangential force of the step before", "the force is that of the step before, if this is 1" =>
        |m, axis| m.touch.late[1] * m.across(axis);
    "a constant force along the normal", "adhesion, a preload" => |m, axis| m.along(axis);
    "the overlap to the power of 3/2", "another power than that of the law" =>
        |m, axis| m.touch.overlap.max(0.0) * m.touch.overlap.max(0.0).sqrt() * m.along(axis);
    "the square of the overlap", "another power than that of the law" => |m, axis| m.touch.overlap.powi(2) * m.along(axis);
    "the overlap times the normal velocity", "damping that depends on the overlap" =>
        |m, axis| m.touch.overlap * m.touch.separation * m.along(axis);
    "the normal velocity", "damping" => |m, axis| m.touch.separation * m.along(axis);
    "the angle by which the first surface has turned", "its spin counts otherwise in the tangential spring" =>
        |m, axis| m.touch.of_way(0) * m.across(axis);
    "the angle by which the second surface has turned", "its spin counts otherwise in the tangential spring" =>
        |m, axis| m.touch.of_way(1) * m.across(axis);
    "the way of the centres along the tangent", "their velocity counts otherwise in the tangential spring" =>
        |m, axis| m.touch.of_way(2) * m.across(axis);
    "the spin", "it counts otherwise in the tangential damping" =>
        |m, axis| m.touch.damping_growth * m.now.spin * m.across(axis);
    "the tangential velocity", "damping" => |m, axis| m.touch.sliding * m.across(axis);
    "Coulomb's limit against the tangential velocity", "a friction by the sign of the velocity" =>
        |m, axis| -m.touch.limit * sign_of(m.touch.sliding) * m.across(axis);
    "the size of the tangential force against the tangential velocity", "the sign is that of the velocity, not of the spring" =>
        |m, axis| -m.touch.tangential.abs() * sign_of(m.touch.sliding) * m.across(axis);
    "what is missing from the tangential force to Coulomb's limit", "the contact slides where it must stick, or to the other side, if this is 1" =>
        |m, axis| (m.touch.limit * sign_of(m.sideways()) - m.touch.tangential) * m.across(axis);
    "the spring's part of the tangential force times its damping", "a product stands where the law has a sum" =>
        |m, axis| m.touch.product() * m.across(axis);
    "the velocity of the cylinder", "a drag, a damping besides that of the contacts" => |m, axis| rate(&m.now, axis);
    "its displacement to the right since the beginning", "something holds it there: a side wall, a boundary" =>
        |m, axis| m.moved(axis, 0, 1.0);
    "its displacement to the left since the beginning", "something holds it there: a side wall, a boundary" =>
        |m, axis| m.moved(axis, 0, -1.0);
    "its displacement upwards since the beginning", "something holds it there" => |m, axis| m.moved(axis, 1, 1.0);
    "its displacement downwards since the beginning", "something holds it there" => |m, axis| m.moved(axis, 1, -1.0);
    "a constant horizontal force", "a field: wind, tilted gravity" => |_, axis| on(axis, 0);
    "a constant vertical force", "a weight, in a motion without gravity" => |_, axis| on(axis, 1);
    "the time", "a force that grows by itself" => |m, axis| m.step as f64 * m.time_step * m.along(axis);
};

/// A torque on a body about its centre.
pub(super) static TORQUE: [Term; 16] = terms! {
    "the tangential force" => |m, _| -m.arm * m.touch.tangential;
    "the spring's part of the tangential force" => |m, _| -m.arm * m.touch.sheared;
    "the damping of the tangential force" => |m, _| -m.arm * m.touch.tangential_damping();
    "the tangential spring of the step before (its history: it is cleared where this is left out)" =>
        |m, _| -m.arm * m.touch.sheared_before[0];
    "the normal force against the spin", "rolling friction" => |m, _| -m.touch.pressing * sign_of(m.now.spin);
    "the normal force times the spin", "rolling resistance" => |m, _| m.touch.pressing * m.now.spin;
    "the spin", "a rolling resistance, a damping of the spin" => |m, _| m.now.spin;
    "the angle by which it has turned", "a spring against rolling" => |m, _| m.touch.ways[usize::from(m.sign < 0.0)];
    "the difference to the tangential force of the step before", "the force is that of the step before" =>
        |m, _| -m.arm * m.touch.late[1];
    "the normal force", "the force does not act on the line of the centres" => |m, _| m.touch.pressing;
    "the tangential force times the overlap", "it acts at another radius than declared: a convention of arms" =>
        |m, _| m.touch.tangential * m.touch.overlap;
    "the size of the tangential force against the tangential velocity", "the sign is that of the velocity, not of the spring" =>
        |m, _| m.arm * m.touch.tangential.abs() * sign_of(m.touch.sliding);
    "Coulomb's limit against the tangential velocity", "a friction by the sign of the velocity" =>
        |m, _| m.arm * m.touch.limit * sign_of(m.touch.sliding);
    "what is missing from the tangential force to Coulomb's limit", "the contact slides where it must stick, or to the other side, if this is 1" =>
        |m, _| m.arm * (m.touch.limit * sign_of(m.now.torque) + m.touch.tangential);
    "the spring's part of the tangential force times its damping", "a product stands where the law has a sum" =>
        |m, _| -m.arm * m.touch.product();
    "a constant", "a torque that is always there" => |_, _| 1.0;
};

/// The change of a velocity in a step.
pub(super) static KICK: [Term; 9] = terms! {
    "the force (torque) in it" => |m, axis| m.kick(axis);
    "the velocity before times time step", "a damping besides that of the contacts, in a unit of time" =>
        |m, axis| rate(&m.now, axis) * m.time_step;
    "the velocity after the kick times time step", "a damping besides that of the contacts, in a unit of time" =>
        |m, axis| (rate(&m.now, axis) + m.kick(axis)) * m.time_step;
    "the velocity before", "a damping besides that of the contacts, in every step" => |m, axis| rate(&m.now, axis);
    "the velocity after the kick", "a damping besides that of the contacts, in every step" =>
        |m, axis| rate(&m.now, axis) + m.kick(axis);
    "the change by the force (torque) of the step before", "the integrator mixes forces of two steps" =>
        |m, axis| m.kick_before(axis);
    "the size of the change against the velocity", "Cundall's local damping" =>
        |m, axis| -m.kick(axis).abs() * sign_of(rate(&m.now, axis));
    "the same with a positive velocity for none", "Cundall's local damping" =>
        |m, axis| -m.kick(axis).abs() * rate(&m.now, axis).signum();
    "the time step", "an acceleration that is always there" => |m, _| m.time_step;
};

/// The change of a position in a step.
pub(super) static MOVE: [Term; 5] = terms! {
    "the new velocity in it" => |m, axis| rate(&m.now, axis) * m.time_step;
    "the change of the velocity times time step", "positions move on with the old velocity, if this is -1" =>
        |m, axis| m.faster(axis) * m.time_step;
    "the velocity", "a way by step and not by time" => |m, axis| rate(&m.now, axis);
    "the square of the time step", "an acceleration that is always there" => |m, _| m.time_step * m.time_step;
    "the time step", "a velocity that is always there" => |m, _| m.time_step;
};

/// The force that is written for the top wall.
pub(super) static WALL_FORCE: [Term; 4] = terms! {
    "the whole force" => |m, _| m.touch.pressing;
    "its damping" => |m, _| m.touch.damping();
    "the difference to that of the step before", "it is that of the step before, if this is 1" => |m, _| m.touch.late[0];
    "a constant", "an offset" => |_, _| 1.0;
};

/// Position (the first two) and velocity (the last two) at step 0.
pub(super) static START: [Term; 3] = terms! {
    "the position in the task" => |m, axis| m.place(axis);
    "a constant", "another origin" => |_, _| 1.0;
    "the velocity in the task" => |m, axis| m.asked_rate(axis);
};

/// A condition in words, and its test.
type Condition = (&'static str, fn(&Moment) -> bool);

/// Conditions under which an equation may fail.
pub(super) static WHERE: [Condition; 18] = [
    ("in the first step", |m| m.step == 0),
    ("in the second step", |m| m.step == 1),
    ("from the second step on", |m| m.step > 0),
    ("while the surfaces approach", |m| m.touch.separation < 0.0),
    ("while the surfaces separate", |m| m.touch.separation > 0.0),
    ("while the normal force pulls", |m| m.touch.pressing < 0.0),
    ("where the tangential force is positive", |m| {
        m.touch.tangential > 0.0
    }),
    ("where the tangential force is negative", |m| {
        m.touch.tangential < 0.0
    }),
    ("where the tangential velocity is positive", |m| {
        m.touch.sliding > 0.0
    }),
    ("where the tangential velocity is negative", |m| {
        m.touch.sliding < 0.0
    }),
    (
        "where the tangential velocity is against the spring's force",
        |m| m.touch.sliding * m.touch.sheared < 0.0,
    ),
    (
        "where the tangential velocity is along the spring's force",
        |m| m.touch.sliding * m.touch.sheared > 0.0,
    ),
    ("where the spin is positive", |m| m.now.spin > 0.0),
    ("where the spin is negative", |m| m.now.spin < 0.0),
    ("of the first cylinder", |m| m.sign > 0.0),
    ("of the second cylinder", |m| m.sign < 0.0),
    ("where the surfaces have touched", |m| {
        m.touch.first_overlap > 0.0
    }),
    ("where they have never touched", |m| {
        m.touch.first_overlap <= 0.0
    }),
];
