//! Faults of the file system, on small ones in memory that nobody else sees.

use super::fault::DiskFault;
use super::round::{Aftermath, Round};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output, Stdio};

/// Whether this user may mount something where nobody else sees it.
pub fn can_mount() -> bool {
    let mut command = private_mounts("mount -t tmpfs none /mnt");
    let status = command.stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

fn private_mounts(script: &str) -> Command {
    let mut command = Command::new("unshare");
    command.args(["--map-root-user", "--mount", "sh", "-c", script]);
    command
}

pub fn strike(fault: DiskFault, round: &mut Round) -> Result<Aftermath, String> {
    match fault {
        DiskFault::Full => Ok(fill(round)),
        DiskFault::ReadOnly => refuse_read_only(round),
        DiskFault::RunsReadOnly => Ok(lose_the_right_to_keep(round)),
    }
}

/// Runs `script`, in which `$@` is tristack.
fn run(round: &Round, script: &str) -> Output {
    let tristack = round.command("");
    let mut command = private_mounts(script);
    command.arg("sh").arg(tristack.get_program());
    command.args(tristack.get_args());
    for (name, value) in tristack.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    command.current_dir(round.root());
    command.output().expect("it runs")
}

/// The store is on a disk that is too small, and is then moved to a larger one.
fn fill(round: &mut Round) -> Aftermath {
    let kilobytes = round.random.usize(4..900);
    let output = run(
        round,
        &format!(
            "mkdir disk && mount -t tmpfs -o size={kilobytes}k none disk && mkdir disk/store || exit 99
            TRISTACK_STORE=disk/store \"$@\"
            status=$?
            cp -a disk/store . && umount disk && rmdir disk || exit 98
            exit $status"
        ),
    );
    Aftermath {
        struck: !output.status.success(),
        outputs: vec![output],
        ..Aftermath::default()
    }
}

/// After a program was killed, the store can only be read.
fn refuse_read_only(round: &mut Round) -> Result<Aftermath, String> {
    let mut child = round.start("");
    round.wait_for_a_moment();
    let _ = child.kill();
    let killed = child.wait_with_output().expect("it ends");
    std::fs::create_dir_all(round.store()).expect("a store");
    let output = run(
        round,
        "mount --bind store store && mount -o remount,bind,ro store || exit 99\n\"$@\"",
    );
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
fn lose_the_right_to_keep(round: &mut Round) -> Aftermath {
    let runs = round.store().join("runs");
    std::fs::create_dir_all(&runs).expect("a store");
    std::fs::write(round.store().join("format"), "tristack store, format 2\n").expect("a format");
    std::fs::set_permissions(&runs, std::fs::Permissions::from_mode(0o755)).expect("permissions");
    let output = run(
        round,
        "mount --bind store/runs store/runs && mount -o remount,bind,ro store/runs || exit 99\n\"$@\"",
    );
    Aftermath {
        outputs: vec![output],
        struck: true,
        harmless: true,
        ..Aftermath::default()
    }
}
