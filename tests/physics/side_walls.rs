//! The paper's preparation between side walls: native against theory, and what is refused. The other codes
//! are in tests/codes/live.rs.

use crate::common::{Bench, json_rows, standard_error, standard_output};
use tristack::code::{Code, Failure, Interrupt, SettledCode};
use tristack::dem::compress_stack;
use tristack::model::{HistoryUpdate, Preparation, Stack};
use tristack::runs::Store;
use tristack::runs::{Progress, Recorded, SelectedCode, Settings};
use tristack::study::Campaign;
use tristack::study::preparation::{
    PreparationStudy, critical_pushes, plan_preparation, study_preparation,
};
use tristack::study::yield_force::Estimator;
use tristack::theory::{critical_push, pushed_slip_force};

static INTERRUPT: Interrupt = Interrupt::new();

struct Silent;

impl Progress for Silent {
    fn planned(&self, _: &str, _total: usize, _reused: usize, _seconds: f64) {}
    fn advanced(&self, _seconds: f64) {}
    fn finished(&self, _: &Code, _: &dyn std::fmt::Display, _: Result<Option<f64>, &Failure>) {}
    fn warn(&self, message: &str) {
        panic!("{message}");
    }
}

fn settings(bench: &Bench) -> Settings<'static> {
    Settings {
        store: Store::open(&bench.path("store")).expect("a store"),
        recorded: Recorded::new(&bench.path("nothing")),
        fresh: false,
        threads: 2,
        time_limit: None,
        interrupt: &INTERRUPT,
    }
}

fn study(stacks: &[Stack], relative_pushes: &[f64]) -> Vec<PreparationStudy> {
    let bench = Bench::without_codes();
    let settings = settings(&bench);
    let codes = [SelectedCode::find(Code::native())];
    let campaign = Campaign::new(&codes, &settings, &Silent);
    study_preparation(&campaign, stacks, relative_pushes, &[]).expect("native runs")
}

/// Largest possible difference between F(A) and its limit, in m g: that limit leaves out the area between two
/// paths in the plane of ρ and ψ. All states of the preparation lie in a rectangle of height 0.53 ε (overlap
/// under the whole weight, held by walls) and width ε/4 + A/(3√3), and an area counts like a push 1/0.718 of it.
fn detour(stack: &Stack, push: f64) -> f64 {
    let epsilon = stack.epsilon();
    let area = 0.53 * epsilon * (0.25 * epsilon + push / 27f64.sqrt());
    let force =
        |push| pushed_slip_force(stack, push, HistoryUpdate::Fixed).expect("the floor slips");
    let slope = (force(epsilon) - force(0.0)) / epsilon;
    slope * area / 0.718
}

#[test]
fn yield_force_grows_with_the_push_as_theory_says_and_starts_from_the_gravity_ramp() {
    let stacks = [Stack::paper(0.2, 1e2), Stack::paper(0.3, 1e4)];
    for study in study(&stacks, &[0.25, 1.0]) {
        assert_eq!(study.rows.len(), 1 + 4);
        for row in &study.rows {
            let force = row.yield_force.expect("a yield force");
            let limit = row.limit_force.expect("a limit");
            let allowed = row.uncertainty.expect("an uncertainty")
                + row.push.map_or(0.0, |push| detour(&study.stack, push));
            println!(
                "A = {:?}: {force}, limit {limit}, allowed {allowed:e}",
                row.push
            );
            assert!((force - limit).abs() <= allowed, "{row:?}");
            assert_eq!(row.estimator, Some(Estimator::SlipOnset));
        }
        let [ramp, unpushed] = [0, 1].map(|index| &study.rows[index]);
        assert_eq!((ramp.push, unpushed.push), (None, Some(0.0)));
        assert_eq!(ramp.limit_force, study.exact_force);
        let largest = study.rows.last().and_then(|row| row.push).expect("a push");
        assert!(study.shift(largest).expect("both forces") > 0.0);
    }
}

#[test]
fn bottom_cylinders_touch_beyond_the_critical_push_and_not_before() {
    for study in study(&[Stack::paper(0.2, 1e2)], &[0.25, 0.5, 0.55, 1.0]) {
        let critical = study.critical_push.expect("c appears").push;
        for row in study.rows.iter() {
            let contact = row.contact_force.expect("a force");
            let beyond = row.push.is_some_and(|push| push > critical);
            assert_eq!(contact > 0.0, beyond, "{row:?}");
        }
    }
}

/// The theory is of leading order: what it leaves out is relatively of order ε.
#[test]
fn critical_push_is_the_predicted_one_to_leading_order() {
    let bench = Bench::without_codes();
    let stacks = [1e2, 1e4].map(|stiffness| Stack::paper(0.2, stiffness));
    let settings = settings(&bench);
    let campaign = Campaign::new(&[], &settings, &Silent);
    let found = critical_pushes(&campaign, &stacks).expect("native runs");
    assert_eq!(found.len(), stacks.len());
    for (stack, found) in stacks.iter().zip(found) {
        let (found, predicted) = (found.expect("c appears"), critical_push(stack));
        assert!(found.width < 1e-4 * found.push);
        let allowed = stack.epsilon() * predicted + found.width;
        assert!(
            (found.push - predicted).abs() < allowed,
            "{found:?} {predicted}"
        );
    }
}

/// Where the walls leave a stack that slides, the onset of slip says nothing about its yield.
#[test]
fn a_stack_that_slides_while_the_walls_go_is_judged_by_its_peak() {
    for study in study(&[Stack::paper(0.12, 1e2)], &[2.0]) {
        let row = study.rows.last().expect("a row");
        assert_eq!(row.estimator, Some(Estimator::Peak));
        let force = row.yield_force.expect("a yield force");
        // It begins at the verge of slip, so that what the push did beyond that is lost.
        let critical = study.critical_push.expect("c appears").push;
        let limits = [critical, 2.0 * critical]
            .map(|push| pushed_slip_force(&study.stack, push, HistoryUpdate::Fixed));
        let [low, high] = limits.map(|limit| limit.expect("a limit"));
        assert!((low..high).contains(&force), "{force} {low} {high}");
    }
}

/// Pinned on x86-64 Linux, debug build of version 0.1.0; see tests/physics/native_dem.rs.
#[test]
fn series_has_the_same_bits_everywhere() {
    let name = SettledCode::native();
    let case = plan_preparation(&name, &name, &Stack::paper(0.2, 1e2), Some(0.005)).cases()[0];
    let series = compress_stack(&case, || true).expect("a finite series");
    let expected = "7213659f2acf80021c6ade265307220d26f4da65b5cdc42c0cba9edc567f4a6f";
    assert_eq!(tristack::model::sha256_hex(&series.to_csv()), expected);
}

const RUN: &str = "simulate --mu 0.2 --stiffness 100";

#[test]
fn simulate_prepares_between_side_walls() {
    let bench = Bench::without_codes();
    let line = format!("{RUN} --code native --preparation side-walls --format json");
    let pushed = json_rows(&standard_output(
        &mut bench.tristack(&format!("{line} --push 0.005")),
    ));
    assert_eq!(pushed[0]["preparation"], "side-walls");
    assert_eq!(pushed[0]["push"], 0.005);
    let unpushed = json_rows(&standard_output(&mut bench.tristack(&line)));
    assert_eq!(unpushed[0]["push"], 0.0);
    let force = |run: &serde_json::Value| run["slip_force"].as_f64().expect("a number");
    assert!((force(&pushed[0]) - force(&unpushed[0]) - 0.0345).abs() < 1e-3);
}

#[test]
fn what_cannot_be_prepared_is_refused_with_what_can() {
    let bench = Bench::without_codes();
    let walls = "--preparation side-walls";
    for (line, expected) in [
        (
            format!("{RUN} --code lammps {walls}"),
            "`--preparation` is side-walls, but must be gravity-ramp for lammps",
        ),
        (
            format!("{RUN} --code native {walls} --push -0.1"),
            "`--push` is -0.1, but must be a number from 0 to 0.5",
        ),
        (
            format!("{RUN} --code native --push 0.1"),
            "`--push` is 0.1, but must be left out, unless --preparation is side-walls",
        ),
    ] {
        bench.tristack(&line).assert().code(1);
        let message = standard_error(&mut bench.tristack(&line));
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn a_case_file_with_side_walls_is_refused_where_they_are_not_offered() {
    let bench = Bench::without_codes();
    let name = Code::named("lammps").expect("it is built in");
    let name = name.as_declared().expect("nothing is left out");
    let case = plan_preparation(&name, &name, &Stack::paper(0.2, 1e2), Some(0.0)).cases()[0];
    assert!(matches!(
        case.protocol.preparation,
        Preparation::SideWalls(_)
    ));
    std::fs::write(bench.path("case.json"), case.to_json()).expect("a file");
    let line = "simulate --code lammps --case case.json";
    bench.tristack(line).assert().code(1);
    let message = standard_error(&mut bench.tristack(line));
    let expected = "`protocol.preparation.kind` is side-walls, but must be gravity-ramp for lammps";
    assert!(message.contains(expected), "{message}");
}
