//! Event runs in the schedule.

use super::{Kind, Progress, Reading, Recorded, RecordedError, ScheduledTask, Store};
use crate::code::{Code, Failure, Finished, Identity, InstalledCode, RunContext, observe};
use crate::dem::{EventRun, Observation};
use crate::files::{FileError, parse_json};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// An event run with its observation, as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObservedRun {
    run: EventRun,
    observation: Observation,
}

/// The event run in the `text` of the result at `path`.
///
/// # Errors
/// If it is malformed.
pub(super) fn observed_run(text: &[u8], path: &Path) -> Result<EventRun, FileError> {
    parse_json::<ObservedRun>(text, path).map(|kept| kept.run)
}

impl ScheduledTask for EventRun {
    type Outcome = Observation;

    const KIND: Kind = Kind::Observation;

    fn content_hash(&self) -> String {
        self.address()
    }

    fn steps(&self) -> u64 {
        self.largest_steps() as u64
    }

    /// A single stack, without vectors.
    fn seconds_per_step(&self, _: Code) -> f64 {
        5e-8
    }

    fn address(&self, _: &dyn InstalledCode) -> String {
        self.address()
    }

    fn stored(
        &self,
        _: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<Observation>, FileError> {
        let kept = store.sealed(Self::KIND, &self.address(), parse_json::<ObservedRun>)?;
        Ok(kept
            .filter(|kept| kept.run == *self)
            .map(|kept| kept.observation))
    }

    fn keep(
        &self,
        _: &dyn InstalledCode,
        observation: &Observation,
        store: &Store,
    ) -> Result<(), FileError> {
        let kept = ObservedRun {
            run: *self,
            observation: *observation,
        };
        let content = serde_json::to_string(&kept).expect("plain data has a JSON form") + "\n";
        store.put_sealed(Self::KIND, &self.address(), &content)
    }

    fn recorded(&self, code: Code, recorded: &Recorded) -> Result<Observation, RecordedError> {
        Err(recorded.absent(code, "event run"))
    }

    fn carry_out(
        runs: &[Self],
        _: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<Observation>,
    ) {
        for (index, run) in runs.iter().enumerate() {
            finished(index, observe(run, context).map_err(|failure| *failure));
        }
    }

    fn report(&self, code: Code, result: Result<&Observation, &Failure>, progress: &dyn Progress) {
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
