//! The effect of other contact laws on the paper's stack.

use super::super::document::{Block, PageTable, Section};
use super::tolerances::rows;
use crate::figures::laws_figure;
use crate::paper::reproduction::Reproduction;
use crate::{
    FORCES_EXPLAINED, LAWS_EXPLAINED, LAWS_TITLE, crosscheck, law_conventions, law_forces,
    laws_lead,
};

pub(super) fn section(reproduction: &Reproduction) -> Section {
    let laws = &reproduction.laws;
    let judgements = &laws.yield_curves;
    let blocks = vec![
        Block::paragraph(laws_lead(judgements)),
        Block::table("laws", LAWS_EXPLAINED, &law_conventions(judgements)),
        Block::Table(PageTable::new(
            "law_forces",
            FORCES_EXPLAINED,
            &crosscheck(judgements),
            law_forces(judgements),
        )),
        Block::figure(laws_figure(judgements)),
        rows(
            "law_scaling",
            "Every row at $\\mu_c$ with Hertz contacts, [](#figure-scaling). Yield force, ± and exact limit are those of the largest \
             force; error, tolerance and verdict those of the onset of slip, which comes before it.",
            &laws.scaling,
        ),
    ];
    Section::new("laws", LAWS_TITLE, blocks)
}
