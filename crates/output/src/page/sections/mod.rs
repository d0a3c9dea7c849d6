//! The sections of the report.

mod claims;
mod conventions;
mod environment;
mod laws;
mod preparation;
mod published;
mod spheres;
mod summary;
mod tolerances;
mod untested;

pub(super) use claims::{claims_table, in_words};

use super::document::{Block, Document, Section};
use crate::code::Code;
use crate::figures::figures;
use crate::paper::claims::ClaimJudgement;
use crate::paper::reproduction::Reproduction;
use crate::{DataTable, law_conventions};

/// Returns the tables that only the report has, without rows.
pub(crate) fn declared_tables() -> Vec<DataTable<'static>> {
    vec![
        summary::theories(&[]),
        summary::points(&[]),
        claims::errata_table(&[]),
        claims_table(&[]),
        tolerances::agreement(&[]),
        tolerances::exponents(&[]),
        law_conventions(&[]),
        preparation::critical(&[]),
        preparation::preparations(&[]),
        spheres::limits(&[]),
        environment::programs(&[], &[]),
        environment::decks(std::iter::empty()),
    ]
}

/// The origin of a report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    /// The command that makes it.
    pub command: String,
    /// The codes for which recorded runs stood in.
    pub recorded: Vec<Code>,
    /// Whether all of Fig. 2(a) was run at the paper's literal settings.
    pub literal: bool,
    /// Content of the lock file with the dependencies of the program.
    pub lock_file: &'static [u8],
}

pub(super) fn document(
    reproduction: &Reproduction,
    judged: &[ClaimJudgement],
    origin: &Origin,
) -> Document {
    let figures = figures(reproduction).into_iter().map(Block::figure);
    let figures = figures.collect();
    let mut sections = vec![
        summary::section(reproduction, judged),
        claims::errata(judged),
        Section::new("figures", "Figures, recomputed from runs", figures),
    ];
    sections.extend(reproduction.published.as_ref().map(published::section));
    sections.extend([
        claims::register(judged),
        tolerances::section(reproduction),
        preparation::section(reproduction),
        conventions::section(reproduction),
        laws::section(reproduction),
        spheres::section(reproduction),
        environment::section(reproduction, origin),
        untested::section(reproduction, judged, origin),
    ]);
    Document {
        title: "Reproducibility report: “Anomalous Enhancement of Yield Strength due to Static Friction”"
            .to_owned(),
        lead: vec![
            "On R. Suzuki, T. Matsushima, T. Yamaguchi, M. Tani and S. Sasa, arXiv:2511.06807, and its \
             supplement: what holds, how well, and how to see it. Forces in $mg$, lengths in $r$, speeds in \
             $r\\sqrt{k_n/m}$, times in $\\sqrt{m/k_n}$; stiffness is $1/\\epsilon = k_n r/(mg)$, and $F = f/(mg)$."
                .to_owned(),
        ],
        sections,
    }
    .numbered()
}
