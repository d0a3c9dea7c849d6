//! The process between tristack and a foreign program.

use crate::common::{Bench, network};
use std::fs;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Output, Stdio};

/// A guard, with `options`, of a shell that executes `script`; it lives as long as its standard input is held open.
fn guarded(bench: &Bench, options: &str, script: &str) -> Child {
    let mut command = bench.process(&format!("guard {options} -- sh -c"));
    command
        .arg(script)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command.spawn().expect("it starts")
}

fn output(options: &str, script: &str) -> Output {
    let bench = Bench::with_system_programs();
    let mut child = guarded(&bench, options, script);
    let held = child.stdin.take();
    let output = child.wait_with_output().expect("it ends");
    drop(held);
    output
}

fn text(options: &str, script: &str) -> String {
    String::from_utf8(output(options, script).stdout).expect("text")
}

fn is_running(process: &str) -> bool {
    fs::exists(format!("/proc/{}", process.trim())).expect("a list of processes")
}

#[test]
fn a_guard_ends_as_its_program_ends() {
    assert_eq!(output("", "exit 7").status.code(), Some(7));
    assert_eq!(output("", "true").status.code(), Some(0));
    for signal in [6, 9, 11, 15] {
        let status = output("", &format!("kill -{signal} $$")).status;
        assert_eq!(status.signal(), Some(signal));
    }
    let bench = Bench::with_system_programs();
    let mut command = bench.tristack("guard -- no-such-program");
    command.assert().code(127);
}

#[test]
fn whatever_a_program_leaves_behind_ends_with_it() {
    let script = "
        setsid sleep 600 > /dev/null & echo $!
        (setsid sh -c 'echo $$ > number; exec sleep 600' &)
        looks=0
        until [ -s number ] || [ $looks = 6000 ]; do sleep 0.01; looks=$((looks + 1)); done
        cat number";
    let left = text("", script);
    let left: Vec<&str> = left.lines().collect();
    assert_eq!(left.len(), 2);
    for process in left {
        assert!(!is_running(process), "{process}");
    }
}

#[test]
fn a_program_ends_when_nobody_holds_its_guard_any_more() {
    let bench = Bench::with_system_programs();
    let mut child = guarded(&bench, "", "echo $$; sleep 600");
    let mut first = [0; 16];
    let count = child.stdout.as_mut().expect("a pipe").read(&mut first);
    let number = String::from_utf8_lossy(&first[..count.expect("a number")]).into_owned();
    assert!(is_running(&number));
    drop(child.stdin.take());
    let status = child.wait().expect("it ends");
    assert!(!is_running(&number));
    assert!(!status.success(), "it was ended, and did not end by itself");
}

#[test]
fn a_program_has_a_network_of_its_own() {
    if !network::can_be_left() {
        return;
    }
    let own = fs::read_link("/proc/self/ns/net").expect("a name space");
    let its = text("--offline", "readlink /proc/self/ns/net");
    assert_ne!(its.trim(), own.to_string_lossy());
    let devices = "tail -n +3 /proc/net/dev | cut -d : -f 1";
    assert_eq!(text("--offline", devices).trim(), "lo");
    let addresses = "cat /sys/class/net/lo/flags /proc/net/fib_trie | grep -c 127.0.0.1";
    let loopback_is_up = text("--offline", addresses);
    assert_ne!(loopback_is_up.trim(), "0");
}

#[test]
fn memory_files_and_core_dumps_are_limited() {
    let limits = text("", "ulimit -v; ulimit -f; ulimit -c");
    // In units of 1024 and of 512 bytes.
    assert_eq!(limits, "8388608\n2097152\n0\n");
}

#[test]
fn a_lower_limit_stays() {
    let script = "ulimit -v 4000000; exec \"$0\" guard -- sh -c 'ulimit -v'";
    let mut shell = Command::new("sh");
    shell.args(["-c", script, env!("CARGO_BIN_EXE_tristack")]);
    let child = shell.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut child = child.expect("it starts");
    let held = child.stdin.take();
    let output = child.wait_with_output().expect("it ends");
    drop(held);
    assert_eq!(String::from_utf8_lossy(&output.stdout), "4000000\n");
}

#[test]
fn a_guard_is_nothing_to_type() {
    let bench = Bench::without_codes();
    let output = bench.tristack("--help").output().expect("it runs");
    let help = String::from_utf8(output.stdout).expect("text");
    assert!(!help.contains("guard"), "{help}");
}

/// Makes the folder of a code whose program, a shell script, has the same name.
fn folder(bench: &Bench, name: &str, script: &str) {
    let folder = bench.path(name);
    fs::create_dir(&folder).expect("a folder");
    let manifest = format!(
        "schema = 1\nname = \"{name}\"\n[program]\ncommand = [\"{name}\"]\nsearch = [\"{{folder}}\"]\n\
         [tasks.stack]\n[tasks.motion]\n"
    );
    fs::write(folder.join("code.toml"), manifest).expect("a manifest");
    let program = folder.join(name);
    fs::write(&program, format!("#!/bin/sh\n{script}")).expect("a program");
    let executable = fs::Permissions::from_mode(0o755);
    fs::set_permissions(&program, executable).expect("it may be run");
}

/// A code whose program goes on after it has killed the process that would end it.
#[test]
fn what_kills_its_guard_ends_all_the_same_and_its_run_fails() {
    let bench = Bench::with_system_programs();
    let numbers = bench.path("numbers");
    let script = format!(
        "setsid sh -c 'echo $$ >> {0}; exec sleep 600' &\necho $$ >> {0}\n\
         until [ $(wc -l < {0}) -ge 2 ]; do sleep 0.01; done\nkill -9 $PPID\nexec sleep 600\n",
        numbers.display()
    );
    folder(&bench, "escape", &script);
    let line = "crosscheck --codes ./escape --mu 0.3 --stiffness 100 --time-limit 60 --jobs 1";
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    let left = fs::read_to_string(&numbers).expect("its processes");
    assert!(left.lines().count() >= 2, "{message}");
    let living: Vec<&str> = left.lines().filter(|own| is_running(own)).collect();
    assert!(living.is_empty(), "{living:?}: {message}");
    assert!(
        message.contains("was ended first; what was left was ended as well"),
        "{message}"
    );
    assert_eq!(output.status.code(), Some(3), "{message}");
}

/// In a name space of its own this user may be refused further ones.
#[test]
fn where_no_network_can_be_left_a_warning_says_so_once() {
    let bench = Bench::with_system_programs();
    folder(&bench, "useless", "exit 1");
    let tristack = bench.process("");
    let program = tristack.get_program().to_owned();
    let script = format!(
        "echo 0 > /proc/sys/user/max_net_namespaces && exec {} crosscheck --codes ./useless --mu 0.3 --stiffness 100",
        program.display()
    );
    let mut command = Command::new("unshare");
    command.args(["--user", "--map-root-user", "sh", "-c", &script]);
    command.current_dir(bench.path(""));
    command.env("TRISTACK_STORE", bench.path("store"));
    let output = command.output().expect("unshare is installed");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    if message.contains("unshare") || message.contains("max_net_namespaces") {
        eprintln!("no name space to try this in: {message}");
        return;
    }
    let count = message
        .matches("warning: the system lets this user leave no network")
        .count();
    assert_eq!(count, 1, "{message}");
}
