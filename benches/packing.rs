//! Steps of some four thousand cylinders in the plane, and of as many spheres in space: time of a step, bodies per second.

#[path = "../tests/physics/packing/heap.rs"]
#[allow(dead_code)] // Tests use all of it.
mod heap;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use heap::Heap;
use tristack::dem::{Geometry, Material, Packing, Sphere};
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

criterion_group!(benches, cylinders, spheres);
criterion_main!(benches);
