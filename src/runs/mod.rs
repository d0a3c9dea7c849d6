//! Finished runs: their entries on disk, the store of a user, the recorded runs of the project, and the schedule
//! that carries out all other runs.

mod entry;
mod observations;
mod parallel;
mod probe_record;
mod recorded;
mod schedule;
mod store;
mod summary;

pub use entry::Archive;
pub(crate) use parallel::in_parallel;
pub use probe_record::{Answer, ProbeRecord};
pub use recorded::{Recorded, RecordedError, RecordedRun, Recording};
pub(crate) use schedule::read_all;
pub use schedule::{Progress, Reading, RunError, ScheduledTask, SelectedCode, Settings, Workload};
pub use store::{Kind, LockOwner, Store, StoreError};
pub use summary::RunSummary;
