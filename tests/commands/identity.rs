//! The identity of a program: what is inside of a wrapper decides its numbers, and stored runs of other insides are not
//! taken for its own.

use crate::common;
use crate::common::replay::{self, Disturbance};
use crate::common::{Bench, json_rows, standard_output};
use rayon::prelude::*;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tristack::code::{Code, witness_test};
use tristack::dem::compress_stack;
use tristack::model::{Case, Power};

const CROSSCHECK: &str = "crosscheck --format json --codes";

/// The series of `case` with a floor that is rougher by a thousandth.
fn rougher(case: &Case) -> Disturbance {
    let mut rougher = *case;
    rougher.stack.floor_friction *= 1.001;
    let series = compress_stack(&rougher, || true).expect("a finite series");
    Disturbance::Series(String::from_utf8(series.to_csv()).expect("text"))
}

/// Two places with what a YADE answers, an honest one and one with a rougher floor, in this order.
fn honest_and_rough(bench: &Bench) -> [PathBuf; 2] {
    let yade = Code::named("yade").expect("it is built in");
    let replay = bench.path("replay");
    let places = ["honest", "rough"].map(|name| bench.path(name));
    for (place, is_honest) in places.iter().zip([true, false]) {
        replay::install(bench, |case| match is_honest {
            true => Disturbance::None,
            false => rougher(case),
        });
        let mut test = witness_test(yade.declaration().convention);
        let asked = test;
        test.floor_friction *= if is_honest { 1.0 } else { 1.001 };
        replay::install_motion_as(&replay, &asked, &test);
        fs::rename(&replay, place).expect("it is moved");
    }
    places
}

fn write_program(path: &Path, script: &str) {
    fs::write(path, script).expect("a script");
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).expect("its permissions");
}

/// Verdicts of a crosscheck of `code`, each once, and whether a run was taken from the store.
fn verdicts(bench: &Bench, code: &str) -> (Vec<String>, bool) {
    let mut command = bench.tristack(&format!("{CROSSCHECK} {code}"));
    let output = command.output().expect("it runs");
    let message = String::from_utf8_lossy(&output.stderr);
    let rows = json_rows(&String::from_utf8_lossy(&output.stdout));
    let verdicts = rows
        .iter()
        .map(|row| row["verdict"].as_str().expect("a verdict").to_owned());
    let mut verdicts: Vec<String> = verdicts.collect();
    verdicts.sort();
    verdicts.dedup();
    (verdicts, message.contains("runs are there already"))
}

/// The witness notices what cannot be seen from outside.
#[test]
fn a_wrapper_whose_hidden_insides_change_is_run_anew() {
    let bench = Bench::with_system_programs();
    let [honest, rough] = honest_and_rough(&bench);
    let folder = replay::quick_folder(&bench.path("folder"));
    for place in [&honest, &rough] {
        let inside = place.with_extension("txt");
        fs::write(&inside, replay::script(place, "")).expect("a script");
    }
    let choose = |place: &Path| replay::install_wrapper(&bench, &place.with_extension("txt"));
    choose(&honest);
    assert_eq!(
        verdicts(&bench, &folder),
        (vec!["agrees".to_owned()], false)
    );
    choose(&rough);
    let (found, reused) = verdicts(&bench, &folder);
    assert_eq!((found, reused), (vec!["differs".to_owned()], false));
    choose(&honest);
    assert_eq!(verdicts(&bench, &folder), (vec!["agrees".to_owned()], true));
}

/// A program that a script names is hashed, so that it is noticed without a micro-test.
#[test]
fn a_wrapper_whose_named_program_changes_is_run_anew() {
    let bench = Bench::with_system_programs();
    let [honest, rough] = honest_and_rough(&bench);
    let inner = bench.path("inner");
    bench.install("yade", &format!("exec '{}' \"$@\"", inner.display()));
    let put = |place: &Path| {
        write_program(&inner, &format!("#!/bin/sh\n{}", replay::script(place, "")));
    };
    put(&honest);
    assert_eq!(verdicts(&bench, "yade"), (vec!["agrees".to_owned()], false));
    put(&rough);
    assert_eq!(
        verdicts(&bench, "yade"),
        (vec!["differs".to_owned()], false)
    );
}

/// So is a module that a Python script imports.
#[test]
fn a_script_whose_imported_module_changes_is_run_anew() {
    let bench = Bench::with_system_programs();
    let [honest, rough] = honest_and_rough(&bench);
    let script = "#!/usr/bin/env python3\nimport os, sys\nimport inside\n\
                  os.execv('/bin/sh', ['sh', inside.SCRIPT] + sys.argv[1:])\n";
    write_program(&bench.path("programs/yade"), script);
    let put = |place: &Path| {
        let script = place.with_extension("txt");
        fs::write(&script, replay::script(place, "")).expect("a script");
        let module = format!("SCRIPT = {:?}\n", script.display().to_string());
        fs::write(bench.path("programs/inside.py"), module).expect("a module");
    };
    put(&honest);
    assert_eq!(verdicts(&bench, "yade"), (vec!["agrees".to_owned()], false));
    put(&rough);
    assert_eq!(
        verdicts(&bench, "yade"),
        (vec!["differs".to_owned()], false)
    );
}

#[test]
fn the_explanation_says_how_mechanics_hold_and_what_the_identity_covers() {
    let bench = Bench::with_system_programs();
    replay::install(&bench, |_| Disturbance::None);
    let text = standard_output(&mut bench.tristack("crosscheck --explain yade/0.3/100"));
    for part in [
        "largest deviation in units of the allowed one: the balance of forces 0.",
        "8. Identity: ",
        "programs/yade, and ",
        "Not covered: ",
    ] {
        assert!(text.contains(part), "{text} lacks {part}");
    }
}

/// With its libraries, one changed byte of which makes another program of it.
#[test]
fn installed_codes_are_covered_with_their_libraries() {
    let external = Code::with_power(Power::Linear)
        .into_iter()
        .filter(|code| !code.is_native());
    let installed = common::installed(&external.collect::<Vec<_>>());
    installed.into_par_iter().for_each(|code| {
        let found = code.find().expect("it is installed");
        let coverage = found.coverage();
        let libraries = coverage
            .split(" of them libraries")
            .next()
            .and_then(|text| text.rsplit(' ').next()?.parse::<usize>().ok());
        assert!(libraries > Some(20), "{code}: {coverage}");
        assert!(found.identity().files_hash.is_some());
        // YADE takes too long to start.
        let is_quick = !code.as_str().starts_with("yade");
        assert_eq!(
            found.identity().witness.is_some(),
            is_quick,
            "{code}: {coverage}"
        );
        assert_eq!(
            found.identity(),
            code.find().expect("still there").identity()
        );
    });
}
