//! The micro-tests of a code in the schedule: all rounds of a probe are one task.

use super::convergence::converged;
use crate::code::{Code, Failure, Finished, Identity, InstalledCode};
use crate::code::{Provenance, RunContext};
use crate::files::FileError;
use crate::model::{ContactTest, sha256_hex};
use crate::runs::{Answer, Kind, ProbeRecord, Progress, Reading, Recorded};
use crate::runs::{RecordedError, ScheduledTask, Store, probe_address};
use crate::series::Motion;
use std::path::Path;
use std::time::Instant;

/// All micro-tests that measure the convention of a code.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MicroTests;

impl std::fmt::Display for MicroTests {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("micro-tests")
    }
}

impl ScheduledTask for MicroTests {
    type Outcome = ProbeRecord;

    const KIND: Kind = Kind::Probe;

    fn content_hash(&self) -> String {
        String::new()
    }

    /// 0: the steps are too few to be worth a forecast.
    fn steps(&self) -> u64 {
        0
    }

    fn address(&self, code: &dyn InstalledCode) -> String {
        probe_address(code)
    }

    fn stored(
        &self,
        code: &dyn InstalledCode,
        store: &Store,
    ) -> Result<Option<ProbeRecord>, FileError> {
        if is_faster_made(code) {
            return Ok(None);
        }
        let record = store.sealed(Self::KIND, &self.address(code), ProbeRecord::parse)?;
        Ok(record.filter(|record| is_current(record, code.name())))
    }

    fn keep(
        &self,
        code: &dyn InstalledCode,
        record: &ProbeRecord,
        store: &Store,
    ) -> Result<(), FileError> {
        if is_faster_made(code) {
            return Ok(());
        }
        store.put_sealed(Self::KIND, &self.address(code), &record.to_json())
    }

    fn recorded(&self, code: &Code, recorded: &Recorded) -> Result<ProbeRecord, RecordedError> {
        recorded.probe(code)
    }

    fn carry_out(
        tasks: &[Self],
        code: &dyn InstalledCode,
        context: &RunContext,
        finished: Finished<ProbeRecord>,
    ) {
        for index in 0..tasks.len() {
            finished(index, ask(code, context).map_err(|failure| *failure));
        }
    }

    fn report(&self, code: &Code, result: Result<&ProbeRecord, &Failure>, progress: &dyn Progress) {
        let seconds = result.map(|record| Some(record.provenance.seconds));
        progress.finished(code, self, seconds);
    }
}

impl Reading for ProbeRecord {
    type Task = MicroTests;

    fn of(record: ProbeRecord) -> Self {
        record
    }

    fn identity(&self) -> &Identity {
        &self.provenance.identity
    }
}

/// Whether making the answers is faster than reading them from the store, as for the native code, whose answers
/// depend on all of tristack.
fn is_faster_made(code: &dyn InstalledCode) -> bool {
    code.name().is_native()
}

/// Whether `record` answers everything that is asked today, as it is asked today.
fn is_current(record: &ProbeRecord, name: &Code) -> bool {
    if record.outdated(|test| name.deck_hash(test)).is_some() {
        return false;
    }
    let answered = |tests: &[ContactTest]| record.answer(tests).ok_or(());
    converged(&name.declaration(), answered, |_| false).is_ok()
}

/// Carries out the micro-tests with `code`, at as many time steps as it takes, each round in a directory of its own.
pub(crate) fn ask(
    code: &dyn InstalledCode,
    context: &RunContext,
) -> Result<ProbeRecord, Box<Failure>> {
    let start = Instant::now();
    let name = code.name();
    let mut answers: Vec<Answer> = Vec::new();
    let mut round = 0;
    let run = |tests: &[ContactTest]| {
        round += 1;
        let place = context.directory.join(format!("round-{round}"));
        let known = |test: &ContactTest, answers: &[Answer]| {
            let own = answers.iter().find(|own| own.test == *test);
            own.map(|own| own.motion.clone())
        };
        // A test with two time steps is the same as another one with one.
        let unknown = tests.iter().filter(|test| known(test, &answers).is_none());
        let unknown: Vec<ContactTest> = unknown.copied().collect();
        let motions = carry_out(code, &unknown, &place, context)?;
        let made = unknown.iter().zip(motions).map(|(test, motion)| Answer {
            test: *test,
            input_hash: name.deck_hash(test),
            motion,
        });
        answers.extend(made);
        let motions = tests.iter().filter_map(|test| known(test, &answers));
        Ok::<_, Box<Failure>>(motions.collect())
    };
    // What a code has answered is not lost if it fails at shorter steps, and files that were made elsewhere may answer
    // the first micro-tests alone.
    converged(&name.declaration(), run, |failure| {
        !failure.is_interrupted()
    })?;
    let command = vec!["tristack".to_owned(), "probe".to_owned()];
    let steps = answers.iter().map(|answer| answer.test.steps).sum();
    let seconds = start.elapsed().as_secs_f64();
    let inputs: Vec<&str> = answers.iter().map(|one| one.input_hash.as_str()).collect();
    let hash = sha256_hex(inputs.concat().as_bytes());
    Ok(ProbeRecord {
        provenance: Provenance::now(code.identity().clone(), hash, command, steps, seconds),
        answers,
    })
}

/// Carries out `tests` at a `place`; those in the plane come first. Each kind has a deck of its own, and is carried out at
/// the same time as the other one where a worker is free.
fn carry_out(
    code: &dyn InstalledCode,
    tests: &[ContactTest],
    place: &Path,
    context: &RunContext,
) -> Result<Vec<Motion>, Box<Failure>> {
    let (in_the_plane, in_space) =
        tests.split_at(tests.partition_point(|test| test.space.is_none()));
    let (time_limit, interrupt) = (context.time_limit, context.interrupt);
    let motions = |tests: &[ContactTest], place: &Path| match tests.is_empty() {
        true => Ok(Vec::new()),
        false => {
            let context = RunContext {
                time_limit,
                ..RunContext::new(place, interrupt)
            };
            code.probe(tests, &context)
        }
    };
    let (in_the_plane, in_space) = rayon::join(
        || motions(in_the_plane, place),
        || motions(in_space, &place.join("in-space")),
    );
    let mut motions = in_the_plane?;
    motions.extend(in_space?);
    Ok(motions)
}
