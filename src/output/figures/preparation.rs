//! What the preparation does to the force between the bottom cylinders and to the yield force.

use super::Figure;
use super::axis::Axis;
use super::panel::{Anchor, Panel, Point, Sample, draw};
use super::style::{EXACT, GUIDE, Mark, THIN};
use crate::code::Code;
use crate::study::preparation::{PreparationRow, PreparationStudy};

/// c(A) and F(A) of every code that can prepare the stack so, at the first stack of the study.
pub(super) fn preparation(study: &PreparationStudy) -> Figure {
    let epsilon = study.stack.epsilon();
    let axis = || Axis::around("push A/(ε r)", (-0.15, 5.3));
    let mut contact = Panel::new(axis(), Axis::around("c/(m g)", (-0.02, 0.4)));
    let mut force = Panel::new(
        axis(),
        Axis::around("yield force F = f/(m g)", (4.05, 4.55)),
    );
    if let Some(found) = study.critical_push {
        let place = found.push / epsilon;
        for panel in [&mut contact, &mut force] {
            panel.upright(GUIDE, place);
        }
        contact.words("A*", (place + 0.08, 0.37), Anchor::Start);
    }
    if let Some(exact) = study.exact_force {
        force.level(EXACT, exact);
        force.words_on("gravity ramp, exact", exact);
    }
    for code in Code::all() {
        let rows = || study.rows_of(code, code).filter(|row| row.push.is_some());
        if rows().next().is_none() {
            continue;
        }
        draw_rows(
            &mut contact,
            code,
            rows().filter_map(|row| point(row, epsilon, row.contact_force)),
        );
        draw_rows(
            &mut force,
            code,
            rows().filter_map(|row| point(row, epsilon, row.yield_force)),
        );
        contact.key(Sample::Mark(Mark::of(code)), &code.label());
    }
    contact.key_at(0.6, 0.5);
    let caption = format!(
        "The paper’s preparation between side walls (supplement, I.B), pushed in by A, at μ = {}, kₙ r/(m g) = {}, \
         κ = {}. (a) Normal force c between the bottom cylinders when the compression begins. (b) Yield force, by \
         slip onset extrapolated to vanishing wall speed, each code with its own torque arms; horizontal: exact \
         limit after the gravity ramp with which all other runs begin. c vanishes up to A*, and F moves all the \
         same. Lines join the native runs.",
        study.stack.floor_friction, study.stack.stiffness, study.stack.stiffness_ratio
    );
    Figure::new(
        "preparation",
        caption,
        draw(&[contact, force], 2, super::HALF_PAGE),
    )
}

fn point(row: &PreparationRow, epsilon: f64, value: Option<f64>) -> Option<Point> {
    Some((row.push? / epsilon, value?))
}

/// Marks, and a line for the native DEM.
fn draw_rows(panel: &mut Panel, code: Code, points: impl Iterator<Item = Point>) {
    let points: Vec<Point> = points.collect();
    if code == Code::NATIVE {
        panel.line(THIN, points.iter().map(|&(x, y)| (x, Some(y))));
    }
    panel.marks(Mark::of(code), points);
}
