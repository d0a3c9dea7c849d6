//! The stacks whose largest force is examined.

use super::THREE_DIGITS;
use crate::model::{HistoryUpdate, PAPER_STIFFNESS_RATIO, Stack};
use crate::theory::{EquilibriumPath, released_frictions};

/// Returns stacks that cover every consequence of the first event. Springs change by this rule as their contacts
/// turn.
pub fn examined_stacks(history_update: HistoryUpdate) -> Vec<Stack> {
    let mut stacks = vec![
        stack(0.3, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        // Saturated: the force does not depend on floor friction.
        stack(0.45, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.9, 0.4, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.45, 0.3, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.5, 1e3, PAPER_STIFFNESS_RATIO),
        // Contact 2–3 closed: the force does not depend on kappa.
        stack(0.12, 0.7, 1e2, 0.3),
        stack(0.2, 0.7, 1e2, 0.3),
        stack(0.3, 0.7, 1e2, 0.3),
        stack(0.3, 0.7, 1e2, 0.6),
        stack(0.3, 0.7, 1e2, 1.0),
        stack(0.2, 0.7, 1e3, 0.6),
        // Contact 2–3 closed, and the cylinders slip.
        stack(0.6, 0.32, 1e2, 0.3),
        stack(0.6, 0.32, 1e2, 0.6),
        // Beyond wall contact.
        stack(0.6, 0.7, 1e1, PAPER_STIFFNESS_RATIO),
        stack(0.6, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        stack(0.9, 0.7, 1e2, PAPER_STIFFNESS_RATIO),
        // Past the maximum of the load.
        stack(0.78, 1.0, 1e2, 10.0),
    ];
    for stiffness_ratio in [0.3, 0.6, 0.9] {
        stacks.extend(beside_released_frictions(stiffness_ratio, history_update));
    }
    stacks
}

fn stack(
    floor_friction: f64,
    cylinder_friction: f64,
    stiffness: f64,
    stiffness_ratio: f64,
) -> Stack {
    Stack {
        cylinder_friction,
        stiffness_ratio,
        ..Stack::paper(floor_friction, stiffness)
    }
}

/// Returns both neighbours of each of the two frictions between which the floor slips while c > 0.
fn beside_released_frictions(stiffness_ratio: f64, history_update: HistoryUpdate) -> Vec<Stack> {
    let base = stack(0.3, 0.7, 1e2, stiffness_ratio);
    let path = EquilibriumPath::new(&base, history_update);
    let frictions =
        released_frictions(&path, &base).map_or(Vec::new(), |(low, high)| vec![low, high]);
    let neighbours = frictions
        .into_iter()
        .flat_map(|friction| [1.0 - THREE_DIGITS, 1.0 + THREE_DIGITS].map(|side| side * friction));
    neighbours
        .map(|floor_friction| Stack {
            floor_friction,
            ..base
        })
        .collect()
}
