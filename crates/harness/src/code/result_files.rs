//! A code whose runs were made elsewhere, following a plan.

use super::described::Code;
use super::failure::{Failure, FailureKind};
use super::installed::{Batching, Finished, InstalledCode, RunContext};
use super::planned::PlannedRun;
use super::provenance::{Identity, Provenance, Run};
use super::task::Task;
use super::written::last_lines;
use crate::model::{Case, ContactTest, Pyramid, shown};
use crate::series::{Motion, PyramidRun, Series};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A code that is judged by files: it reads results and starts nothing.
pub struct ResultFiles {
    name: Code,
    identity: Identity,
    /// The directory of the plan.
    root: PathBuf,
    /// The runs of the plan, by the hash of their inputs.
    runs: BTreeMap<String, PlannedRun>,
}

impl ResultFiles {
    /// Creates the code `name` with its results of `runs` below `root`, which are said to be of this `version`.
    pub(crate) fn new(name: Code, version: &str, root: &Path, runs: &[PlannedRun]) -> Self {
        let runs = runs.iter().cloned();
        let code = name.as_str().to_owned();
        Self {
            name,
            identity: Identity {
                code,
                version: version.to_owned(),
                package: None,
                program_hash: None,
                files_hash: None,
                witness: None,
            },
            root: root.to_owned(),
            runs: runs.map(|run| (run.deck_hash.clone(), run)).collect(),
        }
    }

    fn outcome<T: Task>(&self, task: &T) -> Result<T::Outcome, Box<Failure>> {
        let Some(run) = self.runs.get(&self.name.deck_hash(task)) else {
            let root = shown(&self.root);
            let message = format!(
                "{root} has no run of {task} with the files of today: the same tristack plan again adds it"
            );
            let kind = FailureKind::NoResult(message);
            return Err(Failure::new(self.name.clone(), task, kind).into());
        };
        run.outcome(&self.name, task, &self.root).map_err(|kind| {
            let program = self.name.definition().program.as_ref();
            let logs = program.map_or(&[][..], |program| &program.logs);
            let directory = self.root.join(&run.directory);
            let is_own = run.refuse_links(&self.root).is_ok();
            Box::new(Failure {
                last_lines: match is_own {
                    true => last_lines(&directory, logs),
                    false => Vec::new(),
                },
                ..Failure::new(self.name.clone(), task, kind)
            })
        })
    }

    fn run_of(&self, case: &Case, series: Series) -> Run {
        let (identity, deck_hash) = (self.identity.clone(), self.name.deck_hash(case));
        let command = self.runs.get(&deck_hash);
        let command = command.map_or_else(Vec::new, |run| run.command.clone());
        Run {
            case: *case,
            series,
            provenance: Provenance::now(identity, deck_hash, command, case.steps(), 0.0),
        }
    }
}

impl InstalledCode for ResultFiles {
    fn name(&self) -> &Code {
        &self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn reads_files(&self) -> bool {
        true
    }

    fn coverage(&self) -> String {
        "decks and parameters; nothing is known of the program that made the results".to_owned()
    }

    fn batching(&self) -> Batching {
        Batching::OneCallACore
    }

    fn run(&self, cases: &[Case], _: &RunContext, finished: Finished<Run>) {
        for (index, case) in cases.iter().enumerate() {
            let series = self.outcome(case).map_err(|failure| *failure);
            finished(index, series.map(|series| self.run_of(case, series)));
        }
    }

    fn probe(&self, tests: &[ContactTest], _: &RunContext) -> Result<Vec<Motion>, Box<Failure>> {
        tests.iter().map(|test| self.outcome(test)).collect()
    }

    fn build(&self, pyramids: &[Pyramid], _: &RunContext) -> Result<Vec<PyramidRun>, Box<Failure>> {
        let pyramids = pyramids.iter();
        pyramids.map(|pyramid| self.outcome(pyramid)).collect()
    }
}
