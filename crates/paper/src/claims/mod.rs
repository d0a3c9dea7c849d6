//! Every checkable statement of the paper, and a verdict on each that is derived by running code.
//!
//! `register` reads `reference/claims.toml`: the claims, their places, and the checks that test them. `printed` is
//! the paper as it stands, misprints included: its formulas, with constants that can be changed. `truth` derives the
//! same quantities anew, `checks` compare the two (and runs, for the paper's simulations), and `finding` derives a
//! verdict from the deviation. A misprint becomes an erratum only if the same check holds with the constants of the
//! corrected form. All texts write formulas in TeX between dollar signs; `notation` writes numbers and lists that
//! way.

mod checks;
mod finding;
mod judgement;
mod multiplied_out;
mod notation;
mod printed;
mod register;
mod simulations;
mod truth;

pub use checks::check_names;
pub use finding::{ClaimVerdict, ROUND_OFF};
pub use judgement::{ClaimJudgement, FoundVerdict, Measure, judge};
pub use notation::{list, number, powers_in_tex, scientific, values};
pub use printed::PaperTheory;
pub use register::{Allowance, Claim, ClaimKind, Erratum, Register, RegisterError};
