//! All verdicts as JUnit XML, for continuous integration.

use crate::output::friction;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};
use crate::paper::reproduction::Reproduction;
use crate::study::Verdict;
use crate::study::yield_force::Judgement;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// One suite for each kind of verdict. A claim that does not hold is a result, not a failed test: its case passes and
/// names the verdict. A claim that cannot be tested is skipped.
pub(super) fn junit(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> String {
    let mut report = Report::new("tristack report");
    let mut add_suite = |name: &str, cases: Vec<TestCase>| {
        let mut suite = TestSuite::new(name);
        suite.add_test_cases(cases);
        report.add_test_suite(suite);
    };
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
            let (code, mu, power) = (exponent.code, friction(exponent.mu), exponent.power.value());
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
    report.to_string().expect("plain text has an XML form") + "\n"
}

fn row(row: &Judgement) -> TestCase {
    let (mu, stiffness) = (friction(row.mu()), row.stiffness());
    let name = format!("{} at mu = {mu}, stiffness = {stiffness}", row.code);
    TestCase::new(name, status(row.verdict(), &row.reason()))
}

fn status(verdict: Verdict, text: &str) -> TestCaseStatus {
    let mut status = match verdict {
        Verdict::Agrees => return TestCaseStatus::success(),
        Verdict::Differs => TestCaseStatus::non_success(NonSuccessKind::Failure),
        Verdict::Failed | Verdict::NoYield => TestCaseStatus::non_success(NonSuccessKind::Error),
        Verdict::Inconclusive | Verdict::Missing => TestCaseStatus::skipped(),
    };
    status.set_type(verdict.as_str()).set_message(text);
    status
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
