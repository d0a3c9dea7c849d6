//! The checks, by subject. Each holds what is printed against something worked out another way.

mod appendix;
mod contact_law;
mod elastic;
mod estimates;
mod high_friction;
mod perturbation;
mod preparation;
mod quintic;
mod rigid;
mod runs;
mod scaling;
mod supplement;

use super::finding::Finding;
use super::printed::PaperTheory;
use crate::paper::reproduction::Reproduction;

/// How a check works.
enum Test {
    /// On formulas and theory alone.
    Theory(fn(&PaperTheory) -> Finding),
    /// On runs; the error says what is missing.
    Runs(fn(&PaperTheory, &Reproduction) -> Result<Finding, String>),
}

/// A check that claims can name.
pub struct Check {
    /// Its name in the register.
    pub name: &'static str,
    test: Test,
}

impl Check {
    const fn theory(name: &'static str, test: fn(&PaperTheory) -> Finding) -> Self {
        let test = Test::Theory(test);
        Self { name, test }
    }

    const fn runs(
        name: &'static str,
        test: fn(&PaperTheory, &Reproduction) -> Result<Finding, String>,
    ) -> Self {
        let test = Test::Runs(test);
        Self { name, test }
    }

    /// What the check finds in what `paper` says and what was run, or why it cannot find anything.
    pub fn run(&self, paper: &PaperTheory, runs: Option<&Reproduction>) -> Result<Finding, String> {
        match (&self.test, runs) {
            (Test::Theory(test), _) => Ok(test(paper)),
            (Test::Runs(test), Some(runs)) => test(paper, runs),
            (Test::Runs(_), None) => Err("this takes DEM runs, and none were made".to_owned()),
        }
    }
}

/// Every check.
pub fn all() -> impl Iterator<Item = &'static Check> {
    let groups: [&'static [Check]; 12] = [
        rigid::CHECKS,
        contact_law::CHECKS,
        elastic::CHECKS,
        scaling::CHECKS,
        quintic::CHECKS,
        perturbation::CHECKS,
        appendix::CHECKS,
        supplement::CHECKS,
        high_friction::CHECKS,
        estimates::CHECKS,
        runs::CHECKS,
        preparation::CHECKS,
    ];
    groups.into_iter().flatten()
}

/// The check of that name.
pub fn find(name: &str) -> Option<&'static Check> {
    all().find(|check| check.name == name)
}
