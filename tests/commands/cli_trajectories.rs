//! `tristack trajectories` on a machine without codes: the twins live, the codes recorded.

use crate::common::{Bench, assert_only, json_rows, save_recording, standard_output};
use insta::assert_snapshot;
use std::fs;
use tristack::code::Code;
use tristack::model::{Case, Power};
use tristack::runs::Recording;
use tristack::series::Series;

const COMPARISONS: usize = 110;
const TIME_STEPS: usize = 3;

#[test]
fn every_comparison_agrees_and_says_where_it_comes_from() {
    let bench = Bench::without_codes();
    let mut command = bench.tristack("trajectories --out results");
    let output = command.output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert!(
        message.contains("110 of 110 comparisons agree"),
        "{message}"
    );
    assert!(
        message.contains("lammps is not installed: recorded runs stand in for it"),
        "{message}"
    );
    assert_snapshot!(String::from_utf8(output.stdout).expect("text"));
    assert_only(
        &bench.path("results"),
        &["trajectories.csv", "trajectories.json", "trajectories.md"],
    );
    let page = fs::read_to_string(bench.path("results/trajectories.md")).expect("the page");
    let words = page.lines().filter(|line| !line.starts_with('|'));
    assert_snapshot!("words_of_the_page", words.collect::<Vec<_>>().join("\n"));
}

#[test]
fn rows_meet_the_accuracy_and_the_orders_that_are_promised() {
    let bench = Bench::without_codes();
    let rows = json_rows(&standard_output(
        &mut bench.tristack("trajectories --format json"),
    ));
    assert_eq!(rows.len(), COMPARISONS * TIME_STEPS);
    let finest = rows.iter().filter(|row| row["time_step"] == 0.00625);
    let mut orders = 0;
    for row in finest {
        let largest = row["largest"].as_f64().expect("a distance");
        if row["quantity"] == "wall_force" && row["branch"] == "compression" {
            assert!(largest < 1e-6, "{row}");
        }
        let round_off = row["round_off"].as_f64().expect("a bound");
        let documented = match row["documented_order"].as_str() {
            Some("first") => 1.0,
            Some("second") => 2.0,
            _ => continue,
        };
        // Some seven times above rounding is where an order is looked at.
        if largest > 10.0 * round_off {
            let order = row["order"].as_f64().expect("an order");
            assert!((order - documented).abs() < 0.1, "{row}");
            orders += 1;
        }
    }
    assert!(orders > 40, "{orders} orders were seen");
}

#[test]
fn csv_has_the_agreed_columns() {
    let bench = Bench::without_codes();
    let text = standard_output(&mut bench.tristack("trajectories --format csv"));
    assert_eq!(
        text.lines().next(),
        Some(
            "code,version,source,stiffness,mu,mu_d,kappa,bodies,pair_torque_arm,pair_kinematic_arm,floor_torque_arm,\
             floor_kinematic_arm,history_update,twin,quantity,branch,time_step,largest,rms,first_above_1e-6,\
             first_above_1e-4,first_above_1e-2,order,documented_order,round_off,step_error,verdict"
        )
    );
    assert_eq!(text.lines().count(), 1 + COMPARISONS * TIME_STEPS);
}

#[test]
fn the_native_code_is_refused_as_a_code() {
    let bench = Bench::without_codes();
    let output = bench
        .tristack("trajectories --codes native")
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("`--codes` is native, but must be liggghts, yade,")
            && message.contains("what they are compared with"),
        "{message}"
    );
}

#[test]
fn a_code_that_is_neither_installed_nor_recorded_is_missing() {
    let bench = Bench::without_codes();
    let mut command = bench.tristack("trajectories --format json");
    command.env("TRISTACK_REFERENCE", bench.path("nothing"));
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(3));
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(rows.len(), 5);
    for row in rows {
        assert_eq!(row["verdict"], "missing");
        assert!(row["largest"].is_null());
    }
}

/// Saves the recorded runs of all codes on `bench`, each as `change` makes it.
fn save_recordings(bench: &Bench, change: impl Fn(&Code, &mut Recording)) {
    let mut codes = Code::with_power(Power::Linear);
    codes.retain(|code| !code.is_native());
    for code in codes {
        save_recording(&bench.path("reference"), &code, |recording| {
            change(&code, recording);
        });
    }
}

#[test]
fn a_code_whose_convention_is_not_known_is_not_judged() {
    let bench = Bench::without_codes();
    save_recordings(&bench, |code, recording| {
        recording
            .probe
            .take_if(|_| *code == Code::named("lammps").expect("it is built in"));
    });
    let mut command = bench.tristack("trajectories --format json");
    command.env("TRISTACK_REFERENCE", bench.path("reference"));
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(4));
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let (of_lammps, others): (Vec<_>, Vec<_>) =
        rows.iter().partition(|row| row["code"] == "lammps");
    assert_eq!(of_lammps.len(), 1);
    assert_eq!(of_lammps[0]["verdict"], "inconclusive");
    assert!(others.iter().all(|row| row["verdict"] == "agrees"));
}

/// Two parts in a million on one code's force are seen, and seen as what they are.
#[test]
fn a_code_whose_force_is_slightly_off_differs() {
    let bench = Bench::without_codes();
    save_recordings(&bench, |code, recording| {
        let runs = recording
            .runs
            .iter_mut()
            .filter(|_| *code == Code::named("lammps").expect("it is built in"));
        for run in runs {
            if let Some(series) = &run.series {
                let force = with_wall_force_times(1.0 + 2e-6, series, &run.summary.case);
                run.series = Some(force);
            }
        }
    });
    let mut command = bench.tristack("trajectories --format json");
    command.env("TRISTACK_REFERENCE", bench.path("reference"));
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("lammps, full twin, compression, wall_force")
            && message.contains("the wall force deviates by 2.0e-6 of its peak, accepted is 1e-6")
            && message.contains("breaks the balance of forces"),
        "{message}"
    );
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    for row in &rows {
        let is_lammps = row["code"] == "lammps";
        let disturbed = is_lammps && row["quantity"] == "wall_force";
        match row["branch"].as_str() {
            // A wall force that is off breaks the balance of forces, whatever else is compared.
            Some("compression") if is_lammps => assert_eq!(row["verdict"], "differs", "{row}"),
            _ if !disturbed => assert_eq!(row["verdict"], "agrees", "{row}"),
            // The collapse has other distances of this size.
            _ => {}
        }
    }
}

fn with_wall_force_times(factor: f64, series: &Series, case: &Case) -> Series {
    let mut samples = series.samples().to_vec();
    for sample in &mut samples {
        sample.wall_force *= factor;
    }
    let changed = Series::new(samples, case);
    changed.expect("the same rows")
}

/// `series` of `case` with six digits.
fn with_six_digits(series: &Series, case: &Case) -> Series {
    let text = String::from_utf8(series.to_csv()).expect("text");
    let lines = text.lines().enumerate().map(|(row, line)| {
        let cells = line.split(',').enumerate().map(|(column, cell)| {
            let number: Option<f64> = cell.parse().ok().filter(|_| row > 0 && column > 1);
            number.map_or(cell.to_owned(), |number| format!("{number:.5e}"))
        });
        cells.collect::<Vec<_>>().join(",") + "\n"
    });
    let lines: String = lines.collect();
    Series::read(lines.as_bytes(), case).expect("the same rows")
}

#[test]
fn six_digits_tell_no_code_from_its_twin() {
    let bench = Bench::without_codes();
    let lammps = Code::named("lammps").expect("it is built in");
    let reference = bench.path("reference");
    save_recording(&reference, &lammps, |recording| {
        for run in &mut recording.runs {
            let case = run.summary.case;
            run.series = run.series.as_ref().map(|own| with_six_digits(own, &case));
        }
    });
    let mut command = bench.tristack("trajectories --format json");
    let output = command.env("TRISTACK_REFERENCE", &reference).output();
    let output = output.expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let mut own = rows.iter().filter(|row| row["code"] == "lammps");
    assert!(own.clone().count() > 0, "{message}");
    assert!(own.all(|row| row["verdict"] != "differs"), "{message}");
    assert!(message.contains("printed with 6 digits"), "{message}");
}
