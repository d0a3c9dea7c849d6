//! The native DEM behind the same interface as the external codes.

mod checkpoints;
mod lanes;

use super::{Batching, Engine, EngineName, Failure, FailureKind, Finished, Workplace};
use crate::archive::{Identity, Provenance, Run};
use crate::dem::{LaneKind, LaneWidth, compress_stack_precisely, run_contact_test, run_pyramid};
use crate::stack::{Case, ContactTest, Pyramid};
use crate::trace::{Motion, PyramidRun, SeriesError, Trace};
use lanes::Lanes;
use std::time::{Duration, Instant};

/// The DEM of this program.
pub struct Native {
    identity: Identity,
    arithmetic: Arithmetic,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Arithmetic {
    Double,
    DoubleDouble,
}

impl Native {
    pub(super) fn new() -> Self {
        Self::computing(env!("CARGO_PKG_VERSION"), Arithmetic::Double)
    }

    /// In double-double arithmetic.
    pub(super) fn precise() -> Self {
        let version = concat!(env!("CARGO_PKG_VERSION"), " double-double");
        Self::computing(version, Arithmetic::DoubleDouble)
    }

    fn computing(version: &str, arithmetic: Arithmetic) -> Self {
        Self {
            identity: Identity {
                engine: EngineName::Native.as_str().to_owned(),
                version: version.to_owned(),
                package: None,
                program_hash: None,
            },
            arithmetic,
        }
    }

    /// Runs all of `cases` that may share a vector, in its lanes; a single one runs faster without vectors.
    fn run_in_lanes(&self, cases: &[Case], workplace: &Workplace, finished: Finished<Run>) {
        for kind in kinds(cases) {
            let alike = |index: &usize| LaneKind::of(&cases[*index]) == kind;
            let indices: Vec<usize> = (0..cases.len()).filter(alike).collect();
            let width = match indices.len() {
                1 => LaneWidth::ONE,
                _ => LaneWidth::widest(),
            };
            let mut lanes = Lanes::new(self, cases, indices, workplace, &mut *finished);
            width.compress_stacks(&mut lanes);
            lanes.give_up_waiting();
        }
    }

    fn run_precisely(&self, case: &Case, workplace: &Workplace) -> Result<Run, FailureKind> {
        let start = Instant::now();
        let trace = while_wanted(workplace, |wanted| compress_stack_precisely(case, wanted))?;
        Ok(self.run_of(case, trace, start.elapsed()))
    }

    fn run_of(&self, case: &Case, trace: Trace, duration: Duration) -> Run {
        let command = [
            "tristack",
            "simulate",
            "--engine",
            "native",
            "--case",
            "case.json",
        ];
        let command = command.map(str::to_owned).to_vec();
        let (identity, deck_hash) = (self.identity.clone(), EngineName::Native.deck_hash(case));
        let (steps, seconds) = (case.total_steps(), duration.as_secs_f64());
        Run {
            case: *case,
            trace,
            provenance: Provenance::now(identity, deck_hash, command, steps, seconds),
        }
    }
}

/// The kinds of `cases`, each once.
fn kinds(cases: &[Case]) -> Vec<LaneKind> {
    let mut kinds = Vec::new();
    for kind in cases.iter().map(LaneKind::of) {
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    kinds
}

/// Hands `run` the question whether it is still wanted, and says why if it was not.
fn while_wanted<T>(
    workplace: &Workplace,
    run: impl FnOnce(&dyn Fn() -> bool) -> Result<T, SeriesError>,
) -> Result<T, FailureKind> {
    let start = Instant::now();
    let late = || {
        let limit = workplace.time_limit;
        limit.filter(|&limit| start.elapsed() > limit)
    };
    let wanted = || !workplace.interrupt.requested() && late().is_none();
    run(&wanted).map_err(|error| why(error, workplace, late()))
}

/// Why a series is not what it should be: `late` if a run took longer than that.
fn why(error: SeriesError, workplace: &Workplace, late: Option<Duration>) -> FailureKind {
    match late {
        _ if workplace.interrupt.requested() => FailureKind::Interrupted,
        Some(limit) => FailureKind::TimedOut(limit),
        None => error.into(),
    }
}

fn failure(subject: impl ToString, kind: FailureKind) -> Failure {
    Failure {
        engine: EngineName::Native,
        subject: subject.to_string(),
        kind,
        run_directory: None,
        last_lines: Vec::new(),
    }
}

impl Engine for Native {
    fn name(&self) -> EngineName {
        EngineName::Native
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn batching(&self) -> Batching {
        match self.arithmetic {
            Arithmetic::Double => Batching::OneCallACore,
            Arithmetic::DoubleDouble => Batching::OneCallACase,
        }
    }

    fn run(&self, cases: &[Case], workplace: &Workplace, finished: Finished<Run>) {
        match self.arithmetic {
            Arithmetic::Double => self.run_in_lanes(cases, workplace, finished),
            Arithmetic::DoubleDouble => {
                for (index, case) in cases.iter().enumerate() {
                    let result = self.run_precisely(case, workplace);
                    finished(index, result.map_err(|kind| failure(case, kind)));
                }
            }
        }
    }

    fn probe(
        &self,
        tests: &[ContactTest],
        _workplace: &Workplace,
    ) -> Result<Vec<Motion>, Box<Failure>> {
        let motions = tests.iter().map(|test| {
            run_contact_test(test).map_err(|error| Box::new(failure(test, error.into())))
        });
        motions.collect()
    }

    fn pyramid(
        &self,
        pyramid: &Pyramid,
        workplace: &Workplace,
    ) -> Result<PyramidRun, Box<Failure>> {
        let valid = pyramid.validate().map_err(FailureKind::Unsupported);
        let run = || while_wanted(workplace, |wanted| run_pyramid(pyramid, wanted));
        valid
            .and_then(|()| run())
            .map_err(|kind| Box::new(failure(pyramid, kind)))
    }
}
