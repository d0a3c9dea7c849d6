//! The conventions of the participants, measured before anything is judged by them.

use super::recorded::RecordedError;
use super::schedule::{Participant, Progress, Settings};
use crate::archive::{Answer, ArchiveError, ProbeRecord, Provenance};
use crate::engine::{Engine, EngineName, Failure, Workplace};
use crate::probe::{Finding, probe};
use crate::stack::{ContactTest, sha256_hex};
use crate::verdict::Verdict;
use std::time::Instant;
use thiserror::Error;

/// Why a convention has not been measured.
#[derive(Debug, Error)]
pub enum ProbeError {
    /// The engine failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
    /// The engine is not installed, and no recorded probe stands in.
    #[error(transparent)]
    Missing(#[from] RecordedError),
    /// There is no directory to work in.
    #[error(transparent)]
    Workplace(#[from] ArchiveError),
    /// The recorded answers are those to other questions.
    #[error(
        "the recorded probe of {0} answers other micro-tests than today's; refresh it with: tristack record --engines {0}"
    )]
    Outdated(EngineName),
}

/// The findings on one participant.
pub type Probed = Result<Vec<Finding>, ProbeError>;

/// Probes `participants`, as many at a time as `settings` allow, and returns the findings in their order.
pub fn probe_all(
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Probed> {
    let mut results = Vec::new();
    for group in participants.chunks(settings.threads.max(1)) {
        std::thread::scope(|scope| {
            let handles: Vec<_> = group
                .iter()
                .map(|who| scope.spawn(|| findings(who, settings, progress)))
                .collect();
            let joined = handles.into_iter().map(|handle| handle.join());
            results.extend(joined.map(|result| result.expect("a probe does not panic")));
        });
    }
    results
}

fn findings(who: &Participant, settings: &Settings, progress: &dyn Progress) -> Probed {
    let record = record_probe(who, settings, progress)?;
    let declared = who.name.declaration();
    let properties = probe(&declared, |tests| {
        record.answer(tests).ok_or(ProbeError::Outdated(who.name))
    })?;
    let version = &record.provenance.identity.version;
    let judged = properties
        .into_iter()
        .map(|property| property.judge(who.name, version));
    Ok(judged.collect())
}

/// The answers of a participant to all micro-tests: from the store, live, or recorded.
///
/// # Errors
/// If it fails, or is neither installed nor recorded.
pub fn record_probe(
    who: &Participant,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<ProbeRecord, ProbeError> {
    let Some(engine) = who.engine.as_deref() else {
        return Ok(settings.recorded.probe(who.name)?);
    };
    // The native engine answers faster than its answers are read, and all of tristack decides what they are.
    if who.name == EngineName::Native {
        return ask(engine, settings);
    }
    let address = address(engine);
    if !settings.fresh {
        match settings.store.probe(&address) {
            Ok(Some(record)) if is_current(&record, who.name) => return Ok(record),
            Ok(_) => {}
            Err(error) => {
                progress.warn(&format!("damaged probe in the store, made anew: {error}"));
            }
        }
    }
    let record = ask(engine, settings)?;
    if let Err(error) = settings.store.put_probe(&address, &record) {
        progress.warn(&format!("a finished probe could not be kept: {error}"));
    }
    Ok(record)
}

/// Whether `record` answers everything that is asked today, as it is asked today.
fn is_current(record: &ProbeRecord, name: EngineName) -> bool {
    if record.outdated(|test| name.probe_hash(test)).is_some() {
        return false;
    }
    let answered = |tests: &[ContactTest]| record.answer(tests).ok_or(());
    probe(&name.declaration(), answered).is_ok()
}

/// Content address of the probe of an engine: who it is, and which deck it is given.
fn address(engine: &dyn Engine) -> String {
    let parts = serde_json::json!([engine.identity(), engine.name().static_probe_hash()]);
    sha256_hex(parts.to_string().as_bytes())
}

fn ask(engine: &dyn Engine, settings: &Settings) -> Result<ProbeRecord, ProbeError> {
    let start = Instant::now();
    let work = settings.store.work_directory();
    let prefix = format!("{}-probe-", engine.name());
    let directory = tempfile::Builder::new()
        .prefix(&prefix)
        .tempdir_in(&work)
        .map_err(ArchiveError::writing(&work))?;
    let name = engine.name();
    let mut answers: Vec<Answer> = Vec::new();
    let mut round = 0;
    let answered = probe(&name.declaration(), |tests| {
        round += 1;
        let place = directory.path().join(format!("round-{round}"));
        let workplace = Workplace {
            directory: &place,
            time_limit: settings.time_limit,
            interrupt: settings.interrupt,
        };
        let motions = engine.probe(tests, &workplace)?;
        answers.extend(tests.iter().zip(&motions).map(|(test, motion)| Answer {
            test: *test,
            told_hash: name.probe_hash(test),
            motion: motion.clone(),
        }));
        Ok(motions)
    });
    if let Err(failure) = answered {
        let failure: Box<Failure> = failure;
        if failure.left_evidence() {
            let _ = directory.keep();
        }
        return Err(failure.into());
    }
    let command = vec!["tristack".to_owned(), "probe".to_owned()];
    let steps = answers.iter().map(|answer| answer.test.steps).sum();
    let seconds = start.elapsed().as_secs_f64();
    let told: Vec<&str> = answers.iter().map(|one| one.told_hash.as_str()).collect();
    let hash = sha256_hex(told.concat().as_bytes());
    Ok(ProbeRecord {
        provenance: Provenance::now(engine.identity().clone(), hash, command, steps, seconds),
        answers,
    })
}

/// The findings that are no agreement, one line each; what is unknown as well if the probe failed.
pub fn contradictions(probed: &Probed) -> Vec<String> {
    match probed {
        Err(error) => vec![format!(
            "its contact convention could not be measured: {error}"
        )],
        Ok(findings) => {
            let contradicting = findings
                .iter()
                .filter(|finding| finding.verdict != Verdict::Agrees);
            contradicting
                .map(|finding| {
                    let measured = finding
                        .measured
                        .map_or_else(|| "unknown".to_owned(), |value| format!("{value:.9}"));
                    format!(
                        "its probe contradicts its declaration: {} is {measured}, declared {}",
                        finding.property, finding.declared
                    )
                })
                .collect()
        }
    }
}
