//! `tristack time`: it plans the runs that the crosscheck makes.

use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, files_below, json, standard_output};
use serde_json::Value;

/// The rows of the codes and the row of all of them.
fn planned(bench: &Bench, line: &str) -> (Vec<Value>, Value) {
    let tables = json(&standard_output(
        &mut bench.tristack(&format!("{line} --format json")),
    ));
    let rows = tables["tables"][0]["rows"].as_array().expect("rows");
    (rows.clone(), tables["tables"][1]["rows"][0].clone())
}

/// Runs in the store.
fn kept(bench: &Bench) -> usize {
    let runs = bench.path("store/runs");
    if !runs.exists() {
        return 0;
    }
    let files = files_below(&runs).into_iter();
    files.filter(|file| file.ends_with("series.csv")).count()
}

#[test]
fn it_plans_as_many_runs_as_the_crosscheck_then_makes() {
    let bench = Bench::without_codes();
    let stacks = "--codes native --mu 0.2,0.3 --stiffness 100 --jobs 2";
    let (rows, all) = planned(&bench, &format!("time {stacks}"));
    assert_eq!(rows.len(), 1);
    assert_eq!(rows[0]["there"], 0);
    assert_eq!(rows[0]["basis"], "measured");
    assert!(
        rows[0]["ns_per_step"]
            .as_f64()
            .is_some_and(|cost| cost > 0.0)
    );
    assert_eq!(kept(&bench), 0, "nothing is made");
    bench
        .tristack(&format!("crosscheck {stacks}"))
        .assert()
        .code(0);
    assert_eq!(rows[0]["to_make"], kept(&bench));
    assert_eq!(rows[0]["runs"], rows[0]["to_make"]);
    assert_eq!(all["jobs"], 2);
    let seconds = |key: &str| all[key].as_f64().expect("seconds");
    assert!(seconds("seconds") <= seconds("core_seconds"));

    let (rows, all) = planned(&bench, &format!("time {stacks}"));
    assert_eq!(rows[0]["there"], kept(&bench));
    assert_eq!(rows[0]["to_make"], 0);
    assert_eq!(rows[0]["ns_per_step"], Value::Null);
    assert_eq!(all["seconds"], 0.0);
    let (rows, _) = planned(&bench, &format!("time {stacks} --fresh"));
    assert_eq!(rows[0]["to_make"], kept(&bench));
}

#[test]
fn recorded_runs_take_no_time() {
    let bench = Bench::without_codes();
    let (rows, _) = planned(&bench, "time --profile standard");
    let (native, others) = rows.split_first().expect("rows");
    assert_eq!(native["code"], "native");
    assert!(others.len() > 2);
    for row in others {
        assert_eq!(row["installed"], false);
        assert_eq!(row["there"], row["runs"], "{row}");
        assert_eq!(row["to_make"], 0);
        assert_eq!(row["core_seconds"], 0.0);
    }
}

#[test]
fn a_code_whose_step_cannot_be_timed_is_taken_by_its_manifest() {
    let bench = Bench::with_system_programs();
    // It knows the recorded runs, and no others.
    replay::install(&bench, |_| Disturbance::None);
    let mut command = bench.tristack("time --codes yade --jobs 1");
    let output = command.output().expect("it runs");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("taken from the manifest: yade"), "{text}");
    assert!(text.contains("90 of 90 runs to make"), "{text}");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("could not be measured"), "{message}");
}

#[test]
fn runs_that_are_neither_there_nor_can_be_made_are_counted() {
    let bench = Bench::without_codes();
    let stack = "--mu 0.123 --stiffness 100";
    bench
        .tristack(&format!("sweep --code native {stack}"))
        .assert()
        .code(0);
    let (rows, _) = planned(&bench, &format!("time {stack}"));
    let sum = |key: &str| rows.iter().filter_map(|row| row[key].as_u64()).sum::<u64>();
    let (total, there) = (sum("runs"), sum("there"));
    assert!(there > 0 && there < total, "{there} of {total}");
    assert_eq!(sum("to_make"), 0);
    let text = standard_output(&mut bench.tristack(&format!("time {stack}")));
    for part in [
        format!("nothing to make: {there} of {total} runs are there"),
        format!(
            "{} of {total} runs are neither there nor can be made",
            total - there
        ),
    ] {
        assert!(text.contains(&part), "{text} lacks {part}");
    }
}
