//! Programs in the directories that a manifest names, and in the search path.

use super::manifest_error::refused;
use crate::model::InvalidValue;
use nix::unistd::{AccessFlags, access};
use std::path::{Component, Path, PathBuf};

/// In a manifest: stands for the folder of the manifest.
pub(super) const FOLDER: &str = "{folder}";

/// In a manifest: stands for the search path in the list of directories.
pub(super) const SEARCH_PATH: &str = "$PATH";

/// Finds the program of this name in the search path.
pub(super) fn in_search_path(program: &str) -> Option<PathBuf> {
    first_in_search_path(program, runs)
}

fn first_in_search_path(program: &str, accepts: fn(&Path) -> bool) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let mut directories = std::env::split_paths(&path);
    directories.find_map(|directory| in_directory(&directory, program, accepts))
}

/// Finds the program of this name in one of `directories`, which a manifest names; in the search path if it names
/// none.
///
/// Where directories are named, the search path is one of them only as `$PATH`: it may hold another program of the
/// same name, whose runs would be kept under a wrong name.
pub(super) fn find_program<'a>(
    directories: impl IntoIterator<Item = &'a str>,
    program: &str,
) -> Option<PathBuf> {
    find_first(directories, program, runs)
}

/// Finds a file of this name in the same places that would be the program if it were executable.
pub(super) fn find_not_executable<'a>(
    directories: impl IntoIterator<Item = &'a str>,
    program: &str,
) -> Option<PathBuf> {
    find_first(directories, program, |file| file.is_file() && !runs(file))
}

fn find_first<'a>(
    directories: impl IntoIterator<Item = &'a str>,
    program: &str,
    accepts: fn(&Path) -> bool,
) -> Option<PathBuf> {
    let mut directories = directories.into_iter().peekable();
    if directories.peek().is_none() {
        return first_in_search_path(program, accepts);
    }
    directories.find_map(|directory| match directory {
        SEARCH_PATH => first_in_search_path(program, accepts),
        _ => in_directory(&filled_in(directory)?, program, accepts),
    })
}

fn in_directory(directory: &Path, program: &str, accepts: fn(&Path) -> bool) -> Option<PathBuf> {
    let candidate = std::path::absolute(directory.join(program)).ok()?;
    accepts(&candidate).then_some(candidate)
}

/// Whether `file` is one that this user may execute.
fn runs(file: &Path) -> bool {
    file.is_file() && access(file, AccessFlags::X_OK).is_ok()
}

/// Replaces parts of `directory` such as `$VIRTUAL_ENV` by the values of these environment variables; returns `None`
/// if one of them is unset or empty.
fn filled_in(directory: &str) -> Option<PathBuf> {
    let parts = Path::new(directory).components().map(|part| {
        let Component::Normal(name) = part else {
            return Some(PathBuf::from(part.as_os_str()));
        };
        match name.to_str().and_then(|name| name.strip_prefix('$')) {
            Some(variable) => std::env::var_os(variable)
                .filter(|value| !value.is_empty())
                .map(PathBuf::from),
            None => Some(PathBuf::from(name)),
        }
    });
    parts.collect()
}

/// Refuses a directory that depends on where tristack is started.
pub(super) fn check_directory(directory: &str) -> Result<(), InvalidValue> {
    let rest = directory.strip_prefix(FOLDER);
    let is_definite = match rest {
        Some(rest) => rest.is_empty() || rest.starts_with('/'),
        None => directory.starts_with(['/', '$']),
    };
    if is_definite && !rest.unwrap_or(directory).contains(['{', '}']) {
        return Ok(());
    }
    let accepted = "a directory that begins with `/`, `{folder}` or an environment variable such as `$VIRTUAL_ENV`, or `$PATH`";
    Err(refused("program.search", directory, accepted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variables_are_filled_in_and_one_that_is_not_set_skips_the_directory() {
        let home = std::env::var_os("PATH").expect("tests run with a search path");
        let filled = filled_in("$PATH/bin").expect("it is set");
        assert_eq!(filled, Path::new(&home).join("bin"));
        assert_eq!(filled_in("$TRISTACK_NEVER_SET/bin"), None);
        assert_eq!(filled_in("/opt/x/bin"), Some(PathBuf::from("/opt/x/bin")));
    }

    #[test]
    fn directories_must_be_definite() {
        for good in ["/opt", "{folder}", "{folder}/venv/bin", "$VIRTUAL_ENV/bin"] {
            assert_eq!(check_directory(good), Ok(()));
        }
        for bad in ["venv/bin", "{folder}s/bin", "{home}/bin", "/opt/{deck}", ""] {
            assert!(check_directory(bad).is_err(), "{bad}");
        }
    }
}
