//! Case files.

use super::read::{Links, read_bounded};
use crate::model::{Case, CaseError};
use std::path::Path;

/// Largest case file that is read, in bytes: a thousand times one with every key.
const LARGEST: u64 = 1 << 20;

impl Case {
    /// Reads and validates a case from a `.toml` or `.json` file.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let content = read_bounded(path, LARGEST, Links::Followed).map_err(|source| {
            CaseError::Unreadable {
                path: path.to_owned(),
                source,
            }
        })?;
        Self::parse(&content, path)
    }
}
