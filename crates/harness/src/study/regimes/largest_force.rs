//! The largest force that a stack bears: the runs that measure it, and the comparison with theory.

use super::loading::loading;
use crate::code::{Code, SettledCode};
use crate::dem::{EventRun, Loading, Observation, Until};
use crate::model::{ContactConvention, HistoryUpdate, Stack};
use crate::runs::Workload;
use crate::series::{Estimate, YieldEstimates};
use crate::study::yield_force::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN, SPEEDS};
use crate::study::yield_force::{Extrapolation, extrapolate};
use crate::study::{Evaluation, Grounds, Judged, MAX_TOLERANCE, Study, Verdict};
use crate::theory::{FailureMode, LoadingOutcome};

/// Travel of the wall in units of the predicted travel to the end of the path: far enough beyond it for a force with a
/// peak to have fallen.
const FURTHER: f64 = 1.1;

/// Factor by which the runs are slower than those of the crosscheck, which need not resolve the peak.
const SLOWER: f64 = 8.0;

/// Number of runs of one stack.
const RUNS: usize = SHORT_RAMP_RUN + 1;

/// The largest force of a stack, in theory and in the DEM.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Examination {
    /// The stack.
    pub stack: Stack,
    /// What theory predicts.
    pub claimed: LoadingOutcome,
    /// The peak of the wall force at vanishing speed; `None` where the stack falls or the force has no peak.
    pub peak: Option<Extrapolation>,
    /// The uncertainty of the peak, in m g.
    pub uncertainty: Option<f64>,
    /// (peak − theory)/(F + 3), where both have a peak.
    pub error: Option<f64>,
    /// Whether the stack stands and the peak is as claimed, or absent as claimed.
    pub verdict: Verdict,
}

/// The runs of one stack, as the crosscheck has them: three speeds, a coarse time step, a short ramp.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PeakPlan {
    stack: Stack,
    claimed: LoadingOutcome,
    /// In the order that [`extrapolate`] expects.
    runs: Vec<EventRun>,
}

impl PeakPlan {
    /// Plans the runs of `stack`; `None` if theory makes no prediction.
    pub(super) fn new(stack: &Stack, history_update: HistoryUpdate) -> Option<Self> {
        let claimed = LoadingOutcome::of(stack, history_update)?;
        if !claimed.is_end_known {
            return None;
        }
        let run = |loading| EventRun {
            stack: *stack,
            history_update,
            loading,
            until: Until::EndOfTravel,
        };
        Some(Self {
            stack: *stack,
            claimed,
            runs: loadings(stack, &claimed).into_iter().map(run).collect(),
        })
    }
}

/// The peak of the wall force of a stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PeakFinding {
    peak: Option<Extrapolation>,
    uncertainty: Option<f64>,
    error: Option<f64>,
}

impl Study for PeakPlan {
    type Reading = Observation;
    type Finding = PeakFinding;

    fn code(&self) -> SettledCode {
        SettledCode::native()
    }

    fn workloads(&self) -> Vec<Workload<EventRun>> {
        vec![Workload {
            code: Code::native(),
            tasks: self.runs.clone(),
        }]
    }

    /// Compares the peaks of the runs with theory.
    fn evaluate(&self, runs: Vec<Vec<Observation>>) -> Evaluation<PeakFinding> {
        let observations = runs.concat();
        let estimates: Vec<YieldEstimates> = observations.iter().map(estimates).collect();
        let steps: Vec<u64> = observations.iter().map(|run| run.steps).collect();
        let peak = extrapolate(&estimates, &steps, self.stack.stiffness, |run| run.peak);
        let slowest = observations[SPEEDS.len() - 1].peak_force;
        let uncertainty = peak.map(|peak| peak.budget.total() + peak.wrong_order(slowest));
        let both = peak.zip(self.claimed.largest_force);
        let error = both.map(|(peak, force)| (peak.force - force) / (force + 3.0));
        let falls = self.claimed.failure_mode == FailureMode::Collapses;
        let as_claimed = observations.iter().all(|run| run.stands != falls);
        let mut grounds = Grounds::new();
        grounds.hold(as_claimed, "the stack falls, or stands, against the claim");
        match (error, uncertainty, self.claimed.largest_force) {
            // Contacts that open and slide on the way make the approach to the peak irregular: the uncertainty is
            // too large to be a tolerance.
            (Some(error), Some(uncertainty), Some(force)) => {
                grounds.compare(error, uncertainty / (force + 3.0), MAX_TOLERANCE, None);
            }
            (error, uncertainty, force) => grounds.hold(
                error.or(uncertainty).or(force).is_none(),
                "a peak is there or absent against the claim",
            ),
        }
        let finding = PeakFinding {
            peak,
            uncertainty,
            error,
        };
        Evaluation { finding, grounds }
    }
}

impl Examination {
    pub(super) fn new(judged: &Judged<PeakPlan, PeakFinding>) -> Self {
        let found = judged.finding;
        Self {
            stack: judged.study.stack,
            claimed: judged.study.claimed,
            peak: found.and_then(|found| found.peak),
            uncertainty: found.and_then(|found| found.uncertainty),
            error: found.and_then(|found| found.error),
            verdict: judged.verdict(),
        }
    }
}

fn loadings(stack: &Stack, claimed: &LoadingOutcome) -> [Loading; RUNS] {
    let end = claimed.end.unwrap_or(claimed.last);
    let at_speed = |speed: f64| loading(stack, &end, speed / SLOWER, FURTHER);
    let middle = at_speed(SPEEDS[MIDDLE_RUN]);
    std::array::from_fn(|run| match run {
        COARSE_TIME_STEP_RUN => Loading {
            time_step: (2.0 * middle.time_step)
                .min(stack.longest_time_step(&ContactConvention::TURNING)),
            ..middle
        },
        SHORT_RAMP_RUN => Loading {
            gravity_rate: 2.0 * middle.gravity_rate,
            ..middle
        },
        speed => at_speed(SPEEDS[speed]),
    })
}

/// Returns the peak of one run; none where the force has not fallen after its maximum.
fn estimates(observation: &Observation) -> YieldEstimates {
    YieldEstimates {
        slip: None,
        peak: observation.peaked.then_some(Estimate {
            force: observation.peak_force,
            // Every step is observed, and the force is flat at its maximum.
            sampling: 0.0,
            sensitivity: 1.0,
        }),
        sliding_friction: None,
        departure: None,
        pair_friction: None,
        printed: None,
        position_drift: None,
    }
}
