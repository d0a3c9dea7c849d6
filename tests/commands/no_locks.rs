//! File systems without locks: a store there is refused, with the reason.

use crate::common::Bench;
use std::fs;
use std::process::Command;

/// Builds a library that answers every `flock` with `answer`, statements in C.
fn answering(bench: &Bench, name: &str, answer: &str) -> String {
    let source = bench.path(&format!("{name}.c"));
    let library = bench.path(&format!("{name}.so")).display().to_string();
    let text = format!("#include <errno.h>\nint flock(int file, int operation) {{ {answer} }}\n");
    fs::write(&source, text).expect("a file");
    let mut compiler = Command::new("cc");
    compiler
        .args(["-shared", "-fPIC", "-o", &library])
        .arg(source);
    assert!(compiler.status().expect("a C compiler").success());
    library
}

#[test]
fn a_store_on_a_file_system_without_locks_is_refused_with_the_reason() {
    let answers = [
        ("ENOLCK", "errno = ENOLCK; return -1;", "No locks available"),
        (
            "ENOSYS",
            "errno = ENOSYS; return -1;",
            "Function not implemented",
        ),
        (
            "EOPNOTSUPP",
            "errno = EOPNOTSUPP; return -1;",
            "Operation not supported",
        ),
        (
            "pretence",
            "return 0;",
            "a file that is locked can be locked again",
        ),
    ];
    for (name, answer, reason) in answers {
        let bench = Bench::without_codes();
        let library = answering(&bench, name, answer);
        let mut command = bench.tristack("crosscheck --codes native --mu 0.3 --stiffness 100");
        let output = command
            .env("LD_PRELOAD", library)
            .output()
            .expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        for part in ["the file system has no locks", reason, "--store"] {
            assert!(message.contains(part), "{name}: {message}");
        }
        assert!(
            !bench.path("store/runs").exists(),
            "{name}: nothing is made"
        );
    }
}
