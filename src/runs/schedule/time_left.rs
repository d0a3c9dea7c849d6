//! Runs for which the time that is left is enough.

use super::executor::Executor;
use super::{Reading, ScheduledTask};
use crate::code::{Failure, FailureKind, InstalledCode};
use crate::runs::Kind;
use std::sync::atomic::Ordering;
use std::time::Duration;

impl<R: Reading> Executor<'_, R> {
    /// Those of `requests` that will end in time, one after another; the others are reported.
    pub(super) fn in_time(&self, code: &dyn InstalledCode, mut requests: Vec<usize>) -> Vec<usize> {
        let Some((left, usable)) = self.settings.interrupt.time_left() else {
            return requests;
        };
        if code.keeps_checkpoints() && R::Task::KIND == Kind::Run {
            return requests;
        }
        let mut needed = Duration::ZERO;
        requests.retain(|&request| {
            let estimate = Duration::try_from_secs_f64(self.total_seconds(request));
            let estimate = estimate.unwrap_or(Duration::MAX);
            if needed.saturating_add(estimate) <= left {
                needed += estimate;
                return true;
            }
            let kind = match estimate > usable {
                true => FailureKind::TooLong { estimate, usable },
                false => FailureKind::Interrupted,
            };
            if estimate <= usable {
                self.postponed.fetch_add(1, Ordering::Relaxed);
            }
            let failure = Failure::new(code.name(), self.task(request), kind);
            self.report(code.name(), request, Err(failure));
            false
        });
        requests
    }

    /// Ends the program where requests were left for its next start.
    pub(super) fn end_if_postponed(&self) {
        let count = self.postponed.load(Ordering::Relaxed);
        if count > 0 {
            let name = R::Task::KIND.name();
            self.progress.warn(&format!(
                "{count} {name}s are not begun: by estimate each takes longer than the time that is left"
            ));
            self.settings.interrupt.end_time();
        }
    }
}
