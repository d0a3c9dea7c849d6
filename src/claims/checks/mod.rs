//! The checks, by subject. Each holds what is printed against something worked out another way.

mod appendix;
mod contact_law;
mod elastic;
mod estimates;
mod high_friction;
mod perturbation;
mod quintic;
mod rigid;
mod scaling;
mod supplement;

use super::finding::Finding;
use super::printed::PaperTheory;
use crate::claims::Reproduction;
use std::collections::BTreeMap;

/// What a check is given.
pub struct Setting<'a> {
    /// What the paper says.
    pub paper: &'a PaperTheory,
    /// What the claim tells the check.
    pub parameters: &'a BTreeMap<String, f64>,
    /// What was run.
    pub runs: Option<&'a Reproduction>,
}

/// How a check works.
enum Test {
    /// On formulas and theory alone.
    Theory(fn(&PaperTheory) -> Finding),
    /// With parameters.
    Told(fn(&Setting) -> Result<Finding, String>),
}

/// A check that claims can name.
pub struct Check {
    /// Its name in the register.
    pub name: &'static str,
    /// The parameters it must be given.
    pub parameters: &'static [&'static str],
    test: Test,
}

impl Check {
    const fn theory(name: &'static str, test: fn(&PaperTheory) -> Finding) -> Self {
        Self {
            name,
            parameters: &[],
            test: Test::Theory(test),
        }
    }

    const fn told(
        name: &'static str,
        parameters: &'static [&'static str],
        test: fn(&Setting) -> Result<Finding, String>,
    ) -> Self {
        Self {
            name,
            parameters,
            test: Test::Told(test),
        }
    }

    /// What the check finds, or why it cannot find anything.
    pub fn run(&self, setting: &Setting) -> Result<Finding, String> {
        match self.test {
            Test::Theory(test) => Ok(test(setting.paper)),
            Test::Told(test) => test(setting),
        }
    }
}

impl Setting<'_> {
    /// A parameter, which the register has made sure of.
    fn parameter(&self, name: &str) -> f64 {
        self.parameters.get(name).copied().unwrap_or(f64::NAN)
    }
}

/// Every check.
pub fn all() -> impl Iterator<Item = &'static Check> {
    let groups: [&'static [Check]; 10] = [
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
    ];
    groups.into_iter().flatten()
}

/// The check of that name.
pub fn find(name: &str) -> Option<&'static Check> {
    all().find(|check| check.name == name)
}
