//! Measurements in, judged rows out.

use super::extrapolate::{ConvergenceOrder, Extrapolation, extrapolate};
use super::plan::{Measurement, Method};
use super::row::Row;
use super::runs::{MIDDLE_RUN, SHORT_RAMP_RUN};
use crate::model::Case;
use crate::runs::RunSummary;
use crate::runs::read_all;
use crate::runs::{Progress, RunError, SelectedCode, Settings};
use crate::series::YieldEstimates;
use crate::study::Verdict;
use crate::study::convention::{
    ProbeError, Probed, arms_are_measured, contradictions, is_contradicted, other_program,
    probe_all,
};
use crate::study::{MAX_TOLERANCE, Source, judge, tolerance};

/// A row, and what stands behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The row.
    pub row: Row,
    /// What was read off each run, in the order of the cases.
    pub runs: Vec<RunSummary>,
    /// Slip onset and peak at vanishing wall speed.
    pub slip: Option<Extrapolation>,
    /// See `slip`.
    pub peak: Option<Extrapolation>,
    /// What explains a verdict other than `agrees`.
    pub notes: Vec<String>,
    /// Whether the code is not judged because its probe contradicts its declaration.
    pub contradicted: bool,
    /// Whether the probe has measured the torque arms, and they are as declared.
    pub arms_are_measured: bool,
}

fn is_interrupted<T>(result: &Result<T, RunError>) -> bool {
    matches!(result, Err(RunError::Failed(failure)) if failure.is_interrupted())
}

/// Carries out `measurements` and judges each by its own limit. The order is kept; those that an interrupt
/// has cut short are left out.
pub fn measure(
    measurements: &[Measurement],
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Judgement> {
    let probed = probe_all(codes, settings, progress);
    let results = read_all(measurements, codes, settings, progress);
    let judged = measurements.iter().zip(results);
    let judged = judged.filter_map(|(measurement, results)| {
        let mut own = codes.iter().zip(&probed);
        let own = own.find(|(who, _)| who.name == measurement.code);
        let probe = own.and_then(|(_, probed)| probed.as_ref().err());
        if results.iter().any(is_interrupted) || probe.is_some_and(ProbeError::is_interrupted) {
            return None;
        }
        let code = own.and_then(|(who, _)| who.code.as_deref());
        let source = if code.is_some() {
            Source::Live
        } else {
            Source::Recorded
        };
        let version = code.map_or_else(String::new, |code| code.identity().version.clone());
        let judgement = judge_measurement(measurement, source, version, results);
        Some(match own {
            Some((_, probed)) => judgement.unless_contradicted(probed),
            None => judgement,
        })
    });
    judged.collect()
}

fn judge_measurement(
    measurement: &Measurement,
    source: Source,
    version: String,
    results: Vec<Result<RunSummary, RunError>>,
) -> Judgement {
    let mut judgement = Judgement {
        row: blank_row(measurement, source, version),
        runs: Vec::new(),
        slip: None,
        peak: None,
        notes: Vec::new(),
        contradicted: false,
        arms_are_measured: false,
    };
    if measurement.cases.is_empty() {
        judgement.row.verdict = Verdict::NoYield;
        judgement.notes.extend(measurement.limit.reason.clone());
        return judgement;
    }
    let mut summaries: Vec<RunSummary> = Vec::new();
    for result in results {
        match result {
            Ok(summary) => summaries.push(summary),
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
    let mut versions: Vec<&str> = summaries
        .iter()
        .map(|summary| summary.provenance.identity.version.as_str())
        .collect();
    versions.dedup();
    if !versions.is_empty() {
        judgement.row.version = versions.join(", ");
    }
    if summaries.len() == measurement.cases.len() {
        judge_readings(measurement, summaries, &mut judgement);
    }
    judgement
}

fn blank_row(measurement: &Measurement, source: Source, version: String) -> Row {
    Row {
        code: measurement.code,
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

fn judge_readings(
    measurement: &Measurement,
    summaries: Vec<RunSummary>,
    judgement: &mut Judgement,
) {
    judgement.runs = summaries;
    let Some(reference) = measurement.limit.yield_force else {
        return;
    };
    match measurement.method {
        Method::Extrapolated => judgement.extrapolate(measurement, reference),
        Method::Literal => judgement.take_literally(measurement, reference),
    }
}

impl Judgement {
    /// Whether recorded runs stand behind the row.
    pub fn is_recorded(&self) -> bool {
        self.row.source == Source::Recorded && self.row.verdict != Verdict::Missing
    }

    fn estimates(&self) -> Vec<YieldEstimates> {
        self.runs.iter().map(|run| run.estimates).collect()
    }

    /// The yield force at vanishing wall speed, by slip onset, which the peak must not contradict.
    fn extrapolate(&mut self, measurement: &Measurement, reference: f64) {
        let stiffness = measurement.stack.stiffness;
        let estimates = self.estimates();
        let steps: Vec<u64> = measurement.cases.iter().map(Case::total_steps).collect();
        self.slip = extrapolate(&estimates, &steps, stiffness, |run| run.slip);
        self.peak = extrapolate(&estimates, &steps, stiffness, |run| run.peak);
        let (Some(peak), Some(allowance)) = (self.peak, peak_allowance(measurement, reference))
        else {
            return self.without_yield();
        };
        let peak_uncertainty = peak.budget.total() + allowance;
        let Some(slip) = self.slip else {
            self.decide(peak.force, peak_uncertainty, reference);
            self.doubt("no onset of slip was found before the peak; judged by the peak".to_owned());
            return self.doubt_deep_wall(measurement, reference);
        };
        let uncertainty = slip.budget.total();
        self.decide(slip.force, uncertainty, reference);
        if let Some(note) = friction_note(measurement, &estimates) {
            self.doubt(note);
        }
        if estimates[MIDDLE_RUN] == estimates[SHORT_RAMP_RUN] {
            self.doubt(
                "two runs that differ in their preparation gave the same bits: a series is that of another case, or \
                 the code takes no notice of the preparation"
                    .to_owned(),
            );
        }
        if !measurement.is_gentle {
            self.doubt_rough_touch();
        }
        if !slip.order.is_expected() {
            self.doubt(format!(
                "the slip onset converges with order {:.2} in the wall speed, not {}",
                slip.order.observed.unwrap_or(f64::NAN),
                ConvergenceOrder::EXPECTED
            ));
        }
        if (peak.force - slip.force).abs() > uncertainty + peak_uncertainty {
            self.doubt(format!(
                "slip onset gives {:.6}, the peak {:.6}: further apart than their uncertainties {:.1e}",
                slip.force,
                peak.force,
                uncertainty + peak_uncertainty
            ));
        }
    }

    /// The yield force as the paper reads it: the peak at one wall speed. What the speed costs is seen in a
    /// second run.
    fn take_literally(&mut self, measurement: &Measurement, reference: f64) {
        let estimates = self.estimates();
        let peaks: Option<Vec<_>> = estimates.iter().map(|run| run.peak).collect();
        let Some([slow, fast]) = peaks.as_deref() else {
            return self.without_yield();
        };
        let Some(allowance) = peak_allowance(measurement, reference) else {
            return self.without_yield();
        };
        let change = (fast.force - slow.force).abs();
        let uncertainty = TWO_GRIDS * change + slow.sampling + allowance;
        self.decide(slow.force, uncertainty, reference);
        if let Some(note) = friction_note(measurement, &estimates) {
            self.doubt(note);
        }
        if self.row.verdict == Verdict::Inconclusive {
            let excess = (slow.force - reference) / reference;
            self.notes.push(format!(
                "under-resolved: at the paper's wall speed and time step the peak is {excess:+.1e} of the \
                 limit away from it, and changes by {:.1e} of it when the wall is twice as fast",
                change / reference
            ));
        }
    }

    fn without_yield(&mut self) {
        self.row.verdict = Verdict::NoYield;
        self.notes.push(no_yield_note(&self.runs));
    }

    /// Enters a yield force and what follows from it.
    fn decide(&mut self, force: f64, uncertainty: f64, reference: f64) {
        let load = reference + 3.0;
        let error = (force - reference) / load;
        self.row.yield_force = Some(force);
        self.row.uncertainty = Some(uncertainty);
        self.row.error = Some(error);
        self.row.tolerance = Some(tolerance(uncertainty / load));
        self.row.verdict = judge(error, uncertainty / load);
    }

    /// Takes the judgement back where the limit belongs to a convention that the code does not have, or is
    /// not known to have.
    fn unless_contradicted(mut self, probed: &Probed) -> Self {
        self.arms_are_measured = arms_are_measured(probed);
        let mut contradictions = contradictions(probed);
        let runs = self.runs.iter().map(|run| &run.provenance.identity);
        contradictions.extend(other_program(probed, runs));
        // A stack that does not yield in theory has not been run, and a failed run is no judgement.
        let judged = match self.row.verdict {
            Verdict::Agrees | Verdict::Differs | Verdict::Inconclusive => true,
            Verdict::NoYield => !self.runs.is_empty(),
            Verdict::Failed | Verdict::Missing => false,
        };
        let Some(first) = contradictions.first().filter(|_| judged) else {
            return self;
        };
        let further = match contradictions.len() {
            1 => String::new(),
            count => format!(" (and {} more: tristack probe)", count - 1),
        };
        self.notes.push(format!("not judged: {first}{further}"));
        self.contradicted = is_contradicted(probed);
        self.row.error = None;
        self.row.tolerance = None;
        self.row.verdict = Verdict::Inconclusive;
        self
    }

    /// A code that lets a wall go once it has passed the centre of a cylinder cannot follow a wall force above
    /// k_n r; its series has no onset then, and says nothing about the yield.
    fn doubt_deep_wall(&mut self, measurement: &Measurement, reference: f64) {
        if reference < measurement.stack.stiffness {
            return;
        }
        let depth = reference * measurement.stack.epsilon();
        self.notes.push(format!(
            "at the yield the wall is {depth:.2} r deep in cylinder 1, beyond its centre, where codes let go"
        ));
        self.row.verdict = Verdict::Inconclusive;
    }

    /// A floor that slides at the first touch moves the yield force by some 1e-6 at the speeds of such plans,
    /// which must not count as a disagreement; more than the bar still does.
    fn doubt_rough_touch(&mut self) {
        let small = self
            .row
            .error
            .is_some_and(|error| error.abs() <= MAX_TOLERANCE);
        if self.row.verdict == Verdict::Differs && small {
            self.row.verdict = Verdict::Inconclusive;
        }
        self.doubt(ROUGH_TOUCH.to_owned());
    }

    /// Notes what speaks against an agreement.
    fn doubt(&mut self, note: String) {
        self.notes.push(note);
        if self.row.verdict == Verdict::Agrees {
            self.row.verdict = Verdict::Inconclusive;
        }
    }
}

/// Why nothing is decided where the planned walls are too fast.
const ROUGH_TOUCH: &str = "the wall touches the stack so fast that the floor slides for a moment, and a gentle \
                           wall would take more than 3e6 steps";

/// Safety factor of the grid convergence index where two runs do not show the order of convergence (ASME
/// V&V 20, section 2-4.1; P. J. Roache, J. Fluids Eng. 116, 405 (1994)).
const TWO_GRIDS: f64 = 3.0;

/// A friction measured this close, relatively, to the one asked for is the same: codes cap the force at
/// μ n itself, some through tan(atan μ), so that only roundings of 1e-16 are between them.
const SAME_FRICTION: f64 = 1e-9;

fn friction_note(measurement: &Measurement, estimates: &[YieldEstimates]) -> Option<String> {
    let asked = measurement.stack.floor_friction;
    let measured = estimates.iter().filter_map(|run| run.sliding_friction);
    let other = measured
        .into_iter()
        .find(|friction| (friction / asked - 1.0).abs() > SAME_FRICTION)?;
    Some(format!(
        "the floor slides at |t|/n = {other}, not at mu = {asked}"
    ))
}

/// The peak is grainy: it comes while the floor slips and sticks from step to step, which may hide up to
/// two steps of load in each run. The extrapolation adds them up with the weights 1/3, 2 and 8/3 at speeds
/// of 1, 1/2 and 1/4 of the fastest: four steps at the fastest speed.
const GRAINY_STEPS: f64 = 4.0;

/// Uncertainty of the extrapolated peak of `measurement` beyond its budget, in m g, the peak being near
/// `reference`; `None` where nothing is planned.
pub fn peak_allowance(measurement: &Measurement, reference: f64) -> Option<f64> {
    let travel = measurement.limit.wall_travel?;
    let fastest = &measurement.cases.first()?.protocol;
    let load_per_step = (reference + 3.0) * fastest.wall_speed * fastest.time_step / travel;
    Some(GRAINY_STEPS * load_per_step)
}

fn no_yield_note(summaries: &[RunSummary]) -> String {
    let last = summaries.iter().map(|summary| summary.last_force);
    let highest = last.fold(0.0, f64::max);
    format!(
        "no slip followed by a peak within the planned wall travel; the wall force ends at {highest:.6}"
    )
}
