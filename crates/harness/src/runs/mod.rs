//! Finished runs: their entries on disk, the store of a user, the recorded runs of the project, and the schedule
//! that carries out all other runs.

mod contents;
mod entry;
mod findings;
mod impacts;
mod observations;
mod parallel;
mod probe_record;
mod recorded;
mod schedule;
mod selection;
mod store;
mod summary;

pub use contents::{CodesOfToday, Content, contents};
pub use entry::read_entry;
pub use findings::{Finder, Findings};
pub use impacts::{ImpactReading, ImpactRun};
pub use parallel::in_parallel;
pub(crate) use probe_record::probe_address;
pub use probe_record::{Answer, ProbeRecord};
pub(crate) use recorded::RecordedError;
pub use recorded::{Recorded, RecordedRun, Recording};
pub use schedule::{
    CodeOutlook, Outlook, Progress, Reading, RunError, SelectedCode, Settings, Workload, read_all,
};
pub(crate) use schedule::{PlannedCall, ScheduledTask, outlook};
pub use selection::{Selection, oldest_beyond};
pub use store::{EntryKind, Sharing, Store, StoreError, StoredEntry, StoredFile};
pub(crate) use store::{Kind, LockOwner, entries};
pub use summary::RunSummary;
