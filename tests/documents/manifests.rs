//! Codes as their folders describe them.

use crate::common::{Bench, installed, json, json_rows, records, standard_error, standard_output};
use rayon::prelude::*;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tristack::code::{Code, Definition, SettledCode, Task};
use tristack::dem::compress_stack;
use tristack::model::{Case, Power, Stack};
use tristack::series::Series;
use tristack::study::trajectory::{Branch, Quantity, Twin, documented};
use tristack::study::yield_force::plan;

/// Every order, with its reason, that is expected of the distance between a code and its twin.
#[test]
fn documented_orders_follow_from_the_manifests() {
    let mut lines = Vec::new();
    for code in Code::with_power(Power::Linear) {
        for twin in [Twin::Full, Twin::RotatedSpring] {
            for quantity in Quantity::OF_CYLINDERS {
                for branch in Branch::ALL {
                    let found = documented(&code, twin, quantity, branch);
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
    let codes = Code::with_power(Power::Linear);
    let names: Vec<&str> = codes.iter().map(Code::as_str).collect();
    let built_in = [
        "native",
        "liggghts",
        "yade",
        "yade-facet",
        "yade-wall",
        "lammps",
    ];
    assert_eq!(names, built_in);
    let labels: Vec<String> = codes.iter().map(Code::label).collect();
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
    let pairs = [
        ("yade", folder.to_string()),
        ("yade-wall", format!("{folder}:mydem-wall")),
    ];
    pairs.into_par_iter().for_each(|(own, copy)| {
        let copied = rows(&copy);
        assert!(copied.contains("mydem"), "{copied}");
        assert_eq!(copied.replace("mydem", "yade"), rows(own));
    });
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
        taken.contains(
            "code.toml, line 3: `name` is lammps; accepted is a name that no other code has"
        ),
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

/// A change of a manifest, the beginning of what is to blame if it has a line, and what the refusal says.
const WRONG: [(&str, &str, &str, &[&str]); 21] = [
    (
        "schema = 1",
        "schema = 2",
        "schema = 2",
        &["`schema` is 2", "1"],
    ),
    ("schema = 1", "", "", &["`schema` is missing", "schema = 1"]),
    ("name = \"lammps\"", "", "", &["missing field `name`"]),
    (
        "name = \"lammps\"",
        "name = \"My DEM\"",
        "name = \"My DEM\"",
        &["`name` is My DEM", "lower-case"],
    ),
    (
        "command =",
        "comand =",
        "comand =",
        &[
            "`program.comand`",
            "did you mean `command`?",
            "`environment`",
        ],
    ),
    (
        "command = [\"lmp\"",
        "command = 7 # [\"lmp\"",
        "command = 7 # [\"lmp\"",
        &["`program.command`", "`7`", "a sequence"],
    ),
    (
        "\"{deck}\"",
        "\"{dek}\"",
        "\"{dek}\"",
        &["`program.command` is {dek}", "{deck}, {directories}"],
    ),
    (
        "command =",
        "search = [\"venv/bin\"]\ncommand =",
        "search =",
        &[
            "`program.search` is venv/bin",
            "`{folder}`",
            "`$VIRTUAL_ENV`",
        ],
    ),
    (
        "stack = {",
        "stak = {",
        "stak = {",
        &["`tasks.stak`", "did you mean `stack`?", "`side-walls`"],
    ),
    (
        "motion = { files = [\"probe.in\"",
        "motion = { files = [\"none.in\"",
        "motion = { files = [\"none.in\"",
        &["`tasks.motion.files` is none.in", "cannot read `none.in`"],
    ),
    (
        "files = [\"pyramid.in\"]",
        "files = [\"../pyramid.in\"]",
        "files = [\"../pyramid.in\"]",
        &[
            "`tasks.pyramid.files` is ../pyramid.in",
            "inside the folder",
        ],
    ),
    (
        "files = [\"pyramid.in\"]",
        "files = [\"pyramid.in\", \"parameters.in\"]",
        "files = [\"pyramid.in\", \"parameters.in\"]",
        &["parameters.in", "no file of parameters"],
    ),
    (
        "file = \"log.lammps\"",
        "file = \"/tmp/log.lammps\"",
        "file = \"/tmp/log.lammps\"",
        &[
            "`result.file` is /tmp/log.lammps",
            "inside the run directory",
        ],
    ),
    (
        "format = \"lammps-thermo\"",
        "format = \"csv\"",
        "format = \"csv\"",
        &["`result.format` is csv", "lammps-thermo"],
    ),
    (
        "format = \"lammps-variables\"",
        "format = \"yaml\"",
        "format = \"yaml\"",
        &["`parameters.format` is `yaml`", "`json`, `toml`"],
    ),
    (
        "format = \"lammps-thermo\"",
        "format = \"lammps-thermo\"\ncolumns = { wal_force = \"f\" }",
        "columns =",
        &["`result.columns.wal_force`", "did you mean `wall_force`?"],
    ),
    (
        "format = \"lammps-thermo\"",
        "format = \"lammps-thermo\"\ncolumns = { x1 = { from = \"x\", factor = 0 } }",
        "columns =",
        &["`result.columns.x1` is 0", "other than 0"],
    ),
    (
        "format = \"lammps-thermo\"",
        "format = \"lammps-thermo\"\ncolumns = { x1 = { form = \"x\" } }",
        "columns =",
        &["`result.columns.x1.form`", "did you mean `from`?"],
    ),
    (
        "history_update = \"projected\"",
        "restitution = 2.0",
        "restitution = 2.0",
        &["`convention.restitution` is 2"],
    ),
    (
        "history_update = \"projected\"",
        "law = { power = 1.6 }",
        "law =",
        &["1.6", "1, 1.25, 1.5, 1.75 or 2"],
    ),
    (
        "history_update = \"projected\"",
        "history_updat = \"projected\"",
        "",
        &[
            "`convention.history_updat` is no known key",
            "did you mean `history_update`?",
        ],
    ),
];

#[test]
fn errors_of_a_manifest_name_file_key_value_and_what_is_accepted() {
    for (from, to, blamed, expected) in WRONG {
        let place = tempfile::tempdir().expect("a directory");
        let folder = copy_of("lammps_inputs", place.path());
        change_manifest(&folder, from, to);
        let refusal = Definition::read(&folder).expect_err(to).to_string();
        assert!(refusal.contains("folder/code.toml"), "{refusal}");
        if !blamed.is_empty() {
            let text = fs::read_to_string(folder.join("code.toml")).expect("a manifest");
            let line = text.lines().position(|line| line.contains(blamed));
            let place = format!(", line {}: ", line.expect(blamed) + 1);
            assert!(refusal.contains(&place), "{to}: {place} in {refusal}");
        }
        for words in expected {
            assert!(refusal.contains(words), "{to}: {words} in {refusal}");
        }
    }
}

/// A folder with nothing but a manifest.
fn folder_with(place: &Path, name: &str, manifest: &str) -> PathBuf {
    let folder = place.join(name);
    fs::create_dir_all(&folder).expect("a directory");
    fs::write(folder.join("code.toml"), manifest).expect("a manifest");
    folder
}

const EXTENDING: &str = "schema = 1\nname = \"other\"\nextends = ";

#[test]
fn a_manifest_that_extends_another_has_its_keys_and_files_but_for_its_own() {
    let place = tempfile::tempdir().expect("a directory");
    let own = "\n[tasks]\nmotion = { files = [\"own.in\", \"contacts.in\"] }\n";
    let base = folder_with(place.path(), "base", &format!("{EXTENDING}\"lammps\"{own}"));
    fs::write(base.join("own.in"), "own").expect("a deck");
    change_manifest(&base, "\"other\"", "\"base\"");
    let further = format!("{EXTENDING}\"../base\"\n[convention]\npair = {{ torque_arm = -0.5 }}\n");
    let further = folder_with(place.path(), "further", &further);
    let bench = Bench::without_codes();
    let rows = inventory(&bench, &[&base, &further]);
    let lammps = row(&rows, "lammps");
    for (name, arm) in [("base", 0.0), ("other", -0.5)] {
        let own = row(&rows, name);
        assert_eq!(own["deck_hash"], lammps["deck_hash"], "{name}");
        assert_eq!(own["pair_torque_arm"], arm, "{name}");
        assert_eq!(own["floor_torque_arm"], 0.0, "{name}");
        // How another program is installed is not inherited.
        let hint = own["install"].as_str().expect("a text");
        assert_eq!(hint, "put its program `lmp` in the search path");
    }
}

#[test]
fn a_variant_is_inherited_where_it_is_named() {
    let place = tempfile::tempdir().expect("a directory");
    let copied = copy_of("yade_scripts", place.path());
    change_manifest(&copied, "name = \"yade\"", "name = \"floors\"");
    let bench = Bench::without_codes();
    for (extended, arm) in [
        ("yade", -0.5),
        ("yade-wall", -1.0),
        ("../folder:yade-wall", -1.0),
    ] {
        let manifest = format!("{EXTENDING}\"{extended}\"\n");
        let folder = folder_with(place.path(), "other", &manifest);
        let rows = inventory(&bench, &[&folder]);
        assert_eq!(row(&rows, "other")["floor_torque_arm"], arm, "{extended}");
        let codes = rows.iter().filter(|row| row["code"] != "other").count();
        assert_eq!(codes, Code::built_in().len(), "no variant but this one");
    }
    for (extended, expected) in [
        (
            "../folder",
            "accepted after the `:` is one of yade, yade-facet, yade-wall",
        ),
        (
            "../nowhere",
            "line 3: `extends` is ../nowhere: cannot read its code.toml",
        ),
        ("../other", "in a circle"),
        (
            "yadde",
            "line 3: `extends` is yadde, but must be the name of a code",
        ),
        ("native", "but must be the name of a code"),
    ] {
        let manifest = format!("{EXTENDING}\"{extended}\"\n");
        let folder = folder_with(place.path(), "other", &manifest);
        let refusal = Definition::read(&folder).expect_err(extended).to_string();
        assert!(refusal.contains(expected), "{refusal}");
    }
}

/// An error in an extended manifest is one of that file.
#[test]
fn an_error_names_the_manifest_that_it_stands_in() {
    let place = tempfile::tempdir().expect("a directory");
    let base = copy_of("lammps_inputs", place.path());
    let other = folder_with(
        place.path(),
        "other",
        &format!("{EXTENDING}\"../folder\"\n\n[reslt]\n"),
    );
    let refusal = |folder: &Path| {
        Definition::read(folder)
            .expect_err("it is wrong")
            .to_string()
    };
    let own = refusal(&other);
    assert!(
        own.contains("other/code.toml, line 5: `reslt` is no known key"),
        "{own}"
    );
    assert!(own.ends_with("did you mean `result`?"), "{own}");
    change_manifest(&other, "[reslt]", "");
    change_manifest(&base, "format = \"lammps-variables\"", "format = \"yaml\"");
    let inherited = refusal(&other);
    assert!(
        inherited.contains("folder/code.toml, line 21: "),
        "{inherited}"
    );
}

/// What `tristack codes` lists with `folders` in the user's data directory.
fn inventory(bench: &Bench, folders: &[&Path]) -> Vec<serde_json::Value> {
    let place = tempfile::tempdir().expect("a directory");
    let codes = place.path().join("tristack/codes");
    fs::create_dir_all(&codes).expect("a directory");
    for folder in folders {
        let name = folder.file_name().expect("a name");
        std::os::unix::fs::symlink(folder, codes.join(name)).expect("a link");
    }
    let mut command = bench.tristack("codes --format json");
    let output = command.env("XDG_DATA_HOME", place.path()).output();
    let output = output.expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    json_rows(&String::from_utf8_lossy(&output.stdout))
}

fn row<'a>(rows: &'a [serde_json::Value], name: &str) -> &'a serde_json::Value {
    let row = rows.iter().find(|row| row["code"] == name);
    row.expect("the code is listed")
}

const OWN_PROGRAM: &str = "schema = 1\nname = \"mydem\"\n[program]\ncommand = [\"mydem\", \"{deck}\"]\n\
    version = { arguments = [\"--version\"] }\n\
    search = [\"$MYDEM_NOT_SET/bin\", \"{folder}/bin\", \"$MYDEM/bin\", \"$PATH\"]\n\
    [tasks]\nstack = { files = [\"code.toml\"] }\n";

fn install(folder: &Path, version: &str) {
    let programs = folder.join("bin");
    fs::create_dir_all(&programs).expect("a directory");
    let program = programs.join("mydem");
    fs::write(&program, format!("#!/bin/sh\necho {version}\n")).expect("a script");
    fs::set_permissions(&program, fs::Permissions::from_mode(0o755)).expect("its permissions");
}

/// The directories of the manifest are searched in their order; one whose variable is not set is left out.
#[test]
fn a_program_is_looked_for_where_the_manifest_says() {
    let bench = Bench::without_codes();
    let version = |environment: Option<&Path>| {
        let mut command = bench.tristack("codes --format json");
        command.env("XDG_DATA_HOME", bench.path("data"));
        if let Some(place) = environment {
            command.env("MYDEM", place);
        }
        let rows = json_rows(&standard_output(&mut command));
        row(&rows, "mydem")["version"].as_str().map(str::to_owned)
    };
    let codes = bench.path("data/tristack/codes");
    let folder = folder_with(&codes, "mydem", OWN_PROGRAM);
    let elsewhere = bench.path("elsewhere");
    assert_eq!(version(Some(&elsewhere)), None);
    bench.install("mydem", "echo 1\n");
    assert_eq!(version(Some(&elsewhere)).as_deref(), Some("1"));
    install(&elsewhere, "2");
    assert_eq!(version(None).as_deref(), Some("1"));
    assert_eq!(version(Some(&elsewhere)).as_deref(), Some("2"));
    install(&folder, "3");
    assert_eq!(version(Some(&elsewhere)).as_deref(), Some("3"));
}

/// A compiled program needs no file, and a list of planned runs names it where a shell would not find it.
#[test]
fn a_program_in_its_folder_runs_without_files_here_and_from_a_plan() {
    let bench = Bench::with_system_programs();
    let case = short_case();
    let series = compress_stack(&case, || true).expect("a finite series");
    let folder = folder_with(
        bench.path("").as_path(),
        "mydem",
        "schema = 1\nname = \"mydem\"\n[program]\ncommand = [\"mydem\"]\nsearch = [\"{folder}/bin\"]\n[tasks.stack]\n",
    );
    let data = folder.join("series.txt");
    fs::write(&data, series.to_csv()).expect("a series");
    install(&folder, "1");
    let script = format!("#!/bin/sh\ncp {} result.csv\n", data.display());
    fs::write(folder.join("bin/mydem"), script).expect("a script");
    let (message, out) = simulated(&bench, &folder, &case, "");
    let written = fs::read(out.join("series.csv")).expect(&message);
    assert!(written == series.to_csv(), "the series of native");

    let line = "plan --code ./mydem --mu 0.3 --stiffness 100 --out away";
    bench.tristack(line).assert().code(0);
    let list = fs::read_to_string(bench.path("away/start.txt")).expect("a list");
    let program = folder.join("bin/mydem");
    let program = program.to_str().expect("plain text");
    assert!(
        list.lines()
            .all(|line| line.contains(&format!("&& {program} >"))),
        "{list}"
    );

    change_manifest(&folder, "[\"mydem\"]", "[\"mydem\", \"{deck}\"]");
    let (message, _) = simulated(&bench, &folder, &case, "");
    assert!(
        message.contains("the deck that `{deck}` in program.command stands for"),
        "{message}"
    );
}

/// Another program of that name would run under a wrong name.
#[test]
fn the_search_path_is_searched_if_the_manifest_names_it_or_nothing() {
    let place = tempfile::tempdir().expect("a directory");
    let bench = Bench::without_codes();
    bench.install("mydem", "echo 1\n");
    for (search, version) in [
        ("search = [\"{folder}/bin\"]", None),
        ("search = [\"{folder}/bin\", \"$PATH\"]", Some("1")),
        ("", Some("1")),
    ] {
        let own = OWN_PROGRAM
            .lines()
            .map(|line| match line.trim_start().starts_with("search") {
                true => search,
                false => line,
            });
        let own: Vec<&str> = own.collect();
        let name = format!("folder-{}", search.len());
        let folder = folder_with(place.path(), &name, &own.join("\n"));
        let rows = inventory(&bench, &[&folder]);
        assert_eq!(row(&rows, "mydem")["version"].as_str(), version, "{search}");
    }
}

/// An inherited `{folder}` is that of the manifest that names it.
#[test]
fn an_inherited_directory_is_that_of_the_other_folder() {
    let bench = Bench::without_codes();
    let codes = bench.path("data/tristack/codes");
    install(&folder_with(&codes, "mydem", OWN_PROGRAM), "3");
    folder_with(&codes, "other", &format!("{EXTENDING}\"../mydem\"\n"));
    let mut command = bench.tristack("codes --format json");
    command.env("XDG_DATA_HOME", bench.path("data"));
    let rows = json_rows(&standard_output(&mut command));
    assert_eq!(row(&rows, "other")["version"], "3");
}

#[test]
fn a_broken_folder_of_the_user_is_told_and_stops_no_other_command() {
    let bench = Bench::without_codes();
    let codes = bench.path("data/tristack/codes");
    folder_with(&codes, "mydem", OWN_PROGRAM);
    folder_with(
        &codes,
        "broken",
        "schema = 1\nname = \"broken\"\n[progam]\n",
    );
    let run = |line: &str| {
        let mut command = bench.tristack(line);
        command.env("XDG_DATA_HOME", bench.path("data"));
        let output = command.output().expect("it runs");
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), message)
    };
    let (status, message) = run("codes");
    assert_eq!(status, Some(3));
    let expected = "broken/code.toml, line 3: `progam` is no known key";
    assert!(message.contains(expected), "{message}");
    let (status, message) = run("theory --mu 0.3 --stiffness 100");
    assert_eq!((status, message.as_str()), (Some(0), ""));
    for name in ["mydem", "mydem:mydem"] {
        let (status, message) = run(&format!("probe --codes {name}"));
        assert_eq!(status, Some(3));
        assert!(
            message.contains("mydem is not installed: its program is not in"),
            "{message}"
        );
    }
    let (status, message) = run("probe --codes broken");
    assert_eq!(status, Some(1));
    assert!(message.contains(expected), "{message}");
    let (status, message) = run("probe --codes mydm");
    assert_eq!(status, Some(1));
    assert!(
        message.contains("a similar value exists: 'mydem'"),
        "{message}"
    );
}

/// The proof that a manifest alone is enough for another build of a code.
#[test]
fn a_folder_that_extends_a_code_gives_its_rows() {
    let lammps = Code::named("lammps").expect("it is built in");
    if installed(&[lammps]).is_empty() {
        return;
    }
    let bench = Bench::with_system_programs();
    let codes = bench.path("data/tristack/codes");
    folder_with(&codes, "other", &format!("{EXTENDING}\"lammps\"\n"));
    let rows = |code: &str| {
        let line = format!("sweep --code {code} --mu 0.3 --stiffness 100 --format csv");
        let mut command = bench.tristack(&line);
        command.env("XDG_DATA_HOME", bench.path("data"));
        standard_output(&mut command)
    };
    let own = rows("other");
    assert!(own.contains("other"), "{own}");
    assert_eq!(own.replace("other", "lammps"), rows("lammps"));
}

/// A case of some thousand steps.
fn short_case() -> Case {
    let native = SettledCode::native();
    let stack = Stack::paper(0.3, 100.0);
    let mut case = plan(&native, &stack, native.convention()).cases[0];
    case.protocol.wall_speed *= 8.0;
    case.protocol.sampling.coarse_interval /= 8.0;
    case.protocol.sampling.fine_interval /= 8.0;
    case
}

/// A code that delivers `series` whatever it is asked, with these `columns`.
fn replaying(place: &Path, series: &str, columns: &str) -> PathBuf {
    let manifest = format!(
        "schema = 1\nname = \"mydem\"\n[program]\ncommand = [\"sh\", \"{{deck}}\"]\n\
         [result]\ncolumns = {columns}\n[tasks]\nstack = {{ files = [\"run.sh\", \"series.txt\"] }}\n"
    );
    let folder = folder_with(place, "mydem", &manifest);
    fs::write(folder.join("run.sh"), "cp series.txt result.csv\n").expect("a script");
    fs::write(folder.join("series.txt"), series).expect("a series");
    folder
}

/// What `tristack simulate` with that code says, and the directory that it leaves.
fn simulated(bench: &Bench, folder: &Path, case: &Case, further: &str) -> (String, PathBuf) {
    let out = bench.path("out");
    fs::write(bench.path("case.json"), case.to_json()).expect("a case");
    let folder = folder.display();
    let line = format!("simulate --code {folder} --case case.json --out out {further}");
    (standard_error(&mut bench.tristack(&line)), out)
}

/// The columns `names` of a series in CSV, changed by `change`, and one of its own.
fn rearranged(series: &Series, names: &[&str], change: impl Fn(&str, f64) -> f64) -> String {
    let rows = records(&series.to_csv()).into_iter().map(|row| {
        let fields = names
            .iter()
            .map(|name| change(name, row[*name]).to_string());
        let fields: Vec<String> = fields.collect();
        format!("{},7", fields.join(","))
    });
    let rows: Vec<String> = rows.collect();
    rows.join("\n") + "\n"
}

#[test]
fn columns_of_a_result_may_have_other_names_orders_and_factors() {
    let bench = Bench::with_system_programs();
    let case = short_case();
    let series = compress_stack(&case, || true).expect("a finite series");
    let mut names = Series::COLUMNS.to_vec();
    names.reverse();
    let header = names
        .join(",")
        .replace("wall_force", "top")
        .replace("floor_n2", "down")
        + ",energy\n";
    let turned = |name: &str, number: f64| if name == "floor_n2" { -number } else { number };
    let text = header + &rearranged(&series, &names, turned);
    let columns = "{ wall_force = \"top\", floor_n2 = { from = \"down\", factor = -1.0 } }";
    let folder = replaying(bench.path("").as_path(), &text, columns);
    let (message, out) = simulated(&bench, &folder, &case, "");
    let written = fs::read(out.join("series.csv")).expect(&message);
    assert!(written == series.to_csv(), "the series of native");
    change_manifest(
        &folder,
        columns,
        "{ x1 = \"absent\", wall_force = \"top\", floor_n2 = \"down\" }",
    );
    let (message, _) = simulated(&bench, &folder, &case, "");
    assert!(message.contains("`absent` is missing"), "{message}");
}

/// Positions and angles may be left out; what needs them says so.
#[test]
fn a_series_without_positions_is_read_and_cannot_be_drawn() {
    let bench = Bench::with_system_programs();
    let case = short_case();
    let series = compress_stack(&case, || true).expect("a finite series");
    let forces = [
        "step",
        "time",
        "wall_force",
        "floor_n2",
        "floor_t2",
        "floor_n3",
        "floor_t3",
    ];
    let text = forces.join(",") + ",energy\n" + &rearranged(&series, &forces, |_, number| number);
    let folder = replaying(bench.path("").as_path(), &text, "{}");
    let (message, out) = simulated(&bench, &folder, &case, "--svg picture.svg");
    assert!(
        message.contains("`series` is without x1, y1, theta1"),
        "{message}"
    );
    let written = fs::read_to_string(out.join("series.csv")).expect("a series");
    assert_eq!(written.lines().next(), Some(forces.join(",").as_str()));
    let summary = fs::read_to_string(out.join("summary.json")).expect("a summary");
    let all = json(&summary).to_string();
    assert!(all.contains("\"slip_force\":30."), "{all}");
    let line = text.replace("floor_t3", "t3");
    fs::write(folder.join("series.txt"), line).expect("a series");
    let (message, _) = simulated(&bench, &folder, &case, "");
    assert!(message.contains("`floor_t3` is missing"), "{message}");
}

/// A deck is given everything that it needs, unless its manifest says otherwise.
#[test]
fn a_deck_is_given_the_units_bodies_steps_and_starting_positions() {
    let bench = Bench::with_system_programs();
    let case = short_case();
    let series = compress_stack(&case, || true).expect("a finite series");
    let text = String::from_utf8(series.to_csv()).expect("text");
    let folder = replaying(bench.path("").as_path(), &text, "{}");
    let (message, out) = simulated(&bench, &folder, &case, "");
    let given = fs::read_to_string(out.join("task.json")).expect(&message);
    assert_eq!(json(&given), case.all_parameters());
    assert_eq!(json(&given)["initial_x2"], 1.0);
    let files = "[parameters]\nfile = \"p.json\"\ncontent = \"deck\"\n[result]";
    change_manifest(&folder, "[result]", files);
    fs::remove_dir_all(out).expect("it is removed");
    let (message, out) = simulated(&bench, &folder, &case, "");
    let given = fs::read_to_string(out.join("p.json")).expect(&message);
    assert_eq!(json(&given), case.parameters());
}
