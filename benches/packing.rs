//! Steps of some four thousand cylinders in the plane, and of as many spheres in space: time of a step, bodies per second;
//! and of three cylinders, as a packing and as a scene, which gives the same bits.

#[path = "../tests/physics/packing/heap.rs"]
#[allow(dead_code)] // Tests use all of it.
mod heap;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use heap::Heap;
use tristack::dem::{Facing, Geometry, Material, Packing, PlaneWall, Scene, Sphere, SpringDashpot};
use tristack::model::{ContactConvention, Pyramid, Stack};

const GRAVITY: f64 = 1e-5;

/// Steps before the first that is timed: by then every row and layer carries those above.
const STEPS_TO_LOAD: u32 = 4000;

fn step<G: Geometry<f64>>(packing: &mut Packing<G>) {
    packing.evaluate_forces();
    packing.advance();
}

fn time<G: Geometry<f64>>(criterion: &mut Criterion, name: &str, mut packing: Packing<G>) {
    packing.gravity = GRAVITY;
    for _ in 0..STEPS_TO_LOAD {
        step(&mut packing);
    }
    let count = packing.cylinders().len();
    let mut group = criterion.benchmark_group("packing");
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function(format!("{count} {name}"), |bencher| {
        bencher.iter(|| step(&mut packing));
    });
}

/// 4005 cylinders.
fn cylinders(criterion: &mut Criterion) {
    let pyramid = Pyramid::touching(89, 1e5, ContactConvention::TURNING);
    time(criterion, "cylinders", Packing::pyramid(&pyramid));
}

/// 4002 spheres.
fn spheres(criterion: &mut Criterion) {
    let heap = Heap {
        edge: 18,
        layers: 13,
    };
    let spheres = heap.centres().into_iter().map(Sphere::resting).collect();
    let material = Material {
        moment_of_inertia: 0.4,
        ..Material::new(&Stack::paper(0.5, 1e5), &ContactConvention::TURNING)
    };
    let packing = Packing::new(spheres, heap.walls(0.5, [0.0; 4]), material, 0.1);
    time(criterion, "spheres", packing);
}

/// The same pyramid of three between its three walls, with and without a list of pairs.
fn three(criterion: &mut Criterion) {
    let pyramid = Pyramid::touching(2, 1e5, ContactConvention::TURNING);
    let mut packing = Packing::pyramid(&pyramid);
    let law = SpringDashpot::like(1.0, &pyramid.convention, pyramid.groups.stiffness_ratio);
    let wall = |facing, offset, friction| PlaneWall {
        facing,
        offset,
        speed: 0.0,
        friction,
    };
    let aside = -pyramid.half_width();
    let walls = [
        wall(Facing::Up, 0.0, pyramid.groups.floor_friction),
        wall(Facing::Right, aside, 0.0),
        wall(Facing::Left, aside, 0.0),
    ];
    let cylinders = packing.cylinders().try_into().expect("three cylinders");
    let mut scene = Scene::<3, 3>::new(cylinders, walls, law, pyramid.time_step);
    scene.cylinder_friction = pyramid.groups.cylinder_friction;
    (packing.gravity, scene.gravity) = (GRAVITY, GRAVITY);
    let mut group = criterion.benchmark_group("three cylinders");
    group.bench_function("packing", |bencher| bencher.iter(|| step(&mut packing)));
    group.bench_function("scene", |bencher| bencher.iter(|| scene.steps(1)));
}

criterion_group!(benches, three, cylinders, spheres);
criterion_main!(benches);
