//! The stack at one moment, with every force that is known then: what figures and animations are made of.

use super::samples::{Sample, Series};
use crate::model::InvalidValue;

/// A cylinder of radius 1 as it is at one moment. Lengths in r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedCylinder {
    /// Centre, the floor being at height 0.
    pub position: [f64; 2],
    /// Rotation in radians, counter-clockwise.
    pub angle: f64,
    /// Velocity of the centre in r √(k_n/m), half a step before; absent where it is not reported.
    pub velocity: Option<[f64; 2]>,
}

/// Body or wall that presses on a cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// The cylinder of that index.
    Cylinder(usize),
    /// The floor.
    Floor,
    /// The top wall.
    TopWall,
}

/// A contact that bears a force. Forces in k_n r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Index of the cylinder on which the force acts; on a partner that is a cylinder, its opposite does.
    pub cylinder: usize,
    /// The body or wall that it touches.
    pub partner: Partner,
    /// Where: half-way into the overlap of two cylinders, on the surface of a wall.
    pub position: [f64; 2],
    /// Unit normal n, towards the cylinder.
    pub normal: [f64; 2],
    /// Normal force along n, positive in compression.
    pub normal_force: f64,
    /// Tangential force along t = (−n_y, n_x).
    pub tangential_force: f64,
}

impl ContactPoint {
    /// The normal part of the force on the cylinder.
    pub(crate) fn normal_vector(&self) -> [f64; 2] {
        self.normal.map(|component| self.normal_force * component)
    }

    /// The tangential part of the force on the cylinder.
    pub(crate) fn tangential_vector(&self) -> [f64; 2] {
        let [x, y] = self.normal;
        [-y * self.tangential_force, x * self.tangential_force]
    }

    /// The force on the cylinder.
    pub fn force(&self) -> [f64; 2] {
        let (along, across) = (self.normal_vector(), self.tangential_vector());
        [along[0] + across[0], along[1] + across[1]]
    }
}

/// The stack at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Steps since the wall began to move.
    pub step: u64,
    /// Time since then, in √(m/k_n).
    pub time: f64,
    /// Force of the top wall on cylinder 1 in k_n r.
    pub wall_force: f64,
    /// Height of the top wall in r.
    pub wall_height: f64,
    /// The cylinders: top, right, left.
    pub cylinders: Vec<PlacedCylinder>,
    /// The contacts whose force is known and not zero.
    pub contacts: Vec<ContactPoint>,
}

/// All sampled moments of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    /// In order of time.
    pub frames: Vec<Frame>,
    /// Whether the forces between the cylinders are among the contacts.
    pub pair_forces_known: bool,
}

impl Frames {
    /// Frames of a series: the forces of the walls, and none between the cylinders. The wall starts where it
    /// touches cylinder 1 at the first row, and moves down at `wall_speed`.
    ///
    /// # Errors
    /// If the code does not report all positions and angles, with those that are absent.
    pub fn of_series(series: &Series, wall_speed: f64) -> Result<Self, InvalidValue> {
        if !series.absent().is_empty() {
            return Err(InvalidValue {
                key: "series".to_owned(),
                value: format!("without {}", series.absent().join(", ")),
                accepted: "one with the positions and angles of all cylinders to be drawn"
                    .to_owned(),
            });
        }
        let samples = series.samples();
        let start = samples.first().map_or(0.0, |first| first.y1 + 1.0);
        let frame = |sample: &Sample| Frame::of_sample(sample, start - wall_speed * sample.time);
        Ok(Self {
            frames: samples.iter().map(frame).collect(),
            pair_forces_known: false,
        })
    }
}

impl Frame {
    fn of_sample(sample: &Sample, wall_height: f64) -> Self {
        let placed = |x: f64, y: f64, angle: f64| PlacedCylinder {
            position: [x, y],
            angle,
            velocity: None,
        };
        let on_wall =
            |cylinder, partner, position, normal: [f64; 2], force: [f64; 2]| ContactPoint {
                cylinder,
                partner,
                position,
                normal,
                normal_force: force[1] * normal[1],
                // t = (−n_y, n_x)
                tangential_force: -force[0] * normal[1],
            };
        let (up, down) = ([0.0, 1.0], [0.0, -1.0]);
        let (right, left) = ([sample.x2, 0.0], [sample.x3, 0.0]);
        let on_right = [sample.floor_t2, sample.floor_n2];
        let on_left = [sample.floor_t3, sample.floor_n3];
        let on_top = [0.0, -sample.wall_force];
        let top = [sample.x1, wall_height];
        let contacts = [
            on_wall(1, Partner::Floor, right, up, on_right),
            on_wall(2, Partner::Floor, left, up, on_left),
            on_wall(0, Partner::TopWall, top, down, on_top),
        ];
        let loaded = |contact: &ContactPoint| contact.force() != [0.0; 2];
        Self {
            step: sample.step,
            time: sample.time,
            wall_force: sample.wall_force,
            wall_height,
            cylinders: vec![
                placed(sample.x1, sample.y1, sample.theta1),
                placed(sample.x2, sample.y2, sample.theta2),
                placed(sample.x3, sample.y3, sample.theta3),
            ],
            contacts: contacts.into_iter().filter(loaded).collect(),
        }
    }
}
