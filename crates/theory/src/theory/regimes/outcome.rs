//! Outcome of loading one stack: the first event, its effect, and the largest force that the stack carries.

use super::super::events::Event;
use super::critical_state::{CriticalState, LoadingPhase};
use super::equilibrium_path::EquilibriumPath;
use super::release::Release;
use crate::model::{HistoryUpdate, Stack};
use serde::Serialize;
use std::fmt;

/// The effect of the first event on the stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FailureMode {
    /// The stack does not stand.
    Collapses,
    /// The floor gives way under the wall.
    Yields,
    /// The cylinders give way under the wall.
    Saturates,
    /// The bottom cylinders carry part of the load between them.
    Shares,
    /// The wall rests on the bottom cylinders too.
    SecondLoadPath,
    /// The load passes a maximum before any event.
    Softens,
}

impl fmt::Display for FailureMode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Collapses => "the stack does not carry its own weight",
            Self::Yields => "equilibrium ends; the force there is the yield force",
            Self::Saturates => {
                "equilibrium ends at T = mu_d; the force there is the largest, whatever mu is"
            }
            Self::Shares => {
                "the path goes on with c > 0; a slip ends it only where the contact has opened again"
            }
            Self::SecondLoadPath => {
                "the wall rests on all three cylinders; the force grows without a peak"
            }
            Self::Softens => "the load has passed its maximum before anything slips",
        })
    }
}

/// The first event, the first slip or wall contact, and the phases in which they occur: the common properties of all
/// stacks in one region of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Regime {
    /// The first event.
    pub first: Event,
    /// The phase in which it occurs.
    pub first_stage: LoadingPhase,
    /// The first slip or wall contact; differs from the first event where contact 2–3 closes before it.
    pub last: Event,
    /// The phase in which that occurs.
    pub last_stage: LoadingPhase,
}

impl fmt::Display for Regime {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let when = |stage| match stage {
            LoadingPhase::OwnWeight => " under own weight",
            LoadingPhase::Wall => "",
        };
        if self.first != self.last {
            write!(formatter, "{}, then ", self.first)?;
        }
        write!(formatter, "{}{}", self.last, when(self.last_stage))
    }
}

/// The outcome of loading a stack until equilibrium ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadingOutcome {
    /// The first event.
    pub first: CriticalState,
    /// The first slip or wall contact; differs from the first event where contact 2–3 closes before it.
    pub last: CriticalState,
    /// Effect of the first event.
    pub failure_mode: FailureMode,
    /// Where equilibrium ends. `None` where the stack does not stand, where the wall comes to rest on the bottom
    /// cylinders, and where the end is unknown. Later than `last` if that is a slip with c > 0.
    pub end: Option<CriticalState>,
    /// Whether the end is known: no theory covers cylinders that slip on each other with c > 0 while their springs
    /// remember how they have turned.
    pub is_end_known: bool,
    /// The largest force F that the stack carries: that at the end, unless the stack softens before.
    pub largest_force: Option<f64>,
}

impl LoadingOutcome {
    /// Loads `stack` with the paper's arms and linear springs that follow the rule `history_update`. `None` if the
    /// path of equilibria ends before any event, and for spheres.
    ///
    /// ```
    /// use tristack_theory::model::{HistoryUpdate, Stack};
    /// use tristack_theory::theory::{FailureMode, Event, LoadingOutcome};
    ///
    /// let slippery = Stack { cylinder_friction: 0.4, ..Stack::paper(0.5, 1e2) };
    /// let outcome = LoadingOutcome::of(&slippery, HistoryUpdate::Rotated).unwrap();
    /// assert_eq!(outcome.first.event, Event::CylinderSlip);
    /// assert_eq!(outcome.failure_mode, FailureMode::Saturates);
    /// assert!((outcome.first.tangent - 0.4).abs() < 1e-12);
    /// ```
    pub fn of(stack: &Stack, history_update: HistoryUpdate) -> Option<Self> {
        Self::on(&EquilibriumPath::new(stack, history_update), stack)
    }

    /// Loads a `stack` whose path is known.
    pub fn on(path: &EquilibriumPath, stack: &Stack) -> Option<Self> {
        stack.refuse_spheres().ok()?;
        let (event, parameter) = last_event(path, stack)?;
        let last = path.critical_state(event, parameter);
        let release = (last.bottom_force > 0.0 && event != Event::WallContact)
            .then(|| Release::of(stack, path, (event, parameter)));
        let end = match (release, last.stage, event) {
            (Some(Release::Ends(end)), ..) => Some(end),
            (Some(_), ..) | (_, LoadingPhase::OwnWeight, _) | (_, _, Event::WallContact) => None,
            _ => Some(last),
        };
        // A stack that slips from the start and falls never comes to rest on a fifth contact.
        let falls_at_once = parameter == 0.0 && release.is_none_or(|end| end == Release::Falls);
        let closing = path.locate(Event::ContactCloses, stack);
        let closing = closing.filter(|&closing| closing <= parameter && !falls_at_once);
        let first = closing.map_or(last, |closing| {
            path.critical_state(Event::ContactCloses, closing)
        });
        let passed = path.largest_until(parameter, |point| point.wall_force) * stack.stiffness;
        let softens = end.is_some_and(|end| passed > end.force * (1.0 + MAXIMUM_MARGIN));
        Some(Self {
            is_end_known: release != Some(Release::Unknown),
            failure_mode: failure_mode(&first, softens),
            largest_force: end.map(|end| end.force.max(passed)),
            first,
            last,
            end,
        })
    }

    /// The region of the map to which the stack belongs.
    pub fn regime(&self) -> Regime {
        Regime {
            first: self.first.event,
            first_stage: self.first.stage,
            last: self.last.event,
            last_stage: self.last.stage,
        }
    }
}

/// Forces closer than this count as equal: the quadrature behind them is exact to a few units of round-off.
const MAXIMUM_MARGIN: f64 = 1e-12;

fn failure_mode(first: &CriticalState, softens: bool) -> FailureMode {
    match (first.event, first.stage) {
        (Event::ContactCloses, _) => FailureMode::Shares,
        (_, LoadingPhase::OwnWeight) => FailureMode::Collapses,
        (Event::WallContact, _) => FailureMode::SecondLoadPath,
        _ if softens => FailureMode::Softens,
        (Event::CylinderSlip, _) => FailureMode::Saturates,
        _ => FailureMode::Yields,
    }
}

/// Returns the first slip or wall contact, and its parameter.
fn last_event(path: &EquilibriumPath, stack: &Stack) -> Option<(Event, f64)> {
    let slips = [Event::FloorSlip, Event::CylinderSlip];
    let slips = slips.map(|event| path.locate(event, stack).map(|at| (event, at)));
    if let [Some((_, floor)), Some((_, pair))] = slips
        && floor == 0.0
        && pair == 0.0
    {
        return Some((weaker_contact(path, stack), 0.0));
    }
    let wall = path.wall_contact().map(|at| (Event::WallContact, at));
    let candidates = slips.into_iter().chain([wall]).flatten();
    candidates.min_by(|left, right| left.1.total_cmp(&right.1))
}

/// Returns the contact that slides where neither friction suffices from the start: the one that falls further short of
/// what it needs, since it limits b = e to less than the other one can carry.
fn weaker_contact(path: &EquilibriumPath, stack: &Stack) -> Event {
    let point = path.point(path.beginning());
    let floor = stack.floor_friction / point.floor_ratio;
    let pair = stack.cylinder_friction / point.pair_friction;
    if floor <= pair {
        Event::FloorSlip
    } else {
        Event::CylinderSlip
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_regimes_and_failure_modes_have_words() {
        assert_eq!(LoadingPhase::OwnWeight.to_string(), "own weight");
        assert_eq!(LoadingPhase::Wall.to_string(), "wall");
        let regime = |first, last, last_stage| Regime {
            first,
            first_stage: LoadingPhase::OwnWeight,
            last,
            last_stage,
        };
        let closes = Event::ContactCloses;
        for (regime, words) in [
            (
                regime(Event::FloorSlip, Event::FloorSlip, LoadingPhase::Wall),
                "floor-slip",
            ),
            (
                regime(Event::FloorSlip, Event::FloorSlip, LoadingPhase::OwnWeight),
                "floor-slip under own weight",
            ),
            (
                regime(closes, Event::CylinderSlip, LoadingPhase::Wall),
                "contact-closes, then cylinder-slip",
            ),
        ] {
            assert_eq!(regime.to_string(), words);
        }
        for (failure_mode, part) in [
            (FailureMode::Collapses, "does not carry its own weight"),
            (FailureMode::Yields, "the yield force"),
            (FailureMode::Saturates, "whatever mu is"),
            (FailureMode::Shares, "c > 0"),
            (FailureMode::SecondLoadPath, "without a peak"),
            (FailureMode::Softens, "passed its maximum"),
        ] {
            assert!(failure_mode.to_string().contains(part), "{failure_mode}");
        }
    }
}
