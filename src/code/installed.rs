//! The interface of an installed code.

use super::failure::Failure;
use super::process::Interrupt;
use super::provenance::{Identity, Run};
use super::registry::Code;
use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun};
use std::path::Path;
use std::time::Duration;

/// Progress callback: index of the case, steps done.
pub(crate) type Advanced<'a> = &'a (dyn Fn(usize, u64) + Sync);

/// The conditions under which runs are made.
#[derive(Clone, Copy)]
pub struct RunContext<'a> {
    /// Directory in which every case gets a run directory of its own.
    pub directory: &'a Path,
    /// Directory for checkpoints of unfinished runs; `None` to keep none.
    pub checkpoints: Option<&'a Path>,
    /// Longest time without a finished case; the code's own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Stops the runs when requested.
    pub interrupt: &'a Interrupt,
    /// Receives the progress of long runs.
    pub advanced: Advanced<'a>,
}

impl<'a> RunContext<'a> {
    /// Runs in `directory`, without checkpoints, time limit or progress.
    pub fn new(directory: &'a Path, interrupt: &'a Interrupt) -> Self {
        Self {
            directory,
            checkpoints: None,
            time_limit: None,
            interrupt,
            advanced: &|_, _| (),
        }
    }
}

/// The distribution of cases over calls with which a code is fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Batching {
    /// A call for each case.
    OneCallACase,
    /// A call for each core that the code gets, because starting takes longer than running.
    FewCalls,
    /// A call for each core, because the cases of a call share vector instructions.
    OneCallACore,
}

/// Receives each result, with the index of its task, as soon as it is available.
pub type Finished<'a, T> = &'a mut dyn FnMut(usize, Result<T, Failure>);

/// A code that is installed here.
pub trait InstalledCode: Send + Sync {
    /// The name of the code.
    fn name(&self) -> Code;

    /// The program behind its numbers.
    fn identity(&self) -> &Identity;

    /// The distribution of cases over calls.
    fn batching(&self) -> Batching;

    /// Carries out `tasks`.
    fn carry_out(&self, tasks: Tasks, context: &RunContext);
}

/// Tasks of one kind, and the receiver of their outcomes.
pub enum Tasks<'a, 'f> {
    /// Stacks to be compressed. A failure does not keep the others from running.
    Cases(&'a [Case], Finished<'f, Run>),
    /// Micro-tests. The first failure ends the call.
    ContactTests(&'a [ContactTest], Finished<'f, Motion>),
    /// Pyramids. The first failure ends the call.
    Pyramids(&'a [Pyramid], Finished<'f, PyramidRun>),
}

impl dyn InstalledCode + '_ {
    /// Runs `cases`, and hands each result to `finished`.
    pub fn run(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>) {
        self.carry_out(Tasks::Cases(cases, finished), context);
    }

    /// The motions of micro-tests, in order.
    pub fn probe(
        &self,
        tests: &[ContactTest],
        context: &RunContext,
    ) -> Result<Vec<Motion>, Box<Failure>> {
        collect(tests.len(), |finished| {
            self.carry_out(Tasks::ContactTests(tests, finished), context);
        })
    }

    /// The runs of pyramids, in order.
    ///
    /// # Errors
    /// The first failure, if there is one: the code may not build pyramids, or not with this convention.
    pub fn build(
        &self,
        pyramids: &[Pyramid],
        context: &RunContext,
    ) -> Result<Vec<PyramidRun>, Box<Failure>> {
        collect(pyramids.len(), |finished| {
            self.carry_out(Tasks::Pyramids(pyramids, finished), context);
        })
    }
}

/// The outcomes of `count` tasks in the order of their indices, or the first failure.
fn collect<T>(count: usize, carry_out: impl FnOnce(Finished<T>)) -> Result<Vec<T>, Box<Failure>> {
    let mut outcomes: Vec<Option<T>> = (0..count).map(|_| None).collect();
    let mut failure = None;
    carry_out(&mut |index, result| match result {
        Ok(outcome) => outcomes[index] = Some(outcome),
        Err(error) => failure = failure.take().or(Some(error)),
    });
    match failure {
        Some(failure) => Err(Box::new(failure)),
        None => Ok(outcomes.into_iter().flatten().collect()),
    }
}
