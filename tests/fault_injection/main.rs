//! Faults at random moments. Whatever happens, no finished run is lost, no wrong verdict gets out, nothing is left
//! running or lying about, and going on gives the same bytes as if nothing had happened.
//!
//! `TRISTACK_FAULT_ROUNDS` and `TRISTACK_FAULT_SEED` say how many rounds and which ones, `TRISTACK_FAULT_ONLY` a part of the
//! faults' names; `TRISTACK_FAULT_REPORT` names a file for what was done.

#[path = "../common/mod.rs"]
mod common;

mod code_faults;
mod disk;
mod fault;
mod folder_faults;
mod misbehaviour;
mod process_faults;
mod processes;
mod report;
mod round;
mod store_faults;
mod workload;

use fault::Fault;
use round::{Round, Story};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use workload::Workloads;

/// Each fault once.
const ROUNDS: usize = 57;
const TRIES: u64 = 5;
/// Number of rounds at once; a round mostly waits.
const AT_ONCE: usize = 3;

/// Plays a round again that came to nothing because its moment was too early or too late.
fn play(fault: Fault, workloads: &Workloads, seed: u64) -> Result<Story, String> {
    let seeds = (0..TRIES).map(|again| seed | again << 48);
    let mut outcome = Err("it was not played".to_owned());
    for seed in seeds {
        outcome = Round::play(fault, workloads, seed);
        if !matches!(&outcome, Ok(story) if !story.struck) {
            break;
        }
    }
    outcome
}

fn number(variable: &str, default: usize) -> usize {
    let value = std::env::var(variable).unwrap_or_default();
    match value.as_str() {
        "" => default,
        value => value.parse().expect("a whole number"),
    }
}

#[test]
fn no_fault_loses_a_finished_run_or_lets_a_wrong_verdict_out() {
    let (rounds, seed) = (
        number("TRISTACK_FAULT_ROUNDS", ROUNDS),
        number("TRISTACK_FAULT_SEED", 1),
    );
    let commit = report::commit();
    let workloads = Workloads::find();
    let only = std::env::var("TRISTACK_FAULT_ONLY").unwrap_or_default();
    let faults = Fault::all().filter(|fault| format!("{fault:?}").contains(&only));
    let faults: Vec<Fault> = faults.filter(Fault::is_possible).collect();
    let next = AtomicUsize::new(0);
    let outcomes = Mutex::new(Vec::new());
    std::thread::scope(|threads| {
        for _ in 0..AT_ONCE {
            threads.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= rounds {
                        return;
                    }
                    let fault = faults[index % faults.len()];
                    let outcome = play(fault, &workloads, (seed << 32 | index) as u64);
                    if let Err(complaint) = &outcome {
                        eprintln!("round {index} of seed {seed}, {fault:?}: {complaint}");
                    }
                    let mut outcomes = outcomes.lock().unwrap_or_else(PoisonError::into_inner);
                    outcomes.push((fault, outcome));
                }
            });
        }
    });
    let outcomes = outcomes.into_inner().expect("no round panics");
    report::write(seed, &commit, &outcomes);
    assert_eq!(outcomes.len(), rounds);
    let complaints = outcomes.iter().filter(|(_, outcome)| outcome.is_err());
    assert_eq!(
        complaints.count(),
        0,
        "rounds that went wrong are told above"
    );
}
