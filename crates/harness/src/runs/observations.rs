//! Native runs of which only the observation is kept: event runs, and runs of the authors' program.

use super::{Kind, Progress, Reading, Recorded, RecordedError, ScheduledTask, Store};
use crate::code::{Code, Failure, Finished, Identity, InstalledCode, RunContext, observe, repeat};
use crate::dem::{EventRun, Observation, PublishedForces, PublishedRun};
use crate::files::{FileError, parse_json};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use std::path::Path;

/// A native run that is observed; the text of its [`Display`] names it in messages.
pub trait ObservedRun:
    Copy + Display + PartialEq + Serialize + DeserializeOwned + Send + Sync + 'static
{
    /// What is kept of it.
    type Observation: Clone + Serialize + DeserializeOwned + Send;

    /// Duration of a step in seconds.
    const SECONDS_PER_STEP: f64;

    /// Content address: everything that decides the observation.
    fn address(&self) -> String;

    /// The most steps that it takes.
    fn largest_steps(&self) -> u64;

    /// Carries out `runs`.
    fn observe(runs: &[Self], context: &RunContext, finished: Finished<Self::Observation>);
}

impl ObservedRun for EventRun {
    type Observation = Observation;

    /// For a single stack, without vectors.
    const SECONDS_PER_STEP: f64 = 5e-8;

    fn address(&self) -> String {
        self.address()
    }

    fn largest_steps(&self) -> u64 {
        self.largest_steps() as u64
    }

    fn observe(runs: &[Self], context: &RunContext, finished: Finished<Observation>) {
        for (index, run) in runs.iter().enumerate() {
            finished(index, observe(run, context).map_err(|failure| *failure));
        }
    }
}

impl ObservedRun for PublishedRun {
    type Observation = PublishedForces;

    /// For runs in lanes.
    const SECONDS_PER_STEP: f64 = 2e-8;

    fn address(&self) -> String {
        self.address()
    }

    fn largest_steps(&self) -> u64 {
        self.largest_steps()
    }

    fn observe(runs: &[Self], context: &RunContext, finished: Finished<PublishedForces>) {
        repeat(runs, context, finished);
    }
}

/// A run with its observation, as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept<Run, Observation> {
    run: Run,
    observation: Observation,
}

/// Reads the run from the `text` of the result at `path`.
///
/// # Errors
/// If the text is malformed, or the run is of another kind.
pub(super) fn observed_run<Run: ObservedRun>(text: &[u8], path: &Path) -> Result<Run, FileError> {
    parse_json::<Kept<Run, Run::Observation>>(text, path).map(|kept| kept.run)
}

impl<Run: ObservedRun> ScheduledTask for Run {
    type Outcome = Run::Observation;

    const KIND: Kind = Kind::Observation;

    fn content_hash(&self) -> String {
        self.address()
    }

    fn steps(&self) -> u64 {
        self.largest_steps()
    }

    fn seconds_per_step(&self, _: &Code) -> f64 {
        Self::SECONDS_PER_STEP
    }

    fn address(&self, _: &dyn InstalledCode) -> String {
        ObservedRun::address(self)
    }

    fn stored(
        &self,
        _: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<Run::Observation>, FileError> {
        let kept = store.sealed(
            Self::KIND,
            &ObservedRun::address(self),
            parse_json::<Kept<Run, Run::Observation>>,
        )?;
        Ok(kept
            .filter(|kept| kept.run == *self)
            .map(|kept| kept.observation))
    }

    fn keep(
        &self,
        _: &dyn InstalledCode,
        observation: &Run::Observation,
        store: &Store,
    ) -> Result<(), FileError> {
        let kept = Kept {
            run: *self,
            observation: observation.clone(),
        };
        let content = serde_json::to_string(&kept).expect("plain data has a JSON form") + "\n";
        store.put_sealed(Self::KIND, &ObservedRun::address(self), &content)
    }

    fn recorded(
        &self,
        code: &Code,
        recorded: &Recorded,
    ) -> Result<Run::Observation, RecordedError> {
        Err(recorded.absent(code, "observed run"))
    }

    fn carry_out(
        runs: &[Self],
        _: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<Run::Observation>,
    ) {
        Self::observe(runs, context, finished);
    }

    fn report(
        &self,
        code: &Code,
        result: Result<&Run::Observation, &Failure>,
        progress: &dyn Progress,
    ) {
        progress.finished(code, self, result.map(|_| None));
    }
}

impl Reading for Observation {
    type Task = EventRun;

    fn of(observation: Observation) -> Self {
        observation
    }

    fn identity(&self) -> &Identity {
        Identity::native()
    }
}

impl Reading for PublishedForces {
    type Task = PublishedRun;

    fn of(forces: PublishedForces) -> Self {
        forces
    }

    fn identity(&self) -> &Identity {
        Identity::native()
    }
}
