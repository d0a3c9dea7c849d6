//! Sessions: the programs that use a store at the same time, and the runs that each of them claims.
//!
//! A session is a file that its program keeps locked, and a directory for unfinished work. The system frees the lock
//! when the program ends, however it ends: an unlocked file belongs to a dead program, whose leftovers the next one
//! removes.

use super::directories::Directories;
use super::lock::{Lock, no_lock, overwrite};
use super::{CHECKPOINTS, LockOwner, StoreError};
use crate::files::{
    FileError, Links, is_temporary, open_regular, read_bounded, remove_abandoned, temporary,
};
use nix::sys::statfs::{
    BTRFS_SUPER_MAGIC, EXT4_SUPER_MAGIC, OVERLAYFS_SUPER_MAGIC, TMPFS_MAGIC, XFS_SUPER_MAGIC,
    fstatfs,
};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeSet, HashMap};
use std::ffi::OsStr;
use std::fs::{self, DirBuilder, File, Permissions};
use std::io::Write;
use std::os::unix::fs::{DirBuilderExt, PermissionsExt};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

// Directories of a store.
const SESSIONS: &str = "sessions";
const WORK: &str = "work";
/// Prefix of the name of every session.
const PREFIX: &str = "session-";
const ENDING: &str = ".json";
/// Prefix of the name of a session file that does not say its owner yet.
const DRAFT: &str = "draft-";
/// Permissions of a session file, which other users of a shared store may read.
const READABLE: u32 = 0o644;
/// Permissions of its directory for unfinished work.
const PRIVATE: u32 = 0o700;
/// Size limit for session files, in bytes: that of a million runs.
const LARGEST: u64 = 1 << 27;

/// The name of a session: that of its file, without its ending, and of its directory for unfinished work.
#[derive(Debug, Clone, PartialEq, Eq)]
struct SessionName(String);

impl SessionName {
    /// Returns the name of the session with this `file`; `None` if the file is not that of a session.
    fn of(file: &OsStr) -> Option<Self> {
        let name = file.to_str()?.strip_suffix(ENDING)?;
        let is_own = is_temporary(name.as_ref(), PREFIX.as_ref());
        is_own.then(|| Self(name.to_owned()))
    }

    /// Returns the name of the session whose file is still the `draft`.
    fn of_draft(draft: &Path) -> Self {
        let name = draft.file_name().unwrap_or_default().to_string_lossy();
        Self(format!("{PREFIX}{}", name.trim_start_matches(DRAFT)))
    }

    fn file(&self, root: &Path) -> PathBuf {
        root.join(SESSIONS).join(format!("{}{ENDING}", self.0))
    }

    fn work(&self, root: &Path) -> PathBuf {
        root.join(WORK).join(&self.0)
    }
}

/// The content of a session file. The owner stands first, never changes and is never written again: it can be read
/// whenever the program is killed.
#[derive(Debug, Serialize, Deserialize)]
struct Claims {
    owner: LockOwner,
    /// Addresses of the runs that it is making.
    addresses: BTreeSet<String>,
}

impl Claims {
    fn to_json(&self) -> Vec<u8> {
        serde_json::to_vec(self).expect("plain data has a JSON form")
    }

    /// Number of leading bytes of the JSON form that stay the same when addresses change.
    fn unchanging(&self) -> usize {
        let owner = serde_json::to_vec(&self.owner).expect("plain data has a JSON form");
        BEFORE_OWNER.len() + owner.len()
    }
}

/// The JSON form of claims up to the owner.
const BEFORE_OWNER: &[u8] = b"{\"owner\":";

/// Reads the owner of a session, even of one that was killed while it wrote its addresses.
fn owner(session: &Path) -> Option<LockOwner> {
    let text = read_bounded(session, LARGEST, Links::Refused).ok()?;
    let owner = text.strip_prefix(BEFORE_OWNER)?;
    let mut owner = serde_json::Deserializer::from_slice(owner).into_iter();
    owner.next()?.ok()
}

/// This program in a store.
#[derive(Debug)]
pub(crate) struct Session {
    /// The store.
    root: PathBuf,
    name: SessionName,
    path: PathBuf,
    /// Directory for unfinished work.
    pub(super) work: PathBuf,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    file: File,
    claims: Claims,
}

impl Session {
    /// Begins a session in a store, after removing the leftovers of dead ones. Its file gets the name of a session
    /// only once it says its owner, so that whatever a killed program leaves is known to be its own.
    pub(super) fn begin(directories: &Directories) -> Result<Self, StoreError> {
        let root = directories.root();
        let sessions = directories.create(SESSIONS)?;
        directories.create(WORK)?;
        directories.create(CHECKPOINTS)?;
        let owner = LockOwner::this_program();
        let _lock = Lock::acquire(&root.join("lock"), &owner)?;
        remove_dead(root);
        remove_abandoned(&sessions, DRAFT.as_ref());
        let writing = || FileError::writing(&sessions);
        let draft = temporary(DRAFT.as_ref())
            .permissions(Permissions::from_mode(READABLE))
            .tempfile_in(&sessions)
            .map_err(writing())?;
        let locked = draft.as_file().lock();
        locked.map_err(|error| no_lock(draft.path(), error))?;
        if is_unlocked(draft.path()) {
            return Err(StoreError::NoLocks {
                path: draft.path().to_owned(),
                reason: "a file that is locked can be locked again".to_owned(),
            });
        }
        let name = SessionName::of_draft(draft.path());
        let (path, work) = (name.file(root), name.work(root));
        let claims = Claims {
            owner,
            addresses: BTreeSet::new(),
        };
        let written = (&mut draft.as_file()).write_all(&claims.to_json());
        written.map_err(FileError::writing(draft.path()))?;
        let named = draft.persist_noclobber(&path);
        let file = named.map_err(|error| writing()(error.error))?;
        let session = Self {
            root: root.to_owned(),
            name,
            path,
            work,
            state: Mutex::new(State { file, claims }),
        };
        let created = DirBuilder::new().mode(PRIVATE).create(&session.work);
        created.map_err(FileError::writing(&session.work))?;
        Ok(session)
    }

    /// Claims the runs under `addresses` for this program, until it releases them or ends. Returns, for each, the
    /// other program that is making it, if there is one.
    ///
    /// # Errors
    /// If the claims cannot be read or written.
    pub(crate) fn claim(&self, addresses: &[String]) -> Result<Vec<Option<LockOwner>>, StoreError> {
        let mut state = self.state();
        let _lock = self.lock(&state)?;
        let others = self.others();
        let is_free = |address: &&String| !others.contains_key(*address);
        let free: Vec<String> = addresses.iter().filter(is_free).cloned().collect();
        if !free.is_empty() {
            state.claims.addresses.extend(free);
            state.write(&self.path)?;
        }
        let owners = addresses.iter().map(|address| others.get(address).cloned());
        Ok(owners.collect())
    }

    /// Releases the claims to the runs under `addresses`.
    ///
    /// # Errors
    /// If the claims cannot be written; they end with this program in any case.
    pub(crate) fn release(&self, addresses: &[String]) -> Result<(), StoreError> {
        let mut state = self.state();
        let _lock = self.lock(&state)?;
        for address in addresses {
            state.claims.addresses.remove(address);
        }
        state.write(&self.path)
    }

    /// Keeps other programs from beginning to use the store as long as the returned lock lives.
    ///
    /// # Errors
    /// If another program uses it already, or one on another machine may.
    pub(super) fn alone(&self) -> Result<Lock, StoreError> {
        let state = self.state();
        let lock = self.lock(&state)?;
        remove_dead(&self.root);
        let names = sessions(&self.root).into_iter();
        let others = names.filter(|name| *name != self.name);
        let mut others = others.map(|name| name.file(&self.root));
        // Sessions end without waiting for the lock.
        let used_by = others.find_map(|session| match is_gone(&session) {
            true => None,
            false => Some(self.use_by(session, &state.claims.owner.host)),
        });
        match used_by {
            Some(error) => Err(error),
            None => Ok(lock),
        }
    }

    /// Returns the error that another `session` is using the store, for a program on the machine `here`.
    fn use_by(&self, session: PathBuf, here: &str) -> StoreError {
        let path = self.root.clone();
        let Some(Claims { owner, .. }) = claims(&session) else {
            return StoreError::InUseByUnknown { path, session };
        };
        let is_here = owner.host == here;
        let owner = Box::new(owner);
        match is_here {
            true => StoreError::InUse { path, owner },
            false => StoreError::InUseElsewhere {
                path,
                owner,
                session,
            },
        }
    }

    fn lock(&self, state: &State) -> Result<Lock, StoreError> {
        Lock::acquire(&self.root.join("lock"), &state.claims.owner)
    }

    /// Returns the addresses claimed by other live sessions, with their owners.
    fn others(&self) -> HashMap<String, LockOwner> {
        remove_dead(&self.root);
        let others = sessions(&self.root).into_iter();
        let others = others.filter(|name| *name != self.name);
        let paths = others.map(|name| name.file(&self.root));
        let alive = paths.filter(|path| !is_unlocked(path));
        let claimed = alive.filter_map(|path| claims(&path));
        let owned = claimed.flat_map(|Claims { owner, addresses }| {
            let owned = addresses.into_iter();
            owned.map(move |address| (address, owner.clone()))
        });
        owned.collect()
    }

    /// Locks the state. A panic cannot leave a set of addresses half changed, so poison does not matter.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn write(&mut self, path: &Path) -> Result<(), StoreError> {
        let (text, kept) = (self.claims.to_json(), self.claims.unchanging());
        let written = overwrite(&mut self.file, &text, kept);
        let sent = written.and_then(|()| match is_local(&self.file) {
            true => Ok(()),
            // Other machines do not see what a network file system has not sent yet.
            false => self.file.sync_data(),
        });
        Ok(sent.map_err(FileError::writing(path))?)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // The directory stays if it holds the files of failed runs.
        let _ = fs::remove_dir(&self.work);
        let _ = fs::remove_file(&self.path);
    }
}

/// Lists all sessions of the store at `root`.
fn sessions(root: &Path) -> Vec<SessionName> {
    let entries = fs::read_dir(root.join(SESSIONS)).into_iter().flatten();
    let names = entries.flatten().map(|entry| entry.file_name());
    names.filter_map(|name| SessionName::of(&name)).collect()
}

/// Lists the directories for unfinished work of sessions that have ended, as paths in the store at `root`.
pub(super) fn leftovers(root: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(root.join(WORK)).into_iter().flatten();
    let directories = entries.flatten().filter(|entry| {
        let is_own = is_temporary(&entry.file_name(), PREFIX.as_ref());
        is_own && entry.file_type().is_ok_and(|kind| kind.is_dir())
    });
    let names = directories.filter_map(|entry| entry.file_name().into_string().ok());
    let ended = names
        .map(SessionName)
        .filter(|name| is_gone(&name.file(root)));
    ended.map(|name| Path::new(WORK).join(name.0)).collect()
}

/// Whether the session no longer exists.
fn is_gone(session: &Path) -> bool {
    let found = fs::symlink_metadata(session);
    found.is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound)
}

fn claims(session: &Path) -> Option<Claims> {
    let text = read_bounded(session, LARGEST, Links::Refused).ok()?;
    serde_json::from_slice(&text).ok()
}

/// Whether no program on this machine has locked the session file.
fn is_unlocked(session: &Path) -> bool {
    let file = open_regular(session, Links::Refused, File::options().read(true));
    file.is_ok_and(|file| file.try_lock_shared().is_ok())
}

/// Whether `file` is on a file system of this machine alone, as far as the kind of the file system says.
fn is_local(file: &File) -> bool {
    let local = [
        BTRFS_SUPER_MAGIC,
        EXT4_SUPER_MAGIC,
        OVERLAYFS_SUPER_MAGIC,
        TMPFS_MAGIC,
        XFS_SUPER_MAGIC,
    ];
    fstatfs(file).is_ok_and(|found| local.contains(&found.filesystem_type()))
}

/// Removes the leftovers of dead sessions. Must be called under the lock, so that no session is between its creation
/// and its own lock. Sessions of another machine are left to that machine, because on some file systems their locks
/// cannot be seen from here. A session whose owner cannot be read may be of another machine.
fn remove_dead(root: &Path) {
    let here = LockOwner::this_program().host;
    for name in sessions(root) {
        let session = name.file(root);
        let is_own = || owner(&session).is_some_and(|owner| owner.host == here);
        if is_unlocked(&session) && is_own() {
            // If that fails, the session file stays and the next program tries again.
            let removed = match fs::remove_dir_all(name.work(root)) {
                Err(error) => error.kind() == std::io::ErrorKind::NotFound,
                Ok(()) => true,
            };
            if removed {
                let _ = fs::remove_file(&session);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::directories::Sharing;
    use super::*;

    fn begin(root: &Path) -> Result<Session, StoreError> {
        Session::begin(&Directories::open(root, Sharing::Private)?)
    }

    fn addresses(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    #[test]
    fn what_one_session_works_on_no_other_begins() {
        let root = tempfile::tempdir().unwrap();
        let [one, other] = [(); 2].map(|()| begin(root.path()).unwrap());
        let [ab, bc] = [addresses(&["a", "b"]), addresses(&["b", "c"])];
        assert_eq!(one.claim(&ab).unwrap(), [None, None]);
        let owners = other.claim(&bc).unwrap();
        let owner = owners[0].as_ref().expect("b is taken");
        assert_eq!(owner.process, std::process::id());
        assert_eq!(owners[1], None);
        one.release(&ab).unwrap();
        assert_eq!(other.claim(&bc).unwrap(), [None, None]);
        assert!(one.claim(&addresses(&["c"])).unwrap()[0].is_some());
        drop(other);
        assert_eq!(one.claim(&bc).unwrap(), [None, None]);
    }

    /// Creates the session file and the work directory of an `owner` that claimed "a" and no longer has a lock.
    fn leftovers(root: &Path, owner: LockOwner) -> [PathBuf; 2] {
        let names = [
            "sessions/session-abcdefABCDEF.json",
            "work/session-abcdefABCDEF",
        ];
        let [file, work] = names.map(|name| root.join(name));
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::create_dir_all(work.join("yade-1")).unwrap();
        let claims = Claims {
            owner,
            addresses: addresses(&["a"]).into_iter().collect(),
        };
        fs::write(&file, serde_json::to_vec(&claims).unwrap()).unwrap();
        [file, work]
    }

    #[test]
    fn a_dead_session_holds_nothing_and_its_leftovers_go() {
        let root = tempfile::tempdir().unwrap();
        let [dead, left] = leftovers(root.path(), LockOwner::this_program());
        let evidence = root.path().join("work/ended/yade-2");
        fs::create_dir_all(&evidence).unwrap();
        let session = begin(root.path()).unwrap();
        assert_eq!(session.claim(&addresses(&["a"])).unwrap(), [None]);
        assert!(!dead.exists() && !left.exists());
        assert!(evidence.exists(), "it belongs to a session that ended well");
    }

    #[test]
    fn what_no_session_could_be_called_is_left_alone() {
        let root = tempfile::tempdir().unwrap();
        let kept = [
            "sessions/monday.md",
            "sessions/monday.json",
            "sessions/...json",
            "sessions/.json",
            "sessions/session-..json",
            "sessions/session-abcdefABCDEF.json.bak",
            "work/monday/data.bin",
            "work/session-ended/data.bin",
            "runs/mine",
        ];
        let kept = kept.map(|name| root.path().join(name));
        for path in &kept {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "mine").unwrap();
        }
        drop(begin(root.path()).unwrap());
        for path in kept {
            assert!(path.exists(), "{} is gone", path.display());
        }
    }

    #[test]
    fn a_session_of_another_machine_holds_nothing_without_a_lock_but_is_left_alone() {
        let root = tempfile::tempdir().unwrap();
        let mut owner = LockOwner::this_program();
        owner.host += "-not";
        let [path, work] = leftovers(root.path(), owner);
        let session = begin(root.path()).unwrap();
        assert_eq!(session.claim(&addresses(&["a"])).unwrap(), [None]);
        assert!(path.exists() && work.exists());
    }

    #[test]
    fn a_session_whose_claims_cannot_be_read_is_left_alone_and_keeps_others_from_removing() {
        let root = tempfile::tempdir().unwrap();
        let [path, work] = leftovers(root.path(), LockOwner::this_program());
        fs::write(&path, "{\"owner\":").unwrap();
        let session = begin(root.path()).unwrap();
        assert!(path.exists() && work.exists());
        let refused = session.alone().err().expect("somebody may be there");
        let message = refused.to_string();
        assert!(message.contains("unknown"), "{message}");
        assert!(message.contains("session-abcdefABCDEF"), "{message}");
        fs::remove_file(path).unwrap();
        assert!(session.alone().is_ok());
    }

    /// A program may be killed at any point while it writes its claims, or begins.
    #[test]
    fn what_a_killed_program_leaves_of_its_session_goes() {
        let root = tempfile::tempdir().unwrap();
        let owner = LockOwner::this_program();
        let [dead, left] = leftovers(root.path(), owner.clone());
        let whole = fs::read(&dead).unwrap();
        let own = Claims {
            owner,
            addresses: BTreeSet::new(),
        };
        for length in own.unchanging()..=whole.len() {
            fs::write(&dead, &whole[..length]).unwrap();
            fs::create_dir_all(&left).unwrap();
            drop(begin(root.path()).unwrap());
            assert!(!dead.exists() && !left.exists(), "{length}");
        }
        let draft = root.path().join("sessions/draft-abcdefABCDEF");
        fs::write(&draft, &whole[..5]).unwrap();
        drop(begin(root.path()).unwrap());
        assert!(!draft.exists());
    }

    /// What was written before stays readable while addresses come and go.
    #[test]
    fn a_session_file_holds_the_claims_of_today() {
        let root = tempfile::tempdir().unwrap();
        let session = begin(root.path()).unwrap();
        for held in [&["a", "b"][..], &["b"], &[]] {
            let own = claims(&session.path).unwrap().addresses.into_iter();
            session.release(&own.collect::<Vec<_>>()).unwrap();
            session.claim(&addresses(held)).unwrap();
            let found = claims(&session.path).expect("it is whole");
            assert_eq!(found.addresses.into_iter().collect::<Vec<_>>(), held);
        }
    }

    #[test]
    fn a_session_that_ends_leaves_nothing() {
        let root = tempfile::tempdir().unwrap();
        drop(begin(root.path()).unwrap());
        for directory in ["sessions", "work"] {
            let entries = fs::read_dir(root.path().join(directory)).unwrap();
            assert_eq!(entries.count(), 0, "{directory}");
        }
    }
}
