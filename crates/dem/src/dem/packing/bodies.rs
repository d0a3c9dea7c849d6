//! The cylinders or spheres of a packing, its walls, and one step for all of them.

use super::pairs::PairList;
use super::skin::Skin;
use super::walls::{WallContact, beside_wall};
use crate::dem::body::{Body, Load};
use crate::dem::contact::{ContactForce, SpringDashpot};
use crate::dem::geometry::{Geometry, Plane};
use crate::dem::wall::PlaneWall;
use crate::model::{ContactConvention, Stack};

/// Largest gap between two surfaces in a neighbour list.
const SKIN: f64 = 0.5;

/// The properties shared by all bodies and contacts of a packing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Contact law.
    pub law: SpringDashpot<f64>,
    /// Friction coefficient between cylinders or spheres.
    pub cylinder_friction: f64,
    /// Moment of inertia of a cylinder, or sphere, in m r².
    pub moment_of_inertia: f64,
}

impl Material {
    /// The material of `stack` under `convention`.
    pub fn new(stack: &Stack, convention: &ContactConvention) -> Self {
        Self {
            law: SpringDashpot::like(0.0, convention, stack.stiffness_ratio),
            cylinder_friction: stack.cylinder_friction,
            moment_of_inertia: convention.moment_of_inertia,
        }
    }
}

/// Any number of cylinders or spheres of unit mass and radius, between plane walls.
///
/// Contacts are summed in ascending order of the indices of their bodies, so that a result depends only on the
/// numbering. Steps are fastest if neighbours have similar numbers, as in a lattice numbered row by row; ten thousand
/// cylinders numbered at random take a third longer.
#[derive(Debug, Clone)]
pub struct Packing<G: Geometry<f64> = Plane> {
    /// Gravity, downwards, in k_n r/m.
    pub gravity: f64,
    pub(super) material: Material,
    pub(super) time_step: f64,
    pub(super) cylinders: Vec<Body<f64, G>>,
    pub(super) walls: Vec<PlaneWall>,
    pub(super) loads: Vec<Load<f64, G>>,
    pub(super) pairs: PairList<G>,
    /// Contacts of each wall.
    pub(super) wall_contacts: Vec<Vec<WallContact<G>>>,
    skin: Skin<G>,
}

impl<G: Geometry<f64>> Packing<G> {
    /// A packing without gravity, in which every contact is free of stress.
    pub fn new(
        cylinders: Vec<Body<f64, G>>,
        walls: Vec<PlaneWall>,
        material: Material,
        time_step: f64,
    ) -> Self {
        let count = cylinders.len();
        let mut packing = Self {
            gravity: 0.0,
            material,
            time_step,
            loads: vec![Load::weight(0.0); count],
            pairs: PairList::empty(count),
            wall_contacts: vec![Vec::new(); walls.len()],
            skin: Skin::new(SKIN, &cylinders),
            cylinders,
            walls,
        };
        packing.renew_lists();
        packing
    }

    /// The cylinders, or spheres. Velocities belong to the half step before the positions.
    pub fn cylinders(&self) -> &[Body<f64, G>] {
        &self.cylinders
    }

    /// Force and torque on every body, from the last evaluation of the forces.
    pub fn loads(&self) -> &[Load<f64, G>] {
        &self.loads
    }

    /// Every body near a wall, with the force of the wall on it from the last evaluation of the forces, which may be
    /// zero.
    pub fn wall_forces(&self, wall: usize) -> impl Iterator<Item = (usize, &ContactForce<f64, G>)> {
        let contacts = self.wall_contacts[wall].iter();
        contacts.map(|contact| (contact.cylinder as usize, &contact.force))
    }

    /// Kicks the velocities over a whole step with the evaluated forces, then drifts the positions, and
    /// moves the walls.
    pub fn advance(&mut self) {
        let dt = self.time_step;
        let mut fastest_square = 0.0;
        for (cylinder, load) in self.cylinders.iter_mut().zip(&self.loads) {
            cylinder.advance(load, self.material.moment_of_inertia, dt);
            let velocity = cylinder.velocity;
            fastest_square = f64::max(fastest_square, G::along(velocity, velocity));
        }
        for wall in &mut self.walls {
            wall.offset += wall.speed * dt;
        }
        if self
            .skin
            .is_used_up(fastest_square, &self.walls, dt, &self.cylinders)
        {
            self.renew_lists();
        }
    }

    fn renew_lists(&mut self) {
        self.pairs = self.pairs.renewed(&self.cylinders, 2.0 + SKIN);
        for (wall, contacts) in self.walls.iter().zip(&mut self.wall_contacts) {
            *contacts = beside_wall(wall, &self.cylinders, SKIN, contacts);
        }
    }
}
