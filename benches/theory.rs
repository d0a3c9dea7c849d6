//! Cost of yield forces by the closed form: one, a curve of 25, and one with all events on the way.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use tristack::model::Stack;
use tristack::theory::{closed_form_limit, floor_slip_force, floor_slip_forces};

/// Below, near and above the critical friction; the last needs the most steps.
const STACKS: [(&str, f64, f64); 4] = [
    ("mu 0.2, 1e4", 0.2, 1e4),
    ("mu 0.27, 1e6", 0.27, 1e6),
    ("mu 0.3, 1e2", 0.3, 1e2),
    ("mu 0.5, 1e1", 0.5, 1e1),
];
const CURVE_POINTS: usize = 25;

fn yield_force(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("floor_slip_force");
    for (name, floor_friction, stiffness) in STACKS {
        let stack = Stack::paper(floor_friction, stiffness);
        group.bench_function(name, |bencher| {
            bencher.iter(|| floor_slip_force(black_box(&stack)));
        });
    }
}

fn yield_curve(criterion: &mut Criterion) {
    let part = |index: usize| index as f64 / (CURVE_POINTS - 1) as f64;
    let frictions = [0.1, 0.5].map(black_box);
    let frictions: Vec<f64> = (0..CURVE_POINTS)
        .map(|index| frictions[0] + (frictions[1] - frictions[0]) * part(index))
        .collect();
    let mut group = criterion.benchmark_group("floor_slip_forces");
    group.throughput(Throughput::Elements(CURVE_POINTS as u64));
    for stiffness in [1e2, 1e4] {
        group.bench_function(format!("mu 0.1 to 0.5, {stiffness:e}"), |bencher| {
            bencher.iter(|| floor_slip_forces(black_box(&frictions), stiffness, 2.5));
        });
    }
}

fn strict_limit(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("closed_form_limit");
    for (name, floor_friction, stiffness) in STACKS {
        let stack = Stack::paper(floor_friction, stiffness);
        group.bench_function(name, |bencher| {
            bencher.iter(|| closed_form_limit(black_box(&stack)));
        });
    }
}

criterion_group!(benches, yield_force, yield_curve, strict_limit);
criterion_main!(benches);
