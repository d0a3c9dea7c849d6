//! Carries out requests: takes results from the store or from recordings, runs codes on all cores, or waits for
//! another program that is carrying out the same task.

use super::requests::RunRequest;
use super::store_writer::{Claim, Finished, StoreWriter, keep, with_store_writer};
use super::{Progress, Reading, RunError, ScheduledTask, SelectedCode, Settings};
use crate::code::{Batching, Code, Failure, FailureKind, InstalledCode, RunContext, keep_evidence};
use crate::files::FileError;
use crate::model::shown;
use crate::runs::{LockOwner, in_parallel};
use std::sync::atomic::AtomicUsize;
use std::sync::{Arc, Mutex, PoisonError};
use tempfile::TempDir;

/// Least estimated duration, in seconds, of a call that carries out many tasks, if there is enough work for more
/// calls than cores: starting the code takes a few seconds, and other programs at the store take on the other calls.
const SECONDS_OF_A_CALL: f64 = 60.0;

type Outcome<R> = <<R as Reading>::Task as ScheduledTask>::Outcome;
type Slot<R> = Mutex<Option<Result<R, RunError>>>;

/// The requests for one call of a code.
pub(super) struct Job<'a> {
    pub(super) code: &'a dyn InstalledCode,
    pub(super) requests: Vec<usize>,
}

/// The state that workers share.
pub(super) struct Executor<'a, R: Reading> {
    requests: Vec<RunRequest<'a, R::Task>>,
    pub(super) settings: &'a Settings<'a>,
    pub(super) progress: &'a dyn Progress,
    slots: Vec<Slot<R>>,
    /// Requests that other programs are working on.
    elsewhere: Mutex<Vec<(usize, LockOwner)>>,
    /// Number of requests that would not have ended in the time left.
    pub(super) postponed: AtomicUsize,
}

impl<'a, R: Reading> Executor<'a, R> {
    pub(super) fn new(
        requests: Vec<RunRequest<'a, R::Task>>,
        settings: &'a Settings<'a>,
        progress: &'a dyn Progress,
    ) -> Self {
        Self {
            slots: requests.iter().map(|_| Slot::default()).collect(),
            requests,
            settings,
            progress,
            elsewhere: Mutex::default(),
            postponed: AtomicUsize::new(0),
        }
    }

    /// Carries out every request and returns its result.
    pub(super) fn results(self, codes: &'a [SelectedCode]) -> Vec<Option<Result<R, RunError>>> {
        let jobs = self.jobs(codes);
        self.work_off(&jobs);
        self.wait_for_others(codes);
        self.end_if_postponed();
        let results = self.slots.into_iter().map(|slot| {
            let result = slot.into_inner().unwrap_or_else(PoisonError::into_inner);
            assert!(result.is_some(), "every request is reported");
            result
        });
        results.collect()
    }

    pub(super) fn task(&self, request: usize) -> &'a R::Task {
        self.requests[request].task
    }

    /// Returns the code that carries out `request`, one of `codes`.
    pub(super) fn code_of(
        &self,
        request: usize,
        codes: &'a [SelectedCode],
    ) -> Option<&'a dyn InstalledCode> {
        let code = self.requests[request].code.clone();
        let selected = codes.iter().find(|selected| selected.name == code)?;
        selected.code.as_deref()
    }

    fn fill(&self, request: usize, result: Result<R, RunError>) {
        let mut slot = self.slots[request]
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        *slot = Some(result);
    }

    /// Fills the slots of results that exist, and packs the other requests into jobs.
    fn jobs(&self, codes: &'a [SelectedCode]) -> Vec<Job<'a>> {
        self.progress.begins(&R::Task::KIND.phase(codes.len()));
        let mut open = Vec::new();
        let mut total = 0;
        for selected in codes {
            let requests = self.requests_of(&selected.name);
            total += requests.len();
            match selected.code.as_deref() {
                Some(code) => open.extend(self.without_stored(code, requests)),
                None => self.use_recorded(&selected.name, &requests),
            }
        }
        let seconds = |&request: &usize| self.total_seconds(request);
        let work = open.iter().map(seconds).sum();
        let reused = total - open.len();
        self.progress
            .planned(R::Task::KIND.name(), total, reused, work);
        self.pack(&open, codes)
    }

    /// Packs the requests in `open` into jobs, the longest first.
    pub(super) fn pack(&self, open: &[usize], codes: &'a [SelectedCode]) -> Vec<Job<'a>> {
        let mut jobs = Vec::new();
        for selected in codes {
            let Some(code) = selected.code.as_deref() else {
                continue;
            };
            let own = |request: &usize| self.requests[*request].code == selected.name;
            let own: Vec<usize> = open.iter().copied().filter(own).collect();
            let calls = match code.batching() {
                Batching::OneCallACase => own.len(),
                Batching::FewCalls => self.few_calls(&own, codes.len()),
                Batching::OneCallACore => self.settings.threads,
            };
            let hands = self.deal(own, calls).into_iter();
            jobs.extend(hands.map(|requests| Job { code, requests }));
        }
        jobs.sort_by(|left, right| self.seconds(right).total_cmp(&self.seconds(left)));
        jobs
    }

    /// Returns the number of calls for the requests in `own`, all of one code among `codes` codes.
    fn few_calls(&self, own: &[usize], codes: usize) -> usize {
        let seconds = own.iter().map(|&request| self.total_seconds(request));
        let enough = (seconds.sum::<f64>() / SECONDS_OF_A_CALL) as usize;
        enough.max(self.settings.threads.div_ceil(codes))
    }

    /// Deals out `requests` to at most `calls` calls, the longest first, so that all calls take about as long.
    fn deal(&self, mut requests: Vec<usize>, calls: usize) -> Vec<Vec<usize>> {
        requests.sort_by_key(|&request| std::cmp::Reverse(self.task(request).steps()));
        let calls = calls.min(requests.len());
        let hand = |call| requests.iter().copied().skip(call).step_by(calls).collect();
        (0..calls).map(hand).collect()
    }

    pub(super) fn requests_of(&self, code: &Code) -> Vec<usize> {
        let all = self.requests.iter().enumerate();
        let own = all.filter(|(_, request)| request.code == *code);
        own.map(|(index, _)| index).collect()
    }

    /// Estimates the duration of a request in seconds.
    pub(super) fn total_seconds(&self, request: usize) -> f64 {
        let request = &self.requests[request];
        request.seconds(request.task.steps())
    }

    fn seconds(&self, job: &Job) -> f64 {
        let requests = job.requests.iter();
        requests.map(|&request| self.total_seconds(request)).sum()
    }

    fn use_recorded(&self, code: &Code, requests: &[usize]) {
        for &request in requests {
            let reading = R::recorded(self.task(request), &code.clone(), &self.settings.recorded);
            self.fill(request, reading.map_err(RunError::from));
        }
    }

    /// Fills the slots of the requests whose results are in the store, and returns the others.
    fn without_stored(&self, code: &dyn InstalledCode, requests: Vec<usize>) -> Vec<usize> {
        if self.settings.fresh {
            return requests;
        }
        // Damaged results are put into quarantine later, under a claim.
        let is_stored = |&request: &usize| self.fill_from_store(code, request, |_| ());
        let stored = in_parallel(&requests, self.settings.threads, is_stored);
        let all = requests.into_iter().zip(stored);
        all.filter_map(|(request, stored)| (!stored).then_some(request))
            .collect()
    }

    /// Fills the slot of `request` if its result is in the store; calls `damaged` if that is damaged.
    fn fill_from_store(
        &self,
        code: &dyn InstalledCode,
        request: usize,
        damaged: impl FnOnce(FileError),
    ) -> bool {
        match R::stored(self.task(request), code, &self.settings.store) {
            Ok(Some(reading)) => {
                self.fill(request, Ok(reading));
                return true;
            }
            Ok(None) => {}
            Err(error) => damaged(error),
        }
        false
    }

    pub(super) fn work_off(&self, jobs: &[Job<'a>]) {
        let workers = self.settings.threads.min(jobs.len());
        if workers == 0 {
            return;
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build();
        with_store_writer(
            |finished| self.settle(finished),
            |store_writer| match pool {
                Ok(pool) => pool.in_place_scope_fifo(|scope| {
                    for job in jobs {
                        scope.spawn_fifo(move |_| self.carry_out(job, store_writer));
                    }
                }),
                Err(error) => {
                    self.progress
                        .warn(&format!("everything runs on one core: {error}"));
                    jobs.iter()
                        .for_each(|job| self.carry_out(job, store_writer));
                }
            },
        );
    }

    fn carry_out(&self, job: &Job<'a>, store_writer: &StoreWriter<'a, R::Task>) {
        if self.settings.interrupt.requested() {
            return self.fail_all(job.code, &job.requests, || FailureKind::Interrupted);
        }
        let (claim, requests) = self.take_on(job);
        let requests = self.in_time(job.code, requests);
        if requests.is_empty() {
            return;
        }
        let tasks = requests.iter().map(|&request| *self.task(request));
        let tasks: Vec<R::Task> = tasks.collect();
        let directory = match self.run_directory(job.code.name()) {
            Ok(directory) => directory,
            Err(error) => {
                let start = || FailureKind::Start(std::io::Error::other(error.to_string()));
                return self.fail_all(job.code, &requests, start);
            }
        };
        let checkpoints = self.settings.store.checkpoint_directory();
        let context = RunContext {
            directory: directory.path(),
            checkpoints: Some(&checkpoints),
            fresh: self.settings.fresh,
            time_limit: self.settings.time_limit,
            interrupt: self.settings.interrupt,
            advanced: &|index, steps| self.requests[requests[index]].advance(steps, self.progress),
        };
        let mut evidence = false;
        R::Task::carry_out(&tasks, job.code, &context, &mut |index, result| {
            let request = requests[index];
            match result {
                Ok(outcome) => {
                    let finished = Finished {
                        code: job.code,
                        request,
                        task: self.task(request),
                        outcome,
                        claim: Arc::clone(&claim),
                    };
                    self.hand_in(finished, store_writer);
                }
                Err(failure) => {
                    evidence |= failure.left_evidence();
                    self.report(job.code.name(), request, Err(failure));
                }
            }
        });
        if evidence {
            keep_evidence(directory);
        }
    }

    fn run_directory(&self, code: &Code) -> std::io::Result<TempDir> {
        let prefix = format!("{code}-");
        let root = self.settings.store.work_directory();
        tempfile::Builder::new().prefix(&prefix).tempdir_in(root)
    }

    /// Claims the requests of `job`, and returns those that this program still has to make.
    fn take_on(&self, job: &Job) -> (Arc<Claim<'a>>, Vec<usize>) {
        let addresses = job
            .requests
            .iter()
            .map(|&request| self.task(request).address(job.code));
        let addresses: Vec<String> = addresses.collect();
        let store = &self.settings.store;
        let owners = store.claim(&addresses).unwrap_or_else(|error| {
            let name = R::Task::KIND.name();
            let message = format!("other programs may make the same {name}s again: {error}");
            self.progress.warn(&message);
            vec![None; addresses.len()]
        });
        let mut claim = Claim {
            store,
            progress: self.progress,
            addresses: Vec::new(),
        };
        let mut own = Vec::new();
        for ((&request, address), owner) in job.requests.iter().zip(addresses).zip(owners) {
            match owner {
                // Finished by a program that is still working on other runs of its claim.
                Some(_) if self.is_made(job.code, request, |_| ()) => {}
                Some(owner) => self.elsewhere().push((request, owner)),
                None => {
                    let damaged = |error| self.put_aside(&address, &error);
                    if !self.is_made(job.code, request, damaged) {
                        own.push(request);
                    }
                    claim.addresses.push(address);
                }
            }
        }
        (Arc::new(claim), own)
    }

    /// Whether the result has been kept since the jobs were packed; its slot is then filled.
    pub(super) fn is_made(
        &self,
        code: &dyn InstalledCode,
        request: usize,
        damaged: impl FnOnce(FileError),
    ) -> bool {
        let made = !self.settings.fresh && self.fill_from_store(code, request, damaged);
        if made {
            self.advance(request);
        }
        made
    }

    /// Puts the damaged result under `address` into quarantine, with a warning.
    fn put_aside(&self, address: &str, error: &FileError) {
        let place = match self.settings.store.put_aside(R::Task::KIND, address) {
            Ok(place) => format!("it is now {}", shown(&place)),
            Err(error) => error.to_string(),
        };
        let name = R::Task::KIND.name();
        self.progress.warn(&format!(
            "damaged {name} in the store, made anew: {error}; {place}"
        ));
    }

    fn hand_in(&self, finished: Finished<'a, R::Task>, store_writer: &StoreWriter<'a, R::Task>) {
        if let Err(refused) = store_writer.send(finished) {
            keep(&refused.0);
            self.settle(refused.0);
        }
    }

    fn settle(&self, finished: Finished<R::Task>) {
        let code = finished.code.name();
        self.report(code, finished.request, Ok(finished.outcome));
    }

    pub(super) fn report(&self, code: &Code, request: usize, result: Result<Outcome<R>, Failure>) {
        self.advance(request);
        let task = self.task(request);
        task.report(code, result.as_ref(), self.progress);
        self.fill(request, result.map(R::of).map_err(RunError::from));
    }

    fn advance(&self, request: usize) {
        self.requests[request].advance(self.task(request).steps(), self.progress);
    }

    fn fail_all(
        &self,
        code: &dyn InstalledCode,
        requests: &[usize],
        kind: impl Fn() -> FailureKind,
    ) {
        for &request in requests {
            let failure = Failure::new(code.name().clone(), self.task(request), kind());
            self.report(code.name(), request, Err(failure));
        }
    }

    pub(super) fn elsewhere(&self) -> std::sync::MutexGuard<'_, Vec<(usize, LockOwner)>> {
        self.elsewhere
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}
