//! `tristack bench`: what is printed, never how fast.

use crate::common::{
    Bench, assert_only, code_folder, installed, json_rows, standard_error, standard_output,
};
use tristack::code::Code;

#[test]
fn rows_have_what_others_rely_on_and_files_tell_how_lanes_scale() {
    let bench = Bench::without_codes();
    let line = "bench --codes native --repeats 1 --format json --out results";
    let output = standard_output(&mut bench.tristack(line));
    assert_rows(&json_rows(&output));
    let read = |name: &str| {
        let path = bench.path("results").join(name);
        std::fs::read_to_string(path).expect(name)
    };
    assert_eq!(read("bench.json"), output);
    assert!(read("bench.md").starts_with("Machine: "));
    assert!(read("bench.csv").contains("\nnative-lanes,"));
    assert!(read("scaling.csv").starts_with("cases,cores,ns_per_step,speedup\n1,1,"));
    assert!(read("performance.svg").contains("native-lanes: "));
}

/// A row for each way of native, in the form that others rely on; the lanes are the measure.
fn assert_rows(rows: &[serde_json::Value]) {
    let codes: Vec<_> = rows.iter().map(|row| row["code"].as_str()).collect();
    assert_eq!(codes, [Some("native-scalar"), Some("native-lanes")]);
    for row in rows {
        let number = |key: &str| row[key].as_f64().expect(key);
        assert!(row["steps"].as_u64().expect("a count") > 1_000_000);
        assert_eq!(row["runs"], 1);
        assert!(number("ns_per_step").is_finite() && number("ratio").is_finite());
        // The accuracy to which yield forces are counted.
        assert!(number("largest_error") < 1e-5);
    }
    assert_eq!(rows[1]["ratio"], 1.0);
}

#[test]
fn a_code_in_a_folder_is_timed_beside_native() {
    let lammps = Code::named("lammps").expect("it is built in");
    if installed(&[lammps]).is_empty() {
        return;
    }
    let bench = Bench::with_system_programs();
    code_folder("lammps_inputs", &bench.path("mydem"), |manifest| {
        manifest.replace("name = \"lammps\"", "name = \"mydem\"")
    });
    let line = "bench --codes native,./mydem --repeats 1 --format json";
    let rows = json_rows(&standard_output(&mut bench.tristack(line)));
    let codes: Vec<_> = rows.iter().map(|row| row["code"].as_str()).collect();
    let expected = ["native-scalar", "native-lanes", "mydem"].map(Some);
    assert_eq!(codes, expected);
    assert!(rows[2]["ns_per_step"].as_f64() > Some(0.0), "{}", rows[2]);
    assert!(
        rows[2]["largest_error"].as_f64() < Some(1e-5),
        "{}",
        rows[2]
    );
    // Nothing temporary is left, and nothing is kept.
    assert_only(&bench.path("."), &["mydem", "programs"]);
}

#[test]
fn a_code_that_is_not_installed_is_an_error() {
    let bench = Bench::without_codes();
    let mut command = bench.tristack("bench --codes liggghts --repeats 1");
    command.assert().code(3);
    assert!(standard_error(&mut command).contains("liggghts is not installed"));
}

#[test]
fn no_repeat_at_all_is_refused() {
    let bench = Bench::without_codes();
    bench.tristack("bench --repeats 0").assert().code(1);
}
