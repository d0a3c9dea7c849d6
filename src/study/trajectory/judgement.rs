//! What is said of a code, and the rows that say it.

use super::distance::{Branch, Distance, Quantity};
use super::documented::{Documented, DocumentedOrder};
use super::judge::order_between;
use super::plan::Twin;
use crate::code::Code;
use crate::study::Source;
use crate::study::Verdict;
use crate::study::convention::{Probed, contradictions, is_contradicted};

/// What is said of one code.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryJudgement {
    /// The code.
    pub code: Code,
    /// Its version.
    pub version: String,
    /// Live or recorded.
    pub source: Source,
    /// Times of the peak, of the loss of the wall and of the landing; `None` if there is no comparison.
    pub times: Option<[f64; 3]>,
    /// Every quantity on every branch with every twin; none if a run is not there or shows no yield.
    pub comparisons: Vec<Comparison>,
    /// What stands in place of the comparisons where there are none.
    pub verdict: Verdict,
    /// What explains that verdict.
    pub notes: Vec<String>,
}

/// One quantity on one branch with one twin.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// What the twin has of the convention of the code.
    pub twin: Twin,
    /// What is compared.
    pub quantity: Quantity,
    /// Where.
    pub branch: Branch,
    /// How the distance must fall.
    pub documented: Documented,
    /// The distances, coarsest time step first.
    pub distances: Vec<Distance>,
    /// Largest change of the twin itself when its time step is halved.
    pub step_error: f64,
    /// What follows.
    pub verdict: Verdict,
    /// What explains a verdict other than `agrees`.
    pub note: Option<String>,
}

impl TrajectoryJudgement {
    /// The verdict on every comparison, or the one in their place.
    pub fn verdicts(&self) -> Vec<Verdict> {
        if self.comparisons.is_empty() {
            return vec![self.verdict];
        }
        self.comparisons
            .iter()
            .map(|comparison| comparison.verdict)
            .collect()
    }

    /// Takes the judgement back where the twin has a convention that the code does not have, or is not known to
    /// have: `probes` are those of the codes.
    pub fn unless_contradicted<'a>(
        mut self,
        probes: impl IntoIterator<Item = (Code, &'a Probed)>,
    ) -> Self {
        let mut probes = probes.into_iter();
        let own = probes.find(|(code, _)| *code == self.code);
        let Some((_, probed)) = own.filter(|_| !self.comparisons.is_empty()) else {
            return self;
        };
        if let Some(first) = contradictions(probed).first() {
            self.notes.push(format!("not judged: {first}"));
            self.comparisons.clear();
            self.verdict = if is_contradicted(probed) {
                Verdict::Differs
            } else {
                Verdict::Inconclusive
            };
        }
        self
    }
}

impl Comparison {
    /// The order between the two finest time steps; `None` if there is nothing but rounding.
    pub fn last_order(&self) -> Option<f64> {
        let [.., coarser, finest] = self.distances.as_slice() else {
            return None;
        };
        self.order(coarser, finest)
    }

    /// The order between two time steps; `None` if there is nothing but rounding.
    pub fn order(&self, coarser: &Distance, finer: &Distance) -> Option<f64> {
        let has_one = self.documented.order != DocumentedOrder::RoundOff;
        has_one.then(|| order_between(coarser, finer)).flatten()
    }
}
