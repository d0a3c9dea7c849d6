//! Private file systems, where this user may mount some.

use std::process::{Command, Stdio};
use std::sync::LazyLock;

/// Root may be refused a name space of users, and needs none.
const WAYS: [&[&str]; 2] = [&["--map-root-user", "--mount"], &["--mount"]];

/// Options with which `unshare` lets this user mount private file systems, if there are any.
static WAY: LazyLock<Option<&[&str]>> = LazyLock::new(|| {
    WAYS.into_iter().find(|way| {
        let mut command = unshared(way, "mount -t tmpfs none /mnt");
        let status = command.stderr(Stdio::null()).status();
        status.is_ok_and(|status| status.success())
    })
});

/// With which a script ends that cannot set up its disk, or not copy what is on it: tristack never does.
pub const NO_DISK: i32 = 99;

/// Whether this user may mount private file systems.
pub fn can_mount() -> bool {
    WAY.is_some()
}

fn unshared(way: &[&str], script: &str) -> Command {
    let mut command = Command::new("unshare");
    command.args(way).args(["sh", "-c", script]);
    command
}

/// `tristack`, started by `script`, in which it is `$@`, once `set_up` has mounted what it needs. The script ends with
/// `NO_DISK` if that fails.
pub fn with_mounts(tristack: &Command, set_up: &str, script: &str) -> Command {
    let script = format!("{{ {set_up}; }} || exit {NO_DISK}\n{script}");
    let mut command = unshared(WAY.expect("something can be mounted"), &script);
    command.arg("sh").arg(tristack.get_program());
    command.args(tristack.get_args());
    for (name, value) in tristack.get_envs() {
        match value {
            Some(value) => command.env(name, value),
            None => command.env_remove(name),
        };
    }
    if let Some(directory) = tristack.get_current_dir() {
        command.current_dir(directory);
    }
    command
}
