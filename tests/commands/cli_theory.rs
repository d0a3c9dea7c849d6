//! `tristack theory`, as a user sees it.

use crate::common::{Bench, json, json_rows, standard_output};
use insta::assert_snapshot;

#[test]
fn table_shows_every_theory() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2,critical,0.3,0.9 --stiffness 1e2";
    assert_snapshot!(standard_output(&mut bench.tristack(line)));
}

#[test]
fn json_has_the_agreed_keys() {
    let bench = Bench::without_codes();
    let text =
        standard_output(&mut bench.tristack("theory --mu 0.2 --stiffness 1e2 --format json"));
    let object = json(&text);
    assert_eq!(object["schema"], "tristack/theory/1");
    assert_eq!(
        object["command"],
        "tristack theory --mu 0.2 --stiffness 1e2"
    );
    assert_eq!(object["units"]["quasistatic"], "m g");
    let case = &object["rows"][0];
    assert_eq!(case["mu"], 0.2);
    assert_eq!(case["mu_d"], 0.7);
    assert_eq!(case["epsilon"], 0.01);
    assert_eq!(case["rigid_diverges"], false);
    assert_eq!(case["event"], "floor-slip");
    assert_eq!(case["pair_torque_arm"], 0.0);
    for (theory, expected) in [
        ("perturbation", 4.1669659),
        ("elastic", 4.3192804),
        ("quasistatic", 4.3181929),
        ("floor_slip_force", 4.3181929),
    ] {
        let value = case[theory].as_f64().expect("a number");
        assert!((value - expected).abs() < 5e-8, "{theory} {value}");
    }
    for key in ["elastic_x", "elastic_y", "elastic_z"] {
        assert!(case[key].is_f64());
    }
}

#[test]
fn json_has_a_row_a_case() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2,0.3 --stiffness 1e2,1e3 --format json";
    let rows = json_rows(&standard_output(&mut bench.tristack(line)));
    assert_eq!(rows.len(), 4);
}

#[test]
fn a_theory_that_is_not_valid_gives_null_and_a_reason() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.05 --stiffness 1e2 --format json";
    let case = &json_rows(&standard_output(&mut bench.tristack(line)))[0];
    for (theory, reason) in [
        ("naive", "naive_reason"),
        ("perturbation", "perturbation_reason"),
        ("elastic", "elastic_reason"),
        ("quasistatic", "reason"),
    ] {
        assert!(case[theory].is_null(), "{theory}");
        assert!(case[reason].is_string(), "{theory}");
    }
    assert_eq!(case["rigid"], 0.0);
}

#[test]
fn arms_change_the_quasistatic_limit_alone() {
    let bench = Bench::without_codes();
    let plain = "theory --mu 0.3 --stiffness 1e2 --format json";
    let arms = format!("{plain} --pair-arm -0.5 --floor-arm -1");
    let plain = &json_rows(&standard_output(&mut bench.tristack(plain)))[0];
    let arms = &json_rows(&standard_output(&mut bench.tristack(&arms)))[0];
    assert_eq!(plain["elastic"], arms["elastic"]);
    let force = arms["quasistatic"].as_f64().expect("a number");
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

/// The peak of the paper at its own speed, and what it rests on: F + C v.
#[test]
fn a_wall_speed_adds_to_the_peak_what_theory_knows() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.2 --stiffness 1e4 --speed 1e-6";
    let case = &json_rows(&standard_output(
        &mut bench.tristack(&format!("{line} --format json")),
    ))[0];
    let number = |key: &str| case[key].as_f64().expect("a number");
    let added = number("peak_per_speed") * number("wall_speed");
    assert!((number("peak_at_speed") - number("quasistatic") - added).abs() < 1e-12);
    // docs/theory.md, section 8.7.
    assert!((number("peak_per_speed") - 41760.8).abs() < 0.05, "{case}");
    assert!((number("onset_per_speed") - 1.68161).abs() < 5e-6, "{case}");
    let table = standard_output(&mut bench.tristack(line));
    assert!(table.contains("at wall speed v"), "{table}");
    assert!(
        table.ends_with("forces in m g, v = 1e-6 r sqrt(k_n/m)\n"),
        "{table}"
    );

    // Contact 2-3 is closed at the onset.
    let closed = "theory --mu 0.3 --stiffness 1e2 --kappa 0.8 --speed 1e-6";
    let case = &json_rows(&standard_output(
        &mut bench.tristack(&format!("{closed} --format json")),
    ))[0];
    assert!(case["peak_at_speed"].is_null() && case["quasistatic"].is_number());
    let table = standard_output(&mut bench.tristack(closed));
    assert!(
        table.contains("what a speed adds is not known here"),
        "{table}"
    );
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
        "check",
        "predict",
    ] {
        let help = standard_output(&mut bench.tristack(&format!("{command} --help")));
        assert!(
            help.contains("Example") && help.contains(&format!(": tristack {command}")),
            "{help}"
        );
    }
}

#[test]
fn a_law_and_its_parts_are_options_of_every_command_with_a_convention() {
    let bench = Bench::without_codes();
    let row = |options: &str| {
        let line = format!("theory --mu 0.2 --stiffness 100 --kappa 0.8 {options} --format json");
        json_rows(&standard_output(&mut bench.tristack(&line)))[0].clone()
    };
    let hertz = row(
        "--law hertz --history force --floor-ratio 1.2 --floor-kappa 0.9 --tangential-stiffening",
    );
    for (key, value) in [
        ("law_power", serde_json::json!(1.5)),
        ("history", "force".into()),
        ("floor_ratio", 1.2.into()),
        ("floor_kappa", 0.9.into()),
        ("tangential_stiffening", "every".into()),
    ] {
        assert_eq!(hertz[key], value, "{key}");
    }
    let forces = ["slip_onset", "peak_force", "yield_force", "c"].map(|key| {
        hertz[format!("quasistatic.{key}")]
            .as_f64()
            .expect("a number")
    });
    let [onset, peak, yields, bottom] = forces;
    assert!(onset < peak && bottom > 0.0, "{forces:?}");
    assert_eq!(
        (peak, hertz["quasistatic"].as_f64()),
        (yields, Some(yields))
    );
    let usual = row("--law 1.5");
    assert_eq!(usual["floor_ratio"], std::f64::consts::SQRT_2);
    assert_eq!(usual["history"], "displacement");
    assert_eq!(row("")["law_power"], 1.0);
}

#[test]
fn a_law_that_does_not_exist_is_refused_with_those_that_do() {
    let bench = Bench::without_codes();
    for (options, part) in [
        (
            "--law 1.3",
            "`linear`, `hertz`, and the powers 1, 1.25, 1.5, 1.75 and 2",
        ),
        ("--law hertz --history energy", "displacement-rescaled"),
        ("--law hertz --floor-ratio 0", "--floor-ratio"),
        ("--law hertz --floor-kappa 0", "--floor-kappa"),
    ] {
        let line = format!("theory --mu 0.2 --stiffness 100 {options}");
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            !output.status.success() && message.contains(part),
            "{options}: {message}"
        );
    }
}

#[test]
fn an_external_code_takes_its_own_law_alone() {
    let bench = Bench::without_codes();
    let line = "sweep --code yade --mu 0.3 --stiffness 100 --law hertz";
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        !output.status.success() && message.contains("--law"),
        "{message}"
    );
}

#[test]
fn a_material_takes_the_place_of_stiffness_and_stiffness_ratio() {
    let bench = Bench::without_codes();
    let (modulus, poisson) = (321.0, 0.2);
    let line =
        format!("theory --mu 0.2 --youngs {modulus} --poisson {poisson} --law hertz --format json");
    let row = json_rows(&standard_output(&mut bench.tristack(&line)))[0].clone();
    let number = |key: &str| row[key].as_f64().expect("a number");
    // 4/3 E* sqrt(R), E* = E/(2 (1 - nu^2)), R = r/2; (2 - nu)/(2 (1 - nu)).
    let stiffness = modulus / (1.0 - poisson * poisson) * 2.0 / 3.0 / 2f64.sqrt();
    assert!((number("stiffness") / stiffness - 1.0).abs() < 1e-14);
    assert!((number("kappa") - 1.8 / 1.6).abs() < 1e-14);
    for (options, named) in [
        ("--youngs 321 --poisson 0.2", "unless --law is hertz"),
        ("--youngs 321 --poisson 0.6 --law hertz", "from 0 to 0.5"),
        ("--youngs 0 --poisson 0.2 --law hertz", "above 0"),
    ] {
        let line = format!("theory --mu 0.2 {options}");
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(
            !output.status.success() && message.contains(named),
            "{message}"
        );
    }
}

#[test]
fn spheres_have_a_theory_with_their_own_critical_friction() {
    let bench = Bench::without_codes();
    let line = "theory --bodies 4 --mu 0.3,critical --stiffness 1e2";
    let rows = json_rows(&standard_output(
        &mut bench.tristack(&format!("{line} --format json")),
    ));
    let critical = 2f64.sqrt() - 1.0;
    assert_eq!(rows[0]["bodies"], 4);
    assert!((rows[1]["mu"].as_f64().expect("a number") - critical).abs() < 1e-15);
    assert_eq!(
        [&rows[0], &rows[1]].map(|row| row["rigid_diverges"].as_bool()),
        [Some(false), Some(true)]
    );
    let rigid = (5.0 * 0.3 - critical) / (critical - 0.3);
    assert!((rows[0]["rigid"].as_f64().expect("a number") - rigid).abs() < 1e-12);
    assert!(standard_output(&mut bench.tristack(line)).starts_with("4 spheres below, mu = 0.3"));
}

#[test]
fn what_is_about_cylinders_refuses_spheres_and_rings_have_two_to_five_bodies() {
    let bench = Bench::without_codes();
    let line =
        "predict --youngs 1MPa --density 1000kg/m3 --radius 1cm --length 1cm --mu 0.3 --bodies 3";
    let walls =
        "simulate --code native --mu 0.3 --stiffness 1e2 --bodies 3 --preparation side-walls";
    for line in [line, walls] {
        let output = bench.tristack(line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        let refusal = "`--bodies` is 3, but must be 2, or left out: this is about cylinders alone";
        assert!(message.contains(refusal), "{line}: {message}");
        assert_eq!(output.status.code(), Some(1), "{line}");
    }
    for command in ["theory", "simulate --code native", "crosscheck"] {
        for bodies in [1, 6] {
            let line = format!("{command} --mu 0.3 --stiffness 1e2 --bodies {bodies}");
            let output = bench.tristack(&line).output().expect("it runs");
            let message = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(
                message.contains("a whole number from 2 to 5: six that touch"),
                "{line}: {message}"
            );
            assert_eq!(output.status.code(), Some(1));
        }
    }
    let case = |bodies: u8| {
        let text = format!("[stack]\nmu = 0.3\nbodies = {bodies}\n");
        std::fs::write(bench.path("case.toml"), text).expect("a case file");
        let line = format!("simulate --code native --case case.toml --out run-{bodies}");
        standard_output(&mut bench.tristack(&line));
        let kept = bench.path(&format!("run-{bodies}/case.json"));
        std::fs::read_to_string(kept).expect("a case")
    };
    assert!(!case(2).contains("bodies"));
    assert!(case(3).contains("\"bodies\": 3"));
}

#[test]
fn lists_and_ranges_give_a_row_for_every_pair_of_their_values() {
    let bench = Bench::without_codes();
    let line = "theory --mu 0.1:0.3:0.1,mu_c --stiffness 1e2:1e4:x10,5e5 --format json";
    let rows = json_rows(&standard_output(&mut bench.tristack(line)));
    let numbers = |key: &str, rows: &[serde_json::Value]| -> Vec<f64> {
        let numbers = rows.iter().map(|row| row[key].as_f64().expect("a number"));
        numbers.collect()
    };
    assert_eq!(rows.len(), 16);
    let critical = 2.0 - 3f64.sqrt();
    let frictions = numbers("mu", &rows[..4]);
    assert_eq!(frictions[..3], [0.1, 0.2, 0.3]);
    assert!((frictions[3] - critical).abs() < 1e-15);
    let every_fourth: Vec<_> = rows.iter().step_by(4).cloned().collect();
    assert_eq!(numbers("stiffness", &every_fourth), [1e2, 1e3, 1e4, 5e5]);
}

#[test]
fn a_wrong_value_is_refused_with_flag_value_and_what_is_accepted() {
    let bench = Bench::without_codes();
    let predict = "predict --youngs 1MPa --mass 1g --radius 1cm --length 1cm";
    for (line, parts) in [
        (
            "theory --mu 0.3 --stiffness high".to_owned(),
            ["--stiffness", "'high'", "A:B:xFACTOR"],
        ),
        (
            "sweep --code native --mu 0.1,,0.3 --stiffness 1e2".to_owned(),
            ["--mu", "a value is missing", "A:B:STEP"],
        ),
        (
            "crosscheck --mu 0.3:0.1:0.1 --stiffness 1e2".to_owned(),
            ["--mu", "0.3 is above 0.1", "`critical` (also `mu_c`)"],
        ),
        (
            "simulate --code native --mu 0.2,0.3 --stiffness 1e2".to_owned(),
            ["--mu", "'0.2,0.3'", "takes one value"],
        ),
        (
            "simulate --code native --mu 0.2 --stiffness 1e2:1e3:x10".to_owned(),
            ["--stiffness", "'1e2:1e3:x10'", "takes one value"],
        ),
        (
            format!("{predict} --mu 0.1:0.2:0.1"),
            ["--mu", "'0.1:0.2:0.1'", "takes one value"],
        ),
        (
            "crosscheck --explain native/0.1,0.2/100".to_owned(),
            ["--explain", "MU is `0.1,0.2`", "takes one value"],
        ),
    ] {
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{line}: {message}");
        for part in parts {
            assert!(message.contains(part), "{line}: {part} in {message}");
        }
    }
}
