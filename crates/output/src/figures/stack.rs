//! The stack drawn to scale, with its contact forces as arrows.

mod moments;
mod parts;
mod plane;
mod space;

pub use moments::{StackPanel, representative_panels};

use super::Figure;
use super::drawing::Drawing;
use crate::friction;
use crate::model::{Case, PAPER_BODIES, Stack, exact};
use crate::paper::reproduction::Snapshots;
use crate::series::Frames;

/// Draws one run as SVG: its [`representative_panels`] with a caption on code and stack.
pub fn run_svg(code: &str, case: &Case, frames: &Frames) -> String {
    drawn(code, case, frames).svg()
}

/// Draws the same picture as PDF.
pub fn run_pdf(code: &str, case: &Case, frames: &Frames) -> Vec<u8> {
    drawn(code, case, frames).pdf()
}

fn drawn(code: &str, case: &Case, frames: &Frames) -> Drawing {
    let panels = representative_panels(frames);
    match case.stack.bodies {
        PAPER_BODIES => cylinders(code, case, frames, &panels),
        _ => spheres(code, case, &panels),
    }
}

fn cylinders(code: &str, case: &Case, frames: &Frames, panels: &[StackPanel]) -> Drawing {
    let stack = &case.stack;
    let mut caption = vec![format!(
        "{code}: {}. Circles: undeformed cylinders, so that overlaps show compression; ticks: orientation now and (light) at the start.",
        parameters(stack)
    )];
    if !frames.pair_forces_known {
        caption.push(format!(
            "{code} reports the forces of floor and wall alone; those between the cylinders are not drawn."
        ));
    }
    plane::drawn(panels, panels.len(), stack.epsilon(), &caption)
}

fn spheres(code: &str, case: &Case, panels: &[StackPanel]) -> Drawing {
    let stack = &case.stack;
    let caption = [
        format!(
            "{code}: {} spheres on the floor, {}. Arcs: the equator of each sphere at the start (light), and where it has turned to.",
            stack.bodies,
            parameters(stack)
        ),
        format!(
            "{} The forces between the spheres are not drawn.",
            space::projection()
        ),
    ];
    space::drawn(panels, stack, &caption)
}

fn parameters(stack: &Stack) -> String {
    format!(
        "_μ_ = {}, _k_ₙ _r_/(_m_ _g_) = {}, _κ_ = {}, _μ__{{d}} = {}",
        friction(stack.floor_friction),
        stack.stiffness,
        exact(stack.stiffness_ratio),
        exact(stack.cylinder_friction),
    )
}

/// Draws the stack of the report at rest, at yield and in collapse.
pub(super) fn stack(snapshots: &Snapshots) -> Figure {
    let panels = representative_panels(&snapshots.frames);
    let stack = &snapshots.case.stack;
    let caption = format!(
        "Not in the paper: the stack at rest, at yield and in collapse, drawn to scale, with the contact forces \
         on each cylinder as arrows (dark: normal, light: tangential; $a$ and $b$ between cylinders 1 and 2, $d$ and \
         $e$ at the floor, $f$ at the wall), at $\\mu = {}$, $k_n r/(mg) = {}$, $\\kappa = {}$: one native run. Ticks: orientation \
         now and (light) at the start.",
        stack.floor_friction, stack.stiffness, stack.stiffness_ratio
    );
    let layouts =
        [panels.len(), 1].map(|columns| plane::drawn(&panels, columns, stack.epsilon(), &[]));
    Figure::new("stack", caption, layouts)
}
