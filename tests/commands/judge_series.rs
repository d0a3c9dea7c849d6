//! `tristack judge --series`: a few series of one stack that nobody has planned.

use crate::common::{Bench, code_folder, json};
use serde_json::Value;
use std::fs;
use tristack::code::SettledCode;
use tristack::dem::compress_stack;
use tristack::model::{Arms, Case, ContactConvention, Stack};
use tristack::study::yield_force::{Measurement, plan};

const THREE: &str = "judge --series v4.csv v2.csv v1.csv";
const BARE: &str = "--mu 0.3 --stiffness 100";
const STACK: &str = "--mu 0.3 --stiffness 100 --pair-arm 0 --floor-arm 0";
const FURTHER: &str = "--coarse-step coarse.csv --short-ramp short.csv";
/// The runs of a measurement, in its order.
const FILES: [&str; 5] = ["v4.csv", "v2.csv", "v1.csv", "coarse.csv", "short.csv"];

fn measurement(convention: ContactConvention) -> Measurement {
    plan(&SettledCode::native(), &Stack::paper(0.3, 1e2), convention)
}

/// A bench with the five series of a measurement, and their first three speeds.
fn bench_with(convention: ContactConvention) -> (Bench, String) {
    with_series(Bench::without_codes(), convention)
}

fn with_series(bench: Bench, convention: ContactConvention) -> (Bench, String) {
    let cases = measurement(convention).cases;
    for (name, case) in FILES.iter().zip(&cases) {
        put(&bench, name, case);
    }
    let speeds = cases[..3].iter();
    let speeds: Vec<String> = speeds
        .map(|case| case.protocol.wall_speed.to_string())
        .collect();
    (bench, format!("--speeds {}", speeds.join(",")))
}

fn put(bench: &Bench, name: &str, case: &Case) {
    let series = compress_stack(case, || true).expect("a finite series");
    fs::write(bench.path(name), series.to_csv()).expect("a file");
}

fn change(bench: &Bench, name: &str, change: impl Fn(&[&str]) -> Vec<String>) {
    let text = fs::read_to_string(bench.path(name)).expect("a series");
    let lines = text.lines().enumerate().map(|(index, line)| match index {
        0 => line.to_owned(),
        _ => change(&line.split(',').collect::<Vec<_>>()).join(","),
    });
    let lines: Vec<String> = lines.map(|line| line + "\n").collect();
    fs::write(bench.path(name), lines.concat()).expect("it can be written");
}

/// Status, the three tables, and the messages.
fn judged(bench: &Bench, line: &str) -> (Option<i32>, Vec<Vec<Value>>, String) {
    let output = bench.tristack(&format!("{line} --format json")).output();
    let output = output.expect("it runs");
    let message = String::from_utf8(output.stderr).expect("text");
    let text = String::from_utf8(output.stdout).expect("text");
    let tables = json(&text)["tables"].as_array().cloned().expect(&message);
    let rows = tables.iter().map(|table| table["rows"].as_array().cloned());
    (
        output.status.code(),
        rows.map(|rows| rows.expect("rows")).collect(),
        message,
    )
}

#[track_caller]
fn refused(bench: &Bench, line: &str, expected: &[&str]) {
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8(output.stderr).expect("text");
    let status = output.status.code();
    assert!(
        status == Some(1) && output.stdout.is_empty(),
        "{line}: {message}"
    );
    for words in expected {
        assert!(message.contains(words), "{line}: {words} in {message}");
    }
}

#[test]
fn five_series_agree_and_three_leave_parts_of_the_budget_open() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    let (status, tables, message) = judged(&bench, &format!("{THREE} {speeds} {STACK} {FURTHER}"));
    assert_eq!(status, Some(0), "{message}");
    let row = &tables[0][0];
    assert_eq!(
        (&row["verdict"], &row["not_known"]),
        (&"agrees".into(), &"".into())
    );
    let error = row["error"].as_f64().expect("a distance");
    assert!(error.abs() < 1e-7, "{error}");
    assert_eq!(tables[1].len(), 5);

    let line = format!("{THREE} {speeds} {STACK} --junit tests.xml");
    let (status, tables, message) = judged(&bench, &line);
    assert_eq!(status, Some(4), "{message}");
    let tests = fs::read_to_string(bench.path("tests.xml")).expect("the tests");
    assert!(
        tests.contains("<skipped message=") && tests.contains("type=\"inconclusive\""),
        "{tests}"
    );
    let row = &tables[0][0];
    assert_eq!(row["verdict"], "inconclusive");
    assert_eq!(row["error"].as_f64(), Some(error));
    // Of the time step only a bound is known, which is too large.
    assert_eq!(row["not_known"], "");
    for words in [
        "the part of the time step in the uncertainty is at most ",
        "twice the time step (--coarse-step)",
    ] {
        assert!(message.contains(words), "{message}");
    }
    assert!(!message.contains("--short-ramp"), "{message}");
    let how = |tables: &[Vec<Value>], part: &str| {
        let row = tables[2].iter().find(|row| row["part"] == part);
        row.expect(part)["how"].as_str().expect(part).to_owned()
    };
    for part in ["time_step", "preparation"] {
        assert!(how(&tables, part).starts_with("at most: "));
    }

    let line = format!("{THREE} {speeds} {STACK} --short-ramp short.csv");
    let (_, tables, _) = judged(&bench, &line);
    assert!(how(&tables, "time_step").starts_with("at most: "));
    assert!(how(&tables, "preparation").contains("ramp halved"));
}

/// Where the wall presses in the first row, nobody knows how the stack began.
#[test]
fn a_series_that_does_not_show_the_state_at_rest_leaves_the_preparation_unknown() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    let text = fs::read_to_string(bench.path("v1.csv")).expect("a series");
    let presses = |line: &str| {
        let force = line.split(',').nth(2).and_then(|force| force.parse().ok());
        force.is_none_or(|force: f64| force > 0.0)
    };
    let pressed: Vec<&str> = text.lines().filter(|line| presses(line)).collect();
    assert!(pressed.len() < text.lines().count());
    fs::write(bench.path("v1.csv"), pressed.join("\n") + "\n").expect("a file");
    let line = format!("{THREE} {speeds} {STACK} --coarse-step coarse.csv");
    let (status, tables, message) = judged(&bench, &line);
    assert_eq!(status, Some(4), "{message}");
    assert_eq!(tables[0][0]["not_known"], "preparation");
    assert!(
        message.contains("half the gravity ramp (--short-ramp)"),
        "{message}"
    );
}

/// The same number as a crosscheck gives, which knows the speeds from its plan.
#[test]
fn the_force_is_that_of_a_crosscheck() {
    let (bench, speeds) = bench_with(ContactConvention::PAPER);
    let options = format!("{STACK} {FURTHER} --history-update fixed");
    let (_, tables, _) = judged(&bench, &format!("{THREE} {speeds} {options}"));
    let line = format!("crosscheck --codes native {BARE} --format json");
    let output = bench.tristack(&line).output().expect("it runs").stdout;
    let live = &json(&String::from_utf8(output).expect("text"))["rows"][0];
    let number = |row: &Value, name: &str| row[name].as_f64().expect("a number");
    let own = &tables[0][0];
    // A plan knows the ratios of its speeds, a user their six digits.
    for name in ["slip_onset", "peak_force"] {
        let apart = (number(own, name) - number(live, name)).abs();
        assert!(apart < 1e-6, "{name}: {apart}");
    }
    let ratio = number(own, "uncertainty") / number(live, "uncertainty");
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
fn the_order_of_the_files_does_not_matter_but_speeds_must_be_theirs() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    let given = speeds.strip_prefix("--speeds ").expect("speeds");
    let mut turned: Vec<&str> = given.split(',').collect();
    turned.reverse();
    let turned = turned.join(",");
    let (_, fastest_first, _) = judged(&bench, &format!("{THREE} {speeds} {STACK}"));
    let line = format!("judge --series v1.csv v2.csv v4.csv --speeds {turned} {STACK}");
    let (_, slowest_first, _) = judged(&bench, &line);
    assert_eq!(fastest_first, slowest_first);
    refused(
        &bench,
        &format!("{THREE} --speeds {turned} {STACK}"),
        &[
            "v4.csv: its wall moves at ",
            "and --speeds says ",
            "in the order of the files",
        ],
    );
}

#[test]
fn of_more_than_three_series_the_slowest_are_extrapolated() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    let mut fast = measurement(ContactConvention::TURNING).cases[0];
    fast.protocol.wall_speed *= 2.0;
    put(&bench, "v8.csv", &fast);
    let speeds = speeds.replace(
        "--speeds ",
        &format!("--speeds {},", fast.protocol.wall_speed),
    );
    let line = format!("judge --series v8.csv v4.csv v2.csv v1.csv {speeds} {STACK} {FURTHER}");
    let (status, tables, message) = judged(&bench, &line);
    assert_eq!(status, Some(0), "{message}");
    assert_eq!(tables[1].len(), 6);
    assert!(
        message.contains("the three slowest are extrapolated; v8.csv are read alone"),
        "{message}"
    );
}

#[test]
fn speeds_need_not_be_halves() {
    let (bench, _) = bench_with(ContactConvention::TURNING);
    let mut cases = measurement(ContactConvention::TURNING).cases;
    cases[0].protocol.wall_speed *= 1.25;
    cases[2].protocol.wall_speed *= 1.1;
    put(&bench, "v4.csv", &cases[0]);
    put(&bench, "v1.csv", &cases[2]);
    let speeds: Vec<String> = cases[..3]
        .iter()
        .map(|case| case.protocol.wall_speed.to_string())
        .collect();
    let line = format!("{THREE} --speeds {} {STACK} {FURTHER}", speeds.join(","));
    let (status, tables, message) = judged(&bench, &line);
    assert_eq!(status, Some(0), "{message}");
    assert!(tables[0][0]["error"].as_f64().expect("a distance").abs() < 1e-6);
}

#[test]
fn another_arm_is_named_on_the_command_line_and_a_wrong_one_differs_once_the_budget_is_known() {
    let arms = ContactConvention::with_arms(Arms::reciprocal(-0.5, -1.0));
    let (bench, speeds) = bench_with(arms);
    let bare = format!("{THREE} {speeds} {BARE}");
    let own = format!("{bare} {FURTHER} --pair-arm -0.5 --floor-arm -1");
    assert_eq!(judged(&bench, &own).0, Some(0));
    refused(&bench, &bare, &["`--pair-arm` is left out", "--passport"]);
    refused(
        &bench,
        &format!("{bare} --pair-arm 0"),
        &["`--floor-arm` is left out"],
    );
    let line = format!("{THREE} {speeds} {STACK}");
    let (status, tables, message) = judged(&bench, &format!("{line} {FURTHER}"));
    assert_eq!(status, Some(2), "{message}");
    assert!(tables[0][0]["error"].as_f64().expect("a distance") < -0.1);
    // The shear between the cylinders follows from the arms, and with it a balance of forces.
    let (status, tables, message) = judged(&bench, &line);
    assert_eq!(status, Some(2));
    assert!(
        message.contains("breaks the balance of forces"),
        "{message}"
    );
    assert!(tables[0][0]["error"].as_f64().expect("a distance") < -0.1);
    let text = bench.tristack(&line).output().expect("it runs").stdout;
    let text = String::from_utf8(text).expect("text");
    assert!(
        text.contains("not known") && text.contains("distance: -1.6e-1 of F + n + 1 from"),
        "{text}"
    );
}

#[test]
fn series_that_break_mechanics_differ_whatever_is_not_known() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    for name in FILES {
        change(&bench, name, |fields| {
            let mut fields: Vec<String> = fields.iter().map(|field| (*field).to_owned()).collect();
            let force: f64 = fields[2].parse().expect("a number");
            fields[2] = (1.002 * force).to_string();
            fields
        });
    }
    let (status, _, message) = judged(&bench, &format!("{THREE} {speeds} {STACK}"));
    assert_eq!(status, Some(2), "{message}");
    assert!(
        message.contains("breaks the balance of forces"),
        "{message}"
    );
}

#[test]
fn what_is_wrong_with_files_and_options_is_said() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    let all = format!("{THREE} {speeds} {STACK}");
    let with = |from: &str, to: &str| all.replace(from, to);
    let cases: [(String, &[&str]); 9] = [
        (with(" v1.csv", ""), &["3", "--series"]),
        (with(BARE, "--mu 0.3"), &["--stiffness"]),
        (with("v2.csv", "none.csv"), &["cannot read none.csv"]),
        (
            with(&speeds, "--speeds 4e-4,2e-4"),
            &["`--speeds` is 2", "as many as files"],
        ),
        (
            with(&speeds, "--speeds 4e-4,2e-4,-1"),
            &["'-1' for '--speeds", "a number above 0"],
        ),
        (
            format!("{all} --dt 0.2"),
            &[
                "v4.csv: its time step",
                "0.1",
                "accepted is 0.2, that of --dt",
            ],
        ),
        (
            format!("{all} --coarse-step v2.csv"),
            &["v2.csv: its time step", "accepted is 0.2, twice that"],
        ),
        (
            format!("{all} --short-ramp v1.csv"),
            &["v1.csv: its wall moves at", "--short-ramp says"],
        ),
        (
            with("0.3", "0.05"),
            &["`--mu` is 0.05, but nothing yields there"],
        ),
    ];
    for (line, expected) in cases {
        refused(&bench, &line, expected);
    }
    let slowest = speeds.rsplit(',').next().expect("a speed");
    refused(
        &bench,
        &format!("judge --series v1.csv --speeds {slowest} {STACK} --kappa 1"),
        &["`--series` is 1", "three or more files", "is not known"],
    );
    for (line, expected) in [
        ("judge away --mu 0.3", "cannot be used with"),
        ("judge away --kappa 2", "cannot be used with"),
        ("judge", "required arguments"),
    ] {
        refused(&bench, line, &[expected]);
    }
    let text = fs::read_to_string(bench.path("v2.csv")).expect("a series");
    let third = text.lines().nth(3).expect("a row");
    fs::write(bench.path("v2.csv"), format!("{text}{third}\n")).expect("a file");
    refused(
        &bench,
        &all,
        &["v2.csv: row ", " does not come after the one before"],
    );
    fs::write(bench.path("v2.csv"), "step,time\n").expect("a file");
    refused(&bench, &all, &["v2.csv: the columns are `step,time`"]);
}

/// Arms out of a passport: the same row as with the arms on the command line, with what is open of them in the budget.
#[test]
fn arms_are_taken_from_a_passport_with_their_uncertainty() {
    let convention = ContactConvention::with_arms(Arms::reciprocal(-0.5, -0.5));
    let (bench, speeds) = bench_with(convention);
    bench.tristack("probe --out passports").assert().code(0);
    let line = format!("{THREE} {speeds} {BARE} {FURTHER}");
    let given = "--pair-arm -0.5 --floor-arm -0.5";
    let (_, by_hand, _) = judged(&bench, &format!("{line} {given}"));
    let passport = "--passport passports/yade.json";
    let (status, tables, message) = judged(&bench, &format!("{line} {passport} --out judged"));
    assert_eq!(status, Some(0), "{message}");
    assert!(message.contains("measured arms -0.5, -0.5"), "{message}");
    for name in [
        "reference_force",
        "slip_onset",
        "error",
        "floor_kinematic_arm",
    ] {
        assert_eq!(tables[0][0][name], by_hand[0][0][name], "{name}");
    }
    let open = |tables: &[Vec<Value>]| {
        let mut parts = tables[2].iter();
        let part = parts.find(|part| part["part"] == "convention")?;
        part["value"].as_f64()
    };
    assert_eq!(open(&by_hand), None);
    let own = open(&tables).expect("a part of the budget");
    assert!(own > 0.0 && own < 1e-8, "{own:e}");
    let file = |name: &str| fs::read_to_string(bench.path("judged").join(name)).expect(name);
    let written = json(&file("judged_series.json"));
    assert_eq!(
        written["tables"][0]["rows"],
        Value::Array(tables[0].clone())
    );
    for name in ["judged_series.csv", "series_runs.csv", "series_budget.csv"] {
        assert!(file(name).lines().count() > 1, "{name}");
    }

    // Ten thousand times less certain: more than can be judged by.
    let less = change_passport(&bench, |row| {
        if row["key"] == "convention.floor.torque_arm" {
            row["uncertainty"] = 1e-3.into();
        }
    });
    let (status, tables, message) = judged(&bench, &format!("{line} --passport {less}"));
    assert_eq!(status, Some(4), "{message}");
    assert!(open(&tables).is_some_and(|open| open > 1e-3));
    assert!(
        message.contains("its arms are measured as -0.5, -0.5"),
        "{message}"
    );
}

/// The limits of both springs at the stack of [`STACK`].
const TURNING_LIMIT: f64 = 30.227_048_1;
const FIXED_LIMIT: f64 = 30.112_860_1;

fn reference(tables: &[Vec<Value>]) -> f64 {
    tables[0][0]["reference_force"].as_f64().expect("a limit")
}

#[test]
fn a_spring_taken_for_the_other_one_differs() {
    for (own, limit) in [
        (ContactConvention::TURNING, TURNING_LIMIT),
        (ContactConvention::PAPER, FIXED_LIMIT),
    ] {
        let (bench, speeds) = bench_with(own);
        for taken in ["fixed", "rotated", "projected", "linearised"] {
            let line = format!("{THREE} {speeds} {STACK} {FURTHER} --history-update {taken}");
            let (status, tables, message) = judged(&bench, &line);
            let is_fixed = own == ContactConvention::PAPER;
            let is_right = is_fixed == (taken == "fixed");
            let expected = if is_right { 0 } else { 2 };
            assert_eq!(status, Some(expected), "{own} as {taken}: {message}");
            assert_eq!(tables[0][0]["history_update"], taken);
            if is_right {
                assert!((reference(&tables) - limit).abs() < 1e-7);
            }
        }
    }
}

/// The pair contact of the Python example with a spring that is a vector which nothing turns.
const FIXED_PAIR: &str = "        tx, ty = -ny, nx
        overlap = 2.0 * RADIUS - distance
        if overlap <= 0.0:
            self.spring, self.normal, self.tangential = (0.0, 0.0), 0.0, 0.0
            return
        self.normal = self.kn * overlap - self.cn * (nx * vx + ny * vy)
        ux, uy = self.spring[0] + sliding * self.dt * tx, self.spring[1] + sliding * self.dt * ty
        qx, qy = -self.kt * ux - self.ct * sliding * tx, -self.kt * uy - self.ct * sliding * ty
        size, limit = sqrt(qx * qx + qy * qy), self.friction * abs(self.normal)
        if size < limit:
            self.spring = (ux, uy)
        else:
            qx, qy = qx * limit / size, qy * limit / size
        self.tangential = qx * tx + qy * ty
        fx, fy = self.normal * nx + qx, self.normal * ny + qy
";

/// The Python example as `mydem`, whose manifest leaves out what a turning contact does to its spring; with `fixed` nothing
/// turns it.
fn example(bench: &Bench, fixed: bool) {
    let folder = code_folder("examples/python", &bench.path("mydem"), |manifest| {
        manifest.replace("history_update = \"rotated\"\n", "")
    });
    if fixed {
        let path = folder.join("mydem.py");
        let script = fs::read_to_string(&path).expect("the example");
        let (before, rest) = script
            .split_once("        self.press(2.0 * RADIUS - distance")
            .expect("a pair");
        let (_, after) = rest
            .split_once("        torque = -RADIUS * self.tangential")
            .expect("its torque");
        let before = before.replace(
            "    def press(",
            "    spring = (0.0, 0.0)\n\n    def press(",
        );
        let script =
            format!("{before}{FIXED_PAIR}        torque = -RADIUS * self.tangential{after}");
        fs::write(path, script).expect("it can be written");
    }
}

/// Of two copies of one code, in one of which nothing turns the spring, the probe says which is which, and each is judged by
/// its own limit.
#[test]
fn a_passport_says_whether_springs_turn() {
    for (fixed, own, limit) in [
        (false, ContactConvention::TURNING, TURNING_LIMIT),
        (true, ContactConvention::PAPER, FIXED_LIMIT),
    ] {
        let (bench, speeds) = with_series(Bench::with_system_programs(), own);
        example(&bench, fixed);
        let probe = "probe --codes ./mydem --out passports";
        let status = bench.tristack(probe).output().expect("it runs").status;
        // What a pair does while it slides is not decided where a part of its spring lies along the normal.
        let undecided = fixed && status.code() == Some(4);
        assert!(status.success() || undecided, "{status}");
        let text = fs::read_to_string(bench.path("passports/mydem.json")).expect("a passport");
        let word = if fixed { "fixed" } else { "rotated" };
        assert!(text.contains(&format!("\"{word}\"")), "{text}");
        let line = format!("{THREE} {speeds} {BARE} {FURTHER} --passport passports/mydem.json");
        let (status, tables, message) = judged(&bench, &line);
        assert_eq!(status, Some(0), "{message}");
        assert!((reference(&tables) - limit).abs() < 1e-6, "{tables:?}");
    }
}

/// The name of a copy of the passport of YADE with what `change` makes of its keys and properties.
fn change_passport(bench: &Bench, change: impl Fn(&mut Value)) -> &'static str {
    let text = fs::read_to_string(bench.path("passports/yade.json")).expect("a passport");
    let mut passport = json(&text);
    for table in ["convention", "properties"] {
        let rows = passport[table]["rows"].as_array_mut().expect("rows");
        rows.iter_mut().for_each(&change);
        // A passport with a row that differs differs as a whole.
        if rows.iter().any(|row| row["verdict"] == "differs") {
            passport["verdict"] = "differs".into();
        }
    }
    fs::write(bench.path("changed.json"), passport.to_string()).expect("a file");
    "changed.json"
}

#[test]
fn a_passport_that_does_not_say_the_arms_is_refused() {
    let (bench, speeds) = bench_with(ContactConvention::TURNING);
    bench.tristack("probe --out passports").assert().code(0);
    let line = format!("{THREE} {speeds} {BARE}");
    let torque = "convention.pair.torque_arm";
    let with = |change: &dyn Fn(&mut Value)| {
        format!("{line} --passport {}", change_passport(&bench, change))
    };
    let of_torque = |name: &'static str, value: Value| {
        move |row: &mut Value| {
            if row["key"] == torque {
                row[name] = value.clone();
            }
        }
    };
    let unknown = with(&of_torque("measured", Value::Null));
    refused(
        &bench,
        &unknown,
        &["changed.json", torque, "is not measured"],
    );
    let beyond = with(&of_torque("measured", "-200".into()));
    refused(&bench, &beyond, &["changed.json", torque, "-200"]);
    let negative = with(&of_torque("uncertainty", (-1.0).into()));
    refused(&bench, &negative, &["the uncertainty of", torque, "-1"]);
    let differs = with(&|row| {
        if row["property"] == "floor_friction" {
            row["verdict"] = "differs".into();
        }
    });
    refused(&bench, &differs, &["floor_friction differs"]);
    let other = format!("{line} --passport passports/all_codes.json");
    refused(&bench, &other, &["all_codes.json"]);
    refused(
        &bench,
        &format!("{line} --passport nowhere.json"),
        &["nowhere.json"],
    );
    let both = format!("{line} --passport passports/yade.json --pair-arm -0.5");
    refused(&bench, &both, &["--passport", "--pair-arm"]);
}

/// A single series is judged by what theory expects its wall speed to add: as it is, with another force, and on a floor of
/// another friction.
#[test]
fn one_series_agrees_and_one_that_is_off_differs() {
    for (convention, spring) in [
        (ContactConvention::PAPER, "fixed"),
        (ContactConvention::TURNING, "rotated"),
    ] {
        let bench = Bench::without_codes();
        let mut case = measurement(convention).cases[2];
        case.protocol.time_step = 0.02;
        put(&bench, "one.csv", &case);
        let mut slippery = case;
        slippery.stack.floor_friction *= 0.999;
        put(&bench, "slippery.csv", &slippery);
        put(&bench, "off.csv", &case);
        change(&bench, "off.csv", |fields| {
            let mut fields: Vec<String> = fields.iter().map(|field| (*field).to_owned()).collect();
            // Of the wall, and those of the floor.
            for column in [2, 12, 13, 14, 15] {
                let force = &mut fields[column];
                *force = (1.0001 * force.parse::<f64>().expect("a number")).to_string();
            }
            fields
        });
        let speed = case.protocol.wall_speed;
        let line = |name: &str| {
            format!("judge --series {name} --speeds {speed} {STACK} --history-update {spring}")
        };
        let (status, tables, message) = judged(&bench, &line("one.csv"));
        assert_eq!(status, Some(0), "{message}");
        let row = &tables[0][0];
        let number = |name: &str| row[name].as_f64().expect("a number");
        assert!(number("error").abs() < number("tolerance"));
        assert!(number("tolerance") < 1e-5, "{}", number("tolerance"));
        assert_eq!(tables[1].len(), 1);
        let mut fast = case;
        fast.protocol.wall_speed *= 20.0;
        put(&bench, "fast.csv", &fast);
        let own = line("fast.csv").replace(
            &format!("--speeds {speed} "),
            &format!("--speeds {} ", fast.protocol.wall_speed),
        );
        let (status, _, message) = judged(&bench, &own);
        assert_eq!(status, Some(4), "{message}");
        assert!(
            message.contains("with a slower wall it is less"),
            "{message}"
        );
        for name in ["slippery.csv", "off.csv"] {
            let (status, _, message) = judged(&bench, &line(name));
            assert_eq!(status, Some(2), "{name}: {message}");
        }
    }
}
