//! Programs in the search path.

use nix::unistd::{AccessFlags, access};
use std::path::PathBuf;

/// The program of this name in the search path.
pub(super) fn in_search_path(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path)
        .filter_map(|directory| std::path::absolute(directory.join(program)).ok())
        .find(|candidate| candidate.is_file() && access(candidate, AccessFlags::X_OK).is_ok())
}
