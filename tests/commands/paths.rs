//! Directories and files with names that a shell, a deck or a terminal would trip over, for every code that
//! is installed: results are the same, nothing in a name is executed, and messages stay one line.
#![cfg(target_os = "linux")] // Elsewhere names may have to be text.

use crate::common;
use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, json_rows};
use rayon::prelude::*;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use tristack::code::Code;
use tristack::model::{Case, Power, Stack};
use tristack::study::yield_force::plan;

/// If a name were executed, there would be a file of this name.
const WITNESS: &str = "touched";

const NAMES: [&[u8]; 13] = [
    b"with  spaces ",
    b"single'quote",
    b"double\"quote",
    b"new\nline",
    b"-dash",
    b"$(touch touched)",
    b"`touch touched`",
    b"semicolon; touch touched",
    b"back\\slash",
    b"star*{1,2}?[x]",
    b"#comment & %s ${x}",
    "gr\u{f6}\u{df}e-\u{5b57}".as_bytes(),
    b"not-utf-8-\xe9\xff",
];

/// Native and the first variant of every code.
fn live() -> Vec<Code> {
    let codes = Code::with_power(Power::Linear).into_iter();
    codes.filter(|code| code.is_first_variant()).collect()
}

/// The start-up script of YADE fails where its home directory, a part of the run directory, is not text.
fn names(code: Code) -> impl Iterator<Item = &'static [u8]> {
    let takes_all = code.as_str() != "yade";
    NAMES
        .into_iter()
        .filter(move |name| takes_all || str::from_utf8(name).is_ok())
}

fn named(bytes: &[u8]) -> &OsStr {
    OsStr::from_bytes(bytes)
}

/// All of them that `code` takes, below each other.
fn nested(root: &Path, code: Code) -> PathBuf {
    names(code).fold(root.to_owned(), |path, name| path.join(named(name)))
}

/// Some hundred steps under the convention of `code`.
fn short_case(code: Code) -> Case {
    let code = code.as_declared().expect("nothing is left out");
    let mut case = plan(&code, &Stack::paper(0.3, 1e2), code.convention()).cases[0];
    case.protocol.wall_travel *= 0.01;
    case.protocol.sampling.fine_from_travel = 0.0;
    case
}

/// `--flag=value`, so that a value may begin with a dash.
fn flag(name: &str, value: &Path) -> OsString {
    let mut flag = OsString::from(format!("--{name}="));
    flag.push(value);
    flag
}

/// Runs `command`, which must succeed without leaving a witness below `bench`.
fn succeed(bench: &Bench, command: &mut Command) -> Vec<u8> {
    let output = command.output().expect("it starts");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {message}");
    assert!(!message.contains("panicked"), "{message}");
    let witnesses = below(&bench.path("."), WITNESS);
    assert!(witnesses.is_empty(), "a name was executed: {witnesses:?}");
    output.stdout
}

/// The files of that name below `directory`.
fn below(directory: &Path, name: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).expect("a directory").flatten();
    entries
        .flat_map(|entry| match entry.file_type() {
            Ok(kind) if kind.is_dir() => below(&entry.path(), name),
            _ if entry.file_name() == name => vec![entry.path()],
            _ => Vec::new(),
        })
        .collect()
}

#[test]
fn every_code_works_in_directories_of_any_name() {
    common::installed(&live())
        .into_par_iter()
        .for_each(works_in_directories_of_any_name);
}

fn works_in_directories_of_any_name(code: Code) {
    let bench = Bench::with_system_programs();
    let case = bench.path("case.json");
    fs::write(&case, short_case(code.clone()).to_json()).expect("a case");
    let line = format!("simulate --code {code} --format json");
    let plain = bench.path("plain");
    succeed(
        &bench,
        bench
            .process(&line)
            .arg(flag("case", &case))
            .arg(flag("out", &plain)),
    );
    let expected = fs::read(plain.join("series.csv")).expect("a series");
    for name in names(code.clone()) {
        // Relative, so that a leading dash stays one.
        let out = Path::new(named(name));
        succeed(
            &bench,
            bench
                .process(&line)
                .arg(flag("case", &case))
                .arg(flag("out", out)),
        );
        let series = fs::read(bench.path("").join(out).join("series.csv")).expect("a series");
        assert!(series == expected, "{code} in {out:?}");
    }
}

#[test]
fn every_code_finds_its_way_from_and_through_names_of_any_kind() {
    common::installed(&live())
        .into_par_iter()
        .for_each(finds_its_way);
}

fn finds_its_way(code: Code) {
    let bench = Bench::with_system_programs();
    let here = nested(&bench.path("here"), code.clone());
    let temporary = nested(&bench.path("temporary"), code.clone());
    for directory in [&here, &temporary] {
        fs::create_dir_all(directory).expect("a directory");
    }
    let case = here.join("-$(touch touched)\n'case\".json");
    fs::write(&case, short_case(code.clone()).to_json()).expect("a case");
    let file = Path::new(case.file_name().expect("a name"));
    let line = format!("simulate --code {code} --format json");
    let run = |out: Option<&Path>| {
        let mut command = bench.process(&line);
        command
            .current_dir(&here)
            .env("TMPDIR", &temporary)
            .arg(flag("case", file));
        succeed(&bench, command.args(out.map(|out| flag("out", out))))
    };
    // In a temporary directory, and in one of its own.
    let force =
        |output: &[u8]| json_rows(&String::from_utf8_lossy(output))[0]["peak_force"].clone();
    assert_eq!(force(&run(None)), force(&run(Some(Path::new("-out")))));
    assert!(here.join("-out/series.csv").is_file());
    let left = fs::read_dir(&temporary).expect("a directory").count();
    assert_eq!(left, 0, "{code} leaves something in TMPDIR");
}

#[test]
fn store_and_results_of_a_crosscheck_may_be_anywhere() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let [here, store, temporary] =
        ["here", "store-", "temporary"].map(|name| nested(&bench.path(name), Code::native()));
    for directory in [&here, &temporary] {
        fs::create_dir_all(directory).expect("a directory");
    }
    for times in 1..=2 {
        let mut command = bench.process("crosscheck --codes yade --format json");
        command.current_dir(&here).env("TMPDIR", &temporary);
        let out = Path::new(named(b"-out $(touch touched)\n\xff"));
        let output = succeed(
            &bench,
            command.arg(flag("store", &store)).arg(flag("out", out)),
        );
        let rows = json_rows(&String::from_utf8_lossy(&output));
        assert!(
            rows.len() == 18 && rows.iter().all(|row| row["verdict"] == "agrees"),
            "time {times}"
        );
        assert!(here.join(out).join("crosscheck.csv").is_file());
        assert!(store.join("runs").is_dir());
        // The second time everything has to be in the store.
        let _ = fs::remove_dir_all(bench.path("replay"));
    }
}

#[test]
fn the_environment_may_name_the_store_in_any_bytes() {
    let bench = Bench::without_codes();
    let store = nested(&bench.path("store-"), Code::native());
    let mut command = bench.process("crosscheck --explain native/0.3/100");
    succeed(&bench, command.env("TRISTACK_STORE", &store));
    assert!(store.join("runs").is_dir());
}

#[test]
fn what_cannot_be_read_or_written_is_named_in_one_line() {
    let bench = Bench::without_codes();
    fs::write(bench.path("file"), "").expect("a file where a directory is wanted");
    let name = Path::new(named(b"file/new\nline\x1b[31m\xff"));
    for (line, flag_name) in [
        ("simulate --code native", "case"),
        ("simulate --code native --mu 0.3 --stiffness 100", "out"),
        ("crosscheck --codes native", "store"),
        ("crosscheck --codes native", "out"),
    ] {
        let output = bench
            .process(line)
            .arg(flag(flag_name, name))
            .output()
            .expect("it starts");
        let message = String::from_utf8(output.stderr).expect("text");
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(
            message.starts_with("error: ") && message.contains("new\\nline"),
            "{message}"
        );
        assert!(!message.contains('\x1b'), "{message:?}");
    }
}
