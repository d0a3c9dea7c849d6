//! What is kept of runs: provenance, answers to micro-tests, summaries.

use super::scenes::short_test;
use super::{Seed, marked, reference};
use serde_json::json;
use std::path::Path;
use tristack::code::Code;
use tristack::code::Provenance;
use tristack::dem::run_contact_test;
use tristack::runs::{ProbeRecord, RunSummary};

pub fn check(data: &[u8]) {
    let Some((&kind, text)) = data.split_first() else {
        return;
    };
    match kind % 3 {
        0 => check_provenance(text),
        1 => check_probe(text),
        _ => check_readings(text),
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
    let _ = record.outdated(|test| Code::NATIVE.deck_hash(test));
}

fn check_readings(text: &[u8]) {
    let Ok(text) = std::str::from_utf8(text) else {
        return;
    };
    let path = Path::new("yade.jsonl");
    for summary in RunSummary::parse_all(text, path).unwrap_or_default() {
        summary.case.validate().expect("what is accepted is valid");
        assert_eq!(summary.case.content_hash().len(), 64);
        let line = serde_json::to_string(&summary).expect("plain data");
        assert_eq!(
            RunSummary::parse_all(&line, path).expect("its own JSON"),
            [summary]
        );
    }
}

pub fn seeds() -> Vec<Seed> {
    let mut entries = std::fs::read_dir(reference().join("lammps"))
        .expect("recorded runs")
        .flatten();
    let recorded = entries.next().expect("a recorded run").path();
    let provenance =
        std::fs::read_to_string(recorded.join("provenance.json")).expect("a provenance");
    let summaries =
        std::fs::read_to_string(reference().join("summaries/liggghts.jsonl")).expect("summaries");
    let first: String = summaries
        .lines()
        .take(2)
        .map(|line| line.to_owned() + "\n")
        .collect();
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
        ("summaries".to_owned(), marked(2, first)),
    ]
}
