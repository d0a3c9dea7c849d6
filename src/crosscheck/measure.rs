//! Measurements in, judged rows out.

use super::extrapolate::{Extrapolation, extrapolate};
use super::plan::Measurement;
use super::schedule::{Participant, Progress, RunError, Settings, run_all};
use super::verdict::{Row, Source, Verdict, tolerance};
use crate::archive::Run;
use crate::trace::YieldEstimates;

/// A row, and what stands behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The row.
    pub row: Row,
    /// Slip onset and peak at vanishing wall speed.
    pub slip: Option<Extrapolation>,
    /// See `slip`.
    pub peak: Option<Extrapolation>,
    /// What explains a verdict other than `agrees`.
    pub notes: Vec<String>,
}

/// What is kept of a run.
struct Reading {
    version: String,
    estimates: YieldEstimates,
    /// Wall force at the end, in m g.
    last_force: f64,
}

impl Reading {
    fn new(run: Run) -> Self {
        let stack = &run.case.stack;
        let last = run.trace.samples().last();
        Self {
            estimates: YieldEstimates::read(&run.trace, stack),
            last_force: last.map_or(0.0, |sample| sample.wall_force * stack.stiffness),
            version: run.provenance.identity.version,
        }
    }
}

/// Carries out `measurements` and judges each by its own limit. The order is kept.
pub fn measure(
    measurements: &[Measurement],
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Judgement> {
    let results = run_all(measurements, participants, settings, progress, Reading::new);
    let judged = measurements
        .iter()
        .zip(results)
        .map(|(measurement, results)| {
            let participant = participants
                .iter()
                .find(|who| who.name == measurement.engine);
            let engine = participant.and_then(|participant| participant.engine.as_deref());
            let source = if engine.is_some() {
                Source::Live
            } else {
                Source::Recorded
            };
            let version =
                engine.map_or_else(String::new, |engine| engine.identity().version.clone());
            judge(measurement, source, version, results)
        });
    judged.collect()
}

fn judge(
    measurement: &Measurement,
    source: Source,
    version: String,
    results: Vec<Result<Reading, RunError>>,
) -> Judgement {
    let mut judgement = Judgement {
        row: blank_row(measurement, source, version),
        slip: None,
        peak: None,
        notes: Vec::new(),
    };
    if measurement.cases.is_empty() {
        judgement.row.verdict = Verdict::NoYield;
        judgement.notes.extend(measurement.limit.reason.clone());
        return judgement;
    }
    let mut readings: Vec<Reading> = Vec::new();
    for result in results {
        match result {
            Ok(reading) => readings.push(reading),
            Err(error) => {
                let failed = matches!(error, RunError::Failed(_));
                judgement.row.verdict = if failed {
                    Verdict::Failed
                } else {
                    Verdict::Missing
                };
                judgement.notes.push(error.to_string());
            }
        }
    }
    if let Some(reading) = readings.first() {
        judgement.row.version.clone_from(&reading.version);
    }
    if readings.len() == measurement.cases.len() {
        judge_readings(measurement, &readings, &mut judgement);
    }
    judgement
}

fn blank_row(measurement: &Measurement, source: Source, version: String) -> Row {
    Row {
        engine: measurement.engine,
        version,
        source,
        mu: measurement.stack.floor_friction,
        stiffness: measurement.stack.stiffness,
        kappa: measurement.stack.stiffness_ratio,
        pair_arm: measurement.convention.pair_arm,
        floor_arm: measurement.convention.floor_arm,
        yield_force: None,
        uncertainty: None,
        reference: "quasistatic".to_owned(),
        reference_force: measurement.limit.yield_force,
        error: None,
        tolerance: None,
        model_form: measurement.model_form,
        verdict: Verdict::Missing,
    }
}

fn judge_readings(measurement: &Measurement, readings: &[Reading], judgement: &mut Judgement) {
    let stack = &measurement.stack;
    let estimates: Vec<YieldEstimates> = readings.iter().map(|reading| reading.estimates).collect();
    let slip = extrapolate(&estimates, stack.stiffness, |run| run.slip);
    let peak = extrapolate(&estimates, stack.stiffness, |run| run.peak);
    (judgement.slip, judgement.peak) = (slip, peak);
    let (Some(slip), Some(peak), Some(reference)) = (slip, peak, measurement.limit.yield_force)
    else {
        judgement.row.verdict = Verdict::NoYield;
        judgement.notes.push(no_yield_note(readings));
        return;
    };
    let load = reference + 3.0;
    let uncertainty = slip.budget.total();
    let error = (slip.force - reference) / load;
    let row = &mut judgement.row;
    row.yield_force = Some(slip.force);
    row.uncertainty = Some(uncertainty);
    row.error = Some(error);
    row.tolerance = Some(tolerance(uncertainty / load));
    row.verdict = Verdict::judge(error, uncertainty / load);
    if let Some(note) = contradiction(&slip, &peak, measurement) {
        judgement.notes.push(note);
        if row.verdict == Verdict::Agrees {
            row.verdict = Verdict::Inconclusive;
        }
    }
}

/// The peak is grainy: it comes while the floor slips and sticks from step to step, so that it is off by
/// the load that some steps add.
const GRAINY_STEPS: f64 = 4.0;

/// Slip onset and peak have the same limit; here they are further apart than their uncertainties allow.
fn contradiction(
    slip: &Extrapolation,
    peak: &Extrapolation,
    measurement: &Measurement,
) -> Option<String> {
    let travel = measurement.limit.wall_travel?;
    let fastest = &measurement.cases.first()?.protocol;
    let load_per_step = (slip.force + 3.0) * fastest.wall_speed * fastest.time_step / travel;
    let allowed = slip.budget.total() + peak.budget.total() + GRAINY_STEPS * load_per_step;
    let distance = (peak.force - slip.force).abs();
    (distance > allowed).then(|| {
        format!(
            "slip onset gives {:.6}, the peak {:.6}: further apart than their uncertainty {:.1e}",
            slip.force, peak.force, allowed
        )
    })
}

fn no_yield_note(readings: &[Reading]) -> String {
    let last = readings.iter().map(|reading| reading.last_force);
    let highest = last.fold(0.0, f64::max);
    format!(
        "no slip followed by a peak within the planned wall travel; the wall force ends at {highest:.6}"
    )
}
