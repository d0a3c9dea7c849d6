//! Where orders are worked off: from the store, from recordings, by engines on all cores, or by waiting for another
//! program that is at it.

use super::orders::Order;
use super::outbox::{Claim, Outbox, Outgoing, keep, with_outbox};
use super::{Participant, Progress, RunError, Settings};
use crate::archive::{ArchiveError, Run};
use crate::engine::{Batching, Engine, EngineName, Failure, FailureKind, Workplace, keep_evidence};
use crate::stack::{Case, shown};
use crate::store::Holder;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time between two looks at what other programs have finished.
const POLL_INTERVAL: Duration = Duration::from_millis(200);

type Slot<T> = Mutex<Option<Result<T, RunError>>>;

/// Orders for one call of one engine.
struct Job<'a> {
    engine: &'a dyn Engine,
    orders: Vec<usize>,
}

/// Everything the workers share.
pub(super) struct Floor<'a, T, Keep> {
    orders: Vec<Order<'a>>,
    settings: &'a Settings<'a>,
    progress: &'a dyn Progress,
    keep: Keep,
    slots: Vec<Slot<T>>,
    /// Orders that other programs are working on.
    elsewhere: Mutex<Vec<(usize, Holder)>>,
}

impl<'a, T: Send, Keep: Fn(Run) -> T + Sync> Floor<'a, T, Keep> {
    pub(super) fn new(
        orders: Vec<Order<'a>>,
        settings: &'a Settings<'a>,
        progress: &'a dyn Progress,
        keep: Keep,
    ) -> Self {
        Self {
            slots: orders.iter().map(|_| Slot::<T>::default()).collect(),
            orders,
            settings,
            progress,
            keep,
            elsewhere: Mutex::default(),
        }
    }

    /// The result of every order.
    pub(super) fn results(self, participants: &[Participant]) -> Vec<Option<Result<T, RunError>>> {
        let jobs = self.jobs(participants);
        self.work_off(&jobs);
        self.wait_for_others(participants);
        let results = self.slots.into_iter().map(|slot| {
            let result = slot.into_inner().unwrap_or_else(PoisonError::into_inner);
            assert!(result.is_some(), "every order is reported");
            result
        });
        results.collect()
    }

    fn case(&self, order: usize) -> &Case {
        self.orders[order].case
    }

    fn fill(&self, order: usize, result: Result<Run, RunError>) {
        let mut slot = self.slots[order]
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        *slot = Some(result.map(&self.keep));
    }

    /// Fills the slots of what is there already, and packs the rest into jobs.
    fn jobs<'b>(&self, participants: &'b [Participant]) -> Vec<Job<'b>> {
        let mut open = Vec::new();
        let mut total = 0;
        for participant in participants {
            let orders = self.orders_of(participant.name);
            total += orders.len();
            match participant.engine.as_deref() {
                Some(engine) => open.extend(self.without_stored(engine, orders)),
                None => self.use_recorded(participant.name, &orders),
            }
        }
        let seconds = |&order: &usize| self.total_seconds(order);
        let work = open.iter().map(seconds).sum();
        self.progress.planned(total, total - open.len(), work);
        self.pack(&open, participants)
    }

    /// Jobs for the orders in `open`, the longest first.
    fn pack<'b>(&self, open: &[usize], participants: &'b [Participant]) -> Vec<Job<'b>> {
        let mut jobs = Vec::new();
        for participant in participants {
            let Some(engine) = participant.engine.as_deref() else {
                continue;
            };
            let own = |order: &usize| self.orders[*order].engine == participant.name;
            let own: Vec<usize> = open.iter().copied().filter(own).collect();
            let calls = match engine.batching() {
                Batching::OneCallACase => own.len(),
                Batching::FewCalls => self.settings.threads.div_ceil(participants.len()),
                Batching::OneCallACore => self.settings.threads,
            };
            let hands = self.deal(own, calls).into_iter();
            jobs.extend(hands.map(|orders| Job { engine, orders }));
        }
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

    /// What an order takes, about.
    fn total_seconds(&self, order: usize) -> f64 {
        let order = &self.orders[order];
        order.seconds(order.case.total_steps())
    }

    fn seconds(&self, job: &Job) -> f64 {
        let orders = job.orders.iter();
        orders.map(|&order| self.total_seconds(order)).sum()
    }

    fn use_recorded(&self, engine: EngineName, orders: &[usize]) {
        for &order in orders {
            let run = self.settings.recorded.get(engine, self.case(order));
            self.fill(order, run.map_err(RunError::from));
        }
    }

    /// Fills the slots of the orders whose runs are in the store, and returns the others.
    fn without_stored(&self, engine: &dyn Engine, mut orders: Vec<usize>) -> Vec<usize> {
        if !self.settings.fresh {
            // What is damaged is looked at when nobody else is at it.
            orders.retain(|&order| !self.fill_from_store(engine, order, |_| ()));
        }
        orders
    }

    /// Fills the slot of `order` if its run is in the store; one that is damaged is `damaged`.
    fn fill_from_store(
        &self,
        engine: &dyn Engine,
        order: usize,
        damaged: impl FnOnce(ArchiveError),
    ) -> bool {
        let case = self.case(order);
        let deck_hash = engine.name().deck_hash(case);
        match self.settings.store.get(engine.identity(), case, &deck_hash) {
            Ok(Some(run)) => {
                self.fill(order, Ok(run));
                return true;
            }
            Ok(None) => {}
            Err(error) => damaged(error),
        }
        false
    }

    fn work_off(&self, jobs: &[Job]) {
        let workers = self.settings.threads.min(jobs.len());
        if workers == 0 {
            return;
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build();
        with_outbox(
            |outgoing| self.settle(outgoing),
            |outbox| match pool {
                Ok(pool) => pool.in_place_scope_fifo(|scope| {
                    for job in jobs {
                        scope.spawn_fifo(move |_| self.carry_out(job, outbox));
                    }
                }),
                Err(error) => {
                    self.progress
                        .warn(&format!("everything runs on one core: {error}"));
                    jobs.iter().for_each(|job| self.carry_out(job, outbox));
                }
            },
        );
    }

    fn carry_out(&self, job: &Job, outbox: &Outbox<'a>) {
        if self.settings.interrupt.requested() {
            return self.fail_all(job.engine, &job.orders, || FailureKind::Interrupted);
        }
        let (claim, orders) = self.take_on(job);
        if orders.is_empty() {
            return;
        }
        let cases: Vec<Case> = orders.iter().map(|&order| *self.case(order)).collect();
        let root = self.settings.store.work_directory();
        let prefix = format!("{}-", job.engine.name());
        let directory = match tempfile::Builder::new().prefix(&prefix).tempdir_in(root) {
            Ok(directory) => directory,
            Err(error) => {
                let message = error.to_string();
                let start = || FailureKind::Start(std::io::Error::other(message.clone()));
                return self.fail_all(job.engine, &orders, start);
            }
        };
        let checkpoints = self.settings.store.checkpoint_directory();
        let workplace = Workplace {
            directory: directory.path(),
            checkpoints: Some(&checkpoints),
            time_limit: self.settings.time_limit,
            interrupt: self.settings.interrupt,
            advanced: &|index, steps| self.orders[orders[index]].advance(steps, self.progress),
        };
        let mut evidence = false;
        job.engine.run(&cases, &workplace, &mut |index, result| {
            let order = orders[index];
            match result {
                Ok(run) => self.hand_in(job.engine, order, run, &claim, outbox),
                Err(failure) => {
                    evidence |= failure.left_evidence();
                    self.report(job.engine.name(), order, Err(failure));
                }
            }
        });
        if evidence {
            keep_evidence(directory);
        }
    }

    /// Claims the orders of `job`, and returns those that are still to be made, by this program.
    fn take_on(&self, job: &Job) -> (Arc<Claim<'a>>, Vec<usize>) {
        let addresses = job.orders.iter().map(|&order| self.address(job, order));
        let addresses: Vec<String> = addresses.collect();
        let store = &self.settings.store;
        let holders = store.claim(&addresses).unwrap_or_else(|error| {
            let message = format!("other programs may make the same runs again: {error}");
            self.progress.warn(&message);
            vec![None; addresses.len()]
        });
        let mut claim = Claim {
            store,
            progress: self.progress,
            addresses: Vec::new(),
        };
        let mut own = Vec::new();
        for ((&order, address), holder) in job.orders.iter().zip(addresses).zip(holders) {
            match holder {
                // By a program that is still at others.
                Some(_) if self.is_made(job.engine, order, |_| ()) => {}
                Some(holder) => self.wait_later(order, holder),
                None => {
                    let damaged = |error| self.put_aside(&address, &error);
                    if !self.is_made(job.engine, order, damaged) {
                        own.push(order);
                    }
                    claim.addresses.push(address);
                }
            }
        }
        (Arc::new(claim), own)
    }

    fn address(&self, job: &Job, order: usize) -> String {
        let case = self.case(order);
        let deck_hash = job.engine.name().deck_hash(case);
        job.engine.identity().address(case, &deck_hash)
    }

    /// Whether the run has been kept since the jobs were packed; its slot is then filled.
    fn is_made(
        &self,
        engine: &dyn Engine,
        order: usize,
        damaged: impl FnOnce(ArchiveError),
    ) -> bool {
        let made = !self.settings.fresh && self.fill_from_store(engine, order, damaged);
        if made {
            self.advance(order);
        }
        made
    }

    /// Puts the damaged run under `address` aside, and tells why and where.
    fn put_aside(&self, address: &str, error: &ArchiveError) {
        let place = match self.settings.store.put_aside(address) {
            Ok(place) => format!("it is now {}", shown(&place)),
            Err(error) => error.to_string(),
        };
        let message = format!("damaged run in the store, computed anew: {error}; {place}");
        self.progress.warn(&message);
    }

    fn hand_in(
        &self,
        engine: &dyn Engine,
        order: usize,
        run: Run,
        claim: &Arc<Claim<'a>>,
        outbox: &Outbox<'a>,
    ) {
        let outgoing = Outgoing {
            engine: engine.name(),
            order,
            run,
            claim: Arc::clone(claim),
        };
        if let Err(refused) = outbox.send(outgoing) {
            keep(&refused.0);
            self.settle(refused.0);
        }
    }

    fn settle(&self, outgoing: Outgoing) {
        self.report(outgoing.engine, outgoing.order, Ok(outgoing.run));
    }

    fn report(&self, engine: EngineName, order: usize, result: Result<Run, Failure>) {
        self.advance(order);
        self.progress
            .finished(engine, self.case(order), result.as_ref());
        self.fill(order, result.map_err(RunError::from));
    }

    fn advance(&self, order: usize) {
        self.orders[order].advance(self.case(order).total_steps(), self.progress);
    }

    fn fail_all(&self, engine: &dyn Engine, orders: &[usize], kind: impl Fn() -> FailureKind) {
        for &order in orders {
            let failure = Failure {
                engine: engine.name(),
                subject: self.case(order).to_string(),
                kind: kind(),
                run_directory: None,
                last_lines: Vec::new(),
            };
            self.report(engine.name(), order, Err(failure));
        }
    }

    fn wait_later(&self, order: usize, holder: Holder) {
        let mut elsewhere = self.elsewhere();
        elsewhere.push((order, holder));
    }

    fn elsewhere(&self) -> std::sync::MutexGuard<'_, Vec<(usize, Holder)>> {
        self.elsewhere
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes what other programs finish, and makes what they leave.
    fn wait_for_others(&self, participants: &[Participant]) {
        let mut announced = BTreeMap::new();
        loop {
            let waiting = std::mem::take(&mut *self.elsewhere());
            if waiting.is_empty() {
                return;
            }
            self.announce(&waiting, &mut announced);
            let orders: Vec<usize> = waiting.into_iter().map(|(order, _)| order).collect();
            if !self.settings.interrupt.requested() {
                std::thread::sleep(POLL_INTERVAL);
            }
            self.work_off(&self.pack(&orders, participants));
        }
    }

    /// Says once of every program how many runs are waited for.
    fn announce(&self, waiting: &[(usize, Holder)], announced: &mut BTreeMap<String, usize>) {
        let mut counts = BTreeMap::new();
        for (_, holder) in waiting {
            *counts.entry(holder.to_string()).or_insert(0) += 1;
        }
        for (holder, count) in counts {
            if announced.insert(holder.clone(), count).is_none() {
                self.progress
                    .warn(&format!("waiting for {count} runs that {holder} is making"));
            }
        }
    }
}
