//! The limits of the report: everything that was not tested.

use super::super::document::{Block, Section};
use super::Origin;
use crate::number::{friction_in_tex, stiffness_in_tex};
use crate::paper::claims::{ClaimJudgement, ClaimVerdict, powers_in_tex};
use crate::paper::reproduction::Reproduction;
use crate::study::Verdict;
use crate::study::yield_force::Judgement;
use crate::text::without_mathematics;

/// The limits of every report.
const OUTSIDE: [&str; 4] = [
    "Real cylinders: nothing here was compared with an experiment.",
    "Contact laws other than linear springs and Hertz–Mindlin, more than three cylinders, and codes in three dimensions: of \
     spheres the report has the exact limit alone.",
    "Stiffness ratios other than 2.5 (linear) and 17/14 (Hertz) in the runs; theory and regime maps go further.",
    "The shared libraries of the external programs, which are not hashed.",
];

pub(super) fn section(
    reproduction: &Reproduction,
    claims: &[ClaimJudgement],
    origin: &Origin,
) -> Section {
    let mut items: Vec<String> = OUTSIDE.map(str::to_owned).to_vec();
    if reproduction.published.is_none() {
        items.push(
            "The points that the paper plots: `tristack report --published DIR` reads them from a checkout of the authors’ \
             repository, and reproduces them."
                .to_owned(),
        );
    }
    let laws = &reproduction.laws.yield_curves;
    items.extend(recorded(reproduction.yield_curves.iter().chain(laws)));
    if !origin.literal {
        items.push(
            "Fig. 2(a) at the paper’s literal wall speed and time step, except at $\\mu = 0.2$, stiffness $10^4$: \
             `tristack report --literal` runs all of it, some ten minutes."
                .to_owned(),
        );
    }
    items.extend(unjudged(reproduction));
    let untestable = claims
        .iter()
        .filter(|judged| judged.verdict == ClaimVerdict::Untestable);
    items.extend(untestable.map(|judged| {
        format!(
            "{}, “{}” ([](#claim-{})): {}.",
            judged.claim.place, judged.claim.statement, judged.claim.id, judged.evidence
        )
    }));
    let blocks = vec![Block::List { items }];
    Section::new("untested", "What was not tested", blocks)
}

fn recorded<'a>(judgements: impl Iterator<Item = &'a Judgement>) -> Option<String> {
    let mut codes: Vec<&str> = judgements
        .filter(|judgement| judgement.is_recorded())
        .map(|judgement| judgement.code.as_str())
        .collect();
    codes.sort_unstable();
    codes.dedup();
    (!codes.is_empty()).then(|| {
        format!(
            "{}: not run here; recorded runs stand in, which prove nothing about a program on this machine.",
            codes.join(", ")
        )
    })
}

/// Lists the rows without a judgement, each with its reason.
fn unjudged(reproduction: &Reproduction) -> Vec<String> {
    let judged = |row: &&Judgement| matches!(row.verdict(), Verdict::Agrees | Verdict::Differs);
    let open = reproduction.judged_rows().filter(|row| !judged(row));
    open.map(|row| {
        format!(
            "{} at $\\mu = {}$, stiffness ${}$ was not judged, {}: {}.",
            row.code,
            friction_in_tex(row.mu()),
            stiffness_in_tex(row.stiffness()),
            row.verdict(),
            powers_in_tex(&without_mathematics(&row.reason()))
        )
    })
    .collect()
}
