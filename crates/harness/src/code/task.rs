//! Tasks: cases, micro-tests and pyramids, each with its inputs and its outcome.

use super::described::Code;
use super::format::pyramid_in_log;
use super::full_parameters;
use super::manifest::{Definition, ParameterContent, ParameterFile, ResultFile, TaskKind};
use super::parameters::{self, only_numbers};
use super::written::{STANDARD_ERROR, STANDARD_OUTPUT, read};
use crate::model::{Case, ContactConvention, ContactTest, InvalidValue, Pyramid, sha256_hex};
use crate::series::{Motion, PyramidRun, Series, SeriesError};
use std::path::Path;

/// File with the centres of a pyramid. Decks write it last, so that it belongs to this run if the code succeeds.
const CENTRES: &str = "centres.txt";

/// A task of a code: a case becomes a series, a micro-test a motion.
pub trait Task: Copy + std::fmt::Display + Sync {
    /// The result.
    type Outcome;

    /// The kind of the task, which decides the deck.
    fn kind(&self) -> TaskKind;

    /// The contact convention that the code must have.
    fn convention(&self) -> &ContactConvention;

    /// The stiffness ratio κ of pairs.
    fn stiffness_ratio(&self) -> f64;

    /// Upper bound of its run time, in steps of a stack.
    fn steps(&self) -> u64;

    /// Named numbers for the decks that come with tristack.
    fn parameters(&self) -> serde_json::Value;

    /// Everything that a deck needs, as named numbers and lists: [`Self::parameters`], and the units, bodies, features
    /// and starting positions.
    fn all_parameters(&self) -> serde_json::Value;

    /// Refuses values out of range.
    fn validate(&self) -> Result<(), InvalidValue> {
        Ok(())
    }

    /// Further files for the deck, by name and content.
    fn files(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Reads the outcome that a program has written into `directory`.
    fn read_outcome(
        &self,
        directory: &Path,
        result: &ResultFile,
    ) -> Result<Self::Outcome, SeriesError>;
}

impl Task for Case {
    type Outcome = Series;

    fn kind(&self) -> TaskKind {
        TaskKind::of(&self.stack, &self.protocol.preparation)
    }

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn stiffness_ratio(&self) -> f64 {
        self.stack.stiffness_ratio
    }

    fn steps(&self) -> u64 {
        self.total_steps()
    }

    fn parameters(&self) -> serde_json::Value {
        match self.kind() {
            TaskKind::Rigid => full_parameters::of_case(self),
            _ => parameters::of_case(self),
        }
    }

    fn all_parameters(&self) -> serde_json::Value {
        full_parameters::of_case(self)
    }

    fn read_outcome(&self, directory: &Path, result: &ResultFile) -> Result<Series, SeriesError> {
        let content = read(directory, &result.file)?;
        result.format.series(&content, &result.columns, self)
    }
}

impl Task for ContactTest {
    type Outcome = Motion;

    fn kind(&self) -> TaskKind {
        match self.space {
            Some(_) => TaskKind::SpheresMotion,
            None => TaskKind::Motion,
        }
    }

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn stiffness_ratio(&self) -> f64 {
        self.stiffness_ratio
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn parameters(&self) -> serde_json::Value {
        parameters::of_contact_test(self)
    }

    fn all_parameters(&self) -> serde_json::Value {
        full_parameters::of_contact_test(self)
    }

    fn read_outcome(&self, directory: &Path, result: &ResultFile) -> Result<Motion, SeriesError> {
        let content = read(directory, &result.file)?;
        result.format.motion(&content, &result.columns, self)
    }
}

impl Task for Pyramid {
    type Outcome = PyramidRun;

    fn kind(&self) -> TaskKind {
        TaskKind::Pyramid
    }

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn stiffness_ratio(&self) -> f64 {
        self.groups.stiffness_ratio
    }

    /// Counts every cylinder as if it took as long as a whole stack.
    fn steps(&self) -> u64 {
        let cylinders = self.cylinder_count() as u64;
        self.total_steps().saturating_mul(cylinders)
    }

    fn parameters(&self) -> serde_json::Value {
        parameters::of_pyramid(self)
    }

    fn all_parameters(&self) -> serde_json::Value {
        full_parameters::of_pyramid(self)
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        Self::validate(self)
    }

    fn files(&self) -> Vec<(&'static str, String)> {
        vec![parameters::placed_cylinders(self)]
    }

    fn read_outcome(
        &self,
        directory: &Path,
        result: &ResultFile,
    ) -> Result<PyramidRun, SeriesError> {
        let [log, dump] = [result.file.as_str(), CENTRES].map(|name| read(directory, name));
        pyramid_in_log(&log?, &dump?, self)
    }
}

impl Definition {
    /// Returns the files of `task` alone by name and content: its parameters, and what else it needs. The decks,
    /// which tasks share, come from [`Self::files`].
    ///
    /// # Errors
    /// If a parameter is not a finite number.
    pub(super) fn files_of<T: Task>(
        &self,
        task: &T,
    ) -> Result<Vec<(String, String)>, InvalidValue> {
        let (file, parameters) = (&self.parameters, self.parameters.numbers(task));
        only_numbers(&parameters)?;
        let mut files = vec![(file.file.clone(), file.format.content(&parameters))];
        let further = task.files().into_iter();
        files.extend(further.map(|(name, content)| (name.to_owned(), content)));
        Ok(files)
    }
}

impl ParameterFile {
    /// Returns the parameters of `task` that this file holds.
    pub(super) fn numbers(&self, task: &impl Task) -> serde_json::Value {
        match self.content {
            ParameterContent::Task => task.all_parameters(),
            ParameterContent::Deck => task.parameters(),
        }
    }
}

impl Code {
    /// Refuses a task whose convention contradicts the declaration of the code, or whose stiffness ratio the code
    /// cannot have.
    pub(crate) fn check_convention_of<T: Task>(&self, task: &T) -> Result<(), InvalidValue> {
        self.check_declared(&as_of_cylinders(task, &self.declaration().convention))?;
        self.check_stiffness_ratio(task.stiffness_ratio())
    }

    /// Lists the files that a run of `task` leaves in its directory, as far as the manifest names them.
    pub fn run_files<T: Task>(&self, task: &T) -> Vec<String> {
        let definition = self.definition();
        let Some(program) = &definition.program else {
            return Vec::new();
        };
        let kind = task.kind();
        let own = [STANDARD_OUTPUT, STANDARD_ERROR, &definition.parameters.file];
        let decks = definition.files(kind).map(|(name, _)| name);
        let further = task.files().into_iter().map(|(name, _)| name);
        let names = own.into_iter().chain(decks).chain(further);
        let names = names.map(str::to_owned).chain(program.logs.clone());
        names.chain([definition.result(kind).file]).collect()
    }

    /// Hash of all inputs that this version of tristack gives the code for `task`: files, parameters, command,
    /// environment, and columns under other names or with factors. For the native code its sources take the place of
    /// the files.
    pub fn deck_hash<T: Task>(&self, task: &T) -> String {
        let files_hash = self.files_hash(task.kind());
        self.definition().input_hash(&files_hash, task)
    }

    /// Hash of all that its folder gives a program and says about it: the files of every task, command, environment,
    /// parameter file, columns, and what the manifest declares.
    pub fn folder_hash(&self) -> String {
        let definition = self.definition();
        let of_tasks = TaskKind::ALL.map(|kind| {
            let command = definition.command(kind, &[".".to_owned()]);
            let result = definition.result(kind);
            let file = (result.file, result.columns);
            format!("{}\n{command:?}\n{file:?}", self.files_hash(kind))
        });
        let environment = definition
            .program
            .as_ref()
            .map(|program| &program.environment);
        let (parameters, declared) = (&definition.parameters, self.declaration());
        let given = format!("{of_tasks:?}\n{environment:?}\n{parameters:?}\n{declared:?}");
        sha256_hex(given.as_bytes())
    }
}

/// Returns the convention of `task`; if that has spheres, with the moment of inertia of the `cylinders` of its code,
/// because spheres are solid whatever the cylinders are.
pub(super) fn as_of_cylinders<T: Task>(
    task: &T,
    cylinders: &ContactConvention,
) -> ContactConvention {
    let own = *task.convention();
    match task.kind() {
        TaskKind::Spheres | TaskKind::SpheresMotion => ContactConvention {
            moment_of_inertia: cylinders.moment_of_inertia,
            ..own
        },
        _ => own,
    }
}

impl Definition {
    /// Returns the hash of all inputs for `task`, whose files have the hash `files_hash`.
    fn input_hash<T: Task>(&self, files_hash: &str, task: &T) -> String {
        let (kind, file) = (task.kind(), &self.parameters);
        let content = file.format.content(&file.numbers(task));
        let command = self.command(kind, &[".".to_owned()]);
        let environment = self.program.as_ref().map(|program| &program.environment);
        let mut given = format!("{}\n{content}\n{command:?}\n{environment:?}", file.file);
        let columns = self.result(kind).columns;
        if !columns.is_empty() {
            // Columns decide what the numbers of a result mean.
            given += &format!("\n{columns:?}");
        }
        sha256_hex(format!("{files_hash}\n{given}").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::code::witness_test;

    /// The hash of a micro-test for a manifest with these further `lines`.
    fn hash(lines: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let manifest = format!(
            "schema = 1\nname = \"mydem\"\n[program]\ncommand = [\"mydem\"]\n\
             [tasks]\nstack = {{ files = [\"code.toml\"] }}\n{lines}"
        );
        std::fs::write(folder.path().join("code.toml"), manifest).unwrap();
        let definition = Definition::read(folder.path()).unwrap().remove(0);
        definition.input_hash("", &witness_test(ContactConvention::TURNING))
    }

    #[test]
    fn other_columns_or_parameters_make_other_runs() {
        let plain = hash("");
        assert_eq!(hash("[result]\ncolumns = {}"), plain);
        let others = [
            "[result]\ncolumns = { x1 = \"x\" }",
            "[result]\ncolumns = { x1 = { from = \"x1\", factor = -1.0 } }",
            "motion = { files = [\"code.toml\"], columns = { x1 = \"x\", y1 = \"y\" } }",
            "[parameters]\ncontent = \"deck\"",
        ];
        let hashes: Vec<String> = others.into_iter().map(hash).collect();
        for (index, own) in hashes.iter().enumerate() {
            assert_ne!(*own, plain, "{}", others[index]);
            assert!(!hashes[..index].contains(own), "{}", others[index]);
        }
    }
}
