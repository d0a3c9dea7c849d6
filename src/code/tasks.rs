//! Tasks that a code carries out in one call, and the receiver of their outcomes.

use super::{Failure, Finished, InstalledCode, Run, RunContext};
use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun};

/// Tasks of one kind. Each outcome goes to the receiver, with the index of its task, as soon as it is there.
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
    ///
    /// # Errors
    /// The first failure, if there is one.
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
