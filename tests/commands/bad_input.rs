//! Bad input: a clear error, the documented exit status, no panic, no partial file.

use crate::common::{Bench, standard_error};
use std::fs;

const CASE: &str = r#"
[stack]
floor_friction = 0.3
stiffness = 100.0

[convention]
pair = { torque_arm = 0.0 }
floor = { torque_arm = 0.0 }

[protocol]
preparation = { kind = "gravity-ramp", ramp_time = 100.0, rest_time = 100.0 }
time_step = 0.1
wall_speed = 1e-3
wall_travel = 0.8
sampling = { coarse_interval = 10.0, fine_from_travel = 0.6, fine_interval = 2.0 }
"#;

/// The message of a command that must fail with `status`, checked not to be a panic.
fn refusal(bench: &Bench, line: &str, status: i32) -> String {
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(status).stdout("");
    assert!(!message.contains("panicked"), "{line}: {message}");
    message
}

#[test]
fn flags_with_bad_values_are_named_with_what_would_be_accepted() {
    let bench = Bench::without_codes();
    for (line, parts) in [
        (
            "theory --mu 0.3 --stiffness -5",
            ["--stiffness", "-5", "from 1 to 1e8"],
        ),
        (
            "theory --mu 0.3 --stiffness nan",
            ["--stiffness", "NaN", "from 1 to 1e8"],
        ),
        (
            "theory --mu 0.3 --stiffness inf",
            ["--stiffness", "inf", "from 1 to 1e8"],
        ),
        (
            "theory --mu nan --stiffness 100",
            ["--mu", "NaN", "above 0"],
        ),
        (
            "theory --mu -0.3 --stiffness 100",
            ["--mu", "-0.3", "above 0"],
        ),
        (
            "theory --mu high --stiffness 100",
            ["--mu", "high", "critical"],
        ),
        (
            "theory --mu 0.3 --stiffness 100 --kappa 0",
            ["--kappa", "0", "above 0"],
        ),
        (
            "theory --mu 0.3 --stiffness 100 --pair-arm 700",
            ["--pair-arm", "700", "from -100 to 100"],
        ),
        (
            "simulate --code native --mu 0.3 --stiffness 100 --dt 0.9",
            ["--dt", "0.9", "at most 4.05e-1"],
        ),
        (
            "simulate --code native --mu 0.3 --stiffness 100 --speed 0",
            ["--speed", "0", "above 0"],
        ),
        (
            "simulate --code native --mu 0.3 --stiffness 100 --time-limit -1",
            ["--time-limit", "-1", "seconds"],
        ),
        (
            "simulate --code abaqus --mu 0.3 --stiffness 100",
            ["--code", "abaqus", "liggghts"],
        ),
        (
            "simulate --code yade --mu 0.3 --stiffness 100 --floor-arm -1",
            ["--floor-arm", "-1", "-0.5 for yade"],
        ),
        (
            "sweep --code lammps --mu 0.3 --stiffness 100 --history-update fixed",
            ["--history-update", "fixed", "projected for lammps"],
        ),
        (
            "sweep --code native --mu 0.5:0.1:0.1 --stiffness 100",
            ["--mu", "0.5:0.1:0.1", "A:B:STEP"],
        ),
        ("crosscheck --profile slow", ["--profile", "slow", "quick"]),
        (
            "crosscheck --codes native,matlab",
            ["--codes", "matlab", "yade"],
        ),
    ] {
        let message = refusal(&bench, line, 1);
        for part in parts {
            assert!(message.contains(part), "{line}: {message} lacks {part}");
        }
    }
}

#[test]
fn a_friction_at_which_nothing_yields_is_refused_with_the_range_that_does() {
    let bench = Bench::without_codes();
    for (mu, reason) in [
        ("0.05", "under its own weight"),
        ("0.8", "top wall reaches"),
    ] {
        let line = format!("simulate --code native --mu {mu} --stiffness 100 --out run");
        let message = refusal(&bench, &line, 1);
        assert!(message.contains(reason), "{message}");
        assert!(message.contains("between 0.0898 and 0.5476"), "{message}");
        assert!(!bench.path("run").exists());
    }
}

#[test]
fn case_files_are_checked_key_by_key() {
    let bench = Bench::without_codes();
    let changes = [
        (
            "stiffness = 100.0",
            "stiffness = -100.0",
            "`stack.stiffness` is -100",
        ),
        (
            "stiffness = 100.0",
            "stiffness = nan",
            "`stack.stiffness` is NaN",
        ),
        (
            "stiffness = 100.0",
            "stiffnes = 100.0",
            "unknown field `stiffnes`",
        ),
        ("floor_friction = 0.3", "", "missing field `floor_friction`"),
        (
            "stiffness = 100.0",
            "mu = 0.3",
            "duplicate field `floor_friction`",
        ),
        (
            "stiffness = 100.0",
            "stiffness = \"high\"",
            "invalid type: string",
        ),
        (
            "time_step = 0.1",
            "time_step = 4.0",
            "`protocol.time_step` is 4",
        ),
        (
            "wall_speed = 1e-3",
            "wall_speed = 1e-300",
            "`protocol.wall_speed` is",
        ),
        ("gravity-ramp", "magic", "unknown variant `magic`"),
        (
            "floor = { torque_arm = 0.0 }",
            "restitution = 2.0",
            "`convention.restitution` is 2",
        ),
    ];
    for (from, to, expected) in changes {
        fs::write(bench.path("case.toml"), CASE.replacen(from, to, 1)).expect("a case file");
        let message = refusal(&bench, "simulate --code native --case case.toml", 1);
        assert!(message.contains("case.toml"), "{message}");
        assert!(message.contains(expected), "{message} lacks {expected}");
    }
}

#[test]
fn the_unchanged_case_file_runs() {
    let bench = Bench::without_codes();
    fs::write(bench.path("case.toml"), CASE).expect("a case file");
    bench
        .tristack("simulate --code native --case case.toml")
        .assert()
        .success();
}

#[test]
fn a_case_file_that_cannot_be_read_is_named() {
    let bench = Bench::without_codes();
    for (name, expected) in [
        ("absent.toml", "absent.toml"),
        ("case.yaml", "must end in .toml or .json"),
    ] {
        if name == "case.yaml" {
            fs::write(bench.path(name), CASE).expect("a case file");
        }
        let message = refusal(&bench, &format!("simulate --code native --case {name}"), 1);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_named_before_anything_runs() {
    let bench = Bench::without_codes();
    fs::write(bench.path("file"), "").expect("a file where a directory is wanted");
    for line in [
        "simulate --code native --mu 0.3 --stiffness 100 --out file/run",
        "crosscheck --codes native --out file/results",
        "crosscheck --codes native --store file/store",
        "sweep --code native --mu 0.3 --stiffness 100 --out file/curve",
    ] {
        let message = refusal(&bench, line, 1);
        assert!(message.contains("cannot write file/"), "{message}");
        assert!(!message.contains("runs"), "something ran: {message}");
    }
}

#[test]
fn a_missing_code_asked_for_by_name_is_an_error_with_the_remedy() {
    let bench = Bench::without_codes();
    for line in [
        "crosscheck --codes liggghts",
        "record --codes liggghts",
        "simulate --code liggghts --mu 0.3 --stiffness 100",
        "sweep --code liggghts --mu 0.3 --stiffness 100",
    ] {
        let message = refusal(&bench, line, 3);
        assert!(message.contains("liggghts is not installed"), "{message}");
        assert!(message.contains("apt-get install"), "{message}");
    }
}

#[test]
fn wrong_usage_ends_with_status_1_and_help_with_0() {
    let bench = Bench::without_codes();
    refusal(&bench, "", 1);
    refusal(&bench, "frobnicate", 1);
    refusal(&bench, "theory --mu 0.3", 1);
    bench.tristack("--help").assert().code(0);
    bench.tristack("--version").assert().code(0);
}

#[test]
fn a_unit_that_is_not_meant_is_refused() {
    let bench = Bench::without_codes();
    let line = "predict --youngs 1MPa --mass 1g --radius 1cm --mu 0.3 --length 1M";
    let message = refusal(&bench, line, 1);
    assert!(message.contains("m, cm, mm, um or in"), "{message}");
}

#[test]
fn a_duration_that_rows_would_change_is_refused_with_those_that_are_accepted() {
    let bench = Bench::without_codes();
    let coarse = CASE.replace("fine_interval = 2.0", "fine_interval = 30.0");
    fs::write(bench.path("case.toml"), coarse).expect("a case");
    let message = refusal(&bench, "simulate --code native --case case.toml", 1);
    for part in ["ramp_time", "100", "multiple of 30", "such as 90 or 120"] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn a_duration_that_a_time_step_changes_a_little_is_said() {
    let bench = Bench::without_codes();
    let line = "simulate --code native --mu 0.3 --stiffness 100 --dt";
    let message = standard_error(&mut bench.tristack(&format!("{line} 0.3")));
    let said = "`protocol.preparation.ramp_time` is 100, and carried out as 100.8";
    assert!(message.contains(said), "{message}");
    let message = standard_error(&mut bench.tristack(&format!("{line} 0.1")));
    assert!(!message.contains("ramp_time"), "{message}");
}

#[test]
fn a_number_that_is_tiny_is_printed_with_an_exponent() {
    let bench = Bench::without_codes();
    for line in [
        "theory --mu 1e-300 --mu-d 1e-300 --stiffness 100",
        "sweep --code native --mu 1e-300 --stiffness 100",
        "simulate --code native --mu 1e-300 --stiffness 100",
        "predict --youngs 1MPa --mass 1g --radius 1cm --length 1cm --mu 1e-300",
        "crosscheck --explain native/1e-300/100",
    ] {
        let output = bench.tristack(line).output().expect("it runs");
        for text in [output.stdout, output.stderr] {
            let text = String::from_utf8(text).expect("text");
            assert!(!text.contains(&"0".repeat(30)), "{line}: {text}");
        }
    }
}

#[test]
fn frictions_that_numbers_do_not_tell_apart_are_refused() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --stiffness 100 --mu 0.3:0.3000000000000003:1e-17";
    let message = refusal(&bench, line, 1);
    assert!(message.contains("do not differ by 1e-17"), "{message}");
}
