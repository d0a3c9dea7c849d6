//! Faults of the file system, on small private file systems in memory.

use super::common::mounts::{NO_DISK, with_mounts};
use super::fault::DiskFault;
use super::round::{Aftermath, Round};
use std::os::unix::fs::PermissionsExt;
use std::process::Output;

pub use super::common::mounts::can_mount;

/// Parts of the messages that tristack prints when it cannot write.
const SIGNS: [&str; 4] = [
    "No space left",
    "could not be kept",
    " failed on ",
    NOT_KEPT,
];

/// Part of the message of a program that can only read its store.
pub const NOT_KEPT: &str = "nothing new is kept";

pub fn strike(fault: DiskFault, round: &mut Round) -> Result<Aftermath, String> {
    match fault {
        DiskFault::Full => fill(round),
        DiskFault::ReadOnly => read_only(round),
        DiskFault::RunsReadOnly => lose_the_right_to_keep(round),
    }
}

/// Runs `script`, in which `$@` is tristack, once `set_up` has mounted what it needs.
fn run(round: &Round, set_up: &str, script: &str) -> Result<Output, String> {
    let mut command = with_mounts(&round.command(""), set_up, script);
    command.current_dir(round.root());
    let output = command.output().expect("it runs");
    if output.status.code() == Some(NO_DISK) {
        let message = String::from_utf8_lossy(&output.stderr);
        return Err(format!("there is no such disk: {message}"));
    }
    Ok(output)
}

/// The store is on a disk that is too small, and is then copied to a larger one.
fn fill(round: &mut Round) -> Result<Aftermath, String> {
    // Between too little for a probe and more than native needs for everything.
    let kilobytes = round.random.usize(4..3000);
    let output = run(
        round,
        &format!("mkdir disk && mount -t tmpfs -o size={kilobytes}k none disk && mkdir disk/store"),
        &format!(
            "TRISTACK_STORE=disk/store \"$@\"
            status=$?
            cp -a disk/store . || exit {NO_DISK}
            exit $status"
        ),
    )?;
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    Ok(Aftermath {
        struck: SIGNS.iter().any(|sign| message.contains(sign)),
        outputs: vec![output],
        ..Aftermath::default()
    })
}

/// After a program was killed, the store can only be read: what is there is used, and what is missing is made and
/// printed, and said, once, not to be kept. A directory that is no store yet is refused.
fn read_only(round: &mut Round) -> Result<Aftermath, String> {
    let mut child = round.start("");
    round.wait_for_a_moment(&mut child);
    let _ = child.kill();
    let killed = child.wait_with_output().expect("it ends");
    std::fs::create_dir_all(round.store()).expect("a store");
    let permissions = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(round.store(), permissions).expect("permissions");
    let is_store = round.store().join("format").exists();
    let cases = round.workload.cases.len();
    let missing = cases.saturating_sub(round.entries().len());
    let output = run(
        round,
        "mount --bind store store && mount -o remount,bind,ro store",
        "\"$@\"",
    )?;
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    let aftermath = Aftermath {
        killed: vec![killed],
        struck: true,
        ..Aftermath::default()
    };
    if !is_store {
        let named = message.contains("cannot write") && message.contains("/store");
        return match output.status.code() {
            Some(1) if output.stdout.is_empty() && named => Ok(aftermath),
            status => Err(format!("it was not refused: {status:?}\n{message}")),
        };
    }
    let told = message.matches(NOT_KEPT).count();
    // The answers to a probe are kept too.
    if told > 1 || (missing > 0 && told == 0) {
        let complaint = format!("{missing} runs were missing, and that was told {told} times");
        return Err(format!("{complaint}\n{message}"));
    }
    Ok(Aftermath {
        outputs: vec![output],
        harmless: true,
        ..aftermath
    })
}

/// Runs can be made, but not kept: the result is right, and said not to be kept.
fn lose_the_right_to_keep(round: &mut Round) -> Result<Aftermath, String> {
    let runs = round.store().join("runs");
    std::fs::create_dir_all(&runs).expect("a store");
    std::fs::write(round.store().join("format"), "tristack store, format 2\n").expect("a format");
    std::fs::set_permissions(&runs, std::fs::Permissions::from_mode(0o755)).expect("permissions");
    let output = run(
        round,
        "mount --bind store/runs store/runs && mount -o remount,bind,ro store/runs",
        "\"$@\"",
    )?;
    Ok(Aftermath {
        outputs: vec![output],
        struck: true,
        harmless: true,
        ..Aftermath::default()
    })
}
