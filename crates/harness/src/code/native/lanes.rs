//! Native runs that share vector instructions: longest first, timed, with checkpoints.

use super::checkpoints::{CHECKPOINT_INTERVAL, Unfinished, keep, take_up};
use super::{Native, cause, failure};
use crate::code::{Code, FailureKind, Finished, Run, RunContext};
use crate::dem::{Checkpoint, OpenRun, OpenRuns, RunQueue};
use crate::model::Case;
use crate::series::{Series, SeriesError};
use std::collections::{BTreeMap, VecDeque};
use std::time::{Duration, Instant};

/// The runs that share one vector.
pub(super) struct Lanes<'a, 'f> {
    native: &'a Native,
    cases: &'a [Case],
    /// Longest first, so that no lane is left alone with a long run.
    waiting: VecDeque<usize>,
    context: &'a RunContext<'a>,
    finished: Finished<'f, Run>,
    /// Run time of each run in a lane: its share of the time of the vector.
    open: BTreeMap<usize, Duration>,
    /// The moment up to which time has been shared out.
    shared: Instant,
    last_finished: Instant,
    last_kept: Instant,
}

impl<'a, 'f> Lanes<'a, 'f> {
    /// Prepares the runs of the `cases` with these `indices`.
    pub(super) fn new(
        native: &'a Native,
        cases: &'a [Case],
        mut indices: Vec<usize>,
        context: &'a RunContext<'a>,
        finished: Finished<'f, Run>,
    ) -> Self {
        indices.sort_by_key(|&index| std::cmp::Reverse(cases[index].total_steps()));
        let now = Instant::now();
        Self {
            native,
            cases,
            waiting: indices.into(),
            context,
            finished,
            open: BTreeMap::new(),
            shared: now,
            last_finished: now,
            last_kept: now,
        }
    }

    /// Reports the runs that an interrupt or the time limit kept from starting.
    pub(super) fn give_up_waiting(&mut self) {
        while let Some(index) = self.waiting.pop_front() {
            let late = self.late().map(FailureKind::TimedOut);
            let kind = late.unwrap_or(FailureKind::Interrupted);
            (self.finished)(index, Err(failure(&self.cases[index], kind)));
        }
    }

    fn share_time(&mut self) {
        let now = Instant::now();
        let share = (now - self.shared) / u32::try_from(self.open.len().max(1)).unwrap_or(1);
        for seconds in self.open.values_mut() {
            *seconds += share;
        }
        self.shared = now;
    }

    fn late(&self) -> Option<Duration> {
        self.context.late_since(self.last_finished)
    }

    fn address(&self, index: usize) -> String {
        let case = &self.cases[index];
        let identity = &self.native.identity;
        identity.address(case, &Code::native().deck_hash(case))
    }

    fn keep(&mut self, open: Vec<(usize, Checkpoint)>) {
        self.share_time();
        self.last_kept = Instant::now();
        for (index, checkpoint) in open {
            let seconds = self.open.get(&index).map_or(0.0, Duration::as_secs_f64);
            let unfinished = Unfinished {
                seconds,
                checkpoint,
            };
            keep(self.context, &self.address(index), &unfinished);
        }
    }
}

/// Converts `seconds` from a file, limited to a range that `Duration` can hold.
fn duration(seconds: f64) -> Duration {
    const LONGEST: f64 = 1e10;
    Duration::try_from_secs_f64(seconds.min(LONGEST)).unwrap_or_default()
}

impl RunQueue for Lanes<'_, '_> {
    fn next(&mut self) -> Option<OpenRun> {
        if self.context.interrupt.requested() {
            return None;
        }
        let index = self.waiting.pop_front()?;
        self.share_time();
        let unfinished = take_up(self.context, &self.address(index));
        let unfinished = unfinished.filter(|kept| kept.checkpoint.fits(&self.cases[index]));
        let seconds = unfinished.as_ref().map_or(0.0, |kept| kept.seconds);
        self.open.insert(index, duration(seconds));
        Some(OpenRun {
            index,
            case: self.cases[index],
            checkpoint: unfinished.map(|kept| kept.checkpoint),
        })
    }

    fn wanted(&mut self, open: &dyn OpenRuns) -> bool {
        for (index, steps) in open.steps() {
            (self.context.advanced)(index, steps);
        }
        let wanted = !self.context.interrupt.requested() && self.late().is_none();
        if !wanted || self.last_kept.elapsed() > CHECKPOINT_INTERVAL {
            self.keep(open.checkpoints());
        }
        wanted
    }

    fn ended(&mut self, index: usize, series: Result<Series, SeriesError>) {
        self.share_time();
        let duration = self.open.remove(&index).unwrap_or_default();
        let case = &self.cases[index];
        let late = self.late();
        let complete = series.is_ok();
        let run = series.map(|series| self.native.run_of(case, series, duration));
        let run = run.map_err(|error| failure(case, cause(error, self.context, late)));
        (self.finished)(index, run);
        if complete {
            self.last_finished = Instant::now();
        }
    }
}
