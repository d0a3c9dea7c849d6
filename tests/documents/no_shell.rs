//! No shell anywhere: programs are started in one place, with arguments as they are, and no deck asks its code
//! to start something.

use std::fs;
use std::path::{Path, PathBuf};

/// The only place that starts a program.
const STARTERS: [&str; 2] = [
    "crates/harness/src/code/process.rs",
    "crates/harness/src/code/guard.rs",
];

/// Ways to start a program in Rust.
const STARTS: [&str; 4] = [
    "Command::new",
    "CommandWrap",
    "std::process::Command",
    "exec(",
];
/// Shells, their usual argument, and a program that starts its arguments.
const SHELLS: [&str; 6] = [
    "\"sh\"",
    "\"bash\"",
    "\"/bin/sh\"",
    "\"/bin/bash\"",
    "\"-c\"",
    "\"env\"",
];

/// Ways to start a program in Python, or to run text as a program.
const PYTHON: [&str; 10] = [
    "os.system",
    "subprocess",
    "popen",
    "os.exec",
    "os.spawn",
    "posix_spawn",
    "import pty",
    "eval(",
    "exec(",
    "__import__",
];

/// Commands of LAMMPS and LIGGGHTS that start a program or a script in another language.
const DECK_COMMANDS: [&str; 2] = ["shell", "python"];

/// Words of `forbidden` in the lines of `text` that are no comments.
fn found<'a>(text: &str, comment: &str, forbidden: &[&'a str]) -> Vec<&'a str> {
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with(comment));
    let code: String = lines.map(|line| line.to_owned() + "\n").collect();
    forbidden
        .iter()
        .copied()
        .filter(|word| code.contains(word))
        .collect()
}

/// Lines of a deck whose command is forbidden, also where another one carries it out.
fn shells_of_deck(text: &str) -> Vec<&str> {
    let starts = |line: &&str| {
        let code = line.split('#').next().unwrap_or_default();
        code.split([' ', '\t', '"', '\'', '$', '(', ')'])
            .any(|word| DECK_COMMANDS.contains(&word))
    };
    text.lines().filter(starts).collect()
}

fn files(folder: &str, extension: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|found| found == extension) {
                let text = fs::read_to_string(&path).expect("text");
                found.push((path, text));
            }
        }
    }
    assert!(!found.is_empty(), "{folder} has no files *.{extension}");
    found
}

#[test]
fn programs_are_started_by_the_runner_and_its_guard_and_none_is_a_shell() {
    let folders = [
        "src",
        "crates/theory/src",
        "crates/dem/src",
        "crates/harness/src",
        "crates/paper/src",
        "crates/output/src",
    ];
    let folders = folders.into_iter();
    for (path, text) in folders.flat_map(|folder| files(folder, "rs")) {
        let shells = found(&text, "//", &SHELLS);
        assert!(shells.is_empty(), "{} names {shells:?}", path.display());
        if STARTERS.iter().any(|starter| path.ends_with(starter)) {
            assert!(
                !found(&text, "//", &STARTS).is_empty(),
                "it starts programs"
            );
        } else {
            let starts = found(&text, "//", &STARTS);
            assert!(starts.is_empty(), "{} has {starts:?}", path.display());
        }
    }
}

#[test]
fn scripts_of_yade_start_nothing() {
    for (path, text) in files("yade_scripts", "py") {
        let starts = found(&text, "#", &PYTHON);
        assert!(starts.is_empty(), "{} has {starts:?}", path.display());
    }
}

#[test]
fn decks_of_lammps_and_liggghts_start_nothing() {
    for folder in ["lammps_inputs", "liggghts_inputs"] {
        for (path, text) in files(folder, "in") {
            let shells = shells_of_deck(&text);
            assert!(shells.is_empty(), "{}: {shells:?}", path.display());
        }
    }
}

/// The tests above find what they look for.
#[test]
fn shells_would_be_noticed() {
    assert_eq!(
        found("let c = Command::new(\"sh\").arg(\"-c\");", "//", &SHELLS).len(),
        2
    );
    assert_eq!(
        found("let c = Command::new(name);", "//", &STARTS),
        ["Command::new"]
    );
    assert_eq!(
        found("\tos.system('rm ' + directory)", "#", &PYTHON),
        ["os.system"]
    );
    assert!(found("# subprocess is not used", "#", &PYTHON).is_empty());
    let deck =
        "run 10 every 5 \"shell ls\"\n  shell mkdir x\nvariable a python f\nprint 1 # no shell";
    assert_eq!(shells_of_deck(deck).len(), 3);
}
