//! Every checkable statement of the paper, and a verdict on each that is derived by running code.
//!
//! `reference/claims.toml` says what is claimed, where, and which check tests it (`register`). `printed` is
//! the paper as it stands, misprints included: its formulas with every constant changeable. `truth` works
//! the same things out anew, `checks` compare the two (and, where the paper speaks of simulations, runs), and
//! `finding` makes a verdict of the deviation. A misprint becomes an erratum only if the same check holds
//! with the constants of the corrected form.

mod checks;
mod finding;
mod judgement;
mod printed;
mod register;
mod truth;

pub use finding::ClaimVerdict;
pub use judgement::{ClaimJudgement, judge, judge_theory};
pub use printed::PaperTheory;
pub use register::{Claim, ClaimKind, Erratum, Register, RegisterError};

/// The names of all checks that a register may use.
pub fn check_names() -> Vec<&'static str> {
    checks::all().map(|check| check.name).collect()
}
