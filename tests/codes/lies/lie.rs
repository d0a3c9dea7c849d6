//! Lies: what an engine may do otherwise than it says, and what that truly changes.

use tristack::dem::{Contact, ContactForce, ContactModel, Counterpart, Spring, SpringDashpot};
use tristack::model::{Case, ContactConvention, Problem, Stack};
use tristack::series::Sample;
use tristack::study::yield_force::Measurement;
use tristack::theory::quasistatic_limit;

/// What is altered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Nothing,
    // In the computation.
    FloorFriction,
    FrictionUntilThePeak,
    /// Friction that falls as soon as the floor slides.
    StaticFriction,
    CylinderFriction,
    NormalStiffness,
    TangentialStiffness,
    Gravity,
    WallSpeed,
    PairTorqueArm,
    PairKinematicArm,
    FloorTorqueArm,
    FloorKinematicArm,
    Restitution,
    FloorDamping,
    MomentOfInertia,
    // In what is written.
    WallForce,
    WallForceOffset,
    WallForceNoise,
    FloorForces,
    FloorNormals,
    FloorShears,
    OneSide,
    Position,
    BothSides,
    Height,
    Displacement,
    Spread,
    Start,
    FirstRow,
    MadeUp,
    /// The numbers are true, and printed with few digits.
    FewDigits,
}

impl Kind {
    pub const ALL: [Self; 31] = [
        Self::FloorFriction,
        Self::FrictionUntilThePeak,
        Self::StaticFriction,
        Self::CylinderFriction,
        Self::NormalStiffness,
        Self::TangentialStiffness,
        Self::Gravity,
        Self::WallSpeed,
        Self::PairTorqueArm,
        Self::PairKinematicArm,
        Self::FloorTorqueArm,
        Self::FloorKinematicArm,
        Self::Restitution,
        Self::FloorDamping,
        Self::MomentOfInertia,
        Self::WallForce,
        Self::WallForceOffset,
        Self::WallForceNoise,
        Self::FloorForces,
        Self::FloorNormals,
        Self::FloorShears,
        Self::OneSide,
        Self::Position,
        Self::BothSides,
        Self::Height,
        Self::Displacement,
        Self::Spread,
        Self::Start,
        Self::FirstRow,
        Self::MadeUp,
        Self::FewDigits,
    ];
}

/// A lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lie {
    pub kind: Kind,
    /// Relative to what is altered; for arms the change of the coefficient; for the cylinder friction relative to
    /// b/a at the yield; for positions and offsets in units of the load.
    pub size: f64,
    /// Which of several columns, and the seed of noise.
    pub pick: u64,
}

impl Lie {
    pub fn none() -> Self {
        Self::of(Kind::Nothing, 0.0)
    }

    pub fn of(kind: Kind, size: f64) -> Self {
        Self {
            kind,
            size,
            pick: 0,
        }
    }

    /// A lie of `kind` at random: any size from far below what can be seen to gross.
    pub fn drawn(kind: Kind, random: &mut fastrand::Rng) -> Self {
        let size = 10f64.powf(-9.0 + 8.7 * random.f64());
        Self {
            kind,
            size: if random.bool() { size } else { -size },
            pick: random.u64(..),
        }
    }

    /// The case that the engine computes in place of `case`.
    pub fn computed(&self, case: &Case, pair_friction: f64) -> Case {
        let mut altered = *case;
        let factor = 1.0 + self.size;
        self.alter(&mut altered.stack, &mut altered.convention, pair_friction);
        if self.kind == Kind::WallSpeed {
            let protocol = &mut altered.protocol;
            protocol.wall_speed *= factor;
            protocol.wall_travel *= factor;
            protocol.sampling.fine_from_travel *= factor;
        }
        altered
    }

    fn alter(&self, stack: &mut Stack, convention: &mut ContactConvention, pair_friction: f64) {
        let factor = 1.0 + self.size;
        match self.kind {
            Kind::FloorFriction => stack.floor_friction *= factor,
            Kind::CylinderFriction => stack.cylinder_friction = pair_friction * factor,
            Kind::TangentialStiffness => stack.stiffness_ratio /= factor,
            Kind::Gravity => stack.stiffness /= factor,
            Kind::PairTorqueArm => convention.arms.pair.torque += self.size,
            Kind::PairKinematicArm => convention.arms.pair.kinematic += self.size,
            Kind::FloorTorqueArm => convention.arms.floor.torque += self.size,
            Kind::FloorKinematicArm => convention.arms.floor.kinematic += self.size,
            Kind::Restitution => convention.restitution *= 1.0 - self.size.abs(),
            Kind::MomentOfInertia => convention.moment_of_inertia *= factor,
            _ => {}
        }
    }

    /// By how much the force at which the altered stack yields is off, relative to F + 3: by theory, not by running it.
    pub fn moves_yield_force_by(&self, measurement: &Measurement) -> f64 {
        let limit = &measurement.limit;
        let force = limit.yield_force.expect("it yields");
        let pair_friction = limit.pair_friction.expect("it yields");
        let (mut stack, mut convention) = (measurement.stack, measurement.convention);
        self.alter(&mut stack, &mut convention, pair_friction);
        let mut unit = 1.0;
        match self.kind {
            Kind::FrictionUntilThePeak | Kind::StaticFriction => {
                stack.floor_friction *= 1.0 + self.size;
            }
            Kind::NormalStiffness => {
                stack.stiffness *= 1.0 + self.size;
                stack.stiffness_ratio *= 1.0 + self.size;
            }
            Kind::Gravity => unit = 1.0 + self.size,
            Kind::CylinderFriction => return self.pair_slip(measurement, pair_friction),
            Kind::WallForce => return (self.size * force / (force + 3.0)).abs(),
            Kind::WallForceOffset => return self.size.abs(),
            _ => {}
        }
        let Ok(altered) = Problem::new(stack, convention) else {
            // Theory ends where the range of an arm does. As much to the other side moves the force about as far.
            let size = -self.size;
            return Self { size, ..*self }.moves_yield_force_by(measurement);
        };
        let altered = quasistatic_limit(&altered).yield_force;
        altered.map_or(f64::INFINITY, |altered| {
            (altered * unit - force).abs() / (force + 3.0)
        })
    }

    /// The force at which the cylinders slip before the floor does, which is that at which the floor would slip with
    /// less friction: the path of equilibria depends on neither friction.
    fn pair_slip(&self, measurement: &Measurement, pair_friction: f64) -> f64 {
        if self.size >= 0.0 {
            return 0.0;
        }
        let wanted = pair_friction * (1.0 + self.size);
        let at = |factor: f64| {
            let stack = Stack {
                floor_friction: measurement.stack.floor_friction * factor,
                ..measurement.stack
            };
            let problem = Problem::new(stack, measurement.convention);
            quasistatic_limit(&problem.expect("values in range"))
        };
        let (mut low, mut high) = (0.3, 1.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            match at(middle).pair_friction {
                Some(ratio) if ratio > wanted => high = middle,
                _ => low = middle,
            }
        }
        let force = measurement.limit.yield_force.expect("it yields");
        let slipped = at(high).yield_force.unwrap_or(0.0);
        (force - slipped) / (force + 3.0)
    }

    /// How far what is written is off, in units of the load, where that contradicts mechanics.
    pub fn is_off_by(&self, _: &Measurement) -> f64 {
        match self.kind {
            Kind::FloorForces
            | Kind::FloorNormals
            | Kind::OneSide
            | Kind::Position
            | Kind::BothSides
            | Kind::Height
            | Kind::WallForceNoise
            | Kind::Start
            | Kind::FirstRow => self.size.abs(),
            // Displacements are of the order of the load, and the wall goes with its speed.
            Kind::FloorShears | Kind::Displacement | Kind::Spread | Kind::WallSpeed => {
                0.1 * self.size.abs()
            }
            // The floor sinks by some thousandth of the load in a unit of time.
            Kind::FloorDamping => 0.01 * self.size.abs(),
            Kind::MadeUp => 1.0,
            _ => 0.0,
        }
    }

    /// Alters the rows that are written; `load` is (F + 3) m g in k_n r.
    pub fn write(&self, rows: &mut [Sample], load: f64) {
        let first = rows[0];
        let mut random = fastrand::Rng::with_seed(self.pick);
        let factor = 1.0 + self.size;
        let shift = self.size * load;
        for row in rows {
            match self.kind {
                Kind::WallForce => row.wall_force *= factor,
                Kind::WallForceOffset => row.wall_force += shift,
                Kind::WallForceNoise => row.wall_force += shift * (2.0 * random.f64() - 1.0),
                Kind::FloorForces => self.scale(row, [factor; 4]),
                Kind::FloorNormals => self.scale(row, [factor, 1.0, factor, 1.0]),
                Kind::FloorShears => self.scale(row, [1.0, factor, 1.0, factor]),
                Kind::OneSide => self.scale(row, [factor, factor, 1.0, 1.0]),
                Kind::Position => *self.coordinate(row, 6) += shift,
                Kind::BothSides => {
                    row.bodies[1].position[0] += shift;
                    row.bodies[2].position[0] -= shift;
                }
                Kind::Height => {
                    row.bodies[1].position[1] += shift;
                    row.bodies[2].position[1] += shift;
                }
                Kind::Displacement => {
                    let mut begun = first;
                    let start = *self.coordinate(&mut begun, 5);
                    let value = self.coordinate(row, 5);
                    *value = start + factor * (*value - start);
                }
                Kind::Spread => {
                    row.bodies[1].position[0] +=
                        self.size * (row.bodies[1].position[0] - first.bodies[1].position[0]);
                    row.bodies[2].position[0] +=
                        self.size * (row.bodies[2].position[0] - first.bodies[2].position[0]);
                }
                Kind::Start => {
                    for body in &mut row.bodies[..3] {
                        body.position[1] += shift;
                    }
                }
                Kind::FirstRow if row.step == 0 => {
                    row.bodies[1].position[0] += shift;
                    row.bodies[2].position[0] -= shift;
                }
                Kind::MadeUp => {
                    let across = |body: usize| [row.floor[body][0], 0.5 * load, 0.0];
                    *row = Sample {
                        floor: [[0.0; 3], across(1), across(2), [0.0; 3], [0.0; 3], [0.0; 3]],
                        bodies: Default::default(),
                        ..*row
                    }
                }
                Kind::FewDigits => self.print(row),
                _ => {}
            }
        }
    }

    /// Prints every number with four to eleven digits.
    fn print(&self, row: &mut Sample) {
        let decimals = usize::try_from(3 + self.pick % 8).expect("a small number");
        let bodies = row.bodies.iter_mut();
        let placed = bodies.flat_map(|body| body.position.iter_mut().chain(&mut body.rotation));
        let numbers = placed.chain(row.floor.as_flattened_mut());
        let numbers = numbers.chain([&mut row.wall_force]);
        for number in numbers {
            *number = format!("{number:.decimals$e}").parse().expect("a number");
        }
    }

    fn scale(&self, row: &mut Sample, factors: [f64; 4]) {
        let [_, [right_t, right_n, _], [left_t, left_n, _], ..] = &mut row.floor;
        let forces = [right_n, right_t, left_n, left_t];
        for (force, factor) in forces.into_iter().zip(factors) {
            *force *= factor;
        }
    }

    /// One of the coordinates; x₁, which stays 0, is the last.
    fn coordinate<'a>(&self, row: &'a mut Sample, count: u64) -> &'a mut f64 {
        let pick = usize::try_from(self.pick % count).expect("a small number");
        let (body, axis) = [(0, 1), (1, 0), (1, 1), (2, 0), (2, 1), (0, 0)][pick];
        &mut row.bodies[body].position[axis]
    }
}

/// A contact law that lies.
#[derive(Debug, Clone, Copy)]
pub struct LyingLaw {
    pub law: SpringDashpot<f64>,
    pub lie: Lie,
    /// Sliding speed from which the friction is the one that was asked for, where it is larger before.
    pub slow: f64,
}

impl ContactModel<f64> for LyingLaw {
    type Memory = Spring<f64>;

    fn initial(&self, number: f64) -> Spring<f64> {
        self.law.initial(number)
    }

    fn evaluate(&self, contact: &Contact<f64>, memory: &mut Spring<f64>) -> ContactForce<f64> {
        let mut altered = *contact;
        let is_floor = contact.counterpart == Counterpart::Wall;
        let arm = 1.0 + self.law.arms.floor.kinematic * contact.overlap;
        let sliding = (contact.sliding_speed - arm * contact.spin).abs();
        match self.lie.kind {
            Kind::FrictionUntilThePeak | Kind::StaticFriction
                if is_floor && sliding < self.slow =>
            {
                altered.friction *= 1.0 + self.lie.size;
            }
            Kind::NormalStiffness => altered.overlap *= 1.0 + self.lie.size,
            _ => {}
        }
        let mut law = self.law;
        if self.lie.kind == Kind::FloorDamping && contact.normal[1] > 0.5 && is_floor {
            law.law.damping_normal *= 1.0 + self.lie.size;
        }
        let force = law.evaluate(&altered, memory);
        if self.lie.kind != Kind::NormalStiffness {
            return force;
        }
        let arms = match contact.counterpart {
            Counterpart::Cylinder => self.law.arms.pair,
            Counterpart::Wall => self.law.arms.floor,
        };
        ContactForce {
            arm: 1.0 + arms.torque * contact.overlap,
            ..force
        }
    }
}
