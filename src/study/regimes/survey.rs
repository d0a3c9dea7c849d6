//! The survey of the regime maps: plan, runs, repeats, evaluation.

use super::boundary::{Confirmation, SidePlan};
use super::largest_force::{Examination, PeakPlan};
use crate::dem::{EventRun, Observation};
use crate::model::Stack;
use crate::runs::{Progress, Settings, observe_all};
use crate::study::Verdict;
use crate::theory::BoundaryPoint;

/// The runs of a survey.
#[derive(Debug, Clone, PartialEq)]
pub struct SurveyPlan {
    points: Vec<BoundaryPoint>,
    /// Both neighbours of every point.
    sides: Vec<SidePlan>,
    peaks: Vec<PeakPlan>,
}

/// The regime maps in the DEM.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Boundary by boundary.
    pub confirmations: Vec<Confirmation>,
    /// Stack by stack.
    pub examinations: Vec<Examination>,
}

impl Survey {
    /// Every verdict, boundaries first.
    pub fn verdicts(&self) -> impl Iterator<Item = Verdict> + '_ {
        let boundaries = self.confirmations.iter().map(Confirmation::verdict);
        boundaries.chain(self.examinations.iter().map(|row| row.verdict))
    }
}

impl SurveyPlan {
    /// The neighbours of `points`, and the largest forces of `stacks`.
    pub fn new(points: &[BoundaryPoint], stacks: &[Stack]) -> Self {
        Self {
            points: points.to_vec(),
            sides: points.iter().flat_map(SidePlan::beside).collect(),
            peaks: stacks.iter().filter_map(PeakPlan::new).collect(),
        }
    }

    /// The runs of the first round: those of the sides, then those of the largest forces.
    fn runs(&self) -> Vec<EventRun> {
        let sides = self.sides.iter().map(|side| side.run);
        let peaks = self.peaks.iter().flat_map(|peak| peak.runs.clone());
        sides.chain(peaks).collect()
    }

    /// The runs of the second round, which follow from those `observed` in the first: repeats of sides.
    fn repeats(&self, observed: &[Observation]) -> Vec<EventRun> {
        let sides = self.sides.iter().zip(observed);
        sides
            .filter_map(|(side, first)| side.repeat(first))
            .collect()
    }

    /// The result of both rounds.
    fn evaluate(&self, observed: &[Observation], repeated: &[Observation]) -> Survey {
        let (of_sides, mut of_peaks) = observed.split_at(self.sides.len());
        let mut repeated = repeated.iter();
        let sides = self.sides.iter().zip(of_sides).map(|(side, first)| {
            let repeat = side.repeat(first).and_then(|_| repeated.next());
            side.evaluate(first, repeat)
        });
        let sides: Vec<_> = sides.collect();
        let confirmations = self.points.iter().zip(sides.chunks_exact(2));
        let examinations = self.peaks.iter().map(|peak| {
            let (own, others) = of_peaks.split_at(peak.runs.len());
            of_peaks = others;
            peak.evaluate(own)
        });
        Survey {
            confirmations: confirmations
                .map(|(point, sides)| Confirmation {
                    point: *point,
                    sides: [sides[0], sides[1]],
                })
                .collect(),
            examinations: examinations.collect(),
        }
    }
}

/// Carries out `plan`: both rounds of runs, from the store where they are there already.
pub fn survey(plan: &SurveyPlan, settings: &Settings, progress: &dyn Progress) -> Survey {
    let observed = observe_all(&plan.runs(), settings, progress);
    let repeated = observe_all(&plan.repeats(&observed), settings, progress);
    plan.evaluate(&observed, &repeated)
}
