//! What is said of a code, and the rows that say it.

use super::distance::{Branch, Distance, Quantity};
use super::documented::{Documented, DocumentedOrder};
use super::judge::order_between;
use super::plan::{Trajectory, Twin};
use crate::code::Code;

use crate::study::{Grounds, Judged, Source, Verdict};
use serde::{Deserialize, Serialize};

/// What the runs of a code show beside those of its twins.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryFinding {
    /// Times of the peak, of the loss of the wall and of the landing; `None` if there is no comparison.
    pub times: Option<[f64; 3]>,
    /// Every quantity on every branch with every twin; none if a run shows no yield.
    pub comparisons: Vec<Comparison>,
}

/// A code that has been compared with its twins.
pub type TrajectoryJudgement = Judged<Trajectory, TrajectoryFinding>;

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
    /// What speaks for and against it.
    pub grounds: Grounds,
}

/// One line of the results: one distance. The force is in units of its peak, lengths in r, angles in
/// radians, times in √(m/k_n). A code without comparisons has one row without distance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryRow {
    /// The code.
    pub code: Code,
    /// Its version.
    pub version: String,
    /// Live or recorded.
    pub source: Source,
    /// What the twin has of its convention.
    pub twin: Option<Twin>,
    /// What is compared.
    pub quantity: Option<Quantity>,
    /// Where.
    pub branch: Option<Branch>,
    /// Time step of both.
    pub time_step: Option<f64>,
    /// Largest distance.
    pub largest: Option<f64>,
    /// Root-mean-square distance.
    pub rms: Option<f64>,
    /// Time of the first row on the branch that deviates by more than 1e-6; empty if none does.
    #[serde(rename = "first_above_1e-6")]
    pub first_above_1e6: Option<f64>,
    /// The same for 1e-4.
    #[serde(rename = "first_above_1e-4")]
    pub first_above_1e4: Option<f64>,
    /// The same for 1e-2.
    #[serde(rename = "first_above_1e-2")]
    pub first_above_1e2: Option<f64>,
    /// log₂ of the largest distance at twice the time step over this one; empty where nothing but rounding
    /// is expected.
    pub order: Option<f64>,
    /// How the distance must fall.
    pub documented_order: Option<DocumentedOrder>,
    /// What rounding may have done to the largest distance.
    pub round_off: Option<f64>,
    /// Largest change of the twin itself when its time step is halved.
    pub step_error: Option<f64>,
    /// The verdict on all time steps together.
    pub verdict: Verdict,
}

impl TrajectoryJudgement {
    /// The comparisons; none where a run is not there or the convention of the twin is not that of the code.
    pub fn comparisons(&self) -> &[Comparison] {
        match &self.finding {
            Some(finding) if self.grounds.is_judged() => &finding.comparisons,
            _ => &[],
        }
    }

    /// Times of the peak, of the loss of the wall and of the landing; `None` if there is no comparison.
    pub fn times(&self) -> Option<[f64; 3]> {
        self.finding.as_ref()?.times
    }

    /// The verdict on every comparison, or the one in their place.
    pub fn verdicts(&self) -> Vec<Verdict> {
        match self.comparisons() {
            [] => vec![self.verdict()],
            comparisons => comparisons.iter().map(Comparison::verdict).collect(),
        }
    }

    /// The rows, distance by distance.
    pub fn rows(&self) -> Vec<TrajectoryRow> {
        if self.comparisons().is_empty() {
            return vec![self.blank_row()];
        }
        self.comparisons()
            .iter()
            .flat_map(|comparison| self.rows_of(comparison))
            .collect()
    }

    fn rows_of(&self, comparison: &Comparison) -> Vec<TrajectoryRow> {
        let distances = &comparison.distances;
        let rows = distances.iter().enumerate().map(|(index, distance)| {
            let coarser = index
                .checked_sub(1)
                .and_then(|before| distances.get(before));
            let [first_above_1e6, first_above_1e4, first_above_1e2] = distance.first_above;
            TrajectoryRow {
                twin: Some(comparison.twin),
                quantity: Some(comparison.quantity),
                branch: Some(comparison.branch),
                time_step: Some(distance.time_step),
                largest: Some(distance.largest),
                rms: Some(distance.rms),
                first_above_1e6,
                first_above_1e4,
                first_above_1e2,
                order: coarser.and_then(|coarser| comparison.order(coarser, distance)),
                documented_order: Some(comparison.documented.order),
                round_off: Some(distance.round_off),
                step_error: Some(comparison.step_error),
                verdict: comparison.verdict(),
                ..self.blank_row()
            }
        });
        rows.collect()
    }

    fn blank_row(&self) -> TrajectoryRow {
        TrajectoryRow {
            code: self.code,
            version: self.version.clone(),
            source: self.source,
            twin: None,
            quantity: None,
            branch: None,
            time_step: None,
            largest: None,
            rms: None,
            first_above_1e6: None,
            first_above_1e4: None,
            first_above_1e2: None,
            order: None,
            documented_order: None,
            round_off: None,
            step_error: None,
            verdict: self.verdict(),
        }
    }
}

impl Comparison {
    /// The verdict.
    pub fn verdict(&self) -> Verdict {
        self.grounds.verdict()
    }

    /// The order between the two finest time steps; `None` if there is nothing but rounding.
    pub fn last_order(&self) -> Option<f64> {
        let [.., coarser, finest] = self.distances.as_slice() else {
            return None;
        };
        self.order(coarser, finest)
    }

    fn order(&self, coarser: &Distance, finer: &Distance) -> Option<f64> {
        let has_one = self.documented.order != DocumentedOrder::RoundOff;
        has_one.then(|| order_between(coarser, finer)).flatten()
    }
}
