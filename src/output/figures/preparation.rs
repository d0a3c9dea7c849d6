//! The effect of the preparation on the force between the bottom cylinders and on the yield force.

use super::Figure;
use super::axis::Axis;
use super::codes;
use super::panel::{Anchor, Panel};
use super::style::{EXACT, GUIDE, THIN};
use crate::code::Code;
use crate::model::Power;
use crate::study::preparation::{PreparationRow, PreparationStudy};

/// c(A) and F(A) of every code with a deck for side walls, at the first stack of the study.
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
    for code in Code::of_power(Power::Linear) {
        let rows = || study.rows_of(code, code).filter(|row| row.push.is_some());
        if rows().next().is_none() {
            continue;
        }
        let points = |value: fn(&PreparationRow) -> Option<f64>| -> Vec<_> {
            let known = rows().filter(|row| value(row).is_some());
            known
                .filter_map(|row| Some((row.push? / epsilon, value(row))))
                .collect()
        };
        codes::runs(&mut contact, THIN, code, &points(|row| row.contact_force));
        codes::runs(&mut force, THIN, code, &points(|row| row.yield_force));
        codes::name(&mut contact, code);
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
    Figure::of_halves("preparation", caption, &[contact, force])
}
