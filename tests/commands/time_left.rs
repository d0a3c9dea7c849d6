//! Commands with little time end before it is over, say so, and go on from there.

use crate::common;
use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, wait_for};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::fs;
use std::process::{Output, Stdio};
use tristack::code::Code;
use tristack::model::Stack;
use tristack::study::yield_force::Profile;

/// Exit statuses.
const OUT_OF_TIME: Option<i32> = Some(6);
const INTERRUPTED: Option<i32> = Some(130);
const FAILED: Option<i32> = Some(3);

fn run(bench: &Bench, line: &str) -> (Option<i32>, String, String) {
    let Output {
        status,
        stdout,
        stderr,
    } = bench.tristack(line).output().expect("it runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (status.code(), text(stdout), text(stderr))
}

#[test]
fn without_time_nothing_is_begun_and_the_same_command_goes_on() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --mu 0.2,0.3 --stiffness 100 --format csv --out rows";
    let (status, _, message) = run(&bench, &format!("{line} --time-left 1ns"));
    assert_eq!(status, OUT_OF_TIME, "{message}");
    assert!(
        message.contains("out of time with 0 of 2 rows complete"),
        "{message}"
    );
    assert!(
        message.contains("the same command goes on from here"),
        "{message}"
    );
    assert!(
        !bench.path("rows/crosscheck.csv").exists(),
        "nothing is written"
    );
    let (status, rows, message) = run(&bench, &format!("{line} --time-left 1-00:00:00"));
    assert_eq!(status, Some(0), "{message}");
    let (_, undisturbed, _) = run(&Bench::without_codes(), line);
    assert_eq!(rows, undisturbed);
}

/// The seconds that YADE takes by its manifest: for a `step`, or for a `start`.
fn seconds(key: &str) -> f64 {
    let manifest = fs::read_to_string(common::project().join("yade_scripts/code.toml"));
    let manifest: toml::Value = toml::from_str(&manifest.expect("a manifest")).expect("TOML");
    manifest["seconds"][key].as_float().expect("a number")
}

/// Estimated seconds of the runs of YADE for a stack, without their start.
fn estimates(profile: Profile, stack: &Stack) -> Vec<f64> {
    let step = seconds("step");
    let yade = Code::named("yade").expect("it is built in");
    let measurements = profile.measurements(&[yade.as_declared().expect("nothing is left out")]);
    let row = measurements.iter().find(|row| row.stack == *stack);
    let cases = row.expect("it is one of the figure").cases.iter();
    cases.map(|case| case.total_steps() as f64 * step).collect()
}

#[test]
fn a_run_for_which_no_start_has_the_time_fails_with_its_estimate() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let estimates = estimates(Profile::Literal, &Stack::paper(0.4, 100.0)).into_iter();
    let shortest = estimates.fold(f64::INFINITY, f64::min);
    assert!(shortest > 300.0, "{shortest} s");
    let line = "crosscheck --profile literal --codes yade --mu 0.4 --stiffness 100 --format csv";
    let (status, rows, message) = run(&bench, &format!("{line} --time-left 5min"));
    assert_eq!(status, FAILED, "{message}");
    assert!(rows.contains(",failed"), "{rows}");
    let found = message.contains("by estimate it takes")
        && message.contains("270 s of --time-left are there for it");
    assert!(found, "{message}");
}

/// A command for one literal yield force by YADE that can use so many `seconds` more than the shortest run without its
/// start takes, and the time of that run with its start.
fn literal_line(more: f64) -> (String, f64) {
    let estimates = estimates(Profile::Literal, &Stack::paper(0.4, 100.0)).into_iter();
    let shortest = estimates.fold(f64::INFINITY, f64::min);
    assert!(shortest > 300.0, "{shortest} s");
    // Half a minute is kept back.
    let left = (1e3 * (shortest + more + 30.0)).round();
    let line = "crosscheck --profile literal --codes yade --mu 0.4 --stiffness 100 --format csv";
    (
        format!("{line} --time-left {left}ms"),
        shortest + seconds("start"),
    )
}

#[test]
fn the_start_of_a_call_counts() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let (line, needed) = literal_line(seconds("start") - 0.5);
    let (status, _, message) = run(&bench, &line);
    assert_eq!(status, FAILED, "{message}");
    let (needed, usable) = (needed.ceil(), (needed - 0.5).floor());
    let parts = [
        format!("by estimate it takes {needed} s"),
        format!("{usable} s of --time-left are there for it"),
    ];
    for part in parts {
        assert!(message.contains(&part), "{message} lacks {part}");
    }
}

/// The time is enough for the run and not for what comes before it.
#[test]
fn a_run_that_no_start_comes_to_is_not_postponed_for_ever() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let (line, _) = literal_line(seconds("start"));
    // The first start probes the code, which the second does not repeat.
    let starts: Vec<_> = (0..2).map(|_| run(&bench, &line)).collect();
    let (status, _, message) = &starts[1];
    assert_eq!(*status, FAILED, "{message}");
    assert!(message.contains("by estimate it takes"), "{message}");
}

#[test]
fn runs_for_which_too_little_time_is_left_are_not_begun() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let estimates = estimates(Profile::Literal, &Stack::paper(0.2, 1e4));
    let longest = estimates.iter().copied().fold(0.0, f64::max);
    // Enough for each of them and not for all; a tenth is kept back.
    let left = (seconds("start") + (estimates.iter().sum::<f64>() + longest) / 2.0) / 0.9;
    let line = "crosscheck --profile literal --codes yade --mu 0.2 --stiffness 1e4 --jobs 1";
    let (status, _, message) = run(&bench, &format!("{line} --time-left {left:.0}s"));
    assert_eq!(status, OUT_OF_TIME, "{message}");
    let told = "are not begun: by estimate they would not end in the time that is left";
    assert!(message.contains(told), "{message}");
    // Nothing is recorded of these runs, which are long enough for a busy machine: that they are begun is what shows.
    let (status, _, message) = run(&bench, line);
    assert_eq!(status, FAILED, "{message}");
    let begun = message.matches("the program ended without a series");
    assert!(begun.count() >= estimates.len(), "{message}");
    assert!(!message.contains(told), "{message}");
}

#[test]
fn words_that_are_no_duration_are_refused() {
    let bench = Bench::without_codes();
    for word in ["90", "0s", "1:2:3:4", "soon"] {
        let line = format!("crosscheck --codes native --time-left {word}");
        let (status, _, message) = run(&bench, &line);
        assert_eq!(status, Some(1), "{message}");
        assert!(message.contains("[D-][HH:]MM:SS"), "{message}");
    }
}

/// A crosscheck whose runs last until they are ended, once it makes one; and what it prints.
fn ended_by(signal: Signal) -> (Option<i32>, String) {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| {
        Disturbance::Instead("touch begun; exec sleep 1000")
    });
    let mut command = bench.process("crosscheck --codes yade --jobs 1");
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let program = command.spawn().expect("it starts");
    let work = bench.path("store/work");
    wait_for(|| {
        let files = work.is_dir().then(|| common::files_below(&work))?;
        files
            .iter()
            .any(|file| file.ends_with("begun"))
            .then_some(())
    });
    let process = Pid::from_raw(program.id() as i32);
    kill(process, signal).expect("it is there");
    let output = program.wait_with_output().expect("it ends");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), message)
}

#[test]
fn the_signal_that_batch_systems_send_before_the_end_ends_the_time() {
    let (status, message) = ended_by(Signal::SIGUSR1);
    assert_eq!(status, OUT_OF_TIME, "{message}");
    let parts = [
        "out of time: finished runs are kept",
        "the same command goes on from here",
    ];
    for part in parts {
        assert!(message.contains(part), "{message}");
    }
    assert_eq!(ended_by(Signal::SIGTERM).0, INTERRUPTED);
}

/// Batch systems send SIGTERM to all processes of a job, and a code may end before tristack learns of it.
#[test]
fn a_code_that_ends_by_the_signal_that_tristack_gets_as_well_has_not_failed() {
    let bench = Bench::with_system_programs();
    // The shell, its guard, tristack.
    let both = "kill -TERM $(cut -d' ' -f4 /proc/$PPID/stat); kill -TERM $$; sleep 1000";
    replay::install(&bench, |_| Disturbance::Instead(both));
    let (status, _, message) = run(&bench, "crosscheck --codes yade --jobs 1");
    assert_eq!(status, INTERRUPTED, "{message}");
    assert!(!message.contains("failed"), "{message}");
    let work = fs::read_dir(bench.path("store/work")).expect("a directory");
    assert_eq!(work.count(), 0, "nothing is kept as evidence");
}

/// The numbers of docs/cluster.md on the paper's figure 2(a) at its literal settings by LAMMPS.
#[test]
fn the_page_on_clusters_says_how_many_steps_the_literal_figure_takes() {
    let lammps = Code::named("lammps").expect("it is built in");
    let measurements =
        Profile::Literal.measurements(&[lammps.as_declared().expect("nothing is left out")]);
    let cases = measurements.iter().flat_map(|row| &row.cases);
    let steps: Vec<u64> = cases.map(|case| case.total_steps()).collect();
    let (all, longest) = (steps.iter().sum::<u64>(), steps.iter().max());
    let said = format!(
        "{} runs, {:.2} × 10¹⁰ steps in all, {:.2} × 10⁹ in the longest",
        steps.len(),
        all as f64 / 1e10,
        *longest.expect("a run") as f64 / 1e9
    );
    let page = fs::read_to_string(common::project().join("docs/cluster.md")).expect("a page");
    assert!(page.contains(&said), "docs/cluster.md does not say: {said}");
}
