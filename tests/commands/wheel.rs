//! The Python wheel: installed into an empty environment it gives the program, and that runs outside the checkout.

use crate::common;
use crate::common::{Bench, json, json_rows, project};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// In the environment: the wheel, as a path from the top of the project.
const REQUIRED: &str = "TRISTACK_REQUIRE_WHEEL";

/// The wheel that is to be tried.
fn wheel() -> Option<PathBuf> {
    let Some(name) = std::env::var_os(REQUIRED) else {
        eprintln!("skipped: {REQUIRED} names no wheel");
        return None;
    };
    let wheel = project().join(name);
    assert!(wheel.is_file(), "{} is not built", wheel.display());
    Some(wheel)
}

fn output(command: &mut Command) -> String {
    let Output {
        status,
        stdout,
        stderr,
    } = command.output().expect("it starts");
    let message = String::from_utf8_lossy(&stderr);
    assert!(status.success(), "{command:?}: {message}");
    String::from_utf8(stdout).expect("text")
}

/// A Python environment with nothing but the wheel.
fn environment(bench: &Bench, wheel: &Path) -> PathBuf {
    let environment = bench.path("environment");
    output(
        Command::new("python3")
            .args(["-m", "venv"])
            .arg(&environment),
    );
    let pip = environment.join("bin/pip");
    // Without an index: it needs no other package.
    output(
        Command::new(pip)
            .args(["install", "--no-index", "--quiet"])
            .arg(wheel),
    );
    environment
}

#[test]
fn the_program_of_a_wheel_runs_in_an_empty_directory() {
    let Some(wheel) = wheel() else {
        return;
    };
    let bench = Bench::without_codes();
    let program = environment(&bench, &wheel).join("bin/tristack");
    let empty = bench.path("empty");
    fs::create_dir(&empty).expect("a directory");
    let tristack = |line: &str| output(bench.process_of(&program, line).current_dir(&empty));

    let version = format!("tristack {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(tristack("--version"), version);
    let exact = json_rows(&tristack("theory --mu 0.3 --stiffness 100 --format json"));
    assert!(exact[0]["quasistatic"].as_f64().is_some(), "{exact:?}");
    let line = "crosscheck --codes native --mu 0.3 --stiffness 100 --format json";
    let rows = json_rows(&tristack(line));
    assert_eq!(rows[0]["verdict"], "agrees");
    // Recorded runs are inside, and stand in for the codes that are not here.
    let planned = json(&tristack("time --format json"));
    let codes = planned["tables"][0]["rows"].as_array().expect("rows");
    let recorded =
        |row: &&serde_json::Value| row["installed"] == false && row["runs"] == row["there"];
    assert_eq!(codes.iter().filter(recorded).count(), codes.len() - 1);
    assert_eq!(fs::read_dir(&empty).expect("it is there").count(), 0);
}

#[test]
fn a_wheel_carries_the_licences_and_no_path_of_the_machine_that_built_it() {
    let Some(wheel) = wheel() else {
        return;
    };
    let bench = Bench::without_codes();
    let unpacked = bench.path("unpacked");
    let mut python = Command::new("python3");
    output(
        python
            .args(["-m", "zipfile", "-e"])
            .args([&wheel, &unpacked]),
    );
    let files = common::files_below(&unpacked);
    let names: Vec<String> = files
        .iter()
        .map(|file| file.display().to_string())
        .collect();
    for part in [
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "METADATA",
        "scripts/tristack",
    ] {
        let found = names.iter().any(|name| name.ends_with(part));
        assert!(found, "{names:?} lacks {part}");
    }
    let of = |variable| std::env::var(variable).unwrap_or_default();
    let foreign = [
        project().display().to_string(),
        of("HOME"),
        of("CARGO_HOME"),
    ];
    for file in files {
        let content = fs::read(unpacked.join(&file)).expect("a file");
        for path in foreign.iter().filter(|path| path.len() > 1) {
            let found = content
                .windows(path.len())
                .any(|part| part == path.as_bytes());
            assert!(!found, "{} holds {path}", file.display());
        }
    }
}
