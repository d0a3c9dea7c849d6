//! Cylinders between plane walls, and one leapfrog step of them all.

use super::contact::{Contact, ContactForce, ContactModel, SpringDashpot, along};
use super::real::{Composite, LaneWise, Real, composite, lane_wise};
use crate::stack::CYLINDER_INERTIA;

/// A cylinder of unit mass and radius. Velocities belong to the half step before the positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder<R = f64> {
    /// Centre.
    pub position: [R; 2],
    /// Rotation, counter-clockwise.
    pub angle: R,
    /// Velocity of the centre.
    pub velocity: [R; 2],
    /// Angular velocity, counter-clockwise.
    pub spin: R,
}

composite!(
    Cylinder {
        position,
        angle,
        velocity,
        spin
    },
    PlaneWall {
        normal,
        offset,
        speed,
        friction
    },
    Load { force, torque },
);
lane_wise!(Load { force, torque });

impl<R: Real> Cylinder<R> {
    /// A cylinder at rest.
    pub fn at(x: R, y: R) -> Self {
        let zero = x.like(0.0);
        Self {
            position: [x, y],
            angle: zero,
            velocity: [zero; 2],
            spin: zero,
        }
    }
}

/// A plane wall; the cylinders are on the side its normal points to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWall<R = f64> {
    /// Unit normal n.
    pub normal: [R; 2],
    /// Offset: the plane is n · x = offset.
    pub offset: R,
    /// Velocity of the plane along its normal.
    pub speed: R,
    /// Friction coefficient against cylinders.
    pub friction: R,
}

/// Cylinders, walls and the state of all their contacts.
#[derive(Debug, Clone)]
pub struct Scene<R: Real = f64, Model: ContactModel<R> = SpringDashpot<R>> {
    /// The cylinders.
    pub cylinders: Vec<Cylinder<R>>,
    /// The walls.
    pub walls: Vec<PlaneWall<R>>,
    /// Contact law of every contact.
    pub model: Model,
    /// Friction coefficient between cylinders.
    pub cylinder_friction: R,
    /// Arm coefficient r₁ of cylinder–cylinder contacts.
    pub pair_arm: R,
    /// Arm coefficient r₁ of cylinder–wall contacts.
    pub wall_arm: R,
    /// Moment of inertia of a cylinder.
    pub moment_of_inertia: R,
    /// Gravity, downwards.
    pub gravity: R,
    /// Time step.
    pub time_step: R,
    pair_contacts: Vec<ContactState<R, Model::Memory>>,
    wall_contacts: Vec<ContactState<R, Model::Memory>>,
    loads: Vec<Load<R>>,
}

/// What a contact remembers and exerts.
#[derive(Debug, Clone, Copy)]
struct ContactState<R, Memory> {
    memory: Memory,
    force: ContactForce<R>,
    /// Whether any lane has touched since it was last forgotten.
    loaded: bool,
}

impl<R: Real, Memory: Copy + LaneWise<R>> ContactState<R, Memory> {
    #[inline(always)]
    fn forgotten<Model: ContactModel<R, Memory = Memory>>(model: &Model, number: R) -> Self {
        Self {
            memory: model.forgotten(number),
            force: ContactForce::none(number),
            loaded: false,
        }
    }

    /// The force of `contact` where it `touches`; elsewhere the contact is without force and past.
    #[inline(always)]
    fn evaluate<Model: ContactModel<R, Memory = Memory>>(
        &mut self,
        model: &Model,
        contact: &Contact<R>,
        touches: R::Mask,
    ) {
        let mut memory = self.memory;
        let force = model.evaluate(contact, &mut memory);
        let gone = Self::forgotten(model, contact.overlap);
        self.memory = Memory::choose(touches, memory, gone.memory);
        self.force = ContactForce::choose(touches, force, gone.force);
        self.loaded = true;
    }

    #[inline(always)]
    fn part<Model: ContactModel<R, Memory = Memory>>(&mut self, model: &Model, number: R) {
        if self.loaded {
            *self = Self::forgotten(model, number);
        }
    }
}

impl<R: Real, Memory: Composite<R>> Composite<R> for ContactState<R, Memory> {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.memory.visit(&other.memory, visit);
        self.force.visit(&other.force, visit);
        // Perhaps; what does not touch is forgotten in the next step.
        self.loaded = true;
    }
}

/// Force and torque on a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load<R = f64> {
    /// Force.
    pub force: [R; 2],
    /// Torque about the centre, counter-clockwise.
    pub torque: R,
}

impl<R: Real, Model: ContactModel<R>> Scene<R, Model> {
    /// A scene without walls, friction between cylinders and gravity, every contact stress free.
    pub fn new(cylinders: Vec<Cylinder<R>>, model: Model, time_step: R) -> Self {
        let count = cylinders.len();
        let zero = time_step.like(0.0);
        let contact = ContactState::forgotten(&model, zero);
        Self {
            pair_contacts: vec![contact; count * count.saturating_sub(1) / 2],
            wall_contacts: Vec::new(),
            loads: vec![Load::weight(zero); count],
            cylinders,
            walls: Vec::new(),
            model,
            cylinder_friction: zero,
            pair_arm: zero,
            wall_arm: zero,
            moment_of_inertia: zero.like(CYLINDER_INERTIA),
            gravity: zero,
            time_step,
        }
    }

    /// Adds a wall and returns its index.
    pub fn add_wall(&mut self, wall: PlaneWall<R>) -> usize {
        self.walls.push(wall);
        let all = self.walls.len() * self.cylinders.len();
        let contact = ContactState::forgotten(&self.model, self.time_step);
        self.wall_contacts.resize(all, contact);
        self.walls.len() - 1
    }

    /// Force of a wall on a cylinder, as of the last evaluation of the forces.
    pub fn wall_force(&self, wall: usize, cylinder: usize) -> &ContactForce<R> {
        &self.wall_contacts[wall * self.cylinders.len() + cylinder].force
    }

    /// Force and torque on a cylinder, as of the last evaluation of the forces.
    pub fn load(&self, cylinder: usize) -> &Load<R> {
        &self.loads[cylinder]
    }

    /// Force of a cylinder on another, the one with the higher index being named first, as of the last
    /// evaluation of the forces.
    pub fn pair_force(&self, first: usize, second: usize) -> &ContactForce<R> {
        &self.pair_contacts[first * (first - 1) / 2 + second].force
    }

    /// Evaluates every contact at the present positions and advances the tangential springs to them.
    #[inline(always)]
    pub fn evaluate_forces(&mut self) {
        self.loads.fill(Load::weight(self.gravity));
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
    #[inline(always)]
    pub fn advance(&mut self) {
        let dt = self.time_step;
        for (cylinder, load) in self.cylinders.iter_mut().zip(&self.loads) {
            for axis in 0..2 {
                cylinder.velocity[axis] += load.force[axis] * dt;
                cylinder.position[axis] += cylinder.velocity[axis] * dt;
            }
            cylinder.spin += load.torque / self.moment_of_inertia * dt;
            cylinder.angle += cylinder.spin * dt;
        }
        for wall in &mut self.walls {
            wall.offset += wall.speed * dt;
        }
    }

    #[inline(always)]
    fn evaluate_pair(&mut self, first: usize, second: usize, pair: usize) {
        let (i, j) = (&self.cylinders[first], &self.cylinders[second]);
        let dx = i.position[0] - j.position[0];
        let dy = i.position[1] - j.position[1];
        let square = dx * dx + dy * dy;
        let state = &mut self.pair_contacts[pair];
        let touches = square.less(square.like(4.0));
        if !square.any(touches) {
            return state.part(&self.model, square);
        }
        let distance = square.sqrt();
        let contact = Contact {
            normal: [dx / distance, dy / distance],
            overlap: distance.like(2.0) - distance,
            velocity: [i.velocity[0] - j.velocity[0], i.velocity[1] - j.velocity[1]],
            spin: i.spin + j.spin,
            friction: self.cylinder_friction,
            arm: self.pair_arm,
            time_step: self.time_step,
        };
        state.evaluate(&self.model, &contact, touches);
        let force = in_the_plane(contact.normal, &state.force);
        let torque = state.force.radius * state.force.tangential;
        self.loads[first].add(touches, force, -torque);
        self.loads[second].add(touches, [-force[0], -force[1]], -torque);
    }

    #[inline(always)]
    fn evaluate_wall(&mut self, wall: usize, cylinder: usize) {
        let state = &mut self.wall_contacts[wall * self.cylinders.len() + cylinder];
        let plane = &self.walls[wall];
        let body = &self.cylinders[cylinder];
        let distance = along(plane.normal, body.position) - plane.offset;
        let overlap = distance.like(1.0) - distance;
        let touches = overlap.like(0.0).less(overlap);
        if !overlap.any(touches) {
            return state.part(&self.model, overlap);
        }
        let contact = Contact {
            normal: plane.normal,
            overlap,
            velocity: [
                body.velocity[0] - plane.speed * plane.normal[0],
                body.velocity[1] - plane.speed * plane.normal[1],
            ],
            spin: body.spin,
            friction: plane.friction,
            arm: self.wall_arm,
            time_step: self.time_step,
        };
        state.evaluate(&self.model, &contact, touches);
        let force = in_the_plane(plane.normal, &state.force);
        let torque = state.force.radius * state.force.tangential;
        self.loads[cylinder].add(touches, force, -torque);
    }
}

impl<R: Real> Load<R> {
    #[inline(always)]
    fn weight(gravity: R) -> Self {
        Self {
            force: [gravity.like(0.0), -gravity],
            torque: gravity.like(0.0),
        }
    }

    #[inline(always)]
    fn add(&mut self, touches: R::Mask, force: [R; 2], torque: R) {
        let sum = Self {
            force: [self.force[0] + force[0], self.force[1] + force[1]],
            torque: self.torque + torque,
        };
        *self = Self::choose(touches, sum, *self);
    }
}

#[inline(always)]
fn in_the_plane<R: Real>(normal: [R; 2], force: &ContactForce<R>) -> [R; 2] {
    [
        force.normal * normal[0] - force.tangential * normal[1],
        force.normal * normal[1] + force.tangential * normal[0],
    ]
}

impl<R: Real, Model: ContactModel<R> + Composite<R>> Composite<R> for Scene<R, Model> {
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.cylinders.visit(&other.cylinders, visit);
        self.walls.visit(&other.walls, visit);
        self.model.visit(&other.model, visit);
        self.cylinder_friction
            .visit(&other.cylinder_friction, visit);
        self.pair_arm.visit(&other.pair_arm, visit);
        self.wall_arm.visit(&other.wall_arm, visit);
        self.moment_of_inertia
            .visit(&other.moment_of_inertia, visit);
        self.gravity.visit(&other.gravity, visit);
        self.time_step.visit(&other.time_step, visit);
        self.pair_contacts.visit(&other.pair_contacts, visit);
        self.wall_contacts.visit(&other.wall_contacts, visit);
        self.loads.visit(&other.loads, visit);
    }
}
