//! The effect of the preparation on the yield force and on the force between the bottom cylinders.

use super::Figure;
use super::axis::Axis;
use super::codes;
use super::panel::{Anchor, Panel, Sample};
use super::sheet::Sheet;
use super::style::{EXACT_AFTER_RAMP, GUIDE, THIN};
use crate::code::Code;
use crate::study::preparation::{PreparationRow, PreparationStudy};

/// Width of the line of a limit, in m g.
const LINE_WIDTH: f64 = 2e-3;

/// Draws c(A) and F(A) of every code with a deck for side walls, at the stack of `study`.
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
    for (limit, codes) in limits(study) {
        force.level(EXACT_AFTER_RAMP, limit);
        let names: Vec<String> = codes.into_iter().map(|code| code.label()).collect();
        force.words_on(&names.join("; "), limit);
    }
    force.key(
        Sample::Line(EXACT_AFTER_RAMP),
        "exact limit after the gravity ramp",
    );
    force.key_at(0.04, 0.02);
    for code in Code::distinct(study.rows.iter().map(|row| &row.code)) {
        let rows = || study.rows_of(&code, &code).filter(|row| row.push.is_some());
        if rows().next().is_none() {
            continue;
        }
        let points = |value: fn(&PreparationRow) -> Option<f64>| -> Vec<_> {
            let known = rows().filter(|row| value(row).is_some());
            known
                .filter_map(|row| Some((row.push? / epsilon, value(row))))
                .collect()
        };
        codes::runs(&mut contact, THIN, &code, &points(|row| row.contact_force));
        codes::runs(&mut force, THIN, &code, &points(|row| row.yield_force));
        codes::name(&mut contact, &code);
    }
    contact.key_at(0.6, 0.5);
    let caption = format!(
        "The paper’s preparation between side walls (supplement, I.B), pushed in by $A$, at $\\mu = {}$, $k_n r/(mg) = {}$, \
         $\\kappa = {}$. (a) Normal force $c$ between the bottom cylinders when the compression begins. (b) Yield force, by \
         slip onset extrapolated to vanishing wall speed, each code with its own springs and torque arms; horizontal: the exact \
         limit of each code, by the same convention, after the gravity ramp with which all other runs begin. The force $c$ vanishes up to \
         $A^*$, and $F$ moves all the same. Lines join the native runs.",
        study.stack.floor_friction, study.stack.stiffness, study.stack.stiffness_ratio
    );
    let sheet = Sheet::of_halves([contact, force]);
    Figure::of_sheet("preparation", caption, &sheet)
}

/// Returns the exact limits after a gravity ramp under the codes' conventions, each with the codes whose lines
/// coincide.
fn limits(study: &PreparationStudy) -> Vec<(f64, Vec<Code>)> {
    let mut limits: Vec<(f64, Vec<Code>)> = Vec::new();
    for code in Code::distinct(study.rows.iter().map(|row| &row.code)) {
        let ramp = study.rows_of(&code, &code).find(|row| row.push.is_none());
        let Some(limit) = ramp.and_then(|row| row.limit_force) else {
            continue;
        };
        let is_drawn_there = |own: f64| (own - limit).abs() < LINE_WIDTH;
        match limits.iter_mut().find(|(own, _)| is_drawn_there(*own)) {
            Some((_, codes)) => codes.push(code),
            None => limits.push((limit, vec![code])),
        }
    }
    limits
}
