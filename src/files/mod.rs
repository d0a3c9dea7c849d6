//! Files: read without waiting, written whole or not at all, never those of anybody else; digests, and the errors of all
//! that.

mod case;
mod checksums;
mod draft;
mod error;
mod read;
mod results;

pub use case::read_case;
pub(crate) use case::{case_content, read_case_with};
pub(crate) use checksums::{CHECKSUMS, check, checksums, read_sealed, write_sealed};
pub use checksums::{seal, unseal};
pub(crate) use draft::{
    Scratch, create_anew, create_parent, is_draft, is_temporary, locked_directory,
    remove_abandoned, remove_older, sync_directory, temporary, write_atomically, write_synced,
};
pub use error::FileError;
pub(crate) use error::parse_json;
pub(crate) use read::{
    Links, kind, open_regular, read_beginning, read_bounded, read_end, system_text,
};
pub(crate) use results::Layout;
