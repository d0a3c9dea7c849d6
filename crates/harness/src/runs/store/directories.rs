//! The directories of a store: adopted or created, and nobody else's.

use super::StoreError;
use crate::files::{FileError, create_parent, is_draft, kind, sync_directory};
use crate::model::shown;
use nix::unistd::geteuid;
use std::fs::{self, DirBuilder, Metadata};
use std::io::ErrorKind;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};

/// The directories in a store, each of which may be absent.
const NAMES: [&str; 8] = [
    "runs",
    "probes",
    "observations",
    "impacts",
    "sessions",
    "work",
    "checkpoints",
    "quarantine",
];
/// Write permission for the group and for all others.
const OTHERS_WRITE: u32 = 0o022;

/// Who may write to a store.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sharing {
    /// The user who runs this program and root.
    Private,
    /// Whoever has permission to write to the directory; everything there is believed.
    Shared,
}

/// A store and the directories in it. None may be a symbolic link; in a private store none may belong to another user
/// or be writable for others. So whatever is in such a directory was put there by its owner or by root.
#[derive(Debug)]
pub(super) struct Directories {
    root: PathBuf,
    sharing: Sharing,
}

impl Directories {
    /// Opens the store at `root`; creates it if nothing is there.
    pub(super) fn open(root: &Path, sharing: Sharing) -> Result<Self, StoreError> {
        let directories = Self {
            root: root.to_owned(),
            sharing,
        };
        if let Err(error) = fs::metadata(root)
            && error.kind() == ErrorKind::NotFound
        {
            directories.create_root()?;
        }
        // The user may name a link to the store.
        let found = fs::metadata(root).map_err(FileError::writing(root))?;
        directories.accept(root, &found)?;
        for name in NAMES {
            directories.check(&root.join(name))?;
        }
        Ok(directories)
    }

    fn create_root(&self) -> Result<(), FileError> {
        let writing = || FileError::writing(&self.root);
        let parent = create_parent(&self.root)?;
        let mut builder = DirBuilder::new();
        if self.sharing == Sharing::Private {
            builder.mode(0o700);
        }
        match builder.create(&self.root) {
            // Another program has just created it.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
            Err(error) => Err(writing()(error)),
            Ok(()) => sync_directory(&parent),
        }
    }

    /// The store.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Permissions of new directories in the store, which the umask restricts further.
    pub(super) fn mode(&self) -> u32 {
        match self.sharing {
            Sharing::Private => 0o777 & !OTHERS_WRITE,
            Sharing::Shared => 0o777,
        }
    }

    /// Returns the path of `name` in the store, where a file or a directory may be.
    ///
    /// # Errors
    /// If one of the directories on the way there is a link or not the store's own.
    pub(super) fn place(&self, name: impl AsRef<Path>) -> Result<PathBuf, FileError> {
        let mut path = self.root.clone();
        for part in name.as_ref() {
            if path != self.root {
                self.check(&path)?;
            }
            path.push(part);
        }
        Ok(path)
    }

    /// Refuses what is at `path`, unless it is a directory of the store or there is nothing.
    pub(super) fn check(&self, path: &Path) -> Result<(), FileError> {
        match fs::symlink_metadata(path) {
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
            Err(error) => Err(FileError::reading(path)(error)),
            Ok(found) => self.accept(path, &found),
        }
    }

    /// Returns the directory `name` in the store and creates it if there is none.
    pub(super) fn create(&self, name: impl AsRef<Path>) -> Result<PathBuf, FileError> {
        let path = self.place(&name)?;
        self.check(&path)?;
        let mut above = self.root.clone();
        for part in name.as_ref() {
            let directory = above.join(part);
            match DirBuilder::new().mode(self.mode()).create(&directory) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(FileError::writing(&directory)(error)),
                Ok(()) => sync_directory(&above)?,
            }
            above = directory;
        }
        Ok(path)
    }

    /// Returns the first name in the directory, in alphabetical order, apart from drafts. The directory may not have
    /// been a store yet.
    pub(super) fn first_file(&self) -> Result<Option<String>, FileError> {
        let reading = || FileError::reading(&self.root);
        let entries = fs::read_dir(&self.root).map_err(reading())?;
        let names = entries.map(|entry| Ok(shown(Path::new(&entry?.file_name()))));
        let names: Result<Vec<String>, std::io::Error> = names.collect();
        // Drafts of the marker are left by a program that is opening the store at the same time, or was killed while
        // it did.
        let files = names.map_err(reading())?.into_iter();
        Ok(files.filter(|name| !is_draft(name)).min())
    }

    /// Refuses what is at `path` unless it is a directory of the store.
    fn accept(&self, path: &Path, found: &Metadata) -> Result<(), FileError> {
        let refused = |message: String| Err(FileError::content(path, message));
        if !found.is_dir() {
            let kind = kind(found);
            return refused(format!("it is {kind}; accepted in a store is a directory"));
        }
        if self.sharing == Sharing::Shared {
            return Ok(());
        }
        let trust = "say --shared-store if you trust everybody who may write there";
        let (user, mode) = (geteuid().as_raw(), found.mode() & 0o7777);
        if ![user, 0].contains(&found.uid()) {
            let owner = found.uid();
            return refused(format!(
                "it belongs to user {owner}, who may write to it, and you are user {user}; choose another directory with \
                 --store, or {trust}"
            ));
        }
        if mode & OTHERS_WRITE != 0 {
            return refused(format!(
                "others than its owner may write to it (mode {mode:03o}); forbid that with chmod -R go-w, or {trust}"
            ));
        }
        Ok(())
    }
}
