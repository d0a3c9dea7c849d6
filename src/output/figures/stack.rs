//! The stack with its contact forces.

use super::Figure;
use crate::output::stack_figure::{representative_panels, stack_svg};
use crate::paper::reproduction::Snapshots;

/// The stack at rest, at yield and in collapse.
pub(super) fn stack(snapshots: &Snapshots) -> Figure {
    let panels = representative_panels(&snapshots.frames);
    let stack = &snapshots.case.stack;
    let caption = format!(
        "Not in the paper: the stack at rest, at yield and in collapse, drawn to scale, with the contact forces \
         on each cylinder as arrows (dark: normal, light: tangential; a and b between cylinders 1 and 2, d and \
         e at the floor, f at the wall), at μ = {}, kₙ r/(m g) = {}, κ = {}: one native run. Ticks: orientation \
         now and (light) at the start.",
        stack.floor_friction, stack.stiffness, stack.stiffness_ratio
    );
    Figure::new("stack", caption, stack_svg(&panels, stack.epsilon(), &[]))
}
