//! A code as its folder describes it: the manifest `code.toml` with its defaults and variants, and the files of its
//! tasks.

use super::convention::ConventionKey;
use super::folder::Folder;
use super::layers::Layers;
use super::manifest::{Contact, Definition, ResultFile, TaskKind};
use super::manifest_error::{ManifestError, refused};
use super::search_path::FOLDER;
use crate::model::{InvalidValue, PAPER_BODIES, Preparation, Stack, sha256_hex};
use std::path::Path;
use std::time::Duration;
use toml::de::DeTable;

/// Placeholders that every command accepts.
pub(super) const DECK: &str = "{deck}";
pub(super) const DIRECTORIES: &str = "{directories}";
/// Time limits for a start and a step of a stack, about twenty times the slowest that were measured; a code whose
/// manifest gives longer durations has more.
pub(super) const LONGEST_START: Duration = Duration::from_secs(30);
const LONGEST_STEP: Duration = Duration::from_micros(100);
const SAFETY: f64 = 20.0;

impl TaskKind {
    /// Returns the kind of the task that compresses `stack` after `preparation`.
    pub(super) fn of(stack: &Stack, preparation: &Preparation) -> Self {
        match preparation {
            _ if stack.bodies != PAPER_BODIES => Self::Spheres,
            Preparation::GravityRamp { .. } => Self::Stack,
            Preparation::SideWalls(_) => Self::SideWalls,
            Preparation::Rigid => Self::Rigid,
        }
    }
}

impl Definition {
    /// Reads the codes that the folder at `path` describes, one per variant, in the order of their names.
    pub fn read(path: &Path) -> Result<Vec<Self>, ManifestError> {
        Self::read_folder(Folder::Disk(path.to_owned()))
    }

    pub(super) fn read_folder(folder: Folder) -> Result<Vec<Self>, ManifestError> {
        let layers = Layers::read(folder)?;
        let merged = layers.merged()?;
        // What all variants share is read by itself first, since its errors concern no variant.
        let common: Self = layers.read_as(merged.clone())?;
        let codes = layers.codes(merged).into_iter();
        let codes = codes.map(|code| Self::of_code(code, &common.name, &layers));
        codes.collect()
    }

    fn of_code(code: DeTable, family: &str, layers: &Layers) -> Result<Self, ManifestError> {
        let mut definition: Self = layers.read_as(code.clone())?;
        definition.place = layers.place_of(&code, "name");
        definition.left_out = match definition.contact {
            Contact::Elastic => ConventionKey::left_out_of(&code),
            Contact::Rigid => Vec::new(),
        };
        let finished = definition.finish(family, layers);
        finished.map_err(|invalid| layers.invalid(&code, &invalid))?;
        Ok(definition)
    }

    /// Checks what the types cannot, fills in defaults, and reads the files of the tasks.
    fn finish(&mut self, family: &str, layers: &Layers) -> Result<(), InvalidValue> {
        for kind in &self.without {
            self.tasks.remove(kind);
        }
        self.check()?;
        if self.contact == Contact::Rigid
            && let Some(stack) = self.tasks.remove(&TaskKind::Stack)
        {
            self.tasks.insert(TaskKind::Rigid, stack);
        }
        family.clone_into(&mut self.family);
        if self.title.is_empty() {
            self.title.clone_from(&self.family);
        }
        if self.software.is_empty() {
            self.software.clone_from(&self.title);
        }
        if self.style.is_empty() {
            let label = self.label.as_ref();
            self.style.clone_from(label.unwrap_or(&self.name));
        }
        for entry in self
            .program
            .iter_mut()
            .flat_map(|program| &mut program.search)
        {
            let folder = std::path::absolute(layers.folder_at(&entry.span()).path());
            let folder = folder.unwrap_or_default();
            *entry.get_mut() = entry.get_ref().replace(FOLDER, &folder.to_string_lossy());
        }
        for (kind, task) in &mut self.tasks {
            for name in &task.files {
                let content = layers.file(name).map_err(|error| {
                    let accepted = format!("a file of the folder: cannot read `{name}`: {error}");
                    refused(&kind.key("files"), name, accepted)
                })?;
                task.contents.push(content);
            }
        }
        Ok(())
    }

    pub(super) fn fill(&self, word: &str, deck: &str) -> String {
        let own = self.set.iter();
        let filled = word.replace(DECK, deck);
        own.fold(filled, |word, (name, value)| {
            word.replace(&format!("{{{name}}}"), value)
        })
    }

    /// Whether it runs tasks of this kind.
    pub(super) fn runs(&self, kind: TaskKind) -> bool {
        match kind {
            TaskKind::Rigid => self.tasks.contains_key(&kind),
            _ => self.program.is_none() || self.tasks.contains_key(&kind),
        }
    }

    /// Whether its bodies are rigid.
    pub(super) fn is_rigid(&self) -> bool {
        self.contact == Contact::Rigid
    }

    /// Whether one process carries out many tasks.
    pub(super) fn runs_many(&self) -> bool {
        let command = self.program.iter().flat_map(|program| &program.command);
        command.into_iter().any(|word| word == DIRECTORIES)
    }

    /// Returns the program and the arguments that carry out the tasks in `directories`.
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

    /// Returns the files of a task by name and content.
    pub(super) fn files(&self, kind: TaskKind) -> impl Iterator<Item = (&str, &[u8])> {
        let task = self.tasks.get(&kind).into_iter();
        task.flat_map(|task| {
            let names = task.files.iter().map(String::as_str);
            names.zip(task.contents.iter().map(Vec::as_slice))
        })
    }

    /// The content of every file of every task.
    pub(super) fn decks(&self) -> impl Iterator<Item = &[u8]> {
        let files = self.tasks.values().flat_map(|task| &task.contents);
        files.map(Vec::as_slice)
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
        let mut result = self.result.clone();
        if let Some(task) = self.tasks.get(&kind) {
            result.file = task.result.clone().unwrap_or(result.file);
            result.columns.extend(task.columns.clone());
        }
        result
    }

    /// Estimates how many seconds a task of `steps` steps takes.
    pub(super) fn forecast(&self, steps: u64) -> f64 {
        self.seconds.start + self.seconds.step * steps as f64
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
