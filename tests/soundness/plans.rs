//! Plans of runs that are made elsewhere, as `tristack judge` reads them, with the results that lie beside them.

use super::Seed;
use super::scenes::{short_case, short_test};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;
use tristack::code::{Code, PlannedRun, PlannedTask};
use tristack::dem::compress_stack;
use tristack::model::sha256_hex;
use tristack::series::Series;
use tristack::study::Plan;

const PLAN: &str = "plan.json";
/// What was given to the one run that has a result.
const GIVEN: &[u8] = b"compress\n";

/// A directory in which one run has a result; each input is its plan.
static PLACE: LazyLock<TempDir> = LazyLock::new(|| {
    let place = tempfile::tempdir().expect("a directory");
    let run = place.path().join("runs/stack-00");
    fs::create_dir_all(&run).expect("a directory");
    let series = compress_stack(&short_case(), || true).expect("a finite series");
    fs::write(run.join("stack.deck"), GIVEN).expect("a deck");
    fs::write(run.join("log.lammps"), log(&series)).expect("a result");
    place
});

/// A series as LAMMPS writes it.
fn log(series: &Series) -> String {
    let csv = String::from_utf8(series.to_csv()).expect("text");
    format!("{}Loop time of 2\n", csv.replace(',', " "))
}

pub fn check(data: &[u8]) {
    let root = PLACE.path();
    fs::write(root.join(PLAN), data).expect("it can be written");
    let plan = match Plan::read(root) {
        Ok(plan) => plan.expect("it is there"),
        Err(refusal) => return assert!(refusal.to_string().contains(PLAN), "{refusal}"),
    };
    let written = serde_json::to_vec(&plan).expect("plain data");
    fs::write(root.join(PLAN), written).expect("it can be written");
    assert_eq!(Plan::read(root).expect("its own JSON"), Some(plan.clone()));
    let code = Code::named("lammps").expect("it is built in");
    for row in &plan.rows {
        row.stack.validate().expect("what is accepted is valid");
    }
    for run in &plan.runs {
        stays_inside(run);
    }
    // The task of the run that has a result may have become another one, or its files.
    let troubles = plan.troubles(&code, root);
    let complete = troubles
        .iter()
        .zip(&plan.runs)
        .filter(|(trouble, _)| trouble.is_none());
    for (_, run) in complete {
        assert_eq!(
            (run.directory.trim_start_matches("./"), run.result.as_str()),
            ("runs/stack-00", "log.lammps")
        );
    }
}

fn stays_inside(run: &PlannedRun) {
    for name in run.files.keys().chain([&run.directory, &run.result]) {
        let leads_out = Path::new(name).is_absolute() || name.split('/').any(|part| part == "..");
        assert!(!leads_out, "{name}");
    }
    if let PlannedTask::Stack(case) = &run.task {
        case.validate().expect("what is accepted is valid");
    }
}

fn run(directory: &str, task: PlannedTask) -> PlannedRun {
    PlannedRun {
        directory: directory.to_owned(),
        deck_hash: "00".to_owned(),
        files: BTreeMap::from([("stack.deck".to_owned(), sha256_hex(GIVEN))]),
        command: vec!["lmp".to_owned(), "-in".to_owned(), "stack.deck".to_owned()],
        environment: BTreeMap::new(),
        result: "log.lammps".to_owned(),
        steps: 7,
        seconds: 0.5,
        task,
    }
}

pub fn seeds() -> Vec<Seed> {
    let runs = [
        run("runs/stack-00", PlannedTask::Stack(short_case())),
        run("runs/motion-00", PlannedTask::Motion(short_test())),
        run("runs/stack-00", PlannedTask::Motion(short_test())),
    ];
    let plan = |runs: &[PlannedRun]| {
        let plan = json!({
            "schema": "tristack/plan/1",
            "command": "tristack plan --code lammps --out away",
            "tristack": "0.1.0",
            "code": "lammps",
            "folder": null,
            "version": "1.0",
            "rows": [{ "stack": short_case().stack, "method": "extrapolated" }],
            "continues": true,
            "steps": 7,
            "seconds": 0.5,
            "runs": runs,
        });
        plan.to_string().into_bytes()
    };
    vec![
        ("all".to_owned(), plan(&runs)),
        ("stack".to_owned(), plan(&runs[..1])),
        ("none".to_owned(), plan(&[])),
    ]
}
