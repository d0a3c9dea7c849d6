//! Measures round-off: repeats runs with a build of the code that computes with more digits.

use super::extrapolate::Estimator;
use super::plan::Measurement;
use crate::runs::{Progress, RunError, RunSummary, SelectedCode, Settings, read_all};
use crate::series::YieldEstimates;
use crate::study::Study;

/// A yield force computed with more digits.
#[derive(Debug, Clone, PartialEq)]
pub struct TwinForce {
    /// Version of the twin.
    pub version: String,
    /// F by slip onset at vanishing wall speed.
    pub force: f64,
}

/// Repeats `measurement` with the twin of its code; `None` if there is no such twin here.
pub fn measure_with_twin(
    measurement: &Measurement,
    settings: &Settings,
    progress: &dyn Progress,
) -> Option<Result<TwinForce, RunError>> {
    let code = measurement.code.name().find_precise()?;
    let version = code.identity().version.clone();
    let package = code.identity().package.clone();
    let twin = SelectedCode {
        name: measurement.code.name().clone(),
        code: Some(code),
    };
    let results = read_all(&measurement.workloads(), &[twin], settings, progress);
    let runs = results.into_iter().flatten();
    let estimates = runs.map(|run| run.map(|run: RunSummary| run.estimates));
    let estimates: Vec<YieldEstimates> = match estimates.collect::<Result<_, RunError>>() {
        Ok(estimates) => estimates,
        Err(error) => return Some(Err(error)),
    };
    let slip = measurement.extrapolate(&estimates, Estimator::SlipOnset)?;
    let version = package.map_or(version, |package| format!("long double, {package}"));
    Some(Ok(TwinForce {
        version,
        force: slip.force,
    }))
}
