//! Runs the cases of all workloads on all cores, keeping each result the moment it is there.

use super::plan::Measurement;
use super::recorded::{Recorded, RecordedError};
use super::store::Store;
use crate::archive::Run;
use crate::engine::{Batching, Engine, EngineName, Failure, FailureKind, Interrupt, Workplace};
use crate::stack::Case;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
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
#[derive(Debug, Clone, Error)]
pub enum RunError {
    /// The engine failed.
    #[error(transparent)]
    Failed(Arc<Failure>),
    /// The engine is not installed, and no recorded run stands in.
    #[error(transparent)]
    Missing(Arc<RecordedError>),
}

impl RunError {
    /// Whether nobody recorded the run.
    pub(super) fn is_unrecorded(&self) -> bool {
        matches!(self, Self::Missing(error) if matches!(**error, RecordedError::Absent { .. }))
    }
}

impl From<Failure> for RunError {
    fn from(failure: Failure) -> Self {
        Self::Failed(Arc::new(failure))
    }
}

impl From<RecordedError> for RunError {
    fn from(error: RecordedError) -> Self {
        Self::Missing(Arc::new(error))
    }
}

/// Somebody who wants to know how far it is.
pub trait Progress: Sync {
    /// `total` runs are needed, `reused` of which were there already; the others will take `seconds` of all
    /// cores together, about.
    fn planned(&self, total: usize, reused: usize, seconds: f64);
    /// What was to take so many of these seconds is done.
    fn advanced(&self, seconds: f64);
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

/// One run: however many workloads want it, it is made once.
struct Order<'a> {
    engine: EngineName,
    case: &'a Case,
    /// Steps of which [`Progress`] has been told.
    told: AtomicU64,
}

impl<'a> Order<'a> {
    fn new(engine: EngineName, case: &'a Case) -> Self {
        Self {
            engine,
            case,
            told: AtomicU64::new(0),
        }
    }

    fn seconds(&self, steps: u64) -> f64 {
        steps as f64 * self.engine.seconds_per_step()
    }

    /// Tells `progress` that so many steps are done in all.
    fn advance(&self, steps: u64, progress: &dyn Progress) {
        let told = self.told.fetch_max(steps, Ordering::Relaxed);
        progress.advanced(self.seconds(steps.saturating_sub(told)));
    }
}

/// Every run that `workloads` want, once, and which of them every case of every workload is.
fn orders<W: Workload>(workloads: &[W]) -> (Vec<Order<'_>>, Vec<Vec<usize>>) {
    let mut orders = Vec::new();
    let mut known: HashMap<(EngineName, String), usize> = HashMap::new();
    let wanted = workloads.iter().map(|workload| {
        let engine = workload.engine();
        let cases = workload.cases().iter().map(|case| {
            let key = (engine, case.content_hash());
            *known.entry(key).or_insert_with(|| {
                orders.push(Order::new(engine, case));
                orders.len() - 1
            })
        });
        cases.collect()
    });
    let wanted = wanted.collect();
    (orders, wanted)
}

type Slot<T> = Mutex<Option<Result<T, RunError>>>;

/// What `keep` makes of each run, case by case, of every workload. Runs themselves are not held longer
/// than that, so that memory does not grow with their number.
pub fn run_all<W: Workload, T: Clone + Send>(
    workloads: &[W],
    participants: &[Participant],
    settings: &Settings,
    progress: &dyn Progress,
    keep: impl Fn(Run) -> T + Sync,
) -> Vec<Vec<Result<T, RunError>>> {
    let (orders, wanted) = orders(workloads);
    let floor = Floor {
        slots: orders.iter().map(|_| Slot::<T>::default()).collect(),
        orders,
        settings,
        progress,
        keep,
    };
    let jobs = floor.jobs(participants);
    floor.work_off(&jobs);
    let results = floor.slots.into_iter().map(|slot| {
        let result = slot.into_inner().unwrap_or(None);
        result.expect("every order is reported")
    });
    hand_out(results.map(Some).collect(), wanted)
}

/// The results of the orders that every workload wanted; copies only where several wanted the same.
fn hand_out<R: Clone>(mut results: Vec<Option<R>>, wanted: Vec<Vec<usize>>) -> Vec<Vec<R>> {
    let mut uses = vec![0; results.len()];
    for &order in wanted.iter().flatten() {
        uses[order] += 1;
    }
    let mut result = |order: usize| {
        uses[order] -= 1;
        let result = match uses[order] {
            0 => results[order].take(),
            _ => results[order].clone(),
        };
        result.expect("nobody takes a result that somebody else still wants")
    };
    let mut of_workload = |wanted: Vec<usize>| wanted.into_iter().map(&mut result).collect();
    wanted.into_iter().map(&mut of_workload).collect()
}

/// Orders for one call of one engine.
struct Job<'a> {
    engine: &'a dyn Engine,
    orders: Vec<usize>,
}

/// Everything the workers share.
struct Floor<'a, T, Keep> {
    orders: Vec<Order<'a>>,
    settings: &'a Settings<'a>,
    progress: &'a dyn Progress,
    keep: Keep,
    slots: Vec<Slot<T>>,
}

impl<T: Send, Keep: Fn(Run) -> T + Sync> Floor<'_, T, Keep> {
    fn case(&self, order: usize) -> &Case {
        self.orders[order].case
    }

    fn fill(&self, order: usize, result: Result<Run, RunError>) {
        if let Ok(mut slot) = self.slots[order].lock() {
            *slot = Some(result.map(&self.keep));
        }
    }

    /// Fills the slots of what is there already, and packs the rest into jobs.
    fn jobs<'b>(&self, participants: &'b [Participant]) -> Vec<Job<'b>> {
        let mut jobs = Vec::new();
        let (mut total, mut missing) = (0, 0);
        for participant in participants {
            let orders = self.orders_of(participant.name);
            total += orders.len();
            let Some(engine) = participant.engine.as_deref() else {
                self.use_recorded(participant.name, &orders);
                continue;
            };
            let open = self.without_stored(engine, orders);
            missing += open.len();
            let calls = match engine.batching() {
                Batching::OneCallACase => open.len(),
                Batching::FewCalls => self.settings.threads.div_ceil(participants.len()),
                Batching::OneCallACore => self.settings.threads,
            };
            let hands = self.deal(open, calls).into_iter();
            jobs.extend(hands.map(|orders| Job { engine, orders }));
        }
        let work = jobs.iter().map(|job| self.seconds(job)).sum();
        self.progress.planned(total, total - missing, work);
        jobs.sort_by(|left, right| self.seconds(right).total_cmp(&self.seconds(left)));
        jobs
    }

    /// Deals `orders` out to at most so many calls, the longest first, so that all calls take about as long.
    fn deal(&self, mut orders: Vec<usize>, calls: usize) -> Vec<Vec<usize>> {
        orders.sort_by_key(|&order| std::cmp::Reverse(self.case(order).total_steps()));
        let calls = calls.min(orders.len());
        let hand = |call| orders.iter().copied().skip(call).step_by(calls).collect();
        (0..calls).map(hand).collect()
    }

    fn orders_of(&self, engine: EngineName) -> Vec<usize> {
        let all = self.orders.iter().enumerate();
        let own = all.filter(|(_, order)| order.engine == engine);
        own.map(|(index, _)| index).collect()
    }

    /// What a job takes, about.
    fn seconds(&self, job: &Job) -> f64 {
        let orders = job.orders.iter().map(|&order| &self.orders[order]);
        orders
            .map(|order| order.seconds(order.case.total_steps()))
            .sum()
    }

    fn use_recorded(&self, engine: EngineName, orders: &[usize]) {
        for &order in orders {
            let run = self.settings.recorded.get(engine, self.case(order));
            self.fill(order, run.map_err(RunError::from));
        }
    }

    /// Fills the slots of the orders whose runs are in the store, and returns the others.
    fn without_stored(&self, engine: &dyn Engine, orders: Vec<usize>) -> Vec<usize> {
        if self.settings.fresh {
            return orders;
        }
        let mut open = Vec::new();
        for order in orders {
            let case = self.case(order);
            let deck_hash = engine.name().deck_hash(case);
            match self.settings.store.get(engine.identity(), case, &deck_hash) {
                Ok(Some(run)) => self.fill(order, Ok(run)),
                Ok(None) => open.push(order),
                Err(error) => {
                    self.progress
                        .warn(&format!("damaged run in the store, computed anew: {error}"));
                    open.push(order);
                }
            }
        }
        open
    }

    fn work_off(&self, jobs: &[Job]) {
        let workers = self.settings.threads.min(jobs.len());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build();
        match pool {
            Ok(pool) => pool.in_place_scope_fifo(|scope| {
                for job in jobs {
                    scope.spawn_fifo(|_| self.carry_out(job));
                }
            }),
            Err(error) => {
                self.progress
                    .warn(&format!("everything runs on one core: {error}"));
                jobs.iter().for_each(|job| self.carry_out(job));
            }
        }
    }

    fn carry_out(&self, job: &Job) {
        if self.settings.interrupt.requested() {
            return self.fail_all(job, || FailureKind::Interrupted);
        }
        let cases: Vec<Case> = job.orders.iter().map(|&order| *self.case(order)).collect();
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
        let checkpoints = self.settings.store.checkpoint_directory();
        let workplace = Workplace {
            directory: directory.path(),
            checkpoints: Some(&checkpoints),
            time_limit: self.settings.time_limit,
            interrupt: self.settings.interrupt,
            advanced: &|index, steps| self.orders[job.orders[index]].advance(steps, self.progress),
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
        let order = job.orders[index];
        if let Ok(run) = &result
            && let Err(error) = self.settings.store.put(run)
        {
            self.progress
                .warn(&format!("a finished run could not be kept: {error}"));
        }
        self.orders[order].advance(self.case(order).total_steps(), self.progress);
        self.progress
            .finished(job.engine.name(), self.case(order), result.as_ref());
        self.fill(order, result.map_err(RunError::from));
    }

    fn fail_all(&self, job: &Job, kind: impl Fn() -> FailureKind) {
        for index in 0..job.orders.len() {
            let failure = Failure {
                engine: job.engine.name(),
                subject: self.case(job.orders[index]).to_string(),
                kind: kind(),
                run_directory: None,
                last_lines: Vec::new(),
            };
            self.accept(job, index, Err(failure));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Load, plan};
    use super::*;
    use crate::stack::{Convention, Stack};

    #[test]
    fn what_two_workloads_want_both_get() {
        let results = ["a", "b", "c"].map(|name| Some(name.to_owned()));
        let handed = hand_out(results.to_vec(), vec![vec![0, 1], vec![], vec![1, 2, 1]]);
        assert_eq!(handed, [vec!["a", "b"], vec![], vec!["b", "c", "b"]]);
    }

    #[test]
    fn a_run_that_several_workloads_want_is_made_once() {
        let cases = |friction| {
            let stack = Stack::paper(friction, 1e2);
            plan(EngineName::Native, &stack, Convention::PAPER).cases
        };
        let (some, others) = (cases(0.2), cases(0.3));
        let load = |engine, cases: [&[Case]; 2]| Load {
            engine,
            cases: cases.concat(),
        };
        let workloads = [
            load(EngineName::Native, [&some, &some[1..]]),
            load(EngineName::Native, [&others, &some]),
            load(EngineName::Yade, [&some, &[]]),
        ];
        let (orders, wanted) = orders(&workloads);
        assert_eq!(orders.len(), some.len() + others.len() + some.len());
        for (workload, wanted) in workloads.iter().zip(&wanted) {
            assert_eq!(wanted.len(), workload.cases.len());
            for (case, &order) in workload.cases.iter().zip(wanted) {
                assert_eq!(orders[order].engine, workload.engine);
                assert_eq!(orders[order].case, case);
            }
        }
    }
}
