//! The lock that guards the session files of a store. It is held for less than a millisecond, and the system frees
//! it when its owner dies.

use super::StoreError;
use crate::files::{FileError, Links, open_regular, read_bounded, system_text};
use nix::errno::Errno;
use serde::{Deserialize, Serialize};
use std::fs::{File, TryLockError};
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// Longest wait for the lock; an owner that keeps it longer is suspended.
const PATIENCE: Duration = Duration::from_secs(20);
/// Size limit for the name of an owner, which holds a command line, in bytes.
const LONGEST_OWNER: u64 = 1 << 24;
const POLL_INTERVAL: Duration = Duration::from_millis(2);

/// A running tristack.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LockOwner {
    /// Its process id.
    pub process: u32,
    /// The machine it runs on.
    pub host: String,
    /// Its command line.
    pub command: String,
    /// When it began, UTC.
    pub since: String,
}

impl LockOwner {
    pub(crate) fn this_program() -> Self {
        let host = system_text("/proc/sys/kernel/hostname");
        let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
        Self {
            process: std::process::id(),
            host: host.map_or_else(|| "unknown".to_owned(), |host| host.trim().to_owned()),
            command: words.collect::<Vec<_>>().join(" "),
            since: jiff::Timestamp::now().to_string(),
        }
    }
}

impl std::fmt::Display for LockOwner {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            formatter,
            "process {} on {} (`{}`, since {})",
            self.process, self.host, self.command, self.since
        )
    }
}

/// The lock, held as long as this lives.
pub(super) struct Lock {
    _file: File,
}

impl Lock {
    /// Waits for the lock in the file at `path` and writes `owner` there.
    pub(super) fn acquire(path: &Path, owner: &LockOwner) -> Result<Self, StoreError> {
        Self::acquire_within(PATIENCE, path, owner)
    }

    fn acquire_within(
        patience: Duration,
        path: &Path,
        owner: &LockOwner,
    ) -> Result<Self, StoreError> {
        let mut options = File::options();
        options.create(true).truncate(false).read(true).write(true);
        let file = open_regular(path, Links::Refused, &mut options);
        let mut file = file.map_err(FileError::writing(path))?;
        let start = Instant::now();
        loop {
            match file.try_lock() {
                Ok(()) => break,
                Err(TryLockError::WouldBlock) if start.elapsed() < patience => {
                    std::thread::sleep(POLL_INTERVAL);
                }
                Err(TryLockError::WouldBlock) => return Err(busy(path)),
                Err(TryLockError::Error(error)) => return Err(no_lock(path, error)),
            }
        }
        // Programs that wait too long name the owner in their error; the lock holds without it.
        let _ = overwrite(&mut file, owner.to_string().as_bytes(), 0);
        Ok(Self { _file: file })
    }
}

/// Overwrites the content of `file` in place, because other programs know the file by its lock. The first `kept`
/// bytes are the same already and stay.
pub(super) fn overwrite(file: &mut File, content: &[u8], kept: usize) -> std::io::Result<()> {
    let rest = content.get(kept..).unwrap_or_default();
    file.set_len(kept as u64)?;
    file.seek(SeekFrom::Start(kept as u64))?;
    file.write_all(rest)
}

/// Returns the error for a lock that failed in the file at `path`: most often the file system has no locks.
pub(super) fn no_lock(path: &Path, error: std::io::Error) -> StoreError {
    let missing = [
        Errno::ENOLCK,
        Errno::ENOSYS,
        Errno::EOPNOTSUPP,
        Errno::EINVAL,
    ];
    let found = error.raw_os_error().map(Errno::from_raw);
    match found.is_some_and(|found| missing.contains(&found)) {
        true => StoreError::NoLocks {
            path: path.to_owned(),
            reason: error.to_string(),
        },
        false => FileError::writing(path)(error).into(),
    }
}

fn busy(path: &Path) -> StoreError {
    let owner = read_bounded(path, LONGEST_OWNER, Links::Refused).unwrap_or_default();
    StoreError::Busy {
        path: path.to_owned(),
        owner: String::from_utf8_lossy(&owner).into_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lock_names_its_owner_and_is_free_when_dropped() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("lock");
        let owner = LockOwner::this_program();
        let held = Lock::acquire(&path, &owner).unwrap();
        let refused = Lock::acquire_within(Duration::ZERO, &path, &owner);
        let message = refused.err().unwrap().to_string();
        assert!(message.contains(&format!("process {}", std::process::id())));
        drop(held);
        Lock::acquire_within(Duration::ZERO, &path, &owner).unwrap();
    }
}
