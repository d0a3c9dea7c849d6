//! A boundary of the regime map: the runs on both sides of it, and whether they show what is claimed.

use super::loading::loading;
use crate::code::{Code, SettledCode};
use crate::dem::{EventRun, Loading, Observation, Until};
use crate::model::{HistoryUpdate, Stack};
use crate::runs::Workload;
use crate::study::{Evaluation, Ground, Grounds, Judged, Study, Verdict};
use crate::theory::{BoundaryPoint, Event, LoadingOutcome, Regime};

/// Wall speed in units of the predicted displacement. It keeps the forces at the events within 3e-5 of those of
/// theory, and shifts the boundaries by far less than [`super::THREE_DIGITS`].
const SPEED: f64 = 2e-4;
/// Travel of the wall in units of the predicted travel, if no event comes.
const FURTHER: f64 = 1.05;
/// Factor by which a run that contradicts the claim is slowed down for its repeat.
const SLOWER: f64 = 4.0;

/// A stack beside a boundary: claim and observation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// The stack.
    pub stack: Stack,
    /// What theory predicts.
    pub claimed: LoadingOutcome,
    /// The regime in the DEM; `None` if no event came, or the run was given up.
    pub observed: Option<Regime>,
    /// Force of the wall at the last event in the DEM, in m g.
    pub observed_force: f64,
    /// Whether the observed regime is the claimed one.
    pub verdict: Verdict,
}

/// A point of a boundary, with the observations on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Confirmation {
    /// The point.
    pub point: BoundaryPoint,
    /// The neighbour below and the one above.
    pub sides: [Side; 2],
}

impl Confirmation {
    /// Returns the worse verdict of the two sides. A boundary must have different regimes on its two sides.
    pub fn verdict(&self) -> Verdict {
        let [below, above] = self.point.sides.map(|outcome| outcome.regime());
        let mut grounds = Grounds::new();
        grounds.hold(below != above, "both sides have the same regime");
        let sides = self.sides.iter().map(|side| side.verdict);
        sides.fold(grounds.verdict(), Verdict::max)
    }
}

/// The run of one neighbour of a boundary point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SidePlan {
    claimed: LoadingOutcome,
    run: EventRun,
    /// If this is a repeat, the regime of the faster run, which contradicts the claim.
    contradicting: Option<Option<Regime>>,
}

impl SidePlan {
    /// Returns the neighbours of `point`, the one below first.
    pub(super) fn beside(point: &BoundaryPoint) -> [Self; 2] {
        let [below, above] = point.neighbours();
        let [claimed_below, claimed_above] = point.sides;
        [
            Self::new(below, point.history_update, claimed_below),
            Self::new(above, point.history_update, claimed_above),
        ]
    }

    fn new(stack: Stack, history_update: HistoryUpdate, claimed: LoadingOutcome) -> Self {
        let run = EventRun {
            stack,
            history_update,
            loading: loading(&stack, &claimed.last, SPEED, FURTHER),
            until: Until::LastEvent,
        };
        Self {
            claimed,
            run,
            contradicting: None,
        }
    }

    /// Returns the slower run that is needed if the one `observed` contradicts the claim.
    pub(super) fn repeat(&self, observed: &Observation) -> Option<Self> {
        let shown = regime(observed);
        let usual = self.run.loading;
        let slower = EventRun {
            loading: Loading {
                gravity_rate: usual.gravity_rate / SLOWER,
                wall_speed: usual.wall_speed / SLOWER,
                ..usual
            },
            ..self.run
        };
        (shown != Some(self.claimed.regime())).then_some(Self {
            run: slower,
            contradicting: Some(shown),
            ..*self
        })
    }
}

impl Study for SidePlan {
    type Reading = Observation;
    type Finding = Observation;

    fn code(&self) -> SettledCode {
        SettledCode::native()
    }

    fn workloads(&self) -> Vec<Workload<EventRun>> {
        vec![Workload {
            code: Code::native(),
            tasks: vec![self.run],
        }]
    }

    /// Compares the observed regime with the claim. A contradiction counts if the slower run shows it again; if it
    /// shows anything else, even what was claimed, nothing is decided. A run without events was too short to show
    /// anything.
    fn evaluate(&self, runs: Vec<Vec<Observation>>) -> Evaluation<Observation> {
        let finding = runs[0][0];
        let shown = regime(&finding);
        let mut grounds = Grounds::new();
        match self.contradicting {
            None if shown == Some(self.claimed.regime()) => grounds.add(Ground::Held),
            Some(first) if shown.is_some() && shown == first => {
                grounds.hold(false, "a slower run shows the contradiction again");
            }
            _ => grounds.add(Ground::Undecidable("the runs do not decide".to_owned())),
        }
        Evaluation { finding, grounds }
    }
}

impl Side {
    /// The stack and the last observation of it.
    pub(super) fn new(judged: &Judged<SidePlan, Observation>) -> Self {
        let observed = judged.finding.as_ref();
        Self {
            stack: judged.study.run.stack,
            claimed: judged.study.claimed,
            observed: observed.and_then(regime),
            observed_force: observed.map_or(0.0, |observed| observed.force),
            verdict: judged.verdict(),
        }
    }
}

/// Returns the observed regime; `None` without events.
fn regime(observation: &Observation) -> Option<Regime> {
    let (last, last_stage) = observation.last?;
    let (first, first_stage) = observation
        .closed
        .map_or((last, last_stage), |phase| (Event::ContactCloses, phase));
    Some(Regime {
        first,
        first_stage,
        last,
        last_stage,
    })
}
