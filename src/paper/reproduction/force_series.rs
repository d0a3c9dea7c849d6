//! Supplement, figure on the yield force: f(t) at μ = 0.2, 1/ε = 100, at the paper's literal settings.

use crate::code::{Code, Identity, Run};
use crate::model::{Case, ContactConvention, Stack};
use crate::runs::{Reading, RunError, RunSummary, Workload};
use crate::study::Campaign;
use crate::study::yield_force::{PAPER_TIME_STEP, PAPER_WALL_SPEED, protocol_at_speed};
use crate::theory::quasistatic_limit;
use serde::Serialize;

/// The wall force of one native run, from rest into collapse.
#[derive(Debug, Clone, PartialEq, Serialize)]
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

/// The stack of the paper's figure.
fn force_series_stack() -> Stack {
    Stack::paper(0.2, 100.0)
}

/// The rows of the wall force, and the summary of their run.
#[derive(Clone)]
struct ForceRows {
    rows: Vec<(f64, f64)>,
    summary: RunSummary,
}

impl Reading for ForceRows {
    fn of_run(run: Run) -> Self {
        let stiffness = run.case.stack.stiffness;
        let samples = run.series.samples().iter();
        let rows = samples.map(|row| (row.time, row.wall_force * stiffness));
        Self {
            rows: rows.collect(),
            summary: RunSummary::new(run),
        }
    }

    /// `None`, because a summary has no rows.
    fn of_summary(_: RunSummary) -> Option<Self> {
        None
    }

    fn identity(&self) -> &Identity {
        self.summary.identity()
    }
}

/// Runs the native DEM at the paper's settings; also returns the summary.
///
/// # Errors
/// If the run fails.
pub fn force_series(campaign: &Campaign) -> Result<(ForceSeries, RunSummary), RunError> {
    let stack = force_series_stack();
    let limit = quasistatic_limit(&stack, &ContactConvention::PAPER);
    let protocol = protocol_at_speed(&limit, PAPER_WALL_SPEED, PAPER_TIME_STEP);
    let cases = protocol.map(|protocol| Case {
        stack,
        convention: Code::NATIVE.convention(),
        protocol,
    });
    let workload = Workload {
        code: Code::NATIVE,
        cases: cases.into_iter().collect(),
    };
    let results = campaign.read(&[workload]);
    let first = results.into_iter().flatten().next();
    let ForceRows { rows, summary } = first.expect("a stack that yields is planned")?;
    let series = ForceSeries {
        rows,
        slip_force: summary.estimates.slip.map(|slip| slip.force),
        peak_force: summary.estimates.peak.map(|peak| peak.force),
        limit: limit.yield_force,
        wall_speed: PAPER_WALL_SPEED,
        time_step: PAPER_TIME_STEP,
    };
    Ok((series, summary))
}
