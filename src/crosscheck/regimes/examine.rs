//! What the events do, by the largest force that a stack bears in the native DEM.

use super::super::extrapolate::{Extrapolation, extrapolate};
use super::super::plan::{COARSE_TIME_STEP_RUN, MIDDLE_RUN, SHORT_RAMP_RUN, SPEEDS};
use super::super::verdict::Verdict;
use super::loading;
use crate::dem::{Loading, Observation, Until, watch_stack};
use crate::engine::Interrupt;
use crate::stack::Stack;
use crate::theory::Outcome;
use crate::trace::{Estimate, YieldEstimates};

/// How far the wall goes beyond the predicted end of the path, in units of the predicted travel: far enough
/// for a force that is going to fall to have fallen.
const FURTHER: f64 = 1.1;

/// The largest force of a stack, in theory and in the DEM.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Examination {
    /// The stack.
    pub stack: Stack,
    /// What theory says of it.
    pub claimed: Outcome,
    /// The peak of the wall force at vanishing speed; `None` where the force has no peak.
    pub peak: Option<Extrapolation>,
    /// (peak − theory)/(F + 3), where both have one.
    pub error: Option<f64>,
    /// Whether the peak is what was claimed, or absent as claimed.
    pub verdict: Verdict,
}

/// Stacks whose first event does each of the things that an event can do: at three floor frictions in a row
/// that saturate, with contact 2–3 closed, beyond wall contact, and past the maximum of the load.
pub fn examined_stacks() -> Vec<Stack> {
    let paper = Stack::paper;
    let slippery = |mu, stiffness, cylinder_friction| Stack {
        cylinder_friction,
        ..paper(mu, stiffness)
    };
    let stiff_shear = |mu, stiffness, stiffness_ratio| Stack {
        stiffness_ratio,
        ..paper(mu, stiffness)
    };
    vec![
        paper(0.3, 1e2),
        slippery(0.45, 1e2, 0.4),
        slippery(0.6, 1e2, 0.4),
        slippery(0.9, 1e2, 0.4),
        slippery(0.45, 1e2, 0.3),
        slippery(0.6, 1e3, 0.5),
        stiff_shear(0.2, 1e2, 0.3),
        stiff_shear(0.4, 1e2, 0.3),
        stiff_shear(0.3, 1e2, 0.6),
        stiff_shear(0.2, 1e3, 0.6),
        stiff_shear(0.3, 1e2, 1.0),
        paper(0.6, 1e1),
        paper(0.6, 1e2),
        paper(0.9, 1e2),
        Stack {
            cylinder_friction: 1.0,
            ..stiff_shear(0.78, 1e2, 10.0)
        },
    ]
}

/// Runs `stack` as the crosscheck runs its own (three speeds, a coarse time step, a quick preparation) and
/// holds its peak against theory. `None` if theory has nothing to say of it.
pub fn examine(stack: &Stack, interrupt: &Interrupt) -> Option<Examination> {
    let claimed = Outcome::of(stack)?;
    let observations = observe(stack, &claimed, interrupt);
    let complete = observations.iter().all(|observation| observation.complete);
    let estimates: Vec<YieldEstimates> = observations.iter().map(estimates).collect();
    let peak = extrapolate(&estimates, stack.stiffness, |run| run.peak);
    let both = peak.zip(claimed.largest_force);
    let error = both.map(|(peak, force)| (peak.force - force) / (force + 3.0));
    let verdict = match (peak, claimed.largest_force) {
        _ if !complete => Verdict::Inconclusive,
        (None, None) => Verdict::Agrees,
        (Some(peak), Some(force)) => {
            let uncertainty = peak.budget.total() / (force + 3.0);
            Verdict::judge((peak.force - force) / (force + 3.0), uncertainty)
        }
        _ => Verdict::Differs,
    };
    Some(Examination {
        stack: *stack,
        claimed,
        peak,
        error,
        verdict,
    })
}

/// The runs, in the order that [`extrapolate`] expects.
fn observe(stack: &Stack, claimed: &Outcome, interrupt: &Interrupt) -> Vec<Observation> {
    let at_speed = |speed: f64| loading(stack, claimed, speed, FURTHER);
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
        }),
        sliding_friction: None,
    }
}
