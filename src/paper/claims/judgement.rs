//! From a claim to its verdict.

use super::checks;
use super::finding::{ClaimVerdict, Finding};
use super::printed::PaperTheory;
use super::register::{Claim, ClaimKind, Register};
use crate::paper::reproduction::Reproduction;
use serde::Serialize;

/// One row of `claims.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ClaimJudgement {
    /// Name of the claim.
    pub id: String,
    /// Where it stands in the paper.
    pub place: String,
    /// What it says.
    pub statement: String,
    /// What kind of thing it is.
    pub kind: ClaimKind,
    /// What is to be said of it.
    pub verdict: ClaimVerdict,
    /// What was compared, and the numbers.
    pub evidence: String,
    /// What should stand there instead; only where that has been checked to hold.
    pub erratum: Option<String>,
}

/// Judges every claim of `register` by what `paper` says and what was run for `reproduction`.
pub fn judge(
    register: &Register,
    paper: &PaperTheory,
    reproduction: &Reproduction,
) -> Vec<ClaimJudgement> {
    judge_with(register, paper, Some(reproduction))
}

/// The same by theory alone: claims on DEM runs cannot be tested then.
pub fn judge_theory(register: &Register, paper: &PaperTheory) -> Vec<ClaimJudgement> {
    judge_with(register, paper, None)
}

fn judge_with(
    register: &Register,
    paper: &PaperTheory,
    runs: Option<&Reproduction>,
) -> Vec<ClaimJudgement> {
    let claims = register.claims.iter();
    claims
        .map(|claim| judge_claim(claim, paper, runs))
        .collect()
}

fn judge_claim(claim: &Claim, paper: &PaperTheory, runs: Option<&Reproduction>) -> ClaimJudgement {
    let (verdict, evidence) = match examine(claim, paper, runs) {
        Ok(finding) => (finding.verdict(claim.allowed), finding.evidence),
        Err(reason) => (ClaimVerdict::Untestable, reason),
    };
    ClaimJudgement {
        id: claim.id.clone(),
        place: claim.place.clone(),
        statement: claim.statement.clone(),
        kind: claim.kind,
        verdict,
        evidence,
        erratum: erratum(claim, paper, runs, verdict),
    }
}

/// What the check of `claim` finds, or why it finds nothing.
fn examine(
    claim: &Claim,
    paper: &PaperTheory,
    runs: Option<&Reproduction>,
) -> Result<Finding, String> {
    let Some(name) = &claim.check else {
        return Err(claim.untestable.clone().unwrap_or_default());
    };
    let check = checks::find(name).ok_or_else(|| format!("there is no check `{name}`"))?;
    check.run(paper, runs)
}

/// The corrected form, if one is needed and holds.
fn erratum(
    claim: &Claim,
    paper: &PaperTheory,
    runs: Option<&Reproduction>,
    verdict: ClaimVerdict,
) -> Option<String> {
    let erratum = claim.erratum.as_ref()?;
    if verdict != ClaimVerdict::Fails && verdict != ClaimVerdict::Approximately {
        return None;
    }
    let corrected = examine(claim, &erratum.apply(paper)?, runs).ok()?;
    (corrected.verdict(None) == ClaimVerdict::Holds).then(|| erratum.text.clone())
}
