//! Codes whose contacts or bodies are of another kind than the example's: copies of it.

use crate::common::{Bench, project};
use crate::schemes::{CROSSCHECK, changed, rows};
use serde::Deserialize;
use std::fs;
use std::process::Command;
use tristack::code::{ParameterFormat, Task, witness_test};
use tristack::model::ContactConvention;

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

/// A code that knows the stacks of the profiles, and slides too early on all others.
#[test]
fn a_code_that_is_right_at_known_stacks_alone_differs_at_unannounced_ones() {
    let known = [
        "    top, right, left = bodies = [",
        "    if round(1.0 / task[\"gravity\"], 3) not in (100.0, 1000.0, 10000.0):\n        \
         task[\"floor_friction\"] *= 0.999\n    top, right, left = bodies = [",
    ];
    let bench = changed([known].into_iter());
    let (status, judged, messages) = rows(&bench, CROSSCHECK);
    assert_eq!((status, judged.len()), (0, 1), "{messages}");
    let unannounced = "crosscheck --codes ./mydem --unannounced 2 --seed 1 --format json";
    let (status, judged, messages) = rows(&bench, unannounced);
    assert_eq!((status, judged.len()), (2, 2), "{messages}");
    for row in judged {
        assert_eq!(row["verdict"], "differs", "{messages}");
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

/// Changes with which the example takes radius, mass and moment of inertia of each body from `bodies`.
const FROM_BODIES: [[&str; 2]; 14] = [
    ["RADIUS, MASS, INERTIA = 1.0, 1.0, 0.5", ""],
    [
        "self, x, y, vx=0.0, vy=0.0, spin=0.0):",
        "self, own, x, y, vx=0.0, vy=0.0, spin=0.0):\n        self.own = own",
    ],
    ["-MASS *", "-self.own[\"mass\"] *"],
    ["/ MASS", "/ self.own[\"mass\"]"],
    ["/ INERTIA", "/ self.own[\"moment_of_inertia\"]"],
    [
        "RADIUS * (one.spin + two.spin)",
        "(one.own[\"radius\"] * one.spin + two.own[\"radius\"] * two.spin)",
    ],
    ["2.0 * RADIUS", "one.own[\"radius\"] + two.own[\"radius\"]"],
    ["torque = -RADIUS *", "torque = -1.0 *"],
    [
        "one.torque + torque",
        "one.torque + one.own[\"radius\"] * torque",
    ],
    [
        "two.torque + torque",
        "two.torque + two.own[\"radius\"] * torque",
    ],
    ["top.y + RADIUS", "top.y + top.own[\"radius\"]"],
    ["RADIUS", "body.own[\"radius\"]"],
    ["[Cylinder(", "[Cylinder(task[\"bodies\"][int(body) - 1], "],
    [
        "        parameters = json.load(file)",
        "        task = parameters = json.load(file)",
    ],
];

/// The line of docs/your-own-code.md with which a code refuses features that it does not have.
fn refusing_line() -> String {
    let page = fs::read_to_string(project().join("docs/your-own-code.md")).expect("a page");
    let mut lines = page.lines();
    let line = lines.find(|line| line.contains("task[\"features\"]"));
    line.expect("it is there").to_owned()
}

/// What `mydem.py` of the bench writes for a micro-test.
fn motion(bench: &Bench) -> Vec<u8> {
    let folder = bench.path("mydem");
    let task = witness_test(ContactConvention::TURNING).all_parameters();
    let content = ParameterFormat::Json.content(&task);
    fs::write(folder.join("task.json"), content).expect("a task");
    let mut command = Command::new("python3");
    let status = command.arg("mydem.py").current_dir(&folder).status();
    assert!(status.expect("it runs").success());
    let motion = fs::read(folder.join("result.csv")).expect("a motion");
    for file in ["task.json", "result.csv"] {
        fs::remove_file(folder.join(file)).expect("it is removed");
    }
    motion
}

/// The series of a stack by the code of the bench, if there is one, and what is said.
fn series(bench: &Bench) -> (Option<Vec<u8>>, String) {
    let line = "simulate --code ./mydem --mu 0.3 --stiffness 100 --speed 1e-3 --out out";
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    (fs::read(bench.path("out/series.csv")).ok(), message)
}

/// A copy that takes every body from `bodies` is the example, bit for bit; one without friction refuses the task.
#[test]
fn a_code_may_take_each_body_from_the_list_and_refuse_features() {
    let load = "        task = parameters = json.load(file)";
    let copy = |line: String| {
        let loading = format!("{load}\n    {line}");
        let further = [[load, loading.as_str()]];
        changed(FROM_BODIES.into_iter().chain(further))
    };
    let line = refusing_line();
    let (example, own) = (changed([].into_iter()), copy(line.clone()));
    assert!(motion(&own) == motion(&example), "the motions differ");
    let ((found, message), (expected, _)) = (series(&own), series(&example));
    assert!(found.is_some(), "{message}");
    assert!(found == expected, "the series differ");
    let without_friction = copy(line.replace("{\"friction\"}", "set()"));
    let (found, message) = series(&without_friction);
    assert_eq!(found, None);
    let expected = "features: {'friction'} are not in this code";
    assert!(message.contains(expected), "{message}");
}
