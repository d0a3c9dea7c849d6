//! What the paper says, and what is to be said of it.

use super::super::document::{Block, DataTable, Section};
use crate::output::Table;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};

/// The errata.
pub fn errata(claims: &[ClaimJudgement]) -> Section {
    let mut table = Table::new(&["place", "as printed", "should be", "evidence"]);
    for claim in claims {
        if let Some(erratum) = &claim.erratum {
            table.push(vec![
                claim.place.clone(),
                claim.statement.clone(),
                erratum.clone(),
                claim.evidence.clone(),
            ]);
        }
    }
    let blocks = vec![
        Block::paragraph(
            "Displayed equations and numbers of the paper that do not hold as printed. A corrected form stands \
             here only because the same check holds with it.",
        ),
        Block::Table(named("errata", "Errata.", table)),
    ];
    Section {
        id: "errata",
        title: "Errata",
        blocks,
    }
}

/// All claims.
pub fn register(claims: &[ClaimJudgement]) -> Section {
    let mut table = Table::new(&["claim", "place", "statement", "verdict", "evidence"]);
    for claim in claims {
        table.push(vec![
            claim.id.clone(),
            claim.place.clone(),
            claim.statement.clone(),
            verdict(claim.verdict).to_owned(),
            claim.evidence.clone(),
        ]);
    }
    let blocks = vec![
        Block::paragraph(
            "Every checkable statement of paper and supplement, displayed equations included. Each verdict \
             is derived by running the check; the register is `reference/claims.toml`.",
        ),
        Block::Table(named("claims", "Claims.", table)),
    ];
    Section {
        id: "claims",
        title: "Claims",
        blocks,
    }
}

fn named(name: &'static str, caption: &str, table: Table) -> DataTable {
    DataTable {
        name,
        caption: caption.to_owned(),
        csv: table.csv(),
        table,
        long: false,
    }
}

/// A verdict in words.
pub fn verdict(verdict: ClaimVerdict) -> &'static str {
    match verdict {
        ClaimVerdict::Holds => "holds",
        ClaimVerdict::Approximately => "holds approximately",
        ClaimVerdict::Fails => "does not hold as stated",
        ClaimVerdict::Untestable => "cannot be tested here",
    }
}
