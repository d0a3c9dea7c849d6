//! Files that a program wrote into its run directory: reading results, keeping the files of failed runs.

use crate::files::{Links, open_regular, read_bounded, read_end};
use crate::model::{readable, shown};
use crate::series::SeriesError;
use std::fs::{self, File};
use std::os::unix::fs::MetadataExt;
use std::path::Path;
use tempfile::TempDir;

/// Prefix of the name of the directory that a process uses as its home.
pub const HOME: &str = ".home-";
// Files that receive the output of a program.
pub(super) const STANDARD_OUTPUT: &str = "stdout.txt";
pub(super) const STANDARD_ERROR: &str = "stderr.txt";
const LAST_LINES: usize = 4;
const TAIL_BYTES: u64 = 4096;
/// Two thousand times the longest recorded series.
const LONGEST_READ: u64 = 256 << 20;
/// Files of failed runs, of which there may be hundreds, are cut to this length.
const LONGEST_KEPT: u64 = 4 << 20;

/// Reads the file `name` in `directory`; refuses a link to another file.
pub(super) fn read(directory: &Path, name: &str) -> Result<Vec<u8>, SeriesError> {
    let content = read_bounded(&directory.join(name), LONGEST_READ, Links::Refused);
    content.map_err(|error| SeriesError::absent(format!("cannot read {name}: {error}")))
}

/// Returns the last lines of the `logs` in `directory` and of the program's output, each with the name of its file.
pub(super) fn last_lines(directory: &Path, logs: &[String]) -> Vec<String> {
    let logs = logs.iter().map(String::as_str);
    logs.chain([STANDARD_OUTPUT, STANDARD_ERROR])
        .flat_map(|name| {
            let lines = tail(&directory.join(name));
            lines.into_iter().map(move |line| format!("{name}: {line}"))
        })
        .collect()
}

/// Returns the last line of standard error in `directory`, with the path of its file; `None` if there is none.
pub(super) fn complaint(directory: &Path) -> Option<String> {
    let path = directory.join(STANDARD_ERROR);
    let line = tail(&path).pop()?;
    Some(format!("{}: {line}", shown(&path)))
}

/// Returns the last lines of a file that are not blank; bytes that are not text are replaced.
fn tail(path: &Path) -> Vec<String> {
    let bytes = read_end(path, TAIL_BYTES).unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes);
    let lines = text.lines().filter(|line| !line.trim().is_empty());
    let lines: Vec<String> = lines.map(readable).collect();
    lines[lines.len().saturating_sub(LAST_LINES)..].to_vec()
}

/// Keeps the directory of a failed run. Long files are cut to their beginning, unless they have another name as well.
pub fn keep_evidence(directory: TempDir) {
    let root = directory.keep();
    let Ok(disk) = fs::symlink_metadata(&root).map(|found| found.dev()) else {
        return;
    };
    let mut directories = vec![root];
    while let Some(directory) = directories.pop() {
        let entries = fs::read_dir(directory).into_iter().flatten().flatten();
        for entry in entries {
            match entry.metadata() {
                // Anything on another disk was mounted there.
                Ok(found) if found.dev() != disk => {}
                Ok(found) if found.is_dir() => directories.push(entry.path()),
                Ok(found) if found.is_file() && found.len() > LONGEST_KEPT => {
                    shorten(&entry.path())
                }
                _ => {}
            }
        }
    }
}

/// Cuts a long file. One that cannot be opened, or has another hard link, perhaps elsewhere, stays as it is.
fn shorten(path: &Path) {
    let Ok(file) = open_regular(path, Links::Refused, File::options().write(true)) else {
        return;
    };
    if file.metadata().is_ok_and(|found| found.nlink() == 1) {
        let _ = file.set_len(LONGEST_KEPT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nix::sys::stat::Mode;
    use nix::unistd::mkfifo;
    use std::os::unix::fs::symlink;

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
    fn a_file_that_has_another_name_or_is_elsewhere_keeps_its_length() {
        let directory = tempfile::tempdir().unwrap();
        let [linked, far] = ["linked.txt", "far.txt"].map(|name| directory.path().join(name));
        for path in [&linked, &far] {
            File::create(path)
                .unwrap()
                .set_len(3 * LONGEST_KEPT)
                .unwrap();
        }
        let root = tempfile::tempdir_in(directory.path()).unwrap();
        let inside = |name: &str| root.path().join(name);
        fs::hard_link(&linked, inside("hard.txt")).unwrap();
        symlink(&far, inside("soft.txt")).unwrap();
        symlink(directory.path(), inside("folder")).unwrap();
        mkfifo(&inside("pipe"), Mode::S_IRWXU).unwrap();
        keep_evidence(root);
        for path in [linked, far] {
            assert_eq!(fs::metadata(path).unwrap().len(), 3 * LONGEST_KEPT);
        }
    }

    #[test]
    fn a_result_that_is_no_regular_file_is_not_read() {
        let directory = tempfile::tempdir().unwrap();
        mkfifo(&directory.path().join("log.txt"), Mode::S_IRWXU).unwrap();
        symlink("/dev/zero", directory.path().join("centres.txt")).unwrap();
        for (name, kind) in [
            ("log.txt", "a named pipe"),
            ("centres.txt", "a symbolic link"),
        ] {
            let refusal = read(directory.path(), name).unwrap_err().to_string();
            assert!(
                refusal.contains(&format!("cannot read {name}: it is {kind}")),
                "{refusal}"
            );
        }
    }

    #[test]
    fn a_file_that_is_too_long_is_not_read() {
        let directory = tempfile::tempdir().unwrap();
        let file = File::create(directory.path().join("log.txt")).unwrap();
        file.set_len(LONGEST_READ + 1).unwrap();
        let refusal = read(directory.path(), "log.txt").unwrap_err().to_string();
        let expected = "cannot read log.txt: it has more than 268435456 bytes";
        assert!(refusal.contains(expected), "{refusal}");
        let refusal = read(directory.path(), "none.txt").unwrap_err().to_string();
        assert!(refusal.contains("cannot read none.txt"), "{refusal}");
    }
}
