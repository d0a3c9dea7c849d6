//! An installed external code, whose program is given its tasks in batches.

use super::batch::Batch;
use super::failure::{Failure, FailureKind};
use super::installation::InstalledProgram;
use super::installed::{Batching, Finished, InstalledCode, RunContext, Tasks};
use super::provenance::{Identity, Provenance, Run};
use super::registry::Code;
use super::task::Task;
use crate::model::{Case, InvalidValue};
use crate::series::Series;
use std::ops::Range;

/// An installed external code.
pub(crate) struct ExternalCode {
    program: InstalledProgram,
    identity: Identity,
}

/// Whether two cases are run with the same deck.
fn same_deck(left: &Case, right: &Case) -> bool {
    let kind = |case: &Case| (case.kind(), case.protocol.shortcuts.is_some());
    kind(left) == kind(right)
}

impl ExternalCode {
    /// `code` with the program `word`, if that is installed here.
    pub(super) fn find(code: Code, word: &str) -> Option<Box<dyn InstalledCode>> {
        let program = InstalledProgram::find(code, word)?;
        let installation = &program.installation;
        let identity = Identity {
            code: code.as_str().to_owned(),
            version: installation.version.clone(),
            package: installation.package.clone(),
            program_hash: Some(installation.hash.clone()),
        };
        Some(Box::new(Self { program, identity }))
    }

    /// Carries out the `tasks` in `range`, all of one kind, in order, as many at once as the code can; if
    /// `all_or_nothing`, only up to the first failure.
    fn carry_out_range<T: Task>(
        &self,
        tasks: &[T],
        range: Range<usize>,
        context: &RunContext,
        all_or_nothing: bool,
        finished: Finished<(T::Outcome, f64)>,
    ) {
        let many = self.program.code.definition().runs_many();
        let at_once = if many { range.len() } else { 1 };
        let mut next = range.start;
        while next < range.end {
            let end = (next + at_once).min(range.end);
            let directory = if tasks.len() == 1 {
                context.directory.to_owned()
            } else {
                context
                    .directory
                    .join(format!("{}-{next}", self.program.code))
            };
            let mut batch = Batch::new(&self.program, &tasks[next..end], directory);
            let mut failed = false;
            batch.run(context, &mut |index, result| {
                failed |= result.is_err();
                finished(next + index, result);
            });
            if failed && all_or_nothing {
                return;
            }
            next += batch.settled();
        }
    }

    /// Carries out `tasks` up to the first failure.
    fn up_to_failure<T: Task>(
        &self,
        tasks: &[T],
        context: &RunContext,
        finished: Finished<T::Outcome>,
    ) {
        for (index, task) in tasks.iter().enumerate() {
            if let Err(refusal) = self.check(task) {
                return finished(index, Err(self.unsupported(task, refusal)));
            }
        }
        let all = 0..tasks.len();
        self.carry_out_range(tasks, all, context, true, &mut |index, result| {
            finished(index, result.map(|(outcome, _)| outcome));
        });
    }

    /// Runs `cases`, those that share a deck together.
    fn run_cases(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        let mut start = 0;
        for same in cases.chunk_by(same_deck) {
            let range = start..start + same.len();
            start = range.end;
            if self.check_case(&same[0]).is_ok() {
                self.carry_out_range(cases, range, context, false, &mut |index, result| {
                    let run = result.map(|outcome| self.run_of(cases[index], outcome));
                    finished(index, run);
                });
                continue;
            }
            for index in range {
                if let Err(refusal) = self.check_case(&cases[index]) {
                    finished(index, Err(self.unsupported(&cases[index], refusal)));
                }
            }
        }
    }

    fn run_of(&self, case: Case, (series, seconds): (Series, f64)) -> Run {
        let command = self.program.command(case.kind(), &[".".to_owned()]);
        let hash = self.program.code.deck_hash(&case);
        let provenance =
            Provenance::now(self.identity.clone(), hash, command, case.steps(), seconds);
        Run {
            case,
            series,
            provenance,
        }
    }

    /// Refuses a case that the code has no deck for.
    fn check_case(&self, case: &Case) -> Result<(), InvalidValue> {
        let code = self.program.code;
        code.check_shortcuts(case.protocol.shortcuts.is_some())?;
        code.check_task(case.kind())
    }

    /// Refuses a task that is invalid, or that the code has no deck for.
    fn check(&self, task: &impl Task) -> Result<(), InvalidValue> {
        task.validate()?;
        self.program.code.check_task(task.kind())
    }

    fn unsupported(&self, task: &impl Task, refusal: InvalidValue) -> Failure {
        Failure::new(self.program.code, task, FailureKind::Unsupported(refusal))
    }
}

impl InstalledCode for ExternalCode {
    fn name(&self) -> Code {
        self.program.code
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn batching(&self) -> Batching {
        match self.program.code.definition().runs_many() {
            true => Batching::FewCalls,
            false => Batching::OneCallACase,
        }
    }

    fn carry_out(&self, tasks: Tasks, context: &RunContext) {
        match tasks {
            Tasks::Cases(cases, finished) => self.run_cases(cases, context, finished),
            Tasks::ContactTests(tests, finished) => self.up_to_failure(tests, context, finished),
            Tasks::Pyramids(pyramids, finished) => self.up_to_failure(pyramids, context, finished),
        }
    }
}
