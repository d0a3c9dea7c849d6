//! What the peak of a series leaves open beyond its budget.

use super::plan::Measurement;

/// The peak is grainy: it comes while the floor slips and sticks from step to step, which may hide up to
/// two steps of load in each run. The extrapolation adds them up with the weights 1/3, 2 and 8/3 at speeds
/// of 1, 1/2 and 1/4 of the fastest: four steps at the fastest speed.
const GRAINY_STEPS: f64 = 4.0;

/// Uncertainty of the extrapolated peak of `measurement` beyond its budget, in m g, the peak being near
/// `reference`; `None` where nothing is planned.
pub(crate) fn peak_allowance(measurement: &Measurement, reference: f64) -> Option<f64> {
    let travel = measurement.limit.peak_travel?;
    let fastest = &measurement.cases.first()?.protocol;
    let load_per_step =
        measurement.stack.floor_load(reference) * fastest.wall_speed * fastest.time_step / travel;
    Some(GRAINY_STEPS * load_per_step)
}
