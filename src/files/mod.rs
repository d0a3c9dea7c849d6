//! Files that are either whole or absent: atomic writes, digests, and the errors of both.

mod checksums;
mod draft;
mod error;

pub(crate) use checksums::{CHECKSUMS, check, checksums, read_sealed, write_sealed};
pub use checksums::{seal, unseal};
pub(crate) use draft::{
    create_parent, locked_directory, remove_abandoned, sync_directory, write_atomically,
    write_synced,
};
pub use error::FileError;
pub(crate) use error::parse_json;
