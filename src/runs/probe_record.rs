//! Micro-tests with their outcomes, kept so that a code need not be probed twice.

use crate::code::Provenance;
use crate::files::FileError;
use crate::model::ContactTest;
use crate::series::Motion;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a code answered to micro-tests.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProbeRecord {
    /// Who answered, how and when.
    pub provenance: Provenance,
    /// Each micro-test and its outcome.
    pub answers: Vec<Answer>,
}

/// What a code answered to one micro-test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Answer {
    /// The question.
    pub test: ContactTest,
    /// SHA-256 of all that the program was given with it.
    pub input_hash: String,
    /// What came out.
    pub motion: Motion,
}

/// Spins to the slip threshold are measured, and may differ between machines in the last of their eleven
/// digits; a tenth of the distance from the slip threshold does not matter.
const SAME_SPIN: f64 = 1.1e-11;

/// Whether two micro-tests are the same but for the rounding of their spins.
fn is_same(left: &ContactTest, right: &ContactTest) -> bool {
    let spins = |test: &ContactTest| {
        test.initial_motions
            .map(|initial_motion| initial_motion.spin)
    };
    let pairs = spins(left).into_iter().zip(spins(right));
    let alike = pairs
        .into_iter()
        .all(|(left, right)| (left - right).abs() <= SAME_SPIN * right.abs());
    let mut with_same_spins = *left;
    for (initial_motion, spin) in with_same_spins.initial_motions.iter_mut().zip(spins(right)) {
        initial_motion.spin = spin;
    }
    alike && with_same_spins == *right
}

impl ProbeRecord {
    /// Reads the record in the `text` of the file at `path`.
    ///
    /// # Errors
    /// If it is damaged.
    pub fn parse(text: &[u8], path: &Path) -> Result<Self, FileError> {
        let record: Self = serde_json::from_slice(text).map_err(|error| FileError::Provenance {
            path: path.to_owned(),
            message: error.to_string(),
        })?;
        for Answer { test, motion, .. } in &record.answers {
            Motion::new(motion.rows().to_vec(), test.steps).map_err(|source| {
                FileError::Series {
                    path: path.to_owned(),
                    source,
                }
            })?;
        }
        Ok(record)
    }

    /// JSON on one line.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain data has a JSON form") + "\n"
    }

    /// The outcomes of `tests`, in their order, if every one of them is there.
    pub fn answer(&self, tests: &[ContactTest]) -> Option<Vec<Motion>> {
        let answers = tests.iter().map(|test| {
            let mut known = self.answers.iter();
            let found = known.find(|known| is_same(&known.test, test));
            found.map(|known| known.motion.clone())
        });
        answers.collect()
    }

    /// An answer to something else than `input_hash`, which is today's, says of its micro-test. The hash is that
    /// of the recorded micro-test, whose spins may differ in their last digits from those asked here.
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
            convention: ContactConvention::PAPER,
            stiffness_ratio: 0.5,
            floor_friction: 5e-4,
            cylinder_friction: 5e-4,
            time_step: 0.01,
            steps: 8,
            wall_height: 4.5,
            wall_speed: 0.0,
            initial_motions: [initial_motion, InitialMotion::at(6.0, 2.0)],
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
