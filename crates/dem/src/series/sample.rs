//! A row of a time series, and what it says about each body on the floor.

use super::column::{Column, Number};
use crate::model::{MOST_BODIES, PAPER_BODIES, Stack};
use serde::{Deserialize, Serialize};

/// Position and rotation of a body. Lengths in r, angles in radians.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Placement {
    /// Centre, [x, y, z] with y upwards; cylinders have z = 0.
    pub position: [f64; 3],
    /// Rotation about x, y and z: the time integral of the angular velocity. Cylinders rotate about z.
    pub rotation: [f64; 3],
}

/// One row of a time series. Forces in k_n r, time in √(m/k_n). Values that a code does not report are NaN
/// ([`Series::absent`] names them), and those of bodies that its stack does not have are 0.
///
/// [`Series::absent`]: super::Series::absent
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    /// Steps since the wall began to move.
    pub step: u64,
    /// Time since the wall began to move.
    pub time: f64,
    /// Force of the top wall on the top body, positive in compression.
    pub wall_force: f64,
    /// The bodies in the order of their numbers: cylinder 1 on top, 2 on the right, 3 on the left.
    pub bodies: [Placement; MOST_BODIES],
    /// Force of the floor on each of them, [x, y, z].
    pub floor: [[f64; 3]; MOST_BODIES],
}

/// A body on the floor, in the plane through its place and the axis of the stack. In a symmetric stack all of them are
/// equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorContact {
    /// Distance of its centre from the axis.
    pub outwards: f64,
    /// Distance of its centre from the plane.
    pub sideways: f64,
    /// Height of its centre above the floor.
    pub height: f64,
    /// Its rotation in the plane, counter-clockwise where outwards is to the right.
    pub turn: f64,
    /// Normal force of the floor.
    pub normal: f64,
    /// Tangential force of the floor in the plane, outwards.
    pub tangential: f64,
    /// Tangential force of the floor across the plane.
    pub across: f64,
}

impl FloorContact {
    /// Magnitude of the tangential force.
    pub fn friction(&self) -> f64 {
        libm::hypot(self.tangential, self.across)
    }
}

impl Sample {
    /// The bodies on the floor, in the order of the ring.
    pub fn floor_contacts(&self, stack: &Stack) -> impl ExactSizeIterator<Item = FloorContact> {
        stack.places().map(|place| {
            let Placement { position, rotation } = self.bodies[place.body];
            let [x, z] = place.outwards;
            let in_plane = |vector: [f64; 3]| vector[0] * x + vector[2] * z;
            let across = |vector: [f64; 3]| vector[2] * x - vector[0] * z;
            let force = self.floor[place.body];
            FloorContact {
                outwards: in_plane(position),
                sideways: across(position),
                height: position[1],
                turn: across(rotation),
                normal: force[1],
                tangential: in_plane(force),
                across: across(force),
            }
        })
    }

    /// The first body of the ring: cylinder 2.
    pub fn first(&self, stack: &Stack) -> FloorContact {
        let mut contacts = self.floor_contacts(stack);
        contacts.next().expect("a stack has bodies on the floor")
    }

    /// Sum of the normal forces of the floor.
    pub fn borne(&self, stack: &Stack) -> f64 {
        self.floor_contacts(stack)
            .map(|contact| contact.normal)
            .sum()
    }

    /// Centre of the body on top.
    pub fn top(&self, stack: &Stack) -> [f64; 3] {
        self.bodies[stack.top()].position
    }

    /// Distance of the centre of the body on top from the axis, towards the first body of the ring.
    pub(super) fn top_outwards(&self, stack: &Stack) -> f64 {
        let place = stack.places().next();
        let [x, z] = place.map_or([1.0, 0.0], |place| place.outwards);
        let [dx, _, dz] = self.top(stack);
        dx * x + dz * z
    }

    /// Distance of the centres of cylinders 2 and 3, or of the first two neighbours in a ring.
    pub fn neighbour_distance(&self, stack: &Stack) -> f64 {
        let mut bodies = stack.places().map(|place| place.body);
        let two = [bodies.next(), bodies.next()].map(Option::unwrap_or_default);
        self.distance(two)
    }

    fn distance(&self, bodies: [usize; 2]) -> f64 {
        let [one, other] = bodies.map(|body| self.bodies[body].position);
        let [dx, dy, dz] = [0, 1, 2].map(|axis| one[axis] - other[axis]);
        (dx * dx + dy * dy + dz * dz).sqrt()
    }

    /// Overlap of cylinders 2 and 3, or the largest overlap of neighbours in a ring; 0 where none touch. With linear
    /// springs this is also the force at rest. NaN where positions are not reported.
    pub fn bottom_overlap(&self, stack: &Stack) -> f64 {
        let places: Vec<usize> = stack.places().map(|place| place.body).collect();
        let next = places.iter().cycle().skip(1);
        let pairs = places.iter().zip(next);
        let overlaps = pairs.map(|(&one, &other)| 2.0 - self.distance([one, other]));
        overlaps.fold(0.0, |most, own| {
            if own.is_nan() || own > most {
                own
            } else {
                most
            }
        })
    }
}

pub(super) const FORCE: &str = "k_n r";
pub(super) const LENGTH: &str = "r";
pub(super) const ANGLE: &str = "rad";

macro_rules! column {
    ($name:expr, $unit:expr, $meaning:literal, $optional:literal, $($field:tt)*) => {
        Column {
            name: $name,
            unit: $unit,
            meaning: $meaning,
            is_optional: $optional,
            value: |row: &Sample| row.$($field)* as f64,
            set: |row: &mut Sample, value| {
                let number = Number::of(value);
                number.map(|number| row.$($field)* = number).is_some()
            },
        }
    };
}

/// The columns that all series share, followed by `further` ones.
macro_rules! every_series {
    ($($further:expr),* $(,)?) => {
        [
            column!("step", "1", "steps since the wall began to move", false, step),
            column!("time", "√(m/k_n)", "time since the wall began to move", false, time),
            column!("wall_force", FORCE, "force of the top wall on the top body, positive in compression", false, wall_force),
            $($further),*
        ]
    };
}

#[allow(clippy::unnecessary_cast)] // All values but the step are floating-point numbers already.
static OF_CYLINDERS: [Column<Sample>; 16] = every_series![
    column!(
        "x1",
        LENGTH,
        "horizontal position of cylinder 1 (top)",
        true,
        bodies[0].position[0]
    ),
    column!(
        "y1",
        LENGTH,
        "height of its centre above the floor",
        true,
        bodies[0].position[1]
    ),
    column!(
        "theta1",
        ANGLE,
        "its rotation, counter-clockwise",
        true,
        bodies[0].rotation[2]
    ),
    column!(
        "x2",
        LENGTH,
        "horizontal position of cylinder 2 (right)",
        true,
        bodies[1].position[0]
    ),
    column!(
        "y2",
        LENGTH,
        "height of its centre above the floor",
        true,
        bodies[1].position[1]
    ),
    column!(
        "theta2",
        ANGLE,
        "its rotation, counter-clockwise",
        true,
        bodies[1].rotation[2]
    ),
    column!(
        "x3",
        LENGTH,
        "horizontal position of cylinder 3 (left)",
        true,
        bodies[2].position[0]
    ),
    column!(
        "y3",
        LENGTH,
        "height of its centre above the floor",
        true,
        bodies[2].position[1]
    ),
    column!(
        "theta3",
        ANGLE,
        "its rotation, counter-clockwise",
        true,
        bodies[2].rotation[2]
    ),
    column!(
        "floor_n2",
        FORCE,
        "normal force of the floor on cylinder 2",
        false,
        floor[1][1]
    ),
    column!(
        "floor_t2",
        FORCE,
        "tangential force of the floor on cylinder 2, along +x",
        false,
        floor[1][0]
    ),
    column!(
        "floor_n3",
        FORCE,
        "normal force of the floor on cylinder 3",
        false,
        floor[2][1]
    ),
    column!(
        "floor_t3",
        FORCE,
        "tangential force of the floor on cylinder 3, along +x",
        false,
        floor[2][0]
    ),
];

macro_rules! of_spheres {
    ($($number:literal at $index:literal),*) => {
        #[allow(clippy::unnecessary_cast)]
        static OF_SPHERES: [Column<Sample>; 3 + 9 * MOST_BODIES] = every_series![$(
            column!(concat!("x", $number), LENGTH, "horizontal position of the sphere of this number", true, bodies[$index].position[0]),
            column!(concat!("y", $number), LENGTH, "height of its centre above the floor", true, bodies[$index].position[1]),
            column!(concat!("z", $number), LENGTH, "its other horizontal position; x, y, z are right-handed", true, bodies[$index].position[2]),
            column!(concat!("thetax", $number), ANGLE, "time integral of its angular velocity about x", true, bodies[$index].rotation[0]),
            column!(concat!("thetay", $number), ANGLE, "the same about y", true, bodies[$index].rotation[1]),
            column!(concat!("thetaz", $number), ANGLE, "the same about z", true, bodies[$index].rotation[2]),
            column!(concat!("floorx", $number), FORCE, "force of the floor on it, along +x", false, floor[$index][0]),
            column!(concat!("floory", $number), FORCE, "the same upwards, the normal force", false, floor[$index][1]),
            column!(concat!("floorz", $number), FORCE, "the same along +z", false, floor[$index][2])
        ),*];
    };
}

of_spheres!(1 at 0, 2 at 1, 3 at 2, 4 at 3, 5 at 4, 6 at 5);

impl Sample {
    /// Names of the columns of a stack of cylinders, in order.
    pub(super) const NAMES: [&'static str; OF_CYLINDERS.len()] = {
        let mut names = [""; OF_CYLINDERS.len()];
        let mut index = 0;
        while index < names.len() {
            names[index] = OF_CYLINDERS[index].name;
            index += 1;
        }
        names
    };

    /// Every number of a row, as the columns of the largest stack.
    pub(super) const EVERY: &'static [Column<Self>] = &OF_SPHERES;

    /// The columns of the series of a stack with this many bodies on the floor, in order.
    pub fn columns(bodies: u8) -> &'static [Column<Self>] {
        match bodies {
            PAPER_BODIES => &OF_CYLINDERS,
            _ => &OF_SPHERES[..3 + 9 * (usize::from(bodies) + 1).min(MOST_BODIES)],
        }
    }

    /// Whether every value is a finite number.
    pub fn is_finite(&self) -> bool {
        let mut columns = Self::EVERY.iter();
        columns.all(|column| (column.value)(self).is_finite())
    }
}
