//! The paper as printed. Every formula is evaluated as it stands, with the constants of [`PaperTheory`]; the checks
//! show which formulas are wrong.

mod appendix;
mod constants;
mod contact_law;
mod elastic;
mod rigid;
mod supplement;

pub use constants::PaperTheory;
pub(crate) use contact_law::Sliding;
