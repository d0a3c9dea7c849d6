//! The parameters that the decks of the external codes receive, and the choice of the deck.

use insta::assert_snapshot;
use proptest::prelude::*;
use proptest::sample::select;
use tristack::code::{Code, ParameterFormat, SettledCode, Task, TaskKind};
use tristack::model::{
    Case, ContactConvention, ContactTest, InitialMotion, Power, Preparation, Protocol, Pyramid,
    Sampling, SideWalls, Stack,
};
use tristack::study::preparation::plan_preparation;
use tristack::study::yield_force::plan;

fn named(name: &str) -> Code {
    Code::named(name).expect("it is built in")
}

fn settled(name: &str) -> SettledCode {
    let settled = named(name).as_declared();
    settled.expect("nothing is left out")
}

fn parameters() -> serde_json::Value {
    let convention = named("yade").declaration().convention;
    let cases = plan(&settled("yade"), &Stack::paper(0.3, 1e2), convention).cases;
    cases[1].parameters()
}

#[test]
fn yade_is_told_in_json() {
    assert_snapshot!(ParameterFormat::Json.content(&parameters()));
}

#[test]
fn lammps_and_liggghts_are_told_in_string_variables() {
    assert_snapshot!(ParameterFormat::LammpsVariables.content(&parameters()));
}

/// A change here means that the recorded runs have to be made again.
#[test]
fn decks_are_the_ones_that_were_recorded() {
    let hashes = ["liggghts", "yade", "lammps"].map(|name| named(name).files_hash(TaskKind::Stack));
    assert_snapshot!(hashes.join("\n"));
}

/// What a deck of LAMMPS does once the stack is prepared, without comments.
fn after_preparation(deck: &str) -> Vec<String> {
    let (_, after) = deck.split_once("# ---- (c)").expect("a compression");
    let lines = after.lines().skip(1);
    let code = lines.map(|line| line.split('#').next().unwrap_or_default().trim().to_owned());
    code.filter(|line| !line.is_empty()).collect()
}

/// The start of every run computes forces with another velocity than the step before, which a rescaled spring remembers.
#[test]
fn lammps_prepares_hertz_contacts_and_spheres_in_one_run() {
    let linear = include_str!("../../lammps_inputs/stack.in");
    let hertz = include_str!("../../lammps_inputs/hertz/stack.in");
    let spheres = include_str!("../../lammps_inputs/spheres.in");
    for deck in [hertz, spheres] {
        let runs = deck.lines().filter(|line| line.starts_with("run "));
        assert_eq!(
            runs.map(|line| line.split_whitespace().last())
                .collect::<Vec<_>>(),
            [Some("${prepared}"), Some("${compression_steps}")]
        );
    }
    // The rest of the deck is that of linear springs, whose recorded runs keep it as it is.
    let mut own = after_preparation(hertz);
    assert_eq!(
        own.remove(0),
        "fix             gravity all gravity ${gravity} vector 0 -1 0"
    );
    assert_eq!(own, after_preparation(linear));
}

/// The examples beside the decks name every parameter that the program would give.
#[test]
fn examples_for_running_by_hand_are_complete() {
    let given = names_in_json(&ParameterFormat::Json.content(&parameters()));
    let json = include_str!("../../yade_scripts/parameters.json");
    assert_eq!(names_in_json(json), given);
    for example in [
        include_str!("../../liggghts_inputs/parameters.in"),
        include_str!("../../lammps_inputs/parameters.in"),
    ] {
        assert_eq!(names_of_variables(example), given);
    }
}

/// The same for the preparation between side walls.
#[test]
fn examples_of_side_walls_are_complete() {
    let stack = Stack::paper(0.2, 1e2);
    let plan = plan_preparation(&settled("yade"), &settled("yade"), &stack, Some(0.005));
    let parameters = plan.cases()[1].parameters();
    let given = names_in_json(&ParameterFormat::Json.content(&parameters));
    let json = include_str!("../../yade_scripts/side_walls_parameters.json");
    let variables = include_str!("../../liggghts_inputs/side_walls_parameters.in");
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

/// Numbers that a valid case can be made of, as far as they go.
fn cases() -> impl Strategy<Value = Case> {
    let stack = (1e-6..1e3, 1e-6..1e3, 0.0..8.0, -3.0..6.0).prop_map(
        |(floor_friction, cylinder_friction, stiffness, ratio): (f64, f64, f64, f64)| Stack {
            cylinder_friction,
            stiffness_ratio: 10f64.powf(ratio),
            ..Stack::paper(floor_friction, 10f64.powf(stiffness))
        },
    );
    let speeds = (-9.0..-2.0, 1e-3..1.0, 0.0..1.0, prop::option::of(0.0..0.5));
    (
        stack,
        speeds,
        1e-3..1.0,
        select(Code::with_power(Power::Linear)),
    )
        .prop_map(|(stack, (speed, step, fine, push), restitution, code)| {
            let wall_travel: f64 = 0.5;
            let wall_speed = 10f64.powf(speed);
            let preparation = match push {
                Some(push) => Preparation::SideWalls(SideWalls::paper(push, stack.epsilon())),
                None => Preparation::GravityRamp {
                    ramp_time: 100.0 * step,
                    rest_time: 1e4,
                },
            };
            Case {
                stack,
                convention: ContactConvention {
                    restitution,
                    ..code.declaration().convention
                },
                protocol: Protocol {
                    preparation,
                    time_step: step * stack.longest_time_step(&code.declaration().convention),
                    wall_speed,
                    wall_travel,
                    sampling: Sampling {
                        coarse_interval: wall_travel / wall_speed / 60.0,
                        fine_from_travel: fine * wall_travel,
                        fine_interval: wall_travel / wall_speed / 1e3,
                    },
                    shortcuts: None,
                },
            }
        })
}

fn is_name(word: &str) -> bool {
    let plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_';
    word.starts_with(|first: char| first.is_ascii_lowercase()) && word.bytes().all(plain)
}

/// Digits, sign, point and exponent, and nothing that a deck could take for something else.
fn is_plain_number(word: &str) -> bool {
    let allowed = |byte: u8| byte.is_ascii_digit() || b"+-.e".contains(&byte);
    word.bytes().all(allowed) && word.parse::<f64>().is_ok_and(f64::is_finite)
}

/// Nothing but names that the program chose, and plain numbers, in either format.
fn is_typed(parameters: &serde_json::Value) -> bool {
    let json: serde_json::Value =
        serde_json::from_str(&ParameterFormat::Json.content(parameters)).expect("JSON");
    let mut named = json.as_object().expect("an object").iter();
    let variables = ParameterFormat::LammpsVariables.content(parameters);
    let typed = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        ["variable", name, "string", number] => is_name(name) && is_plain_number(number),
        _ => false,
    };
    named.all(|(name, value)| is_name(name) && is_plain_number(&value.to_string()))
        && variables.lines().all(typed)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, max_global_rejects: 10_000, ..ProptestConfig::with_cases(500) })]

    #[test]
    fn parameters_of_every_valid_case_are_plain_numbers(case in cases()) {
        prop_assume!(case.validate().is_ok());
        prop_assert!(is_typed(&case.parameters()));
    }

    #[test]
    fn parameters_of_every_pyramid_are_plain_numbers(rows in 1u32..20, case in cases()) {
        let pyramid = Pyramid::touching(rows, case.stack.stiffness, case.convention);
        prop_assert!(is_typed(&pyramid.parameters()));
        for (name, content) in pyramid.files() {
            prop_assert_eq!(name, "cylinders.data");
            const WORDS: [&str; 12] = [
                "atoms", "atom", "types", "xlo", "xhi", "ylo", "yhi", "zlo", "zhi", "Atoms", "", "\n",
            ];
            // The first line is a title.
            let mut words = content.lines().skip(1).flat_map(str::split_whitespace);
            prop_assert!(words.all(|word| WORDS.contains(&word) || is_plain_number(word)));
        }
    }

    #[test]
    fn parameters_of_every_micro_test_are_plain_numbers(x in -1e3..1e3f64, spin in -1e3..1e3f64, steps in 0u64..1000) {
        let test = ContactTest {
            convention: ContactConvention::TURNING,
            stiffness_ratio: 2.5,
            floor_friction: 0.3,
            cylinder_friction: 0.7,
            time_step: 0.1,
            steps,
            wall_height: x.abs() + 3.0,
            wall_speed: 0.0,
            initial_motions: [InitialMotion { spin, ..InitialMotion::at(x, 1.0) }, InitialMotion::at(x + 3.0, 1.0)],
            drive: None,
            space: None,
        };
        prop_assert!(is_typed(&test.parameters()));
    }
}

#[test]
fn text_in_a_parameter_file_would_be_noticed() {
    for value in ["\"1; shell ls\"", "null", "true", "[1]", "\"1\""] {
        let value: serde_json::Value = serde_json::from_str(value).expect("JSON");
        assert!(
            !is_typed(&serde_json::json!({ "gravity": value })),
            "{value}"
        );
    }
    assert!(!is_typed(
        &serde_json::json!({ "gravity string 1\nshell": 1.0 })
    ));
    assert!(is_typed(
        &serde_json::json!({ "gravity": 1e-300, "steps": 3 })
    ));
}
