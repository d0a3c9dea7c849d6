//! The figures.

use super::super::document::{Block, Picture, Section};
use super::Origin;
use crate::report::figures::figures;
use crate::reproduction::Reproduction;

/// The section.
pub fn section(reproduction: &Reproduction, origin: &Origin) -> Section {
    let pictures = figures(reproduction).into_iter().map(|figure| Picture {
        name: figure.name.to_owned(),
        caption: figure.caption,
        command: origin.command.clone(),
        svg: figure.svg,
    });
    Section {
        id: "figures",
        title: "Figures, recomputed from runs",
        blocks: pictures.map(Block::Figure).collect(),
    }
}
