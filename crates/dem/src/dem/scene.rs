//! Cylinders or spheres between plane walls, and the loops of a step over their contacts and bodies.

use super::body::{Body, Load, Touch};
use super::contact::{Contact, ContactForce, ContactModel, SpringDashpot};
use super::contact_state::ContactState;
use super::geometry::{Geometry, Plane};
use super::real::{Composite, Real};
use super::wall::PlaneWall;
use crate::model::CYLINDER_INERTIA;

/// Loops over all indices below a count, with the first three unrolled.
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
        #[allow(clippy::needless_range_loop)] // Bodies, loads and contacts share the index.
        for $index in 3..$count $body
    };
}

/// Loops over the bodies below a count; in the plane, where the compiler knows the count, the loop is unrolled.
macro_rules! each_body {
    ($index:ident below $known:ident or $count:expr => $body:block) => {
        if G::IS_SMALL {
            unrolled!($index below $known $body);
        } else {
            #[allow(clippy::needless_range_loop)]
            for $index in 0..$count $body
        }
    };
}

/// Cylinders or spheres, walls and the state of all their contacts. The numbers of bodies and walls are known at
/// compile time, so that the compiler keeps values in registers as far as possible.
#[derive(Debug, Clone)]
pub struct Scene<
    const CYLINDERS: usize,
    const WALLS: usize,
    R: Real = f64,
    Model: ContactModel<R, G> = SpringDashpot<R>,
    G: Geometry<R> = Plane,
> {
    /// The cylinders, or spheres.
    pub cylinders: [Body<R, G>; CYLINDERS],
    /// Number of spheres that exist in space, the first ones; the others are skipped. In the plane, all cylinders
    /// exist.
    pub sphere_count: usize,
    /// The walls.
    pub walls: [PlaneWall<R>; WALLS],
    /// The walls that exist; the others are skipped.
    pub wall_exists: [bool; WALLS],
    /// Contact law of all contacts.
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
    pair_contacts: [[ContactState<R, Model::Memory, G>; CYLINDERS]; CYLINDERS],
    wall_contacts: [[ContactState<R, Model::Memory, G>; CYLINDERS]; WALLS],
    loads: [Load<R, G>; CYLINDERS],
}

impl<const CYLINDERS: usize, const WALLS: usize, R, Model, G> Scene<CYLINDERS, WALLS, R, Model, G>
where
    R: Real,
    Model: ContactModel<R, G>,
    G: Geometry<R>,
{
    /// A scene without friction between cylinders and without gravity, in which every contact is free of stress.
    pub fn new(
        cylinders: [Body<R, G>; CYLINDERS],
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
            sphere_count: CYLINDERS,
            walls,
            wall_exists: [true; WALLS],
            model,
            cylinder_friction: zero,
            moment_of_inertia: zero.like(CYLINDER_INERTIA),
            gravity: zero,
            time_step,
        }
    }

    /// Force of a wall on a cylinder, from the last evaluation of the forces.
    pub fn wall_force(&self, wall: usize, cylinder: usize) -> &ContactForce<R, G> {
        &self.wall_contacts[wall][cylinder].force
    }

    /// Force and torque on a cylinder, from the last evaluation of the forces.
    pub fn load(&self, cylinder: usize) -> &Load<R, G> {
        &self.loads[cylinder]
    }

    /// Force between two cylinders, the higher index first, from the last evaluation of the forces.
    pub fn pair_force(&self, first: usize, second: usize) -> &ContactForce<R, G> {
        &self.pair_contacts[first][second].force
    }

    /// Memory of the contact of two cylinders, the higher index first.
    pub(super) fn pair_memory(&mut self, first: usize, second: usize) -> &mut Model::Memory {
        &mut self.pair_contacts[first][second].memory
    }

    /// Memory of the contact of a wall with a cylinder.
    pub(super) fn wall_memory(&mut self, wall: usize, cylinder: usize) -> &mut Model::Memory {
        &mut self.wall_contacts[wall][cylinder].memory
    }

    /// Evaluates every contact at the present positions and advances the tangential springs to them.
    #[inline(always)]
    pub fn evaluate_forces(&mut self) {
        let mut loads = self.loads;
        self.evaluate_pairs::<true>(&mut loads);
        self.evaluate_walls::<true>(&mut loads);
        self.loads = loads;
    }

    /// Kicks the velocities over a whole step with the evaluated forces, then drifts the positions, and
    /// moves the walls.
    #[inline(always)]
    pub fn advance(&mut self) {
        self.advance_bodies(&self.loads.clone());
        self.move_walls();
    }

    /// Evaluates the forces and advances, `count` times. The contact forces are not kept.
    #[inline(always)]
    pub fn steps(&mut self, count: u64) {
        let mut loads = self.loads;
        for _ in 0..count {
            self.evaluate_pairs::<false>(&mut loads);
            if G::IS_SMALL {
                self.evaluate_walls::<false>(&mut loads);
                self.advance_bodies(&loads);
            } else {
                self.evaluate_walls_and_advance(&loads);
            }
            self.move_walls();
        }
    }

    /// Adds the forces of the walls to `loads`, which hold those of the pairs, and advances the bodies. The walls of
    /// one body do not affect another, so each body moves as soon as its own walls are evaluated, and its load stays
    /// in registers.
    #[inline(always)]
    fn evaluate_walls_and_advance(&mut self, loads: &[Load<R, G>; CYLINDERS]) {
        let (dt, moment_of_inertia) = (self.time_step, self.moment_of_inertia);
        for (body, &load) in loads.iter().enumerate().take(self.sphere_count) {
            let mut load = load;
            for wall in 0..WALLS {
                if self.wall_exists[wall] {
                    self.evaluate_wall::<false>(wall, body, &mut load);
                }
            }
            self.cylinders[body].advance(&load, moment_of_inertia, dt);
        }
    }

    #[inline(always)]
    fn advance_bodies(&mut self, loads: &[Load<R, G>; CYLINDERS]) {
        let (dt, moment_of_inertia) = (self.time_step, self.moment_of_inertia);
        each_body!(body below CYLINDERS or self.sphere_count => {
            self.cylinders[body].advance(&loads[body], moment_of_inertia, dt);
        });
    }

    #[inline(always)]
    fn move_walls(&mut self) {
        for (wall, exists) in self.walls.iter_mut().zip(self.wall_exists) {
            if exists {
                wall.offset += wall.speed * self.time_step;
            }
        }
    }

    /// Sets the loads to the weights plus the forces of all pairs.
    #[inline(always)]
    fn evaluate_pairs<const KEEP: bool>(&mut self, loads: &mut [Load<R, G>; CYLINDERS]) {
        each_body!(first below CYLINDERS or self.sphere_count => {
            let mut load = Load::weight(self.gravity);
            each_body!(second below first or first => {
                self.evaluate_pair::<KEEP>([first, second], [&mut load, &mut loads[second]]);
            });
            loads[first] = load;
        });
    }

    /// Adds the forces of all walls to the loads.
    #[inline(always)]
    fn evaluate_walls<const KEEP: bool>(&mut self, loads: &mut [Load<R, G>; CYLINDERS]) {
        for wall in 0..WALLS {
            if self.wall_exists[wall] {
                each_body!(body below CYLINDERS or self.sphere_count => {
                    self.evaluate_wall::<KEEP>(wall, body, &mut loads[body]);
                });
            }
        }
    }

    #[inline(always)]
    fn evaluate_pair<const KEEP: bool>(&mut self, pair: [usize; 2], loads: [&mut Load<R, G>; 2]) {
        let (apart, square) = Body::apart(pair.map(|body| &self.cylinders[body]));
        let touches = square.less(square.like(4.0));
        if !square.any(touches) {
            self.pair_contacts[pair[0]][pair[1]].separate::<KEEP, _>(&self.model, square);
        } else if square.all(touches) {
            self.press_pair::<KEEP>(pair, (apart, square), Touch::Everywhere, loads);
        } else {
            self.press_pair::<KEEP>(pair, (apart, square), Touch::Where(touches), loads);
        }
    }

    #[inline(always)]
    fn press_pair<const KEEP: bool>(
        &mut self,
        pair: [usize; 2],
        distance: (G::Vector, R),
        touches: Touch<R>,
        loads: [&mut Load<R, G>; 2],
    ) {
        let bodies = pair.map(|body| &self.cylinders[body]);
        let contact = Contact::of_pair(bodies, distance, self.cylinder_friction, self.time_step);
        let state = &mut self.pair_contacts[pair[0]][pair[1]];
        let exerted = state.evaluate::<KEEP, _>(&self.model, &contact, touches);
        exerted.act_on_pair(contact.normal, touches, loads);
    }

    #[inline(always)]
    fn evaluate_wall<const KEEP: bool>(&mut self, wall: usize, body: usize, load: &mut Load<R, G>) {
        let overlap = self.walls[wall].overlap::<G>(self.cylinders[body].position);
        let touches = overlap.like(0.0).less(overlap);
        if !overlap.any(touches) {
            self.wall_contacts[wall][body].separate::<KEEP, _>(&self.model, overlap);
        } else if overlap.all(touches) {
            self.press_on_wall::<KEEP>(wall, body, overlap, Touch::Everywhere, load);
        } else {
            self.press_on_wall::<KEEP>(wall, body, overlap, Touch::Where(touches), load);
        }
    }

    #[inline(always)]
    fn press_on_wall<const KEEP: bool>(
        &mut self,
        wall: usize,
        body: usize,
        overlap: R,
        touches: Touch<R>,
        load: &mut Load<R, G>,
    ) {
        let plane = self.walls[wall];
        let contact = Contact::with_wall(&self.cylinders[body], &plane, overlap, self.time_step);
        let state = &mut self.wall_contacts[wall][body];
        let exerted = state.evaluate::<KEEP, _>(&self.model, &contact, touches);
        let force = G::put_together_at_wall(plane.facing, exerted.normal, exerted.tangential);
        load.add(touches, force, exerted.torque(contact.normal));
    }
}

impl<const CYLINDERS: usize, const WALLS: usize, R, Model, G> Composite<R>
    for Scene<CYLINDERS, WALLS, R, Model, G>
where
    R: Real,
    Model: ContactModel<R, G> + Composite<R>,
    G: Geometry<R>,
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
