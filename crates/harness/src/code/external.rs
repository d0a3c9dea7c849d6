//! An installed external code, whose program gets its tasks in batches.

use super::batch::Batch;
use super::described::Code;
use super::failure::{Failure, FailureKind};
use super::installation::ExternalCode;
use super::installed::{Batching, Finished, InstalledCode, RunContext};
use super::provenance::{Identity, Provenance, Run};
use super::task::Task;
use crate::model::{Case, ContactTest, InvalidValue, Pyramid};
use crate::series::{Motion, PyramidRun, Series};
use std::collections::BTreeMap;
use std::ops::Range;

/// Whether two cases are run with the same deck.
fn same_deck(left: &Case, right: &Case) -> bool {
    let kind = |case: &Case| (case.kind(), case.protocol.shortcuts.is_some());
    kind(left) == kind(right)
}

impl ExternalCode {
    /// Carries out the `tasks` in `range`, all of one kind, in order, as many at once as the code can. With
    /// `all_or_nothing`, stops at the first failure.
    fn carry_out<T: Task>(
        &self,
        tasks: &[T],
        range: Range<usize>,
        context: &RunContext,
        all_or_nothing: bool,
        finished: Finished<(T::Outcome, f64)>,
    ) {
        let many = self.definition().runs_many();
        let at_once = if many { range.len() } else { 1 };
        let mut next = range.start;
        while next < range.end {
            let end = (next + at_once).min(range.end);
            let directory = match tasks {
                [_] => context.directory.to_owned(),
                _ => context.directory.join(format!("{}-{next}", self.name)),
            };
            let mut batch = Batch::new(self, &tasks[next..end], directory);
            let mut failed = false;
            batch.run(context, &mut |index, result| {
                failed |= result.is_err();
                finished(next + index, result);
            });
            if failed && all_or_nothing {
                return;
            }
            next += batch.finished();
        }
    }

    /// Returns the outcomes of `tasks` in order, or the first failure.
    fn outcomes<T: Task>(
        &self,
        tasks: &[T],
        context: &RunContext,
    ) -> Result<Vec<T::Outcome>, Box<Failure>> {
        for task in tasks {
            let checked = task.validate();
            let checked = checked.and_then(|()| self.name.check_task(task.kind()));
            checked.map_err(|refusal| self.unsupported(task, refusal))?;
        }
        let (all, mut outcomes) = (0..tasks.len(), BTreeMap::new());
        self.carry_out(tasks, all, context, true, &mut |index, result| {
            outcomes.insert(index, result.map(|(outcome, _)| outcome));
        });
        let outcomes: Result<_, Failure> = outcomes.into_values().collect();
        Ok(outcomes?)
    }

    fn run_of(&self, case: Case, (series, seconds): (Series, f64)) -> Run {
        let command = self.command(case.kind(), &[".".to_owned()]);
        let (identity, deck_hash) = (self.identity.clone(), self.name.deck_hash(&case));
        Run {
            case,
            series,
            provenance: Provenance::now(identity, deck_hash, command, case.steps(), seconds),
        }
    }

    /// Refuses a case that needs a deck or shortcuts which the code does not have.
    fn check_case(&self, case: &Case) -> Result<(), InvalidValue> {
        let shortened = case.protocol.shortcuts.is_some();
        self.name.check_shortcuts(shortened)?;
        self.name.check_task(case.kind())
    }

    fn unsupported(&self, task: &impl Task, refusal: InvalidValue) -> Failure {
        Failure::new(self.name.clone(), task, FailureKind::Unsupported(refusal))
    }
}

impl InstalledCode for ExternalCode {
    fn name(&self) -> &Code {
        &self.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn coverage(&self) -> String {
        self.described_coverage()
    }

    fn batching(&self) -> Batching {
        match self.definition().runs_many() {
            true => Batching::FewCalls,
            false => Batching::OneCallACase,
        }
    }

    /// Runs successive cases that share a deck together.
    fn run(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        let mut start = 0;
        for same in cases.chunk_by(same_deck) {
            let range = start..start + same.len();
            start = range.end;
            let Err(refusal) = self.check_case(&same[0]) else {
                self.carry_out(cases, range, context, false, &mut |index, result| {
                    let run = result.map(|outcome| self.run_of(cases[index], outcome));
                    finished(index, run);
                });
                continue;
            };
            for index in range {
                let failure = self.unsupported(&cases[index], refusal.clone());
                finished(index, Err(failure));
            }
        }
    }

    fn probe(
        &self,
        tests: &[ContactTest],
        context: &RunContext,
    ) -> Result<Vec<Motion>, Box<Failure>> {
        self.outcomes(tests, context)
    }

    fn build(
        &self,
        pyramids: &[Pyramid],
        context: &RunContext,
    ) -> Result<Vec<PyramidRun>, Box<Failure>> {
        self.outcomes(pyramids, context)
    }
}
