//! `tristack predict`, as an experimenter sees it.

use crate::common::{Bench, json_rows, standard_error, standard_output};
use assert_cmd::Command;
use insta::assert_snapshot;

/// The words of the command line, some with blanks in them.
fn predict(bench: &Bench, words: &[&str]) -> Command {
    let mut command = bench.tristack("predict");
    command.args(words);
    command
}

const ELASTOMER: [&str; 8] = [
    "--youngs",
    "1 MPa",
    "--density",
    "1000 kg/m3",
    "--radius",
    "1 cm",
    "--mu",
    "0.3",
];

fn elastomer<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ELASTOMER.iter().chain(more).copied().collect()
}

#[test]
fn table_sets_the_estimates_side_by_side() {
    let bench = Bench::without_codes();
    let words = elastomer(&["--length", "1 cm"]);
    assert_snapshot!(standard_output(&mut predict(&bench, &words)));
}

#[test]
fn range_covers_the_uncertainty_of_the_friction() {
    let bench = Bench::without_codes();
    let more = [
        "--length",
        "1 cm",
        "--mu-uncertainty",
        "0.02",
        "--contact",
        "hertz",
    ];
    let text = standard_output(&mut predict(&bench, &elastomer(&more)));
    assert_snapshot!(
        text.lines()
            .find(|line| line.starts_with("yield"))
            .unwrap_or_default()
    );
}

/// The paper: E ~ 1 MPa, rho ~ 1e3, L ~ 1 cm give epsilon ~ 1e-4 and, with m = 1 g, f ~ 1e2 N.
#[test]
fn elastomer_of_the_paper_is_reproduced() {
    let bench = Bench::without_codes();
    let words = elastomer(&["--length", "3.1831 mm", "--format", "json"]);
    let estimate = &json_rows(&standard_output(&mut predict(&bench, &words)))[0];
    assert_eq!(estimate["contact"], "paper-scaling");
    for (value, expected) in [
        (&estimate["mass"], 1e-3),
        (&estimate["epsilon"], 9.80665e-5),
        (&estimate["paper_formula_newton"], 1e2),
    ] {
        let value = value.as_f64().expect("a number");
        assert!((value / expected - 1.0).abs() < 1e-4, "{value} {expected}");
    }
}

/// The paper: wood of the same mass needs 1e5 N, which is E of some 1 GPa; 10 GPa would be 1e6 N.
#[test]
fn wood_of_the_paper_is_reproduced_across_the_grain() {
    let bench = Bench::without_codes();
    for (modulus, exponent) in [("1 GPa", 5.0), ("10 GPa", 6.0)] {
        let line =
            "--mass|1 g|--radius|12.6 mm|--length|4.01 mm|--poisson|0.3|--mu|0.3|--format|json";
        let words: Vec<&str> = ["--youngs", modulus]
            .into_iter()
            .chain(line.split('|'))
            .collect();
        let rows = json_rows(&standard_output(&mut predict(&bench, &words)));
        let newton = rows[0]["paper_formula_newton"].as_f64();
        assert_eq!(newton.expect("a number").log10().round(), exponent);
    }
}

#[test]
fn wooden_cylinders_of_the_movies() {
    let bench = Bench::without_codes();
    let line = "--youngs|1 GPa|--mass|21.9 g|--radius|20 mm|--length|40 mm|--poisson|0.3|--mu|0.2";
    let words: Vec<&str> = line.split('|').collect();
    assert_snapshot!(standard_output(&mut predict(&bench, &words)));
}

#[test]
fn what_does_not_yield_says_what_happens_instead() {
    let bench = Bench::without_codes();
    for (mu, what) in [
        ("0.05", "under its own weight; it carries no load;"),
        ("0.9", "the top wall reaches"),
    ] {
        let words = [
            "--youngs", "1 MPa", "--mass", "1 g", "--radius", "1 cm", "--length", "1 cm", "--mu",
            mu,
        ];
        let text = standard_output(&mut predict(&bench, &words));
        assert!(
            text.contains("no yield force") && text.contains(what),
            "{text}"
        );
        // Between a third of mu_c and the friction at which the wall reaches the bottom cylinders first.
        assert!(
            text.contains("it yields where mu is between 0.089"),
            "{text}"
        );
        assert!(!text.contains("0 to 0 N"), "{text}");
    }
}

#[test]
fn csv_has_a_line_an_estimate() {
    let bench = Bench::without_codes();
    let words = elastomer(&["--length", "1 cm", "--format", "csv"]);
    let text = standard_output(&mut predict(&bench, &words));
    assert_snapshot!(text.lines().next().expect("a header"));
    assert_eq!(text.lines().count(), 4);
}

#[test]
fn wrong_input_is_named_with_what_would_be_accepted() {
    let bench = Bench::without_codes();
    for (more, parts) in [
        (vec!["--length", "1 kg"], vec!["--length", "1 kg", "cm, mm"]),
        (vec!["--length", "1"], vec!["--length", "'1'", "unit"]),
        (
            vec!["--length", "1 cm", "--mu-uncertainty", "0.4"],
            vec!["--mu-uncertainty", "0.4"],
        ),
        (
            vec!["--length", "1 cm", "--poisson", "0.6"],
            vec!["--poisson", "0.6", "0.5"],
        ),
        (
            vec!["--length", "1 cm", "--mass", "1 g"],
            vec!["--density", "--mass"],
        ),
        (
            vec!["--length", "1e-300 m", "--kappa", "-1"],
            vec!["kappa", "-1"],
        ),
    ] {
        let words = elastomer(&more);
        let message = standard_error(&mut predict(&bench, &words));
        for part in parts {
            assert!(message.contains(part), "{message}");
        }
        predict(&bench, &words).assert().code(1);
    }
}

#[test]
fn cylinders_too_soft_to_stand_are_refused() {
    let bench = Bench::without_codes();
    let line = "--youngs|10 Pa|--density|1 g/cm3|--radius|0.1 m|--length|0.1 m|--mu|0.3";
    let words: Vec<&str> = line.split('|').collect();
    let message = standard_error(&mut predict(&bench, &words));
    assert!(
        message.contains("k_n r/(m g)") && message.contains("softer"),
        "{message}"
    );
}
