//! Finished runs: their entries on disk, the store of a user, the recorded runs of the project, and the schedule
//! that carries out all other runs.

mod contents;
mod entry;
mod impacts;
mod observations;
mod parallel;
mod probe_record;
mod recorded;
mod schedule;
mod selection;
mod store;
mod summary;

pub(crate) use contents::{CodesOfToday, Content, contents};
pub use entry::read_entry;
pub use impacts::{ImpactReading, ImpactRun};
pub(crate) use parallel::in_parallel;
pub(crate) use probe_record::probe_address;
pub use probe_record::{Answer, ProbeRecord};
pub(crate) use recorded::RecordedError;
pub use recorded::{Recorded, RecordedRun, Recording};
pub(crate) use schedule::{
    CodeOutlook, Outlook, PlannedCall, Reading, ScheduledTask, outlook, read_all,
};
pub use schedule::{Progress, RunError, SelectedCode, Settings, Workload};
pub(crate) use selection::{Selection, oldest_beyond};
pub use store::Store;
pub(crate) use store::{
    EntryKind, Kind, LockOwner, Sharing, StoreError, StoredEntry, StoredFile, entries,
};
pub use summary::RunSummary;
