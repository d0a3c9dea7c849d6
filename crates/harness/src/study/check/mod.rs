//! The check of a code's folder before anything is judged: mandatory items, then consistency, then information.
//!
//! A failure is explained by computing: the twin, a second DEM, makes a mistake on purpose, or its right series is
//! written wrongly, and the result is compared with what the code has written.

mod diagnosis;
mod equations;
mod event;
mod events;
mod evidence;
mod factor;
mod first_force;
mod information;
mod invariances;
mod micro;
mod numbers;
mod reaction;
mod report;
mod rigid;
mod search;
mod spheres;
mod stack;
mod table;
mod terms;
mod touching;
mod transformed;
mod twin;
mod unreadable;
mod written;

pub use report::{Grade, Item, Outcome, Report};

use super::convention::ask;
use super::yield_force::{largest_levers, planned_protocol};
use crate::code::{
    Code, Failure, InstalledCode, Run, RunContext, TaskKind, folder_argument, keep_evidence,
};
use crate::files::{Scratch, temporary};
use crate::model::{
    Arrangement, Case, ContactConvention, Power, Problem, Stack, shell_quoted, shown,
};
use crate::theory::quasistatic_limit;
use information::{information, same_bits};
use micro::Micro;
use std::io;
use std::path::Path;
use unreadable::{UNSTABLE, explained, not_by_step};

/// Friction and stiffness of the stack that is compressed: soft, so that every convention shows, and above the
/// critical friction.
const FRICTION: f64 = 0.3;
const STIFFNESS: f64 = 100.0;
/// Wall speed in the unit of planned measurements ([`planned_protocol`]): twice the fastest of them.
const SPEED: f64 = 4e-3;
const TIME_STEP: f64 = 0.1;
/// By how much the time step is shortened to see whether it is the cause of an explosion.
const FINER: f64 = 8.0;
/// The item on the run of a stack.
const STACK: &str = "task stack";
/// Why it is not tested, if it is not.
const NO_STACK: &str = "the manifest has no task `stack`: the code can have a passport and impacts, but no yield force, \
                        until code.toml has a table `[tasks.stack]` (docs/your-own-code.md)";
/// Prefix of the name of the directory that keeps the runs of a failed check.
const EVIDENCE: &str = "tristack-check-";

/// Returns the case by which a code with this `convention` is checked.
///
/// # Panics
/// Never: where springs turn the stack yields.
pub fn case(convention: ContactConvention) -> Case {
    let stack = Stack {
        stiffness_ratio: Stack::usual_stiffness_ratio(convention.law.power),
        ..Stack::paper(FRICTION, STIFFNESS)
    };
    let protocol = |planned_by: &ContactConvention| {
        let limit = quasistatic_limit(&Problem::new(stack, *planned_by).ok()?);
        let levers = largest_levers(&limit, planned_by);
        let longest = stack.longest_time_step(planned_by) / levers.sqrt();
        let mut time_step = TIME_STEP;
        while time_step > longest {
            time_step *= 0.5;
        }
        planned_protocol(&limit, &stack, planned_by, SPEED, time_step)
    };
    let own = protocol(&convention).or_else(|| protocol(&ContactConvention::TURNING));
    Case {
        stack,
        convention,
        protocol: own.expect("the stack yields where springs turn"),
    }
}

/// Checks `code`, whose folder is `folder`. All runs are made anew, below a temporary directory, and otherwise in the
/// way of `context`.
///
/// # Errors
/// If there is no place for the runs.
pub fn check(code: &Code, folder: &str, context: &RunContext) -> io::Result<Report> {
    let place = Scratch::new()?;
    let mut check = Check {
        code: code.clone(),
        context,
        report: Report::default(),
        directory: place.path(),
    };
    let completed = check.go_through();
    let folder = &folder_argument(folder);
    let mut report = check.report;
    report.next = match completed.is_some() && report.failed_grade().is_none() {
        true => judged_by(code, folder),
        false => format!("mend the first failure, then: tristack check {folder}"),
    };
    if completed.is_none() && !context.interrupt.requested() {
        keep(&place, &mut report)?;
    }
    Ok(report)
}

/// Checks whether motions in which contacts come and go look the same elsewhere, by an installed `code`, in the plane or
/// `in_space`.
///
/// # Errors
/// If the code fails.
pub fn seen_elsewhere(
    code: &dyn InstalledCode,
    in_space: bool,
    context: &RunContext,
) -> Result<Item, Box<Failure>> {
    invariances::of_code(code, in_space, context).map(|seen| seen.item)
}

/// Keeps the runs of a failed check with their output, and names the kept directory in the items of `report`.
fn keep(place: &Scratch, report: &mut Report) -> io::Result<()> {
    let kept = temporary(EVIDENCE.as_ref()).tempdir()?;
    std::fs::rename(place.path(), kept.path())?;
    let [from, to] = [place.path(), kept.path()].map(|path| path.display().to_string());
    for item in &mut report.items {
        item.found = item.found.replace(&from, &to);
    }
    keep_evidence(kept);
    Ok(())
}

/// Returns the command that judges `code`, whose folder a shell is given as `folder`.
fn judged_by(code: &Code, folder: &str) -> String {
    if code.is_rigid() {
        return format!("tristack crosscheck --codes {folder}");
    }
    let runs = |kind| code.check_task(kind).is_ok();
    let power = match code.law().power {
        Power::Linear => Some(""),
        Power::Hertz => Some("--law hertz "),
        _ => None,
    };
    match power {
        Some(law) if runs(TaskKind::Stack) => format!("tristack crosscheck {law}--codes {folder}"),
        Some(law) if runs(TaskKind::Spheres) => {
            format!("tristack crosscheck --bodies 3 {law}--codes {folder}")
        }
        _ if runs(TaskKind::Motion) => format!("tristack probe --codes {folder}"),
        _ => format!("add a task `motion` or `stack` to code.toml, then: tristack check {folder}"),
    }
}

/// A check in progress.
struct Check<'a> {
    code: Code,
    context: &'a RunContext<'a>,
    report: Report,
    directory: &'a Path,
}

impl Check<'_> {
    /// Adds all items; returns `None` if a failure makes the rest pointless.
    fn go_through(&mut self) -> Option<()> {
        self.manifest();
        let installed = self.program()?;
        if self.code.is_rigid() {
            return self.rigid(installed.as_ref());
        }
        let declared = self.code.declaration().convention;
        let case = case(declared);
        let run = match self.code.check_task(TaskKind::Stack) {
            Ok(()) => {
                let Some(run) = self.stack(installed.as_ref(), &case) else {
                    self.explain_explosion(installed.as_ref(), &case);
                    return None;
                };
                Some(run)
            }
            Err(_) => {
                self.add(Item::not_tested(Grade::Mandatory, STACK, NO_STACK));
                None
            }
        };
        let micro = self.micro_tests(installed.as_ref())?;
        let finer = |case: &Case| {
            let run = self.run(installed.as_ref(), case, "finer")?;
            Some(run.series)
        };
        let stack = run.as_ref().map(|run| (&run.series, &case));
        let compared = diagnosis::items(stack, declared, micro.as_ref(), &finer);
        self.report.items.extend(compared);
        let is_late = micro.as_ref().is_some_and(Micro::forces_are_late);
        self.spheres_elsewhere(installed.as_ref());
        self.spheres(installed.as_ref(), is_late);
        if let Some(run) = &run {
            let again = self.run(installed.as_ref(), &case, "again");
            self.add(same_bits(
                &run.series,
                again.as_ref().map(|run| &run.series),
            ));
        }
        self.report
            .items
            .extend(information(&self.code, micro.as_ref()));
        Some(())
    }

    fn add(&mut self, item: Item) {
        self.report.items.push(item);
    }

    fn manifest(&mut self) {
        let kinds = [
            TaskKind::Rigid,
            TaskKind::Stack,
            TaskKind::Motion,
            TaskKind::Spheres,
            TaskKind::SpheresMotion,
        ];
        let own = kinds
            .into_iter()
            .filter(|kind| self.code.check_task(*kind).is_ok());
        let tasks: Vec<&str> = own.map(TaskKind::as_str).collect();
        let tasks = tasks.join(", ");
        let found = format!("{} ({}): tasks {tasks}", self.code, self.code.title());
        self.add(Item::passed(Grade::Mandatory, "manifest", found));
    }

    /// Finds the program, which must say its version, and the same one twice.
    fn program(&mut self) -> Option<Box<dyn InstalledCode>> {
        const NAME: &str = "program";
        let expected = "a program that starts and says its version";
        let fail = |found: String, causes: Vec<String>| {
            Item::failed(Grade::Mandatory, NAME, expected, found, causes)
        };
        let Some(installed) = self.code.find() else {
            if let Some(file) = self.code.not_executable() {
                let found = format!("{} is there, but it is not executable", shown(&file));
                let permit = shell_quoted(&shown(&file));
                let causes = vec![format!(
                    "its permission to be executed is not set: chmod +x {permit}"
                )];
                self.add(fail(found, causes));
                return None;
            }
            let hint = self.code.installation_hint();
            let places = self.code.places();
            let found = format!("the first word of `command` names no program {places}");
            let causes = vec![
                format!("it is not installed; `install` of code.toml says: {hint}"),
                "its name is misspelt, or it is a file of the folder: files are given as {deck}, to an interpreter".to_owned(),
            ];
            self.add(fail(found, causes));
            return None;
        };
        if let Some(reason) = installed.broken() {
            let causes = vec![
                "`version.arguments` make it do something else than print its version".to_owned(),
            ];
            self.add(fail(reason.to_owned(), causes));
            return None;
        }
        let versions = [&installed, &self.code.find()?].map(|own| own.identity().version.clone());
        if versions[0] != versions[1] {
            let found = format!("asked twice, it says {} and {}", versions[0], versions[1]);
            let causes = vec!["the first line that it prints holds a date, a counter or a path: `version.before` is the \
                               text in front of the version in that line".to_owned()];
            self.add(fail(found, causes));
            return None;
        }
        let [version, _] = versions;
        self.add(match version.as_str() {
            "unknown" => Item::remark(
                Grade::Mandatory,
                NAME,
                "its version is unknown: runs of different versions are kept apart by the hash of the program alone; \
                 `version = { arguments = [...], before = \"...\" }` in [program] asks for it",
            ),
            version => Item::passed(Grade::Mandatory, NAME, format!("version {version}")),
        });
        Some(installed)
    }

    /// Runs a small stack, whose result must be complete.
    fn stack(&mut self, installed: &dyn InstalledCode, case: &Case) -> Option<Run> {
        let outcome = self.try_run(installed, case, "stack");
        match outcome {
            Ok(run) => {
                let rows = run.series.samples().len();
                let found = format!(
                    "{rows} rows at the steps asked for, {} steps in {:.2} s",
                    case.total_steps(),
                    run.provenance.seconds
                );
                self.add(Item::passed(Grade::Mandatory, STACK, found));
                Some(run)
            }
            Err(failure) => {
                self.fail(STACK, failure.as_deref(), Some(case));
                None
            }
        }
    }

    /// Runs a sphere on three, if the code has a task for it: as it is, turned, mirrored and renumbered.
    fn spheres(&mut self, installed: &dyn InstalledCode, is_late: bool) {
        const NAME: &str = "task spheres";
        let usual = spheres::case(self.code.declaration().convention, Arrangement::default());
        let Some(case) = usual.filter(|_| self.code.check_task(TaskKind::Spheres).is_ok()) else {
            return;
        };
        let run = match self.try_run(installed, &case, "spheres") {
            Ok(run) => run,
            Err(failure) => return self.fail(NAME, failure.as_deref(), Some(&case)),
        };
        let seconds = run.provenance.seconds;
        self.add(Item::passed(
            Grade::Consistency,
            NAME,
            format!("{} steps in {seconds:.2} s", case.total_steps()),
        ));
        let is_declared = self.code.declaration().left_out.is_empty();
        let items = spheres::items(&run.series, &case, is_declared, is_late);
        self.report.items.extend(items);
        for (name, arrangement) in spheres::OTHERS {
            let Some(other) = spheres::case(self.code.declaration().convention, arrangement) else {
                continue;
            };
            match self.try_run(installed, &other, name) {
                Ok(seen) => self.add(spheres::seen_from_elsewhere(
                    name,
                    (&seen.series, &other),
                    (&run.series, &case),
                )),
                Err(failure) => self.fail(name, failure.as_deref(), Some(&other)),
            }
        }
    }

    fn fail(&mut self, name: &'static str, failure: Option<&Failure>, case: Option<&Case>) {
        let Some(failure) = failure else {
            let none = "the program ended without reporting a result".to_owned();
            return self.add(Item::failed(
                Grade::Mandatory,
                name,
                "a complete result",
                none,
                Vec::new(),
            ));
        };
        let told = explained(failure, case);
        self.add(Item::failed(
            Grade::Mandatory,
            name,
            told.expected,
            told.found,
            told.causes,
        ));
    }

    fn try_run(
        &self,
        installed: &dyn InstalledCode,
        case: &Case,
        name: &str,
    ) -> Result<Run, Option<Box<Failure>>> {
        let directory = self.directory.join(name);
        let context = RunContext {
            directory: &directory,
            ..*self.context
        };
        let mut outcome = None;
        installed.run(&[*case], &context, &mut |_, result| outcome = Some(result));
        outcome.map_or(Err(None), |result| {
            result.map_err(|failure| Some(Box::new(failure)))
        })
    }

    /// Explains a stack that explodes: by whether a much shorter time step prevents it, and by what the micro-tests show,
    /// if they show anything.
    fn explain_explosion(&mut self, installed: &dyn InstalledCode, case: &Case) {
        let is_unstable = |item: &Item| {
            let mut causes = item.causes.iter();
            causes.any(|cause| cause.starts_with(UNSTABLE))
        };
        if !self.report.items.last().is_some_and(is_unstable) {
            return;
        }
        let mut fine = *case;
        fine.protocol.time_step /= FINER;
        let still = match self.try_run(installed, &fine, "stack-fine") {
            Err(Some(failure)) => not_by_step(&failure, FINER),
            _ => None,
        };
        let causes = self.causes_by_micro_tests(installed).or(still);
        if let Some((item, causes)) = self.report.items.last_mut().zip(causes) {
            item.causes = causes;
        }
    }

    /// Returns the causes that the micro-tests show for a stack without a usable result.
    fn causes_by_micro_tests(&self, installed: &dyn InstalledCode) -> Option<Vec<String>> {
        self.code.check_task(TaskKind::Motion).ok()?;
        let directory = self.directory.join("motion");
        let context = RunContext {
            directory: &directory,
            ..*self.context
        };
        let record = ask(installed, &context).ok()?;
        let causes = diagnosis::of_motions(&Micro::of(&self.code, record)?);
        (!causes.is_empty()).then_some(causes)
    }

    fn run(&self, installed: &dyn InstalledCode, case: &Case, name: &str) -> Option<Run> {
        self.try_run(installed, case, name).ok()
    }

    /// Adds to `micro` what the code does in other places.
    fn elsewhere(&mut self, installed: &dyn InstalledCode, micro: Micro) -> Micro {
        let directory = self.directory.join("elsewhere");
        let context = RunContext {
            directory: &directory,
            ..*self.context
        };
        match invariances::of_code(installed, false, &context) {
            Ok(seen) => micro.with(seen),
            Err(failure) => {
                self.fail(invariances::NAME, Some(&failure), None);
                micro
            }
        }
    }

    /// Adds what contacts of spheres do in other places.
    fn spheres_elsewhere(&mut self, installed: &dyn InstalledCode) {
        if self.code.check_task(TaskKind::SpheresMotion).is_err() {
            return;
        }
        let directory = self.directory.join("spheres-elsewhere");
        let context = RunContext {
            directory: &directory,
            ..*self.context
        };
        match invariances::of_code(installed, true, &context) {
            Ok(seen) => self.add(seen.item),
            Err(failure) => self.fail(invariances::IN_SPACE, Some(&failure), None),
        }
    }

    /// Asks the micro-tests. Returns `None` if they fail, and `Some(None)` if the code has no task for them or its
    /// answers cannot be read.
    fn micro_tests(&mut self, installed: &dyn InstalledCode) -> Option<Option<Micro>> {
        const NAME: &str = "task motion";
        if self.code.check_task(TaskKind::Motion).is_err() {
            return Some(None);
        }
        let directory = self.directory.join("motion");
        let context = RunContext {
            directory: &directory,
            ..*self.context
        };
        match ask(installed, &context) {
            Ok(record) => {
                let found = format!(
                    "{} micro-tests in {:.2} s",
                    record.answers.len(),
                    record.provenance.seconds
                );
                self.add(Item::passed(Grade::Mandatory, NAME, found));
                let micro = Micro::of(&self.code, record);
                Some(micro.map(|micro| self.elsewhere(installed, micro)))
            }
            Err(failure) => {
                self.fail(NAME, Some(&failure), None);
                None
            }
        }
    }
}

/// Returns the answers of the native DEM under this `convention` to the micro-tests in the plane.
#[cfg(test)]
fn ask_native(convention: ContactConvention) -> Vec<crate::runs::Answer> {
    let mut answers = Vec::new();
    let declared = crate::code::Declaration {
        convention,
        ..Code::native().declaration()
    };
    let run = |tests: &[crate::model::ContactTest]| {
        let motions: Vec<_> = tests
            .iter()
            .map(|test| crate::dem::run_contact_test(test).expect("it is finite"))
            .collect();
        answers.extend(
            tests
                .iter()
                .zip(&motions)
                .map(|(test, motion)| crate::runs::Answer {
                    test: *test,
                    input_hash: String::new(),
                    motion: motion.clone(),
                }),
        );
        Ok::<_, ()>(motions)
    };
    super::convention::probe(&declared, run).expect("the native DEM answers");
    answers.retain(|answer| answer.test.space.is_none());
    answers
}

/// The paper's convention, those that differ from it in every way, and laws of every power and memory.
#[cfg(test)]
fn conventions() -> Vec<ContactConvention> {
    use crate::model::{
        Arms, ContactArms, CoulombOperand, DampingGrowth, HistoryUpdate, Law, SlidingSpring,
        TangentialHistory, TangentialStiffening, TensileForce,
    };
    let mut arms = Arms::PAPER;
    (arms.pair, arms.floor) = (ContactArms::reciprocal(-0.5), ContactArms::reciprocal(-1.0));
    let other = ContactConvention {
        coulomb_operand: CoulombOperand::Spring,
        sliding_spring: SlidingSpring::FollowsLimit,
        history_update: HistoryUpdate::Projected,
        tensile_force: TensileForce::NeverPulls,
        moment_of_inertia: 0.4,
        ..ContactConvention::with_arms(arms)
    };
    let fixed = ContactConvention {
        history_update: HistoryUpdate::Fixed,
        ..other
    };
    let mut all = vec![
        ContactConvention::TURNING,
        other,
        ContactConvention::PAPER,
        fixed,
    ];
    for (place, power) in Power::ALL.into_iter().enumerate() {
        let law = Law {
            power,
            history: TangentialHistory::ALL[place % TangentialHistory::ALL.len()],
            floor_ratio: 1.3,
            floor_kappa: (place % 2 == 0).then_some(1.7),
            tangential_stiffening: TangentialStiffening::ALL[place % 3],
            damping: DampingGrowth::ALL[place % 2],
        };
        let updates = [HistoryUpdate::Fixed, HistoryUpdate::Linearised];
        let histories = updates.map(|history_update| ContactConvention {
            law,
            history_update,
            ..other
        });
        all.extend(histories);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_command_judges_the_law_of_the_code() {
        let told = |name| judged_by(&Code::named(name).expect("a code"), "mydem");
        assert_eq!(told("lammps"), "tristack crosscheck --codes mydem");
        assert_eq!(
            told("lammps-hertz"),
            "tristack crosscheck --law hertz --codes mydem"
        );
    }
}
