//! Directories for results, which may hold nothing but what the command itself wrote there.

use super::FileError;
use super::draft::{is_draft, is_temporary};
use super::read::{Links, kind, read_bounded};
use crate::model::shown;
use std::ffi::OsStr;
use std::fs::{self, FileType};
use std::path::{Path, PathBuf};

/// Size limit for witness files, in bytes.
const LARGEST_WITNESS: u64 = 1 << 28;

/// The files that a command writes into a directory for its results, by which it recognises the directory later.
///
/// A directory is the command's own if it is empty, or if it holds the witness and nothing else but files of the
/// layout. Any other is refused, so that nobody else's files are ever replaced, removed or mistaken for results.
pub struct Layout {
    /// The file that is written first, so that a directory with any of the files has the witness.
    pub witness: &'static str,
    /// Whether this program wrote a witness with this content.
    pub is_ours: fn(&[u8]) -> bool,
    /// The other files, as paths in the directory; one `*` in a name stands for letters, digits, `-`, `_` and `.`.
    pub files: Vec<String>,
    /// Whether others may put anything into the directory once the witness is there. Then only files of the layout
    /// are replaced.
    pub shared: bool,
    /// Prefix of the names of temporary directories, which a killed program leaves behind.
    pub scratch: Option<&'static str>,
}

impl Layout {
    /// Returns the layout of a command that writes tables: the JSON table `witness`, and `files`.
    pub fn tables(witness: &'static str, files: &[&str]) -> Self {
        Self {
            witness,
            is_ours: is_table,
            files: files.iter().map(|&name| name.to_owned()).collect(),
            shared: false,
            scratch: None,
        }
    }

    /// Creates `directory`, or checks that it is one of this layout; then checks that files can be written there.
    ///
    /// # Errors
    /// If the directory holds anything else, or cannot be written to.
    pub fn claim(&self, directory: &Path) -> Result<(), FileError> {
        fs::create_dir_all(directory).map_err(FileError::writing(directory))?;
        let known = self.has_witness(directory);
        if !(known && self.shared) {
            let results = self.results(directory)?;
            if let Some((path, kind)) = results.first().filter(|_| !known) {
                return Err(self.foreign(directory, path, *kind));
            }
        }
        tempfile::tempfile_in(directory).map_err(FileError::writing(directory))?;
        Ok(())
    }

    /// Lists the results in `directory`; fails if it holds anything else.
    fn results(&self, directory: &Path) -> Result<Vec<(PathBuf, FileType)>, FileError> {
        let mut results = Vec::new();
        let mut open = vec![PathBuf::new()];
        while let Some(folder) = open.pop() {
            let found = below(directory, &folder);
            for (path, kind) in found.map_err(FileError::reading(&directory.join(&folder)))? {
                if kind.is_dir() && self.is_scratch(&path) {
                    continue;
                }
                if !self.knows(&path, kind) {
                    return Err(self.foreign(directory, &path, kind));
                }
                match kind.is_dir() {
                    true => open.push(path),
                    false if is_own_draft(&path) => {}
                    false => results.push((path, kind)),
                }
            }
        }
        Ok(results)
    }

    /// Whether the command may have written what lies at `path`, relative to the directory.
    fn knows(&self, path: &Path, kind: FileType) -> bool {
        let Some(path_text) = path.to_str() else {
            return false;
        };
        let mut names = std::iter::once(self.witness).chain(self.files.iter().map(String::as_str));
        if kind.is_dir() {
            return names.any(|name| {
                Path::new(name)
                    .ancestors()
                    .skip(1)
                    .any(|above| above == path)
            });
        }
        kind.is_file() && (is_own_draft(path) || names.any(|name| matches(name, path_text)))
    }

    fn is_scratch(&self, path: &Path) -> bool {
        let scratch = self.scratch.map(OsStr::new);
        scratch.is_some_and(|prefix| is_temporary(path.as_os_str(), prefix))
    }

    fn has_witness(&self, directory: &Path) -> bool {
        let content = read_bounded(
            &directory.join(self.witness),
            LARGEST_WITNESS,
            Links::Refused,
        );
        content.is_ok_and(|content| (self.is_ours)(&content))
    }

    fn foreign(&self, directory: &Path, path: &Path, found: FileType) -> FileError {
        let name = shown(path);
        let what = match found {
            found if found.is_file() && self.knows(path, found) => format!(
                "it holds `{name}`, but no `{}` that tristack wrote",
                self.witness
            ),
            found if found.is_file() => {
                format!("it holds `{name}`, which this command does not write")
            }
            _ => {
                let found = fs::symlink_metadata(directory.join(path));
                let kind = found.map_or("something else", |found| kind(&found));
                format!("it holds `{name}`, {kind} that this command does not make")
            }
        };
        let accepted = "accepted is a new or empty directory, or one with nothing but earlier results of the same \
                        command";
        FileError::content(directory, format!("{what}; {accepted}"))
    }
}

/// Whether JSON with this content is a table of this program.
fn is_table(content: &[u8]) -> bool {
    let start = &content[..content.len().min(200)];
    String::from_utf8_lossy(start).contains("\"schema\": \"tristack/")
}

fn is_own_draft(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    name.is_some_and(is_draft)
}

/// Whether `path` matches `name`, in which one `*` stands for one or more letters, digits, `-`, `_` and `.`.
fn matches(name: &str, path: &str) -> bool {
    let Some((before, after)) = name.split_once('*') else {
        return name == path;
    };
    let rest = path.strip_prefix(before);
    let middle = rest.and_then(|rest| rest.strip_suffix(after));
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte);
    middle.is_some_and(|middle| !middle.is_empty() && middle.bytes().all(plain))
}

/// Lists the entries of `directory` by path and kind, sorted by path. All paths are relative to `root`; symbolic
/// links are not followed.
fn below(root: &Path, directory: &Path) -> std::io::Result<Vec<(PathBuf, FileType)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(root.join(directory))? {
        let entry = entry?;
        found.push((directory.join(entry.file_name()), entry.file_type()?));
    }
    found.sort_by(|(one, _), (other, _)| one.cmp(other));
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout() -> Layout {
        Layout {
            witness: "table.json",
            is_ours: is_table,
            files: vec!["table.csv".to_owned(), "figures/*.svg".to_owned()],
            shared: false,
            scratch: Some(".home-"),
        }
    }

    const WITNESS: &str = "{\n  \"schema\": \"tristack/table/1\"";

    /// Claims a directory with these files; a name that ends in `/` is a directory.
    fn claim(files: &[(&str, &str)]) -> Result<(), String> {
        let root = tempfile::tempdir().unwrap();
        for (name, content) in files {
            let path = root.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            match name.ends_with('/') {
                true => fs::create_dir(path).unwrap(),
                false => fs::write(path, content).unwrap(),
            }
        }
        let names = || below(root.path(), Path::new("")).unwrap().len();
        let before = names();
        let claimed = layout().claim(root.path());
        assert_eq!(names(), before);
        claimed.map_err(|error| error.to_string())
    }

    #[test]
    fn an_empty_directory_and_one_with_earlier_results_are_accepted() {
        for files in [
            vec![],
            vec![(".table.csv.draft-abcdefABCDEF", "half a ta")],
            vec![("table.json", WITNESS)],
            vec![
                ("table.json", WITNESS),
                ("table.csv", ""),
                ("figures/a-1.svg", ""),
            ],
            vec![("table.json", WITNESS), ("figures/", "")],
            vec![(".home-abcdefABCDEF/.cache/anything", "")],
        ] {
            assert_eq!(claim(&files), Ok(()), "{files:?}");
        }
    }

    #[test]
    fn a_directory_with_anything_else_is_refused_and_the_thing_is_named() {
        let own = ("table.json", WITNESS);
        for (files, named) in [
            (
                vec![("notes.md", "mine")],
                "`notes.md`, which this command does not write",
            ),
            (vec![own, ("notes.md", "mine")], "`notes.md`, which"),
            (
                vec![("table.csv", "mine")],
                "`table.csv`, but no `table.json` that tristack wrote",
            ),
            (
                vec![("table.json", "{}")],
                "`table.json`, but no `table.json` that",
            ),
            (vec![own, ("mine/", "")], "`mine`, a directory that"),
            (
                vec![own, (".home-mine/", "")],
                "`.home-mine`, a directory that",
            ),
            (
                vec![own, ("figures/mine.png", "")],
                "`figures/mine.png`, which",
            ),
            (
                vec![own, ("table.csv/", "")],
                "`table.csv`, a directory that",
            ),
            (vec![own, ("figures/.svg", "")], "`figures/.svg`, which"),
            (
                vec![own, (".table.csv.draft-backup", "")],
                "`.table.csv.draft-backup`, which",
            ),
        ] {
            let refusal = claim(&files).unwrap_err();
            assert!(refusal.contains(named), "{refusal}");
            assert!(
                refusal.contains("accepted is a new or empty directory"),
                "{refusal}"
            );
        }
    }

    #[test]
    fn a_shared_directory_may_hold_anything_once_its_witness_is_there() {
        let shared = Layout {
            shared: true,
            ..layout()
        };
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("notes.md"), "mine").unwrap();
        let refusal = shared.claim(root.path()).unwrap_err().to_string();
        assert!(refusal.contains("`notes.md`, which"), "{refusal}");
        fs::write(root.path().join("table.json"), WITNESS).unwrap();
        shared.claim(root.path()).unwrap();
        assert!(layout().claim(root.path()).is_err());
    }

    #[test]
    fn a_link_in_the_place_of_a_result_is_refused() {
        let root = tempfile::tempdir().unwrap();
        fs::write(root.path().join("table.json"), WITNESS).unwrap();
        std::os::unix::fs::symlink("/etc/passwd", root.path().join("table.csv")).unwrap();
        let refusal = layout().claim(root.path()).unwrap_err().to_string();
        assert!(
            refusal.contains("`table.csv`, a symbolic link that"),
            "{refusal}"
        );
    }
}
