//! Native steps of the stack of three, at every width of vectors that this machine has.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use tristack::code::SettledCode;
use tristack::dem::{LaneWidth, OpenRun, OpenRuns, RunQueue};
use tristack::model::{Case, ContactConvention, Stack};
use tristack::series::{Series, SeriesError};
use tristack::study::yield_force::{MIDDLE_RUN, plan};

/// As many in each lane of every width.
const CASES: usize = 16;

/// Planned runs of stacks that differ in their friction.
fn cases() -> Vec<Case> {
    let frictions = (0..CASES).map(|index| 0.3 + 1e-3 * index as f64);
    let stacks = frictions.map(|friction| Stack::paper(friction, 1e3));
    let plans =
        stacks.map(|stack| plan(&SettledCode::native(), &stack, ContactConvention::TURNING));
    plans.map(|plan| plan.cases[MIDDLE_RUN]).collect()
}

/// Hands out the cases, and drops their series.
struct Queue<'a>(std::iter::Enumerate<std::slice::Iter<'a, Case>>);

impl RunQueue for Queue<'_> {
    fn next(&mut self) -> Option<OpenRun> {
        let (index, &case) = self.0.next()?;
        Some(OpenRun {
            index,
            case,
            checkpoint: None,
        })
    }

    fn wanted(&mut self, _open: &dyn OpenRuns) -> bool {
        true
    }

    fn ended(&mut self, _index: usize, series: Result<Series, SeriesError>) {
        series.expect("a whole series");
    }
}

fn steps(criterion: &mut Criterion) {
    let cases = cases();
    let steps = cases.iter().map(Case::total_steps).sum();
    let mut group = criterion.benchmark_group("compress_stacks");
    group
        .throughput(Throughput::Elements(steps))
        .sample_size(20);
    for width in LaneWidth::available() {
        group.bench_function(format!("{} lanes", width.lanes()), |bencher| {
            bencher.iter(|| width.compress_stacks(&mut Queue(cases.iter().enumerate())));
        });
    }
}

criterion_group!(benches, steps);
criterion_main!(benches);
