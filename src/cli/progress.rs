//! Progress on standard error: a bar on a terminal, plain lines elsewhere.

use crate::archive::Run;
use crate::crosscheck::Progress;
use crate::engine::{EngineName, Failure};
use crate::report::friction;
use crate::stack::Case;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

/// Tells the user how far it is.
pub struct Reporter {
    bar: Option<ProgressBar>,
    lines: ProgressBar,
}

impl Reporter {
    /// A reporter for the standard error of this process.
    pub fn new() -> Self {
        let terminal = std::io::stderr().is_terminal();
        Self {
            bar: terminal.then(|| ProgressBar::new(0).with_style(style())),
            // Not drawn: it only counts for the plain lines.
            lines: ProgressBar::with_draw_target(Some(0), ProgressDrawTarget::hidden()),
        }
    }

    fn say(&self, line: &str) {
        match &self.bar {
            Some(bar) => bar.println(line),
            None => eprintln!("{line}"),
        }
    }
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:40} {pos}/{len} runs, {elapsed} elapsed, {eta} left  {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}

impl Progress for Reporter {
    fn planned(&self, total: usize, reused: usize) {
        let open = (total - reused) as u64;
        self.lines.inc_length(open);
        if let Some(bar) = &self.bar {
            bar.inc_length(open);
        }
        if reused > 0 {
            self.say(&format!("{reused} of {total} runs are there already"));
        }
    }

    fn finished(&self, engine: EngineName, case: &Case, result: Result<&Run, &Failure>) {
        self.lines.inc(1);
        let subject = format!(
            "{engine} mu={} stiffness={} speed={:.2e} dt={}",
            friction(case.stack.floor_friction),
            case.stack.stiffness,
            case.protocol.wall_speed,
            case.protocol.time_step
        );
        if let Err(failure) = result
            && !failure.is_interrupted()
        {
            self.say(&format!("failed: {failure}"));
        }
        match (&self.bar, result) {
            (Some(bar), _) => {
                bar.set_message(subject);
                bar.inc(1);
            }
            (None, Ok(run)) => {
                let length = self.lines.length().unwrap_or(0);
                let seconds = run.provenance.seconds;
                eprintln!(
                    "[{}/{length}] {subject}: {seconds:.2} s",
                    self.lines.position()
                );
            }
            (None, Err(_)) => {}
        }
    }

    fn warn(&self, message: &str) {
        self.say(&format!("warning: {message}"));
    }
}

impl Drop for Reporter {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Counts tasks that are all alike: a bar on a terminal, nothing elsewhere.
pub struct Counter {
    bar: ProgressBar,
}

impl Counter {
    /// A counter up to `total`.
    pub fn new(total: usize) -> Self {
        let target = if std::io::stderr().is_terminal() {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(total as u64), target);
        Self {
            bar: bar.with_style(style()),
        }
    }

    /// Some more tasks are done.
    pub fn add(&self, done: usize) {
        self.bar.inc(done as u64);
    }
}

impl Drop for Counter {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
