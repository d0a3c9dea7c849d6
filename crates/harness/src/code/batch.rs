//! A batch of tasks for one process of an external code: run directories, the run, outcomes and failures.

use super::failure::{Failure, FailureKind};
use super::installation::ExternalCode;
use super::installed::{Finished, RunContext};
use super::manifest::ResultFile;
use super::process::{Job, run};
use super::task::Task;
use super::written::{HOME, STANDARD_ERROR, STANDARD_OUTPUT, last_lines};
use crate::files::{FileError, create_anew, locked_directory, remove_abandoned, remove_older};
use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::time::{Duration, Instant};

/// Permissions of the home directory of the process.
const PRIVATE: u32 = 0o700;

/// Tasks of one kind that one process carries out.
pub(crate) struct Batch<'a, T: Task> {
    code: &'a ExternalCode,
    result: ResultFile,
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
    /// Creates the batch of `tasks`, at least one, for one process of `code` in `directory`.
    pub fn new(code: &'a ExternalCode, tasks: &'a [T], directory: PathBuf) -> Self {
        let task_directories: Vec<String> = match tasks {
            [_] => vec![".".to_owned()],
            _ => (0..tasks.len())
                .map(|index| format!("case-{index}"))
                .collect(),
        };
        Self {
            code,
            result: code.definition().result(tasks[0].kind()),
            tasks,
            directory,
            task_directories,
            reported: vec![false; tasks.len()],
            last_report: Instant::now(),
        }
    }

    /// Number of tasks up to the last reported one. Those beyond it were never started.
    pub(crate) fn finished(&self) -> usize {
        let last = self.reported.iter().rposition(|&reported| reported);
        last.map_or(0, |index| index + 1)
    }

    /// Runs the process and reports at least the first task. A task that ends the process is reported as failed;
    /// those after it are not reported.
    pub fn run(&mut self, context: &RunContext, report: Report<T>) {
        if context.interrupt.requested() {
            return self.interrupt_from(0, report);
        }
        if let Err(kind) = self.prepare() {
            // Directories that have not been cleared must not be read.
            return self.fail(0, kind, report);
        }
        let outcome = self.run_process(context, report);
        if matches!(outcome, Err(FailureKind::Unguarded)) {
            for index in self.finished()..self.tasks.len() {
                self.fail(index, FailureKind::Unguarded, report);
            }
            return;
        }
        self.harvest(report);
        let delivered = self.finished();
        for index in 0..delivered {
            if !self.reported[index] {
                self.fail(index, FailureKind::Skipped, report);
            }
        }
        if delivered == self.tasks.len() {
            return;
        }
        match outcome {
            Ok(status) if status.success() => self.read(delivered, report),
            Ok(status) => self.fail(delivered, FailureKind::Ended(status), report),
            Err(FailureKind::Interrupted) => self.interrupt_from(delivered, report),
            Err(kind) => self.fail(delivered, kind, report),
        }
    }

    fn prepare(&self) -> Result<(), FailureKind> {
        self.code.check_unchanged()?;
        for (index, task) in self.tasks.iter().enumerate() {
            let accepted = self.code.name.check_convention_of(task);
            accepted.map_err(FailureKind::Unsupported)?;
            let directory = self.task_directory(index);
            fs::create_dir_all(&directory).map_err(FileError::writing(&directory))?;
            let files = self.code.definition().files_of(task);
            for (name, content) in files.map_err(FailureKind::Unsupported)? {
                write(&directory.join(name), content.as_bytes())?;
            }
            // Files of an earlier run must not be mistaken for results of this one.
            for stale in self.code.program().logs.iter().chain([&self.result.file]) {
                remove(&directory.join(stale))?;
            }
        }
        for (name, content) in self.code.definition().files(self.tasks[0].kind()) {
            write(&self.directory.join(name), content)?;
        }
        Ok(())
    }

    fn run_process(
        &mut self,
        context: &RunContext,
        report: Report<T>,
    ) -> Result<ExitStatus, FailureKind> {
        let kind = self.tasks[0].kind();
        let command = self.code.command(kind, &self.task_directories);
        let mut command: Vec<OsString> = command.into_iter().map(OsString::from).collect();
        command[0] = self.code.file.clone().into_os_string();
        let directory = self.directory.clone();
        // A killed process may have left its home behind in a directory of the user.
        remove_abandoned(&directory, HOME.as_ref());
        let (home, _lock) = locked_directory(&directory, HOME, PRIVATE)?;
        let job = Job {
            command: &command,
            directory: &directory,
            home: &std::path::absolute(home.path())?,
            environment: &self.code.program().environment,
            time_limit: self.time_limit(context),
            interrupt: context.interrupt,
        };
        let [output, error] =
            [STANDARD_OUTPUT, STANDARD_ERROR].map(|name| create_anew(&directory.join(name)));
        let (status, _) = run(&job, output?, error?, || self.harvest(report))?;
        Ok(status)
    }

    fn time_limit(&self, context: &RunContext) -> Duration {
        let steps = self.tasks.iter().map(Task::steps).max();
        let longest = self.code.definition().time_limit(steps.unwrap_or(0));
        context.time_limit.unwrap_or(longest)
    }

    /// Reports the tasks that have become complete; returns whether there were any.
    fn harvest(&mut self, report: Report<T>) -> bool {
        let complete = |index: &usize| !self.reported[*index] && self.is_complete(*index);
        let complete: Vec<usize> = (0..self.tasks.len()).filter(complete).collect();
        for &index in &complete {
            self.read(index, report);
        }
        !complete.is_empty()
    }

    fn is_complete(&self, index: usize) -> bool {
        let file = self.task_directory(index).join(&self.result.file);
        self.code.definition().runs_many() && is_regular(&file)
    }

    fn task_directory(&self, index: usize) -> PathBuf {
        match self.task_directories[index].as_str() {
            "." => self.directory.clone(),
            name => self.directory.join(name),
        }
    }

    fn read(&mut self, index: usize, report: Report<T>) {
        let directory = self.task_directory(index);
        let outcome = self.tasks[index].read_outcome(&directory, &self.result);
        let outcome = outcome.map_err(FailureKind::Series);
        // If the program was replaced meanwhile, another one may have run.
        let unchanged = self.code.check_unchanged();
        match outcome.and_then(|outcome| unchanged.map(|()| outcome)) {
            Ok(outcome) => {
                let seconds = self.last_report.elapsed().as_secs_f64();
                self.report(index, Ok((outcome, seconds)), report);
            }
            Err(kind) => self.fail(index, kind, report),
        }
    }

    fn interrupt_from(&mut self, first: usize, report: Report<T>) {
        for index in first..self.tasks.len() {
            self.fail(index, FailureKind::Interrupted, report);
        }
    }

    fn fail(&mut self, index: usize, kind: FailureKind, report: Report<T>) {
        let failure = Failure {
            code: self.code.name.clone(),
            subject: self.tasks[index].to_string(),
            kind,
            run_directory: Some(self.task_directory(index)),
            last_lines: last_lines(&self.directory, &self.code.program().logs),
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
}

/// Writes a file of a task and creates its folder if necessary.
fn write(path: &Path, content: &[u8]) -> Result<(), FailureKind> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = folder.and_then(|()| create_anew(path)?.write_all(content));
    written.map_err(|error| FileError::writing(path)(error).into())
}

fn remove(path: &Path) -> Result<(), FailureKind> {
    remove_older(path).map_err(|error| FileError::writing(path)(error).into())
}

fn is_regular(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|found| found.is_file())
}
