//! A boundary is confirmed where the DEM shows what is claimed on both sides of it.

use super::loading;
use crate::code::Interrupt;
use crate::dem::{Loading, Observation, Until, watch_stack};
use crate::model::Stack;
use crate::study::Verdict;
use crate::theory::{BoundaryPoint, Event, LoadingOutcome, Regime};

/// Relative distance from a boundary at which it is looked at: half a unit of the third digit.
pub const THREE_DIGITS: f64 = 5e-4;

/// Wall speed in units of the predicted displacement. The forces at the events are then within 3e-5 of the
/// theory's, and the boundaries far less than [`THREE_DIGITS`] away from theirs.
const SPEED: f64 = 2e-4;
/// How far the wall goes if nothing happens, in units of the predicted travel.
const FURTHER: f64 = 1.05;
/// How much slower a run is repeated that contradicts the claim.
const SLOWER: f64 = 4.0;

/// What was claimed and seen of a stack beside a boundary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    /// The stack.
    pub stack: Stack,
    /// What theory says of it.
    pub claimed: LoadingOutcome,
    /// What the DEM shows; `None` if nothing happened, or the run was given up.
    pub observed: Option<Regime>,
    /// Force of the wall at the last event, in m g, as the DEM shows it.
    pub observed_force: f64,
    /// Whether that is what was claimed.
    pub verdict: Verdict,
}

/// A point of a boundary, as the DEM sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Confirmation {
    /// The point.
    pub point: BoundaryPoint,
    /// The neighbour below and the one above.
    pub sides: [Side; 2],
}

impl Confirmation {
    /// The worse of the two sides. A boundary with the same on both sides is none.
    pub fn verdict(&self) -> Verdict {
        let verdicts = self.sides.map(|side| side.verdict);
        let [below, above] = self.point.sides.map(|outcome| outcome.regime());
        if below == above || verdicts.contains(&Verdict::Differs) {
            Verdict::Differs
        } else if verdicts == [Verdict::Agrees; 2] {
            Verdict::Agrees
        } else {
            Verdict::Inconclusive
        }
    }
}

/// Looks at both neighbours of `point` with the native DEM.
pub fn confirm(point: &BoundaryPoint, interrupt: &Interrupt) -> Confirmation {
    let [below, above] = point.neighbours();
    let [claimed_below, claimed_above] = point.sides;
    Confirmation {
        point: *point,
        sides: [
            look(below, claimed_below, interrupt),
            look(above, claimed_above, interrupt),
        ],
    }
}

/// Runs `stack`. A run that contradicts the claim is repeated more slowly: if it then shows the same, that is
/// what it is; if it shows something else, even what was claimed, nothing has been decided.
fn look(stack: Stack, claimed: LoadingOutcome, interrupt: &Interrupt) -> Side {
    let usual = loading(&stack, &claimed.last, SPEED, FURTHER);
    let slower = Loading {
        gravity_rate: usual.gravity_rate / SLOWER,
        wall_speed: usual.wall_speed / SLOWER,
        ..usual
    };
    let run = |loading: &Loading| {
        watch_stack(&stack, loading, Until::LastEvent, || !interrupt.requested())
    };
    let first = run(&usual);
    let expected = Some(claimed.regime());
    let (observation, verdict) = if !first.complete {
        (first, Verdict::Inconclusive)
    } else if regime(&first) == expected {
        (first, Verdict::Agrees)
    } else {
        let second = run(&slower);
        // A run that shows nothing at all has been too short, whatever it was meant to show.
        let decided =
            second.complete && regime(&second).is_some() && regime(&second) == regime(&first);
        let verdict = if decided {
            Verdict::Differs
        } else {
            Verdict::Inconclusive
        };
        (second, verdict)
    };
    Side {
        stack,
        claimed,
        observed: regime(&observation),
        observed_force: observation.force,
        verdict,
    }
}

/// What was observed, in the terms of the map.
fn regime(observation: &Observation) -> Option<Regime> {
    let (last, last_stage) = observation.last?;
    let (first, first_stage) = observation
        .closed
        .map_or((last, last_stage), |stage| (Event::ContactCloses, stage));
    Some(Regime {
        first,
        first_stage,
        last,
        last_stage,
    })
}
