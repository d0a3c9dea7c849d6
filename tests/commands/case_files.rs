//! Case files that say only what differs from the defaults, and the example with every key.

use crate::common::{Bench, standard_error, standard_output};
use std::fs;
use std::path::Path;
use tristack::model::{Case, Preparation};

/// A file without a convention keeps the spring that files had before there was another.
const FLAGS: &str = "--mu 0.3 --stiffness 1e2 --history-update rotated";

/// The case that `simulate --code native` runs with these options.
fn case(bench: &Bench, options: &str) -> Case {
    let line = format!("simulate --code native {options} --out run");
    standard_output(&mut bench.tristack(&line));
    let case = tristack::files::read_case(&bench.path("run/case.json")).expect("a case");
    fs::remove_dir_all(bench.path("run")).expect("the run is removed");
    case
}

fn in_file(bench: &Bench, text: &str) -> Case {
    fs::write(bench.path("case.toml"), text).expect("a case file");
    case(bench, "--case case.toml")
}

fn example(bench: &Bench) -> String {
    standard_output(&mut bench.tristack("simulate --example"))
}

#[test]
fn a_friction_alone_is_the_case_of_the_flags() {
    let bench = Bench::without_codes();
    let flags = case(&bench, FLAGS);
    for text in [
        "[stack]\nmu = 0.3\n",
        "[stack]\nfloor_friction = 0.3\nstiffness = 100.0\nkappa = 2.5\nmu_d = 0.7\n",
        "[stack]\nmu = 0.3\n[protocol]\n[protocol.sampling]\n",
    ] {
        let written = in_file(&bench, text);
        assert_eq!(written.content_hash(), flags.content_hash(), "{text}");
    }
}

#[test]
fn what_is_written_takes_the_place_of_its_default_alone() {
    let bench = Bench::without_codes();
    let mut expected = case(&bench, FLAGS);
    expected.protocol.wall_travel = 0.75;
    expected.protocol.sampling.fine_interval = 1.0;
    expected.protocol.preparation = Preparation::GravityRamp {
        ramp_time: 50.0,
        rest_time: 100.0,
    };
    let text = "[stack]\nmu = 0.3\n[protocol]\nwall_travel = 0.75\nsampling = { fine_interval = 1.0 }\n\
                preparation = { kind = \"gravity-ramp\", ramp_time = 50.0 }\n";
    assert_eq!(in_file(&bench, text), expected);
    // The rest of the protocol follows the speed, as with the flag; digits that a plan would round are kept.
    let slower = case(&bench, &format!("{FLAGS} --speed 1.2345678e-3"));
    let mut written = in_file(
        &bench,
        "[stack]\nmu = 0.3\n[protocol]\nwall_speed = 1.2345678e-3\n",
    );
    assert_eq!(written.protocol.wall_speed, 1.2345678e-3);
    written.protocol.wall_speed = slower.protocol.wall_speed;
    assert_eq!(written, slower);
}

#[test]
fn a_table_of_a_law_is_the_case_of_its_options() {
    let bench = Bench::without_codes();
    let flags = case(
        &bench,
        &format!("{FLAGS} --law hertz --kappa 1.5 --history force --floor-kappa 3"),
    );
    let text = "[stack]\nmu = 0.3\nkappa = 1.5\n[convention.law]\npower = 1.5\nhistory = \"force\"\nfloor_kappa = 3\n";
    assert_eq!(in_file(&bench, text), flags);
}

/// Without a stiffness ratio it is that of the options, in every law: of a table in a file, and of a code.
#[test]
fn a_law_brings_the_stiffness_ratio_of_its_options() {
    let bench = Bench::without_codes();
    for (power, history) in [("1.5", "displacement"), ("2", "force"), ("1", "force")] {
        let flags = case(
            &bench,
            &format!("{FLAGS} --law {power} --history {history}"),
        );
        let text = format!(
            "[stack]\nmu = 0.3\n[convention.law]\npower = {power}\nhistory = \"{history}\"\n"
        );
        assert_eq!(in_file(&bench, &text), flags);
        // A whole case that leaves nothing else out.
        let mut whole: toml::Table = toml::from_str(&toml::to_string(&flags).unwrap()).unwrap();
        let stack = whole["stack"].as_table_mut().expect("a table");
        stack.remove("stiffness_ratio").expect("the key");
        let text = toml::to_string(&whole).unwrap();
        let read = Case::parse(text.as_bytes(), Path::new("case.toml")).expect("a whole case");
        assert_eq!(read.content_hash(), flags.content_hash());
    }
}

/// A code with a law of its own brings the ratio of that law, too: 2.5 is none of Mindlin's springs, which LIGGGHTS computes.
#[test]
fn the_law_of_a_code_brings_the_stiffness_ratio_of_a_file_without_one() {
    let bench = Bench::without_codes();
    let refusal = |stack: &str| {
        fs::write(
            bench.path("case.toml"),
            format!("[stack]\nmu = 0.3\n{stack}"),
        )
        .expect("a file");
        standard_error(&mut bench.tristack("simulate --code liggghts-hertz --case case.toml"))
    };
    let absent = refusal("");
    assert!(absent.contains("is not installed"), "{absent}");
    let linear = refusal("kappa = 2.5\n");
    assert!(linear.contains("stiffness_ratio` is 2.5"), "{linear}");
}

#[test]
fn side_walls_need_no_more_than_their_kind() {
    let bench = Bench::without_codes();
    for (text, push) in [("", 0.0), (", push = 0.005", 0.005)] {
        let flags = format!("{FLAGS} --preparation side-walls --push {push} --speed 1e-3");
        let text = format!(
            "[stack]\nmu = 0.3\n[protocol]\nwall_speed = 1e-3\npreparation = {{ kind = \"side-walls\"{text} }}\n"
        );
        assert_eq!(in_file(&bench, &text), case(&bench, &flags));
    }
}

/// YADE has other arms than the paper. It is not installed here, which is found out after its case is accepted.
#[test]
fn without_a_convention_it_is_that_of_the_code() {
    let bench = Bench::without_codes();
    let refusal = |convention: &str| {
        let text = format!("[stack]\nmu = 0.3\n{convention}");
        fs::write(bench.path("case.toml"), text).expect("a case file");
        standard_error(&mut bench.tristack("simulate --code yade --case case.toml"))
    };
    let absent = refusal("");
    assert!(absent.contains("yade is not installed"), "{absent}");
    let paper = refusal("[convention]\n");
    assert!(paper.contains("convention.pair"), "{paper}");
}

#[test]
fn the_example_is_the_default_case_with_a_meaning_of_every_key() {
    let bench = Bench::without_codes();
    let text = example(&bench);
    let read = Case::parse(text.as_bytes(), Path::new("example.toml")).expect("a whole case");
    assert_eq!(read, case(&bench, "--mu 0.3 --stiffness 1e2"));
    let lines: Vec<&str> = text.lines().collect();
    for (index, line) in lines.iter().enumerate() {
        if !line.is_empty() && !line.starts_with('#') {
            let before = index.checked_sub(1).map_or("", |before| lines[before]);
            assert!(before.starts_with("# "), "{line} has no meaning");
        }
    }
}

#[test]
fn a_partial_case_is_refused_with_line_key_and_reason() {
    let bench = Bench::without_codes();
    for (text, part) in [
        ("[stack]\nmu = 0.3\nnu = 0.3\n", "line 3"),
        (
            "[stack]\nmu = 0.3\n[protocol]\ntimestep = 0.1\n",
            "unknown field `timestep`",
        ),
        (
            "[stack]\nmu = 0.3\n[protocol.preparation]\nramp_time = 50.0\n",
            "missing field `kind`",
        ),
        (
            "[stack]\nmu = 0.3\n[protocol]\nwall_travel = -1.0\n",
            "`protocol.wall_travel` is -1",
        ),
        ("[stack]\nmu = -0.3\n", "`stack.floor_friction` is -0.3"),
        (
            "[stack]\nmu = 0.9\n",
            "`stack.floor_friction` is 0.9, but must be one at which the stack yields",
        ),
        ("[protocol]\n", "missing field `stack`"),
    ] {
        fs::write(bench.path("case.toml"), text).expect("a case file");
        let message =
            standard_error(&mut bench.tristack("simulate --code native --case case.toml"));
        assert!(
            message.contains(part) && message.contains("case.toml"),
            "{message}"
        );
    }
    for line in ["simulate", "simulate --example --code native"] {
        bench.tristack(line).assert().code(1);
    }
}
