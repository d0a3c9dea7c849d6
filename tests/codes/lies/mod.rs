//! Lying engines: codes that are honest in the probe and wrong in the stack, or that report other numbers than they
//! computed. What truly moves the yield force by more than the tolerance must not agree.
//!
//! `TRISTACK_LIE_ROUNDS` and `TRISTACK_LIE_SEED` say how many rounds and which ones; `TRISTACK_LIE_REPORT` names a file for
//! the smallest alterations that do not agree, which takes minutes.

mod engine;
mod lie;
mod report;

use engine::Honest;
use lie::{Kind, Lie};
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use tristack::code::SettledCode;
use tristack::model::{ContactConvention, Stack};
use tristack::series::MechanicalLaw;
use tristack::study::Verdict;

const ROUNDS: usize = 300;
const MOST_ROUNDS: usize = 6000;
/// What moves the yield force by this much of the tolerance must not agree.
const RESOLUTION: f64 = 1.2;
/// Recorded numbers that are off by this much of the load, and do not move the yield force, must not agree either.
const GROSS: f64 = 1e-3;

/// A round: one lie about one stack in one convention.
struct Round {
    lie: Lie,
    label: String,
    must_be_seen: bool,
    verdict: Verdict,
    is_off: bool,
    notes: Vec<String>,
}

fn number(variable: &str, default: usize) -> usize {
    let value = std::env::var(variable).unwrap_or_default();
    match value.as_str() {
        "" => default,
        value => value.parse().expect("a whole number"),
    }
}

/// `jobs` numbered from 0, on as many threads as there are processors.
pub fn in_parallel<T: Send>(jobs: usize, job: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let (next, results) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= jobs {
                        return;
                    }
                    let result = job(index);
                    results.lock().expect("no job panics").push((index, result));
                }
            });
        }
    });
    let mut results = results.into_inner().expect("no job panics");
    results.sort_by_key(|(index, _)| *index);
    results.into_iter().map(|(_, result)| result).collect()
}

/// Plays a round. Friction that falls between two rows leaves no trace in them: docs/reliability.md says how much of it
/// passes, and nothing is asked here.
fn play(index: usize, seed: usize, honest: &[Honest]) -> Round {
    let mut random = fastrand::Rng::with_seed((seed << 32 | index) as u64);
    let honest = &honest[random.usize(..honest.len())];
    let kind = Kind::ALL[index % Kind::ALL.len()];
    let lie = Lie::drawn(kind, &mut random);
    let judged = honest.judge(&lie);
    let moved = lie.moves_yield_force_by(&honest.measurement);
    let seen_by_size = lie.is_off_by(&honest.measurement) > GROSS;
    Round {
        label: honest.label(),
        must_be_seen: kind != Kind::StaticFriction
            && (moved > RESOLUTION * honest.tolerance || seen_by_size),
        verdict: judged.verdict,
        is_off: judged.is_off,
        notes: judged.notes,
        lie,
    }
}

#[test]
fn nobody_who_is_honest_is_accused() {
    for honest in Honest::all() {
        let judged = honest.judge(&Lie::none());
        assert_eq!(
            judged.verdict,
            Verdict::Agrees,
            "{}: {:?}",
            honest.label(),
            judged.notes
        );
    }
}

/// What an adversary found in an hour, when only the onset was looked at.
#[test]
fn what_agreed_once_agrees_no_more() {
    let at = |mu, stiffness| {
        let native = SettledCode::native();
        Honest::new(&native, &Stack::paper(mu, stiffness))
    };
    let gravity_twice = Lie::of(Kind::Gravity, 1.0);
    let soft = at(0.3, 1e2);
    let needed = soft.measurement.limit.pair_friction.expect("it yields");
    for (honest, lie) in [
        (
            &soft,
            Lie::of(Kind::CylinderFriction, 0.3192 / needed - 1.0),
        ),
        (&soft, Lie::of(Kind::FrictionUntilThePeak, 6e-5)),
        (&at(0.2, 1e2), Lie::of(Kind::FrictionUntilThePeak, 1e-4)),
        (&soft, Lie::of(Kind::MadeUp, 1.0)),
        (&soft, Lie::of(Kind::FloorForces, 2.0)),
        (&at(0.5, 1e6), gravity_twice),
    ] {
        let said = honest.judge(&lie);
        assert_ne!(said.verdict, Verdict::Agrees, "{lie:?}: {:?}", said.notes);
    }
}

/// Cylinders whose spring nothing turns slip by its whole force, of which a part is along the normal: that they stick is told
/// from all of it.
#[test]
fn a_spring_that_nothing_turns_lets_cylinders_slip_by_its_whole_force() {
    let native = SettledCode::native();
    for (mu, stiffness) in engine::STACKS {
        let stack = Stack::paper(mu, stiffness);
        let honest = Honest::with(&native, &stack, ContactConvention::PAPER);
        let said = |part: f64| honest.judge(&Lie::of(Kind::CylinderFriction, part));
        // At a wall that moves, ringing adds a part to the force.
        let enough = said(0.1);
        assert_eq!(enough.verdict, Verdict::Agrees, "{mu} {:?}", enough.notes);
        let too_little = said(-1e-3);
        assert_ne!(
            too_little.verdict,
            Verdict::Agrees,
            "{mu} {:?}",
            too_little.notes
        );
    }
}

/// Positions and angles, which a code may leave out.
const OPTIONAL: [&str; 9] = [
    "x1", "y1", "theta1", "x2", "y2", "theta2", "x3", "y3", "theta3",
];

/// An honest code that does not report everything is not accused, and cannot agree: what is not reported cannot
/// contradict it.
#[test]
fn an_engine_that_leaves_columns_out_gains_no_agreement() {
    let native = SettledCode::native();
    for (mu, stiffness) in engine::STACKS {
        let honest = Honest::new(&native, &Stack::paper(mu, stiffness));
        let runs = honest.runs(&Lie::none());
        let each = OPTIONAL.iter().map(std::slice::from_ref);
        for absent in each.chain([&OPTIONAL[..]]) {
            let said = honest.judge_without(absent, runs.clone());
            let notes = said.notes.join("\n");
            assert_eq!(said.verdict, Verdict::Inconclusive, "{absent:?}: {notes}");
            let told = format!("does not report {}", absent.join(", "));
            assert!(notes.contains(&told), "{notes}");
        }
    }
}

/// What positions would show, and the forces do not.
#[test]
fn a_lie_that_only_positions_show_does_not_agree_without_them() {
    let native = SettledCode::native();
    let honest = Honest::new(&native, &Stack::paper(0.3, 1e2));
    for lie in [
        Lie::of(Kind::MadeUp, 1.0),
        Lie::of(Kind::WallSpeed, 0.1),
        Lie::of(Kind::BothSides, 0.1),
        Lie::of(Kind::MomentOfInertia, 0.2),
    ] {
        let said = honest.judge_without(&OPTIONAL, honest.runs(&lie));
        assert_ne!(said.verdict, Verdict::Agrees, "{lie:?}: {:?}", said.notes);
    }
}

#[test]
fn a_lie_that_moves_the_yield_force_never_agrees() {
    let honest = Honest::all();
    let (wanted, seed) = (
        number("TRISTACK_LIE_ROUNDS", ROUNDS),
        number("TRISTACK_LIE_SEED", 1),
    );
    let mut rounds: Vec<Round> = Vec::new();
    // Until each check has been the only one to notice some lie: without it that round would agree.
    while rounds.len() < wanted || (!never_alone(&rounds).is_empty() && rounds.len() < MOST_ROUNDS)
    {
        let begin = rounds.len();
        rounds.extend(in_parallel(ROUNDS, |index| {
            play(begin + index, seed, &honest)
        }));
    }
    let passed = rounds
        .iter()
        .filter(|round| round.must_be_seen && round.verdict == Verdict::Agrees);
    let passed: Vec<String> = passed
        .map(|round| format!("{:?} at {}", round.lie, round.label))
        .collect();
    assert!(passed.is_empty(), "these agree: {passed:#?}");
    let truths = rounds
        .iter()
        .filter(|round| round.lie.kind == Kind::FewDigits);
    for round in truths {
        let (lie, notes) = (round.lie, &round.notes);
        assert_ne!(
            round.verdict,
            Verdict::Differs,
            "{lie:?} at {}: {notes:?}",
            round.label
        );
    }
    let tried = rounds.iter().filter(|round| round.must_be_seen);
    let kinds: BTreeSet<Kind> = tried.map(|round| round.lie.kind).collect();
    assert!(kinds.len() >= 20, "only {kinds:?} had to be seen");
    assert_eq!(never_alone(&rounds), [""; 0], "these are not needed");
}

/// The checks that were never the only one to notice what had to be noticed.
fn never_alone(rounds: &[Round]) -> Vec<&'static str> {
    let noticed = rounds.iter().filter(|round| round.must_be_seen);
    let alone = noticed.filter_map(|round| {
        let checks: BTreeSet<&str> = round.notes.iter().map(|note| check(note)).collect();
        let only = checks.first().copied().filter(|_| checks.len() == 1);
        // Without an onset the peak decides.
        only.filter(|only| !round.is_off || *only == NO_ONSET)
    });
    let alone: BTreeSet<&str> = alone.collect();
    let mut needed = CHECKS.to_vec();
    needed.retain(|check| !alone.contains(check));
    needed
}

const NO_ONSET: &str = "between slip and peak";

/// The checks that are asserted to be needed, by a part of their notes.
const CHECKS: [&str; 7] = [
    MechanicalLaw::ForceBalance.as_str(),
    MechanicalLaw::MirrorSymmetry.as_str(),
    MechanicalLaw::WallOverlap.as_str(),
    MechanicalLaw::FloorOverlap.as_str(),
    "does not begin at rest",
    NO_ONSET,
    "are not seen to carry",
];

/// The check that a note comes from.
fn check(note: &str) -> &str {
    let known = CHECKS.into_iter().find(|check| note.contains(check));
    known.unwrap_or(note)
}

#[test]
fn the_resolution_is_measured_where_it_is_asked_for() {
    let Some(path) = std::env::var_os("TRISTACK_LIE_REPORT") else {
        return;
    };
    report::write(&path, number("TRISTACK_LIE_ROUNDS", ROUNDS));
}
