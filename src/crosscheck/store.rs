//! The store of finished runs, addressed by case, engine, version, program and all it was given.

use crate::archive::{Archive, ArchiveError, Identity, ProbeRecord, Provenance, Run};
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
    pub fn get(
        &self,
        identity: &Identity,
        case: &Case,
        deck_hash: &str,
    ) -> Result<Option<Run>, ArchiveError> {
        let run = self.archive.load(&name(identity, case, deck_hash))?;
        Ok(run.filter(|run| {
            let provenance = &run.provenance;
            let same = provenance.identity == *identity && provenance.deck_hash == deck_hash;
            same && run.case == *case
        }))
    }

    /// Keeps a finished run.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn put(&self, run: &Run) -> Result<(), ArchiveError> {
        let Provenance {
            identity,
            deck_hash,
            ..
        } = &run.provenance;
        self.archive
            .save(&name(identity, &run.case, deck_hash), run)
    }

    /// The kept probe with the given address, if there is one.
    ///
    /// # Errors
    /// If there is one, but damaged.
    pub fn probe(&self, address: &str) -> Result<Option<ProbeRecord>, ArchiveError> {
        ProbeRecord::load(&self.probe_path(address))
    }

    /// Keeps a probe.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn put_probe(&self, address: &str, record: &ProbeRecord) -> Result<(), ArchiveError> {
        record.save(&self.probe_path(address))
    }

    fn probe_path(&self, address: &str) -> PathBuf {
        let name = format!("{address}.json");
        self.archive.root().join("probes").join(name)
    }

    /// Where native runs are kept that are under way.
    pub fn checkpoint_directory(&self) -> PathBuf {
        self.archive.root().join("checkpoints")
    }

    /// Where run directories are made; those of failed runs stay.
    pub fn work_directory(&self) -> PathBuf {
        self.archive.root().join("work")
    }
}

fn name(identity: &Identity, case: &Case, deck_hash: &str) -> PathBuf {
    let address = identity.address(case, deck_hash);
    Path::new("runs").join(&address[..2]).join(&address[2..])
}
