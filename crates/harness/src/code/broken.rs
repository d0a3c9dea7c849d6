//! A code that is installed but does not work. Recorded runs do not stand in for it: every task fails.

use super::described::Code;
use super::failure::{Failure, FailureKind};
use super::installed::{Batching, Finished, InstalledCode, RunContext};
use super::provenance::{Identity, Run};
use super::question::interrupt;
use crate::model::{Case, ContactTest, Pyramid, shown};
use crate::series::{Motion, PyramidRun};
use std::path::Path;

/// The version that tables show.
const BROKEN: &str = "broken";

/// A code whose program does not tell its version.
pub(crate) struct BrokenCode {
    name: Code,
    identity: Identity,
    reason: String,
}

impl BrokenCode {
    /// Creates the code `name`, whose program in `file` failed with `kind` when asked for its version.
    pub fn new(name: Code, file: &Path, kind: &FailureKind) -> Self {
        let what = match kind {
            FailureKind::TimedOut(limit) => format!("gave no answer within {limit:?}"),
            FailureKind::Ended(status) => format!("ended with {status}, at every attempt"),
            other => other.to_string(),
        };
        let code = name.as_str().to_owned();
        Self {
            name,
            identity: Identity {
                code,
                version: BROKEN.to_owned(),
                package: None,
                program_hash: None,
                files_hash: None,
                witness: None,
            },
            reason: format!(
                "{} is installed, but broken: asked for its version it {what}",
                shown(file)
            ),
        }
    }

    fn failure(&self, task: &impl ToString) -> Failure {
        let kind = match interrupt().requested() {
            true => FailureKind::Interrupted,
            false => FailureKind::Broken(self.reason.clone()),
        };
        Failure::new(self.name.clone(), task, kind)
    }
}

impl InstalledCode for BrokenCode {
    fn name(&self) -> &Code {
        &self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn broken(&self) -> Option<&str> {
        Some(&self.reason)
    }

    fn coverage(&self) -> String {
        self.reason.clone()
    }

    fn batching(&self) -> Batching {
        Batching::OneCallACore
    }

    fn run(&self, cases: &[Case], _: &RunContext, finished: Finished<Run>) {
        for (index, case) in cases.iter().enumerate() {
            finished(index, Err(self.failure(case)));
        }
    }

    fn probe(&self, tests: &[ContactTest], _: &RunContext) -> Result<Vec<Motion>, Box<Failure>> {
        let failure = tests.first().map(|test| self.failure(test));
        failure.map_or(Ok(Vec::new()), |failure| Err(Box::new(failure)))
    }

    fn build(&self, pyramids: &[Pyramid], _: &RunContext) -> Result<Vec<PyramidRun>, Box<Failure>> {
        let failure = pyramids.first().map(|pyramid| self.failure(pyramid));
        failure.map_or(Ok(Vec::new()), |failure| Err(Box::new(failure)))
    }
}
