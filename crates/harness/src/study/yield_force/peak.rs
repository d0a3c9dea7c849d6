//! What the peak of a series leaves open beyond its budget.

use super::plan::Measurement;
use crate::model::Protocol;

/// The peak is grainy: it comes while the floor slips and sticks from step to step, which may hide up to
/// two steps of load in each run. The extrapolation adds them up with the weights 1/3, 2 and 8/3 at speeds
/// of 1, 1/2 and 1/4 of the fastest: four steps at the fastest speed.
const GRAINY_STEPS: f64 = 4.0;

/// Uncertainty of the extrapolated peak of `measurement` beyond its budget, in m g, the peak being near
/// `reference`; `None` where nothing is planned.
pub(crate) fn peak_allowance(measurement: &Measurement, reference: f64) -> Option<f64> {
    let fastest = &measurement.cases.first()?.protocol;
    Some(GRAINY_STEPS * load_per_step(measurement, fastest, reference)?)
}

/// By how much the load near `reference` grows in a time step of a run of `measurement`, in m g.
pub(super) fn load_per_step(
    measurement: &Measurement,
    protocol: &Protocol,
    reference: f64,
) -> Option<f64> {
    let travel = measurement.limit.peak_travel?;
    let step = protocol.wall_speed * protocol.time_step;
    Some(measurement.stack.floor_load(reference) * step / travel)
}
