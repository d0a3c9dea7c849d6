//! The JSON Schemas of `tristack schema`, and real documents that are held to them.

mod validator;

use crate::common::{Bench, json, records, standard_output};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use tristack::code::{SettledCode, Task, witness_test};
use tristack::dem::{compress_stack, run_contact_test};
use tristack::model::{Case, ContactConvention, Law, Preparation, Pyramid, SideWalls, Stack};
use tristack::study::yield_force::plan;
use validator::{unknown_keywords, violation};

const DOCUMENTS: [&str; 7] = [
    "task",
    "case",
    "given-case",
    "manifest",
    "passport",
    "result",
    "rows",
];

fn schema(document: &str) -> Value {
    let bench = Bench::without_codes();
    json(&standard_output(
        &mut bench.tristack(&format!("schema {document}")),
    ))
}

fn fits(schema: &Value, document: &Value) {
    assert_eq!(violation(schema, document), None);
}

fn fits_not(schema: &Value, document: &Value, part: &str) {
    let violation = violation(schema, document).expect("it is refused");
    assert!(violation.contains(part), "{violation}");
}

#[test]
fn every_schema_is_of_2020_12_and_uses_no_keyword_that_is_not_checked_here() {
    for document in DOCUMENTS {
        let schema = schema(document);
        assert_eq!(
            schema["$schema"],
            "https://json-schema.org/draft/2020-12/schema"
        );
        let version = if document == "task" { 2 } else { 1 };
        assert_eq!(schema["$id"], format!("urn:tristack:{document}:{version}"));
        assert_eq!(
            unknown_keywords(&schema),
            Vec::<String>::new(),
            "{document}"
        );
    }
}

#[test]
fn all_schemas_in_one_are_those_of_each() {
    let all = schema("");
    let names: Vec<&String> = all["$defs"].as_object().expect("schemas").keys().collect();
    assert_eq!(names.len(), DOCUMENTS.len());
    for document in DOCUMENTS {
        assert_eq!(all["$defs"][document], schema(document));
    }
}

/// The folders of codes that come with the project.
fn folders() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let built_in = ["liggghts_inputs", "yade_scripts", "lammps_inputs"];
    let built_in = built_in.map(|folder| root.join(folder));
    let examples = std::fs::read_dir(root.join("examples"))
        .into_iter()
        .flatten()
        .flatten();
    let examples = examples.map(|entry| entry.path());
    let all = built_in.into_iter().chain(examples);
    all.filter(|folder| folder.join("code.toml").exists())
        .collect()
}

fn manifest(folder: &Path) -> Value {
    let path = folder.join("code.toml");
    let text = std::fs::read_to_string(path).expect("a manifest");
    serde_json::to_value(text.parse::<toml::Table>().expect("TOML")).expect("plain values")
}

#[test]
fn manifests_fit_theirs_and_mistakes_do_not() {
    let schema = schema("manifest");
    for folder in folders() {
        let manifest = manifest(&folder);
        fits(&schema, &manifest);
        let changed = |change: &dyn Fn(&mut Value)| {
            let mut changed = manifest.clone();
            change(&mut changed);
            changed
        };
        let misspelt = changed(&|manifest| manifest["program"]["comand"] = json!([]));
        fits_not(&schema, &misspelt, "comand");
        let mistyped = changed(&|manifest| manifest["seconds"] = json!({ "start": "1" }));
        fits_not(&schema, &mistyped, "start");
        let word = changed(&|manifest| manifest["parameters"] = json!({ "format": "yaml" }));
        fits_not(&schema, &word, "format");
        let missing = changed(&|manifest| {
            manifest.as_object_mut().expect("keys").remove("name");
        });
        fits_not(&schema, &missing, "name");
        let variant = changed(&|manifest| manifest["variants"] = json!({ "x": { "sett": {} } }));
        fits_not(&schema, &variant, "sett");
    }
}

fn case() -> Case {
    plan(
        &SettledCode::native(),
        &Stack::paper(0.3, 1e2),
        ContactConvention::TURNING,
    )
    .cases[0]
}

fn between_walls() -> Case {
    let mut case = case();
    case.protocol.preparation = Preparation::SideWalls(SideWalls::paper(0.005, 0.01));
    case
}

#[test]
fn tasks_fit_theirs_and_every_parameter_has_unit_and_meaning() {
    let schema = schema("task");
    let tasks = |convention: ContactConvention| {
        let of_case = |case: Case| Case { convention, ..case }.all_parameters();
        let stiffness_ratio = Stack::usual_stiffness_ratio(convention.law.power);
        let [mut whole, mut walls, mut rigid] = [case(), between_walls(), case()];
        rigid.protocol.preparation = Preparation::Rigid;
        whole.stack.stiffness_ratio = stiffness_ratio;
        walls.stack.stiffness_ratio = stiffness_ratio;
        rigid.stack.stiffness_ratio = stiffness_ratio;
        let mut pyramid = Pyramid::touching(3, 1e2, convention);
        pyramid.groups.stiffness_ratio = stiffness_ratio;
        let mut test = witness_test(convention);
        test.stiffness_ratio = stiffness_ratio;
        [
            ("stack", of_case(whole)),
            ("side-walls", of_case(walls)),
            ("rigid", of_case(rigid)),
            ("motion", test.all_parameters()),
            ("pyramid", pyramid.all_parameters()),
        ]
    };
    let linear = tasks(ContactConvention::TURNING).into_iter();
    let others = tasks(ContactConvention::with_law(Law::HERTZ));
    for ((kind, task), (_, other)) in linear.zip(others) {
        fits(&schema, &task);
        fits(&schema, &other);
        let own = &schema["$defs"][kind];
        let declared = &own["properties"];
        let names = |value: &Value| -> Vec<String> {
            let keys = value.as_object().expect("keys").keys();
            keys.cloned().collect()
        };
        // Laws other than the paper's have further parameters.
        assert_eq!(names(declared), names(&other), "{kind}");
        let required = own["required"].as_array().expect("names").iter();
        let mut required: Vec<&str> = required.filter_map(Value::as_str).collect();
        required.sort_unstable();
        assert_eq!(required, names(&task), "{kind}");
        let described = |own: &Value, keys: &[&str]| {
            for key in keys {
                assert!(own[key].is_string(), "{kind}: {own} has no {key}");
            }
        };
        for parameter in declared.as_object().expect("parameters").values() {
            if parameter["type"] == "number" {
                described(parameter, &["x-unit", "description"]);
                continue;
            }
            assert_eq!(parameter["type"], "array", "{kind}");
            described(parameter, &["description"]);
            let numbers = parameter["items"]["properties"].as_object();
            for number in numbers.into_iter().flat_map(|own| own.values()) {
                described(number, &["x-unit", "description"]);
            }
        }
        let mut less = task.clone();
        less.as_object_mut().expect("keys").remove("time_step");
        fits_not(&schema, &less, "time_step");
        assert_eq!(task["features"], json!(["friction"]), "{kind}");
        let mut other = task.clone();
        other["features"][0] = json!("flying");
        fits_not(&schema, &other, "features/0");
        let Some(bodies) = task["bodies"].as_array() else {
            assert_eq!(kind, "pyramid");
            continue;
        };
        assert_eq!(bodies.len(), if kind == "motion" { 2 } else { 3 }, "{kind}");
        other = task;
        other["bodies"][1] = json!({ "radius": 1.0, "mass": "heavy", "moment_of_inertia": 0.5 });
        fits_not(&schema, &other, "bodies/1/mass");
        other["bodies"][1] = json!({ "radius": 1.0, "mass": 1.0 });
        fits_not(&schema, &other, "moment_of_inertia");
    }
}

#[test]
fn rows_of_results_fit_theirs() {
    let schema = schema("result");
    let series = compress_stack(&case(), || true).expect("a finite series");
    let motion = run_contact_test(&witness_test(ContactConvention::TURNING)).expect("a motion");
    let [row, step] = [series.to_csv(), motion.to_csv()].map(|csv| json!(records(&csv)[0]));
    fits(&schema, &row);
    fits(&schema, &step);
    let mut less = row;
    less.as_object_mut().expect("columns").remove("wall_force");
    fits_not(&schema, &less, "wall_force");
}

#[test]
fn tables_fit_theirs() {
    let bench = Bench::without_codes();
    let schema = schema("rows");
    for line in [
        "theory --mu 0.05,0.3,0.5 --stiffness 1e2 --format json",
        "regimes --kappa 2.5 --format json",
        "codes --format json",
        "simulate --code native --mu 0.3 --stiffness 1e2 --speed 1e-3 --format json",
        "sweep --code native --mu 0.3 --stiffness 1e2 --format json",
        "predict --youngs 1MPa --density 1000kg/m3 --radius 1cm --length 1cm --mu 0.3 --format json",
    ] {
        let output = bench.tristack(line).output().expect("it runs");
        let text = String::from_utf8(output.stdout).expect("text");
        let table = json(&text);
        fits(&schema, &table);
        let mut other = table.clone();
        other["schema"] = json!("tristack/unknown/1");
        fits_not(&schema, &other, "schema");
    }
}

#[test]
fn a_passport_fits_its_own() {
    let bench = Bench::without_codes();
    standard_output(&mut bench.tristack("probe --codes native --out passports"));
    let text = std::fs::read_to_string(bench.path("passports/native.json")).expect("a passport");
    let (schema, passport) = (schema("passport"), json(&text));
    fits(&schema, &passport);
    let mut other = passport.clone();
    other["verdict"] = json!("fine");
    fits_not(&schema, &other, "verdict");
    other = passport;
    other["convention"]["rows"][0]["moves_limit"] = json!("yes");
    fits_not(&schema, &other, "moves_limit");
}

#[test]
fn cases_fit_theirs_whether_whole_or_partial() {
    let schema = schema("case");
    let value = |text: &str| {
        let table = text.parse::<toml::Table>().expect("TOML");
        serde_json::to_value(table).expect("plain values")
    };
    let bench = Bench::without_codes();
    let example = standard_output(&mut bench.tristack("simulate --example"));
    for case in [case().to_json(), between_walls().to_json()] {
        fits(&schema, &json(&case));
    }
    for text in [
        example.as_str(),
        "[stack]\nmu = 0.3",
        "[stack]\nmu = 0.3\n[convention.law]\npower = 1.5",
        "[stack]\nfloor_friction = 0.3\nkappa = 1.5\n[protocol.preparation]\nkind = \"side-walls\"\npush = 0.01",
    ] {
        fits(&schema, &value(text));
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/cases");
    for entry in std::fs::read_dir(&folder).expect("the folder").flatten() {
        if entry
            .path()
            .extension()
            .is_some_and(|ending| ending == "toml")
        {
            let text = std::fs::read_to_string(entry.path()).expect("a case");
            fits(&schema, &value(&text));
        }
    }
    let given = std::fs::read_to_string(folder.join("given/authors.toml")).expect("a case");
    let given_schema = self::schema("given-case");
    fits(&given_schema, &value(&given));
    for (from, to, part) in [
        ("[start]", "[started]", "start"),
        ("wall_speed", "wall_speeds", "wall_speed"),
    ] {
        fits_not(&given_schema, &value(&given.replace(from, to)), part);
    }
    for (text, part) in [
        ("[stack]\nstiffness = 100.0", "stack"),
        ("[stack]\nmu = 0.3\nmud = 0.3", "mud"),
        (
            "[stack]\nmu = 0.3\n[convention]\ncoulomb_operand = \"both\"",
            "coulomb_operand",
        ),
        ("[stack]\nmu = 0.3\n[protocol.sampling]\nfine = 1.0", "fine"),
    ] {
        fits_not(&schema, &value(text), part);
    }
}
