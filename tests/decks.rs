//! What the decks of the external codes are told, and which deck it is.

use insta::assert_snapshot;
use tristack::crosscheck::{Workload, plan};
use tristack::engine::{EngineName, ParameterFile, Task};
use tristack::reproduction::plan_preparation;
use tristack::stack::Stack;

fn parameters() -> serde_json::Value {
    let convention = EngineName::Yade.convention();
    let cases = plan(EngineName::Yade, &Stack::paper(0.3, 1e2), convention).cases;
    cases[1].parameters()
}

#[test]
fn yade_is_told_in_json() {
    assert_snapshot!(ParameterFile::Json.content(&parameters()));
}

#[test]
fn lammps_and_liggghts_are_told_in_string_variables() {
    assert_snapshot!(ParameterFile::Lammps.content(&parameters()));
}

/// A change here means that the recorded runs have to be made again.
#[test]
fn decks_are_the_ones_that_were_recorded() {
    let hashes = [EngineName::Liggghts, EngineName::Yade, EngineName::Lammps]
        .map(EngineName::static_deck_hash);
    assert_snapshot!(hashes.join("\n"));
}

/// The examples beside the decks name every parameter that the program would give.
#[test]
fn examples_for_running_by_hand_are_complete() {
    let given = names_in_json(&ParameterFile::Json.content(&parameters()));
    let json = include_str!("../yade_scripts/parameters.json");
    assert_eq!(names_in_json(json), given);
    for example in [
        include_str!("../liggghts_inputs/parameters.in"),
        include_str!("../lammps_inputs/parameters.in"),
    ] {
        assert_eq!(names_of_variables(example), given);
    }
}

/// The same for the preparation between side walls.
#[test]
fn examples_of_side_walls_are_complete() {
    let stack = Stack::paper(0.2, 1e2);
    let plan = plan_preparation(EngineName::Yade, EngineName::Yade, &stack, Some(0.005));
    let parameters = plan.cases()[1].parameters();
    let given = names_in_json(&ParameterFile::Json.content(&parameters));
    let json = include_str!("../yade_scripts/side_walls_parameters.json");
    let variables = include_str!("../liggghts_inputs/side_walls_parameters.in");
    assert_eq!(names_in_json(json), given);
    assert_eq!(names_of_variables(variables), given);
}

fn names_in_json(text: &str) -> Vec<String> {
    let value: serde_json::Value = serde_json::from_str(text).expect("JSON");
    let object = value.as_object().expect("an object");
    let mut names: Vec<String> = object.keys().cloned().collect();
    names.sort();
    names
}

fn names_of_variables(text: &str) -> Vec<String> {
    let variables = text.lines().filter(|line| line.starts_with("variable"));
    let mut names: Vec<String> = variables
        .filter_map(|line| line.split_whitespace().nth(1))
        .map(str::to_owned)
        .collect();
    names.sort();
    names
}
