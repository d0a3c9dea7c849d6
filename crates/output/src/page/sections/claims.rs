//! The claims of the paper, and its errata.

use super::super::document::{
    Block, Claims, PageClaim, PageEquation, PageTable, Section, VerdictCount,
};
use crate::DataTable;
use crate::paper::claims::{
    Allowance, ClaimJudgement, ClaimVerdict, Measure, ROUND_OFF, scientific,
};
use crate::table::Columns;

/// The verdicts in the order of the page.
const VERDICTS: [ClaimVerdict; 4] = [
    ClaimVerdict::Fails,
    ClaimVerdict::Approximately,
    ClaimVerdict::Holds,
    ClaimVerdict::Untestable,
];

/// A claim with its place in the paper, from 1.
type Numbered<'a> = (usize, &'a ClaimJudgement);

pub(super) fn errata(claims: &[ClaimJudgement]) -> Section {
    let data = errata_table(claims);
    let wrong = claims.iter().filter(|own| own.erratum.is_some());
    let anchors = wrong.map(|own| format!("erratum-{}", own.claim.id));
    let caption = "Errata, each with the number of the claim in [](#table-claims).";
    let table = data.titled().anchored(anchors);
    let blocks = vec![
        Block::paragraph(
            "Displayed equations and numbers of the paper that do not hold as printed. A corrected form stands \
             here only because the same check holds with it.",
        ),
        Block::Table(PageTable::new("errata", caption, &data, table)),
    ];
    Section::new("errata", "Errata", blocks)
}

pub(crate) fn errata_table(claims: &[ClaimJudgement]) -> DataTable<'_> {
    Columns::<Numbered>::new(
        "errata",
        "A row is a displayed equation or number of the paper that does not hold as printed. Mathematics is TeX between \
         dollar signs.",
        "`tristack report` (tables/errata.csv)",
    )
    .text("claim", |(_, own)| own.claim.id.clone())
    .means("name of the claim")
    .shown("claim")
    .cell(|(number, own)| format!("[{number}](#claim-{})", own.claim.id))
    .text("place", |(_, own)| own.claim.place.clone())
    .means("where it stands in the paper")
    .shown("place")
    .text("statement", |(_, own)| own.claim.statement.clone())
    .means("what is printed")
    .shown("as printed")
    .text("erratum", |(_, own)| own.erratum.clone())
    .means("what should stand there")
    .shown("should be")
    .text("evidence", |(_, own)| own.evidence.clone())
    .means("what was compared, and the numbers")
    .shown("evidence")
    .rows(numbered(claims).filter(|(_, own)| own.erratum.is_some()))
}

/// Returns the section with all claims.
pub(super) fn register(claims: &[ClaimJudgement]) -> Section {
    let caption = "Claims, those that do not hold first.";
    let equations = equations(claims);
    let sorted = sorted(claims);
    let anchors = sorted
        .iter()
        .map(|(_, own)| format!("claim-{}", own.claim.id));
    let table = claims_of(sorted.clone()).titled().anchored(anchors);
    let blocks = vec![
        Block::paragraph(
            "Every checkable statement of paper and supplement, displayed equations included. Each verdict \
             is derived by running the check; the register is `reference/claims.toml`. A formula holds if it is right to \
             round-off, any other statement up to `holds_to` of claims.json. Where the words of a claim leave room, as “agree well” or \
             “of order” do, it holds approximately up to a larger deviation, given with unit and reason. Native is the DEM of tristack; \
             the elastic equation is Eq. (8).",
        ),
        Block::Claims(Claims {
            table: PageTable::new("claims", caption, &claims_table(claims), table),
            counts: VERDICTS.map(|verdict| count(claims, verdict)).to_vec(),
            list: sorted
                .into_iter()
                .map(|own| on_page(own, &equations))
                .collect(),
            equations,
        }),
    ];
    Section::new("claims", "Claims", blocks)
}

fn numbered(claims: &[ClaimJudgement]) -> impl Iterator<Item = Numbered<'_>> {
    claims
        .iter()
        .enumerate()
        .map(|(index, own)| (index + 1, own))
}

/// Sorts the claims by verdict, those that do not hold first, and within one verdict in the order of the paper.
fn sorted(claims: &[ClaimJudgement]) -> Vec<Numbered<'_>> {
    let mut sorted: Vec<Numbered> = numbered(claims).collect();
    sorted.sort_by_key(|(_, own)| VERDICTS.iter().position(|&one| one == own.verdict));
    sorted
}

fn count(claims: &[ClaimJudgement], verdict: ClaimVerdict) -> VerdictCount {
    let own = claims.iter().filter(|own| own.verdict == verdict);
    VerdictCount {
        verdict: verdict.to_string(),
        words: in_words(verdict),
        count: own.count(),
    }
}

/// Returns the claim as the page shows it. `equations` are those of the paper, each with the first claim on it, which
/// carries its anchor.
fn on_page((number, own): Numbered, equations: &[PageEquation]) -> PageClaim {
    let claim = &own.claim;
    let first = equations.iter().filter(|known| known.claim == claim.id);
    PageClaim {
        id: claim.id.clone(),
        number,
        place: claim.place.clone(),
        statement: claim.statement.clone(),
        verdict: own.verdict.to_string(),
        words: in_words(own.verdict),
        evidence: evidence(own),
        as_published: as_published(own),
        erratum: own.erratum.clone(),
        equations: first.map(|known| known.number.clone()).collect(),
        sources: claim.see.iter().map(|see| format!("[](#{see})")).collect(),
    }
}

/// Formats the evidence, and a full stop before the sources. A deviation follows if there is a second verdict, by
/// published data. If the claim does not simply hold, what its words are taken to allow follows too.
fn evidence(own: &ClaimJudgement) -> String {
    let measure = own.measure.as_ref();
    let criterion = criterion(measure.filter(|_| own.as_published.is_some()));
    let allowed = own.claim.allowed.as_ref();
    let allowed = allowed.filter(|_| own.verdict != ClaimVerdict::Holds);
    let allowed = allowed.map(|allowed| {
        let Allowance { size, of, because } = allowed;
        format!("Allowed: {size} of {of}; {because}.")
    });
    let more: Vec<String> = criterion.into_iter().chain(allowed).collect();
    let is_last = own.claim.see.is_empty() && more.is_empty();
    let stop = if is_last || ends_a_sentence(&own.evidence) {
        ""
    } else {
        "."
    };
    let sentences = std::iter::once(format!("{}{stop}", own.evidence)).chain(more);
    sentences.collect::<Vec<_>>().join(" ")
}

/// States the deviation and the bound up to which a claim holds, if that bound is above the round-off of formulas.
fn criterion(measure: Option<&Measure>) -> Option<String> {
    let Measure { deviation, bound } = *measure.filter(|own| own.bound > ROUND_OFF)?;
    Some(format!(
        "Deviation ${}$; it holds up to ${}$.",
        scientific(deviation, 1),
        scientific(bound, 1)
    ))
}

/// States the verdict by the published data, and its evidence.
fn as_published(own: &ClaimJudgement) -> Option<String> {
    let second = own.as_published.as_ref()?;
    let words = in_words(second.verdict);
    let criterion = criterion(Some(&second.measure));
    let criterion = criterion.map_or_else(String::new, |criterion| format!(" {criterion}"));
    Some(format!(
        "As published: {words} ({}).{criterion}",
        second.evidence
    ))
}

fn ends_a_sentence(text: &str) -> bool {
    text.ends_with('.') || text.ends_with(".)")
}

/// Lists the displayed equations with the first claim on each.
fn equations(claims: &[ClaimJudgement]) -> Vec<PageEquation> {
    let mut equations: Vec<PageEquation> = Vec::new();
    for own in claims {
        for number in &own.claim.equations {
            if !equations.iter().any(|known| known.number == *number) {
                equations.push(PageEquation {
                    number: number.clone(),
                    claim: own.claim.id.clone(),
                    verdict: own.verdict.to_string(),
                });
            }
        }
    }
    equations
}

pub(crate) fn claims_table(claims: &[ClaimJudgement]) -> DataTable<'_> {
    claims_of(numbered(claims).collect())
}

fn claims_of(claims: Vec<Numbered>) -> DataTable {
    Columns::<Numbered>::new(
        "claims",
        "A row is a checkable statement of the paper and the verdict on it. Mathematics is TeX between dollar signs.",
        "`tristack report` (tables/claims.csv, claims.json)",
    )
    .text("id", |(_, own)| own.claim.id.clone())
    .means("name of the claim")
    .number("number", "1", |(number, _)| *number)
    .means("its place among the claims, from 1")
    .shown("claim")
    .text("place", |(_, own)| own.claim.place.clone())
    .means("where it stands in the paper")
    .shown("place")
    .text("statement", |(_, own)| own.claim.statement.clone())
    .means("its text")
    .shown("statement")
    .word("kind", |(_, own)| own.claim.kind)
    .means("what kind of statement it is")
    .text("verdict", |(_, own)| own.verdict.to_string())
    .means("`holds`, `approximately`, `fails` or `untestable`")
    .shown("verdict")
    .cell(|(_, own)| in_words(own.verdict).to_owned())
    .number("allowed", "1", |(_, own)| {
        Some(own.claim.allowed.as_ref()?.size)
    })
    .means("largest deviation with which it holds approximately; absent where its words allow none")
    .text("allowed_of", |(_, own)| {
        Some(own.claim.allowed.as_ref()?.of.clone())
    })
    .means("what that is a part of, or counted in")
    .text("allowed_because", |(_, own)| {
        Some(own.claim.allowed.as_ref()?.because.clone())
    })
    .means("why its words allow as much")
    .number("deviation", "1", |(_, own)| Some(own.measure.as_ref()?.deviation))
    .means("distance of the claim from what was found, in the measure that `evidence` names")
    .number("holds_to", "1", |(_, own)| Some(own.measure.as_ref()?.bound))
    .means("largest deviation with which it holds as stated")
    .text("evidence", |(_, own)| own.evidence.clone())
    .means("what was compared, and the numbers")
    .shown("evidence")
    .cell(|(_, own)| match as_published(own) {
        Some(second) => format!("{} {second}", evidence(own)),
        None => evidence(own),
    })
    .text("published_verdict", |(_, own)| {
        Some(own.as_published.as_ref()?.verdict.to_string())
    })
    .means("the verdict by the data that the authors have published; absent without them, or where they say nothing about it")
    .number("published_deviation", "1", |(_, own)| {
        Some(own.as_published.as_ref()?.measure.deviation)
    })
    .means("`deviation` by these data")
    .text("published_evidence", |(_, own)| {
        Some(own.as_published.as_ref()?.evidence.clone())
    })
    .means("what was compared for it, and the numbers")
    .text("erratum", |(_, own)| own.erratum.clone())
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
