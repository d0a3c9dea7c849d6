//! All of it: every boundary of every map, and every failure_mode.

use super::parallel::in_parallel;
use super::{Confirmation, Examination, confirm, examine, examined_stacks};
use crate::code::Interrupt;
use crate::study::Verdict;
use crate::theory::BoundaryPoint;

/// What the DEM says of the maps.
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

/// Looks at every one of `points` and examines every failure_mode, on `threads` threads; `finished` is told
/// how many more tasks are done.
pub fn survey(
    points: &[BoundaryPoint],
    threads: usize,
    interrupt: &Interrupt,
    finished: &(dyn Fn(usize) + Sync),
) -> Survey {
    let stacks = examined_stacks();
    let confirmations = in_parallel(points.len(), threads, |index| {
        let confirmation = confirm(&points[index], interrupt);
        finished(1);
        confirmation
    });
    let examinations = in_parallel(stacks.len(), threads, |index| {
        let examination = examine(&stacks[index], interrupt);
        finished(1);
        examination
    });
    Survey {
        confirmations,
        examinations: examinations.into_iter().flatten().collect(),
    }
}
