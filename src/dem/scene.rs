//! Cylinders between plane walls, and one leapfrog step of them all.

use super::contact::{
    Contact, ContactForce, ContactModel, Counterpart, SpringDashpot, along, tangential,
};
use super::contact_state::{ContactState, Touch};
use super::real::{Composite, Real, composite};
use super::wall::PlaneWall;
use crate::model::CYLINDER_INERTIA;

/// A loop over all indices below a count, the first three unrolled.
macro_rules! unrolled {
    ($index:ident below $count:ident $body:block) => {
        if $count > 0 {
            let $index = 0;
            $body
        }
        if $count > 1 {
            let $index = 1;
            $body
        }
        if $count > 2 {
            let $index = 2;
            $body
        }
        for $index in 3..$count $body
    };
}

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
    Load { force, torque },
);

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

    /// Kicks the velocities over a whole step, then drifts the positions.
    #[inline(always)]
    pub(super) fn advance(&mut self, load: &Load<R>, moment_of_inertia: R, time_step: R) {
        for axis in 0..2 {
            self.velocity[axis] += load.force[axis] * time_step;
            self.position[axis] += self.velocity[axis] * time_step;
        }
        self.spin += load.torque / moment_of_inertia * time_step;
        self.angle += self.spin * time_step;
    }
}

impl<R: Real> Contact<R> {
    /// The contact of two cylinders, from the difference of their positions and its square.
    #[inline(always)]
    pub(super) fn of_pair(
        [i, j]: [&Cylinder<R>; 2],
        (apart, square): ([R; 2], R),
        friction: R,
        time_step: R,
    ) -> Self {
        let distance = square.sqrt();
        let normal = [apart[0] / distance, apart[1] / distance];
        let velocity = [i.velocity[0] - j.velocity[0], i.velocity[1] - j.velocity[1]];
        Self {
            counterpart: Counterpart::Cylinder,
            normal,
            overlap: distance.like(2.0) - distance,
            separation_speed: along(normal, velocity),
            sliding_speed: tangential(normal, velocity),
            spin: i.spin + j.spin,
            friction,
            time_step,
        }
    }

    /// The contact of a cylinder with a wall.
    #[inline(always)]
    pub(super) fn with_wall(
        body: &Cylinder<R>,
        plane: &PlaneWall<R>,
        overlap: R,
        time_step: R,
    ) -> Self {
        Self {
            counterpart: Counterpart::Wall,
            normal: plane.facing.normal(overlap),
            overlap,
            separation_speed: plane.facing.along(body.velocity) - plane.speed,
            sliding_speed: plane.facing.tangential(body.velocity),
            spin: body.spin,
            friction: plane.friction,
            time_step,
        }
    }
}

/// Cylinders, walls and the state of all their contacts. Their numbers are known to the compiler, which keeps them in
/// registers as far as possible.
#[derive(Debug, Clone)]
pub struct Scene<
    const CYLINDERS: usize,
    const WALLS: usize,
    R: Real = f64,
    Model: ContactModel<R> = SpringDashpot<R>,
> {
    /// The cylinders.
    pub cylinders: [Cylinder<R>; CYLINDERS],
    /// The walls.
    pub walls: [PlaneWall<R>; WALLS],
    /// The walls that exist; the others are skipped.
    pub wall_exists: [bool; WALLS],
    /// Contact law of every contact.
    pub model: Model,
    /// Friction coefficient between cylinders.
    pub cylinder_friction: R,
    /// Moment of inertia of a cylinder.
    pub moment_of_inertia: R,
    /// Gravity, downwards.
    pub gravity: R,
    /// Time step.
    pub time_step: R,
    /// Contacts of pairs, by the higher index and the lower one.
    pair_contacts: [[ContactState<R, Model::Memory>; CYLINDERS]; CYLINDERS],
    wall_contacts: [[ContactState<R, Model::Memory>; CYLINDERS]; WALLS],
    loads: [Load<R>; CYLINDERS],
}

/// Force and torque on a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load<R = f64> {
    /// Force.
    pub force: [R; 2],
    /// Torque about the centre, counter-clockwise.
    pub torque: R,
}

impl<const CYLINDERS: usize, const WALLS: usize, R: Real, Model: ContactModel<R>>
    Scene<CYLINDERS, WALLS, R, Model>
{
    /// A scene without friction between cylinders and without gravity; every contact is free of stress.
    pub fn new(
        cylinders: [Cylinder<R>; CYLINDERS],
        walls: [PlaneWall<R>; WALLS],
        model: Model,
        time_step: R,
    ) -> Self {
        let zero = time_step.like(0.0);
        let contact = ContactState::initial(&model, zero);
        Self {
            pair_contacts: [[contact; CYLINDERS]; CYLINDERS],
            wall_contacts: [[contact; CYLINDERS]; WALLS],
            loads: [Load::weight(zero); CYLINDERS],
            cylinders,
            walls,
            wall_exists: [true; WALLS],
            model,
            cylinder_friction: zero,
            moment_of_inertia: zero.like(CYLINDER_INERTIA),
            gravity: zero,
            time_step,
        }
    }

    /// Force of a wall on a cylinder, as of the last evaluation of the forces.
    pub fn wall_force(&self, wall: usize, cylinder: usize) -> &ContactForce<R> {
        &self.wall_contacts[wall][cylinder].force
    }

    /// Force and torque on a cylinder, as of the last evaluation of the forces.
    pub fn load(&self, cylinder: usize) -> &Load<R> {
        &self.loads[cylinder]
    }

    /// Force between two cylinders, the one with the higher index first, as of the last evaluation of the forces.
    pub fn pair_force(&self, first: usize, second: usize) -> &ContactForce<R> {
        &self.pair_contacts[first][second].force
    }

    /// Evaluates every contact at the present positions and advances the tangential springs to them.
    #[inline(always)]
    pub fn evaluate_forces(&mut self) {
        self.loads = self.forces::<true>();
    }

    /// Kicks the velocities over a whole step with the evaluated forces, then drifts the positions, and
    /// moves the walls.
    #[inline(always)]
    pub fn advance(&mut self) {
        self.accelerate(&self.loads.clone());
    }

    /// Evaluates the forces and advances. The contact forces are not kept.
    #[inline(always)]
    pub fn step(&mut self) {
        let loads = self.forces::<false>();
        self.accelerate(&loads);
    }

    /// The loads on all cylinders.
    #[inline(always)]
    fn forces<const KEEP: bool>(&mut self) -> [Load<R>; CYLINDERS] {
        let mut loads = [Load::weight(self.gravity); CYLINDERS];
        unrolled!(first below CYLINDERS {
            unrolled!(second below first {
                self.evaluate_pair::<KEEP>(first, second, &mut loads);
            });
        });
        for wall in 0..WALLS {
            if self.wall_exists[wall] {
                unrolled!(cylinder below CYLINDERS {
                    self.evaluate_wall::<KEEP>(wall, cylinder, &mut loads);
                });
            }
        }
        loads
    }

    #[inline(always)]
    fn accelerate(&mut self, loads: &[Load<R>; CYLINDERS]) {
        let dt = self.time_step;
        for (cylinder, load) in self.cylinders.iter_mut().zip(loads) {
            cylinder.advance(load, self.moment_of_inertia, dt);
        }
        for (wall, exists) in self.walls.iter_mut().zip(self.wall_exists) {
            if exists {
                wall.offset += wall.speed * dt;
            }
        }
    }

    #[inline(always)]
    fn evaluate_pair<const KEEP: bool>(
        &mut self,
        first: usize,
        second: usize,
        loads: &mut [Load<R>; CYLINDERS],
    ) {
        let [i, j] = [first, second].map(|index| self.cylinders[index].position);
        let apart = [i[0] - j[0], i[1] - j[1]];
        let square = apart[0] * apart[0] + apart[1] * apart[1];
        let touches = square.less(square.like(4.0));
        if !square.any(touches) {
            self.pair_contacts[first][second].separate::<KEEP, _>(&self.model, square);
        } else if square.all(touches) {
            self.press_pair::<KEEP>(first, second, (apart, square), Touch::Everywhere, loads);
        } else {
            self.press_pair::<KEEP>(first, second, (apart, square), Touch::Where(touches), loads);
        }
    }

    #[inline(always)]
    fn press_pair<const KEEP: bool>(
        &mut self,
        first: usize,
        second: usize,
        (apart, square): ([R; 2], R),
        touches: Touch<R>,
        loads: &mut [Load<R>; CYLINDERS],
    ) {
        let pair = [first, second].map(|index| &self.cylinders[index]);
        let contact = Contact::of_pair(
            pair,
            (apart, square),
            self.cylinder_friction,
            self.time_step,
        );
        let state = &mut self.pair_contacts[first][second];
        let exerted = state.evaluate::<KEEP, _>(&self.model, &contact, touches);
        let force = exerted.in_the_plane(contact.normal);
        let torque = exerted.arm * exerted.tangential;
        loads[first].add(touches, force, -torque);
        loads[second].add(touches, [-force[0], -force[1]], -torque);
    }

    #[inline(always)]
    fn evaluate_wall<const KEEP: bool>(
        &mut self,
        wall: usize,
        cylinder: usize,
        loads: &mut [Load<R>; CYLINDERS],
    ) {
        let plane = &self.walls[wall];
        let overlap = plane.overlap(self.cylinders[cylinder].position);
        let touches = overlap.like(0.0).less(overlap);
        if !overlap.any(touches) {
            self.wall_contacts[wall][cylinder].separate::<KEEP, _>(&self.model, overlap);
        } else if overlap.all(touches) {
            self.press_on_wall::<KEEP>(wall, cylinder, overlap, Touch::Everywhere, loads);
        } else {
            self.press_on_wall::<KEEP>(wall, cylinder, overlap, Touch::Where(touches), loads);
        }
    }

    #[inline(always)]
    fn press_on_wall<const KEEP: bool>(
        &mut self,
        wall: usize,
        cylinder: usize,
        overlap: R,
        touches: Touch<R>,
        loads: &mut [Load<R>; CYLINDERS],
    ) {
        let plane = self.walls[wall];
        let contact =
            Contact::with_wall(&self.cylinders[cylinder], &plane, overlap, self.time_step);
        let state = &mut self.wall_contacts[wall][cylinder];
        let exerted = state.evaluate::<KEEP, _>(&self.model, &contact, touches);
        let force = plane.facing.in_the_plane(&exerted);
        let torque = exerted.arm * exerted.tangential;
        loads[cylinder].add(touches, force, -torque);
    }
}

impl<R: Real> Load<R> {
    #[inline(always)]
    pub(super) fn weight(gravity: R) -> Self {
        Self {
            force: [gravity.like(0.0), -gravity],
            torque: gravity.like(0.0),
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, touches: Touch<R>, force: [R; 2], torque: R) {
        let sum = Self {
            force: [self.force[0] + force[0], self.force[1] + force[1]],
            torque: self.torque + torque,
        };
        *self = touches.choose(sum, *self);
    }
}

impl<const CYLINDERS: usize, const WALLS: usize, R: Real, Model: ContactModel<R> + Composite<R>>
    Composite<R> for Scene<CYLINDERS, WALLS, R, Model>
{
    fn visit(&mut self, other: &Self, visit: &mut impl FnMut(&mut R, &R)) {
        self.cylinders.visit(&other.cylinders, visit);
        self.walls.visit(&other.walls, visit);
        self.model.visit(&other.model, visit);
        self.cylinder_friction
            .visit(&other.cylinder_friction, visit);
        self.moment_of_inertia
            .visit(&other.moment_of_inertia, visit);
        self.gravity.visit(&other.gravity, visit);
        self.time_step.visit(&other.time_step, visit);
        self.pair_contacts.visit(&other.pair_contacts, visit);
        self.wall_contacts.visit(&other.wall_contacts, visit);
        self.loads.visit(&other.loads, visit);
    }
}
