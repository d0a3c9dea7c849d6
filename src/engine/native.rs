//! The native DEM behind the same interface as the external codes.

use super::{Engine, EngineName, Failure, FailureKind, Finished, Workplace};
use crate::archive::{Identity, Provenance, Run};
use crate::dem::{compress_stack, compress_stack_precisely, run_contact_test, run_pyramid};
use crate::stack::{Case, ContactTest, Pyramid};
use crate::trace::{Motion, PyramidRun, SeriesError, Trace};
use std::time::Instant;

/// The DEM of this program.
pub struct Native {
    identity: Identity,
    compress: Compress,
}

/// Makes the series of a case, unless it is no longer wanted.
type Compress = fn(&Case, &dyn Fn() -> bool) -> Result<Trace, SeriesError>;

impl Native {
    pub(super) fn new() -> Self {
        Self::computing(env!("CARGO_PKG_VERSION"), |case, wanted| {
            compress_stack(case, wanted)
        })
    }

    /// In double-double arithmetic.
    pub(super) fn precise() -> Self {
        let version = concat!(env!("CARGO_PKG_VERSION"), " double-double");
        Self::computing(version, |case, wanted| {
            compress_stack_precisely(case, wanted)
        })
    }

    fn computing(version: &str, compress: Compress) -> Self {
        Self {
            identity: Identity {
                engine: EngineName::Native.as_str().to_owned(),
                version: version.to_owned(),
                package: None,
                program_hash: None,
            },
            compress,
        }
    }

    fn run_one(&self, case: &Case, workplace: &Workplace) -> Result<Run, FailureKind> {
        let start = Instant::now();
        let trace = while_wanted(workplace, |wanted| (self.compress)(case, wanted))?;
        let seconds = start.elapsed().as_secs_f64();
        let steps = case.total_steps();
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
        Ok(Run {
            case: *case,
            trace,
            provenance: Provenance::now(identity, deck_hash, command, steps, seconds),
        })
    }
}

/// Hands `run` the question whether it is still wanted, and says why if it was not.
fn while_wanted<T>(
    workplace: &Workplace,
    run: impl FnOnce(&dyn Fn() -> bool) -> Result<T, SeriesError>,
) -> Result<T, FailureKind> {
    let start = Instant::now();
    let limit = workplace.time_limit;
    let late = || limit.is_some_and(|limit| start.elapsed() > limit);
    let stopped = || workplace.interrupt.requested() || late();
    run(&|| !stopped()).map_err(|error| match limit {
        _ if workplace.interrupt.requested() => FailureKind::Interrupted,
        Some(limit) if late() => FailureKind::TimedOut(limit),
        _ => error.into(),
    })
}

impl Engine for Native {
    fn name(&self) -> EngineName {
        EngineName::Native
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn prefers_many_cases(&self) -> bool {
        false
    }

    fn run(&self, cases: &[Case], workplace: &Workplace, finished: Finished<Run>) {
        for (index, case) in cases.iter().enumerate() {
            let result = self.run_one(case, workplace).map_err(|kind| Failure {
                engine: EngineName::Native,
                subject: case.to_string(),
                kind,
                run_directory: None,
                last_lines: Vec::new(),
            });
            finished(index, result);
        }
    }

    fn probe(
        &self,
        tests: &[ContactTest],
        _workplace: &Workplace,
    ) -> Result<Vec<Motion>, Box<Failure>> {
        let motions = tests.iter().map(|test| {
            run_contact_test(test).map_err(|error| {
                Box::new(Failure {
                    engine: EngineName::Native,
                    subject: test.to_string(),
                    kind: error.into(),
                    run_directory: None,
                    last_lines: Vec::new(),
                })
            })
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
        valid.and_then(|()| run()).map_err(|kind| {
            Box::new(Failure {
                engine: EngineName::Native,
                subject: pyramid.to_string(),
                kind,
                run_directory: None,
                last_lines: Vec::new(),
            })
        })
    }
}
