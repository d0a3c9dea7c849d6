//! The tasks that the schedule carries out, and how each kind is kept.

use super::Progress;
use crate::code::{Code, Failure, Finished, InstalledCode, Run, RunContext};
use crate::files::FileError;
use crate::model::Case;
use crate::runs::{Kind, Recorded, RecordedError, Store};
use std::fmt::Display;

/// A task whose result is kept: the run of a case, an event run, a run of the authors' program, an impact, or the
/// probe of a code.
pub trait ScheduledTask: Copy + Display + Send + Sync + 'static {
    /// The result as it is kept.
    type Outcome: Send;

    /// The kind of the result.
    const KIND: Kind;

    /// Hash of what the task asks for; equal tasks for one code are carried out once.
    fn content_hash(&self) -> String;

    /// The most steps that it takes.
    fn steps(&self) -> u64;

    /// Estimated duration of a step in seconds.
    fn seconds_per_step(&self, code: &Code) -> f64 {
        code.seconds_per_step()
    }

    /// The address under which the store keeps the result of `code`.
    fn address(&self, code: &dyn InstalledCode) -> String;

    /// Reads the result of `code` from `store`, if there is one.
    ///
    /// # Errors
    /// If there is one but it is damaged.
    fn stored(
        &self,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<Self::Outcome>, FileError>;

    /// Keeps the `outcome` of the task with `code` in `store`.
    ///
    /// # Errors
    /// If the file system refuses.
    fn keep(
        &self,
        code: &dyn InstalledCode,
        outcome: &Self::Outcome,
        store: &Store,
    ) -> Result<(), FileError>;

    /// Reads the recorded result of `code`.
    ///
    /// # Errors
    /// If there is none, or it cannot stand in.
    fn recorded(&self, code: &Code, recorded: &Recorded) -> Result<Self::Outcome, RecordedError>;

    /// Carries out `tasks` with `code`; a failure does not stop the others.
    fn carry_out(
        tasks: &[Self],
        code: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<Self::Outcome>,
    );

    /// Reports the end of the task.
    fn report(
        &self,
        code: &Code,
        result: Result<&Self::Outcome, &Failure>,
        progress: &dyn Progress,
    );
}

impl ScheduledTask for Case {
    type Outcome = Run;

    const KIND: Kind = Kind::Run;

    fn content_hash(&self) -> String {
        Case::content_hash(self)
    }

    fn steps(&self) -> u64 {
        self.total_steps()
    }

    fn address(&self, code: &dyn InstalledCode) -> String {
        let deck_hash = code.name().deck_hash(self);
        code.identity().address(self, &deck_hash)
    }

    fn stored(&self, code: &dyn InstalledCode, store: &Store) -> Result<Option<Run>, FileError> {
        store.get(code.identity(), self, &code.name().deck_hash(self))
    }

    fn keep(&self, _: &dyn InstalledCode, run: &Run, store: &Store) -> Result<(), FileError> {
        store.put(run)
    }

    fn recorded(&self, code: &Code, recorded: &Recorded) -> Result<Run, RecordedError> {
        recorded.run(code, self)
    }

    fn carry_out(
        cases: &[Self],
        code: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<Run>,
    ) {
        code.run(cases, context, finished);
    }

    fn report(&self, code: &Code, result: Result<&Run, &Failure>, progress: &dyn Progress) {
        progress.finished(code, self, result.map(|run| Some(run.provenance.seconds)));
    }
}
