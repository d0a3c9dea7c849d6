//! What the events do, by the largest force that a stack bears in the native DEM.

use super::{THREE_DIGITS, loading};
use crate::code::Interrupt;
use crate::dem::{Loading, Observation, Until, watch_stack};
use crate::model::{PAPER_STIFFNESS_RATIO, Stack};
use crate::series::{Estimate, YieldEstimates};
use crate::study::MAX_TOLERANCE;
use crate::study::Verdict;
use crate::study::yield_force::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN, SPEEDS};
use crate::study::yield_force::{ConvergenceOrder, Extrapolation, extrapolate};
use crate::theory::{FailureMode, LoadingOutcome, released_frictions};

/// How far the wall goes beyond the predicted end of the path, in units of the predicted travel: far enough
/// for a force that is going to fall to have fallen.
const FURTHER: f64 = 1.1;

/// How much slower the runs are than the crosscheck's, which need not resolve the peak.
const SLOWER: f64 = 8.0;

/// The largest force of a stack, in theory and in the DEM.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Examination {
    /// The stack.
    pub stack: Stack,
    /// What theory says of it.
    pub claimed: LoadingOutcome,
    /// The peak of the wall force at vanishing speed; `None` where the stack falls or the force has no peak.
    pub peak: Option<Extrapolation>,
    /// The uncertainty of the peak, in m g.
    pub uncertainty: Option<f64>,
    /// (peak − theory)/(F + 3), where both have one.
    pub error: Option<f64>,
    /// Whether the stack stands and the peak is what was claimed, or absent as claimed.
    pub verdict: Verdict,
}

/// Stacks whose first event does each of the things that an event can do.
pub fn examined_stacks() -> Vec<Stack> {
    let mut stacks = vec![
        stack(0.3, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        // Saturated: the same force whatever the floor is like.
        stack(0.45, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.9, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.45, 0.3, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.5, 1e3, PAPER_STIFFNESS_RATIO),
        // Contact 2–3 closed: the same force whatever kappa is.
        stack(0.12, 0.7, 1e2, 0.3),
        stack(0.2, 0.7, 1e2, 0.3),
        stack(0.3, 0.7, 1e2, 0.3),
        stack(0.3, 0.7, 1e2, 0.6),
        stack(0.3, 0.7, 1e2, 1.0),
        stack(0.2, 0.7, 1e3, 0.6),
        // The same, but the cylinders slip.
        stack(0.6, 0.32, 1e2, 0.3),
        stack(0.6, 0.32, 1e2, 0.6),
        // Beyond wall contact.
        stack(0.6, 0.7, 1e1, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.9, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        // Past the maximum of the load.
        stack(0.78, 1.0, 1e2, 10.0),
    ];
    for stiffness_ratio in [0.3, 0.6, 0.9] {
        stacks.extend(beside_released_frictions(stiffness_ratio));
    }
    stacks
}

fn stack(
    floor_friction: f64,
    cylinder_friction: f64,
    stiffness: f64,
    stiffness_ratio: f64,
) -> Stack {
    Stack {
        floor_friction,
        cylinder_friction,
        stiffness,
        stiffness_ratio,
    }
}

/// Both neighbours of both frictions between which a stack has a yield force that slips while c > 0.
fn beside_released_frictions(stiffness_ratio: f64) -> Vec<Stack> {
    let base = stack(0.3, 0.7, 1e2, stiffness_ratio);
    let frictions = released_frictions(&base).map_or(Vec::new(), |(low, high)| vec![low, high]);
    let neighbours = frictions
        .into_iter()
        .flat_map(|friction| [1.0 - THREE_DIGITS, 1.0 + THREE_DIGITS].map(|side| side * friction));
    neighbours
        .map(|floor_friction| Stack {
            floor_friction,
            ..base
        })
        .collect()
}

/// Runs `stack` as the crosscheck runs its own (three speeds, a coarse time step, a quick preparation) and
/// holds its peak against theory. `None` if theory has nothing to say of it.
pub fn examine(stack: &Stack, interrupt: &Interrupt) -> Option<Examination> {
    let claimed = LoadingOutcome::of(stack)?;
    let observations = observe(stack, &claimed, interrupt);
    let complete = observations.iter().all(|observation| observation.complete);
    let estimates: Vec<YieldEstimates> = observations.iter().map(estimates).collect();
    let steps: Vec<u64> = observations.iter().map(|run| run.steps).collect();
    let peak = extrapolate(&estimates, &steps, stack.stiffness, |run| run.peak);
    let slowest = observations[SPEEDS.len() - 1].peak_force;
    let uncertainty = peak.map(|peak| peak.budget.total() + wrong_order(&peak, slowest));
    let force = claimed.largest_force;
    let both = peak.zip(force);
    let error = both.map(|(peak, force)| (peak.force - force) / (force + 3.0));
    let falls = claimed.failure_mode == FailureMode::Collapses;
    let as_claimed = observations.iter().all(|run| run.stands != falls);
    let verdict = match (error, uncertainty, force) {
        _ if !complete => Verdict::Inconclusive,
        _ if !as_claimed => Verdict::Differs,
        // The peak is approached too irregularly, as contacts open and slide on the way, for its
        // uncertainty to be a tolerance.
        (Some(error), Some(uncertainty), Some(force)) => {
            Verdict::of(error, uncertainty / (force + 3.0), MAX_TOLERANCE)
        }
        (None, None, None) => Verdict::Agrees,
        _ => Verdict::Differs,
    };
    Some(Examination {
        stack: *stack,
        claimed,
        peak,
        uncertainty,
        error,
        verdict,
    })
}

/// What an approach that is not quite of first order in the speed leaves: the excess of the slowest run over
/// the limit, times the deviation of the observed order from 1. Contact 2–3 opens over some time, and that
/// makes the approach less regular than that of a yield with c = 0.
fn wrong_order(peak: &Extrapolation, slowest: f64) -> f64 {
    let order = peak.order.observed.unwrap_or(ConvergenceOrder::EXPECTED);
    (slowest - peak.force).abs() * (order - ConvergenceOrder::EXPECTED).abs()
}

/// The runs, in the order that [`extrapolate`] expects.
fn observe(stack: &Stack, claimed: &LoadingOutcome, interrupt: &Interrupt) -> Vec<Observation> {
    let end = claimed.end.unwrap_or(claimed.last);
    let at_speed = |speed: f64| loading(stack, &end, speed / SLOWER, FURTHER);
    let mut loadings: Vec<Loading> = SPEEDS.into_iter().map(at_speed).collect();
    let middle = loadings[MIDDLE_RUN];
    debug_assert_eq!(COARSE_TIME_STEP_RUN, loadings.len());
    loadings.push(Loading {
        time_step: (2.0 * middle.time_step).min(stack.longest_time_step()),
        ..middle
    });
    debug_assert_eq!(SHORT_RAMP_RUN, loadings.len());
    loadings.push(Loading {
        gravity_rate: 2.0 * middle.gravity_rate,
        ..middle
    });
    let wanted = || !interrupt.requested();
    let runs = loadings.iter();
    runs.map(|loading| watch_stack(stack, loading, Until::EndOfTravel, wanted))
        .collect()
}

/// The peak of one run; none where the force is largest at the very end.
fn estimates(observation: &Observation) -> YieldEstimates {
    YieldEstimates {
        slip: None,
        peak: observation.peaked.then_some(Estimate {
            force: observation.peak_force,
            // Every step is looked at, and the force is flat where it is largest.
            sampling: 0.0,
            sensitivity: 1.0,
        }),
        sliding_friction: None,
    }
}
