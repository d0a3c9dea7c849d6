//! Faults of the file system, on small private file systems in memory.

use super::fault::DiskFault;
use super::round::{Aftermath, Round};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output, Stdio};
use std::sync::LazyLock;

/// Root may be refused a name space of users, and needs none.
const WAYS: [&[&str]; 2] = [&["--map-root-user", "--mount"], &["--mount"]];

/// Options with which `unshare` lets this user mount private file systems, if there are any.
static WAY: LazyLock<Option<&[&str]>> = LazyLock::new(|| {
    WAYS.into_iter().find(|way| {
        let mut command = private_mounts(way, "mount -t tmpfs none /mnt");
        let status = command.stderr(Stdio::null()).status();
        status.is_ok_and(|status| status.success())
    })
});

/// With which a script ends that cannot set up its disk, or not copy what is on it: tristack never does.
const NO_DISK: i32 = 99;

/// Parts of the messages that tristack prints when it cannot write.
const SIGNS: [&str; 3] = ["No space left", "could not be kept", " failed on "];

/// Whether this user may mount private file systems.
pub fn can_mount() -> bool {
    WAY.is_some()
}

fn private_mounts(way: &[&str], script: &str) -> Command {
    let mut command = Command::new("unshare");
    command.args(way).args(["sh", "-c", script]);
    command
}

pub fn strike(fault: DiskFault, round: &mut Round) -> Result<Aftermath, String> {
    match fault {
        DiskFault::Full => fill(round),
        DiskFault::ReadOnly => refuse_read_only(round),
        DiskFault::RunsReadOnly => lose_the_right_to_keep(round),
    }
}

/// Runs `script`, in which `$@` is tristack, once `set_up` has mounted what it needs.
fn run(round: &Round, set_up: &str, script: &str) -> Result<Output, String> {
    let tristack = round.command("");
    let script = format!("{{ {set_up}; }} || exit {NO_DISK}\n{script}");
    let mut command = private_mounts(WAY.expect("something can be mounted"), &script);
    command.arg("sh").arg(tristack.get_program());
    command.args(tristack.get_args());
    for (name, value) in tristack.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
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

/// After a program was killed, the store can only be read.
fn refuse_read_only(round: &mut Round) -> Result<Aftermath, String> {
    let mut child = round.start("");
    round.wait_for_a_moment(&mut child);
    let _ = child.kill();
    let killed = child.wait_with_output().expect("it ends");
    std::fs::create_dir_all(round.store()).expect("a store");
    let output = run(
        round,
        "mount --bind store store && mount -o remount,bind,ro store",
        "\"$@\"",
    )?;
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    let named = message.contains("cannot write") && message.contains("/store");
    if output.status.code() != Some(1) || !output.stdout.is_empty() || !named {
        return Err(format!(
            "it was not refused: {:?}\n{message}",
            output.status
        ));
    }
    Ok(Aftermath {
        outputs: vec![killed, output],
        struck: true,
        ..Aftermath::default()
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
