//! The checks, by subject. Each compares a printed statement with the same result derived in another way.

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
use super::simulations::Simulations;
use super::truth::YieldState;
use crate::published::Published;
use crate::reproduction::Reproduction;

type TheoryTest = fn(&PaperTheory) -> Finding;
type StateTest = fn(&PaperTheory, &YieldState) -> f64;
type SimulationTest = fn(&PaperTheory, &Simulations) -> Result<Finding, String>;
type RunTest = fn(&PaperTheory, &Reproduction) -> Result<Finding, String>;

/// The data that a check needs.
enum Test {
    /// Formulas and theory alone.
    Theory(TheoryTest),
    /// The deviation of an equation at every yield state.
    AtStates(StateTest),
    /// Yield forces and series of native runs or of the published data; the error names those that are missing.
    Simulations(SimulationTest),
    /// Runs; the error names those that are missing.
    Runs(RunTest),
}

/// A check that claims can name.
pub(crate) struct Check {
    /// Its name in the register.
    pub(crate) name: &'static str,
    test: Test,
}

impl Check {
    const fn theory(name: &'static str, test: TheoryTest) -> Self {
        let test = Test::Theory(test);
        Self { name, test }
    }

    const fn at_states(name: &'static str, test: StateTest) -> Self {
        let test = Test::AtStates(test);
        Self { name, test }
    }

    const fn simulations(name: &'static str, test: SimulationTest) -> Self {
        let test = Test::Simulations(test);
        Self { name, test }
    }

    const fn runs(name: &'static str, test: RunTest) -> Self {
        let test = Test::Runs(test);
        Self { name, test }
    }

    /// Compares `paper` with theory or with the runs; an error says why that is impossible.
    pub(crate) fn run(
        &self,
        paper: &PaperTheory,
        runs: Option<&Reproduction>,
    ) -> Result<Finding, String> {
        match (&self.test, runs) {
            (Test::Theory(test), _) => Ok(test(paper)),
            (Test::AtStates(test), _) => Ok(appendix::at_states(|state| test(paper, state))),
            (Test::Runs(test), Some(runs)) => test(paper, runs),
            (Test::Simulations(test), Some(runs)) => test(paper, &Simulations::native(runs)),
            (Test::Runs(_) | Test::Simulations(_), None) => {
                Err("this takes DEM runs, and none were made".to_owned())
            }
        }
    }
}

impl Check {
    /// Runs the check on the published data; returns `None` for a check that takes no simulations.
    pub(crate) fn run_as_published(
        &self,
        paper: &PaperTheory,
        published: &Published,
    ) -> Option<Result<Finding, String>> {
        match &self.test {
            Test::Simulations(test) => Some(test(paper, &Simulations::published(published))),
            _ => None,
        }
    }
}

/// Returns every check.
fn all() -> impl Iterator<Item = &'static Check> {
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

/// Returns the names of all checks that a register may use.
pub fn check_names() -> Vec<&'static str> {
    all().map(|check| check.name).collect()
}

pub(crate) fn find(name: &str) -> Option<&'static Check> {
    all().find(|check| check.name == name)
}
