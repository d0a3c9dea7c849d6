//! Runs that are made elsewhere: `tristack plan` and `tristack judge`.

use crate::common;
use crate::common::away::{native_result, result_of};
use crate::common::{Bench, installed, json, standard_error, standard_output};
use nix::sys::stat::Mode;
use nix::unistd::mkfifo;
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;
use tristack::code::{Code, PlannedRun, PlannedTask};
use tristack::study::Plan;

/// A code that is nowhere installed, with the convention of the native one, whose series stand in for its own.
const MANIFEST: &str = r#"
schema = 1
name = "standin"
seconds = { start = 0.5, step = 1e-6 }
[program]
command = ["standin", "-in", "{deck}", "it's a word"]
environment = { STANDIN_MODE = "a b" }
logs = ["log.txt"]
[tasks]
stack = { files = ["stack.deck", "common.deck"] }
motion = { files = ["motion.deck", "common.deck"] }
[convention]
pair = { torque_arm = 0.0 }
floor = { torque_arm = 0.0 }
coulomb_operand = "spring-and-damping"
sliding_spring = "frozen"
history_update = "rotated"
tensile_force = "may-pull"
moment_of_inertia = 0.5
[integration]
velocity_lag = 0.5
"#;
const ONE_STACK: &str = "--mu 0.3 --stiffness 100";

/// A bench with the folder of that code.
fn bench() -> Bench {
    let bench = Bench::without_codes();
    let folder = bench.path("standin");
    fs::create_dir(&folder).expect("a folder");
    for (name, content) in [
        ("code.toml", MANIFEST),
        ("stack.deck", "compress\n"),
        ("motion.deck", "move\n"),
        ("common.deck", "contacts\n"),
    ] {
        fs::write(folder.join(name), content).expect("a file");
    }
    bench
}

#[track_caller]
fn plan(bench: &Bench, options: &str) -> Plan {
    let line = format!("plan --code ./standin --out away {options}");
    bench.tristack(&line).assert().code(0);
    planned(bench)
}

fn planned(bench: &Bench) -> Plan {
    let plan = Plan::read(&bench.path("away")).expect("it is readable");
    plan.expect("it is there")
}

/// Puts results where there are none.
fn fill(bench: &Bench, plan: &Plan) {
    for run in &plan.runs {
        let path = result_of(bench, run);
        if !path.exists() {
            fs::write(path, native_result(run)).expect("a result");
        }
    }
}

/// A plan of both rounds with all results.
fn complete(bench: &Bench) -> Plan {
    fill(bench, &plan(bench, ONE_STACK));
    let plan = plan(bench, ONE_STACK);
    fill(bench, &plan);
    plan
}

/// Status, standard output and standard error.
fn judge(bench: &Bench, options: &str) -> (Option<i32>, String, String) {
    let mut command = bench.tristack(&format!("judge away {options}"));
    let output = command.output().expect("it runs");
    let [out, error] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("text"));
    (output.status.code(), out, error)
}

/// Everything below `directory`, with the content of files.
fn contents(directory: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(directory).expect("a directory").flatten() {
        match entry.path() {
            path if path.is_dir() => found.extend(contents(&path)),
            path => {
                let content = fs::read(&path).expect("a file");
                found.insert(path, content);
            }
        }
    }
    found
}

#[test]
fn results_of_a_plan_give_the_rows_of_a_live_crosscheck() {
    let bench = bench();
    let options = "--mu 0.2,0.3 --stiffness 100";
    let first = plan(&bench, options);
    assert!(first.continues);
    fill(&bench, &first);
    let second = plan(&bench, options);
    assert!(!second.continues && second.runs.len() > first.runs.len());
    fill(&bench, &second);
    let version = env!("CARGO_PKG_VERSION");
    let (status, rows, message) = judge(&bench, &format!("--code-version {version} --format csv"));
    assert_eq!(status, Some(0), "{message}");
    let line = format!("sweep --code native --history-update rotated {options} --format csv");
    let live = bench.tristack(&line).output().expect("it runs").stdout;
    let live = String::from_utf8(live).expect("text");
    let as_live = rows
        .replace("standin", "native")
        .replace(",files,", ",live,");
    assert_eq!(rows.matches(",files,").count(), 2);
    assert_eq!(as_live, live);
    let all = second.runs.len();
    let said = format!("{all} of {all} results are there and usable, 0 are missing, 0 are");
    assert!(message.contains(&said), "{message}");
}

/// Each line of start.txt by a shell, as somebody would who has the code and not tristack.
#[test]
fn lammps_run_by_hand_from_a_plan_gives_the_rows_of_a_live_crosscheck() {
    let lammps = Code::named("lammps").expect("it is built in");
    if installed(&[lammps]).is_empty() {
        return;
    }
    let bench = Bench::with_system_programs();
    let options = "--mu 0.2,0.3 --stiffness 100";
    for _ in 0..2 {
        let line = format!("plan --code lammps --out away {options}");
        bench.tristack(&line).assert().code(0);
        let list = fs::read_to_string(bench.path("away/start.txt")).expect("a list");
        for line in list.lines() {
            let mut shell = Command::new("sh");
            let status = shell
                .args(["-c", line])
                .current_dir(bench.path("away"))
                .status();
            assert!(status.expect("a shell").success(), "{line}");
        }
    }
    let crosscheck = format!("crosscheck --codes lammps {options} --format json");
    let live = bench.tristack(&crosscheck).output().expect("it runs");
    let mut live = json(&String::from_utf8(live.stdout).expect("text"))["rows"].take();
    let judged = bench
        .tristack("judge away --format json")
        .output()
        .expect("it runs");
    let message = String::from_utf8_lossy(&judged.stderr);
    assert_eq!(judged.status.code(), Some(0), "{message}");
    let judged = json(&String::from_utf8(judged.stdout).expect("text"))["rows"].take();
    for row in live.as_array_mut().expect("rows") {
        assert_eq!(row["verdict"], "agrees");
        row["source"] = "files".into();
        row["version"] = "unknown".into();
    }
    assert_eq!(judged, live);
    assert_eq!(judged.as_array().map(Vec::len), Some(2));
}

/// A program that keeps what it was given gets the same files from a live run.
#[test]
fn a_planned_run_is_given_the_bytes_of_a_live_one() {
    let bench = bench();
    let plan = plan(&bench, ONE_STACK);
    bench.install("standin", "exit 1\n");
    let stack = plan.runs.iter().find_map(|run| match &run.task {
        PlannedTask::Stack(case) => Some((run, case)),
        PlannedTask::Motion(_) => None,
    });
    let (run, case) = stack.expect("a compression");
    fs::write(bench.path("case.json"), case.to_json()).expect("a case");
    let line = "simulate --code ./standin --case case.json --out live";
    bench.tristack(line).assert().code(3);
    for name in run.files.keys() {
        let planned = fs::read(bench.path("away").join(&run.directory).join(name));
        let live = fs::read(bench.path("live").join(name));
        assert_eq!(planned.expect(name), live.expect(name), "{name}");
    }
    assert_eq!(
        run.files.keys().collect::<Vec<_>>(),
        ["common.deck", "stack.deck", "task.json"]
    );
    assert_eq!(run.command, ["standin", "-in", "stack.deck", "it's a word"]);
}

#[test]
fn lists_start_what_has_no_result_and_shells_understand_them() {
    let bench = bench();
    let first = plan(&bench, ONE_STACK);
    let read = |name: &str| fs::read_to_string(bench.path("away").join(name)).expect("a list");
    assert_eq!(read("start.txt").lines().count(), first.runs.len());
    let script = "printf '%s|' \"$STANDIN_MODE\" \"$@\" > said.txt\n";
    bench.install("standin", script);
    let path = format!("{}:/usr/bin:/bin", bench.path("programs").display());
    let started = |list: &str| {
        let line = read(list).lines().next_back().expect("a line").to_owned();
        let mut shell = Command::new("sh");
        shell.args(["-c", &line]).env("PATH", &path);
        let status = shell.current_dir(bench.path("away")).status();
        assert!(status.expect("a shell").success(), "{line}");
        let run = first.runs.iter().find(|run| line.contains(&run.directory));
        let run = run.expect("the run of the line");
        let said = bench.path("away").join(&run.directory).join("said.txt");
        let said = fs::read_to_string(said).expect("it was started in its directory");
        let deck = &run.command[2];
        assert_eq!(said, format!("a b|-in|{deck}|it's a word|"));
    };
    started("start.txt");
    started("parallel.txt");
    let array = Command::new("sh")
        .arg("array.slurm")
        .env("SLURM_ARRAY_TASK_ID", "1")
        .env("PATH", &path)
        .current_dir(bench.path("away"))
        .status();
    assert!(array.expect("a shell").success());
    let of_array = contents(&bench.path("away"));
    let said = of_array.keys().filter(|path| path.ends_with("said.txt"));
    assert_eq!(said.count(), first.runs.len());
    fill(&bench, &first);
    let left = plan(&bench, ONE_STACK).runs.len() - first.runs.len();
    assert_eq!(read("start.txt").lines().count(), left);
}

/// Slurm makes no directory for what a task prints: without one, no task would start.
fn assert_slurm_can_write(bench: &Bench) {
    let array = fs::read_to_string(bench.path("away/array.slurm")).expect("a script");
    let path = array.split("#SBATCH --output=").nth(1).expect("an option");
    let path = path.lines().next().expect("a path");
    let directory = bench.path("away").join(path);
    assert!(directory.parent().is_some_and(Path::is_dir), "{path}");
}

#[test]
fn planning_again_adds_and_changes_nothing_that_is_there() {
    let bench = bench();
    complete(&bench);
    let line = format!("plan --code ./standin --out away {ONE_STACK}");
    let said = standard_output(&mut bench.tristack(&line));
    assert!(
        said.contains("to do: 0 runs, 0 steps; every run has a result"),
        "{said}"
    );
    let before = contents(&bench.path("away"));
    plan(&bench, ONE_STACK);
    assert!(contents(&bench.path("away")) == before);
    let wider = plan(&bench, "--mu 0.2 --stiffness 100");
    assert_eq!(wider.rows.len(), 2);
    let after = contents(&bench.path("away"));
    for (path, content) in before {
        let is_list = path.parent() == Some(&bench.path("away"));
        assert!(is_list || after[&path] == content, "{}", path.display());
    }
}

/// Runs are planned by the arms, and the arms are measured: three rounds.
#[test]
fn a_convention_that_is_left_out_is_measured_before_runs_are_planned() {
    let bench = bench();
    let manifest = bench.path("standin/code.toml");
    let declared = MANIFEST.split("[convention]").next().expect("a beginning");
    fs::write(manifest, declared).expect("a manifest");
    let stacks = |plan: &Plan| {
        let runs = plan.runs.iter();
        runs.filter(|run| matches!(run.task, PlannedTask::Stack(_)))
            .count()
    };
    for _ in 0..2 {
        let plan = plan(&bench, ONE_STACK);
        assert!(plan.continues && stacks(&plan) == 0);
        assert_slurm_can_write(&bench);
        let (status, _, message) = judge(&bench, "");
        assert_eq!(status, Some(3), "{message}");
        assert!(message.contains("not planned yet: plan again"), "{message}");
        fill(&bench, &plan);
    }
    let plan = plan(&bench, ONE_STACK);
    assert!(!plan.continues && stacks(&plan) == 5);
    fill(&bench, &plan);
    let (status, rows, message) = judge(&bench, "--format csv");
    assert_eq!(status, Some(0), "{message}");
    assert!(rows.trim_end().ends_with(",agrees"), "{rows}");
    assert!(
        message.contains("standin: measured, because its manifest leaves it out"),
        "{message}"
    );
}

#[test]
fn what_comes_in_is_judged_and_the_rest_is_missing() {
    let bench = bench();
    let plan = plan(&bench, ONE_STACK);
    let complaint = bench
        .path("away")
        .join(&plan.runs[1].directory)
        .join("stderr.txt");
    fs::write(&complaint, "sh: 1: standin: not found\n").expect("it can be written");
    let (status, rows, message) = judge(&bench, "--format csv");
    assert_eq!(status, Some(3), "{message}");
    assert!(
        message.contains("stderr.txt: sh: 1: standin: not found"),
        "{message}"
    );
    assert!(
        rows.contains(",files,") && rows.trim_end().ends_with(",missing"),
        "{rows}"
    );
    let all = plan.runs.len();
    assert!(message.contains(&format!(
        "0 of {all} results are there and usable, {all} are missing"
    )));
    assert!(message.contains("result.csv is not there yet"), "{message}");
    fill(&bench, &plan);
    // The yield force is there, and the convention is not measured yet.
    let (status, rows, message) = judge(&bench, "--format csv");
    assert_eq!(status, Some(4), "{message}");
    assert!(rows.trim_end().ends_with(",inconclusive"), "{rows}");
    assert!(message.contains("plan again"), "{message}");
    assert!(
        !bench.path("store").exists(),
        "nothing is kept of what others made"
    );
}

/// Changes the result of the run at `index` of the compressions, and returns status and messages of the judgement.
fn with_result(bench: &Bench, index: usize, change: impl FnOnce(&Path)) -> (Option<i32>, String) {
    let plan = complete(bench);
    let stacks = |run: &&PlannedRun| matches!(run.task, PlannedTask::Stack(_));
    let run = plan.runs.iter().filter(stacks).nth(index).expect("a run");
    change(&result_of(bench, run));
    let (status, rows, message) = judge(bench, "--format csv");
    assert!(!rows.contains("agrees"), "{rows}");
    (status, message)
}

fn change_text(path: &Path, change: impl FnOnce(String) -> String) {
    let text = fs::read_to_string(path).expect("a result");
    fs::write(path, change(text)).expect("it can be written");
}

#[test]
fn a_result_that_ends_too_soon_is_incomplete_and_a_garbled_one_malformed() {
    let lines = |text: String, count: usize| -> String {
        let kept = text.lines().take(count);
        kept.map(|line| line.to_owned() + "\n").collect()
    };
    let cut_in_a_row = |text: String| text[..text.len() - 30].to_owned();
    type Change = Box<dyn Fn(String) -> String>;
    let cases: [(Change, &[&str]); 4] = [
        (
            Box::new(move |text| lines(text, 20)),
            &[
                "missing: standin",
                "result.csv is not complete",
                "has 19 rows, but must have",
            ],
        ),
        (
            Box::new(cut_in_a_row),
            &["missing: standin", "result.csv is not complete"],
        ),
        (
            Box::new(|text| text.replacen("wall_force", "f", 1)),
            &[
                "failed: standin",
                "result.csv: the columns are `step,time,f,",
            ],
        ),
        (
            Box::new(|text| {
                let third = text.lines().nth(3).expect("a row").to_owned();
                text.replace(&third, &third.replace(',', ",x"))
            }),
            &["failed: standin", "result.csv: row 3: "],
        ),
    ];
    for (change, expected) in cases {
        let bench = bench();
        let (status, message) = with_result(&bench, 2, |path| change_text(path, change));
        assert_eq!(status, Some(3), "{message}");
        for words in expected {
            assert!(message.contains(words), "{words} in {message}");
        }
        assert!(
            message.contains("1 are incomplete or malformed"),
            "{message}"
        );
    }
}

#[test]
fn a_result_that_is_no_regular_file_of_bounded_size_is_refused_and_not_waited_for() {
    type Put = fn(&Path);
    let ways: [(Put, &str); 4] = [
        (
            |path| mkfifo(path, Mode::S_IRWXU).expect("a pipe"),
            "a named pipe",
        ),
        (
            |path| symlink("/dev/zero", path).expect("a link"),
            "a symbolic link",
        ),
        (
            |path| fs::create_dir(path).expect("a directory"),
            "a directory",
        ),
        (
            |path| {
                let file = fs::File::create(path).expect("a file");
                file.set_len(1 << 40).expect("a sparse file");
            },
            "more than 268435456 bytes",
        ),
    ];
    for (put, words) in ways {
        let bench = bench();
        let (status, message) = with_result(&bench, 0, |path| {
            fs::remove_file(path).expect("it was there");
            put(path);
        });
        assert_eq!(status, Some(3), "{message}");
        assert!(message.contains(words), "{words} in {message}");
    }
}

#[test]
fn a_changed_deck_or_parameter_file_takes_its_result_away() {
    for name in ["stack.deck", "task.json"] {
        let bench = bench();
        let (status, message) = with_result(&bench, 1, |path| {
            change_text(&path.with_file_name(name), |text| text + "\n");
        });
        assert_eq!(status, Some(3), "{message}");
        let said = format!("{name} is not as the plan wrote it");
        assert!(
            message.contains("missing: standin") && message.contains(&said),
            "{message}"
        );
    }
}

#[test]
fn a_folder_with_another_deck_has_to_be_planned_again_and_keeps_what_was_made() {
    let bench = bench();
    let old = complete(&bench);
    fs::write(bench.path("standin/stack.deck"), "compress otherwise\n").expect("a deck");
    let (status, _, message) = judge(&bench, "");
    assert_eq!(status, Some(3), "{message}");
    assert!(
        message.contains("with the files of today: the same tristack plan again"),
        "{message}"
    );
    let new = plan(&bench, ONE_STACK);
    let stacks = |plan: &Plan| -> Vec<String> {
        let runs = plan.runs.iter();
        let stacks = runs.filter(|run| matches!(run.task, PlannedTask::Stack(_)));
        stacks.map(|run| run.directory.clone()).collect()
    };
    assert_ne!(stacks(&old), stacks(&new));
    assert!(old.runs.iter().all(|run| result_of(&bench, run).exists()));
    fill(&bench, &new);
    assert_eq!(judge(&bench, "").0, Some(0));
}

#[test]
fn a_folder_that_has_moved_is_named_on_the_command_line() {
    let bench = bench();
    complete(&bench);
    fs::rename(bench.path("standin"), bench.path("moved")).expect("a new name");
    let (status, _, message) = judge(&bench, "");
    assert_eq!(status, Some(1), "{message}");
    assert!(
        message.contains("plan.json: its folder cannot be read; --code names another"),
        "{message}"
    );
    assert_eq!(judge(&bench, "--code ./moved").0, Some(0));
    let (status, _, message) = judge(&bench, "--code lammps");
    assert_eq!(status, Some(1), "{message}");
    assert!(
        message.contains("`code` is standin, but --code is lammps"),
        "{message}"
    );
}

#[test]
fn tables_are_written_as_a_crosscheck_writes_them() {
    let bench = bench();
    complete(&bench);
    let (status, _, message) = judge(&bench, "--out verdict --code-version 7.2");
    assert_eq!(status, Some(0), "{message}");
    let tables = [
        "budget.csv",
        "crosscheck.csv",
        "crosscheck.json",
        "crosscheck.md",
    ];
    common::assert_only(&bench.path("verdict"), &tables);
    let page = fs::read_to_string(bench.path("verdict/crosscheck.md")).expect("a page");
    assert!(
        page.contains("tristack judge away --code-version 7.2"),
        "{page}"
    );
    let rows = fs::read_to_string(bench.path("verdict/crosscheck.csv")).expect("rows");
    assert!(rows.contains(",standin,7.2,files,"), "{rows}");
}

#[test]
fn what_is_wrong_with_a_command_is_said() {
    let bench = bench();
    complete(&bench);
    fs::create_dir(bench.path("mine")).expect("a directory");
    fs::write(bench.path("mine/notes.md"), "mine").expect("a file");
    for (line, expected) in [
        (
            "plan --code native --out other",
            "`--code` is native, but must be a code with a program",
        ),
        (
            "plan --code ./standin --out mine",
            "`notes.md`, which this command does not write",
        ),
        (
            "plan --code lammps --out away",
            "it is a plan for standin, and --code is lammps",
        ),
        ("judge mine", "mine/plan.json: there is none"),
        ("judge nowhere", "nowhere/plan.json: there is none"),
        (
            "judge away --out away",
            "`array.slurm`, which this command does not write",
        ),
    ] {
        let message = standard_error(&mut bench.tristack(line));
        bench.tristack(line).assert().code(1);
        assert!(message.contains(expected), "{line}: {message}");
    }
    let plan = bench.path("away/plan.json");
    let text = fs::read_to_string(&plan).expect("a plan");
    for (from, to, expected) in [
        (
            "tristack/plan/1",
            "tristack/plan/9",
            "`schema` is tristack/plan/9; accepted is tristack/plan/1",
        ),
        (
            "\"directory\": \"runs/",
            "\"directory\": \"../runs/",
            "accepted is one inside the directory",
        ),
        ("\"rows\"", "\"rwos\"", "unknown field `rwos`"),
        (
            "\"stiffness\": 100.0",
            "\"stiffness\": -1.0",
            "`stack.stiffness` is -1",
        ),
        (
            "\"wall_travel\": ",
            "\"wall_travel\": -",
            "`protocol.wall_travel` is -",
        ),
    ] {
        fs::write(&plan, text.replacen(from, to, 1)).expect("a plan");
        let (status, _, message) = judge(&bench, "");
        assert_eq!(status, Some(1), "{message}");
        assert!(
            message.contains("away/plan.json: ") && message.contains(expected),
            "{message}"
        );
    }
}

#[test]
fn rows_that_wait_for_results_are_skipped_tests() {
    let bench = bench();
    plan(&bench, ONE_STACK);
    let summary = standard_output(&mut bench.tristack("judge away --junit tests.xml --summary"));
    assert!(summary.contains("│ standin ┆"), "{summary}");
    let tests = fs::read_to_string(bench.path("tests.xml")).expect("the tests");
    assert_eq!(tests.matches("<testcase ").count(), 1, "{tests}");
    assert!(tests.contains("<skipped "), "{tests}");
}

/// Somebody who may write into the directory of a plan could let it write and read elsewhere.
#[test]
fn directories_of_runs_that_are_links_are_neither_written_nor_read_through() {
    let bench = bench();
    let plan = plan(&bench, ONE_STACK);
    let run = plan.runs.last().expect("a run");
    let directory = bench.path("away").join(&run.directory);
    let elsewhere = bench.path("elsewhere");
    fs::create_dir(&elsewhere).expect("a directory");
    let stack = directory
        .parent()
        .expect("the directory of the stack")
        .to_owned();
    for (linked, target) in [
        (&directory, elsewhere.clone()),
        (&stack, bench.path("elsewhere/stack")),
    ] {
        let kept = bench.path("kept");
        fs::rename(linked, &kept).expect("it moves");
        fs::create_dir_all(&target).expect("a directory");
        symlink(&target, linked).expect("a link");
        let refused = format!(
            "{}: it is a symbolic link; accepted is a directory that tristack plan has made",
            linked
                .strip_prefix(bench.path(""))
                .expect("below")
                .display()
        );
        let line = format!("plan --code ./standin --out away {ONE_STACK}");
        let mut command = bench.tristack(&line);
        let message = standard_error(&mut command);
        assert!(message.contains(&refused), "{message}");
        command.assert().code(1);
        assert_eq!(fs::read_dir(&target).expect("a directory").count(), 0);

        // What lies behind the link is no result of the plan.
        let behind = target.join(directory.strip_prefix(linked).expect("below it"));
        fs::create_dir_all(&behind).expect("a directory");
        for (name, content) in
            kept_files(&kept.join(directory.strip_prefix(linked).expect("below")))
        {
            fs::write(behind.join(name), content).expect("a file");
        }
        fs::write(behind.join(&run.result), native_result(run)).expect("a result");
        let mut command = bench.tristack("judge away");
        let message = standard_error(&mut command);
        assert!(message.contains(&refused), "{message}");
        command.assert().code(3);
        fs::remove_file(linked).expect("the link goes");
        fs::rename(&kept, linked).expect("it moves back");
        fs::remove_dir_all(&elsewhere).expect("it goes");
    }
}

/// Names and contents of the files in `directory`.
fn kept_files(directory: &Path) -> Vec<(std::ffi::OsString, Vec<u8>)> {
    let entries = fs::read_dir(directory).expect("a directory");
    let entries = entries.map(|entry| entry.expect("an entry"));
    entries
        .map(|entry| (entry.file_name(), fs::read(entry.path()).expect("a file")))
        .collect()
}

#[test]
fn a_row_or_a_run_that_stands_in_a_plan_twice_is_refused() {
    let bench = bench();
    plan(&bench, ONE_STACK);
    let path = bench.path("away/plan.json");
    let text = fs::read_to_string(&path).expect("a plan");
    for (list, words) in [
        (
            "rows",
            "`rows` has the row of mu 0.3, stiffness 100 twice (number 2)",
        ),
        ("runs", "`runs` has the run with the deck_hash "),
    ] {
        let mut document = json(&text);
        let entries = document[list].as_array_mut().expect("a list");
        entries.push(entries[0].clone());
        fs::write(&path, serde_json::to_vec_pretty(&document).expect("JSON")).expect("a file");
        let mut command = bench.tristack("judge away");
        let message = standard_error(&mut command);
        assert!(message.contains(words), "{message}");
        command.assert().code(1);
    }
}
