//! What the native DEM measures at a wall that stands still: three wall speeds, as a crosscheck plans them, extrapolated to
//! none.

use std::thread;
use tristack::dem::compress_stack;
use tristack::model::Case;
use tristack::series::{Mechanics, YieldEstimates};
use tristack::study::yield_force::Measurement;

/// Slip onset and peak of a measurement at a wall that stands still, in m g.
pub fn onset_and_peak(measurement: &Measurement) -> [f64; 2] {
    three_speeds(measurement)
        .map(|[fast, middle, slow]| fast / 3.0 - 2.0 * middle + 8.0 / 3.0 * slow)
}

/// Slip onset and peak of a measurement, in m g, at its three speeds, each half the one before. All series obey mechanics.
pub fn three_speeds(measurement: &Measurement) -> [[f64; 3]; 2] {
    let forces: Vec<[f64; 2]> = thread::scope(|scope| {
        let cases = measurement.cases[..3].iter();
        let runs: Vec<_> = cases.map(|case| scope.spawn(|| measured(case))).collect();
        let runs = runs.into_iter();
        runs.map(|run| run.join().expect("a run")).collect()
    });
    [0, 1].map(|which| [0, 1, 2].map(|run| forces[run][which]))
}

/// Slip onset and peak of one run.
fn measured(case: &Case) -> [f64; 2] {
    let series = compress_stack(case, || true).expect("a finite series");
    let mechanics = Mechanics::read(&series, case);
    let violations: Vec<_> = mechanics.violations().collect();
    assert!(violations.is_empty(), "{case:?} {violations:?}");
    let estimates = YieldEstimates::read(&series, case);
    assert_eq!(estimates.departure, None);
    [estimates.slip, estimates.peak].map(|estimate| estimate.expect("an estimate").force)
}
