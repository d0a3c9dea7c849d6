//! Every number in the prose of the report comes from its rows.

use super::{file, report};
use std::collections::HashMap;
use tristack::model::CRITICAL_FRICTION;

type Row = HashMap<String, String>;

fn rows(table: &str) -> Vec<Row> {
    let text = file(&format!("tables/{table}.csv"));
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader
        .deserialize()
        .map(|row| row.expect("a row"))
        .collect()
}

fn number(row: &Row, column: &str) -> f64 {
    let cell = &row[column];
    cell.parse()
        .unwrap_or_else(|_| panic!("{column} is {cell}"))
}

/// How many of `rows` have a word in a column.
fn count(rows: &[Row], column: &str, word: &str) -> usize {
    rows.iter().filter(|row| row[column] == word).count()
}

/// The item of the summary that begins with, or has, `words`.
fn item(words: &str) -> String {
    let page = file("report.md");
    let summary = page.split("## Summary").nth(1).expect("a summary");
    let items = summary.lines().filter_map(|line| line.strip_prefix("- "));
    let found = items.into_iter().find(|item| item.contains(words));
    found
        .unwrap_or_else(|| panic!("no item on {words}"))
        .to_owned()
}

/// The numbers of a text, powers of ten in TeX with their factors, without those in targets of links and in code.
fn numbers(text: &str) -> Vec<f64> {
    let mut words = String::new();
    for (index, part) in text.split('`').enumerate() {
        words += if index % 2 == 0 { part } else { " " };
    }
    // What is linked is named by its number, which another test checks.
    while let Some(start) = words.find("](") {
        let open = words[..start].rfind('[').unwrap_or(start);
        let end = words[start..].find(')').expect("a whole link") + start;
        words.replace_range(open..=end, " ");
    }
    let words = words
        .replace("\\times 10^{", "e")
        .replace("\\times10^{", "e")
        .replace(" e", "e");
    let words = words
        .replace("10^{", "1e")
        .replace("10^", "1e")
        .replace('}', " ");
    let is_part = |char: char| char.is_ascii_digit() || ".e-".contains(char);
    let parts = words.split(|char: char| !is_part(char));
    parts
        .filter_map(|part| part.trim_matches(['.', 'e', '-']).parse().ok())
        .collect()
}

fn assert_numbers(text: &str, expected: &[f64]) {
    let found = numbers(text);
    assert_eq!(
        found.len(),
        expected.len(),
        "{text}: {found:?} for {expected:?}"
    );
    for (found, expected) in found.iter().zip(expected) {
        let digits = (1..=17).map(|digits| rounded(*expected, digits));
        assert!(
            digits.into_iter().any(|value| value == *found),
            "{found} for {expected} in: {text}"
        );
    }
}

/// The size of `value` with so many digits.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{:.*e}", digits - 1, value.abs())
        .parse()
        .expect("a number")
}

#[test]
fn the_counts_of_claims_are_those_of_the_rows() {
    let claims = rows("claims");
    let mended = |verdict: &str| {
        let own = claims.iter().filter(|row| row["verdict"] == verdict);
        own.filter(|row| !row["erratum"].is_empty()).count() as f64
    };
    let of = |verdict: &str| count(&claims, "verdict", verdict) as f64;
    let all = claims.len() as f64;
    let expected = [
        all,
        of("holds"),
        of("approximately"),
        of("fails"),
        of("untestable"),
        mended("fails"),
        mended("approximately"),
    ];
    // The second number stands in a link.
    assert_numbers(&item("checkable statements"), &expected);
    assert_eq!(
        rows("errata").len() as f64,
        mended("fails") + mended("approximately")
    );
}

#[test]
fn the_counts_of_rows_are_those_of_the_tables() {
    let judged: Vec<Row> = ["yield_curves", "scaling", "law_forces", "law_scaling"]
        .into_iter()
        .flat_map(rows)
        .collect();
    let of = |verdict: &str| count(&judged, "verdict", verdict) as f64;
    let recorded = count(&judged, "source", "recorded") as f64;
    let all = judged.len() as f64;
    let mut expected = vec![
        all,
        all - recorded,
        recorded,
        of("agrees"),
        of("differs"),
        of("inconclusive"),
    ];
    for row in judged.iter().filter(|row| row["verdict"] == "inconclusive") {
        let mu = number(row, "mu");
        // The critical friction is named.
        expected.extend((mu != CRITICAL_FRICTION).then_some(mu));
        expected.push(number(row, "stiffness"));
        assert!(
            item("judged rows").contains(&row["code"]),
            "{}",
            row["code"]
        );
    }
    expected.extend([of("no-yield"), of("failed") + of("missing")]);
    let literal = rows("literal");
    expected.extend([
        literal.len() as f64,
        count(&literal, "verdict", "agrees") as f64,
    ]);
    assert_numbers(&item("judged rows"), &expected);
}

#[test]
fn agreement_and_largest_error_are_those_of_the_yield_curves() {
    let curves = rows("yield_curves");
    let largest = curves
        .iter()
        .map(|row| number(row, "error").abs())
        .fold(0.0, f64::max);
    let (agreeing, all) = (
        count(&curves, "verdict", "agrees") as f64,
        curves.len() as f64,
    );
    let text = item("At the stiffnesses of Fig. 2(a)");
    // The figure's number in the paper, "2(a)", and the 3 of F + 3.
    assert_numbers(&text, &[2.0, agreeing, all, largest, 3.0]);
    for row in curves {
        assert!(text.contains(&row["code"]), "{text}");
    }
}

#[test]
fn exponents_are_those_of_the_fits() {
    let fits = rows("exponents");
    let fit = |code: &str, mu: f64, power: f64| {
        let found = fits.iter().find(|row| {
            row["code"] == code && number(row, "mu") == mu && number(row, "law_power") == power
        });
        number(
            found.unwrap_or_else(|| panic!("no fit of {code} at {mu}")),
            "exponent",
        )
    };
    let linear: Vec<Row> = fits
        .iter()
        .filter(|row| number(row, "law_power") == 1.0)
        .cloned()
        .collect();
    let critical = CRITICAL_FRICTION;
    let agreeing = count(&linear, "verdict", "agrees") as f64;
    assert_numbers(
        &item("Scaling"),
        &[
            3.0,
            fit("native", critical, 1.0),
            fit("native", 0.3, 1.0),
            0.3,
            1e3,
            1e6,
            1.0,
            2.0,
            1.0,
            0.0,
            agreeing,
            linear.len() as f64,
        ],
    );
}

#[test]
fn the_spread_of_the_laws_is_that_of_their_rows() {
    let laws = rows("law_forces");
    let agreeing = count(&laws, "verdict", "agrees") as f64;
    let mut codes: Vec<&str> = laws.iter().map(|row| row["code"].as_str()).collect();
    codes.sort_unstable();
    codes.dedup();
    let text = item("Hertz contacts");
    let found = numbers(&text);
    let (mu, stiffness) = (found[3], found[4]);
    let place = laws
        .iter()
        .filter(|row| number(row, "mu") == mu && number(row, "stiffness") == stiffness);
    let onsets: Vec<f64> = place
        .filter_map(|row| row["reference_onset"].parse().ok())
        .collect();
    let lowest = onsets.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = onsets.iter().copied().fold(0.0, f64::max);
    let mut expected = vec![
        agreeing,
        laws.len() as f64,
        codes.len() as f64,
        mu,
        stiffness,
        lowest,
        highest,
        3.0,
        1e3,
        1e6,
    ];
    let fits = rows("exponents");
    let fits = fits.iter().filter(|row| number(row, "law_power") != 1.0);
    expected.extend(fits.map(|row| number(row, "exponent")));
    expected.extend([2.0, 5.0, 0.0, 1.0, 2.0]);
    assert_numbers(&text, &expected);
}

/// Numbers of the report's prose that are no results: what they are, and why they may be typed.
const GIVEN: [(f64, &str); 5] = [
    (1.0, "counts and numbers of equations, figures of the paper"),
    (2.0, "the same, and squares"),
    (3.0, "weights in F + 3"),
    (0.0, "limits"),
    (90.0, "right angles"),
];

/// Words before numbers that name a place in the paper or in the documents.
const PLACES: [&str; 7] = [
    "Fig. ",
    "Eq. (",
    "Eqs. (",
    "section ",
    "supplement, ",
    "I.",
    "SHA-",
];

/// The uncertainties of the onsets in a table, relative to F + 3, by which rows are judged.
fn relative_uncertainties(table: &str) -> Vec<f64> {
    let all = rows(table);
    let relative = all.iter().filter_map(|row| {
        let uncertainty: f64 = row.get("slip_onset_uncertainty")?.parse().ok()?;
        let reference: f64 = row["reference_onset"].parse().ok()?;
        Some(uncertainty / (reference + 3.0))
    });
    relative.collect()
}

#[test]
fn every_other_number_of_the_prose_is_a_value_of_a_row() {
    let mut values: Vec<f64> = GIVEN.iter().map(|(value, _)| *value).collect();
    for path in super::files_below(&report().0.path("report/tables")) {
        let name = path.to_string_lossy().into_owned();
        let Some(table) = name.strip_suffix(".csv") else {
            continue;
        };
        if ["claims", "errata", "environment"].contains(&table) {
            continue;
        }
        let text = file(&format!("tables/{name}"));
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let cells = reader.records().flat_map(|row| {
            let row = row.expect("a row");
            row.iter().map(str::to_owned).collect::<Vec<_>>()
        });
        let found: Vec<f64> = cells.filter_map(|cell| cell.parse().ok()).collect();
        values.extend(&found);
        values.extend(relative_uncertainties(table));
        values.push(text.lines().count() as f64 - 1.0);
    }
    let page = file("report.md");
    // The summary has tests of its own, sentence by sentence.
    let (_, page) = page.split_once("\n**Table 1.**").expect("a first table");
    let prose = page
        .lines()
        .filter(|line| !line.starts_with(['|', '!', '<', '#']));
    let mut untraced = Vec::new();
    for line in prose {
        let mut text = line.to_owned();
        for place in PLACES {
            while let Some(at) = text.find(place) {
                let end = text[at + place.len()..]
                    .find([')', ' ', '.', ',', ':'])
                    .map_or(text.len(), |end| at + place.len() + end);
                text.replace_range(at..end, " ");
            }
        }
        for found in numbers(&text) {
            let is_value = |value: &f64| {
                (1..=9).any(|digits| {
                    [rounded(*value, digits), rounded(100.0 * value, digits)].contains(&found)
                })
            };
            if !values.iter().any(is_value) {
                untraced.push(format!(
                    "{found} in: {}",
                    line.chars().take(160).collect::<String>()
                ));
            }
        }
    }
    assert!(untraced.is_empty(), "{untraced:#?}");
}
