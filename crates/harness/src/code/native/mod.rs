//! The native DEM behind the interface of the external codes.

mod checkpoints;
mod lanes;

use super::described::Code;
use super::failure::{Failure, FailureKind};
use super::installed::{Batching, Finished, InstalledCode, RunContext};
use super::provenance::{Identity, Provenance, Run};
use crate::dem::{
    EventRun, LaneKind, LaneWidth, Observation, PublishedForces, PublishedRun,
    compress_stack_precisely, run_contact_test, run_pyramid,
};
use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun, Series, SeriesError};
use lanes::Lanes;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// The DEM of this program.
pub struct Native {
    name: Code,
    identity: Identity,
    arithmetic: Arithmetic,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Arithmetic {
    Double,
    DoubleDouble,
}

impl Native {
    pub(super) fn new(arithmetic: Arithmetic) -> Self {
        let version = match arithmetic {
            Arithmetic::Double => env!("CARGO_PKG_VERSION"),
            Arithmetic::DoubleDouble => concat!(env!("CARGO_PKG_VERSION"), " double-double"),
        };
        Self {
            name: Code::native(),
            identity: Identity {
                version: version.to_owned(),
                ..Identity::native().clone()
            },
            arithmetic,
        }
    }

    /// Runs `cases` in vector lanes, those that may share a vector together; a single one runs faster without
    /// vectors.
    fn run_in_lanes(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        let mut left: Vec<usize> = (0..cases.len()).collect();
        while let Some(&first) = left.first() {
            let kind = LaneKind::of(&cases[first]);
            let is_alike = |index: &usize| LaneKind::of(&cases[*index]) == kind;
            let (alike, others): (Vec<usize>, _) = left.into_iter().partition(is_alike);
            left = others;
            let width = match alike.len() {
                1 => LaneWidth::ONE,
                _ => LaneWidth::widest(),
            };
            let mut lanes = Lanes::new(self, cases, alike, context, &mut *finished);
            width.compress_stacks(&mut lanes);
            lanes.give_up_waiting();
        }
    }

    fn run_precisely(&self, case: &Case, context: &RunContext) -> Result<Run, FailureKind> {
        let start = Instant::now();
        let series = while_wanted(context, |wanted| compress_stack_precisely(case, wanted))?;
        Ok(self.run_of(case, series, start.elapsed()))
    }

    fn run_of(&self, case: &Case, series: Series, duration: Duration) -> Run {
        let command = "tristack simulate --code native --case case.json";
        let command = command.split(' ').map(str::to_owned).collect();
        let (identity, deck_hash) = (self.identity.clone(), Code::native().deck_hash(case));
        let (steps, seconds) = (case.total_steps(), duration.as_secs_f64());
        Run {
            case: *case,
            series,
            provenance: Provenance::now(identity, deck_hash, command, steps, seconds),
        }
    }
}

/// Calls `run` with a test of whether to go on. If it was stopped, the error is the interrupt or the time limit.
fn while_wanted<T>(
    context: &RunContext,
    run: impl FnOnce(&dyn Fn() -> bool) -> Result<T, SeriesError>,
) -> Result<T, FailureKind> {
    let start = Instant::now();
    let late = || context.late_since(start);
    let wanted = || !context.interrupt.requested() && late().is_none();
    run(&wanted).map_err(|error| cause(error, context, late()))
}

/// Observes `run`; fails if it was stopped or its observation is not usable.
pub(crate) fn observe(run: &EventRun, context: &RunContext) -> Result<Observation, Box<Failure>> {
    let observation = while_wanted(context, |wanted| {
        let observation = run.observe(wanted);
        let message = || "the run did not reach its end within the finite numbers".to_owned();
        let usable = observation.is_usable().then_some(observation);
        usable.ok_or_else(|| SeriesError::Absent { message: message() })
    });
    observation.map_err(|kind| Box::new(failure(run, kind)))
}

/// Carries out `runs` of the authors' program in lanes.
pub(crate) fn repeat(
    runs: &[PublishedRun],
    context: &RunContext,
    finished: Finished<PublishedForces>,
) {
    let width = match runs.len() {
        1 => LaneWidth::ONE,
        _ => LaneWidth::widest(),
    };
    // Longest first, so that no lane is left alone with a long run: the force grows with the friction.
    let mut order: Vec<usize> = (0..runs.len()).collect();
    order.sort_by(|&one, &other| {
        let [one, other] = [&runs[one], &runs[other]];
        let steps = other.largest_steps().cmp(&one.largest_steps());
        steps.then(
            other
                .stack
                .floor_friction
                .total_cmp(&one.stack.floor_friction),
        )
    });
    let sorted: Vec<PublishedRun> = order.iter().map(|&index| runs[index]).collect();
    let last_finished = Cell::new(Instant::now());
    let late = || context.late_since(last_finished.get());
    let wanted = || !context.interrupt.requested() && late().is_none();
    let mut waiting: BTreeSet<usize> = (0..runs.len()).collect();
    width.run_published(&sorted, wanted, |place, forces| {
        let index = order[place];
        waiting.remove(&index);
        last_finished.set(Instant::now());
        let unusable = || {
            let message = "its force never falls, or leaves the finite numbers".to_owned();
            failure(&runs[index], SeriesError::Absent { message }.into())
        };
        let usable = forces.is_usable().then_some(forces);
        finished(index, usable.ok_or_else(unusable));
    });
    for index in waiting {
        let kind = late().map_or(FailureKind::Interrupted, FailureKind::TimedOut);
        finished(index, Err(failure(&runs[index], kind)));
    }
}

/// Returns the cause of an unusable series; `late` is the time limit if that was exceeded.
fn cause(error: SeriesError, context: &RunContext, late: Option<Duration>) -> FailureKind {
    match late {
        _ if context.interrupt.requested() => FailureKind::Interrupted,
        Some(limit) => FailureKind::TimedOut(limit),
        None => error.into(),
    }
}

fn failure(subject: &impl ToString, kind: FailureKind) -> Failure {
    Failure::new(Code::native(), subject, kind)
}

impl InstalledCode for Native {
    fn name(&self) -> &Code {
        &self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn keeps_checkpoints(&self) -> bool {
        self.arithmetic == Arithmetic::Double
    }

    fn batching(&self) -> Batching {
        match self.arithmetic {
            Arithmetic::Double => Batching::OneCallACore,
            Arithmetic::DoubleDouble => Batching::OneCallACase,
        }
    }

    fn run(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        match self.arithmetic {
            Arithmetic::Double => self.run_in_lanes(cases, context, finished),
            Arithmetic::DoubleDouble => {
                for (index, case) in cases.iter().enumerate() {
                    let result = self.run_precisely(case, context);
                    finished(index, result.map_err(|kind| failure(case, kind)));
                }
            }
        }
    }

    fn probe(&self, tests: &[ContactTest], _: &RunContext) -> Result<Vec<Motion>, Box<Failure>> {
        outcomes(tests, |test| Ok(run_contact_test(test)?))
    }

    fn build(
        &self,
        pyramids: &[Pyramid],
        context: &RunContext,
    ) -> Result<Vec<PyramidRun>, Box<Failure>> {
        outcomes(pyramids, |pyramid| {
            pyramid.validate().map_err(FailureKind::Unsupported)?;
            while_wanted(context, |wanted| run_pyramid(pyramid, wanted))
        })
    }
}

/// Returns the outcomes of `tasks`, or the first failure.
fn outcomes<Task: ToString, Outcome>(
    tasks: &[Task],
    carry_out: impl Fn(&Task) -> Result<Outcome, FailureKind>,
) -> Result<Vec<Outcome>, Box<Failure>> {
    let outcomes = tasks
        .iter()
        .map(|task| carry_out(task).map_err(|kind| failure(task, kind).into()));
    outcomes.collect()
}
