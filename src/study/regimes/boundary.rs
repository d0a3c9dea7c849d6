//! A boundary of the regime map: the runs on both sides of it, and whether they show what is claimed.

use super::loading::loading;
use crate::dem::{EventRun, Loading, Observation, Until};
use crate::model::Stack;
use crate::study::{Ground, Grounds, Verdict};
use crate::theory::{BoundaryPoint, Event, LoadingOutcome, Regime};

/// Wall speed in units of the predicted displacement. It keeps the forces at the events within 3e-5 of those of
/// theory, and shifts the boundaries by far less than [`super::THREE_DIGITS`].
const SPEED: f64 = 2e-4;
/// Travel of the wall in units of the predicted travel, if no event comes.
const FURTHER: f64 = 1.05;
/// How much slower a run is repeated that contradicts the claim.
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
    /// The worse of the two sides. A boundary with the same regime on both sides is none.
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
    pub(super) run: EventRun,
}

impl SidePlan {
    /// The neighbours of `point`, the one below first.
    pub(super) fn beside(point: &BoundaryPoint) -> [Self; 2] {
        let [below, above] = point.neighbours();
        let [claimed_below, claimed_above] = point.sides;
        [
            Self::new(below, claimed_below),
            Self::new(above, claimed_above),
        ]
    }

    fn new(stack: Stack, claimed: LoadingOutcome) -> Self {
        let run = EventRun {
            stack,
            loading: loading(&stack, &claimed.last, SPEED, FURTHER),
            until: Until::LastEvent,
        };
        Self { claimed, run }
    }

    /// The slower run that is needed if the `first` one contradicts the claim.
    pub(super) fn repeat(&self, first: &Observation) -> Option<EventRun> {
        let contradicted = first.complete && regime(first) != Some(self.claimed.regime());
        let usual = self.run.loading;
        contradicted.then_some(EventRun {
            loading: Loading {
                gravity_rate: usual.gravity_rate / SLOWER,
                wall_speed: usual.wall_speed / SLOWER,
                ..usual
            },
            ..self.run
        })
    }

    /// Compares the observation of the `first` run, and that of its repeat if there was one, with the claim. A
    /// contradiction counts if the slower run shows it again; if it shows anything else, even what was claimed,
    /// nothing is decided.
    pub(super) fn evaluate(&self, first: &Observation, repeat: Option<&Observation>) -> Side {
        let mut grounds = Grounds::new();
        match repeat {
            None if first.complete => grounds.add(Ground::Held),
            Some(second) if shows_again(first, second) => {
                grounds.hold(false, "a slower run shows the contradiction again");
            }
            _ => grounds.add(Ground::Undecidable("the runs do not decide".to_owned())),
        }
        let last = repeat.unwrap_or(first);
        Side {
            stack: self.run.stack,
            claimed: self.claimed,
            observed: regime(last),
            observed_force: last.force,
            verdict: grounds.verdict(),
        }
    }
}

/// Whether the `second` run is complete and shows the regime of the `first` one. A run without events was too short
/// to show anything.
fn shows_again(first: &Observation, second: &Observation) -> bool {
    second.complete && regime(second).is_some() && regime(second) == regime(first)
}

/// The observed regime; `None` without events.
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
