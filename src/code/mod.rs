//! Codes: run a case, return its series. A code is a folder with a manifest and decks; the native one is part of this
//! program.

mod batch;
mod capture;
mod definition;
mod external;
mod failure;
mod format;
mod guard;
mod installation;
mod installed;
mod manifest;
mod native;
mod parameters;
mod process;
mod provenance;
mod registry;
mod task;
mod written;

pub use definition::ManifestError;
pub use failure::{Failure, FailureKind};
pub use format::{ParameterFormat, ResultFormat, pyramid_in_log};
pub use guard::{COMMAND as GUARD_COMMAND, end_like, guard, guard_foreign_programs};
pub use installation::version_in_answer;
pub use installed::{Advanced, Batching, Finished, InstalledCode, RunContext, Tasks};
pub use manifest::{Angle, Colour, Definition, Integration, Mark, Shape, TaskKind};
pub use process::Interrupt;
pub use provenance::{Identity, Provenance, Run, machine};
pub use registry::{Code, Declaration};
pub use task::Task;
pub use written::keep_evidence;

impl Code {
    /// The code as it is installed here; `None` if it is not.
    pub fn find(self) -> Option<Box<dyn InstalledCode>> {
        if self == Self::NATIVE {
            return Some(Box::new(native::Native::new()));
        }
        let word = self.definition().command(TaskKind::Stack, &[]);
        external::ExternalCode::find(self, word.first()?)
    }

    /// The same code computing with more digits, if there is one here: native in double-double arithmetic, another
    /// in the program that its manifest names. The difference of the two is round-off.
    pub fn find_precise(self) -> Option<Box<dyn InstalledCode>> {
        if self == Self::NATIVE {
            return Some(Box::new(native::Native::precise()));
        }
        let program = self.definition().program.as_ref()?;
        external::ExternalCode::find(self, program.higher_precision.as_deref()?)
    }
}
