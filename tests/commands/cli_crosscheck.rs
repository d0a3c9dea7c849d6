//! `tristack crosscheck` on a machine without codes: native live, the others recorded.

use crate::common;
use crate::common::{
    Bench, OWN_PROGRAM, assert_only, json_rows, save_recording, standard_error, standard_output,
};
use insta::assert_snapshot;
use std::fs;
use std::process::Command;
use tristack::code::Code;

#[test]
fn every_row_agrees_and_says_where_it_comes_from() {
    let bench = Bench::without_codes();
    let output = bench
        .tristack("crosscheck --out results")
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(0));
    let table = String::from_utf8(output.stdout).expect("text");
    assert_snapshot!(table);
    assert_only(
        &bench.path("results"),
        &[
            "budget.csv",
            "crosscheck.csv",
            "crosscheck.json",
            "crosscheck.md",
        ],
    );
    let page = fs::read_to_string(bench.path("results/crosscheck.md")).expect("the page");
    assert_snapshot!("page", page);
    let message = String::from_utf8(output.stderr).expect("text");
    assert!(
        message.contains("yade is not installed: recorded runs stand in for it"),
        "{message}"
    );
    assert!(
        message.contains("108 of 108 rows agree; 90 rows are recorded, not live"),
        "{message}"
    );
}

/// A program that was copied to an empty machine has its recorded runs with it.
#[test]
fn away_from_the_checkout_the_rows_are_the_same() {
    let bench = Bench::without_codes();
    let home = bench.path("home");
    fs::create_dir(&home).expect("a directory");
    fs::copy(OWN_PROGRAM, home.join("tristack")).expect("a copy");
    for line in [
        "crosscheck --format csv",
        "trajectories --format csv",
        "probe --format csv",
    ] {
        let away = Command::new(home.join("tristack"))
            .args(line.split(' '))
            .env_clear()
            .env("PATH", "")
            .env("HOME", &home)
            .current_dir(&home)
            .output()
            .expect("it runs");
        let message = String::from_utf8_lossy(&away.stderr);
        assert_eq!(away.status.code(), Some(0), "{line}: {message}");
        let own = standard_output(&mut bench.tristack(line));
        assert!(
            own.contains(",recorded,") || line.starts_with("probe"),
            "{own}"
        );
        assert_eq!(String::from_utf8_lossy(&away.stdout), own, "{line}");
    }
}

#[test]
fn rows_that_are_missing_are_not_called_recorded() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("yade").expect("it is built in"),
        |_| (),
    );
    let mut command = bench.tristack("crosscheck");
    command.env("TRISTACK_REFERENCE", bench.path("reference"));
    let message = standard_error(&mut command);
    let expected = [
        "36 of 108 rows agree, 72 missing; 18 rows are recorded, not live",
        "yade is not installed: recorded runs stand in for it",
        "lammps is not installed: no recorded run stands in for it",
        "lammps is not installed, and there is no recorded run of this case in ",
    ];
    for part in expected {
        assert!(message.contains(part), "{message} lacks {part}");
    }
}

#[test]
fn a_damaged_recording_is_refused_with_its_file() {
    let bench = Bench::without_codes();
    let reference = bench.path("reference");
    save_recording(
        &reference,
        &Code::named("yade").expect("it is built in"),
        |_| (),
    );
    let damage = |name: &str| {
        let path = reference.join(name);
        let mut content = fs::read(&path).expect("a file");
        let middle = content.len() / 2;
        content[middle] ^= 1;
        fs::write(&path, content).expect("damage");
    };
    damage("yade.csv");
    damage("yade.tar.gz");
    let (message, verdicts) = yade_notes_and_verdicts(&bench);
    assert_eq!(verdicts, vec!["missing"; 18], "{message}");
    let table = format!(
        "{}: line 1 is `# sha256",
        reference.join("yade.csv").display()
    );
    let archive = format!("cannot read {}", reference.join("yade.tar.gz").display());
    assert!(message.contains(&table), "{message}");
    let probe = bench
        .tristack("probe")
        .env("TRISTACK_REFERENCE", &reference)
        .output();
    let message = String::from_utf8_lossy(&probe.expect("it runs").stderr).into_owned();
    assert!(message.contains(&archive), "{message}");
}

#[test]
fn rows_meet_the_accuracy_that_is_promised() {
    let bench = Bench::without_codes();
    let rows = json_rows(&standard_output(
        &mut bench.tristack("crosscheck --format json"),
    ));
    assert_eq!(rows.len(), 108);
    for row in rows {
        let error = row["error"].as_f64().expect("an error").abs();
        assert!(error < 1e-7, "{row}");
        let load = row["reference_force"].as_f64().expect("a force") + 3.0;
        let uncertainty = row["uncertainty"].as_f64().expect("an uncertainty") / load;
        assert!(
            error <= uncertainty,
            "the budget leaves something out: {row}"
        );
    }
}

#[test]
fn every_style_of_hertz_has_the_onset_and_the_peak_of_its_exact_limit() {
    let bench = Bench::without_codes();
    let line = "crosscheck --law hertz --profile standard --format json";
    let rows = json_rows(&standard_output(&mut bench.tristack(line)));
    assert_eq!(rows.len(), 180);
    let (yielding, others): (Vec<_>, Vec<_>) = rows
        .into_iter()
        .partition(|row| !row["reference_force"].is_null());
    let none = |row: &serde_json::Value| row["verdict"] == "no-yield";
    assert_eq!(others.iter().filter(|row| none(row)).count(), 12);
    for row in yielding {
        assert_eq!(row["verdict"], "agrees", "{row}");
        let number = |name: &str| row[name].as_f64().expect("a number");
        let away = |measured: &str, exact: &str| (number(measured) - number(exact)).abs();
        let onset = away("slip_onset", "reference_onset");
        let promised = if row["code"] == "native" { 1e-6 } else { 1e-5 };
        assert!(
            onset < promised * (number("reference_onset") + 3.0),
            "{row}"
        );
        assert!(onset <= number("slip_onset_uncertainty"), "{row}");
        assert!(
            away("peak_force", "reference_force") <= number("peak_uncertainty"),
            "{row}"
        );
    }
}

#[test]
fn csv_has_the_agreed_columns() {
    let bench = Bench::without_codes();
    let text = standard_output(&mut bench.tristack("crosscheck --codes native --format csv"));
    assert_eq!(
        text.lines().next(),
        Some(
            "stiffness,mu,mu_d,kappa,bodies,code,version,source,pair_torque_arm,pair_kinematic_arm,\
             floor_torque_arm,floor_kinematic_arm,history_update,law_power,history,floor_ratio,floor_kappa,\
             tangential_stiffening,yield_force,uncertainty,reference,reference_force,slip_onset,\
             slip_onset_uncertainty,reference_onset,peak_force,peak_uncertainty,error,tolerance,model_form,cause,verdict"
        )
    );
    assert_eq!(text.lines().count(), 19);
}

#[test]
fn a_second_crosscheck_runs_nothing_and_says_the_same() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --format csv";
    let first = standard_output(&mut bench.tristack(line));
    let mut again = bench.tristack(line);
    assert_eq!(standard_output(&mut again), first);
    assert!(standard_error(&mut again).contains("90 of 90 runs are there already"));
}

#[test]
fn fresh_ignores_the_store() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --fresh --format csv";
    let first = standard_output(&mut bench.tristack(line));
    let mut again = bench.tristack(line);
    assert!(!standard_error(&mut again).contains("there already"));
    assert_eq!(standard_output(&mut again), first);
}

#[test]
fn the_number_of_workers_does_not_change_a_digit() {
    let bench = Bench::without_codes();
    let run = |jobs: u32| {
        let line = format!("crosscheck --codes native --fresh --format csv --jobs {jobs}");
        standard_output(&mut bench.tristack(&line))
    };
    assert_eq!(run(1), run(4));
}

#[test]
fn a_recording_made_with_another_deck_is_refused_with_the_remedy() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("yade").expect("it is built in"),
        |recording| {
            for run in &mut recording.runs {
                run.summary.provenance.deck_hash.insert(0, '0');
            }
        },
    );
    let mut command = bench.tristack("crosscheck --format json");
    command.env("TRISTACK_REFERENCE", bench.path("reference"));
    let output = command.output().expect("it runs");
    assert_eq!(output.status.code(), Some(3));
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(message.contains("made with another deck"), "{message}");
    assert!(
        message.contains("tristack record --codes yade"),
        "{message}"
    );
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let verdicts = |code: &str, verdict: &str| {
        let rows = rows.iter();
        rows.filter(|row| row["code"] == code && row["verdict"] == verdict)
            .count()
    };
    assert_eq!(verdicts("yade", "missing"), 18);
    assert_eq!(
        verdicts("liggghts", "missing"),
        18,
        "its recordings were not copied"
    );
    assert_eq!(verdicts("native", "agrees"), 18);
}

fn yade_notes_and_verdicts(bench: &Bench) -> (String, Vec<String>) {
    let mut command = bench.tristack("crosscheck --format json");
    command.env("TRISTACK_REFERENCE", bench.path("reference"));
    let output = command.output().expect("it runs");
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let own = rows.iter();
    let own = own.filter(|row| row["code"] == "yade");
    let verdicts = own.map(|row| row["verdict"].as_str().expect("a word").to_owned());
    let verdicts = verdicts.collect();
    (
        String::from_utf8_lossy(&output.stderr).into_owned(),
        verdicts,
    )
}

#[test]
fn a_recorded_probe_does_not_vouch_for_runs_of_another_version() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("yade").expect("it is built in"),
        |recording| {
            for run in &mut recording.runs {
                run.summary.provenance.identity.version += "1";
            }
        },
    );
    let (message, verdicts) = yade_notes_and_verdicts(&bench);
    assert_eq!(verdicts, vec!["inconclusive"; 18], "{message}");
    assert!(
        message.contains("its probe was made with another program (yade 2023.02a"),
        "{message}"
    );
}

#[test]
fn the_recorded_probe_of_another_code_does_not_stand_in() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("yade").expect("it is built in"),
        |recording| {
            recording.probe =
                common::recording(&Code::named("yade-facet").expect("it is built in")).probe;
        },
    );
    let (message, verdicts) = yade_notes_and_verdicts(&bench);
    assert_eq!(verdicts, vec!["inconclusive"; 18], "{message}");
    assert!(
        message.contains("its contact convention could not be measured"),
        "{message}"
    );
}

#[test]
fn shortcuts_are_measured_and_refused_where_nobody_knows_them() {
    let bench = Bench::without_codes();
    let sweep = "sweep --code native --mu 0.2:0.4:0.1 --stiffness 1e3";
    let text = standard_output(&mut bench.tristack(&format!("{sweep} --shortcuts --format json")));
    for row in json_rows(&text) {
        assert_eq!(row["verdict"], "agrees", "{row}");
        assert!(row["error"].as_f64().expect("a number").abs() < 1e-5);
    }
    let plain = standard_output(&mut bench.tristack(&format!("{sweep} --format json")));
    assert_ne!(plain, text, "shortcuts change the last digits");
    let simulated = "simulate --code yade --mu 0.2 --stiffness 1e3 --shortcuts";
    let refusal = standard_error(&mut bench.tristack(simulated));
    assert!(
        refusal.contains("--shortcuts") && refusal.contains("native takes them"),
        "{refusal}"
    );
}

/// The page is about runs with shortcuts, and so is the explanation that it names.
#[test]
fn a_page_names_the_command_that_explains_its_own_rows() {
    let bench = Bench::without_codes();
    let page = |options: &str| {
        let line = format!("crosscheck --codes native {options} --out results");
        bench.tristack(&line).assert().code(0);
        fs::read_to_string(bench.path("results/crosscheck.md")).expect("the page")
    };
    let named = "`tristack crosscheck --shortcuts --explain CODE/MU/STIFFNESS`";
    assert!(page("--shortcuts").contains(named));
    assert!(page("").contains("`tristack crosscheck --explain CODE/MU/STIFFNESS`"));
    let explain = "crosscheck --explain native/0.3/100";
    let text = standard_output(&mut bench.tristack(&format!("{explain} --shortcuts")));
    assert!(
        text.contains("│   7 ┆"),
        "the runs without shortcuts: {text}"
    );
    assert_ne!(text, standard_output(&mut bench.tristack(explain)));
}

#[test]
fn off_a_terminal_progress_is_a_line_for_each_phase() {
    let bench = Bench::without_codes();
    let line = "crosscheck --codes native --mu 0.2,0.3 --stiffness 100";
    let message = standard_error(&mut bench.tristack(line));
    let phases = message
        .lines()
        .take_while(|line| !line.contains("rows agree"));
    let phases: Vec<&str> = phases.collect();
    for (said, expected) in phases.iter().zip([
        "planning",
        "probing 1 code",
        "probing 1 code: 1 of 1 made in ",
        "compressions",
        "compressions: 10 of 10 made in ",
    ]) {
        assert!(said.starts_with(expected), "{message}");
    }
    assert_eq!(phases.len(), 5, "{message}");
}

#[test]
fn the_explanation_of_a_row_is_json_too() {
    let bench = Bench::without_codes();
    let line = "crosscheck --explain native/0.3/100 --format json";
    let found = common::json(&standard_output(&mut bench.tristack(line)));
    let tables = found["tables"].as_array().expect("a list of tables");
    let rows = |name: &str| {
        let schema = format!("tristack/{name}/1");
        let table = tables.iter().find(|table| table["schema"] == *schema);
        table.expect(name)["rows"].as_array().expect("rows").clone()
    };
    assert_eq!(rows("crosscheck")[0]["verdict"], "agrees");
    assert_eq!(rows("budget").len(), 1);
    let runs = rows("explained_runs");
    assert_eq!(runs.len(), 5);
    for run in &runs {
        let share = run["force_balance"].as_f64().expect("native is tested");
        assert!(share < 1.0, "{run}");
    }
    assert_eq!(rows("explanation")[0]["arms"], "measured");
}

fn places(rows: &[serde_json::Value]) -> Vec<(f64, f64)> {
    let number = |row: &serde_json::Value, key: &str| row[key].as_f64().expect("a number");
    let places = rows
        .iter()
        .map(|row| (number(row, "mu"), number(row, "stiffness")));
    places.collect()
}

#[test]
fn mu_and_stiffness_choose_rows_of_the_profile_or_make_stacks_of_their_own() {
    let bench = Bench::without_codes();
    let of = |options: &str| {
        let line = format!("crosscheck --codes native {options} --format json");
        places(&json_rows(&standard_output(&mut bench.tristack(&line))))
    };
    assert_eq!(of("--mu 0.3"), [(0.3, 1e2), (0.3, 1e3), (0.3, 1e4)]);
    assert_eq!(of("--stiffness 1e2").len(), 6);
    let critical = of("--mu critical,0.2 --stiffness 1e2 --profile quick");
    assert_eq!((critical.len(), critical[0]), (2, (0.2, 1e2)));
    assert_eq!(
        of("--mu 0.26795 --profile quick --stiffness 1e2"),
        critical[1..]
    );
    let own = of("--mu 0.31 --stiffness 2e2");
    assert_eq!(own, [(0.31, 2e2)]);
}

#[test]
fn a_value_that_chooses_no_row_is_refused_with_those_of_the_profile() {
    let bench = Bench::without_codes();
    for (options, parts) in [
        (
            "--mu 0.35",
            ["`--mu` is 0.35", "0.12, 0.2, 0.25, mu_c, 0.3, 0.4;"],
        ),
        (
            "--profile standard --mu 0.3 --stiffness 1e2,5e3",
            ["`--stiffness` is 5000", "100, 1000, 10000;"],
        ),
    ] {
        let line = format!("crosscheck --codes native {options}");
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{message}");
        for part in parts {
            assert!(message.contains(part), "{line}: {part} in {message}");
        }
    }
}

/// Above this friction the wall reaches the bottom cylinders of some styles first.
#[test]
fn no_yield_where_none_is_expected_is_no_failure() {
    let bench = Bench::without_codes();
    let line = "crosscheck --law hertz --profile standard --mu 0.4 --stiffness 1e3 --only-failures --junit tests.xml";
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert!(message.contains("no-yield"), "{message}");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(!text.contains("no-yield"), "{text}");
    let tests = fs::read_to_string(bench.path("tests.xml")).expect("the tests");
    assert_eq!(tests.matches("<testcase ").count(), 10, "{tests}");
    for trouble in ["<skipped", "<failure", "<error"] {
        assert!(!tests.contains(trouble), "{tests}");
    }
}

#[test]
fn failures_a_summary_and_junit_show_the_same_rows() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("yade").expect("it is built in"),
        |_| (),
    );
    let run = |options: &str| {
        let mut command = bench.tristack(&format!("crosscheck --mu 0.3 {options}"));
        command.env("TRISTACK_REFERENCE", bench.path("reference"));
        let output = command.output().expect("it runs");
        assert_eq!(output.status.code(), Some(3));
        String::from_utf8(output.stdout).expect("text")
    };
    let line = "--only-failures --junit tests.xml --out results --format json";
    let text = run(line);
    let failures = json_rows(&text);
    assert_eq!(
        common::json(&text)["command"],
        "tristack crosscheck --mu 0.3 --only-failures"
    );
    assert_eq!(failures.len(), 12);
    assert!(failures.iter().all(|row| row["verdict"] == "missing"));
    let kept = fs::read_to_string(bench.path("results/crosscheck.csv")).expect("a table");
    assert_eq!(kept.lines().count(), 19, "files have all rows");
    let tests = fs::read_to_string(bench.path("tests.xml")).expect("the tests");
    assert_eq!(tests.matches("<testcase ").count(), 18, "{tests}");
    assert_eq!(tests.matches("<skipped ").count(), 12, "{tests}");
    assert!(
        tests.contains("<testcase name=\"native at mu = 0.3, stiffness = 100\""),
        "{tests}"
    );
    let summary = json_rows(&run("--summary --format json"));
    assert_eq!(summary.len(), 6);
    for row in summary {
        let here = ["native", "yade"].contains(&row["code"].as_str().expect("a name"));
        let (agrees, missing) = if here { (3, 0) } else { (0, 3) };
        assert_eq!(row["rows"], 3);
        assert_eq!(row["agrees"], agrees, "{row}");
        assert_eq!(row["missing"], missing, "{row}");
        assert_eq!(row["largest_error"].is_null(), !here, "{row}");
    }
    let table = run("--summary");
    assert!(
        table.contains("│ code ") && table.contains("┆ missing ┆"),
        "{table}"
    );
    assert!(!table.contains("differs"), "{table}");
}

/// The stacks of a crosscheck with these options, and what it says.
fn drawn(bench: &Bench, options: &str) -> (Vec<(f64, f64)>, String) {
    let line = format!("crosscheck --codes native --format json {options}");
    let output = bench.tristack(&line).output().expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let rows = json_rows(&String::from_utf8(output.stdout).expect("text"));
    let number = |row: &serde_json::Value, name: &str| row[name].as_f64().expect("a number");
    let stacks = rows
        .iter()
        .map(|row| (number(row, "mu"), number(row, "stiffness")));
    let message = String::from_utf8(output.stderr).expect("text");
    (stacks.collect(), message)
}

#[test]
fn unannounced_stacks_are_others_each_time_and_the_same_with_the_seed_that_is_printed() {
    let bench = Bench::without_codes();
    let (first, message) = drawn(&bench, "--unannounced 3");
    assert_eq!(first.len(), 3);
    let (second, _) = drawn(&bench, "--unannounced 3");
    assert_ne!(first, second);
    let seed = message.split("--seed ").nth(1).expect("the seed");
    let seed = seed.lines().next().expect("a line");
    let (again, _) = drawn(&bench, &format!("--unannounced 3 --seed {seed}"));
    assert_eq!(first, again);
    // As they are printed they can be typed, and name the same rows.
    let (mu, stiffness) = first[0];
    let (typed, _) = drawn(&bench, &format!("--mu {mu} --stiffness {stiffness}"));
    assert_eq!(typed, [(mu, stiffness)]);
}
