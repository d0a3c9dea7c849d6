//! Finished runs: their entries on disk, the store of a user, the recorded runs of the project, and the schedule
//! that carries out all other runs.

mod entry;
mod observations;
mod parallel;
mod probe_record;
mod read_all;
mod recorded;
mod schedule;
mod store;
mod summary;

pub use entry::read_entry;
pub(crate) use observations::observe_all;
pub(crate) use parallel::in_parallel;
pub use probe_record::{Answer, ProbeRecord};
pub use read_all::Reading;
pub(crate) use read_all::read_all;
pub(crate) use recorded::RecordedError;
pub use recorded::{Recorded, RecordedRun, Recording};
pub(crate) use schedule::run_all;
pub use schedule::{Progress, RunError, SelectedCode, Settings, Workload};
pub use store::Store;
pub(crate) use store::{LockOwner, StoreError};
pub use summary::RunSummary;
