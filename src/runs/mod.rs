//! Finished runs: their entries on disk, the store of a user, the recorded runs of the project, and the schedule
//! that carries out all other runs.

mod entry;
mod impacts;
mod observations;
mod parallel;
mod probe_record;
mod recorded;
mod schedule;
mod store;
mod summary;

pub use entry::read_entry;
pub use impacts::{ImpactReading, ImpactRun};
pub(crate) use parallel::in_parallel;
pub use probe_record::{Answer, ProbeRecord};
pub(crate) use recorded::RecordedError;
pub use recorded::{Recorded, RecordedRun, Recording};
pub use schedule::{Progress, RunError, SelectedCode, Settings, Workload};
pub(crate) use schedule::{Reading, ScheduledTask, read_all};
pub use store::Store;
pub(crate) use store::{Kind, LockOwner, Sharing, StoreError};
pub use summary::RunSummary;
