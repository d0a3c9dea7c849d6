//! Tasks for one process of an external code: run directories, the runner, blame, outcomes read back.

use super::deck::only_numbers;
use super::external::ExternalCode;
use super::process::{Ending, Job, STANDARD_ERROR, STANDARD_OUTPUT, run};
use super::task::{Deck, Task};
use super::{Failure, FailureKind, Finished, RunContext};
use crate::files::{FileError, remove_abandoned};
use std::ffi::OsString;
use std::fs;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Some thirty times the start-up and the slowest step that were ever seen.
pub(super) const LONGEST_START: Duration = Duration::from_secs(30);
const LONGEST_STEP: Duration = Duration::from_micros(100);
const LAST_LINES: usize = 4;
const HOME: &str = ".home-";
const TAIL_BYTES: u64 = 4096;

/// Time after which a task of so many steps counts as hanging.
pub fn time_limit(steps: u64) -> Duration {
    LONGEST_START + LONGEST_STEP.saturating_mul(u32::try_from(steps).unwrap_or(u32::MAX))
}

/// Some tasks for one process.
pub struct Batch<'a, T: Task> {
    code: &'a ExternalCode,
    deck: &'a Deck<T>,
    tasks: &'a [T],
    directory: PathBuf,
    /// Directories of the tasks, relative to `directory`.
    task_directories: Vec<String>,
    /// Which tasks have been reported.
    reported: Vec<bool>,
    last_report: Instant,
}

/// Receives the outcome of a task and the seconds that it took.
type Report<'a, T> = Finished<'a, (<T as Task>::Outcome, f64)>;

impl<'a, T: Task> Batch<'a, T> {
    /// `tasks` for one process of `code`, in `directory`.
    pub fn new(
        code: &'a ExternalCode,
        deck: &'a Deck<T>,
        tasks: &'a [T],
        directory: PathBuf,
    ) -> Self {
        let task_directories: Vec<String> = match tasks {
            [_] => vec![".".to_owned()],
            _ => (0..tasks.len())
                .map(|index| format!("case-{index}"))
                .collect(),
        };
        Self {
            code,
            deck,
            tasks,
            directory,
            task_directories,
            reported: vec![false; tasks.len()],
            last_report: Instant::now(),
        }
    }

    /// Number of tasks up to the last one that has been reported. Those beyond have had no chance.
    pub fn settled(&self) -> usize {
        let last = self.reported.iter().rposition(|&reported| reported);
        last.map_or(0, |index| index + 1)
    }

    /// Runs the process and reports tasks, at least the first one. Those beyond the last reported one have
    /// had no chance, because it took the process down.
    pub fn run(&mut self, context: &RunContext, report: Report<T>) {
        if context.interrupt.requested() {
            for index in 0..self.tasks.len() {
                self.fail(index, FailureKind::Interrupted, report);
            }
            return;
        }
        if let Err(kind) = self.prepare() {
            // Nothing may be read from directories that have not been cleared.
            return self.fail(0, kind, report);
        }
        let outcome = self.run_process(context, report);
        self.harvest(report);
        let delivered = self.settled();
        for index in 0..delivered {
            if !self.reported[index] {
                self.fail(index, FailureKind::Skipped, report);
            }
        }
        if delivered == self.tasks.len() {
            return;
        }
        match outcome {
            Ok(Ending::Exited(status)) if status.success() => self.read(delivered, report),
            Ok(Ending::Exited(status)) => self.fail(delivered, FailureKind::Ended(status), report),
            Ok(Ending::TimedOut) => {
                let limit = self.time_limit(context);
                self.fail(delivered, FailureKind::TimedOut(limit), report);
            }
            Ok(Ending::Interrupted) => {
                for index in delivered..self.tasks.len() {
                    self.fail(index, FailureKind::Interrupted, report);
                }
            }
            Err(kind) => self.fail(delivered, kind, report),
        }
    }

    fn prepare(&self) -> Result<(), FailureKind> {
        self.code.installation.check_unchanged()?;
        let adapter = self.code.adapter;
        for (index, task) in self.tasks.iter().enumerate() {
            let accepted = adapter.name.check_convention(task.convention());
            accepted.map_err(FailureKind::Unsupported)?;
            let directory = self.task_directory(index);
            fs::create_dir_all(&directory).map_err(FileError::writing(&directory))?;
            let (file, parameters) = (adapter.parameter_file, task.parameters());
            only_numbers(&parameters).map_err(FailureKind::Unsupported)?;
            write(&directory.join(file.name()), &file.content(&parameters))?;
            for (name, content) in task.files() {
                write(&directory.join(name), &content)?;
            }
            // What an earlier run left behind must not pass for the result of this one.
            for stale in self.deck.completion_file.iter().chain(adapter.logs) {
                remove(&directory.join(stale))?;
            }
        }
        for (name, content) in self.deck.files {
            write(&self.directory.join(name), content)?;
        }
        Ok(())
    }

    fn run_process(
        &mut self,
        context: &RunContext,
        report: Report<T>,
    ) -> Result<Ending, FailureKind> {
        let command = self.code.command(self.deck, &self.task_directories);
        let mut command: Vec<OsString> = command.into_iter().map(OsString::from).collect();
        command[0] = self.code.installation.program.clone().into_os_string();
        let directory = self.directory.clone();
        // In the directory of a user, a killed program may have left one.
        remove_abandoned(&directory, HOME.as_ref());
        let home = tempfile::Builder::new()
            .prefix(HOME)
            .tempdir_in(&directory)
            .map_err(FailureKind::Start)?;
        let held = fs::File::open(home.path()).map_err(FailureKind::Start)?;
        let _ = held.try_lock();
        let job = Job {
            command: &command,
            directory: &directory,
            home: &std::path::absolute(home.path()).map_err(FailureKind::Start)?,
            environment: self.code.adapter.environment,
            time_limit: self.time_limit(context),
            interrupt: context.interrupt,
        };
        run(&job, || self.harvest(report)).map_err(FailureKind::Start)
    }

    fn time_limit(&self, context: &RunContext) -> Duration {
        let longest = self
            .tasks
            .iter()
            .map(Task::time_limit)
            .max()
            .unwrap_or(LONGEST_START);
        context.time_limit.unwrap_or(longest)
    }

    /// Reports the tasks that have become complete; says whether there was one.
    fn harvest(&mut self, report: Report<T>) -> bool {
        let complete = |index: &usize| !self.reported[*index] && self.is_complete(*index);
        let complete: Vec<usize> = (0..self.tasks.len()).filter(complete).collect();
        for &index in &complete {
            self.read(index, report);
        }
        !complete.is_empty()
    }

    fn is_complete(&self, index: usize) -> bool {
        let file = self.deck.completion_file;
        file.is_some_and(|file| self.task_directory(index).join(file).is_file())
    }

    fn task_directory(&self, index: usize) -> PathBuf {
        match self.task_directories[index].as_str() {
            "." => self.directory.clone(),
            name => self.directory.join(name),
        }
    }

    fn read(&mut self, index: usize, report: Report<T>) {
        let directory = self.task_directory(index);
        let outcome = (self.deck.read)(&directory, &self.tasks[index]).map_err(FailureKind::Series);
        // A program that was replaced meanwhile may not be the one that answered.
        let unchanged = self.code.installation.check_unchanged();
        match outcome.and_then(|outcome| unchanged.map(|()| outcome)) {
            Ok(outcome) => {
                let seconds = self.last_report.elapsed().as_secs_f64();
                self.report(index, Ok((outcome, seconds)), report);
            }
            Err(kind) => self.fail(index, kind, report),
        }
    }

    fn fail(&mut self, index: usize, kind: FailureKind, report: Report<T>) {
        let failure = Failure {
            code: self.code.adapter.name,
            subject: self.tasks[index].to_string(),
            kind,
            run_directory: Some(self.task_directory(index)),
            last_lines: self.last_lines(),
        };
        self.report(index, Err(failure), report);
    }

    fn report(
        &mut self,
        index: usize,
        result: Result<(T::Outcome, f64), Failure>,
        report: Report<T>,
    ) {
        report(index, result);
        self.reported[index] = true;
        self.last_report = Instant::now();
    }

    fn last_lines(&self) -> Vec<String> {
        let logs = self.code.adapter.logs.iter().copied();
        logs.chain([STANDARD_OUTPUT, STANDARD_ERROR])
            .flat_map(|name| {
                let lines = tail(&self.directory.join(name));
                lines.into_iter().map(move |line| format!("{name}: {line}"))
            })
            .collect()
    }
}

fn write(path: &Path, content: &str) -> Result<(), FailureKind> {
    fs::write(path, content).map_err(|error| FileError::writing(path)(error).into())
}

fn remove(path: &Path) -> Result<(), FailureKind> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(FileError::writing(path)(error).into())
        }
        _ => Ok(()),
    }
}

/// The last lines of a file that are not blank; bytes that are not text are replaced.
fn tail(path: &Path) -> Vec<String> {
    let Ok(mut file) = fs::File::open(path) else {
        return Vec::new();
    };
    let length = file.metadata().map_or(0, |metadata| metadata.len());
    let mut bytes = Vec::new();
    let start = length.saturating_sub(TAIL_BYTES);
    let read = file
        .seek(SeekFrom::Start(start))
        .and_then(|_| file.take(TAIL_BYTES).read_to_end(&mut bytes));
    if read.is_err() {
        return Vec::new();
    }
    let text = String::from_utf8_lossy(&bytes);
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    let skipped = lines.len().saturating_sub(LAST_LINES);
    lines[skipped..]
        .iter()
        .map(|line| (*line).to_owned())
        .collect()
}
