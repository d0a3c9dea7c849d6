//! The moments of a run that are drawn.

use crate::series::{Frame, Frames};

/// A stack is in collapse when its force is below this part of the largest.
const FALLEN: f64 = 0.75;

/// One moment of a stack.
#[derive(Debug, Clone, PartialEq)]
pub struct StackPanel<'a> {
    /// The name of the moment, such as "at rest".
    pub title: &'static str,
    /// The stack.
    pub frame: &'a Frame,
    /// Whether the forces between the cylinders are among its contacts.
    pub pair_forces_known: bool,
}

/// Returns the stack of a run at rest, at its largest force, and in collapse at about half that force, or else at the
/// end of the run.
pub fn representative_panels(frames: &Frames) -> Vec<StackPanel<'_>> {
    let all = &frames.frames;
    let force = |index: usize| all[index].wall_force;
    let highest = (0..all.len()).max_by(|&i, &j| force(i).total_cmp(&force(j)));
    let (Some(highest), Some(last)) = (highest, all.len().checked_sub(1)) else {
        return Vec::new();
    };
    let bearing = (highest + 1..all.len()).take_while(|&index| force(index) > 0.0);
    let from_half = |index: usize| (force(index) - 0.5 * force(highest)).abs();
    let half = bearing.min_by(|&i, &j| from_half(i).total_cmp(&from_half(j)));
    let fallen = |index: &usize| force(*index) < FALLEN * force(highest);
    let collapsing = half.filter(fallen).or((highest..=last).find(fallen));
    let panel = |title: &'static str, index: usize| StackPanel {
        title,
        frame: &all[index],
        pair_forces_known: frames.pair_forces_known,
    };
    let mut panels = vec![panel("at rest", 0)];
    if highest < last {
        panels.push(panel("at yield", highest));
    }
    panels.push(match collapsing {
        Some(index) => panel("in collapse", index),
        None => panel("at the end of the run", last),
    });
    panels
}
