//! The case files of examples/cases/ run, and give what their page says.

use crate::common::{Bench, json_rows, project, standard_output};
use std::collections::BTreeSet;
use std::fs;

const FOLDER: &str = "examples/cases";

/// The cells of each row of the table of the page: file, words, slip onset, largest force.
fn told() -> Vec<[String; 4]> {
    let page = fs::read_to_string(project().join(FOLDER).join("README.md")).expect("the page");
    let rows = page.lines().filter(|line| line.starts_with("| ["));
    let rows = rows.map(|row| {
        let cells = row.trim_matches('|').split('|');
        let cells: Vec<String> = cells.map(|cell| cell.trim().to_owned()).collect();
        cells.try_into().expect("four cells")
    });
    rows.collect()
}

/// The name in a link, `[NAME](NAME)`.
fn linked(cell: &str) -> String {
    let name = cell.trim_start_matches('[').split(']').next();
    name.expect("a link").to_owned()
}

/// What `simulate` says of a case file.
fn simulated(name: &str) -> serde_json::Value {
    let bench = Bench::without_codes();
    let file = project().join(FOLDER).join(name);
    let line = format!(
        "simulate --code native --format json --case {}",
        file.display()
    );
    let mut rows = json_rows(&standard_output(&mut bench.tristack(&line)));
    rows.remove(0)
}

#[test]
fn every_case_gives_the_forces_of_the_page() {
    for [file, _, onset, peak] in told() {
        let row = simulated(&linked(&file));
        for (key, expected) in [("slip_force", onset), ("peak_force", peak)] {
            let decimals = expected.split('.').nth(1).map_or(0, str::len);
            let force = row[key].as_f64().expect("a force");
            assert_eq!(format!("{force:.decimals$}"), expected, "{file} {key}");
        }
    }
}

#[test]
fn every_case_stands_on_the_page_and_explains_its_keys() {
    let folder = fs::read_dir(project().join(FOLDER)).expect("the folder");
    let names = folder.map(|entry| entry.expect("an entry").file_name());
    let names = names.map(|name| name.into_string().expect("text"));
    let cases: BTreeSet<String> = names.filter(|name| name.ends_with(".toml")).collect();
    let listed: BTreeSet<String> = told().iter().map(|[file, ..]| linked(file)).collect();
    assert_eq!(cases, listed);
    for case in cases {
        let text = fs::read_to_string(project().join(FOLDER).join(&case)).expect("a case");
        let command = format!("simulate --code native --case {FOLDER}/{case}");
        assert!(text.contains(&command), "{case} lacks `{command}`");
        let comments = text.lines().filter(|line| line.starts_with('#')).count();
        let keys = text.lines().filter(|line| line.contains(" = ")).count();
        assert!(comments > keys, "{case}");
    }
}
