//! The request to stop, by the user or because the time is up.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A request to stop, shared by everything that runs.
#[derive(Debug, Default)]
pub struct Interrupt {
    by_user: AtomicBool,
    time_is_up: AtomicBool,
    limit: OnceLock<Limit>,
    has_begun: AtomicBool,
}

/// The time within which everything has to be done.
#[derive(Debug)]
struct Limit {
    end: Instant,
    whole: Duration,
}

impl Interrupt {
    /// Returns an interrupt without a request or a limit.
    pub const fn new() -> Self {
        Self {
            by_user: AtomicBool::new(false),
            time_is_up: AtomicBool::new(false),
            limit: OnceLock::new(),
            has_begun: AtomicBool::new(false),
        }
    }

    /// Requests a stop on behalf of the user; returns whether the user requested one before.
    pub fn request(&self) -> bool {
        self.by_user.swap(true, Ordering::SeqCst)
    }

    /// Requests a stop because there is no time left; returns whether that was requested before.
    pub fn end_time(&self) -> bool {
        self.time_is_up.swap(true, Ordering::SeqCst)
    }

    /// Requests a stop as soon as the time `whole` has passed since `start`. Only the first limit counts; returns
    /// whether this is the first.
    pub fn limit(&self, start: Instant, whole: Duration) -> bool {
        let end = start.checked_add(whole);
        end.is_some_and(|end| self.limit.set(Limit { end, whole }).is_ok())
    }

    /// Whether a stop was requested.
    pub fn requested(&self) -> bool {
        self.by_user.load(Ordering::SeqCst) || self.is_out_of_time()
    }

    /// Whether the time alone is the reason to stop.
    pub fn is_for_time(&self) -> bool {
        self.is_out_of_time() && !self.by_user.load(Ordering::SeqCst)
    }

    /// Returns the time left and the whole time allowed; `None` without a limit.
    pub(crate) fn time_left(&self) -> Option<(Duration, Duration)> {
        let Limit { end, whole } = self.limit.get()?;
        Some((end.saturating_duration_since(Instant::now()), *whole))
    }

    /// Notes that work whose result is kept has begun: another start of the same command does not repeat it.
    pub(crate) fn begin(&self) {
        self.has_begun.store(true, Ordering::SeqCst);
    }

    /// Whether any such work has begun. If none has, no other start will have more time left than this one.
    pub(crate) fn has_begun(&self) -> bool {
        self.has_begun.load(Ordering::SeqCst)
    }

    fn is_out_of_time(&self) -> bool {
        let past = |(left, _): (Duration, _)| left.is_zero();
        self.time_is_up.load(Ordering::SeqCst) || self.time_left().is_some_and(past)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_end_of_the_time_is_a_request_to_stop() {
        let interrupt = Interrupt::new();
        let start = Instant::now();
        assert!(interrupt.limit(start, Duration::from_secs(1 << 20)));
        assert!(!interrupt.requested());
        assert!(
            !interrupt.limit(start, Duration::ZERO),
            "the first one counts"
        );
        assert!(!interrupt.requested());
        let late = Interrupt::new();
        assert!(late.limit(start, Duration::ZERO));
        assert!(late.requested() && late.is_for_time());
    }

    #[test]
    fn the_user_comes_before_the_time() {
        let interrupt = Interrupt::new();
        assert!(!interrupt.end_time() && interrupt.end_time());
        assert!(interrupt.is_for_time());
        assert!(!interrupt.request() && interrupt.request());
        assert!(interrupt.requested() && !interrupt.is_for_time());
    }

    #[test]
    fn a_limit_beyond_every_clock_is_none() {
        let interrupt = Interrupt::new();
        assert!(!interrupt.limit(Instant::now(), Duration::MAX));
        assert_eq!(interrupt.time_left(), None);
    }
}
