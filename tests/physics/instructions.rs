//! How many instructions a native step takes, counted by valgrind: a benchmark that does not look at the clock.
//!
//! This program runs itself under callgrind, twice for each width of vectors; what the longer run takes more,
//! over its further steps, is the cost of a step without anything that comes before the first. Valgrind knows no
//! AVX-512, so that the widest vectors counted are the four lanes of AVX2.

use std::process::Command;
use tristack::dem::{LaneWidth, OpenRun, OpenRuns, RunQueue};
use tristack::model::{Case, ContactConvention, Preparation, Protocol, Sampling, Stack};
use tristack::series::{Series, SeriesError};

/// Lanes, and instructions per step and case when the loop was last looked at: of a release, which is what users
/// run, …
const PINNED: [(usize, f64); 3] = [(1, 718.0), (2, 481.5), (4, 168.3)];
/// … and of the tests, in which the operations on vectors are calls.
const PINNED_IN_TESTS: [(usize, f64); 3] = [(1, 763.0), (2, 757.0), (4, 776.7)];

/// Another compiler orders a loop a little differently; a call that is no longer inlined, a branch in every
/// contact, or a number that goes through memory costs more than this.
const TOLERANCE: f64 = 0.05;

const CASES: usize = 8;
/// Steps of compression in the shorter and the longer run.
const STEPS: [u64; 2] = [4_000, 12_000];

/// Tell [`workload`] what to do.
const LANES_VARIABLE: &str = "TRISTACK_COUNTED_LANES";
const STEPS_VARIABLE: &str = "TRISTACK_COUNTED_STEPS";

#[test]
fn a_step_takes_as_many_instructions_as_it_did() {
    if !valgrind_is_installed() {
        return;
    }
    let is_release = !cfg!(debug_assertions);
    for (lanes, pinned) in if is_release { PINNED } else { PINNED_IN_TESTS } {
        let [short, long] = STEPS.map(|steps| instructions(lanes, steps));
        let steps = (STEPS[1] - STEPS[0]) as f64 * CASES as f64;
        let counted = (long - short) / steps;
        println!("{lanes} lanes: {counted:.1} instructions per step and case, pinned {pinned}");
        let change = counted / pinned - 1.0;
        assert!(
            change.abs() < TOLERANCE,
            "{lanes} lanes: {counted:.1} instructions per step and case instead of {pinned}: {:+.1} %; if \
             that is wanted, pin the new number",
            100.0 * change
        );
    }
}

/// Whether valgrind is there; fails if it is not although TRISTACK_REQUIRE_VALGRIND is set.
fn valgrind_is_installed() -> bool {
    let installed = Command::new("valgrind").arg("--version").output().is_ok();
    let required = std::env::var_os("TRISTACK_REQUIRE_VALGRIND").is_some();
    assert!(
        installed || !required,
        "valgrind is required, but not installed"
    );
    if !installed {
        eprintln!("valgrind is not installed: no instructions are counted");
    }
    installed
}

/// Instructions of [`workload`] in so many lanes, with so many steps.
fn instructions(lanes: usize, steps: u64) -> f64 {
    let program = std::env::current_exe().expect("this program has a path");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([
            "instructions::workload",
            "--exact",
            "--ignored",
            "--test-threads=1",
        ])
        .env(LANES_VARIABLE, lanes.to_string())
        .env(STEPS_VARIABLE, steps.to_string())
        .output()
        .expect("valgrind starts");
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{messages}");
    let mut lines = messages.lines();
    let count = lines.find_map(|line| line.split_once("Collected :"));
    let (_, count) = count.expect("callgrind says what it has counted");
    count.trim().parse().expect("a number")
}

#[test]
#[ignore = "carried out under valgrind by the test above"]
fn workload() {
    let variable = |name| std::env::var(name).ok()?.parse::<u64>().ok();
    let (Some(lanes), Some(steps)) = (variable(LANES_VARIABLE), variable(STEPS_VARIABLE)) else {
        return;
    };
    let cases: Vec<Case> = (0..CASES).map(|index| case(index, steps)).collect();
    let mut widths = LaneWidth::available().into_iter();
    let width = widths.find(|width| width.lanes() as u64 == lanes);
    let width = width.expect("valgrind has vectors of this width");
    width.compress_stacks(&mut Queue(cases.iter().enumerate()));
}

/// So many steps of compression, long before the yield, with hardly a row.
fn case(index: usize, steps: u64) -> Case {
    const TIME_STEP: f64 = 0.1;
    const TRAVEL: f64 = 0.05;
    let duration = TIME_STEP * steps as f64;
    Case {
        stack: Stack::paper(0.3 + 1e-3 * index as f64, 1e3),
        convention: ContactConvention::TURNING,
        protocol: Protocol {
            preparation: Preparation::GravityRamp {
                ramp_time: 100.0,
                rest_time: 100.0,
            },
            time_step: TIME_STEP,
            wall_speed: TRAVEL / duration,
            wall_travel: TRAVEL,
            sampling: Sampling {
                coarse_interval: duration,
                fine_from_travel: TRAVEL,
                fine_interval: 10.0,
            },
            shortcuts: None,
        },
    }
}

/// Hands out the cases, and looks at their series only to see that they are whole.
struct Queue<'a>(std::iter::Enumerate<std::slice::Iter<'a, Case>>);

impl RunQueue for Queue<'_> {
    fn next(&mut self) -> Option<OpenRun> {
        let (index, &case) = self.0.next()?;
        Some(OpenRun {
            index,
            case,
            checkpoint: None,
        })
    }

    fn wanted(&mut self, _open: &dyn OpenRuns) -> bool {
        true
    }

    fn ended(&mut self, _index: usize, series: Result<Series, SeriesError>) {
        series.expect("a whole series");
    }
}
