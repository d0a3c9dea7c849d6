//! Slip while contact 2–3 is closed: the stack goes on until that contact opens.

use super::super::events::{Event, locate};
use super::super::path::{FollowedPath, RememberedBranch, remembered_overlap_at_rest};
use super::super::root::bracketed_root;
use super::super::sliding::SlidingEnd;
use super::EquilibriumPath;
use super::critical_state::{CriticalState, LoadingPhase};
use crate::model::{CRITICAL_FRICTION, ContactConvention, Stack};

/// Largest effect of the memory of springs on the frictions between which a stack is released, relative to these.
const NEARBY: f64 = 0.1;
/// Floor friction above which the bottom cylinders of a very light stack touch: G₀ = ε/2 and T = μ_c in G₀ (T − μ) = ε
/// μ. With this friction they touch even in the lightest part of the gravity ramp that is followed.
const LEAST_TO_TOUCH: f64 = CRITICAL_FRICTION / 3.0 * (1.0 + 1e-6);

/// T − μ_c where the centre of cylinder 1 has sunk to the level of the other two, T = 1.
const WIDEST: f64 = 1.0 - CRITICAL_FRICTION;

/// How the loading ends for a stack that slips while c > 0, Eq. (R6).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Release {
    /// Contact 2–3 opens before gravity is complete: the stack falls.
    Falls,
    /// The contact opens under the wall, with the largest force.
    Ends(CriticalState),
    /// The wall reaches the bottom cylinders before the contact opens.
    WallFirst,
    /// Unknown: cylinders slip on each other while their springs remember how they have turned.
    Unknown,
}

impl Release {
    /// How the loading ends for `stack`, which slips on its `path`: given are the event that slips, and its parameter.
    pub(super) fn of(stack: &Stack, path: &EquilibriumPath, (event, slip): (Event, f64)) -> Self {
        let Some((followed, convention)) = path.remembering() else {
            return Self::without_memory(stack, path.settled_height());
        };
        if event != Event::FloorSlip {
            return Self::Unknown;
        }
        let Some(branch) = RememberedBranch::new(followed, stack, convention, slip) else {
            return Self::Falls;
        };
        match branch.end() {
            SlidingEnd::Peak(peak) => {
                let settled_height = branch.settled.wall_height();
                Self::Ends(path.state_at(event, &peak, LoadingPhase::Wall, settled_height))
            }
            SlidingEnd::Other(Event::WallContact) => Self::WallFirst,
            SlidingEnd::Other(_) => Self::Unknown,
        }
    }

    /// The end with springs that turn; `settled_height` is the height of the top wall when it first touches.
    fn without_memory(stack: &Stack, settled_height: f64) -> Self {
        let (beyond, event) = slip_without_contact(stack);
        let epsilon = stack.epsilon();
        let overlap = touching_overlap(beyond);
        if 2.0 * overlap < epsilon {
            return Self::Falls;
        }
        let clearance = clearance(beyond, epsilon);
        if clearance < 0.0 {
            return Self::WallFirst;
        }
        let wall_height = 2.0 - (overlap + epsilon) + clearance;
        Self::Ends(CriticalState {
            event,
            stage: LoadingPhase::Wall,
            force: 2.0 * overlap / epsilon - 1.0,
            tangent: CRITICAL_FRICTION + beyond,
            floor_overlap: overlap + epsilon,
            bottom_force: 0.0,
            wall_travel: settled_height - wall_height,
        })
    }
}

/// Returns the two floor frictions between which a stack like this one has a yield force although it slips while
/// c > 0. With less, it falls under its own weight; with more, the cylinders slip or the wall reaches the bottom ones.
/// With springs that turn, neither depends on κ. `None` for spheres, if such a stack always falls, and, with springs
/// that do not turn, if contact 2–3 does not close on its `path`.
pub fn released_frictions(path: &EquilibriumPath, stack: &Stack) -> Option<(f64, f64)> {
    stack.refuse_spheres().ok()?;
    let (low, high) = frictions_without_memory(stack)?;
    let Some((followed, convention)) = path.remembering() else {
        return Some((low, high));
    };
    if !path.closes() {
        return None;
    }
    let path = followed;
    let low = [LEAST_TO_TOUCH, low * (1.0 + NEARBY)];
    let low = between(low, stack, |stack| {
        let slip = locate(path, Event::FloorSlip, stack)?;
        remembered_overlap_at_rest(path, stack, convention, slip)
    })?;
    let high = beside(high, stack, |stack| {
        Some(remembered_branch(path, stack, convention)?.margin())
    })?;
    Some((low, high))
}

/// The sliding branch of `stack` from the slip of its floor on the `path`.
fn remembered_branch<'a>(
    path: &'a FollowedPath,
    stack: &'a Stack,
    convention: &ContactConvention,
) -> Option<RememberedBranch<'a>> {
    let slip = locate(path, Event::FloorSlip, stack)?;
    RememberedBranch::new(path, stack, convention, slip)
}

/// Returns the floor friction near `guess` at which `margin` vanishes for stacks like `stack`.
fn beside(guess: f64, stack: &Stack, margin: impl Fn(&Stack) -> Option<f64>) -> Option<f64> {
    let range = [1.0 - NEARBY, 1.0 + NEARBY].map(|factor| factor * guess);
    between(range, stack, margin)
}

/// Returns the floor friction within a range at which `margin` vanishes for stacks like `stack`.
fn between(
    [low, high]: [f64; 2],
    stack: &Stack,
    margin: impl Fn(&Stack) -> Option<f64>,
) -> Option<f64> {
    let at = |floor_friction: f64| {
        let stack = Stack {
            floor_friction,
            ..*stack
        };
        margin(&stack).unwrap_or(f64::NAN)
    };
    bracketed_root(at, low, high)
}

/// The frictions of [`released_frictions`] for springs that turn.
fn frictions_without_memory(stack: &Stack) -> Option<(f64, f64)> {
    let epsilon = stack.epsilon();
    let needed = |beyond: f64| {
        let overlap = touching_overlap(beyond);
        (CRITICAL_FRICTION + beyond) * overlap / (overlap + epsilon)
    };
    let settled = bracketed_root(|at| 2.0 * touching_overlap(at) - epsilon, 0.0, WIDEST)?;
    let wall = wall_contact(epsilon)?;
    let end = wall.min(stack.cylinder_friction - CRITICAL_FRICTION);
    (end > settled).then(|| (needed(settled), needed(end)))
}

/// The cylinder friction above which the wall, not cylinder slip, ends a stack that slips while c > 0 on its `path`.
pub(crate) fn released_wall_friction(path: &EquilibriumPath, stack: &Stack) -> Option<f64> {
    let Some((followed, convention)) = path.remembering() else {
        return wall_contact(stack.epsilon()).map(|beyond| CRITICAL_FRICTION + beyond);
    };
    if !path.closes() {
        return None;
    }
    let path = followed;
    let rough = Stack {
        cylinder_friction: f64::MAX,
        ..*stack
    };
    let (_, guess) = frictions_without_memory(&rough)?;
    let floor_friction = beside(guess, &rough, |stack| {
        let peak = remembered_branch(path, stack, convention)?.peak();
        Some(peak.margin(Event::WallContact, stack))
    })?;
    let arriving = Stack {
        floor_friction,
        ..rough
    };
    Some(remembered_branch(path, &arriving, convention)?.needed_friction())
}

/// T − μ_c where the wall reaches the bottom cylinders just as these separate.
fn wall_contact(epsilon: f64) -> Option<f64> {
    bracketed_root(|at| clearance(at, epsilon), 0.0, WIDEST)
}

/// G₀(T) = 2 − (1 + T²)/(2T), the overlap of the contact 1–2 at which the bottom cylinders just touch, y = 0,
/// at T = μ_c + `beyond`; written free of cancellation.
fn touching_overlap(beyond: f64) -> f64 {
    let tangent = CRITICAL_FRICTION + beyond;
    beyond * (CRITICAL_FRICTION.recip() - tangent) / (2.0 * tangent)
}

/// Height of the top wall above the bottom cylinders where these just touch, ρ cos ψ − ε F.
fn clearance(beyond: f64, epsilon: f64) -> f64 {
    let tangent = CRITICAL_FRICTION + beyond;
    let square = tangent * tangent;
    let overlap = touching_overlap(beyond);
    (2.0 - overlap) * (1.0 - square) / (1.0 + square) - (2.0 * overlap - epsilon)
}

/// Returns where on G₀(T) a friction is first exhausted with c = 0, as T − μ_c, and the event: G₀ (T − μ) = ε μ for
/// the floor, T = μ_d for the cylinders.
fn slip_without_contact(stack: &Stack) -> (f64, Event) {
    let mu = stack.floor_friction;
    let excess = |beyond: f64| {
        let tangent = CRITICAL_FRICTION + beyond;
        touching_overlap(beyond) * (tangent - mu) - stack.epsilon() * mu
    };
    let above_critical = (mu - CRITICAL_FRICTION).clamp(0.0, WIDEST);
    let floor = bracketed_root(excess, above_critical, WIDEST).unwrap_or(WIDEST);
    let pair = (stack.cylinder_friction - CRITICAL_FRICTION).max(0.0);
    if floor <= pair {
        (floor, Event::FloorSlip)
    } else {
        (pair, Event::CylinderSlip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::HistoryUpdate;

    #[test]
    fn touching_overlap_is_the_geometry_it_abbreviates() {
        let tangent = CRITICAL_FRICTION + 0.1;
        let direct = 2.0 - (1.0 + tangent * tangent) / (2.0 * tangent);
        assert!((touching_overlap(0.1) - direct).abs() < 1e-15);
        let sine = 2.0 * tangent / (1.0 + tangent * tangent);
        assert!(((2.0 - direct) * sine - 1.0).abs() < 1e-15, "y = 0");
    }

    #[test]
    fn the_wall_comes_down_as_far_as_geometry_and_balance_have_it() {
        let stack = Stack::paper(0.3, 1e2);
        let settled_height = 3.7;
        let Release::Ends(end) = Release::without_memory(&stack, settled_height) else {
            panic!("it ends under the wall");
        };
        let square = end.tangent * end.tangent;
        // y = 0: the distance between the centres of the cylinders is 1/sin ψ.
        let above = (1.0 - square) / (2.0 * end.tangent);
        let squeezed = stack.epsilon() * end.force;
        let height = (1.0 - end.floor_overlap) + above + (1.0 - squeezed);
        assert!((settled_height - end.wall_travel - height).abs() < 1e-14);
        let load = stack.epsilon() * (end.force + 3.0);
        assert!((2.0 * end.floor_overlap - load).abs() < 1e-15);
    }

    #[test]
    fn from_the_wall_friction_on_the_cylinders_no_longer_limit_the_floor() {
        for rule in [HistoryUpdate::Rotated, HistoryUpdate::Fixed] {
            let stack = |floor_friction, cylinder_friction, stiffness_ratio| Stack {
                cylinder_friction,
                stiffness_ratio,
                ..Stack::paper(floor_friction, 1e2)
            };
            let path = EquilibriumPath::new(&stack(0.3, 0.7, 0.9), rule);
            let wall = released_wall_friction(&path, &stack(0.3, 0.7, 0.9)).unwrap();
            // It depends on neither friction of the stack.
            let other = released_wall_friction(&path, &stack(0.1, 0.3, 0.9)).unwrap();
            assert!((wall - other).abs() < 1e-9, "{rule:?} {wall} {other}");
            let highest = |factor: f64| {
                let own = stack(0.3, factor * wall, 0.9);
                released_frictions(&path, &own).unwrap().1
            };
            let [less, equal, more] = [0.99, 1.0, 1.01].map(highest);
            assert!((equal - more).abs() < 1e-6, "{rule:?} {equal} {more}");
            assert!(less < equal - 1e-3, "{rule:?} {less} {equal}");
        }
        let open = Stack::paper(0.3, 1e2);
        let path = EquilibriumPath::new(&open, HistoryUpdate::Fixed);
        assert_eq!(released_wall_friction(&path, &open), None);
    }
}
