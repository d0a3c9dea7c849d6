//! Finished runs on disk: a case, its time series, and where they come from.
//!
//! An entry is a directory with `case.json`, `series.csv` and `provenance.json`. The store of a user and
//! the recorded runs of the project are archives of the same form. Where the series would take too much
//! space, only what was read off it is kept.

mod entry;
mod probe_record;
mod provenance;
mod reading;

pub use entry::{Archive, ArchiveError, Run, write_atomically};
pub use probe_record::{Answer, ProbeRecord};
pub use provenance::{Identity, Provenance, machine};
pub use reading::Reading;
