//! `tristack theory`, as a user sees it.

mod common;

use common::{Bench, json, standard_output};
use insta::assert_snapshot;

#[test]
fn table_shows_every_theory() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2,critical,0.3,0.9 --stiffness 1e2";
    assert_snapshot!(standard_output(&mut bench.tristack(line)));
}

#[test]
fn json_of_one_case_is_an_object_with_the_agreed_keys() {
    let bench = Bench::without_codes();
    let text =
        standard_output(&mut bench.tristack("theory --mu 0.2 --stiffness 1e2 --format json"));
    let case = json(&text);
    assert_eq!(case["mu"], 0.2);
    assert_eq!(case["epsilon"], 0.01);
    assert_eq!(case["rigid"]["diverges"], false);
    assert_eq!(case["quasistatic"]["event"], "floor-slip");
    assert_eq!(case["quasistatic"]["pair_torque_arm"], 0.0);
    for (theory, key, expected) in [
        ("perturbation", "yield_force", 4.1669659),
        ("elastic", "yield_force", 4.3192804),
        ("quasistatic", "yield_force", 4.3184438),
        ("quasistatic", "floor_slip_force", 4.3184438),
    ] {
        let value = case[theory][key].as_f64().expect("a number");
        assert!((value - expected).abs() < 5e-8, "{theory} {key} {value}");
    }
    for key in ["x", "y", "z"] {
        assert!(case["elastic"][key].is_f64());
    }
}

#[test]
fn json_of_several_cases_is_a_list() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2,0.3 --stiffness 1e2,1e3 --format json";
    let list = json(&standard_output(&mut bench.tristack(line)));
    assert_eq!(list.as_array().map(Vec::len), Some(4));
}

#[test]
fn a_theory_that_is_not_valid_gives_null_and_a_reason() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.05 --stiffness 1e2 --format json";
    let case = json(&standard_output(&mut bench.tristack(line)));
    for theory in ["naive", "perturbation", "elastic", "quasistatic"] {
        assert!(case[theory]["yield_force"].is_null(), "{theory}");
        assert!(case[theory]["reason"].is_string(), "{theory}");
    }
    assert_eq!(case["rigid"]["yield_force"], 0.0);
}

#[test]
fn arms_change_the_quasistatic_limit_alone() {
    let bench = Bench::without_codes();
    let plain = "theory --mu 0.3 --stiffness 1e2 --format json";
    let arms = format!("{plain} --pair-arm -0.5 --floor-arm -1");
    let plain = json(&standard_output(&mut bench.tristack(plain)));
    let arms = json(&standard_output(&mut bench.tristack(&arms)));
    assert_eq!(plain["elastic"], arms["elastic"]);
    let force = arms["quasistatic"]["yield_force"]
        .as_f64()
        .expect("a number");
    assert!((force - 24.8114052).abs() < 5e-8, "{force}");
}

#[test]
fn csv_has_one_line_a_case() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2,0.3 --stiffness 1e2 --format csv";
    let text = standard_output(&mut bench.tristack(line));
    let header = text.lines().next().expect("a header");
    assert_snapshot!(header);
    assert_eq!(text.lines().count(), 3);
}

#[test]
fn every_command_has_help_with_an_example() {
    let bench = Bench::without_codes();
    for command in [
        "theory",
        "simulate",
        "sweep",
        "crosscheck",
        "codes",
        "probe",
        "record",
        "regimes",
        "predict",
    ] {
        let help = standard_output(&mut bench.tristack(&format!("{command} --help")));
        assert!(
            help.contains("Example") && help.contains(&format!(": tristack {command}")),
            "{help}"
        );
    }
}
