//! Case files.

use super::read::{Links, read_bounded};
use crate::model::{Case, CaseError, InvalidValue, PartialCase};
use std::path::Path;

/// Size limit for case files in bytes: a thousand times a file with every key.
const LARGEST: u64 = 1 << 20;

/// Reads and validates a case from a `.toml` or `.json` file.
///
/// # Errors
/// If the file cannot be read or is no valid case.
pub fn read_case(path: &Path) -> Result<Case, CaseError> {
    Case::parse(&case_content(path)?, path)
}

/// Reads and validates a case from a file that may be partial: `complete` fills in what is left out.
pub fn read_case_with(
    path: &Path,
    complete: impl FnOnce(&PartialCase) -> Result<Case, InvalidValue>,
) -> Result<Case, CaseError> {
    Case::parse_with(&case_content(path)?, path, complete)
}

/// Reads the content of a case file.
pub fn case_content(path: &Path) -> Result<Vec<u8>, CaseError> {
    let content = read_bounded(path, LARGEST, Links::Followed);
    content.map_err(|source| CaseError::Unreadable {
        path: path.to_owned(),
        source,
    })
}
