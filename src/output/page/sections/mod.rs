//! What the report says, section by section.

mod claims;
mod conventions;
mod environment;
mod figures;
mod preparation;
mod summary;
mod tolerances;
mod untested;

pub(crate) use claims::claims_table;
pub use claims::verdict as in_words;

use super::document::Document;
use crate::code::Code;
use crate::output::DataTable;
use crate::paper::claims::ClaimJudgement;
use crate::paper::reproduction::Reproduction;

/// Every table that stands in a report alone, without rows.
pub(crate) fn declared_tables() -> Vec<DataTable<'static>> {
    vec![
        summary::theories(&[]),
        summary::points(&[]),
        claims::errata_table(&[]),
        claims_table(&[]),
        tolerances::agreement(&[]),
        tolerances::exponents(&[]),
        preparation::critical(&[]),
        preparation::preparations(&[]),
        environment::programs(&[], &[]),
        environment::decks(),
    ]
}

/// How a report came about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Origin {
    /// The command that makes it again.
    pub command: String,
    /// The codes that are not installed and were represented by recorded runs.
    pub recorded: Vec<Code>,
    /// Whether all of Fig. 2(a) was run at the paper's literal settings.
    pub literal: bool,
}

/// The whole report.
pub fn document(
    reproduction: &Reproduction,
    judged: &[ClaimJudgement],
    origin: &Origin,
) -> Document {
    Document {
        title: "Reproducibility report: “Anomalous Enhancement of Yield Strength due to Static Friction”"
            .to_owned(),
        lead: vec![
            "On R. Suzuki, T. Matsushima, T. Yamaguchi, M. Tani and S. Sasa, arXiv:2511.06807, and its \
             supplement: what holds, how well, and how to see it. Forces in m g, lengths in r, speeds in \
             r √(k_n/m), times in √(m/k_n); stiffness is 1/ε = k_n r/(m g)."
                .to_owned(),
        ],
        sections: vec![
            summary::section(reproduction, judged),
            claims::errata(judged),
            figures::section(reproduction),
            claims::register(judged),
            tolerances::section(reproduction),
            preparation::section(reproduction),
            conventions::section(reproduction),
            environment::section(reproduction, origin),
            untested::section(reproduction, judged, origin),
        ],
    }
}
