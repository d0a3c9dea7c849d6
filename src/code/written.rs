//! Files that a program wrote into its run directory: reading results, keeping the files of failed runs.

use crate::series::SeriesError;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;
use tempfile::TempDir;

/// Two thousand times the longest recorded series.
const LONGEST_READ: u64 = 256 << 20;
/// Files of failed runs, of which there may be hundreds, are cut to this length.
const LONGEST_KEPT: u64 = 4 << 20;

/// The file `name` in `directory`.
pub(super) fn read(directory: &Path, name: &str) -> Result<Vec<u8>, SeriesError> {
    let mut content = Vec::new();
    File::open(directory.join(name))
        .and_then(|file| file.take(LONGEST_READ + 1).read_to_end(&mut content))
        .map_err(|error| SeriesError::absent(format!("cannot read {name}: {error}")))?;
    if content.len() as u64 > LONGEST_READ {
        let message = format!("{name} is longer than {LONGEST_READ} bytes, the most that is read");
        return Err(SeriesError::absent(message));
    }
    Ok(content)
}

/// Keeps the directory of a failed run, with the beginning of every long file.
pub(crate) fn keep_evidence(directory: TempDir) {
    let mut directories = vec![directory.keep()];
    while let Some(directory) = directories.pop() {
        let entries = fs::read_dir(directory).into_iter().flatten().flatten();
        for entry in entries {
            match entry.file_type() {
                Ok(kind) if kind.is_dir() => directories.push(entry.path()),
                Ok(kind) if kind.is_file() => shorten(&entry.path()),
                _ => {}
            }
        }
    }
}

/// Cuts a long file; one that cannot be cut stays as it is.
fn shorten(path: &Path) {
    if fs::metadata(path).is_ok_and(|data| data.len() > LONGEST_KEPT) {
        let file = File::options().write(true).open(path);
        let _ = file.and_then(|file| file.set_len(LONGEST_KEPT));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_of_a_failed_run_is_short() {
        let directory = tempfile::tempdir().unwrap();
        let root = tempfile::tempdir_in(directory.path()).unwrap();
        let path = root.path().to_owned();
        fs::create_dir(path.join("case-0")).unwrap();
        for name in ["case-0/log.txt", "stdout.txt"] {
            let file = File::create(path.join(name)).unwrap();
            file.set_len(3 * LONGEST_KEPT).unwrap();
        }
        fs::write(path.join("case-0/parameters.json"), "{}").unwrap();
        keep_evidence(root);
        let length = |name: &str| fs::metadata(path.join(name)).unwrap().len();
        assert_eq!(length("case-0/log.txt"), LONGEST_KEPT);
        assert_eq!(length("stdout.txt"), LONGEST_KEPT);
        assert_eq!(length("case-0/parameters.json"), 2);
    }

    #[test]
    fn a_file_that_is_too_long_is_not_read() {
        let directory = tempfile::tempdir().unwrap();
        let file = File::create(directory.path().join("log.txt")).unwrap();
        file.set_len(LONGEST_READ + 1).unwrap();
        let refusal = read(directory.path(), "log.txt").unwrap_err().to_string();
        assert!(refusal.contains("log.txt is longer than"), "{refusal}");
        let refusal = read(directory.path(), "none.txt").unwrap_err().to_string();
        assert!(refusal.contains("cannot read none.txt"), "{refusal}");
    }
}
