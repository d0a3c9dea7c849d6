//! What an code can be asked to do, and the files in which an external code is told.

use crate::model::{Case, ContactConvention, ContactTest, Pyramid};
use crate::series::{Motion, PyramidRun, Series, SeriesError};
use serde::Serialize;
use std::path::Path;
use std::time::Duration;

use super::batch::time_limit;
use super::deck::{DeckParameters, ProbeParameters, PyramidParameters, placed_cylinders};

/// Something that an code turns into an outcome: a case into a series, a micro-test into a motion.
pub trait Task: Copy + std::fmt::Display + Sync {
    /// What comes out.
    type Outcome;

    /// What a contact must be to the code.
    fn convention(&self) -> &ContactConvention;

    /// Time steps in all.
    fn steps(&self) -> u64;

    /// What a deck has to be told, as an object of named numbers.
    fn parameters(&self) -> serde_json::Value;

    /// What a deck has to be told beyond that: files by name and content.
    fn files(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// Time after which it counts as hanging.
    fn time_limit(&self) -> Duration {
        time_limit(self.steps())
    }
}

impl Task for Case {
    type Outcome = Series;

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn steps(&self) -> u64 {
        self.total_steps()
    }

    fn parameters(&self) -> serde_json::Value {
        named(&DeckParameters::new(self))
    }
}

impl Task for ContactTest {
    type Outcome = Motion;

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn parameters(&self) -> serde_json::Value {
        named(&ProbeParameters::new(self))
    }
}

impl Task for Pyramid {
    type Outcome = PyramidRun;

    fn convention(&self) -> &ContactConvention {
        &self.convention
    }

    fn steps(&self) -> u64 {
        self.total_steps()
    }

    fn parameters(&self) -> serde_json::Value {
        named(&PyramidParameters::new(self))
    }

    fn files(&self) -> Vec<(&'static str, String)> {
        vec![placed_cylinders(self)]
    }

    /// As if every cylinder took as long as a whole stack.
    fn time_limit(&self) -> Duration {
        let cylinders = self.cylinder_count() as u64;
        time_limit(self.steps().saturating_mul(cylinders))
    }
}

fn named(parameters: &impl Serialize) -> serde_json::Value {
    serde_json::to_value(parameters).expect("a struct of finite numbers has a JSON form")
}

/// How a parameter file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterFile {
    /// `parameters.json`, numbers in their shortest exact form.
    Json,
    /// `parameters.in`, variables of LAMMPS and LIGGGHTS; of string style, because it alone passes every
    /// digit.
    Lammps,
}

impl ParameterFile {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Json => "parameters.json",
            Self::Lammps => "parameters.in",
        }
    }

    /// Its content.
    pub fn content(self, parameters: &serde_json::Value) -> String {
        match self {
            Self::Json => format!("{parameters:#}\n"),
            Self::Lammps => {
                let entries = parameters.as_object().into_iter().flatten();
                entries
                    .map(|(name, number)| format!("variable {name} string {number}\n"))
                    .collect()
            }
        }
    }
}

/// A deck: what a code is given to carry out tasks of one kind.
pub struct Deck<T: Task> {
    /// Files by name and content.
    pub files: &'static [(&'static str, &'static str)],
    /// Arguments that carry out the tasks in the given directories.
    pub arguments: fn(&[String]) -> Vec<String>,
    /// For a code that does many tasks in one process: the file of a task that appears when it is done.
    pub completion_file: Option<&'static str>,
    /// Reads the outcome from the directory of a task.
    pub read: fn(&Path, &T) -> Result<T::Outcome, SeriesError>,
}
