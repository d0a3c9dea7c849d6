//! All verdicts as JUnit XML, for continuous integration.

use crate::friction;
use crate::junit::{document, row, status, suite};
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};
use crate::paper::reproduction::Reproduction;
use quick_junit::{TestCase, TestCaseStatus, TestSuite};

/// Formats one suite for each kind of verdict. A claim that does not hold is a result, not a failed test: its case
/// passes and names the verdict. A claim that cannot be tested is skipped.
pub(super) fn junit(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> String {
    let mut suites: Vec<TestSuite> = Vec::new();
    let mut add_suite = |name: &str, cases: Vec<TestCase>| suites.push(suite(name, cases));
    let parts = [
        ("yield_curves", &reproduction.yield_curves),
        ("scaling", &reproduction.scaling),
        ("literal", &reproduction.literal),
        ("laws", &reproduction.laws.yield_curves),
        ("law_scaling", &reproduction.laws.scaling),
    ];
    for (name, judgements) in parts {
        add_suite(name, judgements.iter().map(row).collect());
    }
    let exponents = reproduction.exponents.iter();
    let exponents = exponents
        .chain(&reproduction.laws.exponents)
        .map(|exponent| {
            let (code, mu, power) = (
                exponent.code.clone(),
                friction(exponent.mu),
                exponent.power.value(),
            );
            let name = format!("{code} at mu = {mu}, p = {power}");
            let text = format!("fitted {}, exact {}", exponent.exponent, exponent.exact);
            TestCase::new(name, status(exponent.verdict, &text))
        });
    add_suite("exponents", exponents.collect());
    let trajectories = reproduction.trajectories.iter().flat_map(|judgement| {
        let verdicts = judgement.verdicts().into_iter().enumerate();
        verdicts.map(|(index, verdict)| {
            let name = format!("{} comparison {}", judgement.code, index + 1);
            TestCase::new(name, status(verdict, &judgement.reason()))
        })
    });
    add_suite("trajectories", trajectories.collect());
    add_suite("claims", claims.iter().map(claim).collect());
    document("tristack report", suites)
}

fn claim(judged: &ClaimJudgement) -> TestCase {
    let status = match judged.verdict {
        ClaimVerdict::Untestable => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(&judged.evidence);
            status
        }
        _ => TestCaseStatus::success(),
    };
    let mut case = TestCase::new(judged.claim.id.clone(), status);
    case.set_classname(judged.claim.place.clone());
    let verdict = super::sections::in_words(judged.verdict);
    case.set_system_out(format!("{verdict}: {}", judged.evidence));
    case
}
