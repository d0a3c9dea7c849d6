//! The conventions of the codes, measured before anything is judged by them.

use super::convergence::converged;
use super::finding::{FORCE_LAG, Finding, TOLERANCE};
use super::micro_tests::MicroTests;
use super::no_contact::{NO_CONTACT, acts_nowhere};
use super::rounding::Rounding;
use super::settled::settled;
use crate::code::{Code, ConventionKey, Declaration, Identity, Provenance, Settled, TaskKind};
use crate::model::ContactTest;
use crate::runs::{ProbeRecord, Progress, RunError, SelectedCode, Settings, Workload, read_all};
use crate::series::{ENOUGH_DIGITS, EXACT_DIGITS};
use crate::study::Verdict;
use thiserror::Error;

/// Why a convention has not been measured.
#[derive(Debug, Error)]
pub enum ProbeError {
    /// The code failed, or it is not installed and no recorded probe stands in.
    #[error(transparent)]
    Unanswered(#[from] RunError),
    /// The recorded answers are those to other micro-tests.
    #[error(
        "the recorded probe of {0} answers other micro-tests than today's; refresh it with: tristack record --codes {0}"
    )]
    Outdated(Code),
    /// The manifest has no micro-tests.
    #[error("`tasks.motion` is absent from its manifest{}", not_stated(.0))]
    NoMicroTests(Code),
}

/// Names the keys of the convention that the manifest does not state either.
fn not_stated(code: &Code) -> String {
    let keys = code.declaration().left_out;
    let keys: Vec<&str> = keys.into_iter().map(ConventionKey::as_str).collect();
    match keys.len() {
        0 => String::new(),
        1 => format!(", and {} is not stated there", keys[0]),
        _ => format!(", and not stated there are {}", keys.join(", ")),
    }
}

impl ProbeError {
    /// Whether nothing is wrong except that the user interrupted it.
    pub(crate) fn is_interrupted(&self) -> bool {
        matches!(self, Self::Unanswered(error) if error.is_interrupted())
    }
}

/// What was found out about a program.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// The origin of its answers.
    pub provenance: Provenance,
    /// Its properties.
    pub findings: Vec<Finding>,
    /// Its convention: as declared, and as measured where nothing is declared.
    pub settled: Settled,
    /// Its convention as measured, whatever is declared.
    pub measured: Settled,
    /// The number of significant digits with which it has printed the motions, if fewer than a number has.
    pub digits: Option<u32>,
    /// The quantities of its motions that are in single precision.
    pub single: Vec<&'static str>,
    /// Whether no contact acts in any of the motions, so that nothing can be measured.
    pub no_contact: bool,
}

impl Findings {
    /// The number of digits with which it has printed the motions, if too few to contradict a declaration.
    pub fn few_digits(&self) -> Option<u32> {
        self.digits.filter(|digits| are_few(*digits))
    }
}

fn are_few(digits: u32) -> bool {
    digits < ENOUGH_DIGITS
}

/// The findings on one selected code, or why there are none.
pub type Probed = Result<Findings, ProbeError>;

/// Probes `codes`, and returns the findings in their order.
pub fn probe_all(
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Probed> {
    let records = answers(codes, settings, progress).into_iter();
    let probed = codes.iter().zip(records).map(|(selected, record)| {
        let code = &selected.name;
        let missing = || ProbeError::NoMicroTests(code.clone());
        read_probe(code, record.ok_or_else(missing)??)
    });
    probed.collect()
}

/// The answers of those of `codes` that have micro-tests: from the store, live, or recorded.
pub fn probe_records(
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Result<ProbeRecord, RunError>> {
    let records = answers(codes, settings, progress);
    records.into_iter().flatten().collect()
}

/// The answers of each of `codes`; `None` for one without micro-tests.
fn answers(
    codes: &[SelectedCode],
    settings: &Settings,
    progress: &dyn Progress,
) -> Vec<Option<Result<ProbeRecord, RunError>>> {
    let workloads = codes.iter().map(|selected| {
        let code = selected.name.clone();
        let able = code.check_task(TaskKind::Motion).is_ok();
        let tasks = if able { vec![MicroTests] } else { Vec::new() };
        Workload { code, tasks }
    });
    let workloads: Vec<Workload<MicroTests>> = workloads.collect();
    let records = read_all(&workloads, codes, settings, progress);
    records
        .into_iter()
        .map(|own| own.into_iter().next())
        .collect()
}

/// Reads the findings on `code` off its answers to all micro-tests.
///
/// # Errors
/// If they are answers to other micro-tests than today's.
pub fn read_probe(code: &Code, record: ProbeRecord) -> Probed {
    let declaration = code.declaration();
    let answered = |tests: &[ContactTest]| {
        let answer = record.answer(tests);
        answer.ok_or(ProbeError::Outdated(code.clone()))
    };
    // Answers that were recorded, or made elsewhere, may be those to the first micro-tests alone.
    let properties = converged(&declaration, answered, |_| true)?;
    let nothing = Declaration {
        left_out: ConventionKey::ALL.into(),
        ..declaration.clone()
    };
    let measured = settled(&nothing, &properties);
    let settled = settled(&declaration, &properties);
    let version = &record.provenance.identity.version;
    let motions = record.answers.iter().map(|answer| &answer.motion);
    // The longest numbers count: some motions are so simple that their numbers are short.
    let rounding = Rounding::of(&motions.collect::<Vec<_>>());
    let settled = Settled {
        has_single_positions: rounding.has_single_positions(),
        ..settled
    };
    let digits = Some(rounding.digits).filter(|digits| *digits < EXACT_DIGITS);
    let no_contact = acts_nowhere(&record.answers);
    let properties = properties.into_iter();
    let findings = properties.map(|property| {
        let finding = property.judge(code, version);
        match digits.is_some_and(are_few) {
            true => undecided(finding),
            false => finding,
        }
    });
    Ok(Findings {
        findings: findings.collect(),
        settled,
        measured,
        provenance: record.provenance,
        digits,
        single: rounding.single_quantities(),
        no_contact,
    })
}

/// `finding` with a disagreement made inconclusive, since rounding may explain it.
fn undecided(finding: Finding) -> Finding {
    let verdict = match finding.verdict {
        Verdict::Differs => Verdict::Inconclusive,
        other => other,
    };
    Finding { verdict, ..finding }
}

/// Whether the declaration is known to be wrong. A property that could not be measured well enough does not count.
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

/// Whether the forces that move the bodies were found to be late, by one step or less.
pub fn forces_are_late(probe: &Findings) -> bool {
    let late = |lag: f64| lag > 0.0 && lag <= 1.0 + TOLERANCE;
    let mut findings = probe.findings.iter();
    let lag = findings.find(|own| own.property == FORCE_LAG);
    lag.and_then(|own| own.measured).is_some_and(late)
}

/// Says which quantities of the motions are in single precision, if any is.
pub fn in_single_precision(probe: &Findings) -> Option<String> {
    let (last, others) = probe.single.split_last()?;
    let listed = match others {
        [] => (*last).to_owned(),
        _ => format!("{} and {last}", others.join(", ")),
    };
    Some(format!(
        "single precision: the {listed} of its micro-tests are numbers of 32 bits"
    ))
}

/// Names the first of the programs whose runs a probe of another program must not vouch for, if there is one.
pub fn other_program<'a>(
    probed: &Probed,
    mut runs: impl Iterator<Item = &'a Identity>,
) -> Option<String> {
    let probe = &probed.as_ref().ok()?.provenance.identity;
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

/// The findings that do not agree, one line each; if the probe failed, one line that says why.
pub fn contradictions(probed: &Probed) -> Vec<String> {
    match probed {
        Err(error) => vec![format!(
            "its contact convention could not be measured: {error}"
        )],
        Ok(probe) => contradicting(probe),
    }
}

/// The findings that do not agree with the declaration, one line each; one line where no contact acts.
pub fn contradicting(probe: &Findings) -> Vec<String> {
    if probe.no_contact {
        return vec![format!("its probe decides nothing: {NO_CONTACT}")];
    }
    let declared = probe.findings.iter().filter(|one| one.declared.is_some());
    let mut contradicting: Vec<&Finding> = declared
        .filter(|one| one.verdict != Verdict::Agrees)
        .collect();
    // Another model, and a stiffness that grows, explain the others, and come before them.
    contradicting.sort_by_key(|one| {
        let explains = one.other_model().is_some() || one.growth().is_some();
        (one.verdict != Verdict::Differs, !explains)
    });
    let digits = probe.few_digits().map_or_else(String::new, |digits| {
        format!(" (printed with {digits} digits)")
    });
    let line = |one: &Finding| format!("{}{digits}", contradiction(one));
    contradicting.into_iter().map(line).collect()
}

/// Says how the probe contradicts what is declared or asked for in a `finding` that does not agree.
pub fn contradiction(finding: &Finding) -> String {
    if let Some(told) = finding.other_model() {
        return format!("its probe shows another model: {told}");
    }
    // What has no key in a manifest is asked for by the task.
    let [declaration, declared_as] = match finding.key {
        Some(_) => ["its declaration", "declared"],
        None => ["what was asked for", "asked for"],
    };
    let says = match finding.verdict {
        Verdict::Differs => "contradicts",
        _ => "decides nothing about",
    };
    if let Some(growth) = finding.growth() {
        return format!("its probe {says} {declaration}: {growth}");
    }
    let open = finding
        .uncertainty
        .filter(|_| finding.verdict != Verdict::Differs);
    let open = open.map_or_else(String::new, |open| format!(" to within {open:.0e}"));
    let measured = finding.measured;
    let measured =
        measured.map_or_else(|| "unknown".to_owned(), |value| format!("{value:.9}{open}"));
    let declared = finding.declared.unwrap_or(f64::NAN);
    let property = &finding.property;
    let because = finding.unknown_because();
    let because = because.map_or_else(String::new, |because| format!(" ({because})"));
    format!(
        "its probe {says} {declaration}: {property} is {measured}, {declared_as} {declared}{because}"
    )
}

#[cfg(test)]
mod tests {
    use super::super::probe::probe;
    use super::super::rounding::with_numbers;
    use super::*;
    use crate::code::Provenance;
    use crate::code::SettledCode;
    use crate::dem::run_contact_test;
    use crate::runs::Answer;
    use crate::series::Motion;

    fn probed(verdicts: &[Verdict]) -> Probed {
        let finding = |&verdict: &Verdict| Finding {
            code: Code::named("yade").unwrap(),
            version: String::new(),
            property: verdict.to_string(),
            key: None,
            measured: Some(1.0),
            uncertainty: Some(1.0),
            declared: Some(1.0),
            step_effect: None,
            verdict,
        };
        let identity = Identity {
            code: "yade".to_owned(),
            version: "1".to_owned(),
            package: None,
            program_hash: None,
            files_hash: None,
            witness: None,
        };
        Ok(Findings {
            provenance: Provenance::now(identity, String::new(), Vec::new(), 1, 1.0),
            settled: SettledCode::native().settled().clone(),
            measured: SettledCode::native().settled().clone(),
            findings: verdicts.iter().map(finding).collect(),
            digits: None,
            single: Vec::new(),
            no_contact: false,
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
            first.contains("contradicts what was asked for: differs"),
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
        let own = probed.as_ref().unwrap().provenance.identity.clone();
        assert_eq!(other_program(&probed, [&own, &own].into_iter()), None);
        let newer = Identity {
            program_hash: Some("00".to_owned()),
            files_hash: None,
            witness: None,
            ..own.clone()
        };
        let note = other_program(&probed, [&own, &newer].into_iter()).unwrap();
        assert!(note.contains("tristack record --codes yade"), "{note}");
    }

    /// A motion with every number rounded to this many `decimals` in scientific notation.
    fn rounded(motion: &Motion, decimals: usize) -> Motion {
        with_numbers(motion, |_, value| {
            let text = format!("{value:.decimals$e}");
            text.parse().unwrap()
        })
    }

    /// The probe of a code that is as declared and prints this many `digits`.
    fn probe_with_digits(digits: usize) -> Probed {
        let code = Code::native();
        let mut answers = Vec::new();
        let properties = probe(&code.declaration(), |tests| {
            let motions = tests.iter().map(|test| {
                let motion = rounded(&run_contact_test(test).unwrap(), digits - 1);
                answers.push(Answer {
                    test: *test,
                    input_hash: String::new(),
                    motion: motion.clone(),
                });
                motion
            });
            Ok::<_, ProbeError>(motions.collect())
        });
        let judged = properties
            .unwrap()
            .into_iter()
            .map(|own| own.judge(&code, ""));
        let differing = judged.filter(|own| own.verdict == Verdict::Differs);
        assert_eq!(
            differing.count() > 0,
            digits < 13,
            "rounding shows in the properties"
        );
        let identity = Identity {
            code: code.as_str().to_owned(),
            ..Identity::native().clone()
        };
        let provenance = Provenance::now(identity, String::new(), Vec::new(), 1, 1.0);
        read_probe(
            &code,
            ProbeRecord {
                provenance,
                answers,
            },
        )
    }

    #[test]
    fn few_digits_contradict_nothing_and_are_named() {
        let probed = probe_with_digits(6);
        assert!(!is_contradicted(&probed));
        let first = &contradictions(&probed)[0];
        assert!(first.ends_with("(printed with 6 digits)"), "{first}");
        let property = &probe_with_digits(17).unwrap();
        assert_eq!(property.digits, None);
    }
}
