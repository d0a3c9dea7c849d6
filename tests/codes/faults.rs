//! Codes that crash, hang or lie: each becomes a `failed` verdict with everything needed to look into
//! it, and nothing else is lost.

use crate::common;
use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, json_rows, save_recording, standard_error, wait_for};
use std::fs;
use std::process::Stdio;
use std::time::Duration;
use tristack::code::{Code, ParameterFormat, SettledCode, Task};
use tristack::dem::compress_stack;
use tristack::model::{Case, Stack, sha256_hex};
use tristack::runs::Recorded;
use tristack::study::yield_force::{MIDDLE_RUN, SHORT_RAMP_RUN, plan};

const CROSSCHECK: &str = "crosscheck --codes yade --format json";

/// The slowest run of one stack of the quick profile.
fn is_victim(case: &Case) -> bool {
    let stack = &case.stack;
    stack.floor_friction == 0.2 && stack.stiffness == 100.0 && case.protocol.wall_speed < 2e-5
}

struct Outcome {
    status: Option<i32>,
    rows: Vec<serde_json::Value>,
    message: String,
}

impl Outcome {
    fn count(&self, verdict: &str) -> usize {
        self.rows
            .iter()
            .filter(|row| row["verdict"] == verdict)
            .count()
    }
}

fn crosscheck(bench: &Bench, options: &str) -> Outcome {
    let mut command = bench.tristack(&format!("{CROSSCHECK} {options}"));
    let output = command.output().expect("it runs");
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    Outcome {
        status: output.status.code(),
        rows,
        message: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// A crosscheck in which one run is disturbed; checks that exactly its row has failed, that the message
/// names code, case and run directory, and that everything else agrees.
fn with_victim(disturbance: impl Fn() -> Disturbance, options: &str, expected: &[&str]) {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if is_victim(case) {
            disturbance()
        } else {
            Disturbance::None
        }
    });
    let outcome = crosscheck(&bench, options);
    assert_eq!(outcome.status, Some(3), "{}", outcome.message);
    assert_eq!(outcome.count("failed"), 1, "{}", outcome.message);
    assert_eq!(outcome.count("agrees"), 17, "{}", outcome.message);
    let named = [
        "yade failed on mu = 0.2, stiffness = 100",
        "run directory: ",
    ];
    for part in named.iter().chain(expected) {
        assert!(
            outcome.message.contains(part),
            "{} lacks {part}",
            outcome.message
        );
    }
    let directory = outcome
        .message
        .split("run directory: ")
        .nth(1)
        .expect("a directory");
    let directory = directory.lines().next().expect("a line");
    let evidence = format!("{directory}/parameters.json");
    assert!(fs::exists(evidence).expect("readable"), "{directory}");
}

fn yade() -> SettledCode {
    let code = Code::named("yade").expect("it is built in");
    code.as_declared().expect("nothing is left out")
}

#[test]
fn undisturbed_replay_agrees_everywhere() {
    let bench = Bench::with_system_programs();
    let recorded = replay::install(&bench, |_| Disturbance::None);
    assert_eq!(recorded, 90);
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert_eq!(outcome.count("agrees"), 18);
    let replayed = |row: &serde_json::Value| row["version"] == "replayed";
    assert!(outcome.rows.iter().all(replayed));
}

#[test]
fn a_crash_fails_one_row_and_the_rest_of_the_process_is_made_up_for() {
    let crash = || Disturbance::Instead("echo 'Segmentation fault, sorry' >&2; kill -SEGV $$");
    with_victim(
        crash,
        "",
        &["signal: 11", "stderr.txt: Segmentation fault, sorry"],
    );
}

#[test]
fn an_error_status_fails_one_row() {
    let stop = || Disturbance::Instead("echo 'no such material' >&2; exit 7");
    with_victim(
        stop,
        "",
        &["exit status: 7", "stderr.txt: no such material"],
    );
}

#[test]
fn a_case_that_is_skipped_fails_alone() {
    with_victim(
        || Disturbance::Instead("echo skipped"),
        "",
        &["delivered no series for this case and went on"],
    );
}

#[test]
fn a_hang_is_killed_at_the_time_limit() {
    let hang = || Disturbance::Instead("echo waiting; sleep 600");
    with_victim(
        hang,
        "--time-limit 1",
        &["no series after 1s", "stdout.txt: waiting"],
    );
}

#[test]
fn a_truncated_series_fails_one_row() {
    let cut = |series: String| series.lines().take(100).collect::<Vec<_>>().join("\n");
    with_victim(
        move || Disturbance::Change(cut),
        "",
        &["the series has 99 rows, but must have"],
    );
}

#[test]
fn a_row_cut_in_the_middle_fails_one_row() {
    let cut = |series: String| series[..series.len() / 2].to_owned();
    with_victim(
        move || Disturbance::Change(cut),
        "",
        &["the series is not usable: row "],
    );
}

#[test]
fn garbled_text_fails_one_row() {
    let garble = |series: String| series.replacen("0.", "\u{fffd}x", 40);
    with_victim(
        move || Disturbance::Change(garble),
        "",
        &["the series is not usable: row "],
    );
}

#[test]
fn a_value_that_is_not_a_number_fails_one_row_and_is_named() {
    let poison = |series: String| {
        let mut lines: Vec<String> = series.lines().map(str::to_owned).collect();
        let mut cells: Vec<String> = lines[50].split(',').map(str::to_owned).collect();
        cells[2] = "NaN".to_owned();
        lines[50] = cells.join(",");
        lines.join("\n")
    };
    with_victim(
        move || Disturbance::Change(poison),
        "",
        &["row 50", "`wall_force` is NaN"],
    );
}

#[test]
fn wrong_columns_fail_one_row() {
    let rename = |series: String| series.replacen("wall_force", "force", 1);
    with_victim(
        move || Disturbance::Change(rename),
        "",
        &["the columns are `step,time,force"],
    );
}

#[test]
fn rows_at_other_steps_than_planned_fail_one_row() {
    let shift = |series: String| {
        let mut lines: Vec<&str> = series.lines().collect();
        lines.swap(10, 11);
        lines.join("\n")
    };
    with_victim(
        move || Disturbance::Change(shift),
        "",
        &["row 10 is at step"],
    );
}

#[test]
fn a_code_that_is_wrong_by_a_thousandth_differs() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if case.stack.floor_friction == 0.3 {
            Disturbance::Change(|series| scale_wall_force(&series, 1.001))
        } else {
            Disturbance::None
        }
    });
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    assert_eq!(outcome.count("differs"), 3);
    assert_eq!(outcome.count("agrees"), 15);
}

fn scale_wall_force(series: &str, factor: f64) -> String {
    change_rows(series, |cells| {
        let force: f64 = cells[2].parse().expect("a number");
        cells[2] = (force * factor).to_string();
    })
}

/// Applies `change` to the cells of every row but the header.
fn change_rows(series: &str, change: impl Fn(&mut Vec<String>)) -> String {
    let lines = series.lines().enumerate().map(|(index, line)| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if index > 0 {
            change(&mut cells);
        }
        cells.join(",")
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// A crosscheck in which all series of stiffness 1e4 are changed.
fn with_changed_stiff_rows(change: fn(String) -> String) -> Outcome {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if case.stack.stiffness == 1e4 {
            Disturbance::Change(change)
        } else {
            Disturbance::None
        }
    });
    crosscheck(&bench, "")
}

#[test]
fn a_code_that_never_yields_is_no_pass() {
    let outcome =
        with_changed_stiff_rows(|series| change_rows(&series, |cells| cells[2] = cells[1].clone()));
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    assert_eq!(outcome.count("no-yield"), 6);
    assert!(
        outcome.message.contains("no slip followed by a peak"),
        "{}",
        outcome.message
    );
}

#[test]
fn a_code_without_floor_friction_in_its_series_breaks_the_balance_of_forces() {
    let outcome = with_changed_stiff_rows(|series| {
        change_rows(&series, |cells| {
            for column in [13, 15] {
                cells[column] = "0.0".to_owned();
            }
        })
    });
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    assert_eq!(outcome.count("differs"), 6);
    assert!(
        outcome.message.contains("no onset of slip")
            && outcome.message.contains("breaks the balance of forces"),
        "{}",
        outcome.message
    );
}

#[test]
fn a_friction_wrong_by_a_ten_thousandth_differs_and_is_named() {
    for factor in [1.0001, 0.9999] {
        let bench = Bench::with_system_programs();
        replay::install(&bench, |case| {
            if case.stack.floor_friction != 0.3 || case.stack.stiffness != 100.0 {
                return Disturbance::None;
            }
            let mut wrong = *case;
            wrong.stack.floor_friction *= factor;
            let series = compress_stack(&wrong, || true).expect("a finite series");
            Disturbance::Series(String::from_utf8(series.to_csv()).expect("text"))
        });
        let outcome = crosscheck(&bench, "");
        assert_eq!(outcome.status, Some(2), "{}", outcome.message);
        assert_eq!(outcome.count("differs"), 1, "{}", outcome.message);
        assert_eq!(outcome.count("agrees"), 17);
        let named = "the floor slides at |t|/n = ";
        assert!(outcome.message.contains(named), "{}", outcome.message);
    }
}

#[test]
fn a_friction_that_is_hardly_wrong_is_no_agreement() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if case.stack.floor_friction != 0.3 || case.stack.stiffness != 100.0 {
            return Disturbance::None;
        }
        let mut wrong = *case;
        wrong.stack.floor_friction *= 1.0 + 5e-8;
        let series = compress_stack(&wrong, || true).expect("a finite series");
        Disturbance::Series(String::from_utf8(series.to_csv()).expect("text"))
    });
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(4), "{}", outcome.message);
    assert_eq!(outcome.count("inconclusive"), 1);
}

/// The two have the same steps and the same wall, so that nothing but the numbers tells them apart.
#[test]
fn a_series_of_the_same_stack_after_another_preparation_is_noticed() {
    let stack = Stack::paper(0.3, 100.0);
    let cases = plan(&yade(), &stack, yade().convention()).cases;
    let (middle, short) = (cases[MIDDLE_RUN], cases[SHORT_RAMP_RUN]);
    for (victim, other) in [(middle, short), (short, middle)] {
        let bench = Bench::with_system_programs();
        replay::install(&bench, |_| Disturbance::None);
        let path = |case: &Case| {
            let content = ParameterFormat::Json.content(&case.parameters());
            bench.path(&format!("replay/{}.csv", sha256_hex(content.as_bytes())))
        };
        fs::copy(path(&other), path(&victim)).expect("a series of another case");
        let outcome = crosscheck(&bench, "");
        assert_eq!(outcome.status, Some(4), "{}", outcome.message);
        assert_eq!(outcome.count("inconclusive"), 1);
        assert_eq!(outcome.count("agrees"), 17);
        assert!(outcome.message.contains("gave the same bits"));
    }
}

#[test]
fn a_code_that_does_not_end_after_its_last_case_costs_nothing_but_time() {
    let bench = Bench::with_system_programs();
    replay::install_with_ending(&bench, "sleep 600");
    let outcome = crosscheck(&bench, "--time-limit 1");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert_eq!(outcome.count("agrees"), 18);
}

#[test]
fn another_program_of_the_same_version_meets_no_old_results() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    assert_eq!(crosscheck(&bench, "").status, Some(0));
    replay::install_with_ending(&bench, "# rebuilt");
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert!(
        !outcome.message.contains("there already"),
        "{}",
        outcome.message
    );
}

#[test]
fn output_of_an_earlier_run_does_not_pass_for_that_of_a_later_one() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let case = bench.path("case.json");
    fs::write(&case, replay::first_case().to_json()).expect("a case");
    let line = format!("simulate --code yade --out run --case {}", case.display());
    bench.tristack(&line).assert().code(0);
    assert!(bench.path("run/series.csv").exists());
    bench.install("yade", "exit 0");
    bench.tristack(&line).assert().code(3).stdout("");
    assert!(bench.path("run/case.json").exists());
    for name in ["series.csv", "summary.json"] {
        assert!(
            !bench.path("run").join(name).exists(),
            "{name} is left from the first run"
        );
    }
}

#[test]
fn a_deck_that_was_edited_in_a_run_directory_is_not_used_again() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let case = plan(&yade(), &Stack::paper(0.3, 100.0), yade().convention()).cases[0];
    fs::write(bench.path("case.json"), case.to_json()).expect("a case");
    let line = "simulate --code yade --out run --case case.json";
    bench.tristack(line).assert().code(0);
    let decks = ["run/stack.py", "run/contacts.py", "run/parameters.json"];
    let read = || decks.map(|deck| fs::read(bench.path(deck)).expect("a deck"));
    let right = read();
    for deck in decks {
        fs::write(bench.path(deck), "friction = 0").expect("it can be written");
    }
    bench.tristack(line).assert().code(0);
    assert!(read() == right);
}

/// It went into the directory for temporary files of the machine.
#[test]
fn what_a_program_writes_beside_its_run_goes_with_it() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let program = bench.path("programs/yade");
    let script = fs::read_to_string(&program).expect("a script");
    let asked = "for directory in \"$@\"; do";
    assert!(script.contains(asked));
    let outside = format!(
        "{asked}\n    for above in .. \"$directory/..\"; do echo x > \"$above/outside\"; done"
    );
    fs::write(&program, script.replace(asked, &outside)).expect("it can be written");
    fs::write(bench.path("case.json"), replay::first_case().to_json()).expect("a case");
    let line = "simulate --code yade --case case.json";
    bench.tristack(line).assert().code(0);
    let names = ["case.json", "programs", "replay"];
    common::assert_only(&bench.path("."), &names);
}

#[test]
fn a_case_that_the_code_cannot_run_touches_nothing() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let native = "simulate --code native --mu 0.3 --stiffness 100 --out run";
    bench.tristack(native).assert().code(0);
    let line = "simulate --code yade --case run/case.json --out run";
    bench.tristack(line).assert().code(1).stdout("");
    for name in ["case.json", "series.csv", "summary.json"] {
        assert!(bench.path("run").join(name).exists(), "{name} is gone");
    }
}

#[test]
fn record_keeps_every_run_for_machines_without_the_code() {
    let bench = Bench::with_system_programs();
    let recorded = replay::install(&bench, |_| Disturbance::None) + replay::install_rings(&bench);
    let reference = bench.path("reference");
    fs::create_dir(&reference).expect("a directory");
    fs::write(reference.join("notes.txt"), "mine").expect("a file of somebody else");
    for set in ["probe", "crosscheck", "trajectories"] {
        let mut record = bench.tristack(&format!("record --codes yade --only {set}"));
        record
            .env("TRISTACK_REFERENCE", &reference)
            .assert()
            .code(0);
    }
    common::assert_only(&reference, &["notes.txt", "yade.csv", "yade.tar.gz"]);
    let runs = Recorded::new(&reference).recording(&Code::named("yade").expect("it is built in"));
    let runs = runs.expect("it is not damaged").runs;
    let with_series = runs.iter().filter(|run| run.series.is_some()).count();
    assert_eq!((runs.len(), with_series), (recorded + 3, 3));

    let machine = Bench::without_codes();
    let mut crosscheck = machine.tristack("crosscheck --format json");
    let output = crosscheck.env("TRISTACK_REFERENCE", &reference).output();
    let rows = json_rows(&String::from_utf8_lossy(&output.expect("it runs").stdout));
    let rows = rows.iter();
    let agreeing = rows.filter(|row| {
        row["code"] == "yade" && row["source"] == "recorded" && row["verdict"] == "agrees"
    });
    assert_eq!(agreeing.count(), 18);
}

#[test]
fn record_keeps_the_old_recordings_if_a_run_fails() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| {
        if is_victim(case) {
            Disturbance::Instead("exit 7")
        } else {
            Disturbance::None
        }
    });
    let reference = bench.path("reference");
    save_recording(&reference, yade().name(), |_| ());
    let files = || ["yade.csv", "yade.tar.gz"].map(|name| fs::read(reference.join(name)).ok());
    let old = files();
    let mut record = bench.tristack("record --codes yade");
    record
        .env("TRISTACK_REFERENCE", &reference)
        .assert()
        .code(3);
    assert!(files() == old);
    common::assert_only(&reference, &["yade.csv", "yade.tar.gz"]);
}

#[test]
fn nothing_is_started_after_an_interrupt() {
    let bench = Bench::with_system_programs();
    let starts = bench.path("starts");
    for program in ["lmp", "liggghts"] {
        bench.install(
            program,
            &format!(
                "case \"$*\" in -help|*/dev/null*) exit 0;; esac; echo $$ >> {}; sleep 600",
                starts.display()
            ),
        );
    }
    let child = bench
        .process("crosscheck --codes liggghts,lammps --jobs 2")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let both = || {
        fs::read_to_string(&starts)
            .ok()
            .filter(|text| text.lines().count() == 2)
    };
    wait_for(both);
    send_interrupt(child.id());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(
        fs::read_to_string(&starts)
            .expect("the log")
            .lines()
            .count(),
        2
    );
    common::assert_only(&bench.path("store/work"), &[]);
}

/// The version under which `bench` lists YADE.
fn version_of_yade(bench: &Bench) -> String {
    let list = json_rows(&common::standard_output(
        &mut bench.tristack("codes --format json"),
    ));
    let yade = list.iter().find(|code| code["code"] == "yade");
    let version = yade.expect("yade")["version"].as_str();
    version.expect("a version").to_owned()
}

/// Recorded runs do not stand in for it, and no command takes it for one that is not installed.
fn assert_broken(script: &str, reason: &str) {
    let bench = Bench::with_system_programs();
    bench.install("yade", script);
    let lines = [
        "codes",
        "crosscheck --codes yade",
        "simulate --code yade --mu 0.3 --stiffness 100",
        "probe --codes yade",
    ];
    // Together: each may wait for the time limit of a question.
    std::thread::scope(|threads| {
        for line in lines {
            threads.spawn(|| assert_told(&bench, line, reason));
        }
        assert_eq!(version_of_yade(&bench), "broken");
    });
}

fn assert_told(bench: &Bench, line: &str, reason: &str) {
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{line}: {message}");
    for part in ["programs/yade is installed, but broken: ", reason] {
        assert!(message.contains(part), "{line}: {message} lacks {part}");
    }
    assert!(!message.contains("not installed"), "{line}: {message}");
}

#[test]
fn a_code_that_dies_of_the_question_for_its_version_is_broken() {
    assert_broken("kill -SEGV $$", "it ended with signal: 11");
}

#[test]
fn a_code_that_hangs_at_the_question_for_its_version_is_broken() {
    assert_broken("sleep 600", "it gave no answer within 30s");
}

#[test]
fn a_question_for_the_version_leaves_nothing_behind() {
    let bench = Bench::with_system_programs();
    let homes = bench.path("homes");
    let script = format!(
        "echo \"$HOME\" >> '{}'; touch \"$HOME/a\" b; echo Yade version: 1.2",
        homes.display()
    );
    bench.install("yade", &script);
    assert_eq!(version_of_yade(&bench), "1.2");
    let homes = fs::read_to_string(homes).expect("the log");
    for home in homes.lines() {
        assert!(
            home.starts_with(&bench.path("").display().to_string()),
            "{home}"
        );
        assert!(!fs::exists(home).expect("readable"), "{home}");
    }
}

#[test]
fn a_question_for_the_version_that_is_killed_is_put_again() {
    let bench = Bench::with_system_programs();
    let asked = bench.path("asked");
    let script = format!(
        "[ -e '{0}' ] || {{ echo > '{0}'; kill -KILL $$; }}; echo Yade version: 1.2",
        asked.display()
    );
    bench.install("yade", &script);
    assert_eq!(version_of_yade(&bench), "1.2");
}

#[test]
fn a_liggghts_log_with_a_value_that_is_not_a_number_fails() {
    let bench = Bench::with_system_programs();
    let log = " step time wall_for x1 y1 theta1 x2 y2 theta2 x3 y3 theta3 floor_n2 floor_t2 floor_n3 floor_t3\n0 0 nan 0 2.7 0 1 0.9 0 -1 0.9 0 0.1 -0.02 0.1 0.02\nLoop time of 1";
    bench.install("liggghts", &format!("printf '%s\n' '{log}' > log.liggghts"));
    let line = "simulate --code liggghts --mu 0.3 --stiffness 100";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(3);
    assert!(
        message.contains("row 1 (step 0): `wall_force` is NaN"),
        "{message}"
    );
}

#[test]
fn what_was_finished_before_a_failure_is_not_run_again() {
    let bench = Bench::with_system_programs();
    let crash = || Disturbance::Instead("exit 7");
    replay::install(&bench, |case| {
        if is_victim(case) {
            crash()
        } else {
            Disturbance::None
        }
    });
    assert_eq!(crosscheck(&bench, "").status, Some(3));
    replay::install(&bench, |_| Disturbance::None);
    fs::remove_dir_all(bench.path("replay")).expect("the old replay");
    let recorded = replay::install(&bench, |_| Disturbance::None);
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    let reused = format!("{} of {recorded} runs are there already", recorded - 1);
    assert!(outcome.message.contains(&reused), "{}", outcome.message);
}

#[test]
fn a_damaged_run_in_the_store_is_computed_anew_with_a_warning() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    assert_eq!(crosscheck(&bench, "").status, Some(0));
    let shelf = fs::read_dir(bench.path("store/runs"))
        .expect("runs")
        .flatten()
        .next();
    let run = fs::read_dir(shelf.expect("a shelf").path())
        .expect("a shelf")
        .flatten()
        .next();
    fs::write(run.expect("a run").path().join("series.csv"), "step\n").expect("damage");
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.status, Some(0), "{}", outcome.message);
    assert!(
        outcome
            .message
            .contains("damaged run in the store, made anew"),
        "{}",
        outcome.message
    );
    assert!(!crosscheck(&bench, "").message.contains("damaged"));
}

#[test]
fn an_interrupt_stops_the_code_keeps_what_is_done_and_ends_with_130() {
    let bench = Bench::with_system_programs();
    let pid_file = bench.path("pid");
    replay::install(&bench, |case| {
        if is_victim(case) {
            Disturbance::Instead(". ../../../../../hang.sh")
        } else {
            Disturbance::None
        }
    });
    fs::write(
        bench.path("hang.sh"),
        format!("echo $$ > {}; sleep 600", pid_file.display()),
    )
    .expect("a script");
    let child = bench
        .process(CROSSCHECK)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    let code = wait_for(|| {
        fs::read_to_string(&pid_file)
            .ok()
            .filter(|text| text.ends_with('\n'))
    });
    send_interrupt(child.id());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(130));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(message.contains("interrupted with "), "{message}");
    let gone = || (!fs::exists(format!("/proc/{}", code.trim())).unwrap_or(true)).then_some(());
    wait_for(gone);
}

fn send_interrupt(process: u32) {
    send("-INT", process);
}

fn send(signal: &str, process: u32) {
    let status = std::process::Command::new("kill")
        .args([signal, &process.to_string()])
        .status();
    assert!(status.expect("kill runs").success());
}

#[test]
fn a_terminal_that_closes_ends_nothing_that_was_told_to_ignore_it() {
    let bench = Bench::with_system_programs();
    let started = bench.path("started");
    let script = format!(
        "[ \"$1\" = -help ] || {{ echo > '{}'; sleep 600; }}",
        started.display()
    );
    bench.install("lmp", &script);
    let tristack = bench.process("simulate --code lammps --mu 0.3 --stiffness 100");
    let mut command = std::process::Command::new("env");
    command
        .args(["--ignore-signal=HUP"])
        .arg(tristack.get_program());
    command
        .args(tristack.get_args())
        .current_dir(bench.path(""));
    command.envs(
        tristack
            .get_envs()
            .filter_map(|(name, value)| Some((name, value?))),
    );
    let mut child = command.stderr(Stdio::null()).spawn().expect("it starts");
    wait_for(|| fs::exists(&started).unwrap_or(false).then_some(()));
    for _ in 0..2 {
        send("-HUP", child.id());
    }
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(child.try_wait().expect("it can be watched"), None);
    send("-TERM", child.id());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
}

#[test]
fn simulate_reports_a_crash_with_the_last_lines_and_keeps_the_deck() {
    let bench = Bench::with_system_programs();
    bench.install("liggghts", "echo 'ERROR: Invalid model specified'; exit 1");
    let line = "simulate --code liggghts --mu 0.3 --stiffness 100 --out run";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(3).stdout("");
    assert!(
        message.contains("liggghts failed on mu = 0.3, stiffness = 100"),
        "{message}"
    );
    assert!(
        message.contains("stdout.txt: ERROR: Invalid model specified"),
        "{message}"
    );
    assert!(bench.path("run/stack.in").exists());
    assert!(!bench.path("run/series.csv").exists());
}

#[test]
fn a_code_that_succeeds_without_output_fails() {
    let bench = Bench::with_system_programs();
    bench.install("liggghts", "exit 0");
    let line = "simulate --code liggghts --mu 0.3 --stiffness 100";
    let message = standard_error(&mut bench.tristack(line));
    bench.tristack(line).assert().code(3);
    assert!(message.contains("cannot read log.liggghts"), "{message}");
}

/// A thousandth too much force at mu = 0.3, and one crash elsewhere.
fn wrong_and_crashed(bench: &Bench) {
    replay::install(bench, |case| {
        if is_victim(case) {
            Disturbance::Instead("exit 7")
        } else if case.stack.floor_friction == 0.3 {
            Disturbance::Change(|series| scale_wall_force(&series, 1.001))
        } else {
            Disturbance::None
        }
    });
}

#[test]
fn a_failure_hides_no_disagreement() {
    let bench = Bench::with_system_programs();
    wrong_and_crashed(&bench);
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.count("differs"), 3, "{}", outcome.message);
    assert_eq!(outcome.count("failed"), 1, "{}", outcome.message);
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
    let line = "sweep --code yade --mu 0.2:0.3:0.1 --stiffness 100";
    bench.tristack(line).assert().code(2);
}

#[test]
fn a_failure_hides_no_contradicted_probe() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::Instead("exit 7"));
    replay::install_probe(&bench, |mut row| {
        row.wall_force *= 1.001;
        row
    });
    let outcome = crosscheck(&bench, "");
    assert_eq!(outcome.count("failed"), 18, "{}", outcome.message);
    assert_eq!(outcome.status, Some(2), "{}", outcome.message);
}

#[test]
fn a_table_without_rows_has_its_header() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::Instead("exit 7"));
    let outcome = crosscheck(&bench, "--out results");
    assert_eq!(outcome.count("failed"), 18, "{}", outcome.message);
    let budget = fs::read_to_string(bench.path("results/budget.csv")).expect("a table");
    assert!(budget.starts_with("stiffness,mu,"), "{budget}");
    assert_eq!(budget.lines().count(), 1);
}

/// What a program says of itself is text, and nothing else, wherever it is shown.
#[test]
fn a_version_is_no_markup() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let program = bench.path("programs/yade");
    let script = fs::read_to_string(&program).expect("a script");
    let hostile = "1|2 <script>alert(1)</script> \u{202e}\u{1b}[31m&";
    fs::write(&program, script.replace("replayed", hostile)).expect("a script");
    let output = bench
        .tristack("crosscheck --codes yade --out results")
        .output()
        .expect("it runs");
    let page = fs::read_to_string(bench.path("results/crosscheck.md")).expect("a page");
    let terminal = String::from_utf8_lossy(&output.stdout);
    for text in [&page, &*terminal] {
        assert!(
            !text.contains('\u{202e}') && !text.contains('\u{1b}'),
            "{text}"
        );
    }
    assert!(!page.contains("<script>"), "{page}");
    let line = page.lines().find(|line| line.contains("script>alert"));
    let line = line.expect("the version is there");
    assert!(line.contains("1\\|2 &lt;script>"), "{line}");
}

#[test]
fn what_a_failing_program_prints_is_no_markup() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |case| match is_victim(case) {
        true => Disturbance::Instead("printf '<img src=x> \\033[2J \\342\\200\\256 x\\n'; exit 7"),
        false => Disturbance::None,
    });
    let outcome = crosscheck(&bench, "--out results");
    let page = fs::read_to_string(bench.path("results/crosscheck.md")).expect("a page");
    for text in [&page, &outcome.message] {
        assert!(text.contains("img src=x"), "{text}");
        assert!(
            !text.contains('\u{202e}') && !text.contains('\u{1b}'),
            "{text}"
        );
    }
    assert!(!page.contains("<img"), "{page}");
}
