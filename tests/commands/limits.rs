//! Limits of the system, interrupts, and programs that nobody asked to be started.

use crate::common::{Bench, code_folder, wait_for};
use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output, Stdio};

const THEORY: &str = "theory --mu 0.3 --stiffness 100";

fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A stack for which no memory has room stops every thread from being started.
#[test]
fn where_no_thread_can_be_started_a_sentence_says_so() {
    let bench = Bench::with_system_programs();
    let without_threads = |line: &str| {
        let mut command = bench.process(line);
        command.env("RUST_MIN_STACK", (1_u64 << 46).to_string());
        command.stdin(Stdio::null()).output().expect("it runs")
    };
    let output = without_threads(THEORY);
    let words =
        "error: the system starts no further thread for this user; accepted is a higher limit";
    assert!(message(&output).starts_with(words), "{}", message(&output));
    assert_eq!(output.status.code(), Some(3));
    let output = without_threads("guard -- true");
    let words = "cannot start true: ";
    assert!(message(&output).starts_with(words), "{}", message(&output));
    assert_eq!(output.status.code(), Some(127));
}

/// `tristack` with this command line, in a shell that lets no file become longer than some blocks of 512 bytes.
fn with_short_files(bench: &Bench, blocks: u32, line: &str) -> Output {
    let tristack = bench.process(line);
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("ulimit -f {blocks}; exec \"$0\" \"$@\"")]);
    shell.arg(tristack.get_program()).args(tristack.get_args());
    shell.current_dir(bench.path(""));
    let file = File::create(bench.path("output")).expect("a file");
    shell.stdout(file).output().expect("it runs")
}

#[test]
fn a_limit_on_the_size_of_files_is_told_with_the_file() {
    let bench = Bench::with_system_programs();
    let output = with_short_files(&bench, 0, THEORY);
    let words = "error: cannot write standard output: File too large";
    assert!(message(&output).starts_with(words), "{}", message(&output));
    assert_eq!(output.status.code(), Some(5));
    let passports = crate::common::project().join("reference/passports");
    let line = format!("atlas --passports {} --out site", passports.display());
    let output = with_short_files(&bench, 8, &line);
    let words = "error: cannot write site/";
    assert!(message(&output).contains(words), "{}", message(&output));
    assert_eq!(output.status.code(), Some(5));
}

#[test]
fn output_that_cannot_be_written_has_a_status_and_a_reader_that_has_gone_none() {
    let bench = Bench::with_system_programs();
    let mut command = bench.process(THEORY);
    let full = File::options().write(true).open("/dev/full");
    let output = command.stdout(full.expect("a full device")).output();
    let output = output.expect("it runs");
    assert!(message(&output).contains("cannot write standard output"));
    assert_eq!(output.status.code(), Some(5));
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = bench.process(THEORY).stdout(writer).output();
    assert_eq!(output.expect("it runs").status.code(), Some(0));
}

/// A folder like the Python example, whose program is a shell script: it says that it was started, answers with a version,
/// and goes on as `then` says where it is asked for a run.
fn folder(bench: &Bench, then: &str) {
    let folder = code_folder("examples/python", &bench.path("mine"), |manifest| {
        let manifest = manifest.replace(
            "command = [\"python3\", \"{deck}\"]",
            "command = [\"mine\"]\nsearch = [\"{folder}\"]",
        );
        manifest.replace("before = \"Python \"", "before = \"Mine \"")
    });
    let script = format!(
        "#!/bin/sh\necho >> {}\n[ \"$1\" = --version ] && exec echo Mine 1.0\necho >> {}\n{then}\n",
        bench.path("started").display(),
        bench.path("runs").display()
    );
    let program = folder.join("mine");
    fs::write(&program, script).expect("a program");
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("it may be run");
}

#[test]
fn an_interrupted_check_accuses_nobody_of_the_interrupt() {
    let bench = Bench::with_system_programs();
    folder(&bench, "exec sleep 600");
    let mut command = bench.process("check ./mine");
    let command = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().expect("it starts");
    wait_for(|| bench.path("runs").exists().then_some(()));
    let interrupted = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(interrupted.expect("kill runs").success());
    let output = child.wait_with_output().expect("it ends");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert_eq!(printed, "", "{}", message(&output));
    assert!(
        message(&output).contains("the check of ./mine was not finished"),
        "{}",
        message(&output)
    );
    assert_eq!(output.status.code(), Some(130));
}

#[test]
fn a_plan_starts_no_program() {
    let bench = Bench::with_system_programs();
    folder(&bench, "");
    let line = "plan --code ./mine --out away --mu 0.3 --stiffness 100";
    bench.tristack(line).assert().code(0);
    assert!(!bench.path("started").exists());
}
