//! Impacts in the schedule; what is read off the motion of each is kept, not the motion.

use super::{Kind, Progress, Reading, Recorded, RecordedError, ScheduledTask, Store};
use crate::code::{Code, Failure, Finished, Identity, InstalledCode, RunContext};
use crate::dem::SOURCE_DIGEST;
use crate::files::{FileError, parse_json};
use crate::model::{ContactTest, ImpactTarget, sha256_hex};
use crate::series::Rebound;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::path::Path;

/// An impact as a task for a code.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImpactRun {
    /// What the first cylinder strikes.
    pub target: ImpactTarget,
    /// The motion.
    pub test: ContactTest,
}

impl fmt::Display for ImpactRun {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (target, test) = (self.target.as_str(), &self.test);
        let restitution = test.convention.restitution;
        write!(
            formatter,
            "an impact ({target}, restitution {restitution}) in {} steps",
            test.steps
        )
    }
}

/// What was read off the motion of an impact.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImpactReading {
    /// The program that made the motion.
    pub identity: Identity,
    /// Its numbers; `None` if the bodies do not touch and part again.
    pub rebound: Option<Rebound>,
}

/// A reading with its task, as it is kept.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Kept {
    run: ImpactRun,
    reading: ImpactReading,
}

/// Reads the impact from the `text` of the result at `path`, and the program that made it.
///
/// # Errors
/// If it is malformed.
pub(super) fn read_impact(text: &[u8], path: &Path) -> Result<(ImpactRun, Identity), FileError> {
    parse_json::<Kept>(text, path).map(|kept| (kept.run, kept.reading.identity))
}

impl ImpactRun {
    fn read(&self, code: &dyn InstalledCode, context: &RunContext) -> Outcome {
        let motions = code.probe(&[self.test], context)?;
        let reading = motions.first().map(|motion| self.reading(code, motion));
        Ok(reading.unwrap_or_else(|| ImpactReading {
            identity: code.identity().clone(),
            rebound: None,
        }))
    }

    fn reading(&self, code: &dyn InstalledCode, motion: &crate::series::Motion) -> ImpactReading {
        ImpactReading {
            identity: code.identity().clone(),
            rebound: Rebound::read(motion, self.target, self.test.time_step),
        }
    }
}

type Outcome = Result<ImpactReading, Box<Failure>>;

/// Whether motions are made faster than they are read from the store, as with the native code.
fn is_faster_made(code: &dyn InstalledCode) -> bool {
    code.name().is_native()
}

impl ScheduledTask for ImpactRun {
    type Outcome = ImpactReading;

    const KIND: Kind = Kind::Impact;

    fn content_hash(&self) -> String {
        let content = serde_json::to_string(self).expect("plain data has a JSON form");
        sha256_hex(content.as_bytes())
    }

    fn steps(&self) -> u64 {
        self.test.steps
    }

    fn address(&self, code: &dyn InstalledCode) -> String {
        let deck_hash = code.name().deck_hash(&self.test);
        let parts = serde_json::json!([code.identity().deciding(), deck_hash, self, SOURCE_DIGEST]);
        sha256_hex(parts.to_string().as_bytes())
    }

    fn stored(
        &self,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<ImpactReading>, FileError> {
        if is_faster_made(code) {
            return Ok(None);
        }
        let kept = store.sealed(Self::KIND, &self.address(code), parse_json::<Kept>)?;
        let own = |kept: &Kept| kept.run == *self && kept.reading.identity == *code.identity();
        Ok(kept.filter(own).map(|kept| kept.reading))
    }

    fn keep(
        &self,
        code: &dyn InstalledCode,
        reading: &ImpactReading,
        store: &Store,
    ) -> Result<(), FileError> {
        if is_faster_made(code) {
            return Ok(());
        }
        let kept = Kept {
            run: *self,
            reading: reading.clone(),
        };
        let content = serde_json::to_string(&kept).expect("plain data has a JSON form") + "\n";
        store.put_sealed(Self::KIND, &self.address(code), &content)
    }

    fn recorded(&self, code: &Code, recorded: &Recorded) -> Result<ImpactReading, RecordedError> {
        Err(recorded.absent(code, "impact"))
    }

    /// Carries out all at once if the code can; after a failure one by one, so that the others are still carried out.
    fn carry_out(
        runs: &[Self],
        code: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<ImpactReading>,
    ) {
        let tests: Vec<ContactTest> = runs.iter().map(|run| run.test).collect();
        if runs.len() > 1
            && let Ok(motions) = code.probe(&tests, context)
        {
            for (index, (run, motion)) in runs.iter().zip(&motions).enumerate() {
                finished(index, Ok(run.reading(code, motion)));
            }
            return;
        }
        for (index, run) in runs.iter().enumerate() {
            let place = context.directory.join(format!("impact-{index}"));
            let context = RunContext {
                time_limit: context.time_limit,
                ..RunContext::new(&place, context.interrupt)
            };
            finished(index, run.read(code, &context).map_err(|failure| *failure));
        }
    }

    fn report(
        &self,
        code: &Code,
        result: Result<&ImpactReading, &Failure>,
        progress: &dyn Progress,
    ) {
        progress.finished(code, self, result.map(|_| None));
    }
}

impl Reading for ImpactReading {
    type Task = ImpactRun;

    fn of(reading: Self) -> Self {
        reading
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }
}
