//! The preparation of the stack, and its effect on the yield force.

use super::super::document::{Block, Section};
use crate::DataTable;
use crate::model::Stack;
use crate::number::{digits, one_digit, optional, percent};
use crate::paper::reproduction::Reproduction;
use crate::study::preparation::{PreparationRow, PreparationStudy};
use crate::table::Columns;

pub(super) fn section(reproduction: &Reproduction) -> Section {
    let blocks = vec![
        Block::paragraph(
            "All other runs of this report begin with a gravity ramp: three just-touching cylinders, gravity raised \
             smoothly, which ends with $c = 0$ and is the state in which the exact limit starts. The paper pushes \
             the bottom cylinders together by side walls ($A$), lowers the top one and withdraws the walls, and \
             takes an $A$ for which $c = 0$. But $c$ vanishes for every $A$ up to $A^*$, and the yield force depends on $A$ \
             within that range: $c = 0$ alone does not pin it down.",
        ),
        Block::table(
            "critical_push",
            "The largest push $A^*$ (in $r$) that ends with $c = 0$, by bisection with the native DEM, and what it moves.",
            &critical(&reproduction.preparation),
        ),
        Block::long_table(
            true,
            "preparation",
            "Force $c$ between the bottom cylinders when the compression begins, and yield force $F$, both in $mg$; $A$ in $r$, \
             absent for the gravity ramp. Theory is the exact limit after a gravity ramp, and what becomes of it \
             with a push, to leading order in $\\epsilon$; it does not hold where the floor slides while the walls are withdrawn, as \
             after the largest pushes.",
            &preparations(&reproduction.preparation),
        ),
    ];
    Section::new("preparation", "Preparation of the stack", blocks)
}

/// Returns the table of A* of every stack, and its effect on the yield force.
pub(crate) fn critical(studies: &[PreparationStudy]) -> DataTable<'_> {
    Columns::<&PreparationStudy>::new(
        "critical_push",
        "A row is A*, the largest push of the side walls that ends with c = 0, of one stack, and \
         what it moves.",
        "`tristack report` (tables/critical_push.csv)",
    )
    .stack(|study| study.stack)
    .number("critical_push", "r", |study| {
        study.critical_push.map(|found| found.push)
    })
    .means("A*, by bisection with the native DEM")
    .shown_as("$A^*$", digits::<5>)
    .number("width", "r", |study| {
        study.critical_push.map(|found| found.width)
    })
    .means("width of the interval above A* in which c appears")
    .number("predicted_critical_push", "r", |study| {
        study.predicted_critical_push
    })
    .means("A* to leading order in ε")
    .shown_as("to leading order", digits::<5>)
    .number("exact_force", "m g", |study| study.exact_force)
    .means("exact limit F after a gravity ramp")
    .shown_as("$F$ after gravity ramp, exact", digits::<7>)
    .number("shift", "1", |study| {
        study
            .critical_push
            .and_then(|found| study.shift(found.push))
    })
    .means("F(A*) − F(0), relative to F + 3")
    .shown_as("$F(A^*) - F(0)$, of $F + 3$", percent)
    .rows(studies)
}

/// Returns the table of c(A) and F(A) of every code.
pub(crate) fn preparations(studies: &[PreparationStudy]) -> DataTable<'_> {
    let rows = studies.iter().flat_map(|study| {
        let rows = study.rows.iter();
        rows.map(|row| (study.stack, row))
    });
    Columns::<(Stack, &PreparationRow)>::new(
        "preparation",
        "A row is one preparation of one stack by one code, and the yield force that follows.",
        "`tristack report` (tables/preparation.csv)",
    )
    .stack(|(stack, _)| *stack)
    .code(|(_, row)| &row.code)
    .text("convention_of", |(_, row)| row.convention_of.as_str())
    .means("the code whose contact convention it ran with")
    .shown("convention of")
    .number("push", "r", |(_, row)| row.push)
    .means("A; absent for the gravity ramp")
    .shown_as("$A$", digits::<5>)
    .number("limit_force", "m g", |(_, row)| row.limit_force)
    .means(
        "exact limit after a gravity ramp under this convention; with a push, what becomes \
             of it to leading order in ε",
    )
    .number("contact_force", "m g", |(_, row)| row.contact_force)
    .means("c between the bottom cylinders when the compression begins")
    .shown_as("$c$", |force| format!("{force:.5}"))
    .number("contact_uncertainty", "m g", |(_, row)| {
        row.contact_uncertainty
    })
    .means("its uncertainty")
    .number("yield_force", "m g", |(_, row)| row.yield_force)
    .means("F at vanishing wall speed")
    .shown_as("$F$", digits::<7>)
    .number("uncertainty", "m g", |(_, row)| row.uncertainty)
    .means("its uncertainty")
    .shown_as("±", one_digit)
    .word("estimator", |(_, row)| row.estimator)
    .means("what it was read off: `slip-onset` or `peak`")
    .text("note", |(_, row)| row.note.clone())
    .means("why something is missing")
    .right("theory", |(_, row)| optional(row.limit_force, digits::<7>))
    .rows(rows)
}
