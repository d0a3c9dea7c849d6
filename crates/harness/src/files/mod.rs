//! Files: reads that never wait, writes that are whole or not at all and never touch anybody else's files, digests,
//! and the errors of all these.

mod case;
mod checksums;
mod draft;
mod error;
mod read;
mod results;

pub use case::{case_content, read_case, read_case_with};
pub(crate) use checksums::{CHECKSUMS, check, checksums, read_sealed, write_sealed};
pub use checksums::{seal, unseal};
pub use draft::{Scratch, remove_older, write_atomically};
pub(crate) use draft::{
    create_anew, create_parent, is_draft, is_temporary, locked_directory, remove_abandoned,
    sync_directory, temporary, write_synced,
};
pub use error::FileError;
pub(crate) use error::parse_json;
pub use read::{Links, read_bounded, system_text};
pub(crate) use read::{kind, open_regular, read_beginning, read_end, refuse_linked};
pub use results::Layout;
