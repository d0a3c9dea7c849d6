//! Mended defects in the handling of input, one test a finding
//! (reference/reliability/fuzz.json tells which).

use super::common::{Bench, installed, recording, standard_error};
use super::soundness::scenes::{short_case, short_test};
use super::soundness::{check_within, options};
use std::ffi::OsString;
use std::path::Path;
use tristack::code::{Code, Interrupt, RunContext, pyramid_in_log, version_in_answer};
use tristack::dem::{Checkpoint, compress_stack, run_contact_test};
use tristack::model::{Case, ContactConvention, ContactTest, Pyramid};
use tristack::output::run_svg;
use tristack::paper::claims::Register;
use tristack::runs::{ProbeRecord, Recording};
use tristack::series::{Frames, Motion, Series, SeriesError};

/// It overflowed: a panic, or a record without rows that passed for one of 2⁶⁴ − 1 steps.
#[test]
fn a_motion_of_2_to_the_64_steps_is_refused() {
    let motion = run_contact_test(&short_test()).expect("a finite motion");
    let refusal = Motion::new(motion.rows().to_vec(), u64::MAX).unwrap_err();
    assert!(matches!(refusal, SeriesError::Truncated { found: 4, .. }));
    assert!(Motion::new(Vec::new(), u64::MAX).is_err());
}

/// Every row was kept until the end of the file.
#[test]
fn a_series_with_too_many_rows_is_refused_after_the_first_of_them() {
    let case = short_case();
    let csv = compress_stack(&case, || true)
        .expect("a finite series")
        .to_csv();
    let text = String::from_utf8(csv).expect("text");
    let last = text.lines().last().expect("a row");
    let rows = usize::try_from(case.protocol.schedule().rows()).expect("few");
    let long = format!("{text}{}", format!("{last}\n").repeat(1000));
    let refusal = Series::read(long.as_bytes(), &case).unwrap_err();
    let SeriesError::Truncated { found, expected } = refusal else {
        panic!("{refusal}");
    };
    assert_eq!((found, expected), (rows + 1, rows));
}

/// A summary with values out of their range was accepted as recorded.
#[test]
fn a_summary_of_an_impossible_case_is_refused_with_its_table() {
    let mut recording = recording(&Code::named("liggghts").expect("it is built in"));
    let case = &mut recording.runs[1].summary.case;
    case.protocol.time_step = 9.0;
    let (table, archive) = recording.to_files(&Code::named("liggghts").expect("it is built in"));
    let directory = Path::new("mine");
    let refused = Recording::from_files(
        &table,
        &archive,
        directory,
        &Code::named("liggghts").expect("it is built in"),
    )
    .unwrap_err();
    let message = refused.to_string();
    assert!(
        message.contains("mine/liggghts.csv") && message.contains("protocol.time_step"),
        "{message}"
    );
}

/// They were accepted, and led to claims that hold by infinite deviation.
#[test]
fn infinite_numbers_in_the_register_of_claims_are_refused() {
    let claim = |change: &str| {
        let text =
            format!("[[claim]]\nid = 'a'\nplace = 'p'\nstatement = 's'\nkind = 'number'\n{change}");
        Register::from_toml(&text, "my.toml").map_err(|error| error.to_string())
    };
    let message =
        claim("check = 'quintic'\nallowed = { size = inf, of = 'F', because = 'x' }").unwrap_err();
    assert!(message.contains("`allowed.size` is inf"), "{message}");
    for value in ["inf", "-inf", "nan"] {
        let set = format!("[claim.erratum]\ntext = 't'\nset = {{ stack_weights = {value} }}");
        let message = claim(&format!("check = 'quintic'\n{set}")).unwrap_err();
        assert!(message.contains("`erratum.set.stack_weights`"), "{message}");
    }
}

/// The picture had a hatch every tenth of a radius, however wide the stack: 10¹³ of them, until memory ended.
#[test]
fn the_picture_of_a_stack_that_exploded_stays_small() {
    let case = short_case();
    let mut rows = compress_stack(&case, || true)
        .expect("a finite series")
        .samples()
        .to_vec();
    for far in [1e12, -1e300, f64::MAX] {
        rows.last_mut().expect("a row").bodies[1].position[0] = far;
        rows.last_mut().expect("a row").bodies[0].position[1] = far.abs();
        let series = Series::new(rows.clone(), &case);
        let series = series.expect("finite");
        let frames = Frames::of_series(&series, &case).expect("all columns");
        assert!(run_svg("yade", &case, &frames).len() < 1_000_000);
    }
}

/// An empty answer, or one of control characters, stood as it was in tables and addresses.
#[test]
fn the_version_in_an_answer_is_readable_and_short() {
    let before = "Yade version: ";
    for nothing in ["", "\n \n", "\u{1b}\u{7}", ", 2023", "\u{0}"] {
        assert_eq!(version_in_answer(nothing, before), "unknown", "{nothing:?}");
    }
    assert_eq!(
        version_in_answer("\nYade version: 2023.02a, x\n", before),
        "2023.02a"
    );
    assert_eq!(
        version_in_answer("Yade version: 1\u{1b}[31m", before),
        "1[31m"
    );
    assert_eq!(version_in_answer(&"9".repeat(100_000), before).len(), 100);
}

/// Sums of steps overflowed.
#[test]
fn a_pyramid_that_would_take_for_ever_is_refused() {
    let pyramid = Pyramid::touching(2, 100.0, ContactConvention::TURNING);
    for endless in [
        Pyramid {
            ramp_steps: u64::MAX,
            ..pyramid
        },
        Pyramid {
            rest_steps: u64::MAX,
            ..pyramid
        },
        Pyramid {
            timed_steps: u64::MAX,
            ..pyramid
        },
    ] {
        let message = endless.validate().unwrap_err().to_string();
        assert!(
            message.contains("_steps` is") && message.contains("1e11"),
            "{message}"
        );
    }
}

#[test]
fn steps_that_took_less_than_no_time_are_refused() {
    let pyramid = Pyramid::touching(1, 100.0, ContactConvention::TURNING);
    let dump = b"ITEM: ATOMS id x y\n1 0 1\n";
    assert!(pyramid_in_log(b"Loop time of 1 on 1 procs", dump, &pyramid).is_ok());
    assert!(pyramid_in_log(b"Loop time of -1 on 1 procs", dump, &pyramid).is_err());
}

/// They reached the deck as `null`.
#[test]
fn a_micro_test_with_a_number_that_is_none_is_not_put() {
    for name in installed(&[
        Code::named("liggghts").expect("it is built in"),
        Code::named("yade").expect("it is built in"),
        Code::named("lammps").expect("it is built in"),
    ]) {
        let directory = tempfile::tempdir().expect("a directory");
        let interrupt = Interrupt::new();
        let mut test = ContactTest {
            convention: name.declaration().convention,
            ..short_test()
        };
        test.initial_motions[0].spin = f64::INFINITY;
        let code = name.find().expect("it is installed");
        let failure = code
            .probe(&[test], &RunContext::new(directory.path(), &interrupt))
            .expect_err("it cannot be put");
        let message = failure.to_string();
        assert!(
            message.contains("`spin1` is null, but must be a finite number"),
            "{message}"
        );
    }
}

/// The product of two lists has no bound of its own.
#[test]
fn too_many_combinations_of_friction_and_stiffness_are_refused_at_once() {
    let bench = Bench::without_codes();
    for command in ["theory", "sweep --code native"] {
        let line = format!("{command} --mu 0.1:0.5:0.0004 --stiffness 100:1100:1");
        let message = standard_error(&mut bench.tristack(&line));
        assert!(message.contains("1002001 combinations"), "{message}");
        bench.tristack(&line).assert().code(1);
    }
}

#[test]
fn a_case_file_that_is_not_text_is_refused_by_name() {
    let bench = Bench::without_codes();
    std::fs::write(bench.path("case.json"), b"{\"stack\xff\":").expect("a file");
    let line = "simulate --code native --case case.json";
    let message = standard_error(&mut bench.tristack(line));
    assert!(
        message.starts_with("error: case.json is not a case: invalid unicode"),
        "{message}"
    );
    bench.tristack(line).assert().code(1);
}

/// A record nested so deeply that summary it takes all of the stack is refused by the parser.
#[test]
fn deep_nesting_ends_no_parser() {
    let deep = "[".repeat(200_000);
    let path = Path::new("case.json");
    assert!(Case::parse(deep.as_bytes(), path).is_err());
    assert!(Case::parse(format!("a = {deep}").as_bytes(), Path::new("case.toml")).is_err());
    assert!(Register::from_toml(&format!("claim = {deep}"), "my.toml").is_err());
    assert!(ProbeRecord::parse(deep.as_bytes(), path).is_err());
    assert!(serde_json::from_str::<Checkpoint>(&deep).is_err());
}

/// Lists of options are no shorter than the command line.
#[test]
fn a_long_command_line_is_read_in_no_time() {
    let long = "1,".repeat(60_000) + "x";
    let words = ["theory", "--mu", &long, "--stiffness", &long];
    check_within(1.0, options::check, words.join("\n").as_bytes());
    let line = std::iter::once("tristack").chain(words);
    assert!(tristack::cli::check(line.map(OsString::from)).is_err());
}
