//! How long studies will take on this machine, from their open runs and what a step and a start of each code cost
//! here.

use super::stack::short_and_long;
use super::target::{BenchError, BenchTarget, InstalledTarget};
use crate::code::{Code, InstalledCode, RunContext};
use crate::runs::{CodeOutlook, Kind, Outlook, PlannedCall, SelectedCode, Settings, probe_address};

/// Intended duration of a measurement of the cost of a step, in seconds; it is met if the manifest is right.
const MEASURED_SECONDS: f64 = 1.0;
/// Fewest and most steps of a measurement.
const STEPS: [f64; 2] = [8e3, 4e5];
/// Steps of each of the many native runs of a measurement.
const NATIVE_STEPS: f64 = 1e5;

/// Where the cost of a step comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Measured on this machine, now.
    Measured,
    /// The forecast of the manifest.
    Manifest,
}

impl Basis {
    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Manifest => "manifest",
        }
    }
}

/// What a step and a start cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepCost {
    /// Wall time of a step of one run on one core, in seconds.
    pub step: f64,
    /// Wall time of start and end of a program, in seconds.
    pub start: f64,
    /// Where they come from.
    pub basis: Basis,
}

/// How long the runs of a code will take.
#[derive(Debug, Clone, PartialEq)]
pub struct CodeDuration {
    /// Its runs.
    pub runs: CodeOutlook,
    /// Whether it is installed here.
    pub is_installed: bool,
    /// Seconds that its open micro-tests took where they were recorded; absent if their results are in the store, or
    /// if they were never recorded.
    pub probe: Option<f64>,
    /// What a step costs; absent where there is nothing to do.
    pub cost: Option<StepCost>,
    /// Seconds of one core for runs and micro-tests together.
    pub core_seconds: f64,
}

/// Forecasts how long the open runs in `outlook` will take: of each code, and in total with the threads of
/// `settings`, in seconds.
///
/// # Errors
/// If a measurement cannot write its files, or is interrupted. If a run of a code fails, `tell` gets the error, and
/// the cost comes from the manifest.
pub fn durations(
    outlook: &Outlook,
    codes: &[SelectedCode],
    bodies: u8,
    (settings, context): (&Settings, &RunContext),
    mut tell: impl FnMut(&BenchError),
) -> Result<(Vec<CodeDuration>, f64), BenchError> {
    let mut rows = Vec::new();
    for (runs, selected) in outlook.codes.iter().zip(codes) {
        let cost = match runs.open {
            0 => None,
            _ => Some(step_cost(&selected.name, bodies, context, &mut tell)?),
        };
        let own = outlook.calls.iter().filter(|call| call.code == runs.code);
        let own = own.map(|call| cost.map_or(0.0, |cost| cost.seconds(call)));
        let code = selected.code.as_deref();
        let probe = code.and_then(|code| probe_seconds(code, settings));
        rows.push(CodeDuration {
            runs: runs.clone(),
            is_installed: code.is_some(),
            probe,
            cost,
            core_seconds: own.sum::<f64>() + probe.unwrap_or(0.0),
        });
    }
    let cost_of = |code: &Code| rows.iter().find(|row| row.runs.code == *code)?.cost;
    let seconds = outlook.seconds(settings.threads, |call| {
        cost_of(&call.code).map_or(0.0, |cost| cost.seconds(call))
    });
    // Micro-tests come first, each code on one thread.
    let probes: Vec<f64> = rows.iter().filter_map(|row| row.probe).collect();
    let longest = probes.iter().copied().fold(0.0, f64::max);
    let probes = (probes.iter().sum::<f64>() / settings.threads as f64).max(longest);
    Ok((rows, seconds + probes))
}

impl StepCost {
    /// Returns the duration of a `call`, in seconds.
    fn seconds(&self, call: &PlannedCall) -> f64 {
        self.start + self.step * call.steps.iter().sum::<u64>() as f64
    }

    fn of_manifest(code: &Code) -> Self {
        Self {
            step: code.seconds_per_step(),
            start: code.start_seconds(),
            basis: Basis::Manifest,
        }
    }
}

/// Returns how long the micro-tests of `code` took where they were recorded, unless their results are in the store.
fn probe_seconds(code: &dyn InstalledCode, settings: &Settings) -> Option<f64> {
    let address = probe_address(code);
    if !settings.fresh && settings.store.holds(Kind::Probe, &address) {
        return None;
    }
    let recorded = settings.recorded.probe(code.name()).ok()?;
    Some(recorded.provenance.seconds)
}

/// Measures the cost of a step of `code` in a second or two; takes that of the manifest where a run fails.
fn step_cost(
    code: &Code,
    bodies: u8,
    context: &RunContext,
    tell: &mut impl FnMut(&BenchError),
) -> Result<StepCost, BenchError> {
    match measured(code, bodies, context) {
        Ok(Some(cost)) => Ok(cost),
        Ok(None) => Ok(StepCost::of_manifest(code)),
        Err(error) if context.interrupt.requested() => Err(error),
        Err(error @ BenchError::Failed(_)) => {
            tell(&error);
            Ok(StepCost::of_manifest(code))
        }
        Err(error) => Err(error),
    }
}

/// Measures the cost of a step of `code`; `None` where steps are too fast to be told from the start.
fn measured(code: &Code, bodies: u8, context: &RunContext) -> Result<Option<StepCost>, BenchError> {
    let target = match code.is_native() {
        true => BenchTarget::NativeLanes,
        false => BenchTarget::External(code.clone()),
    };
    // Keys that the manifest leaves out do not change the duration of a step.
    let target = InstalledTarget::find(target, &code.unmeasured(""))?;
    let [fewest, most] = STEPS;
    let steps = match code.is_native() {
        true => NATIVE_STEPS,
        false => (MEASURED_SECONDS / code.seconds_per_step()).clamp(fewest, most),
    };
    let [(few, short), (many, long)] = short_and_long(&target, bodies, steps as u64, context)?;
    let step = (long - short) / (many - few) as f64;
    Ok((step > 0.0).then(|| StepCost {
        step,
        start: (short - step * few as f64).max(0.0),
        basis: Basis::Measured,
    }))
}
