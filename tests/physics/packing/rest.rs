//! A heap of spheres that comes to rest.

use super::heap::Heap;
use super::{distance, moving, solid, step};
use tristack::dem::{Packing, Space};
use tristack::model::ContactConvention;

const GRAVITY: f64 = 1e-3;

/// With twelve contacts and this much damping, rotations are unstable from some 0.1 on.
const TIME_STEP: f64 = 0.08;

/// Sum of the normal forces of a wall.
fn pressure(packing: &Packing<Space>, wall: usize) -> f64 {
    let mut sum = 0.0;
    for (_, force) in packing.wall_forces(wall) {
        sum += force.normal;
    }
    sum
}

/// Force on all spheres together, from outside: of weight, floor and side walls without friction.
fn from_outside(packing: &Packing<Space>) -> [f64; 3] {
    let weight = packing.cylinders().len() as f64 * packing.gravity;
    let [floor, right, left, front, back] = [0, 1, 2, 3, 4].map(|wall| pressure(packing, wall));
    let mut sum = [right - left, floor - weight, front - back];
    for (_, force) in packing.wall_forces(0) {
        sum[0] += force.tangential[0];
        sum[2] += force.tangential[2];
    }
    sum
}

/// Sum of the forces on every sphere.
fn on_each(packing: &Packing<Space>) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for load in packing.loads() {
        sum = [0, 1, 2].map(|axis| sum[axis] + load.force[axis]);
    }
    sum
}

#[test]
fn the_floor_under_two_thousand_spheres_at_rest_bears_as_many_weights() {
    let heap = Heap {
        edge: 16,
        layers: 8,
    };
    let spheres = moving(&heap.centres(), 1e-3);
    let count = spheres.len() as f64;
    assert_eq!(count, 1924.0);
    let damped = ContactConvention {
        restitution: 0.3,
        ..ContactConvention::TURNING
    };
    let walls = heap.walls(0.5, [0.0; 4]);
    let mut packing = Packing::new(spheres, walls, solid(damped), TIME_STEP);
    let weight = count * GRAVITY;
    for index in 0..8000 {
        let risen = f64::min(1.0, f64::from(index) / 1000.0);
        step(&mut packing, GRAVITY * risen);
        // Contacts between spheres cancel, in motion, too; each of `count` forces that are added is rounded.
        let difference = distance(from_outside(&packing), on_each(&packing));
        assert!(difference < count * f64::EPSILON * weight, "step {index}");
    }
    packing.evaluate_forces();
    let loads = packing.loads().iter();
    let parts = loads.flat_map(|load| [load.force, load.torque]).flatten();
    let unbalanced = parts.map(f64::abs).fold(0.0, f64::max) / GRAVITY;
    let [floor, sides @ ..] = [0, 1, 2, 3, 4].map(|wall| pressure(&packing, wall) / weight);
    println!(
        "floor {:e}, unbalanced {unbalanced:e}, sides {sides:?}",
        floor - 1.0
    );
    // The rest of the slowest oscillation.
    assert!((floor - 1.0).abs() < 1e-6 && unbalanced < 1e-6);
    assert!(sides.iter().all(|&side| side > 0.01));
}
