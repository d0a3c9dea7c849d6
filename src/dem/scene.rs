//! Cylinders between plane walls, and one leapfrog step of them all.

use super::contact::{ContactLaw, ContactState, TangentialStep};

/// A cylinder of unit mass and radius. Velocities belong to the half step before the positions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cylinder {
    /// Centre.
    pub position: [f64; 2],
    /// Rotation, counter-clockwise.
    pub angle: f64,
    /// Velocity of the centre.
    pub velocity: [f64; 2],
    /// Angular velocity, counter-clockwise.
    pub spin: f64,
}

impl Cylinder {
    /// A cylinder at rest.
    pub fn at(x: f64, y: f64) -> Self {
        Self {
            position: [x, y],
            ..Self::default()
        }
    }
}

/// A plane wall; the cylinders are on the side its normal points to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWall {
    /// Unit normal n.
    pub normal: [f64; 2],
    /// Offset: the plane is n · x = offset.
    pub offset: f64,
    /// Velocity of the plane along its normal.
    pub speed: f64,
    /// Friction coefficient against cylinders.
    pub friction: f64,
}

/// Moment of inertia of a solid cylinder, m r²/2.
const MOMENT_OF_INERTIA: f64 = 0.5;

/// Cylinders, walls and the state of all their contacts.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The cylinders.
    pub cylinders: Vec<Cylinder>,
    /// The walls.
    pub walls: Vec<PlaneWall>,
    /// Contact law of every contact.
    pub law: ContactLaw,
    /// Friction coefficient between cylinders.
    pub cylinder_friction: f64,
    /// Arm coefficient r₁ of cylinder–cylinder contacts.
    pub pair_arm: f64,
    /// Arm coefficient r₁ of cylinder–wall contacts.
    pub wall_arm: f64,
    /// Gravity, downwards.
    pub gravity: f64,
    /// Time step.
    pub time_step: f64,
    pair_contacts: Vec<ContactState>,
    wall_contacts: Vec<ContactState>,
    loads: Vec<Load>,
}

/// Force and torque on a cylinder.
#[derive(Debug, Clone, Copy, Default)]
struct Load {
    force: [f64; 2],
    torque: f64,
}

impl Scene {
    /// A scene without walls and gravity, every contact stress free.
    pub fn new(cylinders: Vec<Cylinder>, law: ContactLaw, time_step: f64) -> Self {
        let count = cylinders.len();
        Self {
            pair_contacts: vec![ContactState::default(); count * count.saturating_sub(1) / 2],
            wall_contacts: Vec::new(),
            loads: vec![Load::default(); count],
            cylinders,
            walls: Vec::new(),
            law,
            cylinder_friction: 0.0,
            pair_arm: 0.0,
            wall_arm: 0.0,
            gravity: 0.0,
            time_step,
        }
    }

    /// Adds a wall and returns its index.
    pub fn add_wall(&mut self, wall: PlaneWall) -> usize {
        self.walls.push(wall);
        let all = self.walls.len() * self.cylinders.len();
        self.wall_contacts.resize(all, ContactState::default());
        self.walls.len() - 1
    }

    /// State of the contact between a wall and a cylinder, as of the last evaluation of the forces.
    pub fn wall_contact(&self, wall: usize, cylinder: usize) -> &ContactState {
        &self.wall_contacts[wall * self.cylinders.len() + cylinder]
    }

    /// State of the contact between two cylinders, the one with the higher index named first.
    pub fn pair_contact(&self, first: usize, second: usize) -> &ContactState {
        &self.pair_contacts[first * (first - 1) / 2 + second]
    }

    /// Evaluates every contact at the present positions and advances the tangential springs to them.
    pub fn evaluate_forces(&mut self) {
        for load in &mut self.loads {
            *load = Load {
                force: [0.0, -self.gravity],
                torque: 0.0,
            };
        }
        let count = self.cylinders.len();
        let mut pair = 0;
        for first in 1..count {
            for second in 0..first {
                self.evaluate_pair(first, second, pair);
                pair += 1;
            }
        }
        for wall in 0..self.walls.len() {
            for cylinder in 0..count {
                self.evaluate_wall(wall, cylinder);
            }
        }
    }

    /// Kicks the velocities over a whole step with the evaluated forces, then drifts the positions, and
    /// moves the walls.
    pub fn advance(&mut self) {
        let dt = self.time_step;
        for (cylinder, load) in self.cylinders.iter_mut().zip(&self.loads) {
            for axis in 0..2 {
                cylinder.velocity[axis] += load.force[axis] * dt;
                cylinder.position[axis] += cylinder.velocity[axis] * dt;
            }
            cylinder.spin += load.torque / MOMENT_OF_INERTIA * dt;
            cylinder.angle += cylinder.spin * dt;
        }
        for wall in &mut self.walls {
            wall.offset += wall.speed * dt;
        }
    }

    fn evaluate_pair(&mut self, first: usize, second: usize, pair: usize) {
        let (i, j) = (&self.cylinders[first], &self.cylinders[second]);
        let dx = i.position[0] - j.position[0];
        let dy = i.position[1] - j.position[1];
        let square = dx * dx + dy * dy;
        let state = &mut self.pair_contacts[pair];
        if square >= 4.0 {
            *state = ContactState::default();
            return;
        }
        let distance = square.sqrt();
        let overlap = 2.0 - distance;
        let normal = [dx / distance, dy / distance];
        let relative = [i.velocity[0] - j.velocity[0], i.velocity[1] - j.velocity[1]];
        let radius = 1.0 + self.pair_arm * overlap;
        let velocity = tangential(normal, relative) - radius * (i.spin + j.spin);
        let normal_force = self.law.normal_force(overlap, along(normal, relative));
        let step = TangentialStep {
            velocity,
            time_step: self.time_step,
            friction: self.cylinder_friction,
        };
        self.law.advance(state, normal_force, step);
        let force = contact_force(normal, state);
        let torque = radius * state.tangential_force;
        self.loads[first].add(force, -torque);
        self.loads[second].add([-force[0], -force[1]], -torque);
    }

    fn evaluate_wall(&mut self, wall: usize, cylinder: usize) {
        let state = &mut self.wall_contacts[wall * self.cylinders.len() + cylinder];
        let plane = &self.walls[wall];
        let body = &self.cylinders[cylinder];
        let overlap = 1.0 - (along(plane.normal, body.position) - plane.offset);
        if overlap <= 0.0 {
            *state = ContactState::default();
            return;
        }
        let separation_speed = along(plane.normal, body.velocity) - plane.speed;
        let radius = 1.0 + self.wall_arm * overlap;
        let velocity = tangential(plane.normal, body.velocity) - radius * body.spin;
        let normal_force = self.law.normal_force(overlap, separation_speed);
        let step = TangentialStep {
            velocity,
            time_step: self.time_step,
            friction: plane.friction,
        };
        self.law.advance(state, normal_force, step);
        let force = contact_force(plane.normal, state);
        self.loads[cylinder].add(force, -(radius * state.tangential_force));
    }
}

impl Load {
    fn add(&mut self, force: [f64; 2], torque: f64) {
        self.force[0] += force[0];
        self.force[1] += force[1];
        self.torque += torque;
    }
}

fn along(normal: [f64; 2], vector: [f64; 2]) -> f64 {
    normal[0] * vector[0] + normal[1] * vector[1]
}

/// Component of `vector` along t = (−n_y, n_x).
fn tangential(normal: [f64; 2], vector: [f64; 2]) -> f64 {
    normal[0] * vector[1] - normal[1] * vector[0]
}

fn contact_force(normal: [f64; 2], state: &ContactState) -> [f64; 2] {
    [
        state.normal_force * normal[0] - state.tangential_force * normal[1],
        state.normal_force * normal[1] + state.tangential_force * normal[0],
    ]
}
