//! Tables on terminals: their width, their colours, and what goes to a pipe.

use crate::common;
use crate::common::{Bench, standard_error, standard_output};
use console::measure_text_width;
use std::process::Command;

/// Commands that print tables.
const LINES: [&str; 11] = [
    "theory --mu 0.05,critical --stiffness 1e2:1e3:x10",
    "crosscheck --codes native",
    "crosscheck --mu 0.3",
    "crosscheck --codes native --mu 0.3 --summary",
    "crosscheck --explain native/0.3/100",
    "simulate --code native --mu 0.3 --stiffness 1e2",
    "trajectories",
    "impacts --codes native",
    "codes",
    "probe",
    "predict --youngs 1MPa --mass 1g --radius 1cm --length 1cm --mu 0.3",
];

fn widest(text: &str) -> usize {
    text.lines().map(measure_text_width).max().unwrap_or(0)
}

/// The lines of `text` but for how long a run took.
fn without_the_clock(text: &str) -> Vec<&str> {
    let lines = text.lines();
    lines.filter(|line| !line.contains("wall time")).collect()
}

#[test]
fn what_people_read_is_as_wide_as_columns_says() {
    let bench = Bench::without_codes();
    for line in LINES {
        for columns in [80, 50] {
            let mut command = bench.tristack(line);
            let text = standard_output(command.env("COLUMNS", columns.to_string()));
            assert!(text.lines().count() > 3, "{line}: {text}");
            assert!(widest(&text) <= columns, "{line}, {columns}:\n{text}");
        }
        let whole = standard_output(&mut bench.tristack(line));
        let mut command = bench.tristack(line);
        let wide = standard_output(command.env("COLUMNS", "1000"));
        assert_eq!(
            without_the_clock(&wide),
            without_the_clock(&whole),
            "{line}"
        );
    }
}

#[test]
fn columns_that_are_left_out_are_named_with_the_way_to_see_them() {
    let bench = Bench::without_codes();
    let mut command = bench.tristack("crosscheck --codes native --mu 0.3 --stiffness 1e2");
    let text = standard_output(command.env("COLUMNS", "80"));
    let heading = "│ stiffness ┆  mu ┆ code   ┆";
    assert!(text.contains(heading), "{text}");
    let note = text.split("left out here: ").nth(1).expect("a note");
    assert!(
        note.contains("source") && note.contains("--format csv"),
        "{text}"
    );
    let whole =
        standard_output(&mut bench.tristack("crosscheck --codes native --mu 0.3 --stiffness 1e2"));
    assert!(whole.contains("┆ source ┆"), "{whole}");
    assert!(!whole.contains("left out"), "{whole}");
}

#[test]
fn verdicts_are_coloured_where_that_is_wanted_and_never_in_files() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --mu 0.3 --stiffness 1e2";
    let green = "\u{1b}[32magrees\u{1b}[0m";
    let with = |line: &str, variables: &[(&str, &str)]| {
        let mut command = bench.tristack(line);
        command.envs(variables.iter().copied());
        standard_output(&mut command)
    };
    let forced = [("CLICOLOR_FORCE", "1")];
    let coloured = with(line, &forced);
    assert!(coloured.contains(green), "{coloured}");
    let plain = with(line, &[]);
    assert_eq!(console::strip_ansi_codes(&coloured), plain);
    assert!(!plain.contains('\u{1b}'), "{plain}");
    assert_eq!(
        with(line, &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]),
        plain
    );
    for format in ["json", "csv"] {
        let text = with(&format!("{line} --format {format}"), &forced);
        assert!(!text.contains('\u{1b}'), "{text}");
    }
    let narrow = with(line, &[("CLICOLOR_FORCE", "1"), ("COLUMNS", "40")]);
    assert!(widest(&narrow) <= 40 && narrow.contains(green), "{narrow}");
}

/// The output of `line` on a terminal of this many columns.
fn on_terminal(bench: &Bench, line: &str, columns: usize) -> Option<String> {
    let script = Command::new("script").arg("--version").output();
    if script.is_err() {
        eprintln!("util-linux is not installed: no terminal is tried");
        return None;
    }
    let inside = format!(
        "stty cols {columns} rows 30; {} {line}",
        common::OWN_PROGRAM
    );
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &inside, "/dev/null"])
        .env("TERM", "xterm")
        .env("TRISTACK_STORE", bench.path("store"))
        .env_remove("COLUMNS")
        .env_remove("NO_COLOR")
        .env_remove("CLICOLOR")
        .output()
        .expect("it runs");
    Some(
        String::from_utf8(output.stdout)
            .expect("text")
            .replace("\r\n", "\n"),
    )
}

#[test]
fn a_terminal_is_asked_for_its_width_and_shown_colours() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --mu 0.3 --stiffness 1e2 --quiet";
    if let Some(text) = on_terminal(&bench, line, 90) {
        assert!(widest(&text) <= 90, "{text}");
        assert!(text.contains("left out here: "), "{text}");
        assert!(text.contains("\u{1b}[32magrees\u{1b}[0m"), "{text}");
    }
}

#[test]
fn quiet_leaves_errors_alone_on_standard_error() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --mu 0.3 --stiffness 1e2";
    assert!(standard_error(&mut bench.tristack(line)).contains("1 of 1 rows agree"));
    for line in [format!("{line} --quiet"), format!("--quiet {line} --fresh")] {
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(message, "", "{line}");
        assert!(!output.stdout.is_empty() && output.status.success());
    }
    let refused = standard_error(&mut bench.tristack("theory --mu 0.3 --stiffness -5 --quiet"));
    assert!(
        refused.starts_with("error: `--stiffness` is -5"),
        "{refused}"
    );
    let unwritten = format!("{line} --quiet --junit /dev/null/tests.xml");
    let output = bench.tristack(&unwritten).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.starts_with("error: cannot write"), "{message}");
    assert_eq!(output.status.code(), Some(5), "{message}");
}
