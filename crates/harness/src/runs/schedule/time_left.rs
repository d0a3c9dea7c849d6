//! Selects the runs for which there is enough time left.

use super::executor::Executor;
use super::{Reading, ScheduledTask};
use crate::code::{Failure, FailureKind, InstalledCode};
use crate::runs::Kind;
use std::sync::atomic::Ordering;
use std::time::Duration;

impl<R: Reading> Executor<'_, R> {
    /// Returns those of `requests` that end in time if one call carries them out one after another; reports the
    /// others.
    pub(super) fn in_time(&self, code: &dyn InstalledCode, mut requests: Vec<usize>) -> Vec<usize> {
        let interrupt = self.settings.interrupt;
        let Some((left, whole)) = interrupt.time_left() else {
            return requests;
        };
        if code.keeps_checkpoints() && R::Task::KIND == Kind::Run {
            interrupt.begin();
            return requests;
        }
        // The most time that a start of this command has for one run. If nothing has begun, no other start will have
        // more left.
        let usable = match interrupt.has_begun() {
            true => whole,
            false => left.min(whole),
        };
        let start = seconds(code.name().start_seconds());
        let mut needed = start;
        requests.retain(|&request| {
            let estimate = seconds(self.total_seconds(request));
            let after = needed.saturating_add(estimate);
            if after <= left {
                needed = after;
                return true;
            }
            self.leave(code, request, start.saturating_add(estimate), usable);
            false
        });
        if !requests.is_empty() {
            interrupt.begin();
        }
        requests
    }

    /// Reports that `request`, which takes as long as `estimate` with its start, is not begun. It fails if no start
    /// of the same command has that time, of which each can use at most `usable`; otherwise it is left for another
    /// start.
    fn leave(
        &self,
        code: &dyn InstalledCode,
        request: usize,
        estimate: Duration,
        usable: Duration,
    ) {
        let kind = match estimate > usable {
            true => FailureKind::TooLong {
                estimate: seconds_up(estimate),
                usable: Duration::from_secs(usable.as_secs()),
            },
            false => {
                self.postponed.fetch_add(1, Ordering::Relaxed);
                FailureKind::Interrupted
            }
        };
        let failure = Failure::new(code.name().clone(), self.task(request), kind);
        self.report(code.name(), request, Err(failure));
    }

    /// Requests a stop, with a warning, if requests were left for the next start of the program.
    pub(super) fn end_if_postponed(&self) {
        let count = self.postponed.load(Ordering::Relaxed);
        if count > 0 {
            let name = R::Task::KIND.name();
            self.progress.warn(&format!(
                "{count} {name}s are not begun: by estimate they would not end in the time that is left"
            ));
            self.settings.interrupt.end_time();
        }
    }
}

/// Converts to a duration: the longest one if `seconds` is too large, negative or no number.
fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

/// Rounds `duration` up to whole seconds, so that it never looks equal to a shorter one that is rounded down.
fn seconds_up(duration: Duration) -> Duration {
    let part = u64::from(duration.subsec_nanos() > 0);
    Duration::from_secs(duration.as_secs().saturating_add(part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_is_rounded_up_and_nothing_overflows() {
        assert_eq!(
            seconds_up(Duration::from_millis(2100)),
            Duration::from_secs(3)
        );
        assert_eq!(seconds_up(Duration::from_secs(2)), Duration::from_secs(2));
        assert_eq!(seconds_up(Duration::MAX), Duration::from_secs(u64::MAX));
        assert_eq!(seconds(f64::INFINITY), Duration::MAX);
        assert_eq!(seconds(f64::NAN), Duration::MAX);
    }
}
