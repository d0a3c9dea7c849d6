//! The atlas: passports of many codes, versions and styles, what differs between two of them, and what changed from one
//! version to the next.

mod difference;
mod history;
mod meanings;
mod theory;
mod verdicts;
mod version;

pub use difference::{Change, Difference, ForceChange, difference};
pub use history::{Atlas, Edge, NamedPassport};
pub use meanings::{Meaning, base_name, meanings};
pub use theory::{ArmCurve, SPREAD_STIFFNESS, Spread, StiffnessLaw};
pub use verdicts::{CodeVerdicts, UnreadableVerdicts, VerdictRow, Verdicts};
