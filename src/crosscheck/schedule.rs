//! Runs the cases of all workloads on all cores, keeping each result the moment it is there.

use super::plan::Measurement;
use super::recorded::{Recorded, RecordedError};
use super::store::Store;
use crate::archive::Run;
use crate::engine::{Engine, EngineName, Failure, FailureKind, Interrupt, Workplace};
use crate::stack::Case;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use thiserror::Error;

/// How runs are carried out.
pub struct Settings<'a> {
    /// Where finished runs are kept.
    pub store: Store,
    /// The runs that stand in for engines that are not installed.
    pub recorded: Recorded,
    /// Whether to ignore what is in the store.
    pub fresh: bool,
    /// Runs at the same time.
    pub threads: usize,
    /// Longest time without a finished case; the engines' own estimate if absent.
    pub time_limit: Option<Duration>,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
}

/// An engine that takes part, installed or not.
pub struct Participant {
    /// Which one.
    pub name: EngineName,
    /// The engine itself, if it is installed.
    pub engine: Option<Box<dyn Engine>>,
}

impl Participant {
    /// `name`, as it is installed here.
    pub fn find(name: EngineName) -> Self {
        Self {
            name,
            engine: name.find(),
        }
    }
}

/// Why a run is not there.
#[derive(Debug, Error)]
pub enum RunError {
    /// The engine failed.
    #[error(transparent)]
    Failed(#[from] Box<Failure>),
    /// The engine is not installed, and no recorded run stands in.
    #[error(transparent)]
    Missing(#[from] RecordedError),
}

/// Somebody who wants to know how far it is.
pub trait Progress: Sync {
    /// `total` runs are needed, `reused` of which were there already.
    fn planned(&self, total: usize, reused: usize);
    /// One run has ended.
    fn finished(&self, engine: EngineName, case: &Case, result: Result<&Run, &Failure>);
    /// Something went wrong that does not touch the results.
    fn warn(&self, message: &str);
}

/// Cases that one engine is to run.
pub trait Workload: Sync {
    /// Who runs them.
    fn engine(&self) -> EngineName;
    /// The cases.
    fn cases(&self) -> &[Case];
}

impl Workload for Measurement {
    fn engine(&self) -> EngineName {
        self.engine
    }

    fn cases(&self) -> &[Case] {
        &self.cases
    }
}

/// One case of one workload.
#[derive(Clone, Copy)]
struct Task {
    workload: usize,
    case: usize,
}

type Slot<T> = Mutex<Option<Result<T, RunError>>>;

/// What `keep` makes of each run, case by case, of every workload. Runs themselves are not held longer
/// than that, so that memory does not grow with their number.
pub fn run_all<W: Workload, T: Send>(
    workloads: &[W],
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
    keep: impl Fn(Run) -> T + Sync,
) -> Vec<Vec<Result<T, RunError>>> {
    let slots = workloads.iter().map(|workload| {
        let cases = workload.cases().iter();
        cases.map(|_| Slot::<T>::default()).collect()
    });
    let slots: Vec<Vec<Slot<T>>> = slots.collect();
    let floor = Floor {
        workloads,
        settings,
        progress,
        keep,
        slots,
    };
    let jobs = floor.jobs(participants);
    floor.work_off(&jobs);
    let results = floor.slots.into_iter().map(|slots| {
        let results = slots
            .into_iter()
            .map(|slot| slot.into_inner().unwrap_or(None));
        results
            .map(|result| result.expect("every task reports"))
            .collect()
    });
    results.collect()
}

/// Tasks for one call of one engine.
struct Job<'a> {
    engine: &'a dyn Engine,
    tasks: Vec<Task>,
}

/// Everything the workers share.
struct Floor<'a, W, T, Keep> {
    workloads: &'a [W],
    settings: &'a Settings<'a>,
    progress: &'a dyn Progress,
    keep: Keep,
    slots: Vec<Vec<Slot<T>>>,
}

impl<W: Workload, T: Send, Keep: Fn(Run) -> T + Sync> Floor<'_, W, T, Keep> {
    fn case(&self, task: Task) -> &Case {
        &self.workloads[task.workload].cases()[task.case]
    }

    fn fill(&self, task: Task, result: Result<Run, RunError>) {
        if let Ok(mut slot) = self.slots[task.workload][task.case].lock() {
            *slot = Some(result.map(&self.keep));
        }
    }

    /// Fills the slots of what is there already, and packs the rest into jobs.
    fn jobs<'b>(&self, participants: &'b [Participant]) -> Vec<Job<'b>> {
        let mut jobs = Vec::new();
        let (mut total, mut missing) = (0, 0);
        for participant in participants {
            let tasks = self.tasks_of(participant.name);
            total += tasks.len();
            let Some(engine) = participant.engine.as_deref() else {
                self.use_recorded(participant.name, &tasks);
                continue;
            };
            let open = self.without_stored(engine, tasks);
            missing += open.len();
            let in_one_call = if engine.prefers_many_cases() {
                open.len()
                    .div_ceil(self.settings.threads.div_ceil(participants.len()))
            } else {
                1
            };
            let chunks = open.chunks(in_one_call.max(1));
            jobs.extend(chunks.map(|tasks| Job {
                engine,
                tasks: tasks.to_vec(),
            }));
        }
        self.progress.planned(total, total - missing);
        jobs.sort_by_key(|job| std::cmp::Reverse(self.steps(job)));
        jobs
    }

    fn tasks_of(&self, engine: EngineName) -> Vec<Task> {
        let own = self.workloads.iter().enumerate();
        own.filter(|(_, workload)| workload.engine() == engine)
            .flat_map(|(index, workload)| {
                let cases = 0..workload.cases().len();
                cases.map(move |case| Task {
                    workload: index,
                    case,
                })
            })
            .collect()
    }

    fn steps(&self, job: &Job) -> u64 {
        let steps = |&task: &Task| self.case(task).total_steps();
        job.tasks.iter().map(steps).sum()
    }

    fn use_recorded(&self, engine: EngineName, tasks: &[Task]) {
        for &task in tasks {
            let run = self.settings.recorded.get(engine, self.case(task));
            self.fill(task, run.map_err(RunError::from));
        }
    }

    /// Fills the slots of the tasks whose runs are in the store, and returns the others.
    fn without_stored(&self, engine: &dyn Engine, tasks: Vec<Task>) -> Vec<Task> {
        if self.settings.fresh {
            return tasks;
        }
        let mut open = Vec::new();
        for task in tasks {
            let case = self.case(task);
            let deck_hash = engine.name().deck_hash(case);
            match self.settings.store.get(engine.identity(), case, &deck_hash) {
                Ok(Some(run)) => self.fill(task, Ok(run)),
                Ok(None) => open.push(task),
                Err(error) => {
                    self.progress
                        .warn(&format!("damaged run in the store, computed anew: {error}"));
                    open.push(task);
                }
            }
        }
        open
    }

    fn work_off(&self, jobs: &[Job]) {
        let next = AtomicUsize::new(0);
        let workers = self.settings.threads.min(jobs.len());
        std::thread::scope(|scope| {
            for _ in 0..workers {
                scope.spawn(|| {
                    while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
                        self.carry_out(job);
                    }
                });
            }
        });
    }

    fn carry_out(&self, job: &Job) {
        if self.settings.interrupt.requested() {
            return self.fail_all(job, || FailureKind::Interrupted);
        }
        let cases: Vec<Case> = job.tasks.iter().map(|&task| *self.case(task)).collect();
        let root = self.settings.store.work_directory();
        let prefix = format!("{}-", job.engine.name());
        let directory = match tempfile::Builder::new().prefix(&prefix).tempdir_in(&root) {
            Ok(directory) => directory,
            Err(error) => {
                let message = error.to_string();
                let start = || FailureKind::Start(std::io::Error::other(message.clone()));
                return self.fail_all(job, start);
            }
        };
        let workplace = Workplace {
            directory: directory.path(),
            time_limit: self.settings.time_limit,
            interrupt: self.settings.interrupt,
        };
        let mut evidence = false;
        job.engine.run(&cases, &workplace, &mut |index, result| {
            evidence |= result.as_ref().is_err_and(Failure::left_evidence);
            self.accept(job, index, result);
        });
        if evidence {
            let _ = directory.keep();
        }
    }

    fn accept(&self, job: &Job, index: usize, result: Result<Run, Failure>) {
        let task = job.tasks[index];
        if let Ok(run) = &result
            && let Err(error) = self.settings.store.put(run)
        {
            self.progress
                .warn(&format!("a finished run could not be kept: {error}"));
        }
        self.progress
            .finished(job.engine.name(), self.case(task), result.as_ref());
        self.fill(task, result.map_err(|failure| Box::new(failure).into()));
    }

    fn fail_all(&self, job: &Job, kind: impl Fn() -> FailureKind) {
        for index in 0..job.tasks.len() {
            let failure = Failure {
                engine: job.engine.name(),
                subject: self.case(job.tasks[index]).to_string(),
                kind: kind(),
                run_directory: None,
                last_lines: Vec::new(),
            };
            self.accept(job, index, Err(failure));
        }
    }
}
