//! Codes with rigid bodies: the example, copies of it with mistakes, and MigFlow where it is installed.

use crate::common::{Bench, code_folder, installed_in_folder, project};
use crate::schemes::rows;
use rayon::prelude::*;
use std::fs;
use tristack::code::Code;
use tristack::model::Stack;
use tristack::theory::rigid_limit;

const EXAMPLE: &str = "examples/contact-dynamics";
const SCRIPT: &str = "contact_dynamics.py";
const MIGFLOW: &str = "examples/migflow";
const SICONOS: &str = "examples/siconos";

/// A bench with the example as `rigid`, after some replacements in its script, and its manifest changed.
fn bench(change: &[[&str; 2]], manifest: impl FnOnce(String) -> String) -> Bench {
    let bench = Bench::with_system_programs();
    let folder = code_folder(EXAMPLE, &bench.path("rigid"), manifest);
    let script = folder.join(SCRIPT);
    let mut text = fs::read_to_string(&script).expect("a script");
    for [from, to] in change {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    fs::write(script, text).expect("it can be written");
    bench
}

fn changed(change: &[[&str; 2]]) -> Bench {
    bench(change, |text| text)
}

fn unchanged() -> Bench {
    changed(&[])
}

#[test]
fn rigid_bodies_give_way_at_the_exact_force_or_jam() {
    let bench = unchanged();
    // The stiffness is no question, so that it may be left out, and makes no row of its own.
    for stiffnesses in ["", "--stiffness 100,1000"] {
        let line =
            format!("crosscheck --codes ./rigid --mu 0.1,0.2,0.3 {stiffnesses} --format json");
        let (status, judged, messages) = rows(&bench, &line);
        assert_eq!((status, judged.len()), (0, 3), "{messages}");
        for row in &judged {
            let mu = row["mu"].as_f64().expect("a friction");
            let limit = rigid_limit(&Stack::paper(mu, 1.0)).yield_force;
            assert_eq!(row["reference_force"].as_f64(), limit, "{row}");
            assert!(
                row["stiffness"].is_null() && row["pair_torque_arm"].is_null(),
                "{row}"
            );
            let verdict = if limit.is_some() {
                "agrees"
            } else {
                "no-yield"
            };
            assert_eq!(row["verdict"], verdict, "{messages}");
            if limit.is_some() {
                assert!(
                    row["error"].as_f64().expect("an error").abs() < 1e-6,
                    "{row}"
                );
            }
        }
        assert!(
            messages.contains("jam from the floor friction 0.267949"),
            "{messages}"
        );
    }
    let (status, items, messages) = rows(&bench, "check ./rigid --format json");
    assert_eq!(status, 0, "{messages}");
    assert!(
        items.iter().all(|item| item["outcome"] == "passed"),
        "{items:#?}"
    );
    assert!(items.len() >= 12, "{items:#?}");
}

/// Mistakes, with the item of a check that fails first and words in it, and the verdict of a crosscheck at mu = 0.2.
const MISTAKES: [(&str, &str, &str, &str, &str); 10] = [
    (
        "task[\"floor_friction\"], (0.0, 1.0)",
        "1.001 * task[\"floor_friction\"], (0.0, 1.0)",
        "friction of the floor",
        "0.200200",
        "differs",
    ),
    (
        "Contact(*two, task[\"cylinder_friction\"])",
        "Contact(*two, task[\"floor_friction\"])",
        "force while it slides",
        "falls under its own weight",
        "differs",
    ),
    (
        "Contact(*two, task[\"cylinder_friction\"])",
        "Contact(*two, 0.7)",
        "friction between cylinders",
        "`cylinder_friction` is not that between cylinders",
        "agrees",
    ),
    (
        "1.0 / body[\"moment_of_inertia\"])",
        "1.0 / 0.4)",
        "fall under its own weight",
        "moment of inertia",
        "agrees",
    ),
    (
        "for body in bodies:\n                body.vy -=",
        "for body in bodies[1:]:\n                body.vy -=",
        "balance of forces",
        "gravity does not act on all",
        "differs",
    ),
    (
        "press.normal / dt",
        "press.normal",
        "balance of forces",
        "not divided by the time step",
        "differs",
    ),
    (
        "body.spin -= RADIUS * tangential",
        "body.spin -= 0.9 * RADIUS * tangential",
        "fall under its own weight",
        "moment of inertia",
        "agrees",
    ),
    (
        "self.nx * vy - self.ny * vx - RADIUS *",
        "self.nx * vy - self.ny * vx - 0.9 * RADIUS *",
        "rolling",
        "another radius",
        "differs",
    ),
    (
        "x1,y1,theta1,x2,y2,theta2",
        "x1,y1,theta2,x2,y2,theta1",
        "rolling",
        "",
        "differs",
    ),
    (
        "            else:  # nobody waits for a jam twice",
        "            else:\n                sweeps = 40\n            if sweeps < 40:",
        "jam",
        "give way elastically",
        "agrees",
    ),
];

#[test]
fn mistakes_of_rigid_codes_are_told() {
    let surprises = MISTAKES
        .par_iter()
        .filter_map(|(from, to, failing, word, verdict)| {
            let bench = changed(&[[from, to]]);
            let (status, items, messages) = rows(&bench, "check ./rigid --format json");
            let mut failed = items.iter().filter(|item| item["outcome"] == "failed");
            let first = failed.next();
            let told =
                first.map(|item| format!("{}: {} {}", item["item"], item["found"], item["causes"]));
            let told = told.unwrap_or_default();
            let is_told = status == 2 && told.contains(failing) && told.contains(word);
            let line = "crosscheck --codes ./rigid --mu 0.2 --format json";
            let (_, judged, judging) = rows(&bench, line);
            let is_judged = judged.len() == 1 && judged[0]["verdict"] == *verdict;
            (!is_told || !is_judged)
                .then(|| format!("{to}: {status} {told} {messages} {judged:?} {judging}"))
        });
    let surprises: Vec<String> = surprises.collect();
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

/// What has been tried with another command says that springs are missing, and in which file.
#[test]
fn commands_for_springs_refuse_rigid_codes() {
    let bench = unchanged();
    for line in [
        "simulate --code ./rigid --mu 0.2 --stiffness 100",
        "sweep --code ./rigid --mu 0.2 --stiffness 100",
        "trajectories --codes ./rigid",
        "plan --code ./rigid --mu 0.2 --stiffness 100 --out away",
        "crosscheck --explain ./rigid/0.2/100",
        "crosscheck --bodies 3 --codes ./rigid",
        "probe --codes ./rigid",
        "impacts --codes ./rigid",
    ] {
        let output = bench.tristack(line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(message.contains("rigid"), "{line}: {message}");
        assert!(!message.contains("panicked"), "{line}: {message}");
        assert!(!output.status.success(), "{line}");
    }
}

#[test]
fn manifests_of_rigid_codes_have_one_task_and_no_convention() {
    for (from, to, words) in [
        (
            "contact = \"rigid\"",
            "contact = \"stiff\"",
            ["stiff", "rigid"],
        ),
        (
            "[tasks]",
            "[convention]\nmoment_of_inertia = 0.4\n[tasks]",
            ["convention", "no springs"],
        ),
        (
            "stack = { files = [\"contact_dynamics.py\"] }",
            "stack = { files = [\"contact_dynamics.py\"] }\nmotion = { files = [\"contact_dynamics.py\"] }",
            ["motion", "[tasks.stack] alone"],
        ),
    ] {
        let bench = bench(&[], |text| text.replace(from, to));
        let (status, items, messages) = rows(&bench, "check ./rigid --format json");
        assert_eq!(status, 1, "{messages}");
        let found = items[0]["found"].as_str().expect("a reason");
        assert!(words.iter().all(|word| found.contains(word)), "{found}");
        assert!(found.contains("code.toml"), "{found}");
    }
}

/// The rows of codes with rigid bodies that were recorded are judged by the limit of today.
#[test]
fn recorded_rows_of_rigid_codes_have_the_limit_of_today() {
    for (folder, name) in [
        (EXAMPLE, "contact-dynamics"),
        (MIGFLOW, "migflow"),
        (SICONOS, "siconos"),
    ] {
        let path = project().join(folder);
        let code = Code::in_folder(&path, None).expect("a folder in order");
        assert!(code.is_rigid() && code.as_str() == name);
        let mut reader =
            csv::Reader::from_path(path.join("crosscheck.csv")).expect("recorded rows");
        let names = reader.headers().expect("a header").clone();
        let at = |name: &str| names.iter().position(|own| own == name).expect("a column");
        let mut frictions = 0;
        for row in reader.records() {
            let row = row.expect("a row");
            let number = |name: &str| row[at(name)].parse::<f64>().ok();
            let stack = Stack::paper(number("mu").expect("a friction"), 1.0);
            let limit = rigid_limit(&stack).yield_force;
            assert_eq!(number("reference_force"), limit, "{row:?}");
            let verdict = &row[at("verdict")];
            match limit {
                None => assert_eq!(verdict, "no-yield", "{row:?}"),
                Some(limit) => {
                    let error = number("yield_force").expect("a force") - limit;
                    assert!(
                        error.abs() <= number("uncertainty").expect("a number"),
                        "{row:?}"
                    );
                    assert_ne!(verdict, "differs", "{row:?}");
                }
            }
            frictions += 1;
        }
        assert_eq!(frictions, 6, "those of the quick profile");
    }
}

/// Two rows of a code that does not come with tristack, and a jam.
fn agrees_where_it_is_installed(example: &str) {
    let installed = installed_in_folder(example).and_then(|code| code.find());
    // Python may be there without the package, and then does not say its version.
    if installed.is_none_or(|found| found.identity().version == "unknown") {
        return eprintln!("the code of {example} is not installed: its live test is skipped");
    }
    let bench = Bench::with_system_programs();
    let folder = project().join(example);
    let line = format!(
        "crosscheck --codes {} --mu 0.1,0.2,0.3 --format json",
        folder.display()
    );
    let (status, judged, messages) = rows(&bench, &line);
    assert_eq!((status, judged.len()), (0, 3), "{messages}");
    for row in judged {
        let Some(error) = row["error"].as_f64() else {
            assert_eq!(row["verdict"], "no-yield", "{messages}");
            assert_eq!(row["mu"], 0.3);
            continue;
        };
        assert_eq!(row["verdict"], "agrees", "{messages}");
        assert!(error.abs() < 1e-5, "{row}");
    }
}

#[test]
fn migflow_agrees_where_it_is_installed() {
    agrees_where_it_is_installed(MIGFLOW);
}

#[test]
fn siconos_agrees_where_it_is_installed() {
    agrees_where_it_is_installed(SICONOS);
}
