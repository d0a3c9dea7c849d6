//! Packages of Python virtual environments, whose modules and programs decide what a script computes.

use super::manifest::Environment;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The package directories of the virtual environments whose interpreters were found.
#[derive(Default)]
pub(super) struct Packages(BTreeSet<PathBuf>);

impl Packages {
    /// Adds those of the virtual environment in which `program` is the interpreter.
    pub fn add_beside(&mut self, program: &Path) {
        let environment = program.parent().and_then(Path::parent);
        let is_interpreter = program
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with("python"));
        let Some(environment) =
            environment.filter(|place| place.join("pyvenv.cfg").is_file() && is_interpreter)
        else {
            return;
        };
        let versions = std::fs::read_dir(environment.join("lib"));
        let versions = versions.into_iter().flatten().flatten();
        let packages = versions.map(|version| version.path().join("site-packages"));
        self.0.extend(packages.filter(|place| place.is_dir()));
    }

    /// The directories.
    pub fn places(&self) -> impl Iterator<Item = PathBuf> {
        self.0.iter().cloned()
    }

    /// Returns `environment` with the `lib` directories of the virtual environments, where packages put libraries, in
    /// its library search path.
    pub fn with_libraries(&self, environment: &Environment) -> Environment {
        const SEARCH_PATH: &str = "LD_LIBRARY_PATH";
        let mut environment = environment.clone();
        let own = environment.get(SEARCH_PATH).cloned();
        let libraries = self
            .0
            .iter()
            .filter_map(|place| place.ancestors().nth(2)?.to_str());
        let places: Vec<String> = own
            .into_iter()
            .chain(libraries.map(str::to_owned))
            .collect();
        if !places.is_empty() {
            environment.insert(SEARCH_PATH.to_owned(), places.join(":"));
        }
        environment
    }
}
