//! Passports and verdicts in files.

use crate::files::{FileError, Links, read_bounded};
use crate::output::Problem;
use crate::study::atlas::{NamedPassport, Verdicts};
use std::path::{Path, PathBuf};

/// Largest passport that is read, in bytes; a probe writes some 20 kB.
pub(super) const LARGEST_PASSPORT: u64 = 1 << 20;

/// Largest file of verdicts that is read, in bytes.
const LARGEST_VERDICTS: u64 = 1 << 26;

/// Reads the passport in the file at `path`.
pub(super) fn read_passport(path: &Path) -> Result<NamedPassport, FileError> {
    let text = read_bounded(path, LARGEST_PASSPORT, Links::Followed);
    let text = text.map_err(FileError::reading(path))?;
    NamedPassport::read(text).map_err(|error| FileError::content(path, error))
}

/// Reads all passports in `directory`; every JSON file there must be one, under its permanent name.
pub(super) fn read_passports(directory: &Path) -> Result<Vec<NamedPassport>, FileError> {
    let files = json_files(directory, "tristack probe --passports DIR")?;
    let passports = files.into_iter().map(|(name, path)| {
        let passport = read_passport(&path)?;
        if passport.name == name {
            return Ok(passport);
        }
        let message = format!(
            "its content is that of {}.json: it was changed after it was filed, or renamed",
            passport.name
        );
        Err(FileError::content(&path, message))
    });
    passports.collect()
}

/// Reads all verdicts in `directory`, each under the name of its problem.
pub(super) fn read_verdicts(directory: &Path) -> Result<Vec<Problem>, FileError> {
    let files = json_files(
        directory,
        "crosscheck.json files of tristack crosscheck --out DIR",
    )?;
    let problems = files.into_iter().map(|(name, path)| {
        let text = read_bounded(&path, LARGEST_VERDICTS, Links::Followed);
        let text = text.map_err(FileError::reading(&path))?;
        let verdicts = Verdicts::read(&text);
        let verdicts = verdicts.map_err(|error| FileError::content(&path, error))?;
        Ok((name, text, verdicts))
    });
    problems.collect()
}

/// Returns name and path of every JSON file in `directory`. If there is none, the error says what `made` such files.
fn json_files(directory: &Path, made: &str) -> Result<Vec<(String, PathBuf)>, FileError> {
    let entries = std::fs::read_dir(directory).map_err(FileError::reading(directory))?;
    let paths = entries.flatten().map(|entry| entry.path());
    let named = paths.filter_map(|path| {
        let name = path.file_name()?.to_str()?.strip_suffix(".json")?;
        Some((name.to_owned(), path))
    });
    let mut files: Vec<(String, PathBuf)> = named.collect();
    files.sort();
    if files.is_empty() {
        let message = format!("it holds no JSON file; accepted is a directory of {made}");
        return Err(FileError::content(directory, message));
    }
    Ok(files)
}
