//! A code as its folder describes it: the manifest `code.toml` with its defaults and variants, and the files of its
//! tasks.

use super::convention::ConventionKey;
use super::format::ResultFormat;
use super::manifest::{Definition, ResultFile, TaskKind};
use crate::files::{Links, read_bounded};
use crate::model::{InvalidValue, Preparation, readable, sha256_hex, shown};
use std::path::{Component, Path, PathBuf};
use std::time::Duration;
use thiserror::Error;
use toml::{Table, Value};

const MANIFEST: &str = "code.toml";
const SCHEMA: i64 = 1;
/// Largest file of a folder that is read, in bytes; a mesh may be long.
const LARGEST_FILE: u64 = 1 << 26;
/// Placeholders that every command knows.
const DECK: &str = "{deck}";
const DIRECTORIES: &str = "{directories}";
/// About twenty times the slowest start and the slowest step of a stack that were measured.
pub(super) const LONGEST_START: Duration = Duration::from_secs(30);
const LONGEST_STEP: Duration = Duration::from_micros(100);
const SAFETY: f64 = 20.0;

/// The reason why a folder describes no code.
#[derive(Debug, Clone, Error)]
#[error("{}: {message}", shown(path))]
pub struct ManifestError {
    path: PathBuf,
    message: String,
}

impl ManifestError {
    pub(super) fn new(folder: &Path, message: String) -> Self {
        let path = folder.join(MANIFEST);
        Self { path, message }
    }
}

impl TaskKind {
    /// The task that compresses a stack after `preparation`.
    pub(super) fn of(preparation: &Preparation) -> Self {
        match preparation {
            Preparation::GravityRamp { .. } => Self::Stack,
            Preparation::SideWalls(_) => Self::SideWalls,
        }
    }
}

/// The content of a file of the folder.
type ReadFile<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

impl Definition {
    /// The codes that `folder` describes, one a variant, in the order of their names.
    pub fn read(folder: &Path) -> Result<Vec<Self>, ManifestError> {
        Self::read_with(folder, &|name| {
            let content = read_bounded(&folder.join(name), LARGEST_FILE, Links::Followed);
            content.map_err(|error| error.to_string())
        })
    }

    /// The same for a folder whose files are part of this program.
    pub(super) fn embedded(
        folder: &str,
        files: &[(&str, &'static str)],
    ) -> Result<Vec<Self>, ManifestError> {
        Self::read_with(Path::new(folder), &|name| {
            let found = files.iter().find(|(file, _)| *file == name);
            let found = found.ok_or("it is not part of this program")?;
            Ok(found.1.as_bytes().to_vec())
        })
    }

    fn read_with(folder: &Path, read: ReadFile) -> Result<Vec<Self>, ManifestError> {
        let failed = |message: String| ManifestError::new(folder, message);
        let content = read(MANIFEST).map_err(|error| failed(format!("cannot read it: {error}")))?;
        let text = String::from_utf8(content).map_err(|error| failed(error.to_string()))?;
        // The whole manifest first: its errors have a line.
        let manifest: Self = toml::from_str(&text).map_err(|error| failed(error.to_string()))?;
        let table: Table = toml::from_str(&text).map_err(|error| failed(error.to_string()))?;
        let family = manifest.name.clone();
        let codes = manifest.expand(table).map_err(failed)?;
        let finished = codes.into_iter().map(|code| code.finish(&family, read));
        finished.collect::<Result<_, _>>().map_err(failed)
    }

    /// The code itself, or one code for each of its variants, whose keys override its own.
    fn expand(mut self, mut table: Table) -> Result<Vec<Self>, String> {
        if self.variants.is_empty() {
            self.left_out = ConventionKey::left_out_of(&table);
            return Ok(vec![self]);
        }
        table.remove("variants");
        let variants = self.variants.into_iter().map(|(name, overrides)| {
            let mut table = table.clone();
            table.insert("name".to_owned(), Value::String(name.clone()));
            merge(&mut table, overrides);
            let left_out = ConventionKey::left_out_of(&table);
            let code: Result<Self, _> = table.try_into();
            let code = code.map_err(|error| format!("variants.{name}: {error}"))?;
            Ok(Self { left_out, ..code })
        });
        variants.collect()
    }

    /// Checks what the types cannot, and reads the files of the tasks.
    fn finish(mut self, family: &str, read: ReadFile) -> Result<Self, String> {
        self.check().map_err(|invalid| invalid.to_string())?;
        family.clone_into(&mut self.family);
        if self.title.is_empty() {
            self.title.clone_from(&self.family);
        }
        for task in self.tasks.values_mut() {
            let contents = task.files.iter().map(|name| {
                read(name).map_err(|error| format!("tasks: cannot read `{name}`: {error}"))
            });
            task.contents = contents.collect::<Result<_, _>>()?;
        }
        Ok(self)
    }

    fn check(&self) -> Result<(), InvalidValue> {
        if self.schema != SCHEMA {
            return Err(refused("schema", self.schema, SCHEMA.to_string()));
        }
        let plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        if self.name.is_empty() || !self.name.bytes().all(plain) {
            let accepted = "lower-case letters, digits and hyphens";
            return Err(refused("name", &self.name, accepted));
        }
        self.check_texts()?;
        self.convention.validate()?;
        self.check_files()?;
        self.check_command()
    }

    /// Refuses texts that do not show in tables as they are.
    fn check_texts(&self) -> Result<(), InvalidValue> {
        let label = self.label.as_deref().unwrap_or_default();
        for (key, text) in [
            ("title", self.title.as_str()),
            ("label", label),
            ("install", &self.install),
        ] {
            if readable(text) != text {
                let accepted = "one line without control characters";
                return Err(refused(key, readable(text), accepted));
            }
        }
        Ok(())
    }

    /// Refuses files outside the folder or the run directory, and decks that would overwrite parameters, results or
    /// logs.
    fn check_files(&self) -> Result<(), InvalidValue> {
        let logs = self.program.iter().flat_map(|program| &program.logs);
        let results = self.tasks.values().filter_map(|task| task.result.as_ref());
        let common = [&self.parameters.file, &self.result.file];
        let written: Vec<&String> = common.into_iter().chain(logs).chain(results).collect();
        if let Some(name) = written.iter().find(|name| !stays_inside(name)) {
            return Err(refused("file", name, "a path inside the run directory"));
        }
        for task in self.tasks.values() {
            if task.files.is_empty() {
                return Err(refused("files", "[]", "the deck and what it needs"));
            }
            if let Some(name) = task.files.iter().find(|name| !stays_inside(name)) {
                return Err(refused("files", name, "a path inside the folder"));
            }
            if let Some(name) = task.files.iter().find(|name| written.contains(name)) {
                let accepted = "no file of parameters, results or logs";
                return Err(refused("files", name, accepted));
            }
        }
        if self.tasks.contains_key(&TaskKind::Pyramid)
            && self.result.format != ResultFormat::LammpsThermo
        {
            let accepted = "lammps-thermo where there is a task `pyramid`";
            return Err(refused("result.format", "csv", accepted));
        }
        Ok(())
    }

    /// Refuses a command with an unknown placeholder.
    fn check_command(&self) -> Result<(), InvalidValue> {
        let Some(program) = &self.program else {
            return Ok(());
        };
        if !self.tasks.contains_key(&TaskKind::Stack) {
            return Err(refused("tasks.stack", "absent", "a table with `files`"));
        }
        if program.command.is_empty() {
            return Err(refused("program.command", "[]", "a program and arguments"));
        }
        for word in &program.command {
            let filled = self.fill(word, "");
            if word != DIRECTORIES && filled.contains(['{', '}']) {
                let mut known = vec![DECK.to_owned(), DIRECTORIES.to_owned()];
                known.extend(self.set.keys().map(|name| format!("{{{name}}}")));
                let accepted = format!("words with the placeholders {}", known.join(", "));
                return Err(refused("program.command", word, accepted));
            }
        }
        Ok(())
    }

    fn fill(&self, word: &str, deck: &str) -> String {
        let own = self.set.iter();
        let filled = word.replace(DECK, deck);
        own.fold(filled, |word, (name, value)| {
            word.replace(&format!("{{{name}}}"), value)
        })
    }

    /// Whether it runs tasks of this kind.
    pub(super) fn runs(&self, kind: TaskKind) -> bool {
        self.program.is_none() || self.tasks.contains_key(&kind)
    }

    /// Whether one process carries out many tasks.
    pub(super) fn runs_many(&self) -> bool {
        let command = self.program.iter().flat_map(|program| &program.command);
        command.into_iter().any(|word| word == DIRECTORIES)
    }

    /// Program and arguments that carry out the tasks in `directories`.
    pub(super) fn command(&self, kind: TaskKind, directories: &[String]) -> Vec<String> {
        let task = self.tasks.get(&kind);
        let deck = task.and_then(|task| task.files.first());
        let deck = deck.map_or("", String::as_str);
        let words = self.program.iter().flat_map(|program| &program.command);
        words
            .flat_map(|word| match word.as_str() {
                DIRECTORIES => directories.to_vec(),
                word => vec![self.fill(word, deck)],
            })
            .collect()
    }

    /// Files of a task, by name and content.
    pub(super) fn files(&self, kind: TaskKind) -> impl Iterator<Item = (&str, &[u8])> {
        let task = self.tasks.get(&kind).into_iter();
        task.flat_map(|task| {
            let names = task.files.iter().map(String::as_str);
            names.zip(task.contents.iter().map(Vec::as_slice))
        })
    }

    /// Hash of the files of a task.
    pub(super) fn files_hash(&self, kind: TaskKind) -> String {
        let mut bytes = Vec::new();
        for (name, content) in self.files(kind) {
            for part in [name.as_bytes(), b"\n", content, b"\n"] {
                bytes.extend_from_slice(part);
            }
        }
        sha256_hex(&bytes)
    }

    /// The result file of a task.
    pub(super) fn result(&self, kind: TaskKind) -> ResultFile {
        let own = self.tasks.get(&kind).and_then(|task| task.result.clone());
        ResultFile {
            file: own.unwrap_or_else(|| self.result.file.clone()),
            format: self.result.format,
        }
    }

    /// Time after which a task of `steps` steps counts as hanging.
    pub(super) fn time_limit(&self, steps: u64) -> Duration {
        let at_least = |seconds: f64, least: Duration| (SAFETY * seconds).max(least.as_secs_f64());
        let start = at_least(self.seconds.start, LONGEST_START);
        let step = at_least(self.seconds.step, LONGEST_STEP);
        let limit = Duration::try_from_secs_f64(start + step * steps as f64);
        limit.unwrap_or(Duration::MAX)
    }
}

pub(super) fn refused(
    key: &str,
    value: impl ToString,
    accepted: impl Into<String>,
) -> InvalidValue {
    InvalidValue {
        key: key.to_owned(),
        value: value.to_string(),
        accepted: accepted.into(),
    }
}

/// Whether a path names something below the directory it starts from.
fn stays_inside(path: &str) -> bool {
    let mut parts = Path::new(path).components().peekable();
    parts.peek().is_some() && parts.all(|part| matches!(part, Component::Normal(_)))
}

/// Puts the values of `overrides` in place of those of `table`, key by key.
fn merge(table: &mut Table, overrides: Table) {
    for (key, value) in overrides {
        match (table.get_mut(&key), value) {
            (Some(Value::Table(own)), Value::Table(value)) => merge(own, value),
            (_, value) => {
                table.insert(key, value);
            }
        }
    }
}
