//! `tristack report` on a machine without codes, and its page in a real browser.

mod common;
#[path = "report/numbers.rs"]
mod numbers;
#[path = "report/page.rs"]
mod page;

use common::browser::{browser, inspected, laid_out};
use common::{AUTHORS_FORCE, Bench, files_below, json_rows, small_checkout};
use std::collections::HashMap;
use std::fs;
use std::process::Output;
use std::sync::OnceLock;
use tristack::model::Stack;
use tristack::theory::closed_form_limit;

/// The report with published data: one number.
const COMMAND: &str = "report --published repository --out report";

/// The report, made once for all tests from recorded runs and the native DEM.
fn report() -> &'static (Bench, Output) {
    static REPORT: OnceLock<(Bench, Output)> = OnceLock::new();
    REPORT.get_or_init(|| {
        let bench = Bench::without_codes();
        small_checkout(&bench.path("repository"), AUTHORS_FORCE);
        let output = bench.tristack(COMMAND).output();
        (bench, output.expect("it runs"))
    })
}

/// All rows agree, or some are inconclusive and nothing is worse: the native DEM at stiffness 10⁶ is.
fn is_complete(output: &Output) -> bool {
    matches!(output.status.code(), Some(0 | 4))
}

fn file(name: &str) -> String {
    let path = report().0.path("report").join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn message() -> String {
    String::from_utf8_lossy(&report().1.stderr).into_owned()
}

#[test]
fn a_machine_without_codes_gets_the_whole_report_from_recorded_runs() {
    assert!(is_complete(&report().1), "{}", message());
    let page = file("report.md");
    for section in [
        "Summary",
        "Errata",
        "Figures",
        "published numbers",
        "Claims",
        "Agreement",
        "Spheres",
        "Environment",
        "not tested",
    ] {
        let found = page
            .lines()
            .any(|line| line.starts_with("## ") && line.contains(section));
        assert!(found, "no section on {section}");
    }
    assert!(
        page.contains("450 of 450 yield forces of native"),
        "{}",
        &page[..3000]
    );
    assert!(page.contains("recorded runs stand in"));
}

#[test]
fn every_table_and_figure_has_its_files() {
    let page = file("report.md");
    let tables: (&str, &[&str]) = ("tables", &["csv"]);
    for (folder, endings) in [tables, ("figures", &["svg", "pdf"])] {
        let mark = format!("({folder}/");
        let names = page.split(mark.as_str()).skip(1);
        let mut names: Vec<&str> = names.filter_map(|rest| rest.split('.').next()).collect();
        names.dedup();
        assert!(names.len() >= 5, "{folder}: {names:?}");
        for name in names {
            for ending in endings {
                let path = report().0.path(&format!("report/{folder}/{name}.{ending}"));
                let size = fs::metadata(&path).map_or(0, |data| data.len());
                assert!(size > 100, "{} has {size} bytes", path.display());
            }
        }
    }
}

#[test]
fn the_same_store_gives_the_same_bytes() {
    let (bench, first) = report();
    assert!(is_complete(first), "{}", message());
    let again = bench
        .tristack(&COMMAND.replace("--out report", "--out again"))
        .output()
        .expect("it runs");
    assert!(is_complete(&again));
    let files = files_below(&bench.path("report"));
    assert!(files.len() > 30, "{files:?}");
    assert_eq!(files, files_below(&bench.path("again")));
    for name in files {
        let [one, other] = ["report", "again"]
            .map(|directory| fs::read(bench.path(directory).join(&name)).expect("a file"));
        assert!(one == other, "{} differs", name.display());
    }
}

#[test]
fn claims_are_listed_for_programs_and_every_view_has_the_same_rows() {
    let claims = json_rows(&file("claims.json"));
    assert!(claims.len() > 100);
    let verdicts = ["holds", "approximately", "fails", "untestable"];
    let mut table =
        csv::Reader::from_reader(file("tables/claims.csv").as_bytes().to_vec().leak() as &[u8]);
    let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect("a row")).collect();
    assert_eq!(rows.len(), claims.len());
    for (claim, row) in claims.iter().zip(&rows) {
        assert!(verdicts.contains(&claim["verdict"].as_str().expect("a verdict")));
        assert_eq!(claim["id"], row[0]);
        assert!(
            !claim["evidence"].as_str().expect("text").is_empty(),
            "{claim}"
        );
    }
}

#[test]
fn two_bodies_of_the_table_of_spheres_are_cylinders_whose_springs_turn() {
    let text = file("tables/spheres.csv");
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let rows = table.deserialize().map(|row| row.expect("a row"));
    let spheres: Vec<HashMap<String, String>> = rows.collect();
    let number = |row: &HashMap<String, String>, column: &str| -> f64 {
        row[column].parse().expect("a number")
    };
    assert_eq!(spheres.len(), 8);
    for row in spheres.iter().filter(|row| row["bodies"] == "2") {
        let [mu, stiffness] = ["critical_friction", "stiffness"].map(|name| number(row, name));
        let cylinders = closed_form_limit(&Stack::paper(mu, stiffness)).yield_force;
        assert_eq!(number(row, "force_critical"), cylinders.expect("it yields"));
    }
    for row in &spheres {
        let forces = ["force_below", "force_critical", "force_above"];
        let [below, critical, above] = forces.map(|column| number(row, column));
        // Rigid bodies have n − 1 at half the critical friction, and springs take some of that.
        let rigid = number(row, "bodies") - 1.0;
        assert!(0.9 * rigid < below && below < rigid && rigid < critical && critical < above);
    }
}

#[test]
fn a_browser_draws_every_figure_fetches_nothing_and_overlaps_no_text() {
    for width in [1400, 800] {
        let Some(found) = inspected(&file("report.html"), width) else {
            return;
        };
        let pictures = files_below(&report().0.path("report/figures")).len() / 2;
        let figures = found["figures"].as_array().expect("figures");
        assert_eq!(figures.len(), pictures);
        for figure in figures {
            let wide = figure["width"].as_f64().expect("a width");
            assert!(
                wide > 200.0 && figure["height"].as_f64() > Some(100.0),
                "{figure}"
            );
            assert!(
                figure["shapes"].as_u64() > Some(10) && figure["texts"].as_u64() > Some(4),
                "{figure}"
            );
        }
        assert_eq!(found["fetched"], serde_json::json!([]));
        assert_eq!(found["overlaps"], serde_json::json!([]), "at width {width}");
        assert_eq!(found["cut"], serde_json::json!([]), "at width {width}");
        assert_eq!(
            found["sideways"], false,
            "the page scrolls sideways at width {width}"
        );
    }
}

#[test]
fn the_inspection_sees_what_it_looks_for() {
    let Some(browser) = browser() else { return };
    let bench = Bench::without_codes();
    let script = include_str!("page_inspection.js");
    let page = format!(
        "<!doctype html><body><img src=\"http://example.invalid/a.png\"><figure><svg width=\"90\" height=\"90\">\
         <text x=\"5\" y=\"40\">one</text><text x=\"8\" y=\"42\">two</text><text x=\"80\" y=\"80\">cut off</text>\
         </svg></figure><script>{script}</script></body>"
    );
    let output = laid_out(&browser, &bench, &page, 800);
    let dom = String::from_utf8_lossy(&output.stdout);
    assert!(dom.contains("\"one / two\""), "{dom}");
    assert!(dom.contains("example.invalid"), "{dom}");
    assert!(dom.contains("\"cut\":[\"cut off\"]"), "{dom}");
}
