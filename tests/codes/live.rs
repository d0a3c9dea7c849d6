//! The real codes. Runs whenever they are installed; with TRISTACK_REQUIRE_ENGINES=liggghts,yade,lammps a missing
//! one fails the suite.

use crate::common;
use crate::common::{
    Bench, OWN_PROGRAM, are_as_on_file, assert_only, code_folder, json_rows, network, project,
    recording, released_program,
};
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use tristack::code::{Code, FailureKind, Interrupt, RunContext};
use tristack::dem::compress_stack;
use tristack::model::{Case, HistoryUpdate, Power, Preparation, SideWalls, Stack};
use tristack::series::{Sample, Series, YieldEstimates};
use tristack::study::check::{Outcome, seen_elsewhere};
use tristack::study::yield_force::plan;

fn named(name: &str) -> Code {
    Code::named(name).expect("it is built in")
}

/// The external codes that are installed.
fn installed() -> Vec<Code> {
    common::installed(&Code::with_power(Power::Linear)[1..])
}

/// Their names, as `--codes` has them.
fn listed(codes: &[Code]) -> String {
    let names: Vec<&str> = codes.iter().map(|code| code.as_str()).collect();
    names.join(",")
}

/// The rows of a command in which everything agrees.
fn agreeing(bench: &Bench, line: &str) -> Vec<serde_json::Value> {
    let output = bench.tristack(line).output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    json_rows(&String::from_utf8_lossy(&output.stdout))
}

/// Below and above the critical friction, soft and stiff.
const FEW_STACKS: &str = "--mu 0.2,0.3 --stiffness 100,10000";

/// The rows of native and `codes`, by `program` at `bench`, with its files in `out` of the bench.
fn crosscheck(bench: &Bench, program: &Path, codes: &[Code], options: &str, out: &str) -> Output {
    let names = listed(codes);
    let line = format!("crosscheck --codes native,{names} --format json {options} --out {out}");
    let output = bench.process_of(program, &line).output();
    output.expect("it runs")
}

#[test]
fn all_installed_codes_agree_with_their_limit_on_the_quick_profile() {
    let installed = installed();
    if installed.is_empty() {
        return;
    }
    let own = PathBuf::from(OWN_PROGRAM);
    let bench = Bench::with_system_programs();
    let whole = crosscheck(&bench, &own, &installed, "", "whole");
    // Far below what an agreement needs: 7e-8 is what was seen at most.
    assert_live_agreement(&bench, &whole, &installed, (18, 1e-7));
    assert_same_bytes_anew(&bench, &own, &installed);
}

/// What the store of `bench` gives, the program that was released gives in the same bytes by runs of its own.
fn assert_same_bytes_anew(bench: &Bench, own: &Path, installed: &[Code]) {
    let first = crosscheck(bench, own, installed, FEW_STACKS, "out");
    let message = String::from_utf8_lossy(&first.stderr);
    assert!(message.contains("are there already"), "{message}");
    let elsewhere = Bench::with_system_programs();
    let released = released_program();
    let program = released.as_deref().unwrap_or(own);
    let second = crosscheck(&elsewhere, program, installed, FEW_STACKS, "out");
    assert_eq!(first.status, second.status);
    assert!(first.stdout == second.stdout, "the printed rows differ");
    let tables = [
        "budget.csv",
        "crosscheck.csv",
        "crosscheck.json",
        "crosscheck.md",
    ];
    assert_only(&bench.path("out"), &tables);
    for table in tables {
        let [one, two] = [bench, &elsewhere]
            .map(|bench| fs::read(bench.path("out").join(table)).expect("a table"));
        assert!(one == two, "{table} differs");
    }
}

/// Every row of `codes`, and of native, agrees; the errors of the codes are below `largest`.
fn assert_live_agreement(
    bench: &Bench,
    output: &Output,
    installed: &[Code],
    (stacks, largest): (usize, f64),
) {
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(rows.len(), stacks * (1 + installed.len()));
    for code in installed {
        let own = rows.iter().filter(|row| row["code"] == code.as_str());
        let errors = own.map(|row| {
            assert_eq!(row["source"], "live");
            row["error"].as_f64().expect("an error").abs()
        });
        let worst = errors.fold(0.0, f64::max);
        println!("{code}: largest error {worst:.1e} of F + 3");
        assert!(worst < largest, "{code}: {worst:e}");
    }
    assert_only(&bench.path("store/work"), &[]);
}

#[test]
fn all_installed_codes_have_exact_impacts() {
    let installed = installed();
    if installed.is_empty() {
        return;
    }
    let names = listed(&installed);
    let bench = Bench::with_system_programs();
    let line = format!("impacts --codes {names} --format json");
    let rows = agreeing(&bench, &line);
    assert_eq!(rows.len(), 44 * installed.len());
    let errors = rows
        .iter()
        .map(|row| row["error"].as_f64().expect("an error"));
    let worst = errors.map(f64::abs).fold(0.0, f64::max);
    println!("largest error of an impact {worst:.1e}");
    // 3e-7 is what was seen at most, where |N| has a kink in the middle of a step; else it was 1e-11.
    assert!(worst < 1e-6, "{worst:e}");
}

/// Contact 2–3 is closed when the floor begins to slip: onset and peak are two forces, and every code has both.
#[test]
fn all_installed_codes_have_onset_and_peak_of_a_stack_whose_bottom_cylinders_touch() {
    let installed = installed();
    if installed.is_empty() {
        return;
    }
    let names = listed(&installed);
    let bench = Bench::with_system_programs();
    let line = format!(
        "crosscheck --codes {names} --mu 0.2,0.3 --stiffness 1e2 --kappa 0.6 --format json"
    );
    let rows = agreeing(&bench, &line);
    assert_eq!(rows.len(), 2 * installed.len());
    for row in rows {
        let number = |key: &str| row[key].as_f64().expect("a number");
        assert!(
            number("reference_onset") < 0.5 * number("reference_force"),
            "{row}"
        );
        let apart = (number("peak_force") - number("reference_force")).abs();
        assert!(
            apart <= number("peak_uncertainty") + number("slip_onset_uncertainty"),
            "{row}"
        );
    }
}

/// One code of each engine: the check compares every other one with its twin as well, row by row
/// (`folders_of_real_codes_pass`).
#[test]
fn one_installed_code_of_each_engine_follows_its_native_twins() {
    let codes = ["liggghts", "yade-wall", "lammps"].map(named);
    let installed = common::installed(&codes);
    if installed.is_empty() {
        return;
    }
    let names = listed(&installed);
    let bench = Bench::with_system_programs();
    let line = format!("trajectories --codes {names} --format json");
    let rows = agreeing(&bench, &line);
    for code in installed {
        let own = rows.iter().filter(|row| row["code"] == code.as_str());
        let own: Vec<_> = own.collect();
        // A code that turns its springs has no second twin.
        let twins = match code.declaration().convention.history_update {
            HistoryUpdate::Rotated => 1,
            _ => 2,
        };
        // Three time steps; four quantities on two branches and three on the last.
        assert_eq!(own.len(), twins * 3 * (2 * 4 + 3), "{code}");
        let force = own.iter().filter(|row| {
            row["quantity"] == "wall_force"
                && row["branch"] == "compression"
                && row["time_step"] == 0.00625
        });
        for row in force {
            assert_eq!(row["source"], "live");
            println!(
                "{code}, {} twin: {} of the peak",
                row["twin"], row["largest"]
            );
        }
    }
    assert_only(&bench.path("store/work"), &[]);
}

#[test]
fn a_live_run_leaves_deck_output_and_series_for_inspection() {
    let deck = |code: Code| match code.as_str() {
        "liggghts" => vec![
            "contacts.in",
            "log.liggghts",
            "parameters.in",
            "stack.in",
            "top_wall.in",
            "wall.stl",
        ],
        "lammps" => vec![
            "contacts.in",
            "log.lammps",
            "parameters.in",
            "stack.in",
            "top_wall.in",
        ],
        _ => vec![
            "cases.py",
            "contacts.py",
            "law.py",
            "parameters.json",
            "stack.py",
        ],
    };
    for code in installed() {
        let bench = Bench::with_system_programs();
        let line = format!("simulate --code {code} --mu 0.2 --stiffness 100 --out run");
        bench.tristack(&line).assert().code(0);
        let mut files = deck(code);
        files.extend([
            "case.json",
            "series.csv",
            "series.csv-metadata.json",
            "stderr.txt",
            "stdout.txt",
            "summary.json",
        ]);
        files.sort_unstable();
        assert_only(&bench.path("run"), &files);
    }
}

/// What is measured now is what the passports on file say of the same versions.
#[test]
fn all_installed_codes_mean_by_a_contact_what_their_adapter_declares() {
    let codes = [vec![Code::native()], installed()].concat();
    let names = listed(&codes);
    let bench = Bench::with_system_programs();
    let line = format!("probe --codes {names} --passports filed --format json");
    agreeing(&bench, &line);
    assert_only(&bench.path("store/work"), &[]);
    assert!(
        are_as_on_file(&bench.path("filed")) > 0,
        "native is on file"
    );
}

/// Contacts come and go in every law and style as they do elsewhere, mirrored, exchanged, turned and begun anew.
#[test]
fn contacts_of_all_installed_codes_come_and_go_alike_everywhere() {
    let laws = [Power::Linear, Power::Hertz];
    let codes = laws.map(|law| common::installed(&Code::with_power(law)[1..]));
    let place = tempfile::tempdir().expect("a directory");
    codes.concat().par_iter().for_each(|code| {
        let installed = code.find().expect("it is installed");
        let kinds = [false, true].into_iter();
        for in_space in kinds.filter(|in_space| !in_space || code.declaration().in_space) {
            let directory = place.path().join(format!("{code}-{in_space}"));
            let nobody = Interrupt::new();
            let context = RunContext::new(&directory, &nobody);
            let item = seen_elsewhere(installed.as_ref(), in_space, &context);
            let item = item.unwrap_or_else(|failure| panic!("{code}: {failure}"));
            assert_eq!(item.outcome, Outcome::Passed, "{code}: {item:?}");
        }
    });
}

/// A code whose author says nothing of its convention is judged by what is measured, as if that had been declared.
#[test]
fn a_convention_that_is_left_out_is_measured_and_gives_the_same_verdicts() {
    for code in installed()
        .into_iter()
        .filter(|code| code.is_first_variant())
    {
        let folder = match code.as_str() {
            "liggghts" => "liggghts_inputs",
            "lammps" => "lammps_inputs",
            _ => continue,
        };
        let bench = Bench::with_system_programs();
        code_folder(folder, &bench.path("copy"), |manifest| {
            let (before, after) = manifest.split_once("[convention]").expect("a convention");
            let (_, after) = after.split_once("[integration]").expect("an integration");
            let renamed = before.replace(&format!("name = \"{code}\""), "name = \"copy\"");
            format!("{renamed}[integration]{after}").replace("velocity_lag = 0.0\n", "")
        });
        let line = format!("crosscheck --codes {code},./copy {FEW_STACKS} --format json");
        let rows = agreeing(&bench, &line);
        let of = |name: &str| {
            rows.iter()
                .filter(|row| row["code"] == name)
                .collect::<Vec<_>>()
        };
        let (declared, measured) = (of(code.as_str()), of("copy"));
        assert_eq!([declared.len(), measured.len()], [4, 4]);
        for (declared, measured) in declared.into_iter().zip(measured) {
            for key in ["yield_force", "reference_force", "verdict"] {
                assert_eq!(declared[key], measured[key], "{key}: {measured}");
            }
        }
    }
}

#[test]
fn a_live_run_repeats_its_recording() {
    for code in installed() {
        let mut runs = recording(&code).runs.into_iter();
        let recorded = runs.find_map(|run| Some((run.summary.case, run.series?)));
        let (case, series) = recorded.expect("a recorded series");
        let bench = Bench::with_system_programs();
        fs::write(bench.path("case.json"), case.to_json()).expect("a case");
        let line = format!("simulate --code {code} --out run --case case.json");
        bench.tristack(&line).assert().code(0);
        let live = fs::read(bench.path("run/series.csv")).expect("a series");
        let live = Series::read(live.as_slice(), &case);
        let largest = largest_deviation(&series, &live.expect("a series"));
        println!("{code}: largest deviation from its recording {largest:e}");
        // Another build of the same version may round differently; positions are of order 1.
        assert!(largest < 1e-9, "{code}: {largest:e}");
    }
}

/// After a preparation between side walls, a code and a native twin with its convention must differ by less than
/// halving the time step changes in the twin.
#[test]
fn side_walls_lead_to_the_same_stack_and_yield_force_in_every_code_that_offers_them() {
    for code in installed() {
        let pushes: &[f64] = match code.as_str() {
            "lammps" => continue,
            "liggghts" | "yade" => &[0.005, 0.05],
            _ => &[0.05],
        };
        for push in pushes {
            let bench = Bench::with_system_programs();
            let line = format!(
                "simulate --code {code} --mu 0.2 --stiffness 100 --preparation side-walls \
                 --push {push} --out run"
            );
            bench.tristack(&line).assert().code(0);
            let case = tristack::files::read_case(&bench.path("run/case.json")).expect("a case");
            let mut halved = case;
            halved.protocol.time_step *= 0.5;
            let series = fs::File::open(bench.path("run/series.csv")).expect("a series");
            let own = Series::read(series, &case).expect("a series");
            let native = |case: &Case| compress_stack(case, || true).expect("a finite series");
            let own = contact_and_slip(&own, &case);
            let twin = contact_and_slip(&native(&case), &case);
            let finer = contact_and_slip(&native(&halved), &halved);
            for (what, index) in [("c", 0), ("F", 1)] {
                let distance = (own[index] - twin[index]).abs();
                let allowed = (twin[index] - finer[index]).abs();
                println!(
                    "{code}, A = {push}: {what} = {}, {distance:.1e} of {allowed:.1e}",
                    own[index]
                );
                assert!(
                    distance <= allowed,
                    "{code} {push}: {what} {distance:e} {allowed:e}"
                );
            }
        }
    }
}

/// c at the beginning of the compression and F at the onset of slip, in m g.
fn contact_and_slip(series: &Series, case: &Case) -> [f64; 2] {
    let stack = &case.stack;
    let contact = series.samples()[0].bottom_overlap(stack) * stack.stiffness;
    let slip = YieldEstimates::read(series, case).slip;
    [contact, slip.expect("an onset of slip").force]
}

/// One call may mix preparations, each of which has a deck of its own.
#[test]
fn cases_of_both_preparations_come_back_in_order() {
    let interrupt = Interrupt::new();
    for name in installed() {
        let directory = tempfile::tempdir().expect("a directory");
        let context = RunContext::new(directory.path(), &interrupt);
        // The shortest that is a run.
        let settled = name.as_declared().expect("nothing is left out");
        let mut ramp = plan(&settled, &Stack::paper(0.2, 1e2), settled.convention()).cases[0];
        ramp.protocol.wall_travel *= 0.01;
        ramp.protocol.sampling.fine_from_travel = 0.0;
        let mut walls = ramp;
        walls.protocol.preparation = Preparation::SideWalls(SideWalls {
            settle_time: 10.0,
            rest_time: 10.0,
            ..SideWalls::paper(0.0, 0.01)
        });
        let code = name.find().expect("it is installed");
        let mut results = Vec::new();
        code.run(&[ramp, walls, ramp], &context, &mut |index, result| {
            results.push((index, result));
        });
        for (expected, (index, result)) in results.iter().enumerate() {
            assert_eq!(expected, *index);
            match result {
                Ok(run) => assert_eq!(run.case, [ramp, walls, ramp][*index]),
                Err(failure) => {
                    assert_eq!((name.clone(), *index), (named("lammps"), 1), "{failure}");
                    assert!(matches!(failure.kind, FailureKind::Unsupported(_)));
                }
            }
        }
        assert_eq!(results.len(), 3);
        let refused = results.iter().filter(|(_, result)| result.is_err()).count();
        assert_eq!(refused, usize::from(name == named("lammps")));
    }
}

#[test]
fn no_code_sees_the_network() {
    if !network::can_be_left() {
        return;
    }
    let own = fs::read_link("/proc/self/ns/net").expect("a name space");
    for code in installed() {
        let bench = Bench::with_system_programs();
        let line = format!("simulate --code {code} --mu 0.3 --stiffness 10000 --out run");
        let mut child = bench.process(&line).spawn().expect("it starts");
        let place = bench.path("run");
        let mut seen = None;
        while seen.is_none() && child.try_wait().expect("it can be watched").is_none() {
            seen = network_of_program_in(&place);
        }
        let _ = child.kill();
        let _ = child.wait();
        let seen = seen.expect("the code has been seen running");
        assert_ne!(seen, own, "{code}");
    }
}

/// The network of a program that runs in `directory` and is no guard.
fn network_of_program_in(directory: &Path) -> Option<PathBuf> {
    let processes = fs::read_dir("/proc").expect("processes").flatten();
    let mut programs = processes.filter(|process| {
        let here = fs::read_link(process.path().join("cwd"));
        let command = fs::read(process.path().join("cmdline")).unwrap_or_default();
        here.is_ok_and(|here| here == directory)
            && !command.is_empty()
            && !command.starts_with(b"/proc/self/exe")
            && !command.windows(8).any(|part| part == b"tristack")
    });
    let program = programs.next()?;
    fs::read_link(program.path().join("ns/net")).ok()
}

/// The largest difference up to the peak of the wall force; the collapse after it would make more of it.
fn largest_deviation(left: &Series, right: &Series) -> f64 {
    let pairs = left.samples().iter().zip(right.samples());
    let force = |sample: &Sample| sample.wall_force;
    let (peak, _) = (left.samples().iter().enumerate())
        .max_by(|(_, one), (_, other)| force(one).total_cmp(&force(other)))
        .expect("rows");
    assert!(peak > 10 && left.samples().len() == right.samples().len());
    let numbers = |sample: &Sample| {
        [
            sample.wall_force,
            sample.bodies[0].position[0],
            sample.bodies[0].position[1],
            sample.bodies[1].position[0],
            sample.bodies[1].position[1],
            sample.bodies[1].rotation[2],
        ]
    };
    let deviations = pairs.take(peak).flat_map(|(one, other)| {
        let pairs = numbers(one).into_iter().zip(numbers(other));
        pairs.map(|(one, other)| (one - other).abs())
    });
    deviations.fold(0.0, f64::max)
}

/// The first Hertz style of each code, under its own convention, at the six frictions of the quick profile.
#[test]
fn installed_codes_agree_with_the_limit_of_their_hertz_style() {
    let mut styles = common::installed(&Code::with_power(Power::Hertz)[1..]);
    styles.retain(|code| code.is_first_variant());
    if styles.is_empty() {
        return;
    }
    let own = PathBuf::from(OWN_PROGRAM);
    let bench = Bench::with_system_programs();
    let frictions = "0.12,0.2,0.25,critical,0.3,0.4";
    let options = format!("--law hertz --mu {frictions} --stiffness 1e2");
    let rows = crosscheck(&bench, &own, &styles, &options, "hertz");
    // Three times what was seen at most, 3.5e-7.
    assert_live_agreement(&bench, &rows, &styles, (6, 1e-6));
    let page = fs::read_to_string(bench.path("hertz/laws.md")).expect("a page on laws");
    for code in styles {
        assert!(page.contains(code.as_str()), "{code}");
    }
}

/// The largest force at the critical friction grows with the power 2/5 of the stiffness, not with the root.
#[test]
fn liggghts_measures_the_exponent_of_hertz() {
    let code = named("liggghts-hertz");
    if common::installed(&[code]).is_empty() {
        return;
    }
    let bench = Bench::with_system_programs();
    let line = "sweep --code liggghts-hertz --mu critical --stiffness 1e5,1e6 --format json";
    let output = bench.process(line).output().expect("it runs");
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let peaks: Vec<f64> = rows
        .iter()
        .filter_map(|row| row["peak_force"].as_f64())
        .collect();
    let [soft, stiff] = peaks[..] else {
        panic!("{}", String::from_utf8_lossy(&output.stderr));
    };
    let exponent = (stiff / soft).log10();
    assert!((exponent / 0.4 - 1.0).abs() < 0.01, "{exponent}");
}

/// A sphere on three and on four, below, at and above the critical friction.
#[test]
fn all_installed_codes_agree_with_the_limit_of_a_ring_of_spheres() {
    let installed = installed();
    if installed.is_empty() {
        return;
    }
    let own = PathBuf::from(OWN_PROGRAM);
    let bench = Bench::with_system_programs();
    for (bodies, frictions) in [(3, "0.2,critical,0.345"), (4, "0.2,critical,0.45")] {
        let options = format!("--bodies {bodies} --mu {frictions} --stiffness 1e2");
        let out = format!("ring-{bodies}");
        let rows = crosscheck(&bench, &own, &installed, &options, &out);
        // Three times what was seen at most, 4.3e-8.
        assert_live_agreement(&bench, &rows, &installed, (3, 1.3e-7));
    }
}

/// One sphere is displaced, so that no symmetry is left: every component of every sphere follows the twin up to the peak.
#[test]
fn spheres_without_symmetry_follow_their_native_twins() {
    let installed = installed();
    if installed.is_empty() {
        return;
    }
    let names = listed(&installed);
    let bench = Bench::with_system_programs();
    let line = format!("trajectories --bodies 3 --codes {names} --format json");
    let rows = agreeing(&bench, &line);
    // One twin, three time steps, four quantities.
    assert_eq!(rows.len(), 12 * installed.len());
    for code in ["liggghts", "lammps"] {
        let own = rows.iter().filter(|row| row["code"] == code);
        // Rotations are summed by another rule in their decks.
        let alike = own.filter(|row| row["quantity"] != "rotations");
        for row in alike {
            assert!(
                row["largest"].as_f64().expect("a distance") < 1e-9,
                "{row:?}"
            );
        }
    }
}

/// The folder of LIGGGHTS as a stranger's: a stack of spheres turned, mirrored and numbered otherwise has the same onset.
#[test]
fn a_stack_of_spheres_does_not_see_from_where_it_is_looked_at() {
    if common::installed(&[named("liggghts")]).is_empty() {
        return;
    }
    let bench = Bench::with_system_programs();
    let folder = bench.path("mine");
    fs::create_dir(&folder).expect("a directory");
    let manifest = "schema = 1\nname = \"mine\"\nextends = \"liggghts\"\n";
    fs::write(folder.join("code.toml"), manifest).expect("a manifest");
    let output = bench
        .tristack("check")
        .arg(&folder)
        .output()
        .expect("it runs");
    let told = String::from_utf8_lossy(&output.stdout);
    for item in [
        "spheres turned by 1 rad",
        "spheres mirrored",
        "spheres numbered otherwise",
    ] {
        let line = told.lines().find(|line| line.contains(item));
        let line = line.unwrap_or_else(|| panic!("{told}"));
        assert!(line.contains("the same onset"), "{line}");
    }
}

/// A deck that includes all that a task gives, as docs/formats.md has it, is the deck that includes what it reads; one
/// that does not have friction ends with its message.
#[test]
fn decks_take_bodies_and_features_as_variables() {
    let page = fs::read_to_string(project().join("docs/formats.md")).expect("a page");
    let lines = page.lines().map(str::trim);
    let lines = lines.skip_while(|line| !line.starts_with("variable features_friction"));
    let refusing: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
    assert_eq!(refusing.len(), 4, "{refusing:?}");
    let installed = installed();
    for name in ["lammps", "liggghts"] {
        if !installed.iter().any(|code| code.as_str() == name) {
            continue;
        }
        let bench = Bench::with_system_programs();
        let folder = code_folder(&format!("{name}_inputs"), &bench.path("mydem"), |text| {
            let renamed = text.replacen(&format!("name = \"{name}\""), "name = \"mydem\"", 1);
            let file = renamed.replace("\"parameters.in\"", "\"task.in\"");
            file.replace("content = \"deck\"", "content = \"task\"")
        });
        let deck = fs::read_to_string(folder.join("stack.in")).expect("a deck");
        let including = |lines: &str| {
            let own = deck.lines().map(|line| {
                let is_include = line.starts_with("include") && line.ends_with(" parameters.in");
                if is_include { lines } else { line }
            });
            let own: Vec<&str> = own.collect();
            assert_ne!(own.join("\n"), deck.trim_end());
            own.join("\n") + "\n"
        };
        let series = |code: &str, out: &str| {
            let case = "--mu 0.3 --stiffness 100 --speed 1e-3";
            let line = format!("simulate --code {code} {case} --out {out}");
            let output = bench.tristack(&line).output().expect("it runs");
            let message = String::from_utf8_lossy(&output.stderr).into_owned();
            (fs::read(bench.path(out).join("series.csv")).ok(), message)
        };
        let write = |lines: &str| {
            fs::write(folder.join("stack.in"), including(lines)).expect("a deck");
        };
        let read_each = "variable total equal v_bodies_1_mass+v_bodies_2_radius+v_bodies_3_moment_of_inertia\n\
                         if \"${total} <= 2\" then \"print 'no bodies'\" \"quit 1\"";
        write(&format!("{}\n{read_each}", refusing.join("\n")));
        let (own, message) = series("./mydem", "own");
        assert!(own.is_some(), "{message}");
        assert!(own == series(name, "built-in").0, "{message}");
        write(
            &refusing
                .join("\n")
                .replace("features_friction", "features_rolling"),
        );
        let (none, message) = series("./mydem", "none");
        assert_eq!(none, None);
        let expected = "features: friction alone is known here";
        assert!(message.contains(expected), "{message}");
    }
}
