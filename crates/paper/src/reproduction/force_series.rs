//! Supplement, figure on the yield force: f(t) at μ = 0.2, 1/ε = 100, at the paper's literal settings.

use super::case_at_speed;
use crate::code::{Code, Identity, Run, SettledCode};
use crate::model::{Case, ContactConvention, Problem, Stack};
use crate::runs::{Reading, RunError, RunSummary, Workload};
use crate::study::Campaign;
use crate::study::yield_force::{PAPER_TIME_STEP, PAPER_WALL_SPEED};
use crate::theory::quasistatic_limit;

/// The wall force of one native run, from rest into collapse.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceSeries {
    /// Time in √(m/k_n), and F in m g.
    pub rows: Vec<(f64, f64)>,
    /// F at the onset of slip.
    pub slip_force: Option<f64>,
    /// Largest F.
    pub peak_force: Option<f64>,
    /// Exact quasi-static limit.
    pub limit: Option<f64>,
    /// Wall speed in r √(k_n/m).
    pub wall_speed: f64,
    /// Time step in √(m/k_n).
    pub time_step: f64,
}

/// The rows of the wall force, and the summary of their run.
#[derive(Clone)]
struct ForceRows {
    rows: Vec<(f64, f64)>,
    summary: RunSummary,
}

impl Reading for ForceRows {
    type Task = Case;

    fn of(run: Run) -> Self {
        let stiffness = run.case.stack.stiffness;
        let samples = run.series.samples().iter();
        let rows = samples.map(|row| (row.time, row.wall_force * stiffness));
        Self {
            rows: rows.collect(),
            summary: RunSummary::new(run),
        }
    }

    fn identity(&self) -> &Identity {
        self.summary.identity()
    }
}

/// Returns the stack of the paper's figure on f(t).
pub fn force_series_stack() -> Stack {
    Stack::paper(0.2, 100.0)
}

/// Runs the native DEM at the paper's settings; also returns the summary.
///
/// # Errors
/// If the run fails.
pub fn force_series(campaign: &Campaign) -> Result<(ForceSeries, RunSummary), RunError> {
    let stack = force_series_stack();
    let case = case_at_speed(
        &SettledCode::native(),
        stack,
        PAPER_WALL_SPEED,
        PAPER_TIME_STEP,
    );
    let workload = Workload {
        code: Code::native(),
        tasks: case.into_iter().collect(),
    };
    let results = campaign.read(&[workload]);
    let first = results.into_iter().flatten().next();
    let ForceRows { rows, summary } = first.expect("a stack that yields is planned")?;
    let problem = Problem::new(stack, ContactConvention::PAPER).ok();
    let series = ForceSeries {
        rows,
        slip_force: summary.estimates.slip.map(|slip| slip.force),
        peak_force: summary.estimates.peak.map(|peak| peak.force),
        limit: problem.and_then(|own| quasistatic_limit(&own).yield_force),
        wall_speed: PAPER_WALL_SPEED,
        time_step: PAPER_TIME_STEP,
    };
    Ok((series, summary))
}
