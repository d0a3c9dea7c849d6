//! Codes: each runs a case and returns its series. A code is a folder with a manifest and decks; the native one is
//! part of this program.

mod batch;
mod broken;
mod capture;
mod checks;
mod columns;
mod convention;
mod covered;
mod definition;
mod described;
mod difference;
mod external;
mod failure;
mod feature;
mod folder;
mod format;
mod full_parameters;
mod guard;
mod installation;
mod installed;
mod interrupt;
mod layers;
mod manifest;
mod manifest_error;
mod native;
mod packages;
mod parameters;
mod planned;
mod process;
mod provenance;
mod question;
mod result_files;
mod search_path;
mod settled;
mod task;
mod witness;
mod written;

pub use convention::{ConventionKey, Declaration, KnownConvention, Settled, Unknown};
pub use described::{Code, folder_argument};
pub use failure::{Failure, FailureKind};
pub use feature::Feature;
pub use format::{ParameterFormat, ResultFormat, pyramid_in_log};
pub use full_parameters::{Entry, LISTS, PARAMETERS, SCHEMA as TASK_SCHEMA};
pub use guard::{COMMAND as GUARD_COMMAND, end_like, guard, guard_foreign_programs};
use installation::ExternalCode;
pub use installation::version_in_answer;
pub use installed::{Batching, Finished, InstalledCode, RunContext};
pub use interrupt::Interrupt;
pub use manifest::{Angle, Colour, Definition, Shape, TaskKind};
pub use manifest_error::ManifestError;
use native::{Arithmetic, Native};
pub(crate) use native::{observe, repeat};
pub use planned::{PlannedRun, PlannedTask, PreparedRun};
pub use provenance::{Identity, Provenance, Run, machine};
pub use question::let_interrupt_questions;
pub use result_files::ResultFiles;
pub use settled::SettledCode;
pub use task::Task;
pub use witness::witness_test;
pub use written::{HOME, keep_evidence};

impl Code {
    /// Finds the code as it is installed here; it may be broken. Returns `None` if it is not installed.
    pub fn find(&self) -> Option<Box<dyn InstalledCode>> {
        if self.is_native() {
            return Some(Box::new(Native::new(Arithmetic::Double)));
        }
        let program = self.definition().program.as_ref()?;
        ExternalCode::find(self, program.command.first()?)
    }

    /// Finds the build of this code that computes with more digits, if it is installed: double-double arithmetic for
    /// native, the `higher_precision` program of the manifest for others. The difference between the two is
    /// round-off.
    pub fn find_precise(&self) -> Option<Box<dyn InstalledCode>> {
        if self.is_native() {
            return Some(Box::new(Native::new(Arithmetic::DoubleDouble)));
        }
        let program = self.definition().program.as_ref()?;
        ExternalCode::find(self, program.higher_precision.as_deref()?)
    }
}
