//! The claims of the paper, and its errata.

use super::super::document::{Block, Section};
use crate::output::DataTable;
use crate::output::table::Columns;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};

pub(super) fn errata(claims: &[ClaimJudgement]) -> Section {
    let blocks = vec![
        Block::paragraph(
            "Displayed equations and numbers of the paper that do not hold as printed. A corrected form stands \
             here only because the same check holds with it.",
        ),
        Block::table("errata", "Errata.", &errata_table(claims)),
    ];
    Section::new("errata", "Errata", blocks)
}

pub(crate) fn errata_table(claims: &[ClaimJudgement]) -> DataTable<'_> {
    let wrong = claims.iter().filter(|own| own.erratum.is_some());
    Columns::<&ClaimJudgement>::new(
        "errata",
        "A row is a displayed equation or number of the paper that does not hold as printed.",
        "`tristack report` (tables/errata.csv)",
    )
    .text("claim", |own| own.claim.id.clone())
    .means("name of the claim")
    .text("place", |own| own.claim.place.clone())
    .means("where it stands in the paper")
    .shown("place")
    .text("statement", |own| own.claim.statement.clone())
    .means("what is printed")
    .shown("as printed")
    .text("erratum", |own| own.erratum.clone())
    .means("what should stand there")
    .shown("should be")
    .text("evidence", |own| own.evidence.clone())
    .means("what was compared, and the numbers")
    .shown("evidence")
    .rows(wrong)
}

/// All claims.
pub(super) fn register(claims: &[ClaimJudgement]) -> Section {
    let blocks = vec![
        Block::paragraph(
            "Every checkable statement of paper and supplement, displayed equations included. Each verdict \
             is derived by running the check; the register is `reference/claims.toml`.",
        ),
        Block::table("claims", "Claims.", &claims_table(claims)),
    ];
    Section::new("claims", "Claims", blocks)
}

pub(crate) fn claims_table(claims: &[ClaimJudgement]) -> DataTable<'_> {
    Columns::<&ClaimJudgement>::new(
        "claims",
        "A row is a checkable statement of the paper and the verdict on it.",
        "`tristack report` (tables/claims.csv, claims.json)",
    )
    .text("id", |own| own.claim.id.clone())
    .means("name of the claim")
    .shown("claim")
    .text("place", |own| own.claim.place.clone())
    .means("where it stands in the paper")
    .shown("place")
    .text("statement", |own| own.claim.statement.clone())
    .means("its text")
    .shown("statement")
    .word("kind", |own| own.claim.kind)
    .means("what kind of statement it is")
    .text("verdict", |own| own.verdict.to_string())
    .means("`holds`, `approximately`, `fails` or `untestable`")
    .shown("verdict")
    .cell(|own| in_words(own.verdict).to_owned())
    .text("evidence", |own| own.evidence.clone())
    .means("what was compared, and the numbers")
    .shown("evidence")
    .text("erratum", |own| own.erratum.clone())
    .means("what should stand there; only where that has been checked to hold")
    .rows(claims)
}

/// The verdict in words.
pub(crate) fn in_words(verdict: ClaimVerdict) -> &'static str {
    match verdict {
        ClaimVerdict::Holds => "holds",
        ClaimVerdict::Approximately => "holds approximately",
        ClaimVerdict::Fails => "does not hold as stated",
        ClaimVerdict::Untestable => "cannot be tested here",
    }
}
