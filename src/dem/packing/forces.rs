//! Forces of all contacts.

use super::bodies::{Packing, weight};
use super::pairs::UNSTRETCHED;
use super::walls::{NO_FORCE, overlap};
use crate::dem::contact::{Contact, ContactModel, Counterpart, along, tangential};
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
        let weight = weight(self.gravity);
        let mut start = 0;
        for (first, &end) in pairs.ends.iter().enumerate() {
            let end = end as usize;
            let i = &cylinders[first];
            let mut load = weight;
            let seconds = pairs.seconds[start..end].iter();
            for (&second, memory) in seconds.zip(&mut pairs.memories[start..end]) {
                let j = &cylinders[second as usize];
                let dx = i.position[0] - j.position[0];
                let dy = i.position[1] - j.position[1];
                let square = dx * dx + dy * dy;
                if square >= 4.0 {
                    *memory = UNSTRETCHED;
                    continue;
                }
                let distance = square.sqrt();
                let normal = [dx / distance, dy / distance];
                let velocity = [i.velocity[0] - j.velocity[0], i.velocity[1] - j.velocity[1]];
                let contact = Contact {
                    counterpart: Counterpart::Cylinder,
                    normal,
                    overlap: 2.0 - distance,
                    separation_speed: along(normal, velocity),
                    sliding_speed: tangential(normal, velocity),
                    spin: i.spin + j.spin,
                    friction: material.cylinder_friction,
                    time_step: self.time_step,
                };
                let force = material.law.evaluate(&contact, memory);
                let [fx, fy] = force.in_the_plane(normal);
                let torque = -(force.arm * force.tangential);
                add(&mut load, [fx, fy], torque);
                add(&mut loads[second as usize], [-fx, -fy], torque);
            }
            loads[first] = load;
            start = end;
        }
    }

    fn evaluate_wall(&mut self, wall: usize) {
        let plane = &self.walls[wall];
        for state in &mut self.wall_contacts[wall] {
            let body = &self.cylinders[state.cylinder as usize];
            let overlap = overlap(plane, body);
            if overlap <= 0.0 {
                state.memory = UNSTRETCHED;
                state.force = NO_FORCE;
                continue;
            }
            let contact = Contact {
                counterpart: Counterpart::Wall,
                normal: plane.facing.normal(overlap),
                overlap,
                separation_speed: plane.facing.along(body.velocity) - plane.speed,
                sliding_speed: plane.facing.tangential(body.velocity),
                spin: body.spin,
                friction: plane.friction,
                time_step: self.time_step,
            };
            state.force = self.material.law.evaluate(&contact, &mut state.memory);
            let force = plane.facing.in_the_plane(&state.force);
            let torque = -(state.force.arm * state.force.tangential);
            add(&mut self.loads[state.cylinder as usize], force, torque);
        }
    }
}

fn add(load: &mut Load, force: [f64; 2], torque: f64) {
    load.force[0] += force[0];
    load.force[1] += force[1];
    load.torque += torque;
}
