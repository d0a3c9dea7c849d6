//! Checks of a manifest that its types cannot express: which values are accepted.

use super::definition::{DECK, DIRECTORIES};
use super::format::ResultFormat;
use super::manifest::{Contact, Definition, TaskKind};
use super::manifest_error::refused;
use super::search_path::check_directory;
use crate::model::{ContactConvention, InvalidValue, readable};
use std::path::{Component, Path};

impl Definition {
    /// Refuses values that no code can have.
    pub(super) fn check(&self) -> Result<(), InvalidValue> {
        let plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        if self.name.is_empty() || !self.name.bytes().all(plain) {
            let accepted = "lower-case letters, digits and hyphens";
            return Err(refused("name", &self.name, accepted));
        }
        self.check_texts()?;
        self.convention.validate()?;
        self.check_rigid()?;
        self.check_files()?;
        self.check_columns()?;
        self.check_command()
    }

    /// Refuses other tasks than `stack`, and a convention, where bodies are rigid.
    fn check_rigid(&self) -> Result<(), InvalidValue> {
        if self.contact != Contact::Rigid {
            return Ok(());
        }
        let mut others = self.tasks.keys().filter(|kind| **kind != TaskKind::Stack);
        if let Some(kind) = others.next() {
            let accepted = "[tasks.stack] alone where `contact` is \"rigid\"";
            return Err(refused("tasks", kind.as_str(), accepted));
        }
        if self.convention != ContactConvention::default() {
            let accepted = "nothing where `contact` is \"rigid\": rigid bodies have no springs, arms or damping";
            return Err(refused("convention", "given", accepted));
        }
        Ok(())
    }

    /// Refuses texts that tables cannot show as they are.
    fn check_texts(&self) -> Result<(), InvalidValue> {
        let label = self.label.as_deref().unwrap_or_default();
        for (key, text) in [
            ("title", self.title.as_str()),
            ("label", label),
            ("software", &self.software),
            ("style", &self.style),
            ("install", &self.install),
        ] {
            if readable(text) != text {
                let accepted = "one line without control characters";
                return Err(refused(key, readable(text), accepted));
            }
        }
        Ok(())
    }

    /// Refuses files outside the folder or the run directory, decks that would overwrite parameters, results or logs,
    /// a `{deck}` that stands for no file, and a task `pyramid` without logs in the format `lammps-thermo`.
    fn check_files(&self) -> Result<(), InvalidValue> {
        let written = self.written_files();
        let outside = |(_, name): &&(String, &str)| !stays_inside(name);
        if let Some((key, name)) = written.iter().find(outside) {
            return Err(refused(key, name, "a path inside the run directory"));
        }
        for (kind, task) in &self.tasks {
            let key = kind.key("files");
            let command = self.program.iter().flat_map(|program| &program.command);
            let names_deck = command.into_iter().any(|word| word.contains(DECK));
            if task.files.is_empty() && names_deck {
                let accepted =
                    "the deck that `{deck}` in program.command stands for, and what it needs";
                return Err(refused(&key, "[]", accepted));
            }
            if let Some(name) = task.files.iter().find(|name| !stays_inside(name)) {
                return Err(refused(&key, name, "a path inside the folder"));
            }
            let is_written = |name: &&String| written.iter().any(|(_, other)| other == name);
            if let Some(name) = task.files.iter().find(is_written) {
                let accepted = "no file of parameters, results or logs";
                return Err(refused(&key, name, accepted));
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

    /// Lists the files that tristack and the code write into a run directory, each with its key in the manifest.
    fn written_files(&self) -> Vec<(String, &str)> {
        let logs = self.program.iter().flat_map(|program| &program.logs);
        let logs = logs.map(|name| ("program.logs".to_owned(), name.as_str()));
        let results = self.tasks.iter().filter_map(|(kind, task)| {
            let name = task.result.as_deref()?;
            Some((kind.key("result"), name))
        });
        let common = [
            ("parameters.file".to_owned(), self.parameters.file.as_str()),
            ("result.file".to_owned(), self.result.file.as_str()),
        ];
        common.into_iter().chain(logs).chain(results).collect()
    }

    /// Refuses factors that are 0 or not finite, and any factor for the step.
    fn check_columns(&self) -> Result<(), InvalidValue> {
        let common = self.result.columns.iter();
        let common = common.map(|(name, source)| (format!("result.columns.{name}"), name, source));
        let own = self.tasks.iter().flat_map(|(kind, task)| {
            let columns = task.columns.iter();
            columns.map(|(name, source)| (kind.key(&format!("columns.{name}")), name, source))
        });
        for (key, name, source) in common.chain(own) {
            let factor = source.factor;
            if name == "step" && factor != 1.0 {
                return Err(refused(
                    &key,
                    factor,
                    "a column that counts the steps, without a factor",
                ));
            }
            if !factor.is_finite() || factor == 0.0 {
                return Err(refused(&key, factor, "a finite factor other than 0"));
            }
        }
        Ok(())
    }

    /// Refuses a program without any task, an empty command or one with an unknown placeholder, and directories for the
    /// program that depend on where tristack is started.
    fn check_command(&self) -> Result<(), InvalidValue> {
        let Some(program) = &self.program else {
            return Ok(());
        };
        if self.tasks.is_empty() {
            let kinds = TaskKind::ALL.map(TaskKind::as_str).join(", ");
            let accepted = format!("a table with at least one task: {kinds}");
            return Err(refused("tasks", "without a task", accepted));
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
        program
            .search
            .iter()
            .try_for_each(|directory| check_directory(directory.get_ref()))
    }
}

impl TaskKind {
    /// Returns the full path of a key in the table of this task.
    pub(super) fn key(self, name: &str) -> String {
        format!("tasks.{}.{name}", self.as_str())
    }
}

/// Whether a path is relative and stays below its starting directory.
pub(super) fn stays_inside(path: &str) -> bool {
    let mut parts = Path::new(path).components().peekable();
    parts.peek().is_some() && parts.all(|part| matches!(part, Component::Normal(_)))
}
