//! Records of runs: provenance, answers to micro-tests, tables of recorded runs.

use super::scenes::short_test;
use super::{Seed, marked};
use serde_json::json;
use std::path::Path;
use tristack::code::Code;
use tristack::code::Provenance;
use tristack::dem::run_contact_test;
use tristack::model::sha256_hex;
use tristack::runs::{ProbeRecord, Recorded, Recording};

pub fn check(data: &[u8]) {
    let Some((&kind, text)) = data.split_first() else {
        return;
    };
    match kind % 3 {
        0 => check_provenance(text),
        1 => check_probe(text),
        _ => check_table(text),
    }
}

fn check_provenance(text: &[u8]) {
    if let Ok(provenance) = serde_json::from_slice::<Provenance>(text) {
        let again: Provenance = serde_json::from_str(&provenance.to_json()).expect("its own JSON");
        assert_eq!(again, provenance);
    }
}

fn check_probe(text: &[u8]) {
    let Ok(record) = ProbeRecord::parse(text, Path::new("yade.json")) else {
        return;
    };
    for answer in &record.answers {
        assert_eq!(answer.motion.rows().len() as u64, answer.test.steps + 1);
        assert!(record.answer(&[answer.test]).is_some());
    }
    let _ = record.outdated(|test| Code::native().deck_hash(test));
}

fn check_table(text: &[u8]) {
    let text = String::from_utf8_lossy(text);
    let digest = sha256_hex(text.as_bytes());
    let table = format!("# sha256 of all below: {digest}\n{text}");
    let (code, directory) = (
        Code::named("liggghts").expect("it is built in"),
        Path::new("mine"),
    );
    let (_, empty) = Recording::default().to_files(&code);
    let Ok(recording) = Recording::from_files(&table, &empty, directory, &code) else {
        return;
    };
    for run in &recording.runs {
        run.summary
            .case
            .validate()
            .expect("what is accepted is valid");
        assert!(run.series.is_none(), "the archive is empty");
    }
    let (table, _) = recording.to_files(&code);
    let again = Recording::from_files(&table, &empty, directory, &code).expect("its own table");
    assert_eq!(again.to_files(&code).0, table);
    assert_eq!(again.runs.len(), recording.runs.len());
}

/// The recorded runs of a code without their series, some of them.
fn few_runs() -> Recording {
    let recorded =
        Recorded::embedded().recording(&Code::named("liggghts").expect("it is built in"));
    let mut runs = recorded.expect("it is not damaged").runs;
    runs.truncate(2);
    runs.iter_mut().for_each(|run| run.series = None);
    let probe = None;
    Recording { runs, probe }
}

pub fn seeds() -> Vec<Seed> {
    let runs = few_runs();
    let provenance = runs.runs[0].summary.provenance.to_json();
    let (table, _) = runs.to_files(&Code::named("liggghts").expect("it is built in"));
    let (_, table) = table.split_once('\n').expect("a digest");
    let probe = json!({
        "provenance": serde_json::from_str::<serde_json::Value>(&provenance).expect("JSON"),
        "answers": [{
            "test": short_test(),
            "input_hash": "00",
            "motion": run_contact_test(&short_test()).expect("a finite motion"),
        }],
    });
    vec![
        ("provenance".to_owned(), marked(0, provenance)),
        ("probe".to_owned(), marked(1, probe.to_string())),
        ("table".to_owned(), marked(2, table)),
    ]
}
