//! An installed code, and how runs are asked of it.

use super::failure::Failure;
use super::process::Interrupt;
use super::provenance::{Identity, Run};
use super::registry::Code;
use crate::model::{Case, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun};
use std::path::Path;
use std::time::Duration;

/// Progress callback: index of the case, steps done.
pub type Advanced<'a> = &'a (dyn Fn(usize, u64) + Sync);

/// Where and how runs are made.
#[derive(Clone, Copy)]
pub struct RunContext<'a> {
    /// Directory in which every case gets a run directory of its own.
    pub directory: &'a Path,
    /// Directory that keeps runs which are under way, if they are to be taken up after an interruption.
    pub checkpoints: Option<&'a Path>,
    /// Longest time without a finished case; the code's own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
    /// Called now and then while long runs go on.
    pub advanced: Advanced<'a>,
}

impl<'a> RunContext<'a> {
    /// Runs in `directory` until they end or the user wants to stop; nothing is kept or reported.
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

/// How a code is fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Batching {
    /// With a call for each case.
    OneCallACase,
    /// With as few calls as there are cores for it, because starting takes longer than running.
    FewCalls,
    /// With a call on each core, because cases in one call share every instruction.
    OneCallACore,
}

/// Receives results, each with its index, as soon as they are there.
pub type Finished<'a, T> = &'a mut dyn FnMut(usize, Result<T, Failure>);

/// A code that runs cases.
pub trait InstalledCode: Send + Sync {
    /// Which one it is.
    fn name(&self) -> Code;

    /// What decides its numbers.
    fn identity(&self) -> &Identity;

    /// How many cases one call should have.
    fn batching(&self) -> Batching;

    /// Runs `cases` and hands each result, with its index, to `finished` as soon as it is there.
    fn run(&self, cases: &[Case], context: &RunContext, finished: Finished<Run>);

    /// Carries out micro-tests, in order.
    ///
    /// # Errors
    /// The first failure, if there is one.
    fn probe(
        &self,
        tests: &[ContactTest],
        context: &RunContext,
    ) -> Result<Vec<Motion>, Box<Failure>>;

    /// Carries out the run of a pyramid.
    ///
    /// # Errors
    /// If the code cannot build one, if it does not take the pyramid's convention, or if the run fails.
    fn pyramid(&self, pyramid: &Pyramid, context: &RunContext) -> Result<PyramidRun, Box<Failure>>;
}
