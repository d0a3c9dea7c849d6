//! Codes whose contacts or bodies are of another kind than the example's: copies of it.

use crate::common::Bench;
use crate::schemes::{CROSSCHECK, changed, rows};
use serde::Deserialize;
use std::fs;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Variant {
    name: String,
    /// What is replaced in mydem.py, and by what.
    change: Vec<[String; 2]>,
    /// Exit status and verdict of a crosscheck.
    status: i32,
    verdict: String,
    /// Words in its messages.
    words: Vec<String>,
    /// Words in the items of a check.
    check: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Variants {
    variant: Vec<Variant>,
}

/// Verdict, cause and words are right in a crosscheck and in a check.
#[test]
fn every_variant_gets_its_verdict_and_its_cause() {
    let variants: Variants = toml::from_str(include_str!("variants.toml")).expect("a table");
    for own in variants.variant {
        let bench = changed(own.change.iter().map(|[from, to]| [from.as_str(), to]));
        let (status, judged, messages) = rows(&bench, CROSSCHECK);
        let name = &own.name;
        assert_eq!(
            (status, judged.len()),
            (own.status, 1),
            "{name}: {messages}"
        );
        assert_eq!(judged[0]["verdict"], own.verdict.as_str(), "{name}");
        for word in &own.words {
            assert!(messages.contains(word), "{name}, {word}: {messages}");
        }
        let (_, items, _) = rows(&bench, "check ./mydem --format json");
        let texts = items
            .iter()
            .map(|item| format!("{} {}", item["found"], item["causes"]));
        let told: String = texts.collect();
        for word in &own.check {
            assert!(told.contains(word), "{name}, {word}: {items:#?}");
        }
    }
}

/// A bench with the variant of this name.
fn bench_of(name: &str) -> Bench {
    let variants: Variants = toml::from_str(include_str!("variants.toml")).expect("a table");
    let mut variants = variants.variant.into_iter();
    let own = variants.find(|own| own.name == name).expect("a variant");
    changed(own.change.iter().map(|[from, to]| [from.as_str(), to]))
}

/// What is not known is shown as that, and no limit is given for it.
#[test]
fn arms_that_are_not_known_have_no_limit() {
    let bench = bench_of("rolling resistance");
    let (_, judged, _) = rows(&bench, CROSSCHECK);
    for absent in [
        "pair_torque_arm",
        "floor_torque_arm",
        "reference_force",
        "model_form",
    ] {
        assert!(judged[0][absent].is_null(), "{absent}: {judged:?}");
    }
    let line = "crosscheck --codes ./mydem --mu 0.3 --stiffness 100 --junit rows.xml";
    let output = bench.tristack(line).output().expect("it runs");
    let table = String::from_utf8(output.stdout).expect("text");
    assert!(table.contains("unknown (kinematic 0)"), "{table}");
    let tests = fs::read_to_string(bench.path("rows.xml")).expect("a file");
    assert!(tests.contains("type=\"another model\""), "{tests}");
}

#[test]
fn the_contact_point_of_a_measured_arm_is_told_in_words() {
    let bench = bench_of("a contact point 1.5 overlaps inside the cylinder, at the floor");
    let (status, _, told) = rows(&bench, "probe --codes ./mydem --format json");
    assert_eq!(status, 0, "{told}");
    let point = "on the floor, the contact point lies 1.5 overlaps inside the surface of the undeformed body";
    assert!(told.contains(point), "{told}");
}
