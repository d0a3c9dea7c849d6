//! The survey of the regime maps: sides of boundaries, repeats, largest forces.

use super::boundary::{Confirmation, Side, SidePlan};
use super::largest_force::{Examination, PeakPlan};
use crate::model::{HistoryUpdate, Stack};
use crate::study::{Campaign, Judged, Verdict};
use crate::theory::BoundaryPoint;
use std::collections::BTreeSet;

/// The studies of a survey.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyPlan {
    points: Vec<BoundaryPoint>,
    peaks: Vec<PeakPlan>,
}

/// The regime maps in the DEM.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Boundary by boundary.
    pub confirmations: Vec<Confirmation>,
    /// Stack by stack.
    pub examinations: Vec<Examination>,
    /// Why some of them are not judged, each reason once.
    pub notes: Vec<String>,
}

impl Survey {
    /// Returns every verdict, boundaries first.
    pub fn verdicts(&self) -> impl Iterator<Item = Verdict> + '_ {
        let boundaries = self.confirmations.iter().map(Confirmation::verdict);
        boundaries.chain(self.examinations.iter().map(|row| row.verdict))
    }
}

impl SurveyPlan {
    /// Plans runs beside `points`, and of the largest forces of `stacks`. Springs change by this rule as their
    /// contacts turn. Stacks whose end theory does not know are left out.
    pub fn new(points: &[BoundaryPoint], stacks: &[Stack], history_update: HistoryUpdate) -> Self {
        let peaks = stacks
            .iter()
            .filter_map(|stack| PeakPlan::new(stack, history_update));
        Self {
            points: points.to_vec(),
            peaks: peaks.collect(),
        }
    }
}

/// Carries out `plan` with the native code; `None` after an interrupt.
pub fn survey(plan: &SurveyPlan, campaign: &Campaign) -> Option<Survey> {
    let sides = plan.points.iter().flat_map(SidePlan::beside).collect();
    let mut sides = campaign.carry_out::<SidePlan>(sides);
    let repeated = sides.iter_mut().filter_map(|side| {
        let repeat = side.study.repeat(side.finding.as_ref()?)?;
        Some((side, repeat))
    });
    let (repeated, repeats): (Vec<_>, Vec<_>) = repeated.unzip();
    for (side, judged) in repeated.into_iter().zip(campaign.carry_out(repeats)) {
        *side = judged;
    }
    let peaks = campaign.carry_out(plan.peaks.clone());
    if campaign.settings().interrupt.requested() {
        return None;
    }
    let of_sides = sides.iter().flat_map(Judged::notes);
    let notes: BTreeSet<&str> = of_sides
        .chain(peaks.iter().flat_map(Judged::notes))
        .collect();
    let notes = notes.into_iter().map(str::to_owned).collect();
    let sides: Vec<Side> = sides.iter().map(Side::new).collect();
    let pairs = plan.points.iter().zip(sides.chunks_exact(2));
    let confirmations = pairs.map(|(point, sides)| Confirmation {
        point: *point,
        sides: [sides[0], sides[1]],
    });
    Some(Survey {
        confirmations: confirmations.collect(),
        examinations: peaks.iter().map(Examination::new).collect(),
        notes,
    })
}
