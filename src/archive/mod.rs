//! Finished runs on disk: a case, its time series, and where they come from.
//!
//! An entry is a directory with `case.json`, `series.csv`, `provenance.json`, and their digests in `SHA256SUMS`.
//! The store of a user and the recorded runs of the project are archives of the same form. Where the series would take too much
//! space, only what was read off it is kept.

mod checksums;
mod draft;
mod entry;
mod probe_record;
mod provenance;
mod reading;

pub use checksums::{seal, unseal};
pub use draft::{create_parent, remove_abandoned, write_atomically, write_atomically_via};
pub use entry::{Archive, ArchiveError, Run};
pub use probe_record::{Answer, ProbeRecord};
pub use provenance::{Identity, Provenance, machine};
pub use reading::Reading;
