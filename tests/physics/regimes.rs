//! The regime map against the native DEM, on both sides of every boundary.

use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;
use tristack::code::{Code, Failure, Interrupt};
use tristack::dem::{EventRun, Loading, Until};
use tristack::model::HistoryUpdate::{Fixed, Rotated};
use tristack::model::{HistoryUpdate, PAPER_STIFFNESS_RATIO, Stack};
use tristack::runs::{Progress, Recorded, SelectedCode, Settings, Store};
use tristack::study::regimes::{self, Survey, SurveyPlan, THREE_DIGITS, examined_stacks};
use tristack::study::{Campaign, Verdict};
use tristack::theory::{BoundaryPoint, Event, LoadingOutcome, LoadingPhase, RegimeMap};

static INTERRUPT: Interrupt = Interrupt::new();

/// Receives the progress of a survey.
#[derive(Default)]
struct Journal {
    /// Planned and reused runs of every round.
    rounds: Mutex<Vec<(usize, usize)>>,
    warnings: Mutex<Vec<String>>,
}

impl Progress for Journal {
    fn planned(&self, name: &str, total: usize, reused: usize, _: f64) {
        if name == "observation" {
            self.rounds.lock().unwrap().push((total, reused));
        }
    }
    fn advanced(&self, _: f64) {}
    fn finished(&self, _: &Code, _: &dyn std::fmt::Display, _: Result<Option<f64>, &Failure>) {}
    fn warn(&self, message: &str) {
        self.warnings.lock().unwrap().push(message.to_owned());
    }
}

fn settings(store: &Path) -> Settings<'static> {
    Settings {
        store: Store::open(store).expect("a store"),
        recorded: Recorded::new(Path::new("reference")),
        fresh: false,
        threads: 2,
        time_limit: None,
        interrupt: &INTERRUPT,
    }
}

/// The survey of `plan`; `None` after an interrupt.
fn try_survey(plan: &SurveyPlan, settings: &Settings, journal: &Journal) -> Option<Survey> {
    let native = [SelectedCode::find(Code::native())];
    regimes::survey(plan, &Campaign::new(&native, settings, journal))
}

fn survey(plan: &SurveyPlan, settings: &Settings, journal: &Journal) -> Survey {
    try_survey(plan, settings, journal).expect("a whole survey")
}

/// The survey of `points` and `stacks` under a rule in a new store.
fn surveyed(points: &[BoundaryPoint], stacks: &[Stack], rule: HistoryUpdate) -> Survey {
    let store = tempfile::tempdir().expect("a directory");
    let plan = SurveyPlan::new(points, stacks, rule);
    survey(&plan, &settings(store.path()), &Journal::default())
}

fn boundary_points(count: usize) -> Vec<BoundaryPoint> {
    let maps = RegimeMap::standard(PAPER_STIFFNESS_RATIO, Fixed).into_iter();
    maps.flat_map(|map| map.boundary_points(count, THREE_DIGITS))
        .collect()
}

#[test]
fn val_the_dem_agrees_on_both_sides_of_every_boundary() {
    let points = boundary_points(3);
    assert!(points.len() > 25);
    let survey = surveyed(&points, &[], Fixed);
    assert_eq!(survey.confirmations.len(), points.len());
    for confirmation in survey.confirmations {
        assert_eq!(confirmation.verdict(), Verdict::Agrees, "{confirmation:?}");
    }
}

#[test]
fn val_the_dem_contradicts_a_boundary_that_is_wrong_by_two_in_a_thousand() {
    let mut points = boundary_points(2);
    for (index, point) in points.iter_mut().enumerate() {
        let factor = if index.is_multiple_of(2) {
            1.002
        } else {
            0.998
        };
        point.stack = point.across.scale(&point.stack, factor);
    }
    let survey = surveyed(&points, &[], Fixed);
    assert_eq!(survey.confirmations.len(), points.len());
    for confirmation in survey.confirmations {
        assert_eq!(confirmation.verdict(), Verdict::Differs, "{confirmation:?}");
    }
}

/// The extended follower, at the moment the floor slips with c > 0. Two wall speeds are extrapolated; what
/// remains is the force that one time step adds, less than 1e-6 of F + 3.
#[test]
fn val_the_dem_slips_where_the_path_with_a_closed_contact_says() {
    let cases = [(0.3, 0.3, Rotated), (0.25, 0.8, Rotated), (0.3, 0.3, Fixed)];
    for (mu, stiffness_ratio, history_update) in cases {
        let stack = Stack {
            stiffness_ratio,
            ..Stack::paper(mu, 1e2)
        };
        let claimed = LoadingOutcome::of(&stack, history_update).unwrap().last;
        assert!(claimed.bottom_force > 0.0);
        let force = |speed: f64| {
            let loading = Loading {
                gravity_rate: 2e-3,
                wall_speed: speed * claimed.floor_overlap,
                wall_travel: 1.05 * claimed.wall_travel,
                time_step: 0.1,
            };
            let run = EventRun {
                stack,
                history_update,
                loading,
                until: Until::LastEvent,
            };
            let seen = run.observe(|| true);
            assert_eq!(seen.last, Some((Event::FloorSlip, LoadingPhase::Wall)));
            seen.force
        };
        let extrapolated = 2.0 * force(2e-5) - force(4e-5);
        let error = (extrapolated - claimed.force) / (claimed.force + 3.0);
        println!(
            "mu {mu} kappa {stiffness_ratio}: {extrapolated} {} {error:e}",
            claimed.force
        );
        assert!(error.abs() < 1e-5, "{error:e}");
    }
}

#[test]
fn val_the_dem_bears_the_largest_forces() {
    // One of each kind: yield, saturated, contact 2-3 closed, wall contact, softened.
    for rule in [Fixed, Rotated] {
        let stacks = [0, 2, 8, 15, 17].map(|index| examined_stacks(rule)[index]);
        let survey = surveyed(&[], &stacks, rule);
        assert_eq!(survey.examinations.len(), stacks.len());
        for examination in survey.examinations {
            assert_eq!(
                examination.verdict,
                Verdict::Agrees,
                "{rule:?}: {examination:?}"
            );
        }
    }
}

/// A survey of few points, one of which is wrong and needs a second round.
fn small_plan() -> SurveyPlan {
    let mut points = boundary_points(2);
    points.truncate(2);
    points[0].stack = points[0].across.scale(&points[0].stack, 1.002);
    SurveyPlan::new(&points, &[], Fixed)
}

#[test]
fn a_survey_is_made_once_and_then_taken_from_the_store() {
    let store = tempfile::tempdir().expect("a directory");
    let journal = Journal::default();
    let mut settings = settings(store.path());
    let first = survey(&small_plan(), &settings, &journal);
    let again = survey(&small_plan(), &settings, &journal);
    settings.fresh = true;
    let fresh = survey(&small_plan(), &settings, &journal);
    assert_eq!(again, first);
    assert_eq!(fresh, first);
    let rounds = journal.rounds.into_inner().unwrap();
    let (total, repeats) = (rounds[0].0, rounds[1].0);
    assert_eq!(total, 4);
    assert!(repeats > 0);
    let expected = [
        [(total, 0), (repeats, 0)],
        [(total, total), (repeats, repeats)],
        [(total, 0), (repeats, 0)],
    ];
    assert_eq!(rounds, expected.concat());
    assert!(journal.warnings.into_inner().unwrap().is_empty());
}

#[test]
fn a_damaged_observation_goes_into_quarantine_and_is_made_anew() {
    let store = tempfile::tempdir().expect("a directory");
    let settings = settings(store.path());
    let first = survey(&small_plan(), &settings, &Journal::default());
    let observations = store.path().join("observations");
    let files = std::fs::read_dir(&observations).expect("observations");
    let mut files: Vec<_> = files.map(|file| file.unwrap().path()).collect();
    files.sort();
    let right: Vec<Vec<u8>> = files
        .iter()
        .map(|file| std::fs::read(file).unwrap())
        .collect();
    let mut flipped = right[0].clone();
    let last = flipped.len() - 10;
    flipped[last] ^= 1;
    std::fs::write(&files[0], &flipped).unwrap();
    std::fs::write(&files[1], &right[1][..80]).unwrap();
    let journal = Journal::default();
    assert_eq!(survey(&small_plan(), &settings, &journal), first);
    let warnings = journal.warnings.into_inner().unwrap();
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    for warning in &warnings {
        assert!(
            warning.contains("damaged observation in the store") && warning.contains("quarantine"),
            "{warning}"
        );
    }
    for (file, right) in files.iter().zip(&right) {
        assert_eq!(&std::fs::read(file).unwrap(), right);
    }
    let aside = std::fs::read_dir(store.path().join("quarantine")).expect("a directory");
    let aside = aside.map(|file| std::fs::read(file.unwrap().path()).unwrap());
    assert!(aside.into_iter().any(|content| content == flipped));
}

#[test]
fn an_interrupted_survey_keeps_only_whole_observations() {
    let store = tempfile::tempdir().expect("a directory");
    let mut late = settings(store.path());
    late.time_limit = Some(Duration::ZERO);
    let cut = survey(&small_plan(), &late, &Journal::default());
    let verdicts: Vec<Verdict> = cut.verdicts().collect();
    assert_eq!(verdicts, [Verdict::Failed; 2]);
    assert!(!store.path().join("observations").exists());
    let interrupted = Interrupt::new();
    interrupted.request();
    let stopped = Settings {
        interrupt: &interrupted,
        ..settings(store.path())
    };
    let cut = try_survey(&small_plan(), &stopped, &Journal::default());
    assert_eq!(cut, None);
    let journal = Journal::default();
    let whole = survey(&small_plan(), &settings(store.path()), &journal);
    let verdicts: Vec<Verdict> = whole.verdicts().collect();
    assert_eq!(verdicts, [Verdict::Differs, Verdict::Agrees]);
    assert_eq!(journal.rounds.into_inner().unwrap()[0], (4, 0));
}

#[test]
fn several_surveys_at_a_time_share_a_store() {
    let store = tempfile::tempdir().expect("a directory");
    let surveys: Vec<Survey> = std::thread::scope(|scope| {
        let start =
            || scope.spawn(|| survey(&small_plan(), &settings(store.path()), &Journal::default()));
        let threads = [start(), start(), start()];
        threads.map(|thread| thread.join().unwrap()).into()
    });
    let journal = Journal::default();
    let kept = survey(&small_plan(), &settings(store.path()), &journal);
    assert!(surveys.iter().all(|survey| *survey == kept));
    let rounds = journal.rounds.into_inner().unwrap();
    assert!(rounds.iter().all(|(total, reused)| total == reused));
    assert!(journal.warnings.into_inner().unwrap().is_empty());
}
