//! The stack at one moment, with all forces known at that moment: the input of figures and animations.

use super::sample::{Placement, Sample};
use super::samples::Series;
use crate::model::{Case, InvalidValue, PAPER_BODIES, Place, Stack};

/// A cylinder or sphere of radius 1 at one moment. Lengths in r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlacedBody {
    /// Centre, [x, y, z] with y upwards and the floor at height 0; cylinders have z = 0.
    pub position: [f64; 3],
    /// Rotation in radians about x, y and z, the time integral of the angular velocity; cylinders rotate about z.
    pub rotation: [f64; 3],
    /// Velocity of the centre in r √(k_n/m), half a step before; absent where it is not reported.
    pub velocity: Option<[f64; 3]>,
}

/// The body or wall that presses on a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// The body with this index.
    Body(usize),
    /// The floor.
    Floor,
    /// The top wall.
    TopWall,
}

/// A contact that bears a force. Forces in k_n r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Index of the body on which the force acts; the opposite force acts on the partner.
    pub body: usize,
    /// The body or wall that it touches.
    pub partner: Partner,
    /// Position: half-way into the overlap of two bodies, or on the surface of a wall.
    pub position: [f64; 3],
    /// Unit normal n, towards the body.
    pub normal: [f64; 3],
    /// Unit tangent t: (−n_y, n_x, 0) for cylinders, the direction of the tangential force for spheres, 0 if there is
    /// none.
    pub tangent: [f64; 3],
    /// Normal force along n, positive in compression.
    pub normal_force: f64,
    /// Tangential force along t.
    pub tangential_force: f64,
}

impl ContactPoint {
    /// A contact of a cylinder, with its normal and tangential force.
    pub(crate) fn in_plane(
        body: usize,
        partner: Partner,
        [x, y]: [f64; 2],
        normal: [f64; 2],
        [normal_force, tangential_force]: [f64; 2],
    ) -> Self {
        Self {
            body,
            partner,
            position: [x, y, 0.0],
            normal: [normal[0], normal[1], 0.0],
            tangent: [-normal[1], normal[0], 0.0],
            normal_force,
            tangential_force,
        }
    }

    /// A contact of a sphere, with the force on it.
    pub fn in_space(
        body: usize,
        partner: Partner,
        position: [f64; 3],
        normal: [f64; 3],
        force: [f64; 3],
    ) -> Self {
        let product = |one: [f64; 3], other: [f64; 3]| {
            one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
        };
        let normal_force = product(force, normal);
        let across = [0, 1, 2].map(|axis: usize| force[axis] - normal_force * normal[axis]);
        let tangential_force = libm::sqrt(product(across, across));
        let tangent = match tangential_force > 0.0 {
            true => across.map(|component| component / tangential_force),
            false => [0.0; 3],
        };
        Self {
            body,
            partner,
            position,
            normal,
            tangent,
            normal_force,
            tangential_force,
        }
    }

    /// The normal component of the force on the body.
    pub fn normal_vector(&self) -> [f64; 3] {
        self.normal.map(|component| self.normal_force * component)
    }

    /// The tangential component of the force on the body.
    pub fn tangential_vector(&self) -> [f64; 3] {
        self.tangent
            .map(|component| component * self.tangential_force)
    }

    /// The force on the body.
    pub fn force(&self) -> [f64; 3] {
        let (along, across) = (self.normal_vector(), self.tangential_vector());
        [0, 1, 2].map(|axis: usize| along[axis] + across[axis])
    }

    pub(crate) fn is_loaded(&self) -> bool {
        self.force() != [0.0; 3]
    }
}

/// The stack at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Steps since the wall began to move.
    pub step: u64,
    /// Time since then, in √(m/k_n).
    pub time: f64,
    /// Force of the top wall on the top body in k_n r.
    pub wall_force: f64,
    /// Height of the top wall in r.
    pub wall_height: f64,
    /// The bodies in the order of their numbers; cylinders: top, right, left.
    pub bodies: Vec<PlacedBody>,
    /// The contacts whose force is known and not zero.
    pub contacts: Vec<ContactPoint>,
}

/// The frames of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Frames {
    /// Frames in order of time.
    pub frames: Vec<Frame>,
    /// Whether the forces between the bodies are among the contacts.
    pub pair_forces_known: bool,
}

impl Frames {
    /// Builds frames from the series of a case, with the forces of the walls but not those between bodies. The wall
    /// starts where it touches the top body in the first row, and moves down at its speed.
    ///
    /// # Errors
    /// If the code does not report all positions and angles, with those that are absent.
    pub fn of_series(series: &Series, case: &Case) -> Result<Self, InvalidValue> {
        let stack = &case.stack;
        if !series.absent().is_empty() {
            return Err(InvalidValue {
                key: "series".to_owned(),
                value: format!("without {}", series.absent().join(", ")),
                accepted: format!(
                    "one with the positions and angles of all {} to be drawn",
                    stack.kind()
                ),
            });
        }
        let samples = series.samples();
        let start = samples
            .first()
            .map_or(0.0, |first| first.top(stack)[1] + 1.0);
        let speed = case.protocol.wall_speed;
        let frame = |sample: &Sample| Frame::of_sample(sample, stack, start - speed * sample.time);
        Ok(Self {
            frames: samples.iter().map(frame).collect(),
            pair_forces_known: false,
        })
    }
}

impl Frame {
    fn of_sample(sample: &Sample, stack: &Stack, wall_height: f64) -> Self {
        let placed = |body: &Placement| PlacedBody {
            position: body.position,
            rotation: body.rotation,
            velocity: None,
        };
        let bodies = &sample.bodies[..usize::from(stack.bodies) + 1];
        let on_wall = |body: usize, partner, height: f64, up: f64, force: [f64; 3]| {
            let [x, _, z] = sample.bodies[body].position;
            match stack.bodies {
                PAPER_BODIES => {
                    // t = (−n_y, n_x)
                    let parts = [force[1] * up, -force[0] * up];
                    ContactPoint::in_plane(body, partner, [x, height], [0.0, up], parts)
                }
                _ => ContactPoint::in_space(body, partner, [x, height, z], [0.0, up, 0.0], force),
            }
        };
        let on_floor = |place: Place| {
            on_wall(
                place.body,
                Partner::Floor,
                0.0,
                1.0,
                sample.floor[place.body],
            )
        };
        let on_top = [0.0, -sample.wall_force, 0.0];
        let on_top = on_wall(stack.top(), Partner::TopWall, wall_height, -1.0, on_top);
        let contacts = stack.places().map(on_floor).chain([on_top]);
        Self {
            step: sample.step,
            time: sample.time,
            wall_force: sample.wall_force,
            wall_height,
            bodies: bodies.iter().map(placed).collect(),
            contacts: contacts.filter(ContactPoint::is_loaded).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_on_a_sphere_is_the_sum_of_its_parts() {
        let force = [0.3, -0.2, 0.7];
        let normal = [0.6, 0.0, 0.8];
        let contact = ContactPoint::in_space(1, Partner::Floor, [0.0; 3], normal, force);
        let tangent = contact.tangent;
        let product: f64 = (0..3).map(|axis| tangent[axis] * normal[axis]).sum();
        let square: f64 = tangent.iter().map(|part| part * part).sum();
        assert!(product.abs() < 1e-15 && (square - 1.0).abs() < 1e-15);
        assert!(contact.tangential_force > 0.0);
        for (part, sum) in force.into_iter().zip(contact.force()) {
            assert!((part - sum).abs() < 1e-15);
        }
        let frictionless = ContactPoint::in_space(1, Partner::Floor, [0.0; 3], normal, normal);
        assert_eq!(frictionless.tangential_force, 0.0);
        assert!(frictionless.force().iter().all(|part| part.is_finite()));
    }
}
