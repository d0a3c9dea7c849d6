//! A shaken heap of spheres, and the same one turned by a right angle.

use super::heap::Heap;
use super::{TIME_STEP, distance, moving, solid, step};
use tristack::dem::{Facing, Packing, PlaneWall, Space, Sphere};
use tristack::model::ContactConvention;

const STEPS: u32 = 1000;

/// `vector` turned by a right angle about the vertical.
fn turned([x, y, z]: [f64; 3]) -> [f64; 3] {
    [z, y, -x]
}

fn turned_sphere(sphere: &Sphere) -> Sphere {
    Sphere {
        position: turned(sphere.position),
        velocity: turned(sphere.velocity),
        spin: turned(sphere.spin),
        angle: turned(sphere.angle),
    }
}

fn turned_wall(wall: &PlaneWall) -> PlaneWall {
    let facing = match wall.facing {
        Facing::Right => Facing::Back,
        Facing::Back => Facing::Left,
        Facing::Left => Facing::Front,
        Facing::Front => Facing::Right,
        vertical => vertical,
    };
    PlaneWall { facing, ..*wall }
}

/// Shakes the heap up and down.
fn shaken(spheres: Vec<Sphere>, walls: Vec<PlaneWall>) -> Packing<Space> {
    let material = solid(ContactConvention::TURNING);
    let mut packing = Packing::new(spheres, walls, material, TIME_STEP);
    for index in 0..STEPS {
        let falls = index / 100 % 2 == 0;
        step(&mut packing, if falls { 2e-3 } else { -1e-3 });
    }
    packing
}

/// Largest distance of a sphere to its counterpart.
fn farthest<'a>(
    spheres: impl Iterator<Item = Sphere>,
    others: impl Iterator<Item = &'a Sphere>,
) -> f64 {
    let pairs = spheres.zip(others);
    let apart = pairs.map(|(one, other)| distance(one.position, other.position));
    apart.fold(0.0, f64::max)
}

/// No two sides of the box are alike. Collisions magnify what is rounded, as much as they do a small change of the start.
#[test]
fn a_shaken_heap_moves_in_the_same_way_when_everything_is_turned_about_the_vertical() {
    const CHANGE: f64 = 1e-12;
    let heap = Heap {
        edge: 16,
        layers: 8,
    };
    let spheres = moving(&heap.compressed(), 0.02);
    let mut walls = heap.walls(0.5, [0.1, 0.2, 0.3, 0.4]);
    walls[1].speed = 1e-3;
    walls[3].speed = -1e-3;
    let packing = shaken(spheres.clone(), walls.clone());
    let turned = shaken(
        spheres.iter().map(turned_sphere).collect(),
        walls.iter().map(turned_wall).collect(),
    );
    let mut changed = spheres.clone();
    for (sphere, sign) in changed.iter_mut().zip([1.0, -1.0].into_iter().cycle()) {
        sphere.position = sphere.position.map(|part| part + sign * CHANGE);
    }
    let changed = shaken(changed, walls);

    let end = || packing.cylinders().iter();
    let moved = farthest(end().copied(), spheres.iter());
    let growth = farthest(end().copied(), changed.cylinders().iter()) / CHANGE;
    let apart = farthest(end().map(turned_sphere), turned.cylinders().iter());
    // In every step a coordinate up to 16 is rounded, and perhaps magnified from then on as the change at the start is.
    let rounded = f64::from(STEPS) * 8.0 * f64::EPSILON;
    println!(
        "moved {moved}, growth {growth}, apart {apart:e} of {:e}",
        growth * rounded
    );
    assert!(moved > 0.25 && growth * rounded < 1e-6);
    assert!(apart < growth * rounded);
}
