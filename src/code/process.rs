//! The one runner of foreign programs: a process group of its own, no shell, a time limit, bounded output.

use super::capture::Capture;
use super::guard;
use process_wrap::std::{ChildWrapper, CommandWrap, ProcessGroup};
use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// Longest interval between two polls that counts towards a time limit; tristack may have been suspended.
const LONGEST_INTERVAL: Duration = Duration::from_secs(1);
/// Longest time that a guard may take to clean up before it is killed.
const LONGEST_CLEANING: Duration = Duration::from_secs(5);

/// Names of the files that receive the output of a program.
pub(crate) const STANDARD_OUTPUT: &str = "stdout.txt";
/// See [`STANDARD_OUTPUT`].
pub(crate) const STANDARD_ERROR: &str = "stderr.txt";

/// Variables for the environment of a program.
pub type Environment = BTreeMap<String, String>;

/// A request to stop, shared by everything that runs.
#[derive(Debug, Default)]
pub struct Interrupt(AtomicBool);

impl Interrupt {
    /// No request yet.
    pub const fn new() -> Self {
        Self(AtomicBool::new(false))
    }

    /// Requests a stop; returns whether one was requested before.
    pub fn request(&self) -> bool {
        self.0.swap(true, Ordering::SeqCst)
    }

    /// Whether a stop was requested.
    pub(crate) fn requested(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

/// A program to run.
pub(crate) struct Job<'a> {
    /// Program, and the arguments given to it as they are.
    pub command: &'a [OsString],
    /// Its working directory.
    pub directory: &'a Path,
    /// Its home, and the place of its temporary files.
    pub home: &'a Path,
    /// Further variables of its otherwise minimal environment.
    pub environment: &'a Environment,
    /// Longest time without progress.
    pub time_limit: Duration,
    /// Ends the program when requested.
    pub interrupt: &'a Interrupt,
}

/// How a program ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// By itself.
    Exited(ExitStatus),
    /// Killed after the time limit.
    TimedOut,
    /// Killed because the user interrupted.
    Interrupted,
}

/// Runs `job` to its end, with its output in files of its directory. `progress` is polled while it runs; whenever
/// it returns true, the time limit starts anew.
pub fn run(job: &Job, progress: impl FnMut() -> bool) -> std::io::Result<Ending> {
    let output = File::create(job.directory.join(STANDARD_OUTPUT))?;
    let error = File::create(job.directory.join(STANDARD_ERROR))?;
    let mut child = spawn(job)?;
    let captures = [
        child.stdout().take().map(|pipe| Capture::new(pipe, output)),
        child.stderr().take().map(|pipe| Capture::new(pipe, error)),
    ];
    let ending = watch(job, child, progress);
    for capture in captures.into_iter().flatten() {
        capture.finish();
    }
    ending
}

/// Runs a short `job` to its end; returns how it ended and its standard output.
pub fn answer(job: &Job) -> std::io::Result<(Ending, Vec<u8>)> {
    let mut child = spawn(job)?;
    let output = child.stdout().take();
    let output = output.map(|pipe| Capture::new(pipe, Vec::new()));
    let error = child.stderr().take();
    let error = error.map(|pipe| Capture::new(pipe, std::io::sink()));
    let ending = watch(job, child, || false)?;
    error.map(Capture::finish);
    let written = output.and_then(Capture::finish);
    Ok((ending, written.unwrap_or_default()))
}

fn watch(
    job: &Job,
    mut child: Box<dyn ChildWrapper>,
    mut progress: impl FnMut() -> bool,
) -> std::io::Result<Ending> {
    let mut waited = Duration::ZERO;
    let mut last_poll = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            // Kills what is left of its process group.
            let _ = child.start_kill();
            return Ok(Ending::Exited(status));
        }
        if job.interrupt.requested() {
            kill(child.as_mut())?;
            return Ok(Ending::Interrupted);
        }
        if progress() {
            waited = Duration::ZERO;
        }
        if waited > job.time_limit {
            kill(child.as_mut())?;
            return Ok(Ending::TimedOut);
        }
        std::thread::sleep(POLL_INTERVAL);
        waited += last_poll.elapsed().min(LONGEST_INTERVAL);
        last_poll = Instant::now();
    }
}

fn spawn(job: &Job) -> std::io::Result<Box<dyn ChildWrapper>> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let prefix = guard::prefix();
    let mut words = prefix
        .iter()
        .copied()
        .chain(job.command.iter().map(OsString::as_os_str));
    let program = words.next().unwrap_or(OsStr::new(""));
    CommandWrap::with_new(program, |command| {
        command
            .args(words)
            .current_dir(job.directory)
            .env_clear()
            .env("PATH", path)
            .env("HOME", job.home)
            .env("TMPDIR", job.home)
            .env("LC_ALL", "C.UTF-8")
            .env("OMP_NUM_THREADS", "1")
            .envs(job.environment)
            // A guard ends when its input closes; other programs get no input.
            .stdin(if prefix.is_empty() {
                Stdio::null()
            } else {
                Stdio::piped()
            })
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
    })
    .wrap(ProcessGroup::leader())
    .spawn()
}

/// Lets a guard clean up, if there is one, and kills the remaining processes.
fn kill(child: &mut dyn ChildWrapper) -> std::io::Result<()> {
    let guarded = child.stdin().take().is_some();
    let start = Instant::now();
    while guarded && child.try_wait()?.is_none() && start.elapsed() < LONGEST_CLEANING {
        std::thread::sleep(POLL_INTERVAL);
    }
    // There may be nothing left to kill.
    let _ = child.start_kill();
    child.wait()?;
    Ok(())
}
