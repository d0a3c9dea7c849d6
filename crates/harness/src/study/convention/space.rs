//! What a contact of spheres does in space: how its spring follows a normal that turns in any direction and a common spin
//! about the normal, whether every component of a spin and of a torque counts, and whether two contacts of a sphere keep
//! their springs apart.
//!
//! Forces are split into those of the pair, felt by sphere 2 alone, and those of the floor. The spring m behind a
//! force follows from it, in units of a length or of a force, as the law remembers it. From one step to the next m
//! changes by the motion of the surfaces, and by its transport from the old normal n₀ to the new one n₁:
//!
//! m' = m − n₁ (n₁·m) + a L + b Q + c T + d N + …, with L the change that gives m its length back, Q = (n₁ − n₀)(n₁·m) +
//! n₁ (n₀·m) the difference of the vector product m − m × (n₀ × n₁), T = (dt/2) (n₀·Σω) n₀ × m a turn with half the sum of the
//! spins, and N = n₁ (n₁·m) what a spring that nothing turns keeps along the normal. Projection has a = b = c = d = 0. While
//! a contact sticks, regressions give a, b, c and d and the weight of each component of the spins in the motion of the
//! surfaces; d counts only where it is declared or seen.

use super::clock::Clock;
use super::experiments::ContactKind;
use super::finding::{Property, TOLERANCE};
use super::properties::LEFT_BEHIND;
use super::regression::{Measured, fit_rows};
use crate::code::{ConventionKey, Declaration};
use crate::model::{
    ContactCoefficients, ContactConvention, ContactTest, CoulombOperand, HistoryUpdate,
    InitialMotion, MotionInSpace, SlidingSpring, Stack,
};
use crate::series::{BodyRow, Motion, MotionRow};

type Vector = [f64; 3];

/// Friction at which nothing slides.
const STICKS: f64 = 50.0;
/// Friction at which contacts slide from the first steps on.
const SLIDES: f64 = 0.02;
const TIME_STEP: f64 = 0.1;
const STEPS: u64 = 24;
/// Least change of a force, in units of the largest, that a step is read from.
const LEAST: f64 = 1e-6;

/// Fraction of Coulomb's limit below which a contact certainly sticks.
const SURELY_STICKS: f64 = 0.5;
/// Fraction of the elastic normal force above which no rule about pulling forces matters.
const SURELY_PRESSED: f64 = 0.3;

/// Number of ways in which a spring may follow its contact beside projection.
const TRANSPORTS: usize = 4;
/// Number of terms: those transports, and the spins about three axes.
const TERMS: usize = TRANSPORTS + 3;

/// Largest number of fits of the changes of springs. Each leaves only a part of the error of a wrong weight.
const MOST_FITS: usize = 40;

/// A state of motion of a body: place, velocity, spin.
type State = [Vector; 3];

/// Two spheres that circle around each other about an axis across their normal while they roll, slip and spin about it; one
/// sphere that rolls and spins on the floor; and two that do both at once.
const MOTIONS: [[State; 2]; 3] = [
    [
        [[0.70, 3.47, 0.53], [-0.15, 0.05, 0.16], [0.31, -0.12, 0.26]],
        [
            [-0.70, 2.73, -0.53],
            [0.15, -0.05, -0.17],
            [0.23, 0.17, -0.21],
        ],
    ],
    [
        [[0.0, 0.93, 0.0], [0.21, 0.0, -0.17], [0.29, 0.37, 0.19]],
        BESIDE,
    ],
    [
        [[0.61, 0.92, 0.45], [0.03, 0.0, 0.04], [0.13, 0.22, -0.17]],
        [
            [-0.41, 2.41, -0.31],
            [-0.05, -0.02, 0.06],
            [-0.08, 0.15, 0.12],
        ],
    ],
];

/// A sphere that touches nothing.
const BESIDE: State = [[7.0, 3.0, 0.0], [0.0; 3], [0.0; 3]];

/// Index of the motion with two contacts at once.
const AT_ONCE: usize = 2;

/// Ways of looking at the same motion: turned by 1 rad about the vertical, mirrored, and with the spheres renumbered.
#[derive(Debug, Clone, Copy)]
enum View {
    Turned,
    Mirrored,
    Renumbered,
}

const VIEWS: [(View, &str); 3] = [
    (View::Turned, "space_turned"),
    (View::Mirrored, "space_mirrored"),
    (View::Renumbered, "space_renumbered"),
];

impl View {
    /// A place, velocity or force in this view.
    fn of_vector(self, [x, y, z]: Vector) -> Vector {
        match self {
            Self::Turned => {
                let (sine, cosine) = (libm::sin(1.0), libm::cos(1.0));
                [x * cosine + z * sine, y, z * cosine - x * sine]
            }
            Self::Mirrored => [x, y, -z],
            Self::Renumbered => [x, y, z],
        }
    }

    /// A spin or torque in this view.
    fn of_rotation(self, rotation: Vector) -> Vector {
        match self {
            Self::Mirrored => {
                let [x, y, z] = rotation;
                [-x, -y, z]
            }
            _ => self.of_vector(rotation),
        }
    }

    /// The bodies in the order of their numbers.
    fn of_bodies<T: Copy>(self, [one, two]: [T; 2]) -> [T; 2] {
        match self {
            Self::Renumbered => [two, one],
            _ => [one, two],
        }
    }

    /// The micro-test of the same motion in this view.
    fn of_test(self, convention: &ContactConvention) -> ContactTest {
        let bodies = self.of_bodies(MOTIONS[AT_ONCE]);
        let seen = bodies.map(|[at, velocity, spin]| {
            [
                self.of_vector(at),
                self.of_vector(velocity),
                self.of_rotation(spin),
            ]
        });
        test(convention, STICKS, &seen)
    }

    /// The largest deviation of the forces and torques of `seen` from those of `motion` in this view, over the
    /// largest of them.
    fn deviation(self, motion: &Motion, seen: &Motion) -> Measured {
        let (mut apart, mut largest) = (0f64, 0f64);
        for (row, seen) in motion.rows().iter().zip(seen.rows()) {
            let expected = self.of_bodies([0, 1].map(|body| Body::of(row, body)));
            let found = [0, 1].map(|body| Body::of(seen, body));
            for (expected, found) in expected.iter().zip(found) {
                let force = self.of_vector(expected.force);
                let torque = self.of_rotation(expected.torque);
                for (one, other) in [(force, found.force), (torque, found.torque)] {
                    let difference = combine(one, -1.0, other);
                    apart = apart.max(dot(difference, difference).sqrt());
                    largest = largest.max(dot(one, one).sqrt());
                }
            }
        }
        // Each step rounds coordinates of up to 4, in either motion; stiffnesses are about 1.
        let rounding = STEPS as f64 * 4.0 * f64::EPSILON / largest;
        Measured::new(apart / largest, rounding)
    }
}

/// The micro-tests: every motion with friction at which nothing slides, and at which everything does; and the motion
/// with two contacts at once in every view.
pub fn tests(convention: &ContactConvention) -> Vec<ContactTest> {
    let frictions = [STICKS, SLIDES].into_iter();
    let motions = frictions.flat_map(|friction| {
        MOTIONS
            .iter()
            .map(move |bodies| test(convention, friction, bodies))
    });
    let views = VIEWS.iter().map(|(view, _)| view.of_test(convention));
    motions.chain(views).collect()
}

fn test(convention: &ContactConvention, friction: f64, bodies: &[State; 2]) -> ContactTest {
    let spheres = Stack {
        bodies: 3,
        ..Stack::paper(f64::NAN, f64::NAN)
    };
    ContactTest {
        convention: ContactConvention {
            restitution: 0.9,
            ..convention.of_bodies(&spheres)
        },
        stiffness_ratio: 1.25,
        floor_friction: friction,
        cylinder_friction: friction,
        time_step: TIME_STEP,
        steps: STEPS,
        wall_height: 20.0,
        wall_speed: 0.0,
        initial_motions: bodies.map(|[at, velocity, spin]| InitialMotion {
            x: at[0],
            y: at[1],
            vx: velocity[0],
            vy: velocity[1],
            spin: spin[2],
        }),
        drive: None,
        space: Some(bodies.map(|[at, velocity, spin]| MotionInSpace {
            z: at[2],
            vz: velocity[2],
            spinx: spin[0],
            spiny: spin[1],
        })),
    }
}

/// The properties that the outcomes of [`tests`] show, beside the `declared` ones: how a motion looks in other views
/// and, if the law that is needed to read them is declared, what the contacts do.
pub fn properties(
    outcomes: &[(&ContactTest, &Motion)],
    clock: &Clock,
    declared: &Declaration,
) -> Vec<Property> {
    use ConventionKey::{MomentOfInertia, VelocityLag};
    let needed = |key: &ConventionKey| ![MomentOfInertia, VelocityLag].contains(key);
    if outcomes.is_empty() {
        return Vec::new();
    }
    let (outcomes, seen) = outcomes.split_at(2 * MOTIONS.len());
    let views = VIEWS.iter().zip(seen).map(|((view, name), (_, seen))| {
        let deviation = view.deviation(outcomes[AT_ONCE].1, seen);
        Property::new(name, deviation, 0.0)
    });
    let mut properties: Vec<Property> = views.collect();
    if declared.left_out.iter().any(needed) {
        return properties;
    }
    let (sticking, sliding) = outcomes.split_at(MOTIONS.len());
    let kinds = [ContactKind::Pair, ContactKind::Floor].into_iter();
    properties.extend(kinds.flat_map(|kind| {
        let rows = |outcomes: &[(&ContactTest, &Motion)]| {
            let each = outcomes.iter();
            let each = each.map(|(test, motion)| rows_of(kind, test, motion, clock));
            each.collect::<Vec<_>>()
        };
        let law = Reader {
            kind,
            convention: outcomes[0].0.convention,
            stiffness_ratio: outcomes[0].0.stiffness_ratio,
        };
        let (sticking, sliding) = (rows(sticking), rows(sliding));
        let (sticking, spins) = law.of_sticking(&sticking);
        [sticking, law.of_sliding(&sliding, spins)].concat()
    }));
    properties
}

/// A contact at one step. Velocities belong to the half step before.
#[derive(Debug, Clone, Copy)]
struct Row {
    normal: Vector,
    overlap: f64,
    /// Velocity of the centres.
    velocity: Vector,
    /// Sum of the angular velocities.
    spin: Vector,
    force: Vector,
    torque: Vector,
    friction: f64,
}

/// The rows of a motion from step 1 on, as long as the contact is closed.
fn rows_of(kind: ContactKind, test: &ContactTest, motion: &Motion, clock: &Clock) -> Vec<Row> {
    let rows = motion.rows().windows(2);
    rows.map_while(|two| {
        let bodies = [0, 1].map(|body| [&two[0], &two[1]].map(|row| Body::of(row, body)));
        let [one, two] = bodies.map(|[before, body]| body.half_step_earlier(&before, test, clock));
        let sum = |left: Vector, right: Vector| combine(left, 1.0, right);
        let difference = |left: Vector, right: Vector| combine(left, -1.0, right);
        let (normal, overlap, velocity, spin) = match kind {
            ContactKind::Pair => {
                let apart = difference(one.position, two.position);
                let distance = dot(apart, apart).sqrt();
                let normal = apart.map(|part| part / distance);
                let velocity = difference(one.velocity, two.velocity);
                (normal, 2.0 - distance, velocity, sum(one.spin, two.spin))
            }
            _ => (
                [0.0, 1.0, 0.0],
                1.0 - one.position[1],
                one.velocity,
                one.spin,
            ),
        };
        // Sphere 2 feels the pair alone; the torques of a pair are the same on both.
        let (force, torque) = match kind {
            ContactKind::Pair => (two.force.map(|part| -part), two.torque),
            _ => (
                sum(one.force, two.force),
                difference(one.torque, two.torque),
            ),
        };
        (overlap > 0.0).then_some(Row {
            normal,
            overlap,
            velocity,
            spin,
            force,
            torque,
            friction: kind.friction(test),
        })
    })
    .collect()
}

/// A sphere in one row.
#[derive(Debug, Clone, Copy)]
struct Body {
    position: Vector,
    velocity: Vector,
    spin: Vector,
    force: Vector,
    torque: Vector,
}

impl Body {
    fn of(row: &MotionRow, body: usize) -> Self {
        let (plane, beyond): (BodyRow, _) = (row.bodies()[body], row.space[body]);
        let [x, y] = plane.position;
        let [vx, vy] = plane.velocity;
        let [fx, fy] = plane.force;
        let [spinx, spiny] = beyond.spin;
        let [torquex, torquey] = beyond.torque;
        Self {
            position: [x, y, beyond.z],
            velocity: [vx, vy, beyond.vz],
            spin: [spinx, spiny, plane.spin],
            force: [fx, fy, beyond.fz],
            torque: [torquex, torquey, plane.torque],
        }
    }

    /// The sphere with the velocities of half a step before its position, for unit mass and the inertia that the test
    /// asks for, from its rows of that step and of the step `before`.
    fn half_step_earlier(self, before: &Self, test: &ContactTest, clock: &Clock) -> Self {
        let back = (clock.velocity_lag.value - 0.5) * test.time_step;
        let inertia = test.convention.moment_of_inertia;
        let moving = |before: Vector, now: Vector, speed: Vector| {
            std::array::from_fn(|axis| clock.moving(before[axis], now[axis], speed[axis]))
        };
        let (force, torque) = (
            moving(before.force, self.force, self.velocity),
            moving(before.torque, self.torque, self.spin),
        );
        Self {
            velocity: combine(self.velocity, back, force),
            spin: combine(self.spin, back / inertia, torque),
            ..self
        }
    }
}

/// The law by which contacts of one kind are read.
#[derive(Debug, Clone, Copy)]
struct Reader {
    kind: ContactKind,
    convention: ContactConvention,
    stiffness_ratio: f64,
}

/// A contact at one step under a law.
struct Read {
    row: Row,
    at: ContactCoefficients<f64>,
    /// Arms of the surface velocity and of the torque.
    arms: [f64; 2],
    normal_force: f64,
    /// Velocity of the centres in the tangent plane.
    moved: Vector,
    /// Velocity of the surfaces by the spins about x, y and z.
    rolled: [Vector; 3],
    /// Force without its normal part.
    tangential: Vector,
}

impl Read {
    /// Velocity of the surfaces in the tangent plane, with these weights of the spins.
    fn sliding(&self, weights: [f64; 3]) -> Vector {
        weighted(self.moved, weights, self.rolled)
    }
}

impl Reader {
    fn read(&self, row: &Row) -> Read {
        let (law, arms) = match self.kind {
            ContactKind::Pair => (
                self.convention.law(self.stiffness_ratio),
                self.convention.arms.pair,
            ),
            _ => (
                self.convention.wall_law(self.stiffness_ratio),
                self.convention.arms.floor,
            ),
        };
        let at = law.at(row.overlap);
        let arms = [arms.kinematic, arms.torque].map(|arm| 1.0 + arm * row.overlap);
        let separation = dot(row.normal, row.velocity);
        let normal_force = at.normal_force(row.overlap, -separation);
        let rolled = [0, 1, 2].map(|axis| {
            let mut own = [0.0; 3];
            own[axis] = -arms[0] * row.spin[axis];
            cross(own, row.normal)
        });
        Read {
            row: *row,
            at,
            arms,
            normal_force,
            moved: combine(row.velocity, -separation, row.normal),
            rolled,
            tangential: combine(row.force, -normal_force, row.normal),
        }
    }

    /// The rows as long as the bodies are pressed together, and damping has not cancelled most of the elastic force.
    fn pressed<'a>(&'a self, rows: &'a [Row]) -> impl Iterator<Item = Read> + 'a {
        let read = rows.iter().map(|row| self.read(row));
        read.take_while(|read| {
            let elastic = read.at.secant * read.row.overlap;
            read.normal_force > SURELY_PRESSED * elastic
        })
    }

    /// The spring of a contact that sticks, as the law remembers it, if the surfaces move at this velocity.
    fn spring(&self, read: &Read, sliding: Vector) -> Vector {
        let elastic = combine(read.tangential, read.at.damping_tangential, sliding);
        self.remembered(elastic, &read.at)
    }

    /// What damping at this velocity of the surfaces contributes to that spring.
    fn damped(&self, read: &Read, velocity: Vector) -> Vector {
        let damping = velocity.map(|part| part * read.at.damping_tangential);
        self.remembered(damping, &read.at)
    }

    /// The spring that exerts a force, as the law remembers it.
    fn remembered(&self, elastic: Vector, at: &ContactCoefficients<f64>) -> Vector {
        let unit = match self.convention.law.history.keeps_force() {
            true => 1.0,
            false => at.tangential_stiffness,
        };
        elastic.map(|part| -part / unit)
    }

    /// What a motion of the surfaces adds to the spring.
    fn added(&self, velocity: Vector, read: &Read) -> Vector {
        let unit = match self.convention.law.history.keeps_force() {
            true => read.at.tangential_stiffness,
            false => 1.0,
        };
        velocity.map(|part| part * unit * TIME_STEP)
    }

    /// The factor by which a spring shrinks with its contact.
    fn shrunk(&self, before: &Read, now: &Read) -> f64 {
        let shrinks =
            self.convention.law.history.is_rescaled() && now.row.overlap < before.row.overlap;
        match shrinks {
            true => (now.row.overlap / before.row.overlap).sqrt(),
            false => 1.0,
        }
    }

    /// a, b, c and d of the declared convention.
    fn transport(&self) -> [f64; TRANSPORTS] {
        match self.convention.history_update {
            HistoryUpdate::Projected => [0.0, 0.0, 0.0, 0.0],
            HistoryUpdate::Rotated => [1.0, 0.0, 0.0, 0.0],
            HistoryUpdate::Linearised => [0.0, 1.0, 1.0, 0.0],
            HistoryUpdate::Fixed => [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// Returns the weights of transport, spin and torque while contacts stick, and the weights of the spins.
    fn of_sticking(&self, series: &[Vec<Row>]) -> (Vec<Property>, [f64; 3]) {
        let sticks = |read: &Read| {
            let size = dot(read.tangential, read.tangential).sqrt();
            size < SURELY_STICKS * read.row.friction * read.normal_force
        };
        let series = series.iter();
        let series = series.map(|rows| self.pressed(rows).take_while(sticks).collect());
        let series: Vec<Vec<Read>> = series.collect();
        let (found, spins, is_left) = self.fit_springs(&series);
        let turning: Vec<_> = series.iter().flatten().flat_map(torques).collect();
        let names = ["spring_length_kept", "spring_by_product", "spring_twisted"];
        let names = names.into_iter().chain([LEFT_BEHIND]);
        let names = names.chain(["spin_x", "spin_y", "spin_z"]);
        let declared = self.transport().into_iter().chain([1.0; 3]);
        let own = names.zip(found).zip(declared);
        let own = own.filter(|((name, _), _)| is_left || *name != LEFT_BEHIND);
        let torques = ["torque_x", "torque_y", "torque_z"].into_iter();
        let torques = torques.zip(fit_known(&turning)).zip([1.0; 3]);
        let properties = own.chain(torques);
        // The normal of the floor never turns, so that some of these do not show there.
        let properties = properties.filter(|((_, found), _)| {
            found.uncertainty.is_finite() || self.kind == ContactKind::Pair
        });
        let properties = properties.map(|((name, found), declared)| {
            Property::at(self.kind, &format!("space_{name}"), found, declared)
        });
        (properties.collect(), spins)
    }

    /// Returns what [`Self::fit_changes`] finds with the weights of the spins that fit best, these weights, and
    /// whether springs may be left behind by their contacts, which counts only if it is declared or seen.
    fn fit_springs(&self, series: &[Vec<Read>]) -> ([Measured; TERMS], [f64; 3], bool) {
        let fitted = |may_be_left| {
            let mut spins = [1.0; 3];
            let mut found = [Measured::UNKNOWN; TERMS];
            for _ in 0..MOST_FITS {
                found = self.fit_changes(series, spins, may_be_left);
                let next = std::array::from_fn(|axis| {
                    let Measured { value, uncertainty } = found[TRANSPORTS + axis];
                    if uncertainty.is_finite() { value } else { 1.0 }
                });
                if next == spins {
                    break;
                }
                spins = next;
            }
            (found, spins, may_be_left)
        };
        let with = fitted(true);
        let Measured { value, uncertainty } = with.0[TRANSPORTS - 1];
        let is_seen = value.abs() > uncertainty.max(TOLERANCE);
        match self.convention.history_update == HistoryUpdate::Fixed || is_seen {
            true => with,
            false => fitted(false),
        }
    }

    /// a, b, c, d and the weights of the spins, from the changes of springs in a step. The springs that are
    /// transported are computed with the weights `spins` found before; an error in these matters less with every
    /// iteration.
    fn fit_changes(
        &self,
        series: &[Vec<Read>],
        spins: [f64; 3],
        may_be_left: bool,
    ) -> [Measured; TERMS] {
        let mut changes: Vec<([f64; TERMS], f64)> = Vec::new();
        for read in series {
            for two in read.windows(2) {
                let [before, now] = two else { continue };
                let shrunk = self.shrunk(before, now);
                let project = |spring: Vector| {
                    let spring = spring.map(|part| part * shrunk);
                    combine(spring, -dot(now.row.normal, spring), now.row.normal)
                };
                let spring = self.spring(before, before.sliding(spins));
                let effects = transported(spring.map(|part| part * shrunk), before, now).1;
                // The springs if no spin counted.
                let [last, own] = [before, now].map(|read| self.spring(read, read.moved));
                let expected = combine(project(last), 1.0, self.added(now.moved, now));
                let found = combine(own, -1.0, expected);
                // What a spin adds by its motion, and by damping now and before.
                let by_spin = [0, 1, 2].map(|axis| {
                    let before = project(self.damped(before, before.rolled[axis]));
                    let damping = combine(before, -1.0, self.damped(now, now.rolled[axis]));
                    combine(self.added(now.rolled[axis], now), 1.0, damping)
                });
                let [lengthened, product, twisted, left] = effects;
                let left = left.map(|part| part * f64::from(u8::from(may_be_left)));
                let terms = [
                    lengthened, product, twisted, left, by_spin[0], by_spin[1], by_spin[2],
                ];
                changes.extend((0..3).map(|axis| (terms.map(|term| term[axis]), found[axis])));
            }
        }
        fit_known(&changes)
    }

    /// The direction of a force at its limit, while contacts slide: 1 along the direction of the declared rule, 0
    /// across it. The spins count with the weights that were found.
    fn of_sliding(&self, series: &[Vec<Row>], spins: [f64; 3]) -> Vec<Property> {
        let mut terms: Vec<([f64; 2], f64)> = Vec::new();
        for rows in series {
            let read: Vec<Read> = self.pressed(rows).collect();
            let mut spring: Option<Vector> = None;
            for two in read.windows(2) {
                let [before, now] = two else { continue };
                let limit = now.row.friction * now.normal_force.abs();
                let last = spring.unwrap_or_else(|| match self.convention.sliding_spring {
                    // The contact slides from the first step on, so that its spring has stayed unstretched.
                    SlidingSpring::Frozen => [0.0; 3],
                    SlidingSpring::FollowsLimit => self.last_spring(before, spins),
                });
                let last = last.map(|part| part * self.shrunk(before, now));
                let (projected, effects) = transported(last, before, now);
                let weights = self.transport();
                let carried = weighted(projected, weights, effects);
                let sliding = now.sliding(spins);
                let stretched = combine(carried, 1.0, self.added(sliding, now));
                let unit = self.remembered([-1.0, 0.0, 0.0], &now.at)[0];
                let elastic = stretched.map(|part| -part / unit);
                let damping = sliding.map(|part| part * now.at.damping_tangential);
                let sticking = combine(elastic, -1.0, damping);
                let operand = match self.convention.coulomb_operand {
                    CoulombOperand::SpringAndDamping => sticking,
                    CoulombOperand::Spring => elastic,
                };
                let length = dot(operand, operand).sqrt();
                if length < limit {
                    spring = Some(stretched);
                    continue;
                }
                let force = operand.map(|part| part * limit / length);
                let across = cross(now.row.normal, force);
                terms
                    .extend((0..3).map(|axis| ([force[axis], across[axis]], now.tangential[axis])));
                spring = Some(match self.convention.sliding_spring {
                    SlidingSpring::Frozen => carried,
                    SlidingSpring::FollowsLimit => self.last_spring(now, spins),
                });
            }
        }
        let [along, across] = fit_known(&terms);
        vec![
            Property::at(self.kind, "space_sliding_along", along, 1.0),
            Property::at(self.kind, "space_sliding_across", across, 0.0),
        ]
    }

    /// The spring behind the force of a contact, at its limit or not.
    fn last_spring(&self, read: &Read, spins: [f64; 3]) -> Vector {
        let limit = read.row.friction * read.normal_force.abs();
        let size = dot(read.tangential, read.tangential).sqrt();
        let is_capped = (size / limit - 1.0).abs() < LEAST;
        let damps = match self.convention.coulomb_operand {
            CoulombOperand::SpringAndDamping => true,
            CoulombOperand::Spring => !is_capped,
        };
        match damps {
            true => self.spring(read, read.sliding(spins)),
            false => self.remembered(read.tangential, &read.at),
        }
    }
}

/// A spring projected onto the new tangent plane, and what each other transport adds to that.
fn transported(spring: Vector, before: &Read, now: &Read) -> (Vector, [Vector; TRANSPORTS]) {
    let (old, new) = (before.row.normal, now.row.normal);
    let along = dot(new, spring);
    let projected = combine(spring, -along, new);
    let left = dot(projected, projected);
    let ratio = if left > 0.0 {
        dot(spring, spring) / left
    } else {
        1.0
    };
    let lengthened = projected.map(|part| part * (ratio.sqrt() - 1.0));
    // What such a spring keeps along the old normal turns with it.
    let kept = dot(old, spring);
    let product = combine(new, -1.0, old).map(|part| part * along);
    let product = combine(product, kept, new);
    let twist = 0.5 * TIME_STEP * dot(old, now.row.spin);
    let twisted = cross(old, combine(spring, kept, new)).map(|part| part * twist);
    let left = new.map(|part| part * along);
    (projected, [lengthened, product, twisted, left])
}

/// Each component of the torque on a body, with that of −R n × f as its term.
fn torques(read: &Read) -> [([f64; 3], f64); 3] {
    let expected = cross(read.row.normal, read.tangential).map(|part| -read.arms[1] * part);
    [0, 1, 2].map(|axis| {
        let mut terms = [0.0; 3];
        terms[axis] = expected[axis];
        (terms, read.row.torque[axis])
    })
}

/// The coefficients of those terms that occur; the others are unknown.
fn fit_known<const N: usize>(rows: &[([f64; N], f64)]) -> [Measured; N] {
    let size = |index: usize| {
        let terms = rows.iter().map(|(terms, _)| terms[index].abs());
        terms.fold(0.0, f64::max)
    };
    let sizes: [f64; N] = std::array::from_fn(size);
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let known: Vec<usize> = (0..N)
        .filter(|&index| sizes[index] > LEAST * largest)
        .collect();
    let reduced = rows.iter().map(|(terms, target)| {
        let terms = known.iter().map(|&index| terms[index]);
        (terms.collect(), *target)
    });
    let found = fit_rows(&reduced.collect::<Vec<_>>(), known.len());
    let mut all = [Measured::UNKNOWN; N];
    for (index, found) in known.into_iter().zip(found) {
        all[index] = found;
    }
    all
}

/// left + factor right.
fn combine(left: Vector, factor: f64, right: Vector) -> Vector {
    std::array::from_fn(|axis| left[axis] + factor * right[axis])
}

/// start + Σ weight · vector.
fn weighted<const N: usize>(start: Vector, weights: [f64; N], vectors: [Vector; N]) -> Vector {
    let terms = weights.into_iter().zip(vectors);
    terms.fold(start, |sum, (weight, vector)| combine(sum, weight, vector))
}

fn dot(left: Vector, right: Vector) -> f64 {
    left.iter()
        .zip(right)
        .map(|(left, right)| left * right)
        .sum()
}

fn cross(left: Vector, right: Vector) -> Vector {
    [
        left[1] * right[2] - left[2] * right[1],
        left[2] * right[0] - left[0] * right[2],
        left[0] * right[1] - left[1] * right[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::run_contact_test;
    use crate::model::Law;

    /// The properties of the native code under one convention, read as if another were declared.
    fn read_as(own: ContactConvention, declared: ContactConvention) -> Vec<Property> {
        let tests: Vec<ContactTest> = tests(&own);
        let motions: Vec<Motion> = tests
            .iter()
            .map(|test| run_contact_test(test).unwrap())
            .collect();
        let asked: Vec<ContactTest> = super::tests(&declared);
        let outcomes: Vec<_> = asked.iter().zip(&motions).collect();
        let clock = Clock {
            mass: Measured::new(1.0, 0.0),
            moment_of_inertia: Measured::new(own.moment_of_inertia, 0.0),
            velocity_lag: Measured::new(0.5, 0.0),
            force_lag: None,
            local_damping: None,
            grain: 1,
        };
        let declared = Declaration {
            convention: declared,
            velocity_lag: 0.5,
            left_out: Vec::new(),
            in_space: true,
        };
        properties(&outcomes, &clock, &declared)
    }

    /// The properties that are not as declared.
    fn wrong(properties: &[Property]) -> Vec<&str> {
        let is_wrong = |own: &&Property| {
            let Measured { value, uncertainty } = own.measured;
            let error = (value - own.declared.unwrap_or(f64::NAN)).abs();
            error.is_nan() || error > 1e-9_f64.max(uncertainty)
        };
        let wrong = properties.iter().filter(is_wrong);
        wrong.map(|own| own.name.as_str()).collect()
    }

    fn conventions() -> Vec<ContactConvention> {
        let mut all = Vec::new();
        for law in [Law::LINEAR, Law::HERTZ] {
            for history_update in HistoryUpdate::ALL {
                for (coulomb_operand, sliding_spring) in [
                    (CoulombOperand::Spring, SlidingSpring::FollowsLimit),
                    (
                        CoulombOperand::SpringAndDamping,
                        SlidingSpring::FollowsLimit,
                    ),
                    (CoulombOperand::SpringAndDamping, SlidingSpring::Frozen),
                ] {
                    all.push(ContactConvention {
                        history_update,
                        coulomb_operand,
                        sliding_spring,
                        ..ContactConvention::with_law(law)
                    });
                }
            }
        }
        all
    }

    #[test]
    fn every_convention_of_the_native_code_is_read_as_it_is() {
        for own in conventions() {
            let found = read_as(own, own);
            assert!(found.len() > 12, "{found:?}");
            assert_eq!(wrong(&found), Vec::<&str>::new(), "{own:?} {found:#?}");
        }
    }

    #[test]
    fn another_transport_of_the_spring_is_named() {
        let with = |history_update| ContactConvention {
            history_update,
            ..ContactConvention::TURNING
        };
        let projected = with(HistoryUpdate::Projected);
        let found = read_as(with(HistoryUpdate::Rotated), projected);
        assert!(wrong(&found).contains(&"pair_space_spring_length_kept"));
        let found = read_as(with(HistoryUpdate::Linearised), projected);
        let named = wrong(&found);
        for name in [
            "pair_space_spring_by_product",
            "pair_space_spring_twisted",
            "floor_space_spring_twisted",
        ] {
            assert!(named.contains(&name), "{named:?}");
        }
    }
}
