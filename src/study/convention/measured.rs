//! The conventions of the codes, measured before anything is judged by them.

use super::finding::Finding;
use super::probe::probe;
use crate::code::{Code, Failure, InstalledCode, RunContext, TaskKind, keep_evidence};
use crate::code::{Identity, Provenance};
use crate::files::FileError;
use crate::model::{ContactTest, sha256_hex, shown};
use crate::runs::{Answer, ProbeRecord, in_parallel};
use crate::runs::{Progress, RecordedError, SelectedCode, Settings};
use crate::study::Verdict;
use std::time::Instant;
use thiserror::Error;

/// Why a convention has not been measured.
#[derive(Debug, Error)]
pub enum ProbeError {
    /// The code failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
    /// The code is not installed, and no recorded probe stands in.
    #[error(transparent)]
    Missing(#[from] RecordedError),
    /// There is no directory to work in.
    #[error(transparent)]
    RunContext(#[from] FileError),
    /// The recorded answers are those to other questions.
    #[error(
        "the recorded probe of {0} answers other micro-tests than today's; refresh it with: tristack record --codes {0}"
    )]
    Outdated(Code),
}

impl ProbeError {
    /// Whether nothing is wrong but that the user did not want to wait.
    pub(crate) fn is_interrupted(&self) -> bool {
        matches!(self, Self::Failed(failure) if failure.is_interrupted())
    }
}

/// What was found out about a program.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// The program that was probed.
    pub identity: Identity,
    /// Its properties.
    pub findings: Vec<Finding>,
}

/// The findings on one selected.
pub type Probed = Result<Findings, ProbeError>;

/// Probes `codes`, as many at a time as `settings` allow, and returns the findings in their order.
pub fn probe_all(
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Probed> {
    in_parallel(codes, settings.threads, |who| {
        findings(who, settings, progress)
    })
}

fn findings(who: &SelectedCode, settings: &Settings, progress: &dyn Progress) -> Probed {
    let record = record_probe(who, settings, progress)?;
    let declared = who.name.declaration();
    let properties = probe(&declared, |tests| {
        record.answer(tests).ok_or(ProbeError::Outdated(who.name))
    })?;
    let version = &record.provenance.identity.version;
    let judged = properties
        .into_iter()
        .map(|property| property.judge(who.name, version));
    Ok(Findings {
        findings: judged.collect(),
        identity: record.provenance.identity.clone(),
    })
}

/// The answers of a selected to all micro-tests: from the store, live, or recorded.
///
/// # Errors
/// If it fails, or is neither installed nor recorded.
pub fn record_probe(
    who: &SelectedCode,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<ProbeRecord, ProbeError> {
    let Some(code) = who.code.as_deref() else {
        return Ok(settings.recorded.probe(who.name)?);
    };
    // The native code answers faster than its answers are read, and all of tristack decides what they are.
    if who.name == Code::NATIVE {
        return ask(code, settings);
    }
    let address = address(code);
    if !settings.fresh {
        match settings.store.probe(&address) {
            Ok(Some(record)) if is_current(&record, who.name) => return Ok(record),
            Ok(_) => {}
            Err(error) => {
                let aside = settings.store.put_aside(&address)?;
                progress.warn(&format!(
                    "damaged probe in the store, made anew: {error}; it is now {}",
                    shown(&aside)
                ));
            }
        }
    }
    let record = ask(code, settings)?;
    if let Err(error) = settings.store.put_probe(&address, &record) {
        progress.warn(&format!("a finished probe could not be kept: {error}"));
    }
    Ok(record)
}

/// Whether `record` answers everything that is asked today, as it is asked today.
fn is_current(record: &ProbeRecord, name: Code) -> bool {
    if record.outdated(|test| name.deck_hash(test)).is_some() {
        return false;
    }
    let answered = |tests: &[ContactTest]| record.answer(tests).ok_or(());
    probe(&name.declaration(), answered).is_ok()
}

/// Content address of a probe: the identity of the code and its deck.
fn address(code: &dyn InstalledCode) -> String {
    let parts = serde_json::json!([code.identity(), code.name().files_hash(TaskKind::Motion)]);
    sha256_hex(parts.to_string().as_bytes())
}

fn ask(code: &dyn InstalledCode, settings: &Settings) -> Result<ProbeRecord, ProbeError> {
    let start = Instant::now();
    let work = settings.store.work_directory();
    let prefix = format!("{}-probe-", code.name());
    let directory = tempfile::Builder::new()
        .prefix(&prefix)
        .tempdir_in(work)
        .map_err(FileError::writing(work))?;
    let name = code.name();
    let mut answers: Vec<Answer> = Vec::new();
    let mut round = 0;
    let answered = probe(&name.declaration(), |tests| {
        round += 1;
        let place = directory.path().join(format!("round-{round}"));
        let context = RunContext {
            time_limit: settings.time_limit,
            ..RunContext::new(&place, settings.interrupt)
        };
        let motions = code.probe(tests, &context)?;
        answers.extend(tests.iter().zip(&motions).map(|(test, motion)| Answer {
            test: *test,
            input_hash: name.deck_hash(test),
            motion: motion.clone(),
        }));
        Ok(motions)
    });
    if let Err(failure) = answered {
        let failure: Box<Failure> = failure;
        if failure.left_evidence() {
            keep_evidence(directory);
        }
        return Err(failure.into());
    }
    let command = vec!["tristack".to_owned(), "probe".to_owned()];
    let steps = answers.iter().map(|answer| answer.test.steps).sum();
    let seconds = start.elapsed().as_secs_f64();
    let told: Vec<&str> = answers.iter().map(|one| one.input_hash.as_str()).collect();
    let hash = sha256_hex(told.concat().as_bytes());
    Ok(ProbeRecord {
        provenance: Provenance::now(code.identity().clone(), hash, command, steps, seconds),
        answers,
    })
}

/// Whether the declaration is known to be wrong: a property that could not be measured well enough says
/// nothing.
pub fn is_contradicted(probed: &Probed) -> bool {
    let differs = |finding: &Finding| finding.verdict == Verdict::Differs;
    probed
        .as_ref()
        .is_ok_and(|probe| probe.findings.iter().any(differs))
}

/// Whether every torque arm was measured and is as declared.
pub fn arms_are_measured(probed: &Probed) -> bool {
    let Ok(probe) = probed else {
        return false;
    };
    let arms = probe.findings.iter();
    let mut arms = arms.filter(|finding| finding.property.ends_with("_arm"));
    arms.all(|finding| finding.verdict == Verdict::Agrees)
}

/// The first of the programs whose runs a probe of another program must not vouch for, if there is one.
pub fn other_program<'a>(
    probed: &Probed,
    mut runs: impl Iterator<Item = &'a Identity>,
) -> Option<String> {
    let probe = &probed.as_ref().ok()?.identity;
    let other = runs.find(|identity| *identity != probe)?;
    let code = &probe.code;
    Some(format!(
        "its probe was made with another program ({}) than its runs ({}); refresh both with: tristack record \
         --codes {code}",
        described(probe),
        described(other)
    ))
}

/// A program in one line.
fn described(identity: &Identity) -> String {
    let package = identity.package.as_deref().unwrap_or("no package");
    let hash = identity.program_hash.as_deref().unwrap_or("no program");
    let hash = hash.get(..12).unwrap_or(hash);
    format!("{} {}, {package}, {hash}", identity.code, identity.version)
}

/// The findings that are no agreement, one line each; what is unknown as well if the probe failed.
pub fn contradictions(probed: &Probed) -> Vec<String> {
    match probed {
        Err(error) => vec![format!(
            "its contact convention could not be measured: {error}"
        )],
        Ok(probe) => {
            let contradicting = probe.findings.iter();
            let contradicting = contradicting.filter(|one| one.verdict != Verdict::Agrees);
            let mut contradicting: Vec<&Finding> = contradicting.collect();
            contradicting.sort_by_key(|finding| finding.verdict != Verdict::Differs);
            contradicting
                .into_iter()
                .map(|finding| {
                    let measured = finding
                        .measured
                        .map_or_else(|| "unknown".to_owned(), |value| format!("{value:.9}"));
                    let says = match finding.verdict {
                        Verdict::Differs => "contradicts its declaration",
                        _ => "decides nothing about its declaration",
                    };
                    format!(
                        "its probe {says}: {} is {measured}, declared {}",
                        finding.property, finding.declared
                    )
                })
                .collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn probed(verdicts: &[Verdict]) -> Probed {
        let finding = |&verdict: &Verdict| Finding {
            code: Code::named("yade").unwrap(),
            version: String::new(),
            property: verdict.to_string(),
            measured: Some(1.0),
            uncertainty: Some(1.0),
            declared: 1.0,
            verdict,
        };
        Ok(Findings {
            identity: Identity {
                code: "yade".to_owned(),
                version: "1".to_owned(),
                package: None,
                program_hash: None,
            },
            findings: verdicts.iter().map(finding).collect(),
        })
    }

    #[test]
    fn only_a_property_that_differs_contradicts() {
        let unknown = probed(&[Verdict::Agrees, Verdict::Inconclusive]);
        assert!(!is_contradicted(&unknown));
        assert_eq!(contradictions(&unknown).len(), 1);
        let wrong = probed(&[Verdict::Inconclusive, Verdict::Differs]);
        assert!(is_contradicted(&wrong));
        let first = &contradictions(&wrong)[0];
        assert!(
            first.contains("contradicts its declaration: differs"),
            "{first}"
        );
        let of_arm = |verdict| {
            let mut probed = probed(&[verdict]).unwrap();
            probed.findings[0].property = "floor_torque_arm".to_owned();
            arms_are_measured(&Ok(probed))
        };
        assert!(of_arm(Verdict::Agrees) && !of_arm(Verdict::Inconclusive));
        assert!(!is_contradicted(&Err(ProbeError::Outdated(
            Code::named("yade").unwrap()
        ))));
    }

    #[test]
    fn a_probe_vouches_for_runs_of_its_own_program_alone() {
        let probed = probed(&[Verdict::Agrees]);
        let own = probed.as_ref().unwrap().identity.clone();
        assert_eq!(other_program(&probed, [&own, &own].into_iter()), None);
        let newer = Identity {
            program_hash: Some("00".to_owned()),
            ..own.clone()
        };
        let note = other_program(&probed, [&own, &newer].into_iter()).unwrap();
        assert!(note.contains("tristack record --codes yade"), "{note}");
    }
}
