//! Everything that was judged, as JUnit XML for continuous integration.

use crate::output::friction;
use crate::paper::claims::{ClaimJudgement, ClaimVerdict};
use crate::paper::reproduction::Reproduction;
use crate::study::Verdict;
use crate::study::yield_force::Judgement;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

/// One suite a kind of judgement. A claim that does not hold is no failure of the tests but their result: it
/// passes, and says so; a claim that cannot be tested is skipped.
pub fn junit(reproduction: &Reproduction, claims: &[ClaimJudgement]) -> String {
    let mut report = Report::new("tristack report");
    let parts = [
        ("yield_curves", &reproduction.yield_curves),
        ("scaling", &reproduction.scaling),
        ("literal", &reproduction.literal),
    ];
    for (name, judgements) in parts {
        let mut suite = TestSuite::new(name);
        suite.add_test_cases(judgements.iter().map(row));
        report.add_test_suite(suite);
    }
    let mut suite = TestSuite::new("exponents");
    suite.add_test_cases(reproduction.exponents.iter().map(|exponent| {
        let name = format!("{} at mu = {}", exponent.code, friction(exponent.mu));
        let text = format!("fitted {}, exact {}", exponent.exponent, exponent.exact);
        TestCase::new(name, status(exponent.verdict, &text))
    }));
    report.add_test_suite(suite);
    let mut suite = TestSuite::new("trajectories");
    for judgement in &reproduction.trajectories {
        let verdicts = judgement.verdicts().into_iter().enumerate();
        suite.add_test_cases(verdicts.map(|(index, verdict)| {
            let name = format!("{} comparison {}", judgement.code, index + 1);
            TestCase::new(name, status(verdict, &judgement.notes().join("; ")))
        }));
    }
    report.add_test_suite(suite);
    let mut suite = TestSuite::new("claims");
    suite.add_test_cases(claims.iter().map(claim));
    report.add_test_suite(suite);
    report.to_string().expect("plain text has an XML form") + "\n"
}

fn row(judgement: &Judgement) -> TestCase {
    let row = judgement;
    let name = format!(
        "{} at mu = {}, stiffness = {}",
        row.code,
        friction(row.mu()),
        row.stiffness()
    );
    TestCase::new(name, status(row.verdict(), &judgement.notes().join("; ")))
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

fn claim(claim: &ClaimJudgement) -> TestCase {
    let status = match claim.verdict {
        ClaimVerdict::Untestable => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(&claim.evidence);
            status
        }
        _ => TestCaseStatus::success(),
    };
    let mut case = TestCase::new(claim.id.clone(), status);
    case.set_classname(claim.place.clone());
    case.set_system_out(format!(
        "{}: {}",
        super::sections::in_words(claim.verdict),
        claim.evidence
    ));
    case
}
