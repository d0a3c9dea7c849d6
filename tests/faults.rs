//! Engines that crash, hang or lie: each becomes a `failed` verdict with everything needed to look into
//! it, and nothing else is lost.

mod common;

use common::replay::{self, Disturbance};
use common::{Bench, json, standard_error};
use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};
use tristack::stack::Case;

const CROSSCHECK: &str = "crosscheck --engines yade --format json";

/// The slowest run of one stack of the quick profile.
fn is_victim(case: &Case) -> bool {
    let stack = &case.stack;
    stack.floor_friction == 0.2 && stack.stiffness == 100.0 && case.protocol.wall_speed < 2e-5
}

struct Outcome {
    status: Option<i32>,
    rows: Vec<serde_json::Value>,
    message: String,
}

impl Outcome {
    fn count(&self, verdict: &str) -> usize {
        self.rows
            .iter()
            .filter(|row| row["verdict"] == verdict)
            .count()
    }
}

fn crosscheck(bench: &Bench, options: &str) -> Outcome {
    let mut command = bench.tristack(&format!("{CROSSCHECK} {options}"));
    let output = command.output().expect("it runs");
    let rows = json(&String::from_utf8_lossy(&output.stdout));
    Outcome {
        status: output.status.code(),
        rows: rows.as_array().expect("a list of rows").clone(),
        message: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// A crosscheck in which one run is disturbed; checks that exactly its row has failed, that the message
/// names engine, case and run directory, and that everything else agrees.
fn with_victim(disturbance: impl Fn() -> Disturbance, options: &str, expected: &[&str]) {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if is_victim(case) {
            disturbance()
        } else {
            Disturbance::None
        }
    });
    let outcome = crosscheck(&bench, options);
    assert_eq!(outcome.status, Some(3), "{}", outcome.message);
    assert_eq!(outcome.count("failed"), 1, "{}", outcome.message);
    assert_eq!(outcome.count("agrees"), 17, "{}", outcome.message);
    let named = [
        "yade failed on mu = 0.2, stiffness = 100",
        "run directory: ",
    ];
    for part in named.iter().chain(expected) {
        assert!(
            outcome.message.contains(part),
            "{} lacks {part}",
            outcome.message
        );
    }
    let directory = outcome
        .message
        .split("run directory: ")
        .nth(1)
        .expect("a directory");
    let directory = directory.lines().next().expect("a line");
    assert!(
        fs::exists(format!("{directory}/stack.py")).expect("readable"),
        "{directory}"
    );
}

#[test]
fn undisturbed_replay_agrees_everywhere() {
    let bench = Bench::with_system_programs();
    let recorded = replay::install(&bench, |_| Disturbance::None);
    assert_eq!(recorded, 90);
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert_eq!(outcome.count("agrees"), 18);
    let replayed = |row: &serde_json::Value| row["version"] == "Yade version: replayed";
    assert!(outcome.rows.iter().all(replayed));
}

#[test]
fn a_crash_fails_one_row_and_the_rest_of_the_process_is_made_up_for() {
    let crash = || Disturbance::Instead("echo 'Segmentation fault, sorry' >&2; kill -SEGV $$");
    with_victim(
        crash,
        "",
        &["signal: 11", "stderr.txt: Segmentation fault, sorry"],
    );
}

#[test]
fn an_error_status_fails_one_row() {
    let stop = || Disturbance::Instead("echo 'no such material' >&2; exit 7");
    with_victim(
        stop,
        "",
        &["exit status: 7", "stderr.txt: no such material"],
    );
}

#[test]
fn a_case_that_is_skipped_fails_alone() {
    with_victim(
        || Disturbance::Instead("echo skipped"),
        "",
        &["without a series"],
    );
}

#[test]
fn a_hang_is_killed_at_the_time_limit() {
    let hang = || Disturbance::Instead("echo waiting; sleep 600");
    with_victim(
        hang,
        "--time-limit 1",
        &["no series after 1.0 s", "stdout.txt: waiting"],
    );
}

#[test]
fn a_truncated_series_fails_one_row() {
    let cut = |series: String| series.lines().take(100).collect::<Vec<_>>().join("\n");
    with_victim(
        move || Disturbance::Change(cut),
        "",
        &["the series has 99 rows, but must have"],
    );
}

#[test]
fn a_row_cut_in_the_middle_fails_one_row() {
    let cut = |series: String| series[..series.len() / 2].to_owned();
    with_victim(
        move || Disturbance::Change(cut),
        "",
        &["the series is not usable: row "],
    );
}

#[test]
fn garbled_text_fails_one_row() {
    let garble = |series: String| series.replacen("0.", "\u{fffd}x", 40);
    with_victim(
        move || Disturbance::Change(garble),
        "",
        &["the series is not usable: row "],
    );
}

#[test]
fn a_value_that_is_not_a_number_fails_one_row_and_is_named() {
    let poison = |series: String| {
        let mut lines: Vec<String> = series.lines().map(str::to_owned).collect();
        let mut cells: Vec<String> = lines[50].split(',').map(str::to_owned).collect();
        cells[2] = "NaN".to_owned();
        lines[50] = cells.join(",");
        lines.join("\n")
    };
    with_victim(
        move || Disturbance::Change(poison),
        "",
        &["row 50", "`wall_force` is NaN"],
    );
}

#[test]
fn wrong_columns_fail_one_row() {
    let rename = |series: String| series.replacen("wall_force", "force", 1);
    with_victim(
        move || Disturbance::Change(rename),
        "",
        &["the columns are `step,time,force"],
    );
}

#[test]
fn rows_at_other_steps_than_planned_fail_one_row() {
    let shift = |series: String| {
        let mut lines: Vec<&str> = series.lines().collect();
        lines.swap(10, 11);
        lines.join("\n")
    };
    with_victim(
        move || Disturbance::Change(shift),
        "",
        &["row 10 is at step"],
    );
}

#[test]
fn a_code_that_is_wrong_by_a_thousandth_differs() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if case.stack.floor_friction == 0.3 {
            Disturbance::Change(|series| scale_wall_force(&series, 1.001))
        } else {
            Disturbance::None
        }
    });
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    assert_eq!(outcome.count("differs"), 3);
    assert_eq!(outcome.count("agrees"), 15);
}

fn scale_wall_force(series: &str, factor: f64) -> String {
    let lines = series.lines().enumerate().map(|(index, line)| {
        if index == 0 {
            return line.to_owned();
        }
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        let force: f64 = cells[2].parse().expect("a number");
        cells[2] = (force * factor).to_string();
        cells.join(",")
    });
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn a_code_that_never_slips_has_no_yield_and_is_no_pass() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if case.stack.stiffness == 1e4 {
            Disturbance::Change(|series| {
                let cut_tangential = |line: &str| {
                    let mut cells: Vec<&str> = line.split(',').collect();
                    if cells[0] != "step" {
                        (cells[13], cells[15]) = ("0.0", "0.0");
                    }
                    cells.join(",")
                };
                series
                    .lines()
                    .map(cut_tangential)
                    .collect::<Vec<_>>()
                    .join("\n")
            })
        } else {
            Disturbance::None
        }
    });
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    assert_eq!(outcome.count("no-yield"), 6);
    assert!(
        outcome.message.contains("no slip followed by a peak"),
        "{}",
        outcome.message
    );
}

#[test]
fn what_was_finished_before_a_failure_is_not_run_again() {
    let bench = Bench::with_system_programs();
    let crash = || Disturbance::Instead("exit 7");
    replay::install(&bench, |case| {
        if is_victim(case) {
            crash()
        } else {
            Disturbance::None
        }
    });
    assert_eq!(crosscheck(&bench, "").status, Some(3));
    replay::install(&bench, |_| Disturbance::None);
    fs::remove_dir_all(bench.path("replay")).expect("the old replay");
    let recorded = replay::install(&bench, |_| Disturbance::None);
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    let reused = format!("{} of {recorded} runs are there already", recorded - 1);
    assert!(outcome.message.contains(&reused), "{}", outcome.message);
}

#[test]
fn a_damaged_run_in_the_store_is_computed_anew_with_a_warning() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    assert_eq!(crosscheck(&bench, "").status, Some(0));
    let shelf = fs::read_dir(bench.path("store/runs"))
        .expect("runs")
        .flatten()
        .next();
    let run = fs::read_dir(shelf.expect("a shelf").path())
        .expect("a shelf")
        .flatten()
        .next();
    fs::write(run.expect("a run").path().join("series.csv"), "step\n").expect("damage");
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert!(
        outcome
            .message
            .contains("damaged run in the store, computed anew"),
        "{}",
        outcome.message
    );
    assert!(!crosscheck(&bench, "").message.contains("damaged"));
}

#[test]
fn an_interrupt_stops_the_engine_keeps_what_is_done_and_ends_with_130() {
    let bench = Bench::with_system_programs();
    let pid_file = bench.path("pid");
    replay::install(&bench, |case| {
        if is_victim(case) {
            Disturbance::Instead(". ../../../../hang.sh")
        } else {
            Disturbance::None
        }
    });
    fs::write(
        bench.path("hang.sh"),
        format!("echo $$ > {}; sleep 600", pid_file.display()),
    )
    .expect("a script");
    let child = bench
        .process(CROSSCHECK)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let engine = wait_for(|| {
        fs::read_to_string(&pid_file)
            .ok()
            .filter(|text| text.ends_with('\n'))
    });
    send_interrupt(child.id());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("interrupted; what was finished is kept"),
        "{message}"
    );
    let gone = || (!fs::exists(format!("/proc/{}", engine.trim())).unwrap_or(true)).then_some(());
    wait_for(gone);
}

fn send_interrupt(process: u32) {
    let status = std::process::Command::new("kill")
        .args(["-INT", &process.to_string()])
        .status();
    assert!(status.expect("kill runs").success());
}

fn wait_for<T>(mut condition: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        if let Some(value) = condition() {
            return value;
        }
        assert!(start.elapsed() < Duration::from_secs(20), "waited in vain");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn simulate_reports_a_crash_with_the_last_lines_and_keeps_the_deck() {
    let bench = Bench::with_system_programs();
    bench.install("liggghts", "echo 'ERROR: Invalid model specified'; exit 1");
    let line = "simulate --engine liggghts --mu 0.3 --stiffness 100 --out run";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(3).stdout("");
    assert!(
        message.contains("liggghts failed on mu = 0.3, stiffness = 100"),
        "{message}"
    );
    assert!(
        message.contains("stdout.txt: ERROR: Invalid model specified"),
        "{message}"
    );
    assert!(bench.path("run/stack.in").exists());
    assert!(!bench.path("run/series.csv").exists());
}

#[test]
fn an_engine_that_succeeds_without_output_fails() {
    let bench = Bench::with_system_programs();
    bench.install("liggghts", "exit 0");
    let line = "simulate --engine liggghts --mu 0.3 --stiffness 100";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(3);
    assert!(message.contains("cannot read log.liggghts"), "{message}");
}
