//! The pipeline of every study: plan runs, carry them out or take recorded ones, evaluate them, derive the verdict.

use super::convention::{
    Finding, Probed, arms_are_measured, contradictions, forces_are_late, in_single_precision,
    is_contradicted, other_program, probe_all, settled_by, step_effects,
};
use super::tolerance::MAX_TOLERANCE;
use super::verdict::{Cause, Ground, Grounds, Verdict};
use crate::code::{Code, Identity, InstalledCode, SettledCode, Unknown};
use crate::runs::{
    Outlook, Progress, Reading, RunError, SelectedCode, Settings, Workload, outlook, read_all,
};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// A study: the runs that it needs, and their evaluation.
pub trait Study {
    /// The part of each run that is kept.
    type Reading: Reading;
    /// The result of the runs.
    type Finding;

    /// The code that is judged, under the convention that the study holds it to.
    fn code(&self) -> SettledCode;

    /// Whether its result depends on `unknown`, a part of the convention of the code that is not known.
    fn depends_on(&self, _unknown: &Unknown) -> bool {
        true
    }

    /// The largest uncertainty with which its result agrees, relative to the load on the floor.
    fn resolution(&self) -> f64 {
        MAX_TOLERANCE
    }

    /// The tasks that the study needs to be carried out; those of the judged code come first.
    fn workloads(&self) -> Vec<Workload<TaskOf<Self>>>;

    /// Evaluates `runs`, which are complete and in the order of the workloads and their tasks.
    fn evaluate(&self, runs: Vec<Vec<Self::Reading>>) -> Evaluation<Self::Finding>;
}

/// The task of a study.
pub type TaskOf<S> = <<S as Study>::Reading as Reading>::Task;

/// The evaluation of a study.
pub struct Evaluation<F> {
    /// The result of the runs.
    pub finding: F,
    /// The grounds for a verdict on it.
    pub grounds: Grounds,
}

/// Whether the numbers of a row were computed now, or read from a recorded run or from files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// Run on this machine, now or earlier (from the store).
    Live,
    /// Read from the recorded runs, because the code is not installed.
    Recorded,
    /// Read from files that were made elsewhere after a plan.
    Files,
}

impl Source {
    /// The source of the runs of a code, which may be `installed`.
    fn of(installed: Option<&dyn InstalledCode>) -> Self {
        match installed {
            None => Self::Recorded,
            Some(code) if code.reads_files() => Self::Files,
            Some(_) => Self::Live,
        }
    }

    /// The word in tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Live => "live",
            Self::Recorded => "recorded",
            Self::Files => "files",
        }
    }
}

/// A study that has been carried out.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged<S, F> {
    /// The study.
    pub study: S,
    /// The code that is judged.
    pub code: Code,
    /// Its version.
    pub version: String,
    /// Where its runs come from.
    pub source: Source,
    /// Whether the probe has measured its torque arms and found them as declared.
    pub arms_are_measured: bool,
    /// The result of the runs; `None` if one of them is missing.
    pub finding: Option<F>,
    /// The grounds for a verdict on it.
    pub grounds: Grounds,
}

impl<S: Study> Judged<S, S::Finding> {
    /// Withdraws a judgement that depends on parts of the convention that neither the manifest nor the probe gives. Parts
    /// that are unknown for the same reason share a note.
    fn hold_to_settled(&mut self) {
        let code = self.study.code();
        let unknown = code.settled().unknown.iter();
        let unknown: Vec<&Unknown> = unknown.filter(|own| self.study.depends_on(own)).collect();
        for alike in unknown.chunk_by(|one, other| one.because == other.because) {
            let keys: Vec<&str> = alike.iter().map(|own| own.key.as_str()).collect();
            let are = if keys.len() == 1 { "is" } else { "are" };
            let (keys, because) = (keys.join(", "), &alike[0].because);
            self.grounds.add(Ground::NotJudged {
                note: format!(
                    "not judged: {keys} {are} left out of its manifest and not known: {because}"
                ),
                cause: Cause::NotKnown,
            });
        }
    }
}

impl<S, F> Judged<S, F> {
    /// The verdict that follows from the grounds.
    pub fn verdict(&self) -> Verdict {
        self.grounds.verdict()
    }

    /// Whether its numbers come from recorded runs.
    pub fn is_recorded(&self) -> bool {
        self.source == Source::Recorded && self.verdict() != Verdict::Missing
    }

    /// Notes that explain the verdict.
    pub fn notes(&self) -> Vec<&str> {
        self.grounds.notes()
    }

    /// Why the verdict is not `agrees`, in one line.
    pub fn reason(&self) -> String {
        self.grounds.reason()
    }
}

/// Carries out studies with the codes that take part; probes each code once, when its convention is first needed.
pub struct Campaign<'a> {
    codes: &'a [SelectedCode],
    settings: &'a Settings<'a>,
    progress: &'a dyn Progress,
    probes: OnceLock<Vec<Probed>>,
}

impl<'a> Campaign<'a> {
    /// A campaign with `codes`.
    pub fn new(
        codes: &'a [SelectedCode],
        settings: &'a Settings<'a>,
        progress: &'a dyn Progress,
    ) -> Self {
        Self {
            codes,
            settings,
            progress,
            probes: OnceLock::new(),
        }
    }

    /// The codes that take part.
    pub fn codes(&self) -> &'a [SelectedCode] {
        self.codes
    }

    /// The names of the codes.
    pub fn names(&self) -> Vec<Code> {
        self.codes
            .iter()
            .map(|selected| selected.name.clone())
            .collect()
    }

    /// The codes in order, each under its settled convention: as declared or, where its manifest leaves something
    /// out, as its probe shows.
    pub fn settled(&self) -> Vec<SettledCode> {
        let codes = self.codes.iter().enumerate();
        let settled = codes.map(|(place, selected)| {
            let declared = selected.name.as_declared();
            declared.unwrap_or_else(|| settled_by(&selected.name, &self.probes()[place]))
        });
        settled.collect()
    }

    /// How runs are carried out.
    pub fn settings(&self) -> &'a Settings<'a> {
        self.settings
    }

    /// The result of the probe of each code, in order; measured once.
    pub fn probes(&self) -> &[Probed] {
        self.probes
            .get_or_init(|| probe_all(self.codes, self.settings, self.progress))
    }

    /// The results of the probes by value.
    pub fn into_probes(self) -> Vec<Probed> {
        self.probes();
        self.probes.into_inner().unwrap_or_default()
    }

    /// Carries out `workloads` and reads each result.
    pub fn read<R: Reading>(
        &self,
        workloads: &[Workload<R::Task>],
    ) -> Vec<Vec<Result<R, RunError>>> {
        read_all(workloads, self.codes, self.settings, self.progress)
    }

    /// Like [`Self::read`] for workloads of the native code, which need not take part in the campaign.
    pub fn read_native<R: Reading>(
        &self,
        workloads: &[Workload<R::Task>],
    ) -> Vec<Vec<Result<R, RunError>>> {
        let native = [SelectedCode::find(Code::native())];
        read_all(workloads, &native, self.settings, self.progress)
    }

    /// Carries out `studies` and judges each, in order; those that an interrupt has cut short are left out.
    pub fn carry_out<S: Study>(&self, studies: Vec<S>) -> Vec<Judged<S, S::Finding>> {
        self.probes();
        let workloads: Vec<Vec<Workload<TaskOf<S>>>> = studies.iter().map(S::workloads).collect();
        let mut results = self.read(&workloads.concat()).into_iter();
        let judged = studies.into_iter().zip(workloads).map(|(study, own)| {
            let results = results.by_ref().take(own.len()).collect();
            self.judge(study, results)
        });
        judged.flatten().collect()
    }

    /// What carrying out `studies` would involve, apart from the micro-tests.
    pub fn outlook<S: Study>(&self, studies: &[S]) -> Outlook {
        let workloads: Vec<Workload<TaskOf<S>>> = studies.iter().flat_map(S::workloads).collect();
        outlook::<S::Reading>(&workloads, self.codes, self.settings)
    }

    fn judge<S: Study>(
        &self,
        study: S,
        results: Vec<Vec<Result<S::Reading, RunError>>>,
    ) -> Option<Judged<S, S::Finding>> {
        let code = study.code().name().clone();
        let place = self.codes.iter().position(|own| own.name == code);
        // Rigid bodies have no convention that a probe could measure.
        let place_of_probe = place.filter(|_| !code.is_rigid());
        let probed = place_of_probe.and_then(|place| self.probes().get(place));
        let unprobed = probed.and_then(|probed| probed.as_ref().err());
        if errors(&results).any(RunError::is_interrupted)
            || unprobed.is_some_and(|error| error.is_interrupted())
        {
            return None;
        }
        let installed = place.and_then(|place| self.codes[place].code.as_deref());
        let identities = identities(results.first());
        let mut judged = Judged {
            version: versions(&identities, installed),
            source: Source::of(installed),
            arms_are_measured: probed.is_some_and(arms_are_measured),
            study,
            code,
            finding: None,
            grounds: Grounds::new(),
        };
        match complete(results) {
            Ok(runs) => {
                let evaluation = judged.study.evaluate(runs);
                judged.finding = Some(evaluation.finding);
                judged.grounds = evaluation.grounds;
                // If nothing yields in theory, nothing is run, and there is no judgement to withdraw.
                if let Some(probed) = probed.filter(|_| !identities.is_empty()) {
                    let accepts = judged.study.resolution() > MAX_TOLERANCE;
                    judged.grounds.hold_to_probe(probed, &identities, accepts);
                    if probed.is_ok() {
                        judged.hold_to_settled();
                    }
                }
            }
            Err(missing) => {
                judged.grounds = missing;
                // A contradiction that the probe has found counts even if runs are missing.
                if let Some(probed) = probed.filter(|probed| is_contradicted(probed)) {
                    judged.grounds.hold_to_probe(probed, &identities, false);
                }
            }
        }
        Some(judged)
    }
}

fn errors<R>(results: &[Vec<Result<R, RunError>>]) -> impl Iterator<Item = &RunError> {
    let runs = results.iter().flatten();
    runs.filter_map(|run| run.as_ref().err())
}

/// The programs that made the runs of the judged code.
fn identities<R: Reading>(own: Option<&Vec<Result<R, RunError>>>) -> Vec<Identity> {
    let runs = own
        .into_iter()
        .flatten()
        .filter_map(|run| run.as_ref().ok());
    runs.map(|run| run.identity().clone()).collect()
}

/// The version of the runs, all versions if there are several, or that of the `installed` code if there are no runs.
fn versions(identities: &[Identity], installed: Option<&dyn InstalledCode>) -> String {
    let mut versions: Vec<&str> = identities.iter().map(|own| own.version.as_str()).collect();
    versions.dedup();
    if let Some(code) = installed.filter(|_| versions.is_empty()) {
        versions.push(&code.identity().version);
    }
    versions.join(", ")
}

/// All runs, or the reasons why some of them are missing.
fn complete<R>(results: Vec<Vec<Result<R, RunError>>>) -> Result<Vec<Vec<R>>, Grounds> {
    let mut grounds = Grounds::new();
    for error in errors(&results) {
        let note = error.to_string();
        grounds.add(match error {
            RunError::Failed(_) => Ground::Failed(note),
            RunError::Missing(_) | RunError::Absent(_) => Ground::Missing(note),
        });
    }
    let complete = results.into_iter().map(|own| own.into_iter().collect());
    let complete: Result<_, RunError> = complete.collect();
    complete.map_err(|_| grounds)
}

impl Grounds {
    /// Withdraws a judgement whose reference belongs to a convention that the code does not have, or is not known to
    /// have, according to `probed`. `identities` are the programs that made the runs. Where the user `accepts_coarse` numbers,
    /// what single precision or few digits leave open of the convention is no obstacle.
    fn hold_to_probe(&mut self, probed: &Probed, identities: &[Identity], accepts_coarse: bool) {
        if probed.as_ref().is_ok_and(forces_are_late) {
            self.allow_late_forces();
        }
        let single = probed.as_ref().ok().and_then(in_single_precision);
        single
            .into_iter()
            .for_each(|told| self.add(Ground::SinglePrecision(told)));
        let mut contradictions = contradictions(probed);
        let other = other_program(probed, identities.iter());
        let accepts_coarse = accepts_coarse && other.is_none();
        contradictions.extend(other);
        let Some(first) = contradictions.first() else {
            let findings = probed.iter().flat_map(|probe| &probe.findings);
            let effects = step_effects(findings);
            effects
                .into_iter()
                .for_each(|told| self.add(Ground::Remark(told)));
            return;
        };
        let further = match contradictions.len() {
            1 => String::new(),
            count => format!(" (and {} more: tristack probe)", count - 1),
        };
        let cause = cause(probed);
        let is_coarse = matches!(cause, Cause::SinglePrecision | Cause::FewDigits);
        self.add(match accepts_coarse && is_coarse {
            true => Ground::Remark(format!("{first}{further}")),
            false => Ground::NotJudged {
                note: format!("not judged: {first}{further}"),
                cause,
            },
        });
    }
}

/// The kind of reason for which a code is not judged after its probe.
fn cause(probed: &Probed) -> Cause {
    let Ok(probe) = probed else {
        return Cause::NotProbed;
    };
    let findings = &probe.findings;
    let is_open = |own: &Finding| own.declared.is_some() && own.verdict != Verdict::Agrees;
    if findings.iter().any(|own| own.other_model().is_some()) {
        Cause::AnotherModel
    } else if is_contradicted(probed) {
        Cause::Contradicted
    } else if !findings.iter().any(is_open) {
        Cause::NotProbed
    } else if !probe.single.is_empty() {
        Cause::SinglePrecision
    } else if probe.few_digits().is_some() {
        Cause::FewDigits
    } else {
        Cause::NotKnown
    }
}
