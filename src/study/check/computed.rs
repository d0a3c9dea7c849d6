//! Mistakes in computing: the native DEM makes them, and writes the series of the code.

use super::beside::Beside;
use super::factor::{of_factor, of_friction};
use super::rows::{Row, at_time, index, rows_of};
use crate::dem::{
    Contact, ContactForce, ContactModel, Counterpart, Spring, SpringDashpot, compress_stack_with,
};
use crate::model::{Case, Preparation};
use rayon::prelude::*;

/// Range in which factors are looked for, and the number of factors that are tried first.
const LARGEST_FACTOR: f64 = 30.0;
const FIRST_TRIES: i32 = 12;
const REFINEMENTS: usize = 30;
/// Mistakes that fit as well as the best one are named too.
const AS_WELL: f64 = 3.0;
const MOST_CAUSES: usize = 3;
/// Relative distance at which two travels of the wall count as the same: its first touch rings.
const SAME_TRAVEL: f64 = 0.03;

/// The mistakes that explain the series of `case`, best first.
pub(super) fn explanations(beside: &Beside, case: &Case) -> Vec<String> {
    let single = single_mistakes(case);
    let single = single.into_par_iter().filter_map(|mistake| {
        let rows = mistake.rows()?;
        let explains = beside.explains(&rows, &beside.columns);
        explains.then(|| (beside.distance(&rows, &beside.columns), mistake.text))
    });
    let mut fitting: Vec<(f64, String)> = single.collect();
    fitting.extend(late_wall(beside, case));
    if fitting.is_empty() {
        let fitted = Parameter::ALL.into_par_iter();
        fitting = fitted
            .filter_map(|parameter| parameter.fit(beside, case))
            .collect();
    }
    fitting.sort_by(|left, right| left.0.total_cmp(&right.0));
    let best = fitting.first().map_or(0.0, |best| best.0);
    let as_good = fitting
        .into_iter()
        .take_while(|(rest, _)| *rest <= AS_WELL * best.max(1e-6));
    let mut causes: Vec<String> = as_good.map(|(_, text)| text).collect();
    causes.truncate(MOST_CAUSES);
    causes
}

/// The series of the native DEM in every step.
pub(super) fn every_step(case: &Case) -> Vec<Row> {
    let mut dense = Mistake::new(case, "");
    let protocol = &mut dense.case.protocol;
    protocol.sampling.fine_interval = protocol.time_step;
    protocol.sampling.coarse_interval = protocol.time_step;
    dense.rows().unwrap_or_default()
}

/// Factors on the coefficients of one kind of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Change {
    normal_stiffness: f64,
    tangential_stiffness: f64,
    normal_damping: f64,
    tangential_damping: f64,
    friction: f64,
    /// On the spins in the surface velocity.
    spin: f64,
    /// On the torque.
    torque: f64,
}

impl Change {
    const NONE: Self = Self {
        normal_stiffness: 1.0,
        tangential_stiffness: 1.0,
        normal_damping: 1.0,
        tangential_damping: 1.0,
        friction: 1.0,
        spin: 1.0,
        torque: 1.0,
    };
}

/// The law of a case with mistakes.
#[derive(Debug, Clone, Copy)]
struct MistakenLaw {
    law: SpringDashpot<f64>,
    pair: Change,
    floor: Change,
    wall: Change,
}

impl MistakenLaw {
    fn of(case: &Case) -> Self {
        Self {
            law: SpringDashpot::like(0.0, &case.convention, case.stack.stiffness_ratio),
            pair: Change::NONE,
            floor: Change::NONE,
            wall: Change::NONE,
        }
    }

    /// Sets the frictions of the floor and between cylinders.
    fn use_frictions(&mut self, case: &Case, floor: f64, cylinders: f64) {
        self.floor.friction = floor / case.stack.floor_friction;
        self.pair.friction = cylinders / case.stack.cylinder_friction;
    }

    fn everywhere(&mut self, change: impl Fn(&mut Change)) {
        [&mut self.pair, &mut self.floor, &mut self.wall]
            .into_iter()
            .for_each(change);
    }
}

impl ContactModel<f64> for MistakenLaw {
    type Memory = Spring<f64>;

    fn initial(&self, number: f64) -> Spring<f64> {
        self.law.initial(number)
    }

    fn evaluate(&self, contact: &Contact<f64>, memory: &mut Spring<f64>) -> ContactForce<f64> {
        let change = match contact.counterpart {
            Counterpart::Cylinder => &self.pair,
            Counterpart::Wall if contact.normal[1] > 0.0 => &self.floor,
            Counterpart::Wall => &self.wall,
        };
        let mut law = self.law;
        law.law.tangential_stiffness *= change.tangential_stiffness;
        law.law.damping_normal *= change.normal_damping;
        law.law.damping_tangential *= change.tangential_damping;
        let altered = Contact {
            overlap: contact.overlap * change.normal_stiffness,
            friction: contact.friction * change.friction,
            spin: contact.spin * change.spin,
            ..*contact
        };
        let force = law.evaluate(&altered, memory);
        ContactForce {
            arm: force.arm * change.torque,
            ..force
        }
    }
}

/// A mistake, as the native DEM makes it.
struct Mistake {
    text: String,
    case: Case,
    law: MistakenLaw,
}

impl Mistake {
    fn new(case: &Case, text: &str) -> Self {
        let (text, law) = (text.to_owned(), MistakenLaw::of(case));
        Self {
            text,
            case: *case,
            law,
        }
    }

    fn rows(&self) -> Option<Vec<Row>> {
        let series = compress_stack_with(&self.case, self.law, || true).ok()?;
        Some(rows_of(&series))
    }
}

/// Mistakes without a size.
fn single_mistakes(case: &Case) -> Vec<Mistake> {
    let (floor, cylinders) = (case.stack.floor_friction, case.stack.cylinder_friction);
    let of_law = |text: &str, change: &dyn Fn(&mut MistakenLaw)| {
        let mut mistake = Mistake::new(case, text);
        change(&mut mistake.law);
        mistake
    };
    let mut sudden = Mistake::new(
        case,
        "gravity is there at once, and must rise over `ramp_steps` as x^3 (10 - 15 x + 6 x^2)",
    );
    if let Preparation::GravityRamp {
        ramp_time,
        rest_time,
    } = &mut sudden.case.protocol.preparation
    {
        let short = case.protocol.sampling.fine_interval;
        (*ramp_time, *rest_time) = (short, *ramp_time + *rest_time - short);
    }
    let mut unrested = Mistake::new(
        case,
        "the stack does not rest for `rest_steps` before the wall moves",
    );
    if let Preparation::GravityRamp { rest_time, .. } = &mut unrested.case.protocol.preparation {
        *rest_time = case.protocol.sampling.fine_interval;
    }
    let mut still = Mistake::new(
        case,
        "the cylinders do not turn: the torque is never applied, or rotation is switched off",
    );
    still.case.convention.moment_of_inertia = 1e12;
    vec![
        sudden,
        unrested,
        still,
        of_law(
            "the spin enters the surface velocity with the wrong sign",
            &|law| law.everywhere(|change| change.spin = -1.0),
        ),
        of_law(
            "the spin enters the surface velocity of pairs with the wrong sign",
            &|law| law.pair.spin = -1.0,
        ),
        of_law(
            "the spin enters the surface velocity at the floor with the wrong sign",
            &|law| law.floor.spin = -1.0,
        ),
        of_law("the surface velocity leaves out the spin", &|law| {
            law.everywhere(|change| change.spin = 0.0)
        }),
        of_law(
            "the surface velocity at the floor leaves out the spin",
            &|law| law.floor.spin = 0.0,
        ),
        of_law(
            "the surface velocity of pairs leaves out the spin",
            &|law| law.pair.spin = 0.0,
        ),
        of_law("the torque has the wrong sign", &|law| {
            law.everywhere(|change| change.torque = -1.0)
        }),
        of_law("the floor exerts no torque", &|law| law.floor.torque = 0.0),
        of_law("the floor exerts its torque with the wrong sign", &|law| {
            law.floor.torque = -1.0
        }),
        of_law("pairs exert no torque", &|law| law.pair.torque = 0.0),
        of_law(
            "the torque of pairs has the wrong sign on one of them or on both",
            &|law| law.pair.torque = -1.0,
        ),
        of_law("nothing is damped", &|law| {
            law.everywhere(|change| (change.normal_damping, change.tangential_damping) = (0.0, 0.0))
        }),
        of_law(
            "floor_friction and cylinder_friction are exchanged",
            &|law| law.use_frictions(case, cylinders, floor),
        ),
        of_law("floor_friction serves for the cylinders too", &|law| {
            law.use_frictions(case, floor, floor)
        }),
        of_law("cylinder_friction serves for the floor too", &|law| {
            law.use_frictions(case, cylinders, cylinders)
        }),
        of_law(
            "the floor has the mean of floor_friction and cylinder_friction",
            &|law| {
                law.use_frictions(case, 0.5 * (floor + cylinders), cylinders);
            },
        ),
        of_law(
            "the floor has the geometric mean of floor_friction and cylinder_friction",
            &|law| {
                law.use_frictions(case, (floor * cylinders).sqrt(), cylinders);
            },
        ),
        of_law("the floor has no friction", &|law| law.floor.friction = 0.0),
        of_law(
            "the floor never slides: its tangential force is not capped",
            &|law| law.floor.friction = 1e6,
        ),
        of_law("there is no friction between cylinders", &|law| {
            law.pair.friction = 0.0
        }),
        of_law("there is no friction anywhere", &|law| {
            law.everywhere(|change| change.friction = 0.0)
        }),
    ]
}

/// The whole series is late or early, because the wall does not just touch when it begins to move.
fn late_wall(beside: &Beside, case: &Case) -> Option<(f64, String)> {
    let [force, time, height] = ["wall_force", "time", "y1"].map(index);
    let load = beside
        .expected
        .iter()
        .map(|row| row[force])
        .fold(0.0, f64::max);
    let rows = beside.dense;
    let reaches = |rows: &[Row]| {
        let after = rows
            .iter()
            .position(|row| row[force] > 0.3 * load)
            .filter(|&row| row > 0)?;
        let [one, two] = [&rows[after - 1], &rows[after]];
        Some(
            one[time]
                + (two[time] - one[time]) * (0.3 * load - one[force]) / (two[force] - one[force]),
        )
    };
    let late = reaches(beside.found)? - reaches(rows)?;
    let columns = &beside.columns;
    let shifted = |late: f64| -> Vec<Row> {
        let times = beside.expected.iter().map(|row| row[time]);
        times.map(|moment| at_time(rows, moment - late)).collect()
    };
    let between = case.protocol.sampling.coarse_interval;
    let distance = |late: f64| beside.distance(&shifted(late), columns);
    let late = minimum(&distance, late - between, late + between);
    let shifted = shifted(late);
    if late.abs() < case.protocol.time_step || !beside.explains(&shifted, columns) {
        return None;
    }
    let travel = late * case.protocol.wall_speed;
    let sunk = 1.0 + 3f64.sqrt() - rows[0][height];
    let place = match (travel / sunk - 1.0).abs() < SAME_TRAVEL {
        true => {
            "it starts above the stack as it was before gravity, and must start at the present top of cylinder 1"
        }
        false => "it must start at the present top of cylinder 1, y1 + 1, and move from step 0 on",
    };
    Some((
        beside.distance(&shifted, columns),
        format!(
            "the wall touches too {}: by {:.6} r of its travel ({:.1} steps); {place}",
            if late > 0.0 { "late" } else { "early" },
            travel.abs(),
            (late / case.protocol.time_step).abs()
        ),
    ))
}

/// A number of the task that may be another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Parameter {
    FloorFriction,
    PairFriction,
    NormalStiffness,
    PairStiffness,
    FloorStiffness,
    WallStiffness,
    TangentialStiffness,
    PairTangentialStiffness,
    FloorTangentialStiffness,
    Damping,
    Gravity,
    WallSpeed,
    TimeStep,
}

impl Parameter {
    const ALL: [Self; 13] = [
        Self::FloorFriction,
        Self::PairFriction,
        Self::NormalStiffness,
        Self::PairStiffness,
        Self::FloorStiffness,
        Self::WallStiffness,
        Self::TangentialStiffness,
        Self::PairTangentialStiffness,
        Self::FloorTangentialStiffness,
        Self::Damping,
        Self::Gravity,
        Self::WallSpeed,
        Self::TimeStep,
    ];

    /// The name in messages, and the value that was asked for.
    fn asked(self, case: &Case) -> (&'static str, f64) {
        let law = case.convention.law(case.stack.stiffness_ratio);
        match self {
            Self::FloorFriction => ("floor_friction", case.stack.floor_friction),
            Self::PairFriction => ("cylinder_friction", case.stack.cylinder_friction),
            Self::NormalStiffness => ("normal_stiffness", law.normal_stiffness),
            Self::PairStiffness => ("normal_stiffness between cylinders", law.normal_stiffness),
            Self::FloorStiffness => ("normal_stiffness of the floor", law.normal_stiffness),
            Self::WallStiffness => ("normal_stiffness of the top wall", law.normal_stiffness),
            Self::TangentialStiffness => ("tangential_stiffness", law.tangential_stiffness),
            Self::PairTangentialStiffness => (
                "tangential_stiffness between cylinders",
                law.tangential_stiffness,
            ),
            Self::FloorTangentialStiffness => (
                "tangential_stiffness of the floor",
                law.tangential_stiffness,
            ),
            Self::Damping => ("damping_normal and damping_tangential", law.damping_normal),
            Self::Gravity => (
                "gravity, or the mass on which it acts,",
                case.stack.epsilon(),
            ),
            Self::WallSpeed => ("wall_speed", case.protocol.wall_speed),
            Self::TimeStep => ("time_step", case.protocol.time_step),
        }
    }

    /// The mistake in which it is `factor` times what was asked for.
    fn mistaken(self, case: &Case, factor: f64) -> Mistake {
        let mut mistake = Mistake::new(case, "");
        let (law, protocol) = (&mut mistake.law, &mut mistake.case.protocol);
        match self {
            Self::FloorFriction => law.floor.friction = factor,
            Self::PairFriction => law.pair.friction = factor,
            Self::NormalStiffness => law.everywhere(|change| change.normal_stiffness = factor),
            Self::PairStiffness => law.pair.normal_stiffness = factor,
            Self::FloorStiffness => law.floor.normal_stiffness = factor,
            Self::WallStiffness => law.wall.normal_stiffness = factor,
            Self::TangentialStiffness => {
                law.everywhere(|change| change.tangential_stiffness = factor)
            }
            Self::PairTangentialStiffness => law.pair.tangential_stiffness = factor,
            Self::FloorTangentialStiffness => law.floor.tangential_stiffness = factor,
            Self::Damping => law.everywhere(|change| {
                (change.normal_damping, change.tangential_damping) = (factor, factor);
            }),
            Self::Gravity => mistake.case.stack.stiffness /= factor,
            Self::WallSpeed => {
                protocol.wall_speed *= factor;
                protocol.wall_travel *= factor;
                protocol.sampling.fine_from_travel *= factor;
            }
            Self::TimeStep => {
                protocol.time_step *= factor;
                protocol.wall_travel *= factor;
                protocol.sampling.fine_from_travel *= factor;
                protocol.sampling.fine_interval *= factor;
                protocol.sampling.coarse_interval *= factor;
                if let Preparation::GravityRamp {
                    ramp_time,
                    rest_time,
                } = &mut protocol.preparation
                {
                    *ramp_time *= factor;
                    *rest_time *= factor;
                }
            }
        }
        mistake
    }

    /// The value with which the native DEM comes nearest to what was found, if that explains it.
    fn fit(self, beside: &Beside, case: &Case) -> Option<(f64, String)> {
        let distance = |exponent: f64| {
            let rows = self.mistaken(case, exponent.exp()).rows();
            rows.map_or(f64::INFINITY, |rows| {
                beside.distance(&rows, &beside.columns)
            })
        };
        let spacing = LARGEST_FACTOR.ln() / f64::from(FIRST_TRIES);
        let tries = (-FIRST_TRIES..=FIRST_TRIES).map(|index| f64::from(index) * spacing);
        let nearest = tries.min_by(|left, right| distance(*left).total_cmp(&distance(*right)))?;
        let factor = minimum(&distance, nearest - spacing, nearest + spacing).exp();
        let rows = self.mistaken(case, factor).rows()?;
        let explains = beside.explains(&rows, &beside.columns);
        explains.then(|| {
            (
                beside.distance(&rows, &beside.columns),
                self.described(case, factor),
            )
        })
    }

    fn described(self, case: &Case, factor: f64) -> String {
        let (name, asked) = self.asked(case);
        let stack = &case.stack;
        let (value, kappa) = (asked * factor, stack.stiffness_ratio);
        let mut meanings = match self {
            Self::FloorFriction => of_friction(value, asked, stack.cylinder_friction),
            Self::PairFriction => of_friction(value, asked, stack.floor_friction),
            _ => of_factor(factor, stack.epsilon()),
        };
        let is_shear = [
            Self::TangentialStiffness,
            Self::PairTangentialStiffness,
            Self::FloorTangentialStiffness,
        ]
        .contains(&self);
        if is_shear {
            let own = [
                (kappa * kappa, "k_n and k_t are exchanged in their ratio"),
                (kappa, "k_t = k_n: the normal stiffness serves for both"),
            ];
            meanings.extend(super::factor::meanings(
                factor,
                &own.map(|(value, meaning)| (value, meaning.to_owned())),
            ));
        }
        let meanings = match meanings.is_empty() {
            true => String::new(),
            false => format!(": {}", meanings.join("; or ")),
        };
        format!("the series is that of {name} = {value:.6} in place of {asked:.6}{meanings}")
    }
}

/// Where `value` is smallest between two places, by the golden section.
fn minimum(value: &dyn Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut left, mut right) = (high - golden * (high - low), low + golden * (high - low));
    let (mut of_left, mut of_right) = (value(left), value(right));
    for _ in 0..REFINEMENTS {
        if of_left < of_right {
            (high, right, of_right) = (right, left, of_left);
            left = high - golden * (high - low);
            of_left = value(left);
        } else {
            (low, left, of_left) = (left, right, of_right);
            right = low + golden * (high - low);
            of_right = value(right);
        }
    }
    0.5 * (low + high)
}
