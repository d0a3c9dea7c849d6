//! `tristack simulate`, `sweep` and `codes`, as a user sees them.

use crate::common;
use crate::common::{Bench, assert_only, json_rows, standard_error, standard_output};
use insta::assert_snapshot;
use std::fs;

const RUN: &str = "simulate --code native --mu 0.3 --stiffness 1e2";

fn without_time(text: &str) -> String {
    let keep = |line: &&str| !line.contains("wall time") && !line.contains("seconds");
    text.lines().filter(keep).collect::<Vec<_>>().join("\n")
}

#[test]
fn table_shows_both_estimators() {
    let bench = Bench::without_codes();
    assert_snapshot!(without_time(&standard_output(&mut bench.tristack(RUN))));
}

/// Every command takes either name of the option.
#[test]
fn codes_are_named_by_code_or_codes() {
    let bench = Bench::without_codes();
    let one = without_time(&standard_output(&mut bench.tristack(RUN)));
    let other = RUN.replace("--code", "--codes");
    assert_eq!(
        without_time(&standard_output(&mut bench.tristack(&other))),
        one
    );
    let [one, other] = ["--codes", "--code"]
        .map(|option| standard_output(&mut bench.tristack(&format!("probe {option} native"))));
    assert_eq!(one, other);
}

#[test]
fn json_has_the_agreed_keys_and_the_same_numbers_everywhere() {
    let bench = Bench::without_codes();
    let text = standard_output(&mut bench.tristack(&format!("{RUN} --format json")));
    assert_snapshot!(without_time(&text));
    assert!(json_rows(&text)[0]["seconds"].is_f64());
}

#[test]
fn out_holds_case_series_and_summary() {
    let bench = Bench::without_codes();
    bench
        .tristack(&format!("{RUN} --out run"))
        .assert()
        .success();
    assert_only(
        &bench.path("run"),
        &[
            "case.json",
            "series.csv",
            "series.csv-metadata.json",
            "summary.json",
        ],
    );
    let series = fs::read_to_string(bench.path("run/series.csv")).expect("a series");
    assert_snapshot!(series.lines().next().expect("a header"));
}

#[test]
fn a_case_file_repeats_the_run_bit_by_bit() {
    let bench = Bench::without_codes();
    bench
        .tristack(&format!("{RUN} --out first"))
        .assert()
        .success();
    bench
        .tristack("simulate --code native --case first/case.json --out second")
        .assert()
        .success();
    let series = |run: &str| fs::read(bench.path(run).join("series.csv")).expect("a series");
    assert_eq!(series("first"), series("second"));
}

#[test]
fn native_takes_any_arms() {
    let bench = Bench::without_codes();
    let line = format!("{RUN} --pair-arm -0.5 --floor-arm -1 --format json");
    let run = &json_rows(&standard_output(&mut bench.tristack(&line)))[0];
    let slip = run["slip_force"].as_f64().expect("a number");
    // The exact limit under these arms (reference/golden); the slip at finite speed comes a little later.
    assert!(slip > 24.8114052 && slip < 24.82, "{slip}");
}

#[test]
fn an_explicit_speed_is_taken_literally() {
    let bench = Bench::without_codes();
    let line = format!("{RUN} --speed 1e-3 --dt 0.05 --format json");
    let run = &json_rows(&standard_output(&mut bench.tristack(&line)))[0];
    assert_eq!(run["wall_speed"], 1e-3);
    assert_eq!(run["time_step"], 0.05);
}

#[test]
fn sweep_is_a_judged_yield_curve() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.05:0.55:0.1 --stiffness 1e2 --out curve";
    let mut command = bench.tristack(line);
    assert_snapshot!(standard_output(&mut command));
    assert_only(&bench.path("curve"), &["sweep.csv", "sweep.json"]);
}

/// Of LAMMPS pair granular: the torque acts halfway into the overlap, the surfaces move at the full radius.
#[test]
fn native_yields_at_the_exact_limit_where_torque_and_kinematic_arms_differ() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.2:0.3:0.1 --stiffness 1e2 --pair-arm -0.5 --pair-kinematic-arm 0";
    let judged = standard_output(&mut bench.tristack(&format!("{line} --format json")));
    let rows = json_rows(&judged);
    assert_eq!(rows.len(), 2);
    for row in &rows {
        assert_eq!(row["verdict"], "agrees", "{row}");
        assert_eq!(row["pair_torque_arm"], -0.5);
        assert_eq!(row["pair_kinematic_arm"], 0.0);
        // Far from the limit of the paper's arms, so that they cannot be taken for these.
        let model_form = row["model_form"].as_f64().expect("a number");
        assert!(model_form > 0.01, "{row}");
    }
}

#[test]
fn sweep_says_why_a_point_does_not_yield() {
    let bench = Bench::without_codes();
    let line = "sweep --code native --mu 0.05 --stiffness 1e2";
    let message = standard_error(&mut bench.tristack(line));
    assert!(
        message.contains("slides on the floor under its own weight"),
        "{message}"
    );
    bench.tristack(line).assert().code(0);
}

#[test]
fn codes_lists_what_is_not_installed_with_a_remedy() {
    let bench = Bench::without_codes();
    let text = standard_output(&mut bench.tristack("codes"));
    let (native, external): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.contains("native"));
    assert!(native[0].contains(env!("CARGO_PKG_VERSION")));
    // The hashes of the decks are pinned in tests/documents/decks.rs.
    let hashes = [(r"\b[0-9a-f]{12}\b", "[hash]")];
    insta::with_settings!({filters => hashes.to_vec()}, {
        assert_snapshot!(external.join("\n"));
    });
}

#[test]
fn a_file_beside_the_series_has_the_unit_and_the_meaning_of_every_column() {
    let bench = Bench::without_codes();
    bench
        .tristack(&format!("{RUN} --out run"))
        .assert()
        .success();
    let text = |name: &str| fs::read_to_string(bench.path("run").join(name)).expect("a file");
    let described = common::json(&text("series.csv-metadata.json"));
    assert_eq!(described["url"], "series.csv");
    let columns = described["tableSchema"]["columns"].as_array();
    let columns = columns.expect("a list of columns");
    let word =
        |column: &serde_json::Value, key: &str| column[key].as_str().unwrap_or("").to_owned();
    let names: Vec<String> = columns.iter().map(|own| word(own, "name")).collect();
    assert_eq!(text("series.csv").lines().next(), Some(&*names.join(",")));
    for column in columns {
        assert!(!word(column, "schema:unitText").is_empty(), "{column}");
        assert!(!word(column, "dc:description").is_empty(), "{column}");
    }
}

#[test]
fn the_exact_limit_stands_beside_the_result_of_a_run() {
    let bench = Bench::without_codes();
    let run = &json_rows(&standard_output(
        &mut bench.tristack(&format!("{RUN} --format json")),
    ))[0];
    let number = |name: &str| run[name].as_f64().expect("a number");
    let (onset, reference) = (number("slip_force"), number("reference_onset"));
    let error = (onset - reference) / (reference + 3.0);
    assert!((number("error") - error).abs() < 1e-15, "{error}");
    // A wall of finite speed is a little late.
    assert!((0.0..1e-2).contains(&error), "{error}");
}

#[test]
fn a_run_that_stops_before_the_yield_says_how_far_the_wall_must_move() {
    let bench = Bench::without_codes();
    let case = "[stack]\nfloor_friction = 0.3\nstiffness = 100.0\n[protocol]\nwall_travel = 0.4\n\
                sampling = { coarse_interval = 50.0, fine_from_travel = 0.4, fine_interval = 2.0 }\n";
    fs::write(bench.path("case.toml"), case).expect("a case file");
    let message = standard_error(&mut bench.tristack("simulate --code native --case case.toml"));
    for part in [
        "ends before the floor slips",
        "the wall moves 0.4000 r",
        "`protocol.wall_travel`",
    ] {
        assert!(message.contains(part), "{message} lacks {part}");
    }
    let words: Vec<&str> = message.split_whitespace().collect();
    let needed = words
        .windows(4)
        .find(|four| four[0] == "be" && four[2] == "or");
    let needed = needed.expect("a travel that suffices")[1];
    let longer = case.replace("wall_travel = 0.4\n", &format!("wall_travel = {needed}\n"));
    fs::write(bench.path("case.toml"), longer).expect("a case file");
    let message = standard_error(&mut bench.tristack("simulate --code native --case case.toml"));
    assert!(!message.contains("ends before"), "{message}");
}
