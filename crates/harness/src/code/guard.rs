//! The guard: a process of tristack that stands between it and an external program.
//!
//! A guard lives as long as the external program and its descendants, and kills them when tristack ends for any
//! reason, `kill -9` included. It also limits their memory and files, and shuts them off from the network where the
//! system permits.

use crate::files::system_text;
use nix::errno::Errno;
use nix::sched::{CloneFlags, unshare};
use nix::sys::prctl::{set_child_subreaper, set_dumpable};
use nix::sys::resource::{Resource, getrlimit, setrlimit};
use nix::sys::signal::{Signal, kill, raise};
use nix::sys::socket::{AddressFamily, MsgFlags, SockFlag, SockProtocol, SockType, send, socket};
use nix::sys::wait::{WaitPidFlag, WaitStatus, waitpid};
use nix::unistd::{Pid, getgid, getpid, getuid};
use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::io::Read;
use std::os::fd::AsRawFd;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::sync::{LazyLock, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// The command of `tristack` that runs a guard.
pub const COMMAND: &str = "guard";
/// Its flag that runs the program without a network.
const OFFLINE: &str = "--offline";
const THIS_PROGRAM: &str = "/proc/self/exe";

/// Ten times the address space of the largest code: YADE had 0.81 GiB at most (VmPeak, a stack of the quick profile).
const MOST_MEMORY: u64 = 8 << 30;
/// Nine thousand times the longest recorded series, of 118 kB.
const LONGEST_FILE: u64 = 1 << 30;

static GUARDED: AtomicBool = AtomicBool::new(false);

/// Whether the orphans of guards become children of this process.
static ADOPTS: AtomicBool = AtomicBool::new(false);

/// The processes of the guards that live. It is locked while one is started, so that none is taken for an orphan.
static GUARDS: Mutex<BTreeSet<i32>> = Mutex::new(BTreeSet::new());

/// Receives a warning.
static WARN: OnceLock<fn(&str)> = OnceLock::new();

/// Longest time that the orphans of a guard are waited for after they were killed.
const LONGEST_END: Duration = Duration::from_secs(5);

/// Guards external programs from now on; `warn` receives the warning that they cannot be shut off from the network.
/// Call it only in a program that understands `COMMAND`, and before it has started anything.
pub fn guard_foreign_programs(warn: fn(&str)) {
    let _ = WARN.set(warn);
    GUARDED.store(true, Ordering::SeqCst);
    // What the program before this one had started in the same process belongs to somebody else.
    let adopts = children().is_empty() && set_child_subreaper(true).is_ok();
    ADOPTS.store(adopts, Ordering::SeqCst);
}

/// Starts a guard by `spawn`, which returns it; `number` is that of its process.
pub(super) fn start<T>(
    spawn: impl FnOnce() -> std::io::Result<T>,
    number: impl FnOnce(&T) -> u32,
) -> std::io::Result<T> {
    let mut guards = GUARDS.lock().unwrap_or_else(PoisonError::into_inner);
    let guard = spawn()?;
    guards.insert(number(&guard) as i32);
    Ok(guard)
}

/// Takes note that the guard with this `number` has ended, and kills what it has left behind. Returns whether there was
/// anything: a guard that is not killed ends all processes of its program itself.
pub(super) fn ended(number: u32) -> bool {
    let mut guards = GUARDS.lock().unwrap_or_else(PoisonError::into_inner);
    guards.remove(&(number as i32));
    if !ADOPTS.load(Ordering::SeqCst) {
        return false;
    }
    let (mut found, start) = (false, Instant::now());
    while start.elapsed() < LONGEST_END {
        let mut orphans = children();
        orphans.retain(|child| !guards.contains(&child.as_raw()));
        if orphans.is_empty() {
            break;
        }
        for orphan in orphans {
            let _ = kill(orphan, Signal::SIGKILL);
            found |= !matches!(
                waitpid(orphan, Some(WaitPidFlag::WNOHANG)),
                Ok(WaitStatus::Exited(..))
            );
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    found
}

/// Returns the words before the command of an external program. The link leads to this program even after its file
/// was replaced.
pub(super) fn prefix() -> Vec<&'static OsStr> {
    let words: &[&str] = match GUARDED.load(Ordering::SeqCst) {
        false => &[],
        true if *MAY_LEAVE_NETWORK => &[THIS_PROGRAM, COMMAND, OFFLINE, "--"],
        true => &[THIS_PROGRAM, COMMAND, "--"],
    };
    words.iter().map(OsStr::new).collect()
}

/// Whether the system lets this user leave the network. A separate process tries, because that cannot be undone.
static MAY_LEAVE_NETWORK: LazyLock<bool> = LazyLock::new(|| {
    let mut guard = Command::new(THIS_PROGRAM);
    guard.args([COMMAND, OFFLINE, "--", THIS_PROGRAM, "--version"]);
    guard.stdout(Stdio::null()).stderr(Stdio::null());
    let child = start(|| guard.stdin(Stdio::piped()).spawn(), |child| child.id());
    let status = child.and_then(|mut child| {
        let held = child.stdin.take();
        let status = child.wait();
        drop(held);
        ended(child.id());
        status
    });
    let may = status.is_ok_and(|status| status.success());
    if let Some(warn) = WARN.get().filter(|_| !may) {
        warn(
            "the system lets this user leave no network (name spaces are refused): external programs have the network \
             of this user",
        );
    }
    may
});

/// Runs `command` until it ends or standard input is closed, without a network if `offline`, and kills all its
/// descendants.
pub fn guard(command: &[OsString], offline: bool) -> std::io::Result<ExitStatus> {
    set_child_subreaper(true)?;
    limit(Resource::RLIMIT_CORE, 0)?;
    limit(Resource::RLIMIT_AS, MOST_MEMORY)?;
    limit(Resource::RLIMIT_FSIZE, LONGEST_FILE)?;
    if offline {
        leave_network()?;
    }
    // Nobody without privileges may trace this process from now on, nor read its memory.
    set_dumpable(false)?;
    let (sender, started) = channel();
    let closed = std::thread::Builder::new().spawn(move || {
        // Nothing is ever written to standard input: the read returns when the other side closes.
        let _ = std::io::stdin().read(&mut [0]);
        if let Ok(program) = started.recv() {
            let _ = kill(program, Signal::SIGKILL);
        }
    });
    closed?;
    let mut child = Command::new(&command[0])
        .args(&command[1..])
        .stdin(Stdio::null())
        .spawn()?;
    let _ = sender.send(Pid::from_raw(child.id() as i32));
    let status = child.wait()?;
    end_descendants();
    Ok(status)
}

/// Ends this program by the signal in `status`, or returns the exit code in it, so that the parent process sees how
/// the external program ended.
pub fn end_like(status: ExitStatus) -> i32 {
    if let Some(signal) = status.signal().and_then(|it| Signal::try_from(it).ok()) {
        // The first signal may only remove the handler of the runtime.
        let _ = raise(signal);
        let _ = raise(signal);
    }
    // For a signal that this program ignores: the code by which a shell reports it.
    let signal = status.signal().unwrap_or_default();
    status.code().unwrap_or(128 + signal)
}

/// Limits `resource` to `most`, or to what is allowed already if that is less.
fn limit(resource: Resource, most: u64) -> std::io::Result<()> {
    let (_, allowed) = getrlimit(resource)?;
    let most = most.min(allowed);
    Ok(setrlimit(resource, most, most)?)
}

/// Moves this process to a separate network, which has only a loopback interface.
fn leave_network() -> std::io::Result<()> {
    let (user, group) = (getuid(), getgid());
    if unshare(CloneFlags::CLONE_NEWNET).is_err() {
        // Only the owner of a user namespace may do that, and every user may create one.
        unshare(CloneFlags::CLONE_NEWUSER | CloneFlags::CLONE_NEWNET)?;
        std::fs::write("/proc/self/setgroups", "deny")?;
        std::fs::write("/proc/self/uid_map", format!("{user} {user} 1"))?;
        std::fs::write("/proc/self/gid_map", format!("{group} {group} 1"))?;
    }
    start_loopback()
}

/// Asks the kernel to bring up interface 1, the loopback: some codes do not start without one.
fn start_loopback() -> std::io::Result<()> {
    const NEW_LINK: u16 = 16;
    const REQUEST: u16 = 1;
    const LOOPBACK: u32 = 1;
    const UP: u32 = 1;
    let netlink = socket(
        AddressFamily::Netlink,
        SockType::Raw,
        SockFlag::SOCK_CLOEXEC,
        SockProtocol::NetlinkRoute,
    )?;
    // struct nlmsghdr and struct ifinfomsg of linux/netlink.h and linux/rtnetlink.h.
    let length = 32_u32.to_ne_bytes();
    let kind = [NEW_LINK, REQUEST].map(u16::to_ne_bytes);
    let rest = [0, 0, 0, LOOPBACK, UP, UP].map(u32::to_ne_bytes);
    let message = [length.as_slice(), kind.as_flattened(), rest.as_flattened()].concat();
    send(netlink.as_raw_fd(), &message, MsgFlags::empty())?;
    Ok(())
}

/// Kills all descendants of the external program, also those that have left its group: orphans become children of
/// this process.
fn end_descendants() {
    loop {
        match waitpid(None, Some(WaitPidFlag::WNOHANG)) {
            Err(Errno::EINTR) => continue,
            // No children are left.
            Err(_) => return,
            Ok(_) => {}
        }
        for child in children() {
            let _ = kill(child, Signal::SIGKILL);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Returns the children of this process.
fn children() -> Vec<Pid> {
    // One list a thread, where the kernel has them; elsewhere all processes are asked for their parent.
    let threads = std::fs::read_dir("/proc/self/task").into_iter().flatten();
    let lists = threads
        .flatten()
        .map(|thread| thread.path().join("children"));
    let lists: Option<Vec<String>> = lists.map(system_text).collect();
    if let Some(lists) = lists.filter(|lists| !lists.is_empty()) {
        let numbers = lists.iter().flat_map(|list| list.split_whitespace());
        let numbers = numbers.filter_map(|number| number.parse().ok());
        return numbers.map(Pid::from_raw).collect();
    }
    let processes = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let numbers = processes.filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    numbers
        .filter(|&process| parent(process) == Some(getpid()))
        .map(Pid::from_raw)
        .collect()
}

fn parent(process: i32) -> Option<Pid> {
    let status = system_text(format!("/proc/{process}/stat"))?;
    // The name, in parentheses, may hold anything.
    let (_, rest) = status.rsplit_once(')')?;
    let parent = rest.split_whitespace().nth(1)?;
    parent.parse().ok().map(Pid::from_raw)
}
