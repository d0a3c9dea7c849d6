use std::time::Instant;
use tristack::dem::*;
use tristack::stack::*;
use tristack::trace::*;
struct Q { cases: Vec<Case>, next: usize, out: Vec<Option<Trace>> }
impl RunQueue for Q {
    fn next(&mut self) -> Option<OpenRun> {
        let index = self.next; self.next += 1;
        Some(OpenRun { index, case: *self.cases.get(index)?, checkpoint: None })
    }
    fn wanted(&mut self, _: &dyn Fn() -> Vec<(usize, Checkpoint)>) -> bool { true }
    fn ended(&mut self, index: usize, series: Result<Trace, SeriesError>) { self.out[index] = series.ok(); }
}
fn main() {
    let n: usize = std::env::args().nth(1).map_or(16, |a| a.parse().unwrap());
    let cases: Vec<Case> = (0..n).map(|i| {
        let stack = Stack::paper(0.2 + 0.001 * i as f64, 1e2);
        let m = tristack::crosscheck::plan(tristack::engine::EngineName::Native, &stack, Convention::PAPER);
        let mut c = m.cases[0]; c.protocol.time_step = 0.01; c
    }).collect();
    let steps: u64 = cases.iter().map(Case::total_steps).sum();
    let t = Instant::now();
    let scalar: Vec<Trace> = cases.iter().map(|c| compress_stack(c, || true).unwrap()).collect();
    println!("scalar {:.2} ns/step", t.elapsed().as_secs_f64() * 1e9 / steps as f64);
    for w in LaneWidth::available() {
        let mut q = Q { cases: cases.clone(), next: 0, out: vec![None; n] };
        let t = Instant::now();
        w.compress_stacks(&mut q);
        println!("{} lanes {:.2} ns/step", w.lanes(), t.elapsed().as_secs_f64() * 1e9 / steps as f64);
        for (a, b) in scalar.iter().zip(&q.out) { assert!(a == b.as_ref().unwrap()); }
    }
}
