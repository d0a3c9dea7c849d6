//! The paper as printed. Every formula is evaluated the way it stands, with the constants of
//! [`PaperTheory`]; which of them are wrong is for the checks to say.

mod appendix;
mod constants;
mod contact_law;
mod elastic;
mod rigid;
mod supplement;

pub use constants::PaperTheory;
pub use contact_law::Sliding;
