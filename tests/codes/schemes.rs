//! Codes whose scheme is not that of the example, but converges: copies of the Python example.

use crate::common::{Bench, code_folder, json_rows};
use serde::Deserialize;
use serde_json::Value;
use std::fs;
use std::process::Command;

/// Numbers of the copies in schemes.toml.
const TEXTBOOK_VERLET: usize = 0;
const STEPS_INSIDE: usize = 1;
const EULER: usize = 2;
const LATE: usize = 3;
const RUNGE_KUTTA: usize = 4;
const ADAPTIVE: usize = 5;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Scheme {
    name: String,
    /// What is replaced in mydem.py, and by what.
    change: Vec<[String; 2]>,
    /// Words with which `check` names it.
    words: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Schemes {
    scheme: Vec<Scheme>,
}

fn scheme(index: usize) -> Scheme {
    let schemes: Schemes = toml::from_str(include_str!("schemes.toml")).expect("a table");
    schemes.scheme.into_iter().nth(index).expect("a scheme")
}

/// A bench with the scheme as `mydem`, after further changes, and without a declared convention.
fn bench(scheme: &Scheme, further: &[[&str; 2]]) -> Bench {
    let own = scheme.change.iter().map(|[from, to]| [from.as_str(), to]);
    changed(own.chain(further.iter().copied()))
}

/// A bench with a copy of the Python example as `mydem`, in whose script these changes are made and whose manifest declares
/// no convention.
pub fn changed<'a>(changes: impl Iterator<Item = [&'a str; 2]>) -> Bench {
    let bench = Bench::with_system_programs();
    let undeclared = |manifest: String| {
        let convention = manifest.find("[convention]").expect("a convention");
        manifest[..convention].to_owned() + "[convention]\n"
    };
    let folder = code_folder("examples/python", &bench.path("mydem"), undeclared);
    let script = folder.join("mydem.py");
    let mut text = fs::read_to_string(&script).expect("a script");
    for [from, to] in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    fs::write(script, text).expect("it can be written");
    bench
}

/// Exit status, rows and messages of a command with the code.
pub fn rows(bench: &Bench, line: &str) -> (i32, Vec<Value>, String) {
    let output = bench.tristack(line).output().expect("it runs");
    let status = output.status.code().expect("it ends by itself");
    let [text, messages] = [output.stdout, output.stderr].map(|text| {
        let text = String::from_utf8(text);
        text.expect("text")
    });
    (status, json_rows(&text), messages)
}

pub const CROSSCHECK: &str = "crosscheck --codes ./mydem --mu 0.3 --stiffness 100 --format json";

/// The only row agrees, and the notes on it name what vanishes with the time step.
fn agrees(index: usize, remark: &str) {
    let scheme = scheme(index);
    let (status, rows, notes) = rows(&bench(&scheme, &[]), CROSSCHECK);
    assert_eq!((status, rows.len()), (0, 1), "{}: {notes}", scheme.name);
    assert_eq!(rows[0]["verdict"], "agrees");
    assert!(notes.contains(remark), "{notes}");
}

#[test]
fn textbook_verlet_agrees_with_a_remark() {
    agrees(TEXTBOOK_VERLET, "(order 1)");
}

#[test]
fn steps_inside_steps_agree_with_a_remark() {
    agrees(STEPS_INSIDE, "(order 1)");
}

#[test]
fn explicit_euler_agrees_although_the_stack_rings_longer() {
    agrees(EULER, "take damping away, so that the stack rings longer");
}

#[test]
fn forces_of_the_step_before_agree_and_are_named() {
    agrees(LATE, "those of 1.000 steps before the positions");
}

#[test]
fn runge_and_kuttas_scheme_agrees_with_a_remark() {
    agrees(RUNGE_KUTTA, "(order 1)");
}

#[test]
fn a_mistake_of_a_ten_thousandth_is_found_beside_errors_of_first_order() {
    let stiffer = [
        "task[\"tangential_stiffness\"]",
        "1.0001 * task[\"tangential_stiffness\"]",
    ];
    let (status, rows, notes) = rows(&bench(&scheme(TEXTBOOK_VERLET), &[stiffer]), CROSSCHECK);
    assert_eq!((status, rows.len()), (2, 1), "{notes}");
    assert!(notes.contains("tangential_stiffness is 2.0002"), "{notes}");
}

/// What it measures is not smooth in the time step, and known to some 1e-5 of the load alone.
#[test]
fn steps_that_depend_on_the_motion_agree_within_an_accepted_resolution() {
    let bench = bench(&scheme(ADAPTIVE), &[]);
    let (status, judged, notes) = rows(&bench, CROSSCHECK);
    assert_eq!((status, judged.len()), (4, 1), "{notes}");
    assert_eq!(judged[0]["verdict"], "inconclusive");
    assert!(notes.contains("too coarse: "), "{notes}");
    assert!(
        notes.contains("unless `--resolution` accepts more"),
        "{notes}"
    );
    assert!(!notes.contains("contradicts"), "{notes}");
    let accepting = format!("{CROSSCHECK} --resolution 1e-4");
    let (status, judged, notes) = rows(&bench, &accepting);
    assert_eq!((status, judged.len()), (0, 1), "{notes}");
    assert_eq!(judged[0]["verdict"], "agrees");
}

/// `check` names the schemes in remarks alone.
#[test]
fn check_names_schemes_in_remarks_alone() {
    for index in [TEXTBOOK_VERLET, EULER, LATE, RUNGE_KUTTA, ADAPTIVE] {
        let scheme = scheme(index);
        let (status, items, _) = rows(&bench(&scheme, &[]), "check ./mydem --format json");
        assert_eq!(status, 0, "{}: {items:#?}", scheme.name);
        let texts = items
            .iter()
            .map(|item| format!("{} {}", item["found"], item["causes"]));
        let told: String = texts.collect();
        for word in &scheme.words {
            assert!(told.contains(word.as_str()), "{}: {items:#?}", scheme.name);
        }
    }
}

/// Plans `stacks` of the code in the directory `away` and starts what is planned, as long as runs follow from results.
pub fn make_elsewhere(bench: &Bench, stacks: &str) {
    let plan = format!("plan --codes ./mydem {stacks} --out away");
    // Two rounds at each time step, before and after the runs of the stack.
    let mut rounds = 0..24;
    let is_whole = rounds.any(|_| {
        let output = bench.tristack(&plan).output().expect("it runs");
        let told = String::from_utf8(output.stdout).expect("text");
        let is_whole = told.contains("to do: 0 runs");
        if !is_whole {
            let mut started = Command::new("sh");
            started.arg("start.txt").current_dir(bench.path("away"));
            started.output().expect("it runs");
        }
        is_whole
    });
    assert!(is_whole);
}

/// The micro-tests with shorter steps are planned too, and those that the first ones share with them are not waited for.
#[test]
fn a_scheme_that_converges_is_judged_by_files_alone() {
    let bench = bench(&scheme(TEXTBOOK_VERLET), &[]);
    make_elsewhere(&bench, "--mu 0.3 --stiffness 100");
    let (status, judged, messages) = rows(&bench, "judge away --format json");
    assert_eq!((status, judged.len()), (0, 1), "{messages}");
    assert_eq!(judged[0]["verdict"], "agrees", "{messages}");
}
