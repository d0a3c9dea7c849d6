//! The interface of an installed code.

use super::described::Code;
use super::failure::Failure;
use super::interrupt::Interrupt;
use super::provenance::{Identity, Run};
use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun};
use std::path::Path;
use std::time::{Duration, Instant};

/// The conditions under which runs are made.
#[derive(Clone, Copy)]
pub struct RunContext<'a> {
    /// Directory in which every case gets its own run directory.
    pub directory: &'a Path,
    /// Directory for checkpoints of unfinished runs; `None` to keep none.
    pub checkpoints: Option<&'a Path>,
    /// Whether to begin anew and ignore checkpoints.
    pub fresh: bool,
    /// Longest time without a finished case; the code's own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Stops the runs when requested.
    pub interrupt: &'a Interrupt,
    /// Receives the progress of long runs: index of the case, steps done.
    pub advanced: &'a (dyn Fn(usize, u64) + Sync),
}

impl<'a> RunContext<'a> {
    /// Returns the context for runs in `directory`, without checkpoints, time limit or progress.
    pub fn new(directory: &'a Path, interrupt: &'a Interrupt) -> Self {
        Self {
            directory,
            checkpoints: None,
            fresh: false,
            time_limit: None,
            interrupt,
            advanced: &|_, _| (),
        }
    }

    /// Returns the time limit if it has passed since `start`.
    pub(super) fn late_since(&self, start: Instant) -> Option<Duration> {
        self.time_limit.filter(|&limit| start.elapsed() > limit)
    }
}

/// How cases are distributed over calls so that a code is fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Batching {
    /// One call per case.
    OneCallACase,
    /// One call per core that the code gets, because starting takes longer than running.
    FewCalls,
    /// One call per core, because the cases of a call share vector instructions.
    OneCallACore,
}

/// Receives each result, with the index of its task, as soon as it is available.
pub type Finished<'a, T> = &'a mut dyn FnMut(usize, Result<T, Failure>);

/// A code that is installed on this machine.
pub trait InstalledCode: Send + Sync {
    /// The name of the code.
    fn name(&self) -> &Code;

    /// The program behind its numbers.
    fn identity(&self) -> &Identity;

    /// Why it does not work although it is installed; `None` if it works.
    fn broken(&self) -> Option<&str> {
        None
    }

    /// Whether its results are files that were made elsewhere.
    fn reads_files(&self) -> bool {
        false
    }

    /// What the identity covers and what it does not, in prose.
    fn coverage(&self) -> String {
        "the sources of this program".to_owned()
    }

    /// Whether a compression that was cut short continues, at its next start, from where it was.
    fn keeps_checkpoints(&self) -> bool {
        false
    }

    /// The distribution of cases over calls.
    fn batching(&self) -> Batching;

    /// Compresses the stacks of `cases` and hands each result to `finished`. A failure does not stop the others.
    fn run(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>);

    /// Carries out micro-tests and returns their motions in order, or the first failure.
    fn probe(
        &self,
        tests: &[ContactTest],
        context: &RunContext,
    ) -> Result<Vec<Motion>, Box<Failure>>;

    /// Carries out the runs of pyramids and returns them in order, or the first failure: the code may not build
    /// pyramids, or not with this convention.
    fn build(
        &self,
        pyramids: &[Pyramid],
        context: &RunContext,
    ) -> Result<Vec<PyramidRun>, Box<Failure>>;
}
