//! Forces of all contacts.

use super::bodies::Packing;
use super::pairs::UNSTRETCHED;
use crate::dem::contact::{Contact, ContactForce, ContactModel};
use crate::dem::contact_state::Touch;
use crate::dem::scene::Load;

impl Packing {
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
                let apart = [i.position[0] - j.position[0], i.position[1] - j.position[1]];
                let square = apart[0] * apart[0] + apart[1] * apart[1];
                if square >= 4.0 {
                    *memory = UNSTRETCHED;
                    continue;
                }
                let friction = material.cylinder_friction;
                let contact = Contact::of_pair([i, j], (apart, square), friction, self.time_step);
                let exerted = material.law.evaluate(&contact, memory);
                let force = exerted.in_the_plane(contact.normal);
                let torque = -(exerted.arm * exerted.tangential);
                load.add(Touch::Everywhere, force, torque);
                loads[second as usize].add(Touch::Everywhere, force.map(|part| -part), torque);
            }
            loads[first] = load;
            start = end;
        }
    }

    fn evaluate_wall(&mut self, wall: usize) {
        let plane = &self.walls[wall];
        for state in &mut self.wall_contacts[wall] {
            let body = &self.cylinders[state.cylinder as usize];
            let overlap = plane.overlap(body.position);
            if overlap <= 0.0 {
                state.memory = UNSTRETCHED;
                state.force = ContactForce::none(0.0);
                continue;
            }
            let contact = Contact::with_wall(body, plane, overlap, self.time_step);
            state.force = self.material.law.evaluate(&contact, &mut state.memory);
            let force = plane.facing.in_the_plane(&state.force);
            let torque = -(state.force.arm * state.force.tangential);
            self.loads[state.cylinder as usize].add(Touch::Everywhere, force, torque);
        }
    }
}
