//! The figures.

use super::super::document::{Block, Section};
use crate::output::figures::figures;
use crate::paper::reproduction::Reproduction;

/// The section.
pub fn section(reproduction: &Reproduction) -> Section {
    Section {
        id: "figures",
        title: "Figures, recomputed from runs",
        blocks: figures(reproduction)
            .into_iter()
            .map(Block::Figure)
            .collect(),
    }
}
