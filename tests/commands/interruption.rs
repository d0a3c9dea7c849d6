//! A long native run that is interrupted goes on from there, and ends with the same bits.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use tristack::code::Run;
use tristack::code::{Code, Failure, Interrupt, RunContext, SettledCode};
use tristack::files::{seal, unseal};
use tristack::model::{Case, ContactConvention, Preparation, Stack};
use tristack::runs::{Progress, Recorded, SelectedCode, Settings, Store, Workload};
use tristack::series::Series;
use tristack::study::Campaign;
use tristack::study::yield_force::plan;

/// Some 1e7 steps each.
fn long_cases(count: usize) -> Vec<Case> {
    let frictions = [0.2, 0.22, 0.24];
    let cases = frictions.into_iter().take(count).map(|friction| {
        let stack = Stack::paper(friction, 1e2);
        let mut case = plan(&SettledCode::native(), &stack, ContactConvention::TURNING).cases[0];
        case.protocol.time_step = 1e-3;
        case.protocol.sampling.coarse_interval *= 0.1;
        case
    });
    cases.collect()
}

/// Outcomes of `cases` with an interrupt as soon as one of them has done `stop_at` steps.
fn outcomes(cases: &[Case], checkpoints: &Path, stop_at: u64) -> (Vec<Result<Run, Failure>>, u64) {
    let (interrupt, first) = (Interrupt::new(), AtomicU64::new(u64::MAX));
    let advanced = |_: usize, steps: u64| {
        first.fetch_min(steps, Ordering::Relaxed);
        if steps > stop_at {
            interrupt.request();
        }
    };
    let context = RunContext {
        checkpoints: Some(checkpoints),
        advanced: &advanced,
        ..RunContext::new(checkpoints, &interrupt)
    };
    let outcomes: Mutex<Vec<Option<Result<Run, Failure>>>> =
        Mutex::new(cases.iter().map(|_| None).collect());
    let code = Code::native().find().expect("it is always there");
    code.run(cases, &context, &mut |index, result| {
        outcomes.lock().expect("nobody panics")[index] = Some(result);
    });
    let outcomes = outcomes.into_inner().expect("nobody panics").into_iter();
    (outcomes.flatten().collect(), first.into_inner())
}

#[test]
fn an_interrupted_run_is_taken_up_where_it_was_and_ends_with_the_same_bits() {
    for count in [1, 3] {
        let cases = long_cases(count);
        let [one, other] = [(); 2].map(|()| tempfile::tempdir().expect("a directory"));
        let (undisturbed, _) = outcomes(&cases, one.path(), u64::MAX);
        let half = cases[0].total_steps() / 2;
        let (interrupted, _) = outcomes(&cases, other.path(), half);
        for outcome in interrupted {
            assert!(outcome.is_err_and(|failure| failure.is_interrupted()));
        }
        let kept = fs::read_dir(other.path()).expect("a directory").count();
        assert_eq!(kept, count, "a checkpoint for each run");
        let (resumed, first) = outcomes(&cases, other.path(), u64::MAX);
        assert_eq!([resumed.len(), undisturbed.len()], [count; 2]);
        assert!(first >= half, "it went on at step {first}, not at {half}");
        for (resumed, undisturbed) in resumed.iter().zip(&undisturbed) {
            let [resumed, undisturbed] =
                [resumed, undisturbed].map(|outcome| &outcome.as_ref().expect("a run").series);
            assert!(resumed == undisturbed);
        }
    }
}

#[test]
fn a_fresh_start_takes_up_nothing() {
    let root = tempfile::tempdir().expect("a directory");
    let interrupt = Interrupt::new();
    let settings = |fresh| Settings {
        store: Store::open(&root.path().join("store")).expect("a store"),
        recorded: Recorded::embedded(),
        fresh,
        threads: 2,
        time_limit: None,
        interrupt: &interrupt,
    };
    let case = slow_start();
    for fresh in [true, false] {
        let checkpoints = settings(fresh).store.checkpoint_directory();
        fs::create_dir_all(&checkpoints).expect("a directory");
        outcomes(&[case], &checkpoints, 0);
        let file = only_file(&checkpoints);
        let sealed = fs::read(&file).expect("a checkpoint");
        let text = unseal(&file, &sealed).expect("its digest");
        let mut kept: serde_json::Value = serde_json::from_slice(text).expect("JSON");
        // By this the run is known that goes on from it.
        kept["seconds"] = 1e6.into();
        fs::write(&file, seal(kept.to_string().as_bytes())).expect("a checkpoint");
        let codes = [SelectedCode::find(Code::native())];
        let settings = settings(fresh);
        let read = Campaign::new(&codes, &settings, &Silent).read::<Run>(&[Workload {
            code: Code::native(),
            tasks: vec![case],
        }]);
        let seconds = read[0][0].as_ref().expect("a run").provenance.seconds;
        assert_eq!(seconds < 1e6, fresh, "{seconds} s");
        assert_eq!(fs::read_dir(&checkpoints).expect("a directory").count(), 0);
        fs::remove_dir_all(root.path().join("store/runs")).expect("it is there");
    }
}

struct Silent;

impl Progress for Silent {
    fn planned(&self, _: &str, _: usize, _: usize, _: f64) {}
    fn advanced(&self, _: f64) {}
    fn finished(&self, _: &Code, _: &dyn std::fmt::Display, _: Result<Option<f64>, &Failure>) {}
    fn warn(&self, _: &str) {}
}

#[test]
fn of_more_runs_than_fit_into_a_vector_every_one_is_reported_after_an_interrupt() {
    let some = long_cases(3);
    let cases: Vec<Case> = some.iter().copied().cycle().take(40).collect();
    let directory = tempfile::tempdir().expect("a directory");
    let (outcomes, _) = outcomes(&cases, directory.path(), 1000);
    assert_eq!(outcomes.len(), 40);
    let interrupted = outcomes
        .into_iter()
        .filter(|outcome| matches!(outcome, Err(failure) if failure.is_interrupted()));
    assert_eq!(interrupted.count(), 40);
}

#[test]
fn a_finished_run_needs_no_checkpoint_once_it_is_kept() {
    let root = tempfile::tempdir().expect("a directory");
    let store = Store::open(&root.path().join("store")).expect("a store");
    let cases = long_cases(1);
    let checkpoints = store.checkpoint_directory();
    let kept = || fs::read_dir(&checkpoints).expect("a directory").count();
    fs::create_dir_all(&checkpoints).expect("a directory");
    outcomes(&cases, &checkpoints, 100_000);
    let (finished, _) = outcomes(&cases, &checkpoints, u64::MAX);
    assert_eq!(kept(), 1, "it may be lost until it is kept");
    store
        .put(finished[0].as_ref().expect("a run"))
        .expect("it is kept");
    assert_eq!(kept(), 0);
}

#[test]
fn a_single_flipped_bit_in_a_checkpoint_is_noticed() {
    let cases = long_cases(1);
    let directory = tempfile::tempdir().expect("a directory");
    outcomes(&cases, directory.path(), 100_000);
    for entry in fs::read_dir(directory.path()).expect("a directory") {
        let path = entry.expect("an entry").path();
        let mut content = fs::read(&path).expect("a checkpoint");
        let digit = content.iter().rposition(u8::is_ascii_digit);
        content[digit.expect("a number")] ^= 1;
        fs::write(&path, content).expect("it can be written");
    }
    let (again, first) = outcomes(&cases, directory.path(), u64::MAX);
    assert!(again[0].is_ok());
    assert!(first < 100_000, "from the start");
}

#[test]
fn a_damaged_checkpoint_is_not_believed() {
    let cases = long_cases(1);
    let directory = tempfile::tempdir().expect("a directory");
    let (interrupted, _) = outcomes(&cases, directory.path(), 100_000);
    assert!(interrupted[0].is_err());
    for entry in fs::read_dir(directory.path()).expect("a directory") {
        let path = entry.expect("an entry").path();
        let text = fs::read_to_string(&path).expect("a checkpoint");
        fs::write(&path, &text[..text.len() / 2]).expect("it can be written");
    }
    let (again, first) = outcomes(&cases, directory.path(), u64::MAX);
    assert!(again[0].is_ok());
    assert!(first < 100_000, "from the start");
}

/// It would have led to a series with missing rows, or to numbers of another scene.
#[test]
fn a_checkpoint_that_does_not_fit_its_case_is_not_believed() {
    type Change = fn(&mut serde_json::Value);
    let changes: [Change; 6] = [
        |kept| kept["checkpoint"]["step"] = u64::MAX.into(),
        |kept| kept["checkpoint"]["step"] = 0.into(),
        |kept| kept["checkpoint"]["numbers"] = serde_json::json!([1.0]),
        |kept| kept["checkpoint"]["samples"] = serde_json::json!([]),
        |kept| kept["checkpoint"]["samples"][0]["step"] = 1.into(),
        |kept| kept["checkpoint"]["samples"][0]["time"] = 0.5.into(),
    ];
    let case = slow_start();
    let (expected, checkpoint) = kept_run(&case);
    for change in changes {
        let mut damaged = checkpoint.clone();
        change(&mut damaged);
        assert!(damaged != checkpoint);
        assert!(taken_up(&case, &damaged) == expected.series);
    }
}

/// It panicked.
#[test]
fn a_checkpoint_may_claim_any_duration() {
    let case = slow_start();
    let (expected, checkpoint) = kept_run(&case);
    for seconds in [-1.0, 1e300, -1e300, 0.0, 1.8e19] {
        let mut damaged = checkpoint.clone();
        damaged["seconds"] = seconds.into();
        assert!(taken_up(&case, &damaged) == expected.series);
    }
}

/// A case with a checkpoint early in its compression: there is one after each 65536 steps.
fn slow_start() -> Case {
    let stack = Stack::paper(0.3, 1e2);
    let mut case = plan(&SettledCode::native(), &stack, ContactConvention::TURNING).cases[0];
    case.protocol.preparation = Preparation::GravityRamp {
        ramp_time: 6000.0,
        rest_time: 400.0,
    };
    case
}

/// The run of `case`, and what is kept of it when it is interrupted.
fn kept_run(case: &Case) -> (Run, serde_json::Value) {
    let directory = tempfile::tempdir().expect("a directory");
    let (mut undisturbed, _) = outcomes(&[*case], directory.path(), u64::MAX);
    let (interrupted, _) = outcomes(&[*case], directory.path(), 0);
    assert!(interrupted[0].is_err());
    let file = only_file(directory.path());
    let sealed = fs::read(&file).expect("a checkpoint");
    let text = unseal(&file, &sealed).expect("its digest");
    let kept: serde_json::Value = serde_json::from_slice(text).expect("JSON");
    assert!(
        !kept["checkpoint"]["samples"]
            .as_array()
            .expect("rows")
            .is_empty()
    );
    (undisturbed.remove(0).expect("a run"), kept)
}

/// The series of `case`, taken up from `kept`.
fn taken_up(case: &Case, kept: &serde_json::Value) -> Series {
    let directory = tempfile::tempdir().expect("a directory");
    assert!(outcomes(&[*case], directory.path(), 0).0[0].is_err());
    let sealed = seal(kept.to_string().as_bytes());
    fs::write(only_file(directory.path()), sealed).expect("a checkpoint");
    let (mut taken_up, _) = outcomes(&[*case], directory.path(), u64::MAX);
    taken_up.remove(0).expect("a run").series
}

fn only_file(directory: &Path) -> PathBuf {
    let mut entries = fs::read_dir(directory).expect("a directory").flatten();
    entries.next().expect("a file").path()
}
