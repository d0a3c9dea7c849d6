//! Files that are written whole or not at all, even if the machine fails.
//!
//! Content goes to a draft, is synced, and replaces the target by a rename, which is synced too.

use super::FileError;
use super::read::{Links, accept_regular, open_directory, open_regular};
use nix::unistd::geteuid;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File, Permissions, TryLockError};
use std::io::{ErrorKind, Write};
use std::os::unix::fs::{MetadataExt, OpenOptionsExt, PermissionsExt};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Number of random letters and digits that end the names of whatever this program may remove because of its name:
/// enough that nobody else's file has such a name.
const RANDOM: usize = 12;

/// Permissions of ordinary files, which the user's umask restricts further.
const AS_USUAL: u32 = 0o666;
/// Permissions of files that nobody else may write to, before the umask.
pub(super) const OWNER_WRITES: u32 = 0o644;
/// Permissions of directories that nobody else may look into.
const OWNER_ALONE: u32 = 0o700;

/// Writes `content` to `path` so that a reader sees the old file or the new one, never a part. Removes drafts of the
/// same file that killed programs left behind.
///
/// # Errors
/// If the file system refuses, or `path` is anything but a regular file or a new name; it is then as it was.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let directory = create_parent(path)?;
    if let Ok(found) = fs::symlink_metadata(path) {
        accept_regular(&found).map_err(FileError::writing(path))?;
    }
    let prefix = draft_prefix(path);
    remove_abandoned(&directory, &prefix);
    write_by_draft(&directory, &prefix, path, content, AS_USUAL)
}

/// Returns the prefix of the names of drafts of the file at `path`.
fn draft_prefix(path: &Path) -> OsString {
    let mut prefix = OsString::from(".");
    prefix.push(path.file_name().unwrap_or_default());
    prefix.push(".draft-");
    prefix
}

/// Whether [`write_atomically`] may have given `name` to a draft of a file in the same directory.
pub(crate) fn is_draft(name: &str) -> bool {
    let name = name.strip_prefix('.');
    let parts = name.and_then(|name| name.rsplit_once(".draft-"));
    parts.is_some_and(|(_, random)| is_random(random.as_bytes()))
}

/// Whether `name` is `prefix` with an ending like those that [`temporary`] makes.
pub(crate) fn is_temporary(name: &OsStr, prefix: &OsStr) -> bool {
    let name = name.as_encoded_bytes();
    let random = name.strip_prefix(prefix.as_encoded_bytes());
    random.is_some_and(is_random)
}

fn is_random(text: &[u8]) -> bool {
    text.len() == RANDOM && text.iter().all(u8::is_ascii_alphanumeric)
}

/// Returns a builder of temporary files and directories whose names [`is_temporary`] recognises.
pub(crate) fn temporary<'a>(prefix: &'a OsStr) -> tempfile::Builder<'a, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).rand_bytes(RANDOM);
    builder
}

/// Writes `content` to `path` through a draft in the directory `drafts`, which the caller cleans up.
pub(super) fn write_by_draft(
    drafts: &Path,
    prefix: &OsStr,
    path: &Path,
    content: &[u8],
    mode: u32,
) -> Result<(), FileError> {
    let directory = create_parent(path)?;
    let write = || try_to_write(drafts, prefix, path, content, mode);
    // Another program may have removed the draft as abandoned before it was locked.
    match write() {
        Err(error) if error.kind() == ErrorKind::NotFound => write(),
        written => written,
    }
    .map_err(FileError::writing(path))?;
    sync_directory(&directory)
}

fn try_to_write(
    drafts: &Path,
    prefix: &OsStr,
    path: &Path,
    content: &[u8],
    mode: u32,
) -> std::io::Result<()> {
    // As readable as any other file of this user, unlike a usual temporary file.
    let mut draft = temporary(prefix)
        .permissions(Permissions::from_mode(mode))
        .tempfile_in(drafts)?;
    // The lock marks the draft as in use. Where files cannot be locked, drafts are merely not cleaned up.
    let _ = draft.as_file().try_lock();
    draft.write_all(content)?;
    draft.as_file().sync_all()?;
    draft.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// Removes this user's files and directories in `directory` that [`temporary`] may have made with `prefix` and that
/// are not locked. A lock ends with the program that holds it.
pub(crate) fn remove_abandoned(directory: &Path, prefix: &OsStr) {
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    let user = geteuid().as_raw();
    let own = entries.filter(|entry| {
        is_temporary(&entry.file_name(), prefix)
            && entry.metadata().is_ok_and(|found| found.uid() == user)
    });
    for entry in own {
        let path = entry.path();
        // Held until the removal is done, so that the program that made it cannot take it into use meanwhile.
        let hold = |file: File| file.try_lock().ok().map(|()| file);
        // Another program may be faster.
        let _ = match entry.file_type() {
            Ok(kind) if kind.is_dir() => open_directory(&path)
                .ok()
                .and_then(hold)
                .map(|_held| fs::remove_dir_all(&path)),
            Ok(kind) if kind.is_file() => open_to_read(&path)
                .ok()
                .and_then(hold)
                .map(|_held| fs::remove_file(&path)),
            _ => None,
        };
    }
}

fn open_to_read(path: &Path) -> std::io::Result<File> {
    open_regular(path, Links::Refused, File::options().read(true))
}

/// Creates a directory in `parent` that is removed when dropped, and locked as long as the returned file is open.
///
/// Another program may take it for abandoned before it is locked; then another one is created under a new name.
pub(crate) fn locked_directory(
    parent: &Path,
    prefix: &str,
    mode: u32,
) -> std::io::Result<(TempDir, File)> {
    for _ in 0..TRIES {
        let directory = temporary(prefix.as_ref())
            .permissions(Permissions::from_mode(mode))
            .tempdir_in(parent)?;
        if let Some(lock) = take_into_use(directory.path())? {
            return Ok((directory, lock));
        }
    }
    let message = format!("{} lost {TRIES} new directories", parent.display());
    Err(std::io::Error::other(message))
}

/// Locks the new directory at `path`; returns `None` if another program is about to remove it, or has removed it.
/// Where files cannot be locked, nothing counts as abandoned.
fn take_into_use(path: &Path) -> std::io::Result<Option<File>> {
    let lock = match open_directory(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        opened => opened?,
    };
    let taken = matches!(lock.try_lock(), Err(TryLockError::WouldBlock)) || !path.exists();
    Ok((!taken).then_some(lock))
}

/// Most attempts to create a directory that no other program takes for abandoned before it is locked.
const TRIES: usize = 100;
/// Prefix of the names of [`Scratch`] directories.
const SCRATCH: &str = "tristack-scratch-";

/// A directory for temporary files. It lies inside another one, so that what a program writes beside it is removed as
/// well: when dropped or, if this program is killed, by the next program that makes a `Scratch`.
pub struct Scratch {
    directory: PathBuf,
    _outer: TempDir,
    _lock: File,
}

impl Scratch {
    /// Creates one in this machine's directory for temporary files, after removing abandoned ones.
    pub fn new() -> std::io::Result<Self> {
        let root = std::env::temp_dir();
        remove_abandoned(&root, SCRATCH.as_ref());
        let (outer, lock) = locked_directory(&root, SCRATCH, OWNER_ALONE)?;
        let directory = outer.path().join("inner");
        fs::create_dir(&directory)?;
        Ok(Self {
            directory,
            _outer: outer,
            _lock: lock,
        })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.directory
    }
}

/// Writes a new file that nobody else may write to. It survives a power failure once its directory is synced.
pub(crate) fn write_synced(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let mut options = File::options();
    let options = options.write(true).create_new(true).mode(OWNER_WRITES);
    let written = options.open(path).and_then(|mut file| {
        file.write_all(content)?;
        file.sync_all()
    });
    written.map_err(FileError::writing(path))
}

/// Creates a file at `path`. An older one is removed first rather than overwritten, since others may have links to
/// it.
pub(crate) fn create_anew(path: &Path) -> std::io::Result<File> {
    remove_older(path)?;
    File::options().write(true).create_new(true).open(path)
}

/// Removes the file at `path` if there is one; never the target of a symbolic link.
pub fn remove_older(path: &Path) -> std::io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Syncs `directory`, so that renames into and out of it survive a power failure.
pub(crate) fn sync_directory(directory: &Path) -> Result<(), FileError> {
    open_directory(directory)
        .and_then(|directory| directory.sync_all())
        .map_err(FileError::writing(directory))
}

/// Returns the parent directory of `target`. If it is missing, creates it and syncs the two directories above it.
pub(crate) fn create_parent(target: &Path) -> Result<PathBuf, FileError> {
    let directory = parent(target);
    if !directory.is_dir() {
        fs::create_dir_all(&directory).map_err(FileError::writing(&directory))?;
        for above in directory.ancestors().skip(1).take(2) {
            sync_directory(&parent(&above.join("file")))?;
        }
    }
    Ok(directory)
}

/// The directory that `path` is in.
fn parent(path: &Path) -> PathBuf {
    let parent = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new(".")).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<OsString> {
        let entries = fs::read_dir(directory).unwrap();
        entries.map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn what_a_killed_program_left_goes_with_the_next_write() {
        let directory = tempfile::tempdir().unwrap();
        let abandoned = directory.path().join(".table.csv.draft-abcdefABCDEF");
        fs::write(abandoned, "half a ta").unwrap();
        write_atomically(&directory.path().join("table.csv"), b"table").unwrap();
        assert_eq!(names(directory.path()), ["table.csv"]);
    }

    #[test]
    fn the_draft_of_a_living_program_is_left_alone() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join(".table.csv.draft-abcdefABCDEF");
        let held = File::create(&path).unwrap();
        held.lock().unwrap();
        write_atomically(&directory.path().join("table.csv"), b"table").unwrap();
        assert!(path.exists());
    }

    #[test]
    fn a_new_directory_that_is_being_removed_is_not_taken_into_use() {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("new");
        assert!(take_into_use(&path).unwrap().is_none());
        fs::create_dir(&path).unwrap();
        let remover = open_directory(&path).unwrap();
        remover.lock().unwrap();
        assert!(take_into_use(&path).unwrap().is_none());
        drop(remover);
        assert!(take_into_use(&path).unwrap().is_some());
    }

    /// Several threads clean up while others begin: no thread loses its directory.
    #[test]
    fn no_directory_is_lost_to_one_who_cleans_up() {
        let parent = tempfile::tempdir().unwrap();
        std::thread::scope(|threads| {
            for _ in 0..4 {
                threads.spawn(|| {
                    for _ in 0..100 {
                        remove_abandoned(parent.path(), "draft-".as_ref());
                        let made = locked_directory(parent.path(), "draft-", OWNER_ALONE);
                        let (directory, _lock) = made.expect("a directory");
                        let inner = directory.path().join("inner");
                        fs::create_dir(inner).expect("its directory is there");
                    }
                });
            }
        });
        assert!(names(parent.path()).is_empty());
    }

    #[test]
    fn what_only_looks_like_a_draft_or_is_none_is_left_alone() {
        let directory = tempfile::tempdir().unwrap();
        let kept = [
            ".table.csv.draft-backup",
            ".table.csv.draft-of-yesterday",
            ".table.csv.draft-",
            ".other.csv.draft-abcdefABCDEF",
        ];
        for name in kept {
            fs::write(directory.path().join(name), "mine").unwrap();
        }
        let link = directory.path().join(".table.csv.draft-abcdefABCDEF");
        std::os::unix::fs::symlink("elsewhere", &link).unwrap();
        write_atomically(&directory.path().join("table.csv"), b"table").unwrap();
        assert_eq!(names(directory.path()).len(), kept.len() + 2);
    }

    #[test]
    fn a_link_or_a_device_is_not_replaced() {
        let directory = tempfile::tempdir().unwrap();
        let [mine, link] = ["mine", "table.csv"].map(|name| directory.path().join(name));
        fs::write(&mine, "mine").unwrap();
        std::os::unix::fs::symlink(&mine, &link).unwrap();
        let refusal = write_atomically(&link, b"table").unwrap_err().to_string();
        assert!(
            refusal.ends_with("it is a symbolic link; accepted is a regular file"),
            "{refusal}"
        );
        assert!(link.is_symlink());
        assert_eq!(fs::read(&mine).unwrap(), b"mine");
        assert!(write_atomically(Path::new("/dev/null"), b"table").is_err());
    }

    #[test]
    fn a_file_is_created_anew_without_touching_what_shares_its_name() {
        let directory = tempfile::tempdir().unwrap();
        let [mine, link, twin] = ["mine", "link", "twin"].map(|name| directory.path().join(name));
        fs::write(&mine, "mine").unwrap();
        std::os::unix::fs::symlink(&mine, &link).unwrap();
        fs::hard_link(&mine, &twin).unwrap();
        for path in [&link, &twin] {
            create_anew(path).unwrap().write_all(b"new").unwrap();
            assert_eq!(fs::read(path).unwrap(), b"new");
        }
        assert_eq!(fs::read(&mine).unwrap(), b"mine");
    }

    #[test]
    fn a_file_that_cannot_be_written_stays_as_it_was() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("table.csv");
        fs::create_dir(&path).unwrap();
        assert!(write_atomically(&path, b"table").is_err());
        assert!(path.is_dir());
        assert_eq!(names(directory.path()), ["table.csv"]);
    }
}
