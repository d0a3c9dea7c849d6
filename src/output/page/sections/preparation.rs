//! Which preparation was used, and what the choice moves.

use super::super::document::{Block, DataTable, Section};
use crate::output::Table;
use crate::output::number::{friction, optional, significant};
use crate::paper::reproduction::Reproduction;
use crate::study::preparation::PreparationStudy;

/// The section.
pub fn section(reproduction: &Reproduction) -> Section {
    let mut blocks = vec![Block::paragraph(
        "All runs of this report begin with a gravity ramp: three just-touching cylinders, gravity raised \
         smoothly, which ends with c = 0 and is the state in which the exact limit starts. The paper pushes \
         the bottom cylinders together by side walls (A), lowers the top one and withdraws the walls, and \
         takes an A for which c = 0. c vanishes for every A up to A*, and the yield force depends on A \
         within that range: c = 0 alone does not pin it down.",
    )];
    blocks.push(Block::Table(critical(&reproduction.preparation)));
    blocks.push(Block::Table(rows(&reproduction.preparation)));
    Section {
        id: "preparation",
        title: "Preparation of the stack",
        blocks,
    }
}

/// A* and what it moves, stack by stack.
fn critical(studies: &[PreparationStudy]) -> DataTable {
    let mut table = Table::new(&[
        "stiffness>",
        "μ>",
        "A*>",
        "to leading order>",
        "F after gravity ramp, exact>",
        "F(A*) − F(0), of F + 3>",
    ]);
    for study in studies {
        let found = study.critical_push;
        let shift = found.and_then(|found| study.shift(found.push));
        table.push(vec![
            study.stack.stiffness.to_string(),
            friction(study.stack.floor_friction),
            optional(found, |found| significant(found.push, 5)),
            significant(study.predicted_critical_push, 5),
            optional(study.exact_force, |force| significant(force, 7)),
            optional(shift, |shift| format!("{:+.2} %", 100.0 * shift)),
        ]);
    }
    DataTable {
        name: "critical_push",
        caption: "A*, the largest push (in r) that ends with c = 0, by bisection with the native DEM, and \
                  what it moves."
            .to_owned(),
        csv: table.csv(),
        table,
        long: false,
    }
}

/// c(A) and F(A) of every code.
fn rows(studies: &[PreparationStudy]) -> DataTable {
    let mut table = Table::new(&[
        "stiffness>",
        "μ>",
        "code",
        "convention of",
        "A>",
        "c>",
        "F>",
        "±>",
        "theory>",
    ]);
    let mut writer = csv::Writer::from_writer(Vec::new());
    for study in studies {
        for row in &study.rows {
            table.push(vec![
                study.stack.stiffness.to_string(),
                friction(study.stack.floor_friction),
                row.code.to_string(),
                row.convention_of.to_string(),
                optional(row.push, |push| significant(push, 5)),
                optional(row.contact_force, |force| format!("{force:.5}")),
                optional(row.yield_force, |force| significant(force, 7)),
                optional(row.uncertainty, |value| format!("{value:.0e}")),
                optional(row.limit_force, |force| significant(force, 7)),
            ]);
            writer
                .serialize((study.stack, row))
                .expect("plain rows are written to memory");
        }
    }
    DataTable {
        name: "preparation",
        caption: "c between the bottom cylinders when the compression begins, and yield force F, both in m g; \
                  A in r, absent for the gravity ramp. Theory is the exact limit after a gravity ramp, and \
                  what becomes of it with a push, to leading order in ε."
            .to_owned(),
        csv: writer.into_inner().expect("memory is flushed"),
        table,
        long: true,
    }
}
