//! The result of a check: one item per question, in three grades.

use crate::code::folder_argument;
use serde::Serialize;

/// What an item decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Grade {
    /// Without it nothing can be judged.
    Mandatory,
    /// Mechanics and the task demand it.
    Consistency,
    /// It cannot fail.
    Informational,
}

/// The outcome of an item.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Found as expected.
    Passed,
    /// Found something other than expected.
    Failed,
    /// Worth knowing.
    Remark,
    /// Something that it needs is missing.
    NotTested,
}

/// One question to a code, and the answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What it decides.
    pub grade: Grade,
    /// The question in a few words.
    pub name: &'static str,
    /// The outcome.
    pub outcome: Outcome,
    /// What was expected; may be empty where it passed.
    pub expected: String,
    /// What was found.
    pub found: String,
    /// Mistakes that fit what was found, or the usual ones; empty unless it failed or vanishes with the time step.
    pub causes: Vec<String>,
}

impl Item {
    /// An item of `grade` that found what was expected.
    pub(super) fn passed(grade: Grade, name: &'static str, found: impl Into<String>) -> Self {
        Self {
            grade,
            name,
            outcome: Outcome::Passed,
            expected: String::new(),
            found: found.into(),
            causes: Vec::new(),
        }
    }

    /// Something worth knowing.
    pub(super) fn remark(grade: Grade, name: &'static str, found: impl Into<String>) -> Self {
        Self {
            outcome: Outcome::Remark,
            ..Self::passed(grade, name, found)
        }
    }

    /// An item that could not be tested, because of `reason`.
    pub(super) fn not_tested(grade: Grade, name: &'static str, reason: impl Into<String>) -> Self {
        Self {
            outcome: Outcome::NotTested,
            ..Self::passed(grade, name, reason)
        }
    }

    /// An item that found something other than `expected`, with `causes` that fit.
    pub(super) fn failed(
        grade: Grade,
        name: &'static str,
        expected: impl Into<String>,
        found: impl Into<String>,
        causes: Vec<String>,
    ) -> Self {
        Self {
            outcome: Outcome::Failed,
            expected: expected.into(),
            causes,
            ..Self::passed(grade, name, found)
        }
    }
}

/// All items of one code, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    /// The items; none after a mandatory one that failed.
    pub items: Vec<Item>,
    /// What to do next.
    pub next: String,
}

impl Report {
    /// The report on a `folder` whose manifest is refused with `reason`.
    pub fn of_manifest(reason: &str, folder: &str) -> Self {
        let expected = "a manifest, code.toml, that describes a code";
        let usual = "usual causes: a key misspelt or in another table; a file that is named, but not there; a name that \
                     another code has";
        let causes = vec![usual.to_owned()];
        Self {
            items: vec![Item::failed(
                Grade::Mandatory,
                "manifest",
                expected,
                reason,
                causes,
            )],
            next: format!(
                "mend the manifest, then: tristack check {}",
                folder_argument(folder)
            ),
        }
    }

    /// Returns the worst grade that failed.
    pub fn failed_grade(&self) -> Option<Grade> {
        self.failures().map(|item| item.grade).min()
    }

    /// Returns the items that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Item> {
        let items = self.items.iter();
        items.filter(|item| item.outcome == Outcome::Failed)
    }

    /// Adds what another command has found.
    pub fn add_of_others(&mut self, found: String) {
        let item = Item::remark(Grade::Informational, "other commands", found);
        self.items.push(item);
    }

    /// Says what is wrong: the names of the items that failed, with the first cause that they share, or else what was
    /// found.
    pub fn wrong(&self) -> Vec<String> {
        let mut told: Vec<(&str, Vec<&str>)> = Vec::new();
        for item in self.failures() {
            let cause = item.causes.first().unwrap_or(&item.found);
            match told.iter_mut().find(|(other, _)| other == cause) {
                Some((_, names)) => names.push(item.name),
                None => told.push((cause, vec![item.name])),
            }
        }
        let told = told.into_iter();
        told.map(|(cause, names)| format!("{}: {cause}", names.join(", ")))
            .collect()
    }
}
