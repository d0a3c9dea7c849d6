//! An external code as an engine: run directories, the shared runner, the series read back.

use super::installation::{self, Installation};
use super::process::{Ending, Job, STANDARD_ERROR, STANDARD_OUTPUT, run};
use super::{DeckParameters, Engine, EngineName, Failure, FailureKind, Workplace};
use crate::archive::{ArchiveError, Identity, Provenance, Run};
use crate::stack::{Case, sha256_hex};
use crate::trace::{SeriesError, Trace};
use std::ffi::OsString;
use std::fs;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::process::ExitStatus;
use std::time::{Duration, Instant};

/// Some thirty times the start-up and the slowest step that were ever seen.
const LONGEST_START: Duration = Duration::from_secs(30);
const LONGEST_STEP: Duration = Duration::from_micros(100);
const LAST_LINES: usize = 4;
const TAIL_BYTES: u64 = 4096;

/// Time after which a run of `case` counts as hanging.
pub fn time_limit(case: &Case) -> Duration {
    let steps = case.protocol.schedule().total_steps();
    LONGEST_START + LONGEST_STEP.saturating_mul(u32::try_from(steps).unwrap_or(u32::MAX))
}

/// What has to be known about an external code.
pub struct Adapter {
    pub(super) name: EngineName,
    /// Program in the search path.
    pub(super) program: &'static str,
    /// Arguments that make it print its version.
    pub(super) version_arguments: &'static [&'static str],
    /// Files of the deck, by name and content.
    pub(super) deck: &'static [(&'static str, &'static str)],
    /// Variables of its environment.
    pub(super) environment: &'static [(&'static str, &'static str)],
    /// Files of its own, in the working directory, that say what went wrong.
    pub(super) logs: &'static [&'static str],
    /// Name of the parameter file, and its content.
    pub(super) parameter_file: &'static str,
    pub(super) parameters: fn(&DeckParameters) -> String,
    /// Arguments that run the cases in the given directories.
    pub(super) arguments: fn(&[String]) -> Vec<String>,
    /// For a code that runs many cases in one process: the file of a case that appears when its series is
    /// complete.
    pub(super) completion_file: Option<&'static str>,
    /// Reads the series from the directory of a case.
    pub(super) read_series: fn(&Path, &Case) -> Result<Trace, SeriesError>,
}

impl Adapter {
    pub(super) fn deck_hash(&self) -> String {
        let content: Vec<&str> = self.deck.iter().map(|&(_, content)| content).collect();
        sha256_hex(content.concat().as_bytes())
    }
}

/// An external code that is installed.
pub struct ExternalEngine {
    adapter: &'static Adapter,
    installation: Installation,
    identity: Identity,
}

impl ExternalEngine {
    pub(super) fn find(adapter: &'static Adapter) -> Option<Box<dyn Engine>> {
        let installation = installation::find(adapter.program, adapter.version_arguments)?;
        let identity = Identity {
            engine: adapter.name.as_str().to_owned(),
            version: installation.version.clone(),
            package: installation.package.clone(),
            deck_hash: adapter.deck_hash(),
        };
        Some(Box::new(Self {
            adapter,
            installation,
            identity,
        }))
    }
}

impl ExternalEngine {
    /// Program and arguments that run the cases in `directories`.
    fn command(&self, directories: &[String]) -> Vec<String> {
        let mut command = vec![self.adapter.program.to_owned()];
        command.extend((self.adapter.arguments)(directories));
        command
    }
}

impl Engine for ExternalEngine {
    fn name(&self) -> EngineName {
        self.adapter.name
    }

    fn identity(&self) -> &Identity {
        &self.identity
    }

    fn prefers_many_cases(&self) -> bool {
        self.adapter.completion_file.is_some()
    }

    fn run(
        &self,
        cases: &[Case],
        workplace: &Workplace,
        finished: &mut dyn FnMut(usize, Result<Run, Failure>),
    ) {
        let at_once = if self.prefers_many_cases() {
            cases.len()
        } else {
            1
        };
        let mut next = 0;
        while next < cases.len() {
            let end = (next + at_once).min(cases.len());
            let directory = if cases.len() == 1 {
                workplace.directory.to_owned()
            } else {
                workplace
                    .directory
                    .join(format!("{}-{next}", self.adapter.program))
            };
            let mut batch = Batch::new(self, &cases[next..end], directory);
            let mut report = |index: usize, result| finished(next + index, result);
            batch.run(workplace, &mut report);
            next += batch.next;
        }
    }
}

/// Some cases for one process.
struct Batch<'a> {
    engine: &'a ExternalEngine,
    cases: &'a [Case],
    directory: PathBuf,
    /// Directories of the cases, relative to `directory`.
    case_directories: Vec<String>,
    /// First case whose result has not been reported yet.
    next: usize,
    last_report: Instant,
}

type Report<'a> = &'a mut dyn FnMut(usize, Result<Run, Failure>);

impl<'a> Batch<'a> {
    fn new(engine: &'a ExternalEngine, cases: &'a [Case], directory: PathBuf) -> Self {
        let case_directories: Vec<String> = match cases {
            [_] => vec![".".to_owned()],
            _ => (0..cases.len())
                .map(|index| format!("case-{index}"))
                .collect(),
        };
        Self {
            engine,
            cases,
            directory,
            case_directories,
            next: 0,
            last_report: Instant::now(),
        }
    }

    /// Runs the process and reports cases from the first one on, at least one of them. Those that are not
    /// reported have had no chance: an earlier case took the process down.
    fn run(&mut self, workplace: &Workplace, report: Report) {
        let outcome = match self.prepare() {
            Ok(()) => self.run_process(workplace, report),
            Err(kind) => Err(kind),
        };
        match outcome {
            Ok(Ending::Exited(status)) => self.conclude(status, report),
            Ok(Ending::TimedOut) => {
                let limit = self.time_limit(workplace);
                self.fail(FailureKind::TimedOut(limit), report);
            }
            Ok(Ending::Interrupted) => {
                while self.next < self.cases.len() {
                    self.fail(FailureKind::Interrupted, report);
                }
            }
            Err(kind) => self.fail(kind, report),
        }
    }

    fn prepare(&self) -> Result<(), FailureKind> {
        let adapter = self.engine.adapter;
        for (case, name) in self.cases.iter().zip(&self.case_directories) {
            let accepted = adapter.name.check_convention(&case.convention);
            accepted.map_err(FailureKind::Unsupported)?;
            let directory = self.directory.join(name);
            fs::create_dir_all(&directory).map_err(ArchiveError::writing(&directory))?;
            let content = (adapter.parameters)(&DeckParameters::new(case));
            write(&directory.join(adapter.parameter_file), &content)?;
        }
        for (name, content) in adapter.deck {
            write(&self.directory.join(name), content)?;
        }
        Ok(())
    }

    fn run_process(
        &mut self,
        workplace: &Workplace,
        report: Report,
    ) -> Result<Ending, FailureKind> {
        let command = self.engine.command(&self.case_directories);
        let mut command: Vec<OsString> = command.into_iter().map(OsString::from).collect();
        command[0] = self.engine.installation.program.clone().into_os_string();
        let directory = self.directory.clone();
        let job = Job {
            command: &command,
            directory: &directory,
            environment: self.engine.adapter.environment,
            time_limit: self.time_limit(workplace),
            interrupt: workplace.interrupt,
        };
        run(&job, || self.harvest(report)).map_err(FailureKind::Start)
    }

    fn time_limit(&self, workplace: &Workplace) -> Duration {
        let longest = self
            .cases
            .iter()
            .map(time_limit)
            .max()
            .unwrap_or(LONGEST_START);
        workplace.time_limit.unwrap_or(longest)
    }

    /// Reports, in order, the cases that are complete; says whether there was one.
    fn harvest(&mut self, report: Report) -> bool {
        let before = self.next;
        while self.next < self.cases.len() && self.is_complete(self.next) {
            self.read(report);
        }
        self.next > before
    }

    fn is_complete(&self, index: usize) -> bool {
        self.engine.adapter.completion_file.is_some_and(|file| {
            let directory = self.directory.join(&self.case_directories[index]);
            directory.join(file).is_file()
        })
    }

    /// Reports what is left when the process has ended by itself.
    fn conclude(&mut self, status: ExitStatus, report: Report) {
        self.harvest(report);
        while (self.next..self.cases.len()).any(|index| self.is_complete(index)) {
            self.fail(FailureKind::Ended(status), report);
            self.harvest(report);
        }
        if self.next == self.cases.len() {
            return;
        }
        if status.success() {
            self.read(report);
        } else {
            self.fail(FailureKind::Ended(status), report);
        }
    }

    fn read(&mut self, report: Report) {
        let case = &self.cases[self.next];
        let directory = self.directory.join(&self.case_directories[self.next]);
        match (self.engine.adapter.read_series)(&directory, case) {
            Ok(trace) => {
                let seconds = self.last_report.elapsed().as_secs_f64();
                let steps = case.protocol.schedule().total_steps();
                let identity = self.engine.identity.clone();
                let command = self.engine.command(&[".".to_owned()]);
                let provenance = Provenance::now(identity, command, steps, seconds);
                self.report(
                    Ok(Run {
                        case: *case,
                        trace,
                        provenance,
                    }),
                    report,
                );
            }
            Err(error) => self.fail(FailureKind::Series(error), report),
        }
    }

    fn fail(&mut self, kind: FailureKind, report: Report) {
        let failure = Failure {
            engine: self.engine.adapter.name,
            case: Box::new(self.cases[self.next]),
            kind,
            run_directory: Some(self.directory.clone()),
            last_lines: self.last_lines(),
        };
        self.report(Err(failure), report);
    }

    fn report(&mut self, result: Result<Run, Failure>, report: Report) {
        report(self.next, result);
        self.next += 1;
        self.last_report = Instant::now();
    }

    fn last_lines(&self) -> Vec<String> {
        let logs = self.engine.adapter.logs.iter().copied();
        logs.chain([STANDARD_OUTPUT, STANDARD_ERROR])
            .flat_map(|name| {
                let lines = tail(&self.directory.join(name));
                lines.into_iter().map(move |line| format!("{name}: {line}"))
            })
            .collect()
    }
}

fn write(path: &Path, content: &str) -> Result<(), FailureKind> {
    fs::write(path, content).map_err(|error| ArchiveError::writing(path)(error).into())
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
