//! Judges claims.

use super::checks;
use super::finding::{ClaimVerdict, Finding};
use super::printed::PaperTheory;
use super::register::{Claim, Register};
use crate::reproduction::Reproduction;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// A claim and the verdict on it.
#[derive(Debug, Clone, PartialEq)]
pub struct ClaimJudgement {
    /// The claim.
    pub claim: Claim,
    /// Verdict by the finding of the check.
    pub verdict: ClaimVerdict,
    /// The quantities compared and their values, or the reason why there are none.
    pub evidence: String,
    /// Deviation and bound behind the verdict; `None` for an untestable claim.
    pub measure: Option<Measure>,
    /// The verdict on the same statement by the published data; `None` without them, or if they say nothing about it.
    pub as_published: Option<FoundVerdict>,
    /// Correction, if a check has shown that it holds.
    pub erratum: Option<String>,
}

/// A verdict that a check has found.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundVerdict {
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// The quantities compared and their values.
    pub evidence: String,
    /// Deviation and bound behind the verdict.
    pub measure: Measure,
}

/// How far a claim is from what was found, in the check's own measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measure {
    /// The deviation.
    pub deviation: f64,
    /// The largest one with which the claim holds as stated.
    pub bound: f64,
}

/// Judges every claim of `register` by the formulas of `paper` and by `runs`, without which claims on DEM runs are
/// untestable.
pub fn judge(
    register: &Register,
    paper: &PaperTheory,
    runs: Option<&Reproduction>,
) -> Vec<ClaimJudgement> {
    let claims = register.claims.par_iter();
    let judged = claims.map(|claim| judge_claim(claim, paper, runs));
    judged.collect()
}

fn judge_claim(claim: &Claim, paper: &PaperTheory, runs: Option<&Reproduction>) -> ClaimJudgement {
    let verdict_of = |finding: Finding| {
        let allowed = claim.allowed.as_ref().map(|allowed| allowed.size);
        let Finding {
            deviation, bound, ..
        } = finding;
        FoundVerdict {
            verdict: finding.verdict(allowed),
            evidence: finding.evidence,
            measure: Measure { deviation, bound },
        }
    };
    let (verdict, evidence, measure) = match examine(claim, paper, runs).map(verdict_of) {
        Ok(found) => (found.verdict, found.evidence, Some(found.measure)),
        Err(reason) => (ClaimVerdict::Untestable, reason, None),
    };
    let check = claim.check.as_deref().and_then(checks::find);
    let published = runs.and_then(|runs| runs.published.as_ref());
    let as_published = check.zip(published);
    let as_published = as_published.and_then(|(check, data)| check.run_as_published(paper, data));
    let as_published = as_published.and_then(Result::ok).map(verdict_of);
    ClaimJudgement {
        claim: claim.clone(),
        verdict,
        evidence,
        measure,
        as_published,
        erratum: erratum(claim, paper, runs, verdict),
    }
}

/// Returns the finding of the claim's check, or the reason why there is none.
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

/// Returns the corrected form, if one is needed and the check holds with it.
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
    let corrected = erratum.apply(paper)?;
    let finding = examine(claim, &corrected, runs).ok()?;
    let holds = finding.verdict(None) == ClaimVerdict::Holds;
    holds.then(|| erratum.words(&corrected)).flatten()
}
