//! Files that are either whole or absent: atomic writes, digests, and the errors of both.

mod checksums;
mod draft;
mod error;

pub use checksums::{CHECKSUMS, check, checksums, seal, unseal};
pub use draft::{
    create_parent, remove_abandoned, sync_directory, write_atomically, write_atomically_via,
    write_synced,
};
pub use error::FileError;
