//! The published numbers, reproduced.

use super::super::document::{Block, Section};
use crate::paper::published::Published;
use crate::published::PROTOCOL;
use crate::{
    contradictions, published_files, published_forces, published_series, published_summary_in_tex,
};

pub(super) fn section(published: &Published) -> Section {
    let blocks = vec![
        Block::paragraph(format!(
            "The data of the authors’ public repository against native runs. {PROTOCOL} {}.",
            published_summary_in_tex(published)
        )),
        Block::long_table(
            true,
            "published",
            "Every published yield force: exact limit, what gives it, and what remains. $F = f/(mg)$; distances relative to $F + 3$.",
            &published_forces(&published.forces),
        ),
        Block::table(
            "published_series",
            "Published series of the wall force.",
            &published_series(&published.series),
        ),
        Block::table(
            "contradictions",
            "Numbers that data files, their heads, the program and the paper give for the same quantity, and that differ by more than \
             their digits allow. Differences are relative; of forces, to $F + 3$.",
            &contradictions(&published.contradictions),
        ),
        Block::long_table(
            true,
            "published_files",
            "The data files that were read.",
            &published_files(&published.files),
        ),
    ];
    Section::new("published", "The published numbers, reproduced", blocks)
}
