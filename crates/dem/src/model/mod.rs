//! The problem as a run: a case consists of stack, contact convention and protocol, and has a content hash.
//!
//! Stack, convention and contact law come from the crate `tristack-theory`, in the units of
//! [`tristack_theory::model`].

mod case;
mod case_file;
mod digest;
mod protocol;
mod pyramid;
mod shortcuts;
mod shown;
mod side_walls;
mod written_stack;

pub use case::{Case, CaseError};
pub use case_file::{PartialCase, PartialProtocol};
pub use digest::sha256_hex;
pub use protocol::smooth_step;
pub use protocol::{Preparation, PreparationSteps, Protocol, Sampling, Schedule};
pub use pyramid::Pyramid;
pub use shortcuts::Shortcuts;
pub use shown::shown;
pub use shown::{readable, readable_lines, shell_quoted};
pub use side_walls::{SideWallSteps, SideWalls};
pub use tristack_theory::model::*;
pub use written_stack::WrittenStack;
