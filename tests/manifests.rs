//! Codes as their folders describe them.

mod common;

use common::{Bench, installed, standard_error};
use std::fs;
use std::path::{Path, PathBuf};
use tristack::code::{Code, Definition};
use tristack::study::trajectory::{Branch, Quantity, Twin, documented};

/// Every order, with its reason, that is expected of the distance between a code and its twin.
#[test]
fn documented_orders_follow_from_the_manifests() {
    let mut lines = Vec::new();
    for code in Code::all() {
        for twin in [Twin::Full, Twin::RotatedSpring] {
            for quantity in Quantity::ALL {
                for branch in Branch::ALL {
                    let found = documented(code, twin, quantity, branch);
                    lines.push(format!(
                        "{code}, {twin:?}, {quantity:?}, {branch:?}: {:?}: {}",
                        found.order, found.reason
                    ));
                }
            }
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn codes_stand_in_the_order_of_their_folders_and_names() {
    let names: Vec<&str> = Code::all().into_iter().map(Code::as_str).collect();
    let built_in = [
        "native",
        "liggghts",
        "yade",
        "yade-facet",
        "yade-wall",
        "lammps",
    ];
    assert_eq!(names, built_in);
    let labels: Vec<String> = Code::all().into_iter().map(Code::label).collect();
    let in_figures = [
        "native",
        "LIGGGHTS",
        "YADE, box",
        "YADE, facet",
        "YADE, wall",
        "LAMMPS",
    ];
    assert_eq!(labels, in_figures);
}

/// The files of a folder of the project, in `place`.
fn copy_of(folder: &str, place: &Path) -> PathBuf {
    let copy = place.join("folder");
    fs::create_dir(&copy).expect("a directory");
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    for entry in fs::read_dir(original).expect("a folder").flatten() {
        if entry.path().is_file() {
            fs::copy(entry.path(), copy.join(entry.file_name())).expect("a copy");
        }
    }
    copy
}

fn change_manifest(folder: &Path, from: &str, to: &str) {
    let manifest = folder.join("code.toml");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    assert!(text.contains(from), "{from}");
    fs::write(manifest, text.replace(from, to)).expect("it can be written");
}

/// The proof that no source knows a code: a folder under another name gives the same rows.
#[test]
fn a_folder_given_by_path_is_the_built_in_code_under_another_name() {
    let yade = Code::named("yade").expect("it is built in");
    if installed(&[yade]).is_empty() {
        return;
    }
    let place = tempfile::tempdir().expect("a directory");
    let folder = copy_of("yade_scripts", place.path());
    change_manifest(&folder, "name = \"yade\"", "name = \"mydem\"");
    change_manifest(&folder, "[variants.yade", "[variants.mydem");
    let bench = Bench::with_system_programs();
    let rows = |code: &str| {
        let line = format!("sweep --code {code} --mu 0.3 --stiffness 100 --format csv");
        let output = bench.tristack(&line).output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{message}");
        String::from_utf8(output.stdout).expect("text")
    };
    let folder = folder.display();
    for (own, copy) in [
        ("yade", folder.to_string()),
        ("yade-wall", format!("{folder}:mydem-wall")),
    ] {
        let copied = rows(&copy);
        assert!(copied.contains("mydem"), "{copied}");
        assert_eq!(copied.replace("mydem", "yade"), rows(own));
    }
}

#[test]
fn a_folder_with_a_name_that_is_taken_is_refused() {
    let place = tempfile::tempdir().expect("a directory");
    let folder = copy_of("lammps_inputs", place.path());
    let bench = Bench::without_codes();
    let refusal = |code: &str| {
        let line = format!("sweep --code {code} --mu 0.3 --stiffness 100");
        let message = standard_error(&mut bench.tristack(&line));
        bench.tristack(&line).assert().code(1);
        message
    };
    let folder = folder.display();
    let taken = refusal(&folder.to_string());
    assert!(
        taken.contains("code.toml: name is lammps; accepted is a name that is free"),
        "{taken}"
    );
    let absent = refusal("./nowhere");
    assert!(
        absent.contains("./nowhere/code.toml: cannot read it"),
        "{absent}"
    );
}

#[test]
fn a_folder_with_several_codes_is_asked_for_one_by_name() {
    let place = tempfile::tempdir().expect("a directory");
    let folder = copy_of("yade_scripts", place.path());
    change_manifest(&folder, "name = \"yade\"", "name = \"floors\"");
    change_manifest(&folder, "[variants.yade", "[variants.floor");
    let bench = Bench::without_codes();
    let line = format!("crosscheck --codes native,{}", folder.display());
    let message = standard_error(&mut bench.tristack(&line));
    assert!(
        message.contains("accepted is one of floor, floor-facet, floor-wall"),
        "{message}"
    );
}

/// A change of a manifest, and what the refusal says.
const WRONG: [(&str, &str, &[&str]); 12] = [
    ("schema = 1", "schema = 2", &["`schema` is 2", "1"]),
    ("schema = 1", "", &["missing field `schema`"]),
    (
        "name = \"lammps\"",
        "name = \"My DEM\"",
        &["`name` is My DEM", "lower-case"],
    ),
    (
        "command =",
        "comand =",
        &["unknown field `comand`", "`command`", "line 10"],
    ),
    (
        "\"{deck}\"",
        "\"{dek}\"",
        &["{dek}", "{deck}, {directories}"],
    ),
    (
        "stack = {",
        "stak = {",
        &["unknown variant `stak`", "`side-walls`"],
    ),
    (
        "motion = { files = [\"probe.in\"",
        "motion = { files = [\"none.in\"",
        &["cannot read `none.in`"],
    ),
    (
        "files = [\"pyramid.in\"]",
        "files = [\"../pyramid.in\"]",
        &["../pyramid.in", "inside the folder"],
    ),
    (
        "files = [\"pyramid.in\"]",
        "files = [\"pyramid.in\", \"parameters.in\"]",
        &["parameters.in", "no file of parameters"],
    ),
    (
        "format = \"lammps-thermo\"",
        "format = \"csv\"",
        &["result.format", "lammps-thermo"],
    ),
    (
        "format = \"lammps-variables\"",
        "format = \"yaml\"",
        &["yaml", "`json`, `toml`"],
    ),
    (
        "history_update = \"projected\"",
        "restitution = 2.0",
        &["`convention.restitution` is 2"],
    ),
];

#[test]
fn errors_of_a_manifest_name_file_key_value_and_what_is_accepted() {
    for (from, to, expected) in WRONG {
        let place = tempfile::tempdir().expect("a directory");
        let folder = copy_of("lammps_inputs", place.path());
        change_manifest(&folder, from, to);
        let refusal = Definition::read(&folder).expect_err(to).to_string();
        assert!(refusal.contains("folder/code.toml: "), "{refusal}");
        for words in expected {
            assert!(refusal.contains(words), "{to}: {words} in {refusal}");
        }
    }
}
