//! Evaluation of the forces of all contacts.

use super::bodies::Packing;
use crate::dem::body::{Body, Load, Touch};
use crate::dem::contact::{Contact, ContactForce, ContactModel, Spring};
use crate::dem::geometry::Geometry;

impl<G: Geometry<f64>> Packing<G> {
    /// Evaluates every contact at the present positions and advances the tangential springs to them.
    pub fn evaluate_forces(&mut self) {
        self.evaluate_pairs();
        for wall in 0..self.walls.len() {
            self.evaluate_wall(wall);
        }
    }

    fn evaluate_pairs(&mut self) {
        let Self {
            material,
            cylinders,
            loads,
            pairs,
            ..
        } = self;
        let weight = Load::weight(self.gravity);
        let mut start = 0;
        for (first, &end) in pairs.ends.iter().enumerate() {
            let end = end as usize;
            let i = &cylinders[first];
            let mut load = weight;
            let seconds = pairs.seconds[start..end].iter();
            for (&second, memory) in seconds.zip(&mut pairs.memories[start..end]) {
                let j = &cylinders[second as usize];
                let (apart, square) = Body::apart([i, j]);
                if square >= 4.0 {
                    *memory = Spring::unstretched(0.0);
                    continue;
                }
                let friction = material.cylinder_friction;
                let contact = Contact::of_pair([i, j], (apart, square), friction, self.time_step);
                let exerted = material.law.evaluate(&contact, memory);
                let both = [&mut load, &mut loads[second as usize]];
                exerted.act_on_pair(contact.normal, Touch::Everywhere, both);
            }
            loads[first] = load;
            start = end;
        }
    }

    fn evaluate_wall(&mut self, wall: usize) {
        let plane = &self.walls[wall];
        for state in &mut self.wall_contacts[wall] {
            let body = &self.cylinders[state.cylinder as usize];
            let overlap = plane.overlap::<G>(body.position);
            if overlap <= 0.0 {
                state.memory = Spring::unstretched(0.0);
                state.force = ContactForce::none(0.0);
                continue;
            }
            let contact = Contact::with_wall(body, plane, overlap, self.time_step);
            state.force = self.material.law.evaluate(&contact, &mut state.memory);
            let (normal, tangential) = (state.force.normal, state.force.tangential);
            let force = G::put_together_at_wall(plane.facing, normal, tangential);
            let torque = state.force.torque(contact.normal);
            self.loads[state.cylinder as usize].add(Touch::Everywhere, force, torque);
        }
    }
}
