//! Progress on standard error: a bar on a terminal, a line for each phase elsewhere.

use super::streams::is_quiet;
use super::{complain, tell};
use crate::code::{Code, Failure};
use crate::runs::Progress;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use std::fmt::{Display, Write};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time between two lines of progress, where there is no bar.
const BETWEEN_LINES: Duration = Duration::from_secs(30);
/// Time between two redraws of the bar while nothing advances.
const BETWEEN_PICTURES: Duration = Duration::from_millis(120);
/// Share of the work, and time, that must have passed before the time left is estimated.
const ENOUGH_TO_ESTIMATE: (f64, Duration) = (0.02, Duration::from_secs(3));

/// Does some `work` whose progress cannot be counted, and shows the name of the `phase` meanwhile.
pub(super) fn during<T>(phase: &str, work: impl FnOnce() -> T) -> T {
    let reporter = Reporter::new();
    reporter.begins(phase);
    work()
}

/// Reports progress on standard error, and removes the bar at the end.
pub(super) struct Reporter {
    /// In nanoseconds of expected work; hidden where there is no terminal.
    bar: ProgressBar,
    phase: Mutex<Phase>,
}

/// The work that is being done.
struct Phase {
    name: String,
    begun: Instant,
    last_line: Instant,
    /// Results to make, those that are finished, and those of them that failed.
    open: usize,
    finished: usize,
    failed: usize,
}

impl Phase {
    fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            begun: Instant::now(),
            last_line: Instant::now(),
            open: 0,
            finished: 0,
            failed: 0,
        }
    }

    /// Returns the line that ends a phase in which something had to be made.
    fn summary(&self) -> Option<String> {
        let made = self.finished - self.failed;
        let failed = match self.failed {
            0 => String::new(),
            failed => format!(", {failed} failed"),
        };
        let took = duration(self.begun.elapsed());
        let Self { name, open, .. } = self;
        (*open > 0).then(|| format!("{name}: {made} of {open} made in {took}{failed}"))
    }
}

impl Reporter {
    pub fn new() -> Self {
        Self {
            bar: match is_quiet() {
                true => ProgressBar::hidden(),
                false => ProgressBar::no_length(),
            },
            phase: Mutex::new(Phase::new("")),
        }
    }

    fn say(&self, line: &str) {
        match self.bar.is_hidden() {
            true => tell!("{line}"),
            false => self.bar.println(line),
        }
    }

    /// Says a line that --quiet does not silence.
    fn complain(&self, line: &str) {
        match self.bar.is_hidden() {
            true => complain!("{line}"),
            false => self.bar.println(line),
        }
    }

    /// Returns the phase, which stays valid even if a thread panicked while it held it.
    fn phase(&self) -> MutexGuard<'_, Phase> {
        self.phase.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Says what the phase has come to, where there is no bar.
    fn end(&self, phase: &Phase) {
        if let Some(summary) = phase.summary().filter(|_| self.bar.is_hidden()) {
            tell!("{summary}");
        }
    }
}

fn style(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    style.with_key("left", |state: &ProgressState, text: &mut dyn Write| {
        let left = time_left(f64::from(state.fraction()), state.elapsed());
        let _ = text.write_str(&left);
    })
}

/// Says how much time is left when this share of the work took `elapsed`.
fn time_left(done: f64, elapsed: Duration) -> String {
    let (share, time) = ENOUGH_TO_ESTIMATE;
    if done < share || elapsed < time {
        return "time left not known yet".to_owned();
    }
    let left = elapsed.as_secs_f64() * (1.0 / done - 1.0).max(0.0);
    format!("about {} left", duration(Duration::from_secs_f64(left)))
}

/// Writes a duration as people say it.
fn duration(duration: Duration) -> String {
    match duration.as_secs_f64() {
        seconds if seconds < 10.0 => format!("{seconds:.1} s"),
        seconds if seconds < 120.0 => format!("{seconds:.0} s"),
        _ => HumanDuration(duration).to_string(),
    }
}

impl Progress for Reporter {
    fn begins(&self, name: &str) {
        let mut phase = self.phase();
        if phase.name == name {
            return;
        }
        self.end(&phase);
        *phase = Phase::new(name);
        // Changing the length draws the bar, which has its style by then.
        self.bar
            .set_style(style("{spinner} {prefix}, {elapsed} elapsed"));
        self.bar.set_prefix(name.to_owned());
        self.bar.set_message("");
        self.bar.unset_length();
        self.bar.reset();
        match self.bar.is_hidden() {
            true => tell!("{name}"),
            false => self.bar.enable_steady_tick(BETWEEN_PICTURES),
        }
    }

    fn planned(&self, name: &str, total: usize, reused: usize, seconds: f64) {
        if reused > 0 {
            self.say(&format!("{reused} of {total} {name}s are there already"));
        }
        let mut phase = self.phase();
        phase.open += total - reused;
        if seconds > 0.0 {
            let template = "{prefix}: {bar:20} {percent} %, {left}  {wide_msg}";
            self.bar.set_style(style(template));
            let known = self.bar.length().unwrap_or(0);
            self.bar
                .set_length(known.saturating_add((1e9 * seconds) as u64));
        }
    }

    fn advanced(&self, seconds: f64) {
        self.bar.inc((1e9 * seconds) as u64);
        let mut phase = self.phase();
        if self.bar.is_hidden() && phase.last_line.elapsed() > BETWEEN_LINES {
            phase.last_line = Instant::now();
            let done = self.bar.position() as f64 / self.bar.length().unwrap_or(0).max(1) as f64;
            let left = time_left(done, phase.begun.elapsed());
            let Phase { name, .. } = &*phase;
            tell!("{name}: {:.0} % done, {left}", 100.0 * done);
        }
    }

    fn finished(&self, code: &Code, task: &dyn Display, result: Result<Option<f64>, &Failure>) {
        let (finished, open) = {
            let mut phase = self.phase();
            // An interrupted run counts neither as made nor as failed.
            let is_interrupted = matches!(result, Err(failure) if failure.is_interrupted());
            phase.finished += usize::from(!is_interrupted);
            phase.failed += usize::from(result.is_err() && !is_interrupted);
            (phase.finished, phase.open)
        };
        match result {
            Err(failure) if !failure.is_interrupted() => {
                self.complain(&format!("failed: {failure}"))
            }
            _ => self
                .bar
                .set_message(format!("[{finished}/{open}] {code}: {task}")),
        }
    }

    fn warn(&self, message: &str) {
        self.complain(&format!("warning: {message}"));
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        self.end(&self.phase());
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_said_once_it_can_be_estimated() {
        let seconds = Duration::from_secs;
        for (done, elapsed) in [(0.0, seconds(60)), (0.01, seconds(60)), (0.5, seconds(1))] {
            assert_eq!(time_left(done, elapsed), "time left not known yet");
        }
        assert_eq!(time_left(0.25, seconds(10)), "about 30 s left");
        assert_eq!(time_left(0.1, seconds(60)), "about 9 minutes left");
        assert_eq!(time_left(1.0, seconds(60)), "about 0.0 s left");
    }

    #[test]
    fn a_phase_in_which_nothing_was_made_ends_without_a_line() {
        let mut phase = Phase::new("compressions");
        assert_eq!(phase.summary(), None);
        (phase.open, phase.finished, phase.failed) = (90, 12, 2);
        let summary = phase.summary().expect("something was made");
        assert!(summary.starts_with("compressions: 10 of 90 made in "));
        assert!(summary.ends_with(", 2 failed"), "{summary}");
    }
}
