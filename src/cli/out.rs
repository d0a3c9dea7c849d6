//! Directories and files for results.

use super::{ExitStatus, complain};
use crate::files::{FileError, Layout, write_atomically};
use crate::model::shown;
use std::path::Path;

/// The directory for the results of a command, if one is given.
pub(super) struct Out<'a> {
    directory: Option<&'a Path>,
    witness: &'static str,
}

impl<'a> Out<'a> {
    /// Creates the directory, or makes sure that it holds nothing but earlier results of `layout`.
    pub(super) fn claim(directory: Option<&'a Path>, layout: &Layout) -> Result<Self, FileError> {
        if let Some(directory) = directory {
            layout.claim(directory)?;
        }
        Ok(Self {
            directory,
            witness: layout.witness,
        })
    }

    /// Takes a `directory` that has been claimed for a layout with this `witness`.
    pub(super) fn claimed(directory: &'a Path, witness: &'static str) -> Self {
        let directory = Some(directory);
        Self { directory, witness }
    }

    /// Writes files if the result `is_whole`: after an interrupt that left rows out, nothing is written.
    pub(super) fn write_whole<N: AsRef<str>, C: AsRef<[u8]>>(
        &self,
        is_whole: bool,
        files: impl FnOnce() -> Vec<(N, C)>,
    ) -> ExitStatus {
        match is_whole {
            true => self.write(files),
            false => ExitStatus::Success,
        }
    }

    /// Writes files, given by name and content, if there is a directory for them. A file that cannot be written is
    /// named on standard error.
    pub(super) fn write<N: AsRef<str>, C: AsRef<[u8]>>(
        &self,
        files: impl FnOnce() -> Vec<(N, C)>,
    ) -> ExitStatus {
        let Some(directory) = self.directory else {
            return ExitStatus::Success;
        };
        let mut files = files();
        // The witness, by which the directory is recognized, is written first, so that nothing is there without it.
        files.sort_by_key(|(name, _)| name.as_ref() != self.witness);
        let mut worst = ExitStatus::Success;
        for (name, content) in &files {
            let status = write(&directory.join(name.as_ref()), content.as_ref());
            worst = worst.max(status);
            if status != ExitStatus::Success && name.as_ref() == self.witness {
                complain!("nothing else is written to {}", shown(directory));
                break;
            }
        }
        worst
    }
}

/// Writes a file; one that cannot be written is named on standard error.
pub(super) fn write(path: &Path, content: &[u8]) -> ExitStatus {
    match write_atomically(path, content) {
        Ok(()) => ExitStatus::Success,
        Err(error) => {
            let (file, error) = (shown(path), shown(Path::new(&error.to_string())));
            match error.contains(&file) {
                true => complain!("error: {error}"),
                // It is the directory that cannot be written.
                false => complain!("error: cannot write {file}: {error}"),
            }
            ExitStatus::NotWritten
        }
    }
}
