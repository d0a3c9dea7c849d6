//! `tristack store`: what it lists, what it removes, and what it leaves alone.

use crate::common::{Bench, json, json_rows, standard_output};
use serde_json::Value;
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use tristack::model::sha256_hex;
use tristack::runs::Store;

const SWEEP: &str = "sweep --code native --mu 0.3 --stiffness 100 --format csv";
/// A moment after which no entry was written.
const EVERYTHING: &str = "--older-than 2999-01-01";

/// A store with the five runs of one yield force.
fn bench_with_runs() -> Bench {
    let bench = Bench::without_codes();
    bench.tristack(SWEEP).assert().code(0);
    bench
}

/// The directories of runs, by their addresses.
fn runs(bench: &Bench) -> Vec<PathBuf> {
    let below = |directory: &Path| {
        let entries = fs::read_dir(directory).expect("a directory");
        let paths = entries.map(|entry| entry.expect("an entry").path());
        paths.collect::<Vec<_>>()
    };
    let groups = below(&bench.path("store/runs"));
    let mut runs: Vec<PathBuf> = groups.iter().flat_map(|group| below(group)).collect();
    runs.sort();
    runs
}

fn address(run: &Path) -> String {
    let mut parts = run.iter().rev().map(|part| part.to_string_lossy());
    let (rest, first) = (parts.next(), parts.next());
    format!("{}{}", first.expect("a group"), rest.expect("a run"))
}

fn bytes(run: &Path) -> u64 {
    let files = fs::read_dir(run).expect("a run").flatten();
    files
        .map(|file| file.metadata().expect("a length").len())
        .sum()
}

/// Lets a run have been written so many days after the beginning of 1970.
fn set_day(run: &Path, day: u64) {
    let time = SystemTime::UNIX_EPOCH + Duration::from_secs(86_400 * day);
    for file in fs::read_dir(run).expect("a run").flatten() {
        let file = File::open(file.path()).expect("a file");
        file.set_modified(time).expect("its time is set");
    }
}

fn entries(bench: &Bench, choice: &str) -> Vec<Value> {
    let line = format!("store list --entries {choice} --format json");
    json_rows(&standard_output(&mut bench.tristack(&line)))
}

#[test]
fn a_list_sums_up_what_a_sweep_has_left() {
    let bench = bench_with_runs();
    let rows = json_rows(&standard_output(
        &mut bench.tristack("store list --format json"),
    ));
    assert_eq!(rows.len(), 1);
    let row = &rows[0];
    assert_eq!(row["kind"], "run");
    assert_eq!(row["code"], "native");
    assert_eq!(row["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(row["entries"], 5);
    let all: u64 = runs(&bench).iter().map(|run| bytes(run)).sum();
    assert_eq!(row["bytes"], all);
    let text = standard_output(&mut bench.tristack("store list"));
    assert!(text.contains("5 entries, "), "{text}");
}

#[test]
fn every_entry_is_listed_with_its_address_and_its_stack() {
    let bench = bench_with_runs();
    let rows = entries(&bench, "");
    let listed: Vec<&str> = rows
        .iter()
        .filter_map(|row| row["address"].as_str())
        .collect();
    let there: Vec<String> = runs(&bench).iter().map(|run| address(run)).collect();
    assert_eq!(listed, there);
    for row in &rows {
        assert_eq!(row["mu"], 0.3);
        assert_eq!(row["stiffness"], 100.0);
        assert_eq!(row["law_power"], 1.0);
        assert_eq!(row["bodies"], 2);
    }
    assert!(entries(&bench, "--code yade").is_empty());
    assert!(entries(&bench, "--kind probe,impact").is_empty());
    assert!(entries(&bench, "--outdated").is_empty());
}

#[test]
fn an_entry_is_shown_by_the_beginning_of_its_address() {
    let bench = bench_with_runs();
    let run = &runs(&bench)[2];
    let address = address(run);
    let line = format!("store show {}", &address[..12]);
    let text = standard_output(&mut bench.tristack(&line));
    for part in [
        &address,
        "native",
        "series.csv",
        "SHA256SUMS",
        "outdated    no",
    ] {
        assert!(text.contains(part), "{text} lacks {part}");
    }
    let tables = json(&standard_output(
        &mut bench.tristack(&format!("{line} --format json")),
    ));
    let [entry, files] = [0, 1].map(|table| tables["tables"][table]["rows"].clone());
    assert_eq!(entry[0]["address"], address);
    let sum: u64 = files
        .as_array()
        .expect("rows")
        .iter()
        .filter_map(|file| file["bytes"].as_u64())
        .sum();
    assert_eq!(sum, bytes(run));
}

#[test]
fn an_address_that_is_none_or_several_is_refused() {
    let bench = bench_with_runs();
    let refused = bench.tristack("store show xyz").assert().code(1);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("xyz"), "{message}");
    let mut command = bench.tristack("store show");
    let refused = command.arg("").assert().code(1);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("5 entries begin with it"), "{message}");
}

#[test]
fn what_is_older_goes_and_is_made_again_when_it_is_needed() {
    let bench = bench_with_runs();
    let first = standard_output(&mut bench.tristack(SWEEP));
    let all = runs(&bench);
    for run in &all[..2] {
        set_day(run, 10_000);
    }
    let prune = "store prune --older-than 2001-09-09";
    let text = standard_output(&mut bench.tristack(&format!("{prune} --dry-run")));
    assert!(text.contains("2 entries, "), "{text}");
    assert!(text.contains("would be removed"), "{text}");
    assert_eq!(runs(&bench), all);
    let text = standard_output(&mut bench.tristack(prune));
    assert!(text.contains("2 entries, "), "{text}");
    assert_eq!(runs(&bench), all[2..]);
    assert_eq!(
        fs::read_dir(bench.path("store/work"))
            .expect("work")
            .count(),
        0
    );
    assert_eq!(standard_output(&mut bench.tristack(SWEEP)), first);
    assert_eq!(runs(&bench), all);
}

#[test]
fn the_oldest_go_until_the_store_is_small_enough() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    for (run, day) in all.iter().zip([30, 10, 50, 20, 40]) {
        set_day(run, day);
    }
    let kept = bytes(&all[2]) + bytes(&all[4]);
    let line = format!("store prune --to {kept}B");
    bench.tristack(&line).assert().code(0);
    assert_eq!(runs(&bench), [all[2].clone(), all[4].clone()]);
    let text = standard_output(&mut bench.tristack(&line));
    assert!(text.starts_with("0 entries"), "{text}");
}

#[test]
fn an_entry_that_no_run_of_today_has_the_address_of_is_outdated() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    let group = bench.path("store/runs/00");
    fs::create_dir_all(&group).expect("a directory");
    let old = group.join("0".repeat(62));
    fs::rename(&all[1], &old).expect("another address");
    let text = standard_output(&mut bench.tristack(&format!("store show {}", "0".repeat(64))));
    assert!(text.contains("outdated    yes"), "{text}");
    bench.tristack("store prune --outdated").assert().code(0);
    let left: Vec<PathBuf> = all.iter().filter(|run| **run != all[1]).cloned().collect();
    assert_eq!(runs(&bench), left);
}

#[test]
fn runs_with_more_digits_that_explain_a_row_are_not_outdated() {
    let bench = Bench::without_codes();
    let explain = "crosscheck --explain native/0.3/100";
    bench.tristack(explain).assert().code(0);
    let all = entries(&bench, "--kind run").len();
    assert!(all > 5, "{all} runs: none with more digits");
    assert!(entries(&bench, "--outdated").is_empty());
    bench.tristack("store prune --outdated").assert().code(0);
    assert_eq!(entries(&bench, "--kind run").len(), all);
}

#[test]
fn nothing_is_removed_while_another_program_uses_the_store() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    let other = Store::open(&bench.path("store")).expect("a store");
    let refused = bench
        .tristack(&format!("store prune {EVERYTHING}"))
        .assert();
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(
        message.contains(&format!("process {} on ", std::process::id())),
        "{message}"
    );
    refused.code(1);
    assert_eq!(runs(&bench), all);
    drop(other);
    bench
        .tristack(&format!("store prune {EVERYTHING}"))
        .assert()
        .code(0);
    assert!(entries(&bench, "").is_empty());
}

#[test]
fn a_program_whose_session_cannot_be_read_keeps_others_from_removing() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    let other = Store::open(&bench.path("store")).expect("a store");
    let sessions = fs::read_dir(bench.path("store/sessions")).expect("sessions");
    for session in sessions.flatten() {
        // In place, so that it stays locked.
        fs::write(session.path(), "").expect("it is emptied");
    }
    let prune = format!("store prune {EVERYTHING}");
    let refused = bench.tristack(&prune).assert().code(1);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("unknown"), "{message}");
    assert_eq!(runs(&bench), all);
    drop(other);
    bench.tristack(&prune).assert().code(0);
    assert!(entries(&bench, "").is_empty());
}

#[test]
fn the_whole_address_names_all_that_has_it_and_nothing_that_begins_with_it() {
    let bench = bench_with_runs();
    let address = address(&runs(&bench)[0]);
    let store = bench.path("store");
    fs::write(store.join(format!("checkpoints/{address}.json")), "{}").expect("a checkpoint");
    let aside = store.join(format!("quarantine/{address}-1"));
    fs::create_dir_all(&aside).expect("a directory");
    fs::write(aside.join("series.csv"), "step").expect("a damaged series");
    let text = standard_output(&mut bench.tristack(&format!("store show {address}")));
    for part in ["kind        run", "kind        checkpoint", "series.csv"] {
        assert!(text.contains(part), "{text} lacks {part}");
    }
    assert!(!text.contains("quarantine"), "{text}");
    let text = standard_output(&mut bench.tristack(&format!("store show {address}-1")));
    assert!(text.contains("kind        quarantine"), "{text}");
}

/// Puts `new` for `old` in the file of `run` that says how it was made, and gives it the right digest.
fn change_origin(run: &Path, old: &str, new: &str) {
    let files = fs::read_dir(run).expect("a run").flatten();
    let texts = files.map(|file| (file.path(), fs::read_to_string(file.path()).expect("text")));
    let (path, text) = texts
        .filter(|(path, _)| !path.to_string_lossy().contains("summary"))
        .find(|(_, text)| text.contains(old))
        .expect("a file says it");
    let changed = text.replace(old, new);
    let sums = fs::read_to_string(run.join("SHA256SUMS")).expect("digests");
    let [before, after] = [&text, &changed].map(|text| sha256_hex(text.as_bytes()));
    assert!(sums.contains(&before), "{sums}");
    fs::write(path, changed).expect("it can be written");
    fs::write(run.join("SHA256SUMS"), sums.replace(&before, &after)).expect("it can be written");
}

#[test]
fn control_characters_of_an_entry_do_not_reach_the_terminal() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    change_origin(&all[0], "\"machine\": \"", "\"machine\": \"\\u001b[31m");
    change_origin(&all[1], "\"machine\": ", "\"\\u001b[31mmachine\": ");
    for (run, line) in [(&all[0], "machine     "), (&all[1], "unreadable  ")] {
        let show = format!("store show {}", address(run));
        let text = standard_output(&mut bench.tristack(&show));
        assert!(text.contains(line), "{text}");
        assert!(text.contains("\\u{1b}[31m"), "{text}");
        assert!(!text.contains('\x1b'), "{text:?}");
    }
}

#[test]
fn nothing_goes_but_entries_and_no_link_is_followed() {
    let bench = bench_with_runs();
    let all = runs(&bench);
    let store = bench.path("store");
    let elsewhere = bench.path("elsewhere");
    let run_elsewhere = elsewhere.join("f".repeat(62));
    fs::create_dir_all(&run_elsewhere).expect("a directory");
    for file in fs::read_dir(&all[0]).expect("a run").flatten() {
        fs::copy(file.path(), run_elsewhere.join(file.file_name())).expect("a copy");
    }
    // A group of runs and a run that are links; a run with a file of somebody else; and files with names of their own.
    symlink(&elsewhere, store.join("runs/zz")).expect("a link");
    let _ = fs::create_dir(store.join("runs/ff"));
    let link = store.join("runs/ff").join("e".repeat(62));
    symlink(&run_elsewhere, &link).expect("a link");
    fs::write(all[1].join("notes.txt"), "mine").expect("a file");
    for name in [
        "runs/notes.txt",
        "probes/monday.json",
        "quarantine/mine",
        "work/mine/x",
    ] {
        let path = store.join(name);
        fs::create_dir_all(path.parent().expect("a directory")).expect("a directory");
        fs::write(path, "mine").expect("a file");
    }
    bench
        .tristack(&format!("store prune {EVERYTHING}"))
        .assert()
        .code(0);
    assert!(all[1].join("series.csv").exists());
    assert!(link.is_symlink());
    assert!(run_elsewhere.join("series.csv").exists());
    for name in [
        "runs/notes.txt",
        "probes/monday.json",
        "quarantine/mine",
        "work/mine/x",
    ] {
        assert!(store.join(name).exists(), "{name} is gone");
    }
    for run in [&all[0], &all[2], &all[3], &all[4]] {
        assert!(!run.exists(), "{} is there", run.display());
    }
}

#[test]
fn what_is_in_quarantine_goes_only_by_its_kind() {
    let bench = bench_with_runs();
    let series = runs(&bench)[0].join("series.csv");
    fs::write(&series, "step").expect("it is damaged");
    bench.tristack(SWEEP).assert().code(0);
    assert_eq!(entries(&bench, "--kind quarantine").len(), 1);
    bench
        .tristack(&format!("store prune {EVERYTHING}"))
        .assert()
        .code(0);
    assert_eq!(entries(&bench, "").len(), 1);
    bench
        .tristack("store prune --kind quarantine")
        .assert()
        .code(0);
    assert!(entries(&bench, "").is_empty());
}

#[test]
fn the_files_of_failed_runs_and_checkpoints_are_listed_and_go() {
    let bench = bench_with_runs();
    let failed = bench.path("store/work/session-abcdefABCDEF/yade-x7");
    fs::create_dir_all(&failed).expect("a directory");
    fs::write(failed.join("log"), "it failed").expect("a log");
    let checkpoint = bench
        .path("store/checkpoints")
        .join("a".repeat(64) + ".json");
    fs::write(&checkpoint, "{}").expect("a checkpoint");
    let rows = entries(&bench, "--kind failed-run,checkpoint");
    let told: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                row["kind"].as_str(),
                row["code"].as_str(),
                row["bytes"].as_u64(),
            )
        })
        .collect();
    let expected = [
        (Some("checkpoint"), Some("native"), Some(2)),
        (Some("failed-run"), Some("yade"), Some(9)),
    ];
    assert_eq!(told, expected);
    bench.tristack("store prune --code yade").assert().code(0);
    assert!(!failed.exists() && checkpoint.exists());
    bench
        .tristack("store prune --kind checkpoint")
        .assert()
        .code(0);
    assert!(!checkpoint.exists());
    assert_eq!(runs(&bench).len(), 5);
}

#[test]
fn a_store_that_is_not_there_is_not_created_by_looking_at_it() {
    let bench = Bench::without_codes();
    for line in ["store list", "store prune --outdated"] {
        bench.tristack(line).assert().code(0);
        assert!(!bench.path("store").exists(), "{line}");
    }
}

#[test]
fn a_directory_that_is_no_store_is_refused() {
    let bench = Bench::without_codes();
    fs::create_dir(bench.path("letters")).expect("a directory");
    fs::write(bench.path("letters/one"), "mine").expect("a file");
    for line in [
        "store list --store letters",
        "store prune --outdated --store letters",
    ] {
        let refused = bench.tristack(line).assert().code(1);
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains("no store"), "{message}");
    }
}

#[test]
fn what_is_to_be_removed_has_to_be_said() {
    let bench = Bench::without_codes();
    for (line, part) in [
        ("store prune", "--older-than"),
        ("store prune --to 100", "such as 100MB"),
        ("store prune --older-than soon", "such as 12h"),
    ] {
        let refused = bench.tristack(line).assert().code(1);
        let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(message.contains(part), "{message} lacks {part}");
    }
}
