//! Progress on standard error: a bar on a terminal, plain lines elsewhere.

use super::tell;
use crate::code::{Code, Failure};
use crate::runs::Progress;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::fmt::Display;
use std::io::IsTerminal;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time between two lines of progress, where there is no bar.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// Runs `work` with a progress report on standard error, and removes the bar when it is done.
pub(super) fn with_progress<T>(work: impl FnOnce(&Reporter) -> T) -> T {
    work(&Reporter::new())
}

/// Reports progress to the user.
pub(super) struct Reporter {
    /// In nanoseconds of expected work; hidden where there is no terminal.
    bar: ProgressBar,
    drawn: bool,
    counts: Mutex<Counts>,
}

struct Counts {
    finished: usize,
    open: usize,
    last_line: Instant,
}

impl Reporter {
    fn new() -> Self {
        let drawn = std::io::stderr().is_terminal();
        let target = if drawn {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        Self {
            bar: ProgressBar::with_draw_target(Some(0), target).with_style(style()),
            drawn,
            counts: Mutex::new(Counts {
                finished: 0,
                open: 0,
                last_line: Instant::now(),
            }),
        }
    }

    fn say(&self, line: &str) {
        if self.drawn {
            self.bar.println(line);
        } else {
            tell!("{line}");
        }
    }

    /// The counts, which stay valid even if a thread panicked while it held them.
    fn counts(&self) -> MutexGuard<'_, Counts> {
        self.counts.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:40} {percent} %, {elapsed} elapsed, {eta} left  {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl Progress for Reporter {
    fn planned(&self, name: &str, total: usize, reused: usize, seconds: f64) {
        self.counts().open += total - reused;
        self.bar.inc_length((1e9 * seconds) as u64);
        if reused > 0 {
            self.say(&format!("{reused} of {total} {name}s are there already"));
        }
    }

    fn advanced(&self, seconds: f64) {
        self.bar.inc((1e9 * seconds) as u64);
        let mut counts = self.counts();
        if !self.drawn && counts.last_line.elapsed() > BETWEEN_LINES {
            counts.last_line = Instant::now();
            let done = self.bar.position() as f64 / self.bar.length().unwrap_or(0).max(1) as f64;
            let left = HumanDuration(self.bar.eta());
            tell!("{:.0} % done, {left} left", 100.0 * done);
        }
    }

    fn finished(&self, code: Code, task: &dyn Display, result: Result<Option<f64>, &Failure>) {
        let (finished, open) = {
            let mut counts = self.counts();
            counts.finished += 1;
            (counts.finished, counts.open)
        };
        let subject = format!("[{finished}/{open}] {code}: {task}");
        match result {
            Err(failure) if !failure.is_interrupted() => self.say(&format!("failed: {failure}")),
            Ok(seconds) if !self.drawn => {
                let seconds = seconds.map(|seconds| format!(": {seconds:.2} s"));
                tell!("{subject}{}", seconds.unwrap_or_default());
            }
            _ => self.bar.set_message(subject),
        }
    }

    fn warn(&self, message: &str) {
        self.say(&format!("warning: {message}"));
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
