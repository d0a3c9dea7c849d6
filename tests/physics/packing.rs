//! Many cylinders or spheres: the same bits as in the small scene, and thousands of spheres as physics.

mod bits;
mod cluster;
mod heap;
mod rest;
mod turned;

use tristack::dem::{Body, Material, Packing, Space, Sphere};
use tristack::model::{ContactConvention, Stack};

const TIME_STEP: f64 = 0.1;

/// The material of solid spheres under `convention`.
fn solid(convention: ContactConvention) -> Material {
    Material {
        moment_of_inertia: 0.4,
        ..Material::new(&Stack::paper(0.5, 1e3), &convention)
    }
}

/// A sphere at each of `centres`, each with a motion of its own: components of velocity and spin are at most `speed`.
fn moving(centres: &[[f64; 3]], speed: f64) -> Vec<Sphere> {
    let mut random = fastrand::Rng::with_seed(7);
    let mut vector = || [(); 3].map(|()| speed * (2.0 * random.f64() - 1.0));
    let spheres = centres.iter().map(|&centre| Sphere {
        velocity: vector(),
        spin: vector(),
        ..Body::resting(centre)
    });
    spheres.collect()
}

/// Evaluates the forces under `gravity` and advances.
fn step(packing: &mut Packing<Space>, gravity: f64) {
    packing.gravity = gravity;
    packing.evaluate_forces();
    packing.advance();
}

/// Largest difference of two components.
fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    let apart = [0, 1, 2].map(|axis| (one[axis] - other[axis]).abs());
    assert!(apart.iter().all(|part| part.is_finite()), "{apart:?}");
    apart.into_iter().fold(0.0, f64::max)
}
