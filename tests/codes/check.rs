//! `tristack check` on the Python example, on copies of it that are broken, and on folders that misbehave.

use crate::common;
use crate::common::{Bench, assert_only, code_folder, installed, json_rows};
use rayon::prelude::*;
use serde::Deserialize;
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use tristack::code::Code;

const EXAMPLE: &str = "examples/python";
/// So many causes are still an explanation.
const MOST_CAUSES: usize = 3;

/// A copy of the example with one mistake.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Broken {
    mistake: String,
    /// What is replaced in mydem.py, and by what.
    change: Vec<[String; 2]>,
    /// Words that name the mistake.
    words: Vec<String>,
    /// Whether the explanation names it; all do where it is not said.
    #[serde(default = "yes")]
    explained: bool,
    /// Whether the check explained it when it saw it for the first time.
    #[serde(default = "yes")]
    first: bool,
    /// What an explanation has to say, by the one who wrote the folder.
    #[serde(default)]
    accept: String,
    /// Whether nothing is wrong with it any more.
    #[serde(default)]
    harmless: bool,
    /// Whether check does not notice it.
    #[serde(default)]
    unnoticed: bool,
    /// Whether it waits for the trials of all folders: its check takes minutes, because only a stack shows the mistake that rises
    /// slowly under gravity, or it is one of many.
    #[serde(default)]
    slow: bool,
}

fn yes() -> bool {
    true
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    folder: Vec<Broken>,
}

fn table(text: &str) -> Vec<Broken> {
    toml::from_str::<Table>(text).expect("a table").folder
}

/// A law that the example does not have, and copies that have it and a mistake.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LawOfCopies {
    name: String,
    /// What is replaced in code.toml.
    manifest: Vec<[String; 2]>,
    /// What is replaced in mydem.py.
    change: Vec<[String; 2]>,
    folder: Vec<Broken>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Laws {
    law: Vec<LawOfCopies>,
}

fn replaced(mut text: String, change: &[[String; 2]]) -> String {
    for [from, to] in change {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

/// A bench with the example as `mydem`, after some replacements in its script.
fn bench_with(change: &[[String; 2]]) -> Bench {
    bench_of(&[], change)
}

/// The same after replacements in its manifest, too.
fn bench_of(manifest: &[[String; 2]], change: &[[String; 2]]) -> Bench {
    let bench = Bench::with_system_programs();
    let folder = code_folder(EXAMPLE, &bench.path("mydem"), |text| {
        replaced(text, manifest)
    });
    let script = folder.join("mydem.py");
    let text = fs::read_to_string(&script).expect("a script");
    fs::write(script, replaced(text, change)).expect("it can be written");
    bench
}

/// The exit status and the items of a check.
fn check(bench: &Bench, options: &str) -> (i32, Vec<Value>) {
    let line = format!("check ./mydem --format json {options}");
    let output = bench.tristack(&line).output().expect("it runs");
    let text = String::from_utf8(output.stdout).expect("text");
    let status = output.status.code().expect("it ends by itself");
    (status, json_rows(&text))
}

fn text<'a>(item: &'a Value, key: &str) -> &'a str {
    item[key].as_str().unwrap_or_default()
}

/// Whether an item that failed, or a remark, names the mistake among at most three causes.
fn is_explained(items: &[Value], broken: &Broken) -> bool {
    let mut telling = items
        .iter()
        .filter(|item| ["failed", "remark"].contains(&text(item, "outcome")));
    telling.any(|item| {
        let causes = text(item, "causes");
        let told = format!("{} {} {causes}", text(item, "item"), text(item, "found"));
        let causes = match causes.strip_prefix("usual causes: ") {
            Some(usual) => usual.split("; ").count(),
            None => causes.split(" | ").count(),
        };
        let few = causes <= MOST_CAUSES;
        few && broken.words.iter().all(|word| told.contains(word.as_str()))
    })
}

/// The folders of which it is not as the table says whether they are explained.
fn surprises(folders: &[Broken]) -> Vec<String> {
    surprises_among(folders, &|broken| bench_with(&broken.change))
}

fn surprises_among(folders: &[Broken], bench: &(dyn Fn(&Broken) -> Bench + Sync)) -> Vec<String> {
    let surprises = folders.par_iter().filter_map(|broken| {
        let (status, items) = check(&bench(broken), "");
        let explained = is_explained(&items, broken);
        // Few digits are no failure.
        let is_noticed = (status != 0) != (broken.harmless || broken.unnoticed)
            || broken.words[0].contains("digits");
        let told = || format!("{}: {status}, {items:#?}", broken.mistake);
        (explained != broken.explained || !is_noticed).then(told)
    });
    surprises.collect()
}

#[test]
fn broken_folders_are_explained() {
    let folders = table(include_str!("check/broken.toml"));
    assert!(folders.len() >= 15);
    let surprises = surprises(&folders);
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

/// The folders of other laws, without those that take minutes if `is_quick`.
fn folders_of_other_laws_are_explained(is_quick: bool) {
    let laws: Laws = toml::from_str(include_str!("check/laws.toml")).expect("a table");
    for mut law in laws.law {
        law.folder.retain(|broken| !is_quick || !broken.slow);
        let surprises = surprises_among(&law.folder, &|broken| {
            let change: Vec<_> = law.change.iter().chain(&broken.change).cloned().collect();
            bench_of(&law.manifest, &change)
        });
        assert!(
            surprises.is_empty(),
            "{}: {}",
            law.name,
            surprises.join("\n")
        );
    }
}

#[test]
fn broken_folders_of_other_laws_are_explained() {
    folders_of_other_laws_are_explained(true);
}

/// The folders of a trial: ten that were written after the check was frozen, `first` of which it explained at once.
fn explained_as_far_as_is_said(trial: &str, first: usize, is_blind: bool) {
    let folders = table(trial);
    assert_eq!(folders.len(), 10);
    assert_eq!(folders.iter().filter(|folder| folder.first).count(), first);
    assert!(
        folders
            .iter()
            .all(|folder| folder.accept.is_empty() != is_blind)
    );
    let surprises = surprises(&folders);
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

#[test]
fn folders_that_were_written_blind_are_explained_as_far_as_is_said() {
    explained_as_far_as_is_said(include_str!("check/blind-6.toml"), 5, true);
}

/// Mistakes that were reported of released codes, without those that wait for all trials if `is_quick`.
fn reports_are_explained_as_far_as_is_said(is_quick: bool) {
    let mut folders = table(include_str!("check/reports.toml"));
    folders.retain(|broken| !is_quick || !broken.slow);
    assert!(!folders.is_empty());
    let surprises = surprises(&folders);
    assert!(surprises.is_empty(), "{}", surprises.join("\n"));
}

#[test]
fn reports_on_released_codes_are_explained_as_far_as_is_said() {
    reports_are_explained_as_far_as_is_said(true);
}

#[test]
#[ignore = "eleven further trials take minutes: cargo test --test codes check -- --ignored"]
fn folders_of_earlier_trials_are_explained_as_far_as_is_said() {
    explained_as_far_as_is_said(include_str!("check/unforeseen.toml"), 2, false);
    explained_as_far_as_is_said(include_str!("check/blind.toml"), 5, true);
    explained_as_far_as_is_said(include_str!("check/blind-2.toml"), 6, true);
    explained_as_far_as_is_said(include_str!("check/blind-3.toml"), 6, true);
    explained_as_far_as_is_said(include_str!("check/blind-4.toml"), 5, true);
    explained_as_far_as_is_said(include_str!("check/blind-5.toml"), 1, true);
    explained_as_far_as_is_said(include_str!("check/blind-7.toml"), 7, true);
    explained_as_far_as_is_said(include_str!("check/blind-8.toml"), 8, true);
    explained_as_far_as_is_said(include_str!("check/blind-9.toml"), 4, true);
    explained_as_far_as_is_said(include_str!("check/blind-10.toml"), 8, true);
    folders_of_other_laws_are_explained(false);
    reports_are_explained_as_far_as_is_said(false);
}

#[test]
fn the_example_passes_and_is_told_what_comes_next() {
    let bench = bench_with(&[]);
    let (status, items) = check(&bench, "");
    let wrong = items
        .iter()
        .filter(|item| text(item, "outcome") != "passed");
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<&Value>::new());
    assert_eq!(status, 0);
    let grades: Vec<&str> = items.iter().map(|item| text(item, "grade")).collect();
    assert!(grades.is_sorted_by_key(|grade| {
        ["mandatory", "consistency", "informational"]
            .iter()
            .position(|known| known == grade)
    }));
    let shown = common::standard_output(&mut bench.tristack("check ./mydem"));
    let last = shown.lines().last().unwrap_or_default();
    assert_eq!(last, "next: tristack crosscheck --codes ./mydem");
    // Nothing is left behind, neither runs nor a store.
    assert_only(&bench.path("."), &["mydem", "programs"]);
}

/// What comes next can be given to a shell as it stands, and a path with commas and spaces is one folder.
#[test]
fn a_folder_with_commas_and_spaces_is_told_so_that_a_shell_takes_it() {
    let bench = Bench::with_system_programs();
    let name = "my code, new";
    code_folder(EXAMPLE, &bench.path(name), |manifest| {
        manifest.replace("stack = { files = [\"mydem.py\"] }\n", "")
    });
    let tristack = |words: &[&str]| {
        let output = bench.tristack("").args(words).output().expect("it runs");
        let shown = String::from_utf8_lossy(&output.stdout).into_owned();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), shown, told)
    };
    let (status, shown, _) = tristack(&["check", name]);
    let last = shown.lines().last().unwrap_or_default();
    assert_eq!(last, "next: tristack probe --codes './my code, new'");
    assert_eq!(status, Some(0));
    let together = ["probe", "--codes", "./my code, new", "--codes", "native"];
    let (status, shown, told) = tristack(&together);
    assert_eq!(status, Some(0), "{told}");
    assert!(
        shown.contains("mydem") && shown.contains("native"),
        "{shown}"
    );
    // A list that holds it is refused, and says how it is written.
    let (status, _, told) = tristack(&["probe", "--codes", "native,./my code, new"]);
    assert_eq!(status, Some(1));
    let accepted =
        "accepted is its path alone, './my code, new', and the flag again for other codes";
    assert!(told.contains(accepted), "{told}");
    fs::write(bench.path(name).join("code.toml"), "nme = 1").expect("it can be written");
    let (_, shown, _) = tristack(&["check", name]);
    let last = shown.lines().last().unwrap_or_default();
    assert_eq!(
        last,
        "next: mend the manifest, then: tristack check './my code, new'"
    );
}

/// Rows of the quick profile that are made again; all of them take minutes.
const ROWS_AGAIN: [(&str, &str); 2] = [("0.12", "100"), ("0.4", "10000")];

#[test]
fn the_recorded_rows_of_the_example_are_those_that_it_gives() {
    let bench = bench_with(&[]);
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(EXAMPLE);
    let recorded = fs::read_to_string(file.join("crosscheck.csv")).expect("rows");
    let recorded = rows(&recorded);
    assert_eq!(recorded.len(), 18);
    assert!(recorded.iter().all(|row| cell(row, "verdict") == "agrees"));
    for (mu, stiffness) in ROWS_AGAIN {
        let line =
            format!("crosscheck --codes ./mydem --mu {mu} --stiffness {stiffness} --format csv");
        let made = rows(&common::standard_output(&mut bench.tristack(&line)));
        let same = |row: &&Row| {
            let number = |name: &str| cell(row, name).parse::<f64>().expect("a number");
            number("mu").to_string() == mu && number("stiffness").to_string() == stiffness
        };
        let recorded = recorded.iter().find(same).expect("it is recorded");
        for (name, old) in recorded {
            let new = cell(&made[0], name);
            let numbers = new.parse::<f64>().ok().zip(old.parse::<f64>().ok());
            let is_same = numbers.map_or(new == old, |(new, old)| (new - old).abs() < 1e-9);
            // The version is that of the Python that is here.
            assert!(is_same || name == "version", "{name}: {new}, not {old}");
        }
    }
}

type Row = Vec<(String, String)>;

fn rows(text: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let named = |record: csv::StringRecord| {
        let cells = header.iter().zip(record.iter());
        cells
            .map(|(name, cell)| (name.to_owned(), cell.to_owned()))
            .collect()
    };
    let records = reader.records();
    records
        .map(|record| named(record.expect("a row")))
        .collect()
}

fn cell<'a>(row: &'a Row, name: &str) -> &'a str {
    let found = row.iter().find(|(own, _)| own == name);
    &found.expect("it has the column").1
}

/// The codes inside the program pass as folders under other names.
#[test]
fn folders_of_real_codes_pass() {
    let mut codes = Code::built_in();
    codes.retain(|code| !code.is_native());
    for code in installed(&codes) {
        let bench = Bench::with_system_programs();
        fs::create_dir(bench.path("mydem")).expect("a directory");
        let manifest =
            format!("schema = 1\nname = \"mydem\"\nextends = \"{code}\"\ntitle = \"My DEM\"\n");
        fs::write(bench.path("mydem/code.toml"), manifest).expect("a manifest");
        let (status, items) = check(&bench, "");
        let failed = items
            .iter()
            .filter(|item| text(item, "outcome") == "failed");
        assert_eq!(failed.collect::<Vec<_>>(), Vec::<&Value>::new(), "{code}");
        assert_eq!(status, 0, "{code}");
        // A code may have a valid rule of its own there, which is a remark.
        let path = |item: &&Value| text(item, "item") == "loading path";
        let compared = items.iter().find(path).expect("an item");
        assert!(
            ["passed", "remark"].contains(&text(compared, "outcome")),
            "{code}"
        );
    }
}

/// `check` and `probe` say what the other has found about the folder as it is, and nothing of what it was.
#[test]
fn what_one_command_has_found_the_others_say() {
    let bench = bench_of(&[["frozen".to_owned(), "follows-limit".to_owned()]], &[]);
    let told = |line: &str| {
        let output = bench.tristack(line).output().expect("it runs");
        let [rows, told] =
            [output.stdout, output.stderr].map(|own| String::from_utf8(own).expect("text"));
        format!("{rows}{told}")
    };
    let of = |command: &str| format!("`tristack {command}` has found about this very code: ");
    let probed = told("probe --codes ./mydem");
    assert!(!probed.contains("about this very code"), "{probed}");
    let checked = told("check ./mydem");
    let property = "floor_sliding_spring_memory";
    assert!(
        checked.contains(&format!(
            "{}its probe contradicts its declaration: ",
            of("probe")
        )),
        "{checked}"
    );
    assert!(
        checked.contains("next: mend the first failure"),
        "{checked}"
    );
    let probed = told("probe --codes ./mydem");
    assert!(
        probed.contains(&format!("mydem: {}declared convention: ", of("check"))),
        "{probed}"
    );
    let listed = told("store list --kind finding --entries");
    assert_eq!(listed.matches("mydem").count(), 2, "{listed}");
    let manifest = bench.path("mydem/code.toml");
    let text = fs::read_to_string(&manifest).expect("a manifest");
    fs::write(&manifest, text.replace("follows-limit", "frozen")).expect("it can be written");
    for line in ["probe --codes ./mydem", "check ./mydem"] {
        let told = told(line);
        assert!(!told.contains("about this very code"), "{told}");
        assert!(told.contains("passed") || told.contains(property), "{told}");
    }
}

#[test]
fn a_code_without_micro_tests_is_checked_as_far_as_it_goes() {
    let bench = Bench::with_system_programs();
    let without = |manifest: String| manifest.replace("motion = {", "side-walls = {");
    code_folder(EXAMPLE, &bench.path("mydem"), without);
    let (status, items) = check(&bench, "");
    let untested = items
        .iter()
        .filter(|item| text(item, "outcome") == "not-tested");
    let untested: Vec<&str> = untested.map(|item| text(item, "item")).collect();
    assert_eq!(untested, ["micro-tests", "measured convention"]);
    assert_eq!(status, 0);
}

/// A bench with the example as `mydem`, of which nothing is left but the micro-tests, after some replacements in its
/// script.
fn bench_of_pairs(change: &[[String; 2]]) -> Bench {
    let without = ["stack = { files = [\"mydem.py\"] }\n", ""].map(str::to_owned);
    bench_of(&[without], change)
}

#[test]
fn a_code_without_a_stack_is_checked_and_probed() {
    let bench = bench_of_pairs(&[]);
    let (status, items) = check(&bench, "");
    assert_eq!(status, 0, "{items:#?}");
    let others = items
        .iter()
        .filter(|item| text(item, "outcome") != "passed");
    let others: Vec<_> = others
        .map(|item| (text(item, "item"), text(item, "outcome")))
        .collect();
    assert_eq!(others, [("task stack", "not-tested")]);
    let shown = common::standard_output(&mut bench.tristack("check ./mydem"));
    let last = shown.lines().last().unwrap_or_default();
    assert_eq!(last, "next: tristack probe --codes ./mydem");
    common::standard_output(&mut bench.tristack("probe --codes ./mydem --out passport"));
    assert!(bench.path("passport/mydem.json").is_file());
}

#[test]
fn a_mistake_in_a_code_without_a_stack_is_explained() {
    let folders = table(include_str!("check/broken.toml"));
    let mistake = "the damping acts on the first cylinder of a pair alone";
    let mut folders = folders.iter();
    let broken = folders.find(|own| own.mistake == mistake).expect("there");
    let (status, items) = check(&bench_of_pairs(&broken.change), "");
    assert_eq!(status, 2, "{items:#?}");
    assert!(is_explained(&items, broken), "{items:#?}");
}

#[test]
fn commands_that_compress_a_stack_refuse_a_code_without_one() {
    let bench = bench_of_pairs(&[]);
    let of_stacks = [
        "crosscheck --codes ./mydem",
        "crosscheck --explain ./mydem/0.3/100",
        "time --codes ./mydem",
        "trajectories --codes ./mydem",
        "simulate --code ./mydem --mu 0.3 --stiffness 100",
        "sweep --code ./mydem --mu 0.3 --stiffness 100",
        "plan --code ./mydem --out away",
        "bench --codes ./mydem",
        "record --codes ./mydem",
        "report --codes ./mydem",
    ];
    let of_spheres = ["crosscheck --bodies 3 --codes ./mydem"];
    let lines = of_stacks.map(|line| (line, "stack"));
    for (line, task) in lines
        .into_iter()
        .chain(of_spheres.map(|line| (line, "spheres")))
    {
        let output = bench.tristack(line).output().expect("it runs");
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{line}: {error}");
        let told = format!("error: ./mydem/code.toml: `tasks.{task}` is absent");
        assert!(error.starts_with(&told), "{line}: {error}");
    }
    // Nothing was written, nor probed.
    assert_only(&bench.path("."), &["mydem", "programs"]);
}

#[test]
fn a_manifest_without_any_task_is_refused() {
    let without = |key: &str| {
        [
            format!("{key} = {{ files = [\"mydem.py\"] }}"),
            String::new(),
        ]
    };
    let bench = bench_of(&["stack", "motion"].map(without), &[]);
    let (status, items) = check(&bench, "");
    assert_eq!(status, 1);
    let found = text(&items[0], "found");
    assert!(found.contains("at least one task: stack,"), "{found}");
}

#[test]
fn a_manifest_or_a_program_that_is_not_there_is_told_and_nothing_follows() {
    let wrong: [(&str, &str, i32, &str, &str); 3] = [
        ("command =", "comand =", 1, "manifest", "comand"),
        (
            "\"python3\"",
            "\"no-such-program\"",
            3,
            "program",
            "not installed",
        ),
        (
            "[\"--version\"]",
            "[\"-c\", \"import time; print(time.time_ns())\"]",
            3,
            "program",
            "asked twice",
        ),
    ];
    for (from, to, expected, item, words) in wrong {
        let bench = Bench::with_system_programs();
        code_folder(EXAMPLE, &bench.path("mydem"), |manifest| {
            manifest.replace(from, to)
        });
        let (status, items) = check(&bench, "");
        assert_eq!(status, expected, "{items:#?}");
        let last = items.last().expect("an item");
        assert_eq!(
            (text(last, "item"), text(last, "outcome")),
            (item, "failed")
        );
        let told = format!("{} {}", text(last, "found"), text(last, "causes"));
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn a_program_that_is_not_executable_is_told() {
    let command = [
        "command = [\"python3\", \"{deck}\"]",
        "command = [\"mydem.py\"]\nsearch = [\"{folder}\"]",
    ];
    let bench = bench_of(&[command.map(str::to_owned)], &[]);
    let script = bench.path("mydem/mydem.py");
    fs::set_permissions(&script, fs::Permissions::from_mode(0o644)).expect("its permissions");
    let (status, items) = check(&bench, "");
    let last = items.last().expect("an item");
    assert_eq!((status, text(last, "item")), (3, "program"));
    let found = text(last, "found");
    let expected = "mydem/mydem.py is there, but it is not executable";
    assert!(found.ends_with(expected), "{found}");
    let causes = text(last, "causes");
    assert!(causes.contains("chmod +x /"), "{causes}");
    assert!(!causes.contains("misspelt"), "{causes}");
    let output = bench.tristack("probe --codes ./mydem").output();
    let error = String::from_utf8(output.expect("it runs").stderr).expect("text");
    let told = "is there, but not executable; accepted is one that is: chmod +x /";
    assert!(error.contains(told), "{error}");
}

#[test]
fn a_probe_in_which_no_contact_acts_says_so_once() {
    let never = ["if overlap <= 0.0:", "if True:"].map(str::to_owned);
    let bench = bench_with(&[never]);
    let told = "no contact force was seen in any of its micro-tests";
    let output = bench.tristack("probe --codes ./mydem").output();
    let output = output.expect("it runs");
    assert_eq!(output.status.code(), Some(4));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(error.matches(told).count(), 1, "{error}");
    let output = bench
        .tristack("probe --codes ./mydem --format json")
        .output();
    let findings = json_rows(&String::from_utf8_lossy(&output.expect("it runs").stdout));
    let properties: Vec<&str> = findings.iter().map(|own| text(own, "property")).collect();
    assert!(
        properties.contains(&"floor_normal_stiffness"),
        "{properties:?}"
    );
    let line = "crosscheck --codes ./mydem --mu 0.3 --stiffness 100";
    let output = bench.tristack(line).output().expect("it runs");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(error.matches(told).count(), 1, "{error}");
    let (_, items) = check(&bench, "");
    let mut items = items.iter();
    let declared = items.find(|item| text(item, "item") == "declared convention");
    let declared = declared.expect("the item");
    assert_eq!(text(declared, "outcome"), "not-tested");
}

/// Behaviour of a script before it does its task, options, exit status, and words by which it is told.
const MISBEHAVIOUR: [(&str, &str, i32, &str); 7] = [
    (
        "import time; time.sleep(600)",
        "--time-limit 2",
        3,
        "it hangs",
    ),
    (
        "print('x' * 50_000_000) if 'ramp_steps' in open('task.json').read() else 0",
        "",
        0,
        "",
    ),
    (
        "import os; [open(os.path.join(place, 'outside'), 'w').write('x') for place in ('..', os.environ['HOME'], os.environ['TMPDIR'])]",
        "",
        0,
        "",
    ),
    (
        "import os, time\nif os.fork() == 0:\n    os.setsid()\n    time.sleep(600)",
        "",
        0,
        "",
    ),
    (
        "import os; os.symlink('/etc/passwd', 'result.csv'); raise SystemExit",
        "",
        3,
        "cannot read result.csv",
    ),
    (
        "import os; os.mkfifo('result.csv'); raise SystemExit",
        "",
        3,
        "cannot read result.csv",
    ),
    (
        "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)",
        "",
        3,
        "stops with an error",
    ),
];

#[test]
fn folders_that_misbehave_harm_nothing() {
    MISBEHAVIOUR
        .par_iter()
        .for_each(|(before, options, expected, words)| {
            let own = "if __name__ == \"__main__\":\n";
            let indented = before.replace('\n', "\n    ");
            let change = [own.to_owned(), format!("{own}    {indented}\n")];
            let bench = bench_with(&[change]);
            let (status, items) = check(&bench, options);
            assert_eq!(status, *expected, "{before}: {items:#?}");
            let told: Vec<String> = items.iter().map(Value::to_string).collect();
            assert!(told.concat().contains(words), "{before}: {told:#?}");
            let processes = processes_in(&bench.path("."));
            assert!(processes.is_empty(), "{before}: {processes:?}");
            // Of a run that failed its directory is kept, for its author to look at, and what was found, in the store; of
            // others nothing.
            let names = fs::read_dir(bench.path("."))
                .expect("a directory")
                .flatten();
            let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
            let foreign = names.filter(|name| {
                let is_kept =
                    *expected != 0 && (name.starts_with("tristack-check-") || name == "store");
                name != "mydem" && name != "programs" && !is_kept
            });
            assert_eq!(
                foreign.collect::<Vec<_>>(),
                Vec::<String>::new(),
                "{before}"
            );
        });
}

/// The processes that work in a directory below `place`.
fn processes_in(place: &Path) -> Vec<String> {
    let place = place.canonicalize().expect("it is there");
    let processes = fs::read_dir("/proc").expect("processes").flatten();
    let works_there = |process: &fs::DirEntry| {
        let directory = fs::read_link(process.path().join("cwd"));
        directory.is_ok_and(|directory| directory.starts_with(&place))
    };
    let found = processes.filter(works_there);
    found
        .map(|process| process.file_name().to_string_lossy().into_owned())
        .collect()
}

/// The commands of docs/your-own-code.md, word by word: those in blocks marked `sh`.
#[test]
fn the_page_on_your_own_code_can_be_followed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(root.join("docs/your-own-code.md")).expect("the page");
    let blocks = page.split("```sh\n").skip(1);
    let commands = blocks.filter_map(|rest| rest.split("```").next());
    let commands: Vec<&str> = commands.flat_map(str::lines).collect();
    assert!(commands.len() >= 4, "{commands:?}");
    let bench = Bench::with_system_programs();
    std::os::unix::fs::symlink(root.join("examples"), bench.path("examples")).expect("a link");
    for command in commands {
        let output = match command.strip_prefix("tristack ") {
            Some(line) => bench.tristack(line).output().expect("it runs"),
            None => {
                let mut words = command.split_whitespace();
                let program = words.next().expect("a program");
                let mut other = std::process::Command::new(program);
                other.args(words).current_dir(bench.path("."));
                other.output().expect("it runs")
            }
        };
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command}: {error}");
    }
}
