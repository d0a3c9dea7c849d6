//! The one runner of foreign programs: a process group of its own, no shell, a time limit, bounded output.

use super::capture::capture;
use super::failure::FailureKind;
use super::guard;
use super::interrupt::Interrupt;
use super::manifest::Environment;
use nix::sys::signal::Signal;
use process_wrap::std::{ChildWrapper, CommandWrap, ProcessGroup};
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{ExitStatus, Stdio};
use std::time::{Duration, Instant};

const POLL_INTERVAL: Duration = Duration::from_millis(10);
/// Longest interval between two polls that counts towards a time limit; a longer one means that tristack was
/// suspended.
const LONGEST_INTERVAL: Duration = Duration::from_secs(1);
/// Longest time that a guard may take to clean up before it is killed.
const LONGEST_CLEANING: Duration = Duration::from_secs(5);
/// Longest wait for a pipe after its program has ended: a process that outlives it may keep the pipe open.
const LONGEST_REST: Duration = Duration::from_secs(1);

/// A program to run.
pub(crate) struct Job<'a> {
    /// The program and its arguments, which are passed on as they are.
    pub command: &'a [OsString],
    /// Its working directory.
    pub directory: &'a Path,
    /// Its home, which also takes its temporary files.
    pub home: &'a Path,
    /// Further variables of its otherwise minimal environment.
    pub environment: &'a Environment,
    /// Longest time without progress.
    pub time_limit: Duration,
    /// Ends the program when requested.
    pub interrupt: &'a Interrupt,
}

/// Runs `job` to its end and copies its output to `output` and `error`. Returns the status with which it ended by
/// itself, and `output` if that is complete. Polls `progress` while the program runs; whenever it returns true, the
/// time limit starts anew.
pub fn run<W: Write + Send + 'static>(
    job: &Job,
    output: W,
    error: impl Write + Send + 'static,
    progress: impl FnMut() -> bool,
) -> Result<(ExitStatus, Option<W>), FailureKind> {
    let mut child = spawn(job)?;
    let output = child.stdout().take().map(|pipe| capture(pipe, output));
    let error = child.stderr().take().map(|pipe| capture(pipe, error));
    let (output, error) = match (output.transpose(), error.transpose()) {
        (Ok(output), Ok(error)) => (output, error),
        (Err(error), _) | (_, Err(error)) => {
            kill(child.as_mut())?;
            return Err(error.into());
        }
    };
    let status = watch(job, child, progress);
    error.and_then(|copied| copied.recv_timeout(LONGEST_REST).ok());
    let output = output.and_then(|copied| copied.recv_timeout(LONGEST_REST).ok());
    Ok((status?, output))
}

fn watch(
    job: &Job,
    mut child: Box<dyn ChildWrapper>,
    mut progress: impl FnMut() -> bool,
) -> Result<ExitStatus, FailureKind> {
    let mut waited = Duration::ZERO;
    let mut last_poll = Instant::now();
    loop {
        if let Some(ended) = child.try_wait().transpose() {
            // Kills what is left of its process group.
            let _ = child.start_kill();
            if guard::ended(child.id()) {
                return Err(FailureKind::Unguarded);
            }
            // The group of a guard that was killed had nobody to wait for, which is an error.
            let status = ended?;
            return match ended_with_tristack(job, status) {
                true => Err(FailureKind::Interrupted),
                false => Ok(status),
            };
        }
        if job.interrupt.requested() {
            kill(child.as_mut())?;
            return Err(FailureKind::Interrupted);
        }
        if progress() {
            waited = Duration::ZERO;
        }
        if waited > job.time_limit {
            kill(child.as_mut())?;
            return Err(FailureKind::TimedOut(job.time_limit));
        }
        std::thread::sleep(POLL_INTERVAL);
        waited += last_poll.elapsed().min(LONGEST_INTERVAL);
        last_poll = Instant::now();
    }
}

/// Whether the program ended with `status` because everything that runs was sent a signal to end, as batch systems
/// do: tristack then learns of it at about the same time.
fn ended_with_tristack(job: &Job, status: ExitStatus) -> bool {
    let asked = [
        Signal::SIGTERM,
        Signal::SIGINT,
        Signal::SIGHUP,
        Signal::SIGUSR1,
    ];
    let signal = status.signal().and_then(|it| Signal::try_from(it).ok());
    if !signal.is_some_and(|signal| asked.contains(&signal)) {
        return false;
    }
    let start = Instant::now();
    while !job.interrupt.requested() && start.elapsed() < LONGEST_REST {
        std::thread::sleep(POLL_INTERVAL);
    }
    job.interrupt.requested()
}

fn spawn(job: &Job) -> std::io::Result<Box<dyn ChildWrapper>> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let prefix = guard::prefix();
    let command = job.command.iter().map(OsString::as_os_str);
    let mut words = prefix.iter().copied().chain(command);
    let program = words.next().unwrap_or(OsStr::new(""));
    // A guard ends when its input closes; other programs get no input.
    let input = match prefix.as_slice() {
        [] => Stdio::null(),
        _ => Stdio::piped(),
    };
    let mut guarded = CommandWrap::with_new(program, |command| {
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
            .stdin(input)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
    });
    guarded.wrap(ProcessGroup::leader());
    guard::start(|| guarded.spawn(), |child| child.id())
}

/// Lets a guard clean up, if there is one, and kills the remaining processes.
fn kill(child: &mut dyn ChildWrapper) -> std::io::Result<()> {
    let ended = end(child);
    // Whatever its end was like, nothing of it stays.
    guard::ended(child.id());
    ended
}

fn end(child: &mut dyn ChildWrapper) -> std::io::Result<()> {
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
