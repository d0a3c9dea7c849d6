//! The one runner of foreign programs: a process group of its own, no shell, a time limit, output in files.

use process_wrap::std::{ChildWrapper, CommandWrap, ProcessGroup};
use std::ffi::OsString;
use std::fs::File;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const POLL_INTERVAL: Duration = Duration::from_millis(10);

/// Names of the files that receive what the program writes.
pub const STANDARD_OUTPUT: &str = "stdout.txt";
/// See [`STANDARD_OUTPUT`].
pub const STANDARD_ERROR: &str = "stderr.txt";

/// The user's wish to stop, shared by everything that runs.
#[derive(Debug, Default)]
pub struct Interrupt(AtomicBool);

impl Interrupt {
    /// Nobody wants to stop yet.
    pub const fn new() -> Self {
        Self(AtomicBool::new(false))
    }

    /// Asks everything to stop.
    pub fn request(&self) {
        self.0.store(true, Ordering::SeqCst);
    }

    /// Whether everything should stop.
    pub fn requested(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

/// A program to run.
pub struct Job<'a> {
    /// Program, and the arguments given to it as they are.
    pub command: &'a [OsString],
    /// Its working directory.
    pub directory: &'a Path,
    /// Further variables of its otherwise minimal environment.
    pub environment: &'a [(&'a str, &'a str)],
    /// Longest time without progress.
    pub time_limit: Duration,
    /// Set when the user wants to stop.
    pub interrupt: &'a Interrupt,
}

/// How a program ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// By itself.
    Exited(ExitStatus),
    /// Killed after the time limit.
    TimedOut,
    /// Killed because the user interrupted.
    Interrupted,
}

/// Runs `job` to its end. `progress` is called while it runs and says whether something was finished,
/// which starts the time limit anew.
///
/// # Errors
/// If the program cannot be started or watched.
pub fn run(job: &Job, progress: impl FnMut() -> bool) -> std::io::Result<Ending> {
    let scratch = tempfile::Builder::new()
        .prefix(".scratch-")
        .tempdir_in(job.directory)?;
    watch(job, spawn(job, scratch.path())?, progress)
}

fn watch(
    job: &Job,
    mut child: Box<dyn ChildWrapper>,
    mut progress: impl FnMut() -> bool,
) -> std::io::Result<Ending> {
    let mut last_progress = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            // What the program left behind in its group goes with it.
            let _ = child.start_kill();
            return Ok(Ending::Exited(status));
        }
        if job.interrupt.requested() {
            kill(child.as_mut())?;
            return Ok(Ending::Interrupted);
        }
        if last_progress.elapsed() > job.time_limit {
            kill(child.as_mut())?;
            return Ok(Ending::TimedOut);
        }
        if progress() {
            last_progress = Instant::now();
        }
        std::thread::sleep(POLL_INTERVAL);
    }
}

/// Home and temporary files go to `scratch`, which does not outlive the program.
fn spawn(job: &Job, scratch: &Path) -> std::io::Result<Box<dyn ChildWrapper>> {
    let output = File::create(job.directory.join(STANDARD_OUTPUT))?;
    let error = File::create(job.directory.join(STANDARD_ERROR))?;
    let path = std::env::var_os("PATH").unwrap_or_default();
    CommandWrap::with_new(&job.command[0], |command| {
        command
            .args(&job.command[1..])
            .current_dir(job.directory)
            .env_clear()
            .env("PATH", path)
            .env("HOME", scratch)
            .env("TMPDIR", scratch)
            .env("LC_ALL", "C.UTF-8")
            .env("OMP_NUM_THREADS", "1")
            .envs(job.environment.iter().copied())
            .stdin(Stdio::null())
            .stdout(output)
            .stderr(error);
    })
    .wrap(ProcessGroup::leader())
    .spawn()
}

fn kill(child: &mut dyn ChildWrapper) -> std::io::Result<()> {
    child.start_kill()?;
    child.wait()?;
    Ok(())
}
