//! The store of finished runs, addressed by case, engine, version and deck.

use crate::archive::{Archive, ArchiveError, Identity, Run};
use crate::stack::Case;
use std::path::{Path, PathBuf};

/// Finished runs of one user.
#[derive(Debug, Clone)]
pub struct Store {
    archive: Archive,
}

impl Store {
    /// A store at `root`, which is created.
    ///
    /// # Errors
    /// If it cannot be written to.
    pub fn open(root: &Path) -> Result<Self, ArchiveError> {
        let store = Self {
            archive: Archive::new(root),
        };
        let work = store.work_directory();
        std::fs::create_dir_all(&work).map_err(ArchiveError::writing(&work))?;
        tempfile::tempfile_in(&work).map_err(ArchiveError::writing(&work))?;
        Ok(store)
    }

    /// The finished run of `case` by the engine with `identity`, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
    pub fn get(&self, identity: &Identity, case: &Case) -> Result<Option<Run>, ArchiveError> {
        let run = self.archive.load(&name(identity, case))?;
        Ok(run.filter(|run| run.case == *case && run.provenance.identity == *identity))
    }

    /// Keeps a finished run.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn put(&self, run: &Run) -> Result<(), ArchiveError> {
        self.archive
            .save(&name(&run.provenance.identity, &run.case), run)
    }

    /// Where run directories are made; those of failed runs stay.
    pub fn work_directory(&self) -> PathBuf {
        self.archive.root().join("work")
    }
}

fn name(identity: &Identity, case: &Case) -> PathBuf {
    let address = identity.address(case);
    Path::new("runs").join(&address[..2]).join(&address[2..])
}
