//! An external code as an engine: run directories, the shared runner, the series read back.

use super::installation::{self, Installation, VersionQuestion};
use super::process::{Ending, Job, STANDARD_ERROR, STANDARD_OUTPUT, run};
use super::{DeckParameters, Engine, EngineName, Environment, Failure, FailureKind, Workplace};
use crate::archive::{ArchiveError, Identity, Provenance, Run};
use crate::stack::{Case, sha256_hex};
use crate::trace::{SeriesError, Trace};
use std::ffi::OsString;
use std::fs;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
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
    /// How it says its version.
    pub(super) version: VersionQuestion,
    /// Files of the deck, by name and content.
    pub(super) deck: &'static [(&'static str, &'static str)],
    /// Variables of its environment.
    pub(super) environment: Environment,
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
    pub(super) fn static_deck_hash(&self) -> String {
        let files = self
            .deck
            .iter()
            .map(|(name, content)| format!("{name}\n{content}\n"));
        sha256_hex(files.collect::<String>().as_bytes())
    }
}

impl Adapter {
    /// All but the static deck that one case is run with, as one text.
    pub(super) fn told(&self, parameters: &DeckParameters) -> String {
        let arguments = (self.arguments)(&[".".to_owned()]);
        let (file, content) = (self.parameter_file, (self.parameters)(parameters));
        format!("{file}\n{content}\n{arguments:?}\n{:?}", self.environment)
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
        let installation =
            installation::find(adapter.program, &adapter.version, adapter.environment)?;
        let identity = Identity {
            engine: adapter.name.as_str().to_owned(),
            version: installation.version.clone(),
            package: installation.package.clone(),
            program_hash: Some(installation.hash.clone()),
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
            next += batch.settled();
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
    /// Which cases have been reported.
    reported: Vec<bool>,
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
            reported: vec![false; cases.len()],
            last_report: Instant::now(),
        }
    }

    /// Number of cases up to the last one that has been reported. Those beyond have had no chance.
    fn settled(&self) -> usize {
        let last = self.reported.iter().rposition(|&reported| reported);
        last.map_or(0, |index| index + 1)
    }

    /// Runs the process and reports cases, at least the first one. Those beyond the last reported one have
    /// had no chance, because it took the process down.
    fn run(&mut self, workplace: &Workplace, report: Report) {
        if let Err(kind) = self.prepare() {
            // Nothing may be read from directories that have not been cleared.
            return self.fail(0, kind, report);
        }
        let outcome = self.run_process(workplace, report);
        self.harvest(report);
        let delivered = self.settled();
        for index in 0..delivered {
            if !self.reported[index] {
                self.fail(index, FailureKind::Skipped, report);
            }
        }
        if delivered == self.cases.len() {
            return;
        }
        match outcome {
            Ok(Ending::Exited(status)) if status.success() => self.read(delivered, report),
            Ok(Ending::Exited(status)) => self.fail(delivered, FailureKind::Ended(status), report),
            Ok(Ending::TimedOut) => {
                let limit = self.time_limit(workplace);
                self.fail(delivered, FailureKind::TimedOut(limit), report);
            }
            Ok(Ending::Interrupted) => {
                for index in delivered..self.cases.len() {
                    self.fail(index, FailureKind::Interrupted, report);
                }
            }
            Err(kind) => self.fail(delivered, kind, report),
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
            // What an earlier run left behind must not pass for the result of this one.
            for stale in adapter.completion_file.iter().chain(adapter.logs) {
                remove(&directory.join(stale))?;
            }
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

    /// Reports the cases that have become complete; says whether there was one.
    fn harvest(&mut self, report: Report) -> bool {
        let complete = |index: &usize| !self.reported[*index] && self.is_complete(*index);
        let complete: Vec<usize> = (0..self.cases.len()).filter(complete).collect();
        for &index in &complete {
            self.read(index, report);
        }
        !complete.is_empty()
    }

    fn is_complete(&self, index: usize) -> bool {
        let file = self.engine.adapter.completion_file;
        file.is_some_and(|file| self.case_directory(index).join(file).is_file())
    }

    fn case_directory(&self, index: usize) -> PathBuf {
        match self.case_directories[index].as_str() {
            "." => self.directory.clone(),
            name => self.directory.join(name),
        }
    }

    fn read(&mut self, index: usize, report: Report) {
        let case = &self.cases[index];
        let adapter = self.engine.adapter;
        match (adapter.read_series)(&self.case_directory(index), case) {
            Ok(trace) => {
                let provenance = Provenance::now(
                    self.engine.identity.clone(),
                    adapter.name.deck_hash(case),
                    self.engine.command(&[".".to_owned()]),
                    case.protocol.schedule().total_steps(),
                    self.last_report.elapsed().as_secs_f64(),
                );
                let case = *case;
                self.report(
                    index,
                    Ok(Run {
                        case,
                        trace,
                        provenance,
                    }),
                    report,
                );
            }
            Err(error) => self.fail(index, FailureKind::Series(error), report),
        }
    }

    fn fail(&mut self, index: usize, kind: FailureKind, report: Report) {
        let failure = Failure {
            engine: self.engine.adapter.name,
            case: Box::new(self.cases[index]),
            kind,
            run_directory: Some(self.case_directory(index)),
            last_lines: self.last_lines(),
        };
        self.report(index, Err(failure), report);
    }

    fn report(&mut self, index: usize, result: Result<Run, Failure>, report: Report) {
        report(index, result);
        self.reported[index] = true;
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

fn remove(path: &Path) -> Result<(), FailureKind> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(ArchiveError::writing(path)(error).into())
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
