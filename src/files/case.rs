//! Case files.

use super::read::{Links, read_bounded};
use crate::model::{Case, CaseError, InvalidValue, PartialCase};
use std::path::Path;

/// Largest case file that is read, in bytes: a thousand times one with every key.
const LARGEST: u64 = 1 << 20;

impl Case {
    /// Reads and validates a case from a `.toml` or `.json` file.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        Self::parse(&case_content(path)?, path)
    }

    /// The same of a file that may be partial: `complete` fills in what is left out.
    pub fn read_with(
        path: &Path,
        complete: impl FnOnce(&PartialCase) -> Result<Self, InvalidValue>,
    ) -> Result<Self, CaseError> {
        Self::parse_with(&case_content(path)?, path, complete)
    }
}

/// The content of a case file.
pub(crate) fn case_content(path: &Path) -> Result<Vec<u8>, CaseError> {
    let content = read_bounded(path, LARGEST, Links::Followed);
    content.map_err(|source| CaseError::Unreadable {
        path: path.to_owned(),
        source,
    })
}
