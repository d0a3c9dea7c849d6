//! The comparison of a code with its twins, and its rows.

use super::distance::{Branch, Distance, Quantity};
use super::documented::{Documented, DocumentedOrder};
use super::judge::order_between;
use super::plan::{Trajectory, Twin};
use crate::study::{Grounds, Judged, Verdict};

/// Times at which branches end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// Time of the peak of the wall force.
    pub peak: f64,
    /// Times of the loss of the wall contact and of the landing; `None` where only the compression is compared.
    pub later: Option<[f64; 2]>,
}

/// The result of comparing the runs of a code with those of its twins.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryFinding {
    /// Times at which branches end; `None` without a comparison.
    pub times: Option<Times>,
    /// Every quantity on every branch with every twin; empty if a twin shows no yield, or columns are absent.
    pub comparisons: Vec<Comparison>,
}

/// A code that has been compared with its twins.
pub type TrajectoryJudgement = Judged<Trajectory, TrajectoryFinding>;

/// One quantity on one branch with one twin.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The twin.
    pub twin: Twin,
    /// The quantity.
    pub quantity: Quantity,
    /// The branch.
    pub branch: Branch,
    /// The order that the distances must have.
    pub documented: Documented,
    /// The distances, coarsest time step first.
    pub distances: Vec<Distance>,
    /// Largest change of the twin itself when its time step is halved.
    pub step_error: f64,
    /// The grounds for a verdict on it.
    pub grounds: Grounds,
}

impl TrajectoryJudgement {
    /// The comparisons; empty if a run is missing, or the twin has another convention than the code.
    pub fn comparisons(&self) -> &[Comparison] {
        match &self.finding {
            Some(finding) if self.grounds.is_judged() => &finding.comparisons,
            _ => &[],
        }
    }

    /// Times at which branches end; `None` if there is no comparison.
    pub fn times(&self) -> Option<Times> {
        self.finding.as_ref()?.times
    }

    /// The verdict on every comparison, or the verdict on the row if there are none.
    pub fn verdicts(&self) -> Vec<Verdict> {
        match self.comparisons() {
            [] => vec![self.verdict()],
            comparisons => comparisons.iter().map(Comparison::verdict).collect(),
        }
    }
}

impl Comparison {
    /// The verdict.
    pub fn verdict(&self) -> Verdict {
        self.grounds.verdict()
    }

    /// The order between the two finest time steps; `None` where only rounding is documented, or a distance is zero.
    pub fn last_order(&self) -> Option<f64> {
        let [.., coarser, finest] = self.distances.as_slice() else {
            return None;
        };
        self.order(coarser, finest)
    }

    /// The order between two time steps; `None` where only rounding is documented, or a distance is zero.
    pub fn order(&self, coarser: &Distance, finer: &Distance) -> Option<f64> {
        let has_one = self.documented.order != DocumentedOrder::RoundOff;
        has_one.then(|| order_between(coarser, finer)).flatten()
    }
}
