//! The store as a user meets it: on disk, and with several programs at it.

use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, standard_output, wait_for};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tristack::model::sha256_hex;

const SWEEP: &str = "sweep --code native --mu 0.3 --stiffness 100 --format csv";

fn entries(bench: &Bench) -> Vec<PathBuf> {
    let below = |directory: &Path| {
        let entries = fs::read_dir(directory).expect("a directory");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        paths.collect::<Vec<_>>()
    };
    let groups = below(&bench.path("store/runs"));
    groups.iter().flat_map(|group| below(group)).collect()
}

#[test]
fn an_entry_can_be_checked_without_tristack() {
    let bench = Bench::without_codes();
    bench.tristack(SWEEP).assert().code(0);
    let entries = entries(&bench);
    assert_eq!(entries.len(), 5);
    let is_right = |entry: &Path| {
        let mut command = Command::new("sha256sum");
        command.args(["--check", "--strict", "--quiet", "SHA256SUMS"]);
        let output = command.current_dir(entry).output().expect("it runs");
        output.status.success()
    };
    for entry in &entries {
        assert!(is_right(entry), "{}", entry.display());
    }
    fs::write(entries[0].join("series.csv"), "step").expect("it can be written");
    assert!(!is_right(&entries[0]));
}

#[test]
fn a_damaged_entry_is_put_aside_and_kept() {
    let bench = Bench::without_codes();
    let first = standard_output(&mut bench.tristack(SWEEP));
    let entry = &entries(&bench)[0];
    let path = entry.join("series.csv");
    let right = fs::read(&path).expect("a series");
    fs::write(&path, &right[1..]).expect("it can be written");
    let output = bench.tristack(SWEEP).output().expect("it runs");
    assert_eq!(String::from_utf8_lossy(&output.stdout), first);
    let message = String::from_utf8_lossy(&output.stderr);
    let aside = bench.path("store/quarantine");
    let aside = fs::read_dir(aside).expect("a directory").next();
    let aside = aside.expect("an entry").expect("it is readable").path();
    for part in [
        "damaged run in the store, made anew",
        "series.csv: its SHA-256 is",
        &aside.display().to_string(),
    ] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
    let kept = fs::read(aside.join("series.csv")).expect("a series");
    assert_eq!(kept, right[1..]);
    assert_eq!(fs::read(path).expect("a series"), right);
}

fn summary_file(entry: &Path) -> PathBuf {
    let files = fs::read_dir(entry).expect("an entry");
    let mut files = files.map(|file| file.expect("a file").path());
    let is_summary = |path: &PathBuf| path.to_string_lossy().contains("/summary-");
    files.find(is_summary).expect("a summary")
}

#[test]
fn a_summary_stands_in_for_the_series_that_it_was_made_of_and_for_no_other() {
    let bench = Bench::without_codes();
    let first = standard_output(&mut bench.tristack(SWEEP));
    let entries = entries(&bench);
    let [file, other] = [0, 1].map(|entry| summary_file(&entries[entry]));
    let right = fs::read_to_string(&file).expect("a summary");
    let other = fs::read_to_string(other).expect("a summary");
    let (before, after) = right.split_once("\"force\":").expect("a force");
    let flipped = format!("{before}\"force\":1{after}");
    for wrong in [&flipped, &other, &String::new()] {
        fs::write(&file, wrong).expect("it can be written");
        assert_eq!(standard_output(&mut bench.tristack(SWEEP)), first);
        assert_eq!(fs::read_to_string(&file).expect("a summary"), right);
    }
    fs::remove_file(&file).expect("it is there");
    assert_eq!(standard_output(&mut bench.tristack(SWEEP)), first);
    assert_eq!(fs::read_to_string(&file).expect("a summary"), right);
    // One that is sealed is believed: the series is not read.
    let (_, content) = flipped.split_once('\n').expect("a digest");
    let sealed = format!("{}\n{content}", sha256_hex(content.as_bytes()));
    fs::write(&file, sealed).expect("it can be written");
    assert_ne!(standard_output(&mut bench.tristack(SWEEP)), first);
}

#[test]
fn a_store_of_another_format_is_refused_and_left_as_it_is() {
    let bench = Bench::without_codes();
    let store = bench.path("store");
    for (file, content) in [
        ("format", "tristack store, format 3\n"),
        ("runs/00/old", ""),
    ] {
        let path = store.join(file);
        fs::create_dir_all(path.parent().expect("a directory")).expect("a directory");
        fs::write(&path, content).expect("a file");
        let private = fs::Permissions::from_mode(0o700);
        for directory in path
            .ancestors()
            .skip(1)
            .take_while(|path| path.starts_with(&store))
        {
            fs::set_permissions(directory, private.clone()).expect("permissions");
        }
        let output = bench.tristack(SWEEP).output().expect("it runs");
        assert_eq!(output.status.code(), Some(1));
        let message = String::from_utf8_lossy(&output.stderr);
        for part in [
            "store/format: ",
            "accepted is a store with `tristack store, format 2`",
        ] {
            assert!(message.contains(part), "{message}");
        }
        assert_eq!(fs::read_dir(&store).expect("a store").count(), 1);
        fs::remove_dir_all(&store).expect("it can be removed");
    }
}

#[test]
fn runs_are_kept_though_nobody_listens_any_more() {
    let bench = Bench::without_codes();
    let mut command =
        bench.process("sweep --code native --mu 0.2:0.5:0.02 --stiffness 100 --jobs 2");
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("it starts");
    drop(child.stderr.take());
    drop(child.stdout.take());
    let status = child.wait().expect("it ends");
    assert_eq!(status.code(), Some(0));
    assert_eq!(entries(&bench).len(), 16 * 5);
}

#[test]
fn native_runs_that_are_late_are_told_of_one_by_one() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.2:0.5:0.05 --stiffness 1e6 --jobs 1 --time-limit 0.001";
    let output = bench.tristack(&format!("{line} --format csv")).output();
    let output = output.expect("it runs");
    let rows = String::from_utf8(output.stdout).expect("text");
    assert_eq!(rows.lines().count(), 1 + 7, "{rows}");
    assert_eq!(output.status.code(), Some(3));
}

fn start(bench: &Bench, line: &str) -> std::process::Child {
    let mut command = bench.process(line);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("it starts")
}

/// A code that notes every series it is asked for, and takes as long as `wait`, a shell command.
fn install_slow_replay(bench: &Bench, wait: &str) -> PathBuf {
    replay::install(bench, |_| Disturbance::None);
    let program = bench.path("programs/yade");
    let asked = bench.path("asked");
    let script = fs::read_to_string(&program).expect("a script");
    let slow = script.replace(
        "address=$(",
        &format!(
            "[ $result = probe.csv ] || {{ echo $directory >> {}; {wait}; }}; address=$(",
            asked.display()
        ),
    );
    assert_ne!(slow, script);
    fs::write(program, slow).expect("a script");
    asked
}

#[test]
fn two_programs_at_one_store_make_every_run_once() {
    let bench = Bench::with_system_programs();
    let asked = install_slow_replay(&bench, "sleep 0.1");
    let line = "crosscheck --codes yade --jobs 2 --format csv";
    let programs = [start(&bench, line), start(&bench, line)];
    let numbers = [programs[0].id(), programs[1].id()];
    let outputs = programs.map(|program| program.wait_with_output().expect("it ends"));
    let tell = |output: &Output| String::from_utf8_lossy(&output.stderr).into_owned();
    let [one, other] = &outputs;
    assert_eq!(one.status.code(), Some(0), "{}", tell(one));
    assert_eq!(one.stdout, other.stdout, "{}", tell(other));
    let asked = fs::read_to_string(asked).expect("a list");
    assert_eq!(asked.lines().count(), 90);
    let waited = numbers.iter().filter(|number| {
        let named = format!("that process {number} on ");
        outputs.iter().any(|output| tell(output).contains(&named))
    });
    assert!(waited.count() > 0, "{}\n{}", tell(one), tell(other));
}

#[test]
fn what_a_killed_program_was_making_is_made_by_the_one_that_waits() {
    let bench = Bench::with_system_programs();
    let hold = bench.path("hold");
    fs::write(&hold, "").expect("a file");
    let wait = format!("while [ -e {} ]; do sleep 0.01; done", hold.display());
    let asked = install_slow_replay(&bench, &wait);
    let line = "sweep --code yade --mu 0.3 --stiffness 100 --jobs 1 --format csv";
    let mut first = start(&bench, line);
    wait_for(|| asked.exists().then_some(()));
    let told = bench.path("told");
    let mut second = bench.process(line);
    second.stdout(Stdio::null());
    second.stderr(fs::File::create(&told).expect("a file"));
    let mut second = second.spawn().expect("it starts");
    let message = || fs::read_to_string(&told).expect("text");
    wait_for(|| message().contains("waiting for").then_some(()));
    first.kill().expect("it can be killed");
    let status = first.wait().expect("it ends");
    assert_eq!(status.signal(), Some(9), "it was still making its runs");
    fs::remove_file(hold).expect("it is there");
    let status = second.wait().expect("it ends");
    assert_eq!(status.code(), Some(0), "{}", message());
    let store = bench.path("store");
    for directory in ["sessions", "work"] {
        let left = fs::read_dir(store.join(directory)).expect("a directory");
        assert_eq!(left.count(), 0, "{directory}");
    }
    assert_eq!(entries(&bench).len(), 5);
}
