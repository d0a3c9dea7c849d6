//! The micro-tests: initial motions of two cylinders in which one contact shows its law.

use crate::model::{ContactConvention, ContactTest, Drive, InitialMotion};
use crate::theory::CycleOrder;

/// The contact that is tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactKind {
    /// Between the two cylinders.
    Pair,
    /// Between cylinder 1 and the floor.
    Floor,
    /// Between cylinder 1 and the top wall.
    Wall,
}

impl ContactKind {
    /// The word that begins the names of its properties.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Pair => "pair",
            Self::Floor => "floor",
            Self::Wall => "wall",
        }
    }

    /// The friction coefficient of a micro-test at this contact; the wall has none.
    pub fn friction(self, test: &ContactTest) -> f64 {
        match self {
            Self::Pair => test.cylinder_friction,
            Self::Floor => test.floor_friction,
            Self::Wall => 0.0,
        }
    }

    /// The effective mass in the normal direction, for bodies of the given mass.
    pub fn effective_mass(self, mass: f64) -> f64 {
        match self {
            Self::Pair => 0.5 * mass,
            Self::Floor | Self::Wall => mass,
        }
    }
}

/// Weak damping, so that the normal force of a collision rises for a while.
const RESTITUTION: f64 = 0.9;
/// k_n/k_t below 1: the tangential spring reaches the limit while the normal force still rises.
const STIFFNESS_RATIO: f64 = 0.5;
/// The same where forces grow with a power of the overlap: that of Mindlin's law at ν = 1/3, since some codes compute it
/// from Poisson's ratio.
const MINDLIN_RATIO: f64 = 1.25;
/// Friction high enough that a contact in gentle motion sticks.
const ROUGH: f64 = 0.9;
/// Friction low enough that a contact in fast motion slides, and sticks again when it has slowed down.
const SLIPPERY: f64 = 0.2;
/// Friction low enough that the limit is reached within a few steps, before the geometry changes noticeably.
const SLEEK: f64 = 5e-4;
/// Angle between the vertical and the line through the centres of a pair, which lies along no axis.
const PAIR_ANGLE: f64 = 0.4;
const PAIR_CENTRE: [f64; 2] = [0.0, 2.3];
const WALL_HEIGHT: f64 = 4.5;
const BESIDE: InitialMotion = InitialMotion {
    x: 6.0,
    y: 2.0,
    vx: 0.0,
    vy: 0.0,
    spin: 0.0,
};

/// Motion of the first body relative to the second in the frame of the contact, spins of both, and how the test
/// observes it.
#[derive(Clone, Copy)]
struct Start {
    overlap: f64,
    /// Velocity along the normal, positive when separating.
    separation_speed: f64,
    tangential_speed: f64,
    /// Angular velocity of the first body; the second one of a pair has two thirds of it.
    spin: f64,
    /// Angular velocity at which a pair turns as a whole.
    turn: f64,
    friction: f64,
    time_step: f64,
    steps: u64,
}

/// A contact at rest that sticks.
const AT_REST: Start = Start {
    overlap: 0.0,
    separation_speed: 0.0,
    tangential_speed: 0.0,
    spin: 0.0,
    turn: 0.0,
    friction: ROUGH,
    time_step: 0.05,
    steps: 40,
};

/// Gentle motions at three overlaps, in which the contact sticks.
const GENTLE: [Start; 3] = [
    Start {
        overlap: 0.02,
        separation_speed: -0.03,
        tangential_speed: 0.002,
        ..AT_REST
    },
    Start {
        overlap: 0.1,
        separation_speed: -0.05,
        spin: 0.004,
        ..AT_REST
    },
    Start {
        overlap: 0.3,
        separation_speed: -0.1,
        tangential_speed: 0.008,
        spin: -0.006,
        ..AT_REST
    },
];

/// A separation so fast that the damping exceeds the spring.
const SEPARATING: Start = Start {
    overlap: 0.03,
    separation_speed: 1.0,
    time_step: 0.01,
    steps: 4,
    ..AT_REST
};

/// A fast motion, in which the contact slides while the normal force changes, and then sticks again.
const SLIDING: Start = Start {
    overlap: 0.08,
    separation_speed: -0.3,
    tangential_speed: 0.08,
    spin: -0.03,
    friction: SLIPPERY,
    time_step: 0.02,
    steps: 120,
    ..AT_REST
};

/// The same for forces that grow with a power of the overlap, where contacts last longer.
const SLIDING_SOFTLY: Start = Start {
    tangential_speed: 0.1,
    spin: -0.05,
    steps: 160,
    ..SLIDING
};

/// A stretched spring between two cylinders that turn about each other.
const TURNING: Start = Start {
    overlap: 0.3,
    separation_speed: -0.2,
    tangential_speed: 0.1,
    turn: 0.1,
    time_step: 0.005,
    steps: 400,
    ..AT_REST
};

/// Overlaps between which contacts are driven, and tangential displacement.
pub const LOW: f64 = 0.05;
pub const HIGH: f64 = 0.2;
pub const SHEAR: f64 = 3e-4;
/// Steps of a leg of such a cycle.
const LEG_STEPS: u64 = 50;

/// Gentle motions, the same with half the time step (which show the times to which forces belong), a separation, and
/// a motion that slides (not along the wall, which is frictionless).
pub fn common(kind: ContactKind, convention: &ContactConvention) -> Vec<ContactTest> {
    let refined = GENTLE.map(|gentle| Start {
        time_step: 0.5 * gentle.time_step,
        steps: 2 * gentle.steps,
        ..gentle
    });
    let sliding = match convention.law.is_linear() {
        true => SLIDING,
        false => SLIDING_SOFTLY,
    };
    let sliding = (kind != ContactKind::Wall).then_some(sliding);
    let starts = GENTLE.into_iter().chain(refined);
    let starts = starts.chain([SEPARATING]).chain(sliding);
    starts.map(|start| test(kind, convention, start)).collect()
}

/// `test` with its time step divided by `divisor`.
pub fn refined(test: &ContactTest, divisor: u64) -> ContactTest {
    ContactTest {
        time_step: test.time_step / divisor as f64,
        steps: test.steps * divisor,
        drive: test.drive.map(|drive| Drive {
            leg_steps: drive.leg_steps * divisor,
            ..drive
        }),
        ..*test
    }
}

/// A spin that brings the contact to Coulomb's limit within a few steps, if it is fast enough.
pub fn near_slip(kind: ContactKind, convention: &ContactConvention, spin: f64) -> ContactTest {
    let start = Start {
        overlap: 0.2,
        spin,
        friction: SLEEK,
        time_step: 0.01,
        steps: 8,
        ..AT_REST
    };
    test(kind, convention, start)
}

/// A cycle of the given order between the overlaps [`LOW`] and [`HIGH`], without damping.
pub fn driven(kind: ContactKind, convention: &ContactConvention, order: CycleOrder) -> ContactTest {
    let start = Start {
        overlap: LOW,
        steps: 4 * LEG_STEPS,
        ..AT_REST
    };
    let free = test(kind, convention, start);
    let duration = LEG_STEPS as f64 * start.time_step;
    let [press, shear] = [(HIGH - LOW) / duration, SHEAR / duration];
    // The contact of a pair turns while it is sheared along a chord, and is pressed and released along its new normal.
    let is_pair = kind == ContactKind::Pair;
    let mut angle = if is_pair { PAIR_ANGLE } else { 0.0 };
    let turn = |overlap: f64| match is_pair {
        true => 2.0 * libm::asin(0.5 * SHEAR / (2.0 - overlap)),
        false => 0.0,
    };
    let mut leg = |away: f64, along: f64, turns: f64| {
        let halfway = angle - 0.5 * turns;
        let normal = [libm::sin(halfway), libm::cos(halfway)];
        angle -= turns;
        in_the_plane(normal, away, along)
    };
    let legs = match order {
        CycleOrder::ShearedFirst => [
            leg(0.0, shear, turn(LOW)),
            leg(-press, 0.0, 0.0),
            leg(0.0, -shear, -turn(HIGH)),
            leg(press, 0.0, 0.0),
        ],
        CycleOrder::PressedFirst => [
            leg(-press, 0.0, 0.0),
            leg(0.0, shear, turn(HIGH)),
            leg(press, 0.0, 0.0),
            leg(0.0, -shear, -turn(LOW)),
        ],
    };
    ContactTest {
        convention: ContactConvention {
            restitution: 1.0,
            ..free.convention
        },
        drive: Some(Drive {
            leg_steps: LEG_STEPS,
            legs,
        }),
        ..free
    }
}

/// The motion of a pair that turns.
pub fn turning(convention: &ContactConvention) -> ContactTest {
    test(ContactKind::Pair, convention, TURNING)
}

fn test(kind: ContactKind, convention: &ContactConvention, start: Start) -> ContactTest {
    let initial_motions = match kind {
        ContactKind::Pair => pair(start),
        ContactKind::Floor => [
            single([0.0, 1.0], [0.0, 1.0 - start.overlap], start),
            BESIDE,
        ],
        ContactKind::Wall => {
            let height = WALL_HEIGHT - 1.0 + start.overlap;
            [single([0.0, -1.0], [0.0, height], start), BESIDE]
        }
    };
    ContactTest {
        convention: ContactConvention {
            restitution: RESTITUTION,
            ..*convention
        },
        stiffness_ratio: match convention.law.is_linear() {
            true => STIFFNESS_RATIO,
            false => MINDLIN_RATIO,
        },
        floor_friction: start.friction,
        cylinder_friction: start.friction,
        time_step: start.time_step,
        steps: start.steps,
        wall_height: WALL_HEIGHT,
        wall_speed: if kind == ContactKind::Wall { 0.02 } else { 0.0 },
        initial_motions,
        drive: None,
        space: None,
    }
}

/// A cylinder pressed against a wall with the given normal.
fn single(normal: [f64; 2], [x, y]: [f64; 2], start: Start) -> InitialMotion {
    let [vx, vy] = in_the_plane(normal, start.separation_speed, start.tangential_speed);
    InitialMotion {
        x,
        y,
        vx,
        vy,
        spin: start.spin,
    }
}

/// Two cylinders pressed against each other.
fn pair(start: Start) -> [InitialMotion; 2] {
    let normal = [libm::sin(PAIR_ANGLE), libm::cos(PAIR_ANGLE)];
    let half_distance = 0.5 * (2.0 - start.overlap);
    let orbital = 2.0 * half_distance * start.turn;
    let relative = in_the_plane(
        normal,
        start.separation_speed,
        start.tangential_speed + orbital,
    );
    let body = |sign: f64, spin: f64| InitialMotion {
        x: PAIR_CENTRE[0] + sign * half_distance * normal[0],
        y: PAIR_CENTRE[1] + sign * half_distance * normal[1],
        vx: 0.5 * sign * relative[0],
        vy: 0.5 * sign * relative[1],
        spin: spin + start.turn,
    };
    [body(1.0, start.spin), body(-1.0, start.spin / 1.5)]
}

/// The vector with the given components along the normal and along t = (−n_y, n_x).
fn in_the_plane(normal: [f64; 2], along: f64, across: f64) -> [f64; 2] {
    [
        along * normal[0] - across * normal[1],
        along * normal[1] + across * normal[0],
    ]
}
