//! Micro-tests with their outcomes, kept so that a code need not be probed twice.

use crate::code::{InstalledCode, Provenance, TaskKind};
use crate::files::{FileError, parse_json};
use crate::model::{ContactTest, sha256_hex};
use crate::series::Motion;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The micro-tests of a code with their outcomes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeRecord {
    /// The origin of the outcomes.
    pub provenance: Provenance,
    /// Each micro-test and its outcome.
    pub answers: Vec<Answer>,
}

/// A micro-test and its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The micro-test.
    pub test: ContactTest,
    /// SHA-256 of all inputs of the program.
    pub input_hash: String,
    /// The outcome.
    pub motion: Motion,
}

/// Returns the address of the record of `code`, which depends on its identity and its decks.
pub(crate) fn probe_address(code: &dyn InstalledCode) -> String {
    let decks = [TaskKind::Motion, TaskKind::SpheresMotion];
    let decks = decks.map(|kind| code.name().files_hash(kind));
    let parts = serde_json::json!([code.identity().deciding(), decks]);
    sha256_hex(parts.to_string().as_bytes())
}

/// Largest relative difference between spins that count as the same. Spins to the slip threshold are measured, and
/// may differ between machines in the last of their eleven digits; a tenth of the distance from the slip threshold
/// does not matter.
const SAME_SPIN: f64 = 1.1e-11;

/// Whether two micro-tests are the same up to the rounding of their spins.
fn is_same(left: &ContactTest, right: &ContactTest) -> bool {
    let mut with_same_spins = *left;
    let mut alike = true;
    let bodies = with_same_spins.initial_motions.iter_mut();
    for (body, other) in bodies.zip(&right.initial_motions) {
        alike &= (body.spin - other.spin).abs() <= SAME_SPIN * other.spin.abs();
        body.spin = other.spin;
    }
    alike && with_same_spins == *right
}

impl ProbeRecord {
    /// Reads the record in the `text` of the file at `path`.
    pub fn parse(text: &[u8], path: &Path) -> Result<Self, FileError> {
        let record: Self = parse_json(text, path)?;
        for Answer { test, motion, .. } in &record.answers {
            let checked = Motion::new(motion.rows().to_vec(), test.steps);
            checked.map_err(FileError::series(path))?;
        }
        Ok(record)
    }

    /// Returns JSON on one line.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain data has a JSON form") + "\n"
    }

    /// Returns the outcomes of `tests` in their order, if all of them are there.
    pub fn answer(&self, tests: &[ContactTest]) -> Option<Vec<Motion>> {
        let answers = tests.iter().map(|test| {
            let mut known = self.answers.iter();
            let found = known.find(|known| is_same(&known.test, test));
            found.map(|known| known.motion.clone())
        });
        answers.collect()
    }

    /// Returns the first answer whose inputs differ from today's, which `input_hash` hashes. It is called with the
    /// recorded micro-test, whose spins may differ in their last digits from those of today.
    pub fn outdated(&self, input_hash: impl Fn(&ContactTest) -> String) -> Option<&Answer> {
        let mut answers = self.answers.iter();
        answers.find(|answer| answer.input_hash != input_hash(&answer.test))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ContactConvention, InitialMotion};

    #[test]
    fn a_spin_may_differ_in_its_last_digits_and_nothing_else() {
        let initial_motion = InitialMotion {
            spin: 4e-4,
            ..InitialMotion::at(0.0, 0.8)
        };
        let test = ContactTest {
            convention: ContactConvention::TURNING,
            stiffness_ratio: 0.5,
            floor_friction: 5e-4,
            cylinder_friction: 5e-4,
            time_step: 0.01,
            steps: 8,
            wall_height: 4.5,
            wall_speed: 0.0,
            initial_motions: [initial_motion, InitialMotion::at(6.0, 2.0)],
            drive: None,
            space: None,
        };
        let with = |spin: f64, x: f64| {
            let mut other = test;
            other.initial_motions[0].spin = spin;
            other.initial_motions[0].x = x;
            other
        };
        assert!(is_same(&with(4e-4 * (1.0 + 1e-11), 0.0), &test));
        assert!(!is_same(&with(4e-4 * (1.0 + 1e-10), 0.0), &test));
        assert!(!is_same(&with(4e-4, 1e-15), &test));
    }
}
