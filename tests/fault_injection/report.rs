//! Summary of the rounds, for docs/reliability.md. Faults that are not played keep their rows of an earlier report.

use super::fault::Fault;
use super::round::Story;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// Writes it to the file that TRISTACK_FAULT_REPORT names, if it names one.
pub fn write(seed: usize, commit: &str, outcomes: &[(Fault, Result<Story, String>)]) {
    let Some(path) = std::env::var_os("TRISTACK_FAULT_REPORT") else {
        return;
    };
    let mut faults: BTreeMap<Fault, [usize; 6]> = BTreeMap::new();
    for (fault, outcome) in outcomes {
        let [count, struck, finished, made, real, complaints] = faults.entry(*fault).or_default();
        *count += 1;
        match outcome {
            Ok(story) => {
                *struck += usize::from(story.struck);
                *finished += story.finished_before;
                *made += story.made_after;
                *real += usize::from(story.real);
            }
            Err(_) => *complaints += 1,
        }
    }
    let date = jiff::Timestamp::now().to_string();
    let played = faults.into_iter().map(|(fault, counts)| {
        let (kind, name) = names(fault);
        let [rounds, struck, finished, made, real, complaints] = counts;
        serde_json::json!({
            "kind": kind,
            "fault": name,
            "rounds": rounds,
            "struck": struck,
            "finished_before": finished,
            "made_after": made,
            "real_codes": real,
            "complaints": complaints,
            "commit": commit,
            "date": date,
        })
    });
    let played: Vec<Value> = played.collect();
    let others = kept(Path::new(&path), &played);
    let faults: Vec<Value> = others.into_iter().chain(played).collect();
    let all: u64 = faults.iter().filter_map(|row| row["rounds"].as_u64()).sum();
    let report = serde_json::json!({
        "command": "bash .ci/reliability faults",
        "machine": tristack::code::machine(),
        "rounds": all,
        "seed": seed,
        "faults": faults,
    });
    let text = serde_json::to_string_pretty(&report).expect("plain data");
    std::fs::write(path, text + "\n").expect("the report can be written");
}

/// The rows of an earlier report, for the faults that were not played.
fn kept(path: &Path, played: &[Value]) -> Vec<Value> {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let report: Value = serde_json::from_str(&text).unwrap_or_default();
    let rows = report["faults"].as_array().into_iter().flatten();
    let is_played = |row: &Value| {
        let same = |other: &Value| ["kind", "fault"].iter().all(|key| row[key] == other[key]);
        played.iter().any(same)
    };
    rows.filter(|row| !is_played(row)).cloned().collect()
}

/// The sources that are tried, which have to be asked for at the start: the rounds take long.
pub fn commit() -> String {
    let mut command = std::process::Command::new("git");
    let output = command.args(["describe", "--always", "--dirty", "--abbrev=12"]);
    let output = output.output().expect("git runs");
    String::from_utf8_lossy(&output.stdout).trim().to_owned()
}

/// `Code(SeriesEmpty)` as "code" and "series empty".
fn names(fault: Fault) -> (String, String) {
    let text = format!("{fault:?}");
    let (kind, name) = text.trim_end_matches(')').split_once('(').expect("a kind");
    let words = name.chars().flat_map(|letter| {
        let space = letter.is_uppercase().then_some(' ');
        space.into_iter().chain(letter.to_lowercase())
    });
    let words: String = words.collect();
    (kind.to_lowercase(), words.trim().to_owned())
}
