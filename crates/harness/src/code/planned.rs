//! Runs that are made elsewhere. The directory of each holds, byte for byte, what a live run is given; its result is
//! read from there, and no program is started.

use super::checks::stays_inside;
use super::described::Code;
use super::failure::FailureKind;
use super::manifest::{Environment, Program};
use super::manifest_error::refused;
use super::search_path::{SEARCH_PATH, find_program};
use super::task::Task;
use super::written::complaint;
use crate::files::{FileError, Links, read_bounded, read_end, refuse_linked, write_atomically};
use crate::model::{Case, ContactTest, InvalidValue, readable, sha256_hex, shown};
use crate::series::SeriesError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// Digits of the input hash in the name of a run's directory.
const HASH_DIGITS: usize = 12;
/// Size limit for given files that are compared, in bytes: that for files of a manifest's folder.
const LARGEST_GIVEN: u64 = 1 << 26;

/// A task that is carried out elsewhere, under the name that manifests give its kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlannedTask {
    /// A stack is compressed.
    Stack(Case),
    /// A micro-test.
    Motion(ContactTest),
}

impl From<Case> for PlannedTask {
    fn from(case: Case) -> Self {
        Self::Stack(case)
    }
}

impl From<ContactTest> for PlannedTask {
    fn from(test: ContactTest) -> Self {
        Self::Motion(test)
    }
}

/// A run that is made elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedRun {
    /// Its directory, relative to that of the plan.
    pub directory: String,
    /// SHA-256 of all inputs of the program. It names the run: another deck is another run.
    pub deck_hash: String,
    /// SHA-256 of each file that is put into the directory.
    pub files: BTreeMap<String, String>,
    /// Program and arguments, to be started in the directory.
    pub command: Vec<String>,
    /// Further variables of its environment.
    pub environment: BTreeMap<String, String>,
    /// The file in the directory that the result is read from.
    pub result: String,
    /// The most steps that it takes.
    pub steps: u64,
    /// Its duration in seconds, by the forecast of the manifest.
    pub seconds: f64,
    /// The task.
    pub task: PlannedTask,
}

/// A planned run with the contents of its files.
pub struct PreparedRun {
    /// The run.
    pub run: PlannedRun,
    contents: Vec<(String, Vec<u8>)>,
}

impl Code {
    /// Prepares the run of `task` in a directory of a plan; the name of the directory begins with `place`.
    ///
    /// # Errors
    /// If the code cannot run the task, or its command does not fit on one line.
    pub(crate) fn prepare_elsewhere<T: Task + Into<PlannedTask>>(
        &self,
        task: &T,
        place: &str,
    ) -> Result<PreparedRun, InvalidValue> {
        let (definition, kind) = (self.definition(), task.kind());
        self.check_convention_of(task)?;
        self.check_task(kind)?;
        let mut command = definition.command(kind, &[".".to_owned()]);
        if let Some(path) = definition.program.as_ref().and_then(named_path) {
            command[0] = path;
        }
        let environment = definition.program.as_ref();
        let environment = environment.map_or_else(Environment::new, |own| own.environment.clone());
        if let Some(word) = not_in_one_line(&command, &environment) {
            let accepted = "words without control characters, so that a list has one line a run";
            return Err(refused("program.command", readable(word), accepted));
        }
        let own = definition.files_of(task)?.into_iter();
        let own = own.map(|(name, content)| (name, content.into_bytes()));
        let decks = definition.files(kind);
        let decks = decks.map(|(name, content)| (name.to_owned(), content.to_vec()));
        let contents: Vec<(String, Vec<u8>)> = own.chain(decks).collect();
        let hashes = contents.iter();
        let hashes = hashes.map(|(name, content)| (name.clone(), sha256_hex(content)));
        let (deck_hash, steps) = (self.deck_hash(task), task.steps());
        let run = PlannedRun {
            directory: format!("{place}-{}", &deck_hash[..HASH_DIGITS]),
            deck_hash,
            files: hashes.collect(),
            command,
            environment,
            result: definition.result(kind).file,
            steps,
            seconds: definition.forecast(steps),
            task: (*task).into(),
        };
        Ok(PreparedRun { run, contents })
    }
}

/// Returns the path of the program in one of the directories that its manifest names, since a shell would not search
/// them.
fn named_path(program: &Program) -> Option<String> {
    let directories = program.search.iter().map(|place| place.get_ref().as_str());
    let mut directories = directories.filter(|place| *place != SEARCH_PATH).peekable();
    directories.peek()?;
    let path = find_program(directories, program.command.first()?)?;
    Some(path.to_str()?.to_owned())
}

/// Returns a word of the command or its environment that would not stay on one line.
fn not_in_one_line<'a>(command: &'a [String], environment: &'a Environment) -> Option<&'a String> {
    let environment = environment.iter();
    let variables = environment.flat_map(|(name, value)| [name, value]);
    let mut words = command.iter().chain(variables);
    words.find(|word| readable(word) != **word)
}

impl PreparedRun {
    /// Writes the files of the run into its directory below `root`, unless they are there. A run that has a result is
    /// left as it is.
    ///
    /// # Errors
    /// If the file system refuses, or a directory below `root` is a symbolic link.
    pub fn write(&self, root: &Path) -> Result<(), FileError> {
        let directory = root.join(&self.run.directory);
        self.run.refuse_links(root)?;
        if is_there(&directory.join(&self.run.result)) {
            return Ok(());
        }
        for (name, content) in &self.contents {
            let path = directory.join(name);
            let found = read_bounded(&path, content.len() as u64, Links::Refused);
            if found.is_err() || found.is_ok_and(|found| found != *content) {
                write_atomically(&path, content)?;
            }
        }
        Ok(())
    }
}

impl PlannedRun {
    /// Refuses a run with files outside the directory of its plan, or with an invalid case.
    pub(crate) fn check(&self) -> Result<(), String> {
        let mut names = self.files.keys().chain([&self.directory, &self.result]);
        if let Some(name) = names.find(|name| !stays_inside(name)) {
            let name = readable(name);
            return Err(format!(
                "`{name}` is the path of a run; accepted is one inside the directory of the plan"
            ));
        }
        match &self.task {
            PlannedTask::Stack(case) => case.validate().map_err(|error| error.to_string()),
            PlannedTask::Motion(_) => Ok(()),
        }
    }

    /// Reads the outcome of `task`, which is the task of this run by `code`, from its directory below `root`.
    ///
    /// # Errors
    /// [`FailureKind::Awaited`] if there is no result yet, [`FailureKind::NoResult`] if it is incomplete or was made
    /// from other inputs, and [`FailureKind::UnusableFile`] if it is unusable.
    pub(crate) fn outcome<T: Task>(
        &self,
        code: &Code,
        task: &T,
        root: &Path,
    ) -> Result<T::Outcome, FailureKind> {
        let directory = root.join(&self.directory);
        let result = code.definition().result(task.kind());
        let path = directory.join(&self.result);
        self.refuse_links(root).map_err(FailureKind::UnusableFile)?;
        if !is_there(&path) {
            return Err(FailureKind::Awaited(path));
        }
        self.check_given(&directory)?;
        task.read_outcome(&directory, &result)
            .map_err(|error| match is_a_part(&error, &path) {
                true => FailureKind::NoResult(format!(
                    "{} is not complete, or still being written: {error}",
                    shown(&path)
                )),
                false => FailureKind::UnusableFile(FileError::series(&path)(error)),
            })
    }

    /// Refuses directories of the run below `root` that are symbolic links.
    pub(crate) fn refuse_links(&self, root: &Path) -> Result<(), FileError> {
        let directory = Path::new(&self.directory);
        let mut names = self.files.keys().chain([&self.result]);
        names.try_for_each(|name| refuse_linked(root, &directory.join(name)))
    }

    /// Returns the last line that its program wrote to standard error, below `root`.
    pub(crate) fn complaint(&self, root: &Path) -> Option<String> {
        self.refuse_links(root).ok()?;
        complaint(&root.join(&self.directory))
    }

    /// Returns why the outcome of the planned task cannot be read; `None` if it is there and usable.
    pub(crate) fn trouble(&self, code: &Code, root: &Path) -> Option<FailureKind> {
        match &self.task {
            PlannedTask::Stack(case) => self.outcome(code, case, root).err(),
            PlannedTask::Motion(test) => self.outcome(code, test, root).err(),
        }
    }

    /// Refuses a result of other decks or parameters than the planned ones: it belongs to another run.
    fn check_given(&self, directory: &Path) -> Result<(), FailureKind> {
        for (name, planned) in &self.files {
            let path = directory.join(name);
            let found = match read_bounded(&path, LARGEST_GIVEN, Links::Refused) {
                Ok(content) if sha256_hex(&content) == *planned => continue,
                Ok(_) => "is not as the plan wrote it".to_owned(),
                Err(error) => format!("cannot be compared with what the plan wrote: {error}"),
            };
            return Err(FailureKind::NoResult(format!(
                "{} {found}, so that the result beside it belongs to another run; accepted is a result of the planned \
                 files: remove that result, plan again, and run it",
                shown(&path)
            )));
        }
        Ok(())
    }
}

/// Whether anything is at `path`, links not followed.
fn is_there(path: &Path) -> bool {
    let found = std::fs::symlink_metadata(path);
    !found.is_err_and(|error| error.kind() == ErrorKind::NotFound)
}

/// Whether the result at `path`, in which `error` was found, is incomplete: it has too few rows, or ends within a
/// line.
fn is_a_part(error: &SeriesError, path: &Path) -> bool {
    match error {
        SeriesError::Truncated { found, expected } => found < expected,
        SeriesError::Garbled { .. } | SeriesError::Columns { .. } => {
            read_end(path, 1).is_ok_and(|end| end != b"\n")
        }
        _ => false,
    }
}
