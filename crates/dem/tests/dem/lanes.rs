//! Runs in the lanes of vectors have the bits of single runs, however many share one and whenever they stop.

use tristack_dem::dem::{
    Checkpoint, LaneKind, LaneWidth, OpenRun, OpenRuns, RunQueue, compress_stack,
};
use tristack_dem::model::{
    Case, ContactConvention, CoulombOperand, DampingGrowth, HistoryUpdate, Law, Power, Preparation,
    Protocol, Sampling, Shortcuts, SideWalls, SlidingSpring, Stack, TangentialHistory,
    TangentialStiffening, TensileForce,
};
use tristack_dem::series::{Series, SeriesError};

/// A queue that gives up after it has been asked so many times.
struct Queue<'a> {
    waiting: Vec<OpenRun>,
    patience: usize,
    stopped: Vec<OpenRun>,
    series: &'a mut [Option<Series>],
    cases: &'a [Case],
}

impl RunQueue for Queue<'_> {
    fn next(&mut self) -> Option<OpenRun> {
        self.waiting.pop()
    }

    fn wanted(&mut self, open: &dyn OpenRuns) -> bool {
        self.patience -= 1;
        if self.patience > 0 {
            return true;
        }
        self.stopped = open
            .checkpoints()
            .into_iter()
            .map(|(index, checkpoint)| OpenRun {
                index,
                case: self.cases[index],
                checkpoint: Some(through_a_file(&checkpoint)),
            })
            .collect();
        false
    }

    fn ended(&mut self, index: usize, series: Result<Series, SeriesError>) {
        self.series[index] = series.ok();
    }
}

fn through_a_file(checkpoint: &Checkpoint) -> Checkpoint {
    let text = serde_json::to_string(checkpoint).expect("plain data has a JSON form");
    serde_json::from_str(&text).expect("what was written can be read")
}

/// Series of all `cases`, in vectors of the widths in turn, stopped as often as there are widths.
fn in_lanes(cases: &[Case], widths: &[LaneWidth], patience: usize) -> Vec<Option<Series>> {
    let mut series = vec![None; cases.len()];
    let mut waiting: Vec<OpenRun> = (0..cases.len())
        .map(|index| OpenRun {
            index,
            case: cases[index],
            checkpoint: None,
        })
        .collect();
    for width in widths.iter().cycle() {
        let mut queue = Queue {
            waiting,
            patience,
            stopped: Vec::new(),
            series: &mut series,
            cases,
        };
        width.compress_stacks(&mut queue);
        waiting = [queue.waiting, queue.stopped].concat();
        if waiting.is_empty() {
            break;
        }
    }
    series
}

fn alone(cases: &[Case]) -> Vec<Option<Series>> {
    let alone = |case| compress_stack(case, || true).expect("a series");
    cases.iter().map(alone).map(Some).collect()
}

fn case(floor_friction: f64, stiffness: f64, time_step: f64) -> Case {
    Case {
        stack: Stack::paper(floor_friction, stiffness),
        convention: ContactConvention::TURNING,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 40.0,
                rest_time: 20.0,
            },
            time_step,
            wall_speed: 1e-4,
            wall_travel: 12.0 / stiffness,
            sampling: Sampling {
                coarse_interval: 7.0,
                fine_from_travel: 9.0 / stiffness,
                fine_interval: 1.0,
            },
            shortcuts: None,
        },
    }
}

/// Cases of one kind that differ in every number.
fn different_cases() -> Vec<Case> {
    let mut cases: Vec<Case> = (0..11)
        .map(|index| {
            let part = f64::from(index) / 11.0;
            let mut case = case(0.15 + 0.3 * part, 100.0 + 900.0 * part, 0.02 + 0.05 * part);
            case.stack.stiffness_ratio = 2.5 - part;
            case.stack.cylinder_friction = 0.5 + 0.3 * part;
            case.convention.arms.pair.torque = -part;
            case.convention.arms.pair.kinematic = -0.3 * part;
            case.convention.arms.floor.torque = -0.5 * part;
            case.convention.arms.floor.kinematic = -part;
            case.convention.restitution = 0.6 + 0.2 * part;
            case.convention.moment_of_inertia = 0.5 - 0.1 * part;
            case
        })
        .collect();
    cases[3].protocol.wall_travel *= 2.0;
    cases
}

#[test]
fn every_width_gives_the_bits_of_single_runs() {
    let cases = different_cases();
    let expected = alone(&cases);
    for width in LaneWidth::available() {
        assert!(
            in_lanes(&cases, &[width], usize::MAX) == expected,
            "{} lanes",
            width.lanes()
        );
    }
}

#[test]
fn every_convention_has_the_same_bits_in_lanes() {
    let mut conventions = vec![ContactConvention::TURNING; 6];
    conventions[0].coulomb_operand = CoulombOperand::Spring;
    conventions[1].sliding_spring = SlidingSpring::FollowsLimit;
    conventions[2].history_update = HistoryUpdate::Projected;
    conventions[3].history_update = HistoryUpdate::Linearised;
    conventions[4].tensile_force = TensileForce::NeverPulls;
    conventions[5].history_update = HistoryUpdate::Fixed;
    for convention in conventions {
        let cases: Vec<Case> = [0.2, 0.25, 0.3]
            .map(|friction| Case {
                convention,
                ..case(friction, 200.0, 0.05)
            })
            .into();
        assert!(
            in_lanes(&cases, &[LaneWidth::widest()], usize::MAX) == alone(&cases),
            "{convention:?}"
        );
    }
}

#[test]
fn every_law_has_the_same_bits_in_lanes_of_every_width_and_from_checkpoints() {
    for power in Power::ALL {
        for history in TangentialHistory::ALL {
            let law = Law {
                history,
                floor_ratio: 1.3,
                floor_kappa: Some(2.0),
                tangential_stiffening: match history.keeps_force() {
                    true => TangentialStiffening::Every,
                    false => TangentialStiffening::Pairs,
                },
                damping: match history.is_rescaled() {
                    true => DampingGrowth::Viscoelastic,
                    false => DampingGrowth::ConstantRatio,
                },
                ..Law::of_power(power)
            };
            let mut cases = different_cases()[..5].to_vec();
            for case in &mut cases {
                case.convention.law = law;
            }
            let expected = alone(&cases);
            assert!(
                in_lanes(&cases, &LaneWidth::available(), 1) == expected,
                "{law}"
            );
            assert!(in_lanes(&cases, &[LaneWidth::widest()], usize::MAX) == expected);
        }
    }
}

#[test]
fn side_walls_have_the_same_bits_in_lanes() {
    let cases: Vec<Case> = [0.0, 0.002, 0.01, 0.05]
        .map(|push| {
            let mut case = case(0.25, 100.0, 0.05);
            case.protocol.preparation = Preparation::SideWalls(SideWalls {
                settle_time: 50.0,
                rest_time: 50.0,
                landing_speed: push,
                ..SideWalls::paper(push, 0.01)
            });
            case
        })
        .into();
    for width in LaneWidth::available() {
        assert!(in_lanes(&cases, &[width], usize::MAX) == alone(&cases));
    }
}

#[test]
fn runs_taken_up_from_checkpoints_end_with_the_same_bits() {
    let mut cases = different_cases();
    for case in &mut cases {
        case.protocol.time_step /= 40.0;
    }
    let expected = alone(&cases);
    let longest = cases.iter().map(Case::total_steps).max();
    assert!(longest > Some(4 << 16), "{longest:?}");
    for patience in [1, 2] {
        assert!(in_lanes(&cases, &LaneWidth::available(), patience) == expected);
    }
}

#[test]
fn a_kind_is_what_lanes_cannot_differ_in() {
    let [one, other] = [case(0.2, 100.0, 0.1), different_cases()[5]];
    assert_eq!(LaneKind::of(&one), LaneKind::of(&other));
    let mut capped = one;
    capped.convention.sliding_spring = SlidingSpring::FollowsLimit;
    assert_ne!(LaneKind::of(&one), LaneKind::of(&capped));
    let mut hertz = one;
    hertz.convention.law = Law::HERTZ;
    assert_ne!(LaneKind::of(&one), LaneKind::of(&hertz));
}

#[test]
fn runs_with_shortcuts_are_shorter_and_have_the_same_bits_in_lanes() {
    let cases: Vec<Case> = [0.2, 0.25, 0.3]
        .map(|friction| {
            let mut case = case(friction, 200.0, 0.05);
            case.protocol.shortcuts =
                Shortcuts::towards(9.0 / 200.0, case.protocol.wall_speed, f64::INFINITY);
            case.validate().expect("a valid case");
            case
        })
        .into();
    let short = in_lanes(&cases, &[LaneWidth::widest()], usize::MAX);
    assert!(short == alone(&cases));
    for (case, series) in cases.iter().zip(&short) {
        let mut plain = *case;
        plain.protocol.shortcuts = None;
        assert!(case.total_steps() < plain.total_steps() * 3 / 4);
        let series = series.as_ref().expect("a series").to_csv();
        let read = Series::read(series.as_slice(), case);
        assert!(read.is_ok(), "what ends with the drop can be read again");
    }
}
