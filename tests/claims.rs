//! The register of claims, and the verdicts by theory alone.
use tristack::claims::{PaperTheory, Register, judge_theory};

#[test]
fn print() {
    let register = Register::paper().unwrap();
    for row in judge_theory(&register, &PaperTheory::printed()) {
        println!(
            "{:<14} {:<28} {} {}",
            row.verdict.as_str(),
            row.id,
            row.evidence,
            row.erratum
                .map_or(String::new(), |e| format!("\n      => {e}"))
        );
    }
}
